"""Growth of balance and pairing with size (docs/results/growth.md), from the growth cases of complete_bench (preset `bench`).

To be run on a machine that does nothing else. Of repeated runs the fastest counts. Growth is fitted by least squares to log
time over log n, n = leaves in + leaves out, and set beside what n and n log n would give over the same sizes.
"""
import io
import math
from collections import defaultdict

from pool import Job

PAGE = "growth.md"
DATA = None
SECONDS = 7200
SHAPES = ["sphere", "gyroid", "points"]
MODES = ["balance", "sweep", "descent"]
FIT_FROM = 1e5  # cells; below, fixed costs count


def jobs(args):
    options = args.options or ["--benchmark_repetitions=3"]
    return [Job("growth", [["{bench}", "--benchmark_filter=^growth", "--benchmark_out={out}/report.json", *options]])]


def read_runs(data):
    """{(shape, depth): {(mode, threads): {time in ms, leaves_in, leaves_out, bytes}}} with the fastest of repeated runs."""
    runs = defaultdict(dict)
    for run in data["benchmarks"]:
        if run.get("run_type") == "aggregate" or not run["name"].startswith("growth/"):
            continue
        args = dict(part.split(":") for part in run["name"].split("/") if ":" in part)
        shape, depth, mode, threads = (int(args[k]) for k in ("shape", "depth", "mode", "threads"))
        case = runs[(shape, depth)]
        if (mode, threads) not in case or run["real_time"] < case[(mode, threads)]["ms"]:
            case[(mode, threads)] = {"ms": run["real_time"], "in": run["leaves_in"], "out": run["leaves_out"],
                                     "bytes": run["peak_B_per_leaf"]}
    return data["context"], dict(sorted(runs.items()))


def slope(points):
    """Exponent of the power of n that fits the times best."""
    logs = [(math.log(n), math.log(t)) for n, t in points]
    mean_x = sum(x for x, _ in logs) / len(logs)
    mean_y = sum(y for _, y in logs) / len(logs)
    return sum((x - mean_x) * (y - mean_y) for x, y in logs) / sum((x - mean_x) ** 2 for x, _ in logs)


def milliseconds(t):
    return f"{t:.1f}" if t < 100 else f"{t:.0f}"


def row_of(shape, case):
    any_run = next(iter(case.values()))
    cells = [SHAPES[shape], f"{any_run['in']:,.0f}", f"{case.get((1, 1), any_run)['out']:,.0f}"]
    for mode in range(len(MODES)):
        one, two = case.get((mode, 1)), case.get((mode, 2))
        cells.append(milliseconds(one["ms"]) if one else "")
        cells.append(milliseconds(two["ms"]) if two else "")
        cells.append(f"{one['ms'] / two['ms']:.2f}" if one and two else "")
    sweep, descent = case.get((1, 1)), case.get((2, 1))
    cells.append(f"{sweep['in'] / sweep['ms'] / 1e3:.1f}" if sweep else "")
    cells.append(f"{descent['ms'] / sweep['ms']:.1f}" if sweep and descent else "")
    cells.append(f"{sweep['bytes']:.0f}" if sweep and sweep["out"] > 1e6 else "")
    return "| " + " | ".join(cells) + " |\n"


def write_fits(runs, out):
    out.write("\nGrowth: exponent a of time ~ n^a, n = leaves in + leaves out, over the grids with n above "
              f"{FIT_FROM:,.0f}; beside it the exponent that n log n has over the same sizes.\n\n")
    out.write("| grid | threads | balance | sweep | sweep + descent | n log n |\n|---|--:|--:|--:|--:|--:|\n")
    for shape, name in enumerate(SHAPES):
        for threads in (1, 2):
            cells, sizes = [], set()
            for mode in range(len(MODES)):
                points = [(run["in"] + run["out"], run["ms"]) for (s, _), case in runs.items() if s == shape
                          for key, run in case.items() if key == (mode, threads) and run["in"] + run["out"] > FIT_FROM]
                sizes.update(n for n, _ in points)
                cells.append(f"{slope(points):.3f}" if len(points) > 1 else "")
            limit = f"{slope([(n, n * math.log(n)) for n in sizes]):.3f}" if len(sizes) > 1 else ""
            out.write(f"| {name} | {threads} | " + " | ".join(cells + [limit]) + " |\n")


def page(records, args):
    context, runs = read_runs(records[0]["steps"][0]["report"])
    out = io.StringIO()
    out.write("# Growth of balance and pairing with size\n\n")
    out.write(f"Made by `{args.command}` "
              f"({context['num_cpus']} processors at {context['mhz_per_cpu'] / 1000:.1f} GHz; load when it began: "
              f"{', '.join(f'{x:.1f}' for x in context.get('load_avg', []))}). "
              "Wall times in ms with one and with two threads and their ratio. Balance is strong, without pairing; "
              "sweep and descent are blocks under weak balance. Speed: million input leaves per second in the sweep, one "
              "thread. Descent: its time over the sweep's. Memory: peak bytes per output leaf in the sweep, the input "
              "and the output included.\n\n")
    head = ["grid", "leaves in", "leaves out"]
    for mode in MODES:
        head += [f"{mode} 1", "2", "ratio"]
    head += ["M leaves/s", "descent / sweep", "B/leaf"]
    out.write("| " + " | ".join(head) + " |\n|---|" + "--:|" * (len(head) - 1) + "\n")
    for (shape, _), case in runs.items():
        out.write(row_of(shape, case))
    write_fits(runs, out)
    return out.getvalue()
