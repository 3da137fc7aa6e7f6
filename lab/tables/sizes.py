"""Models meshed at sizes that shrink by the cube root of two (docs/results/sizes.md): whether counts follow the size, and edges keep to it."""
from measures import table
from tables.models import mesh_job

PAGE = "sizes.md"
DATA = "models"
MODELS = ["bone.obj", "fandisk.off", "joint.off", "eight.obj", "kitten.obj", "hull-body.obj", "anchor.off", "20mm-xyz-cube.stl"]
#: Shares of the diagonal, each 2^(1/3) below the one before: counts should double.
SIZES = [0.08 * 2 ** (-step / 3) for step in range(10)]


#: From here on cells are smaller than most parts of the models, percent.
FINE = 4.01


def jobs(args):
    return [mesh_job(args.data / m, ["--size", f"{100 * size:.4f}%", *args.options], f"{100 * size:.2f}%")
            for m in MODELS if (args.data / m).exists() for size in SIZES]


def report_of(record):
    return record["steps"][-1].get("report") or {}


def hexes(record):
    return report_of(record).get("hexes", 0)


def kendall(values):
    """Of a series that should rise: pairs that do less those that fall, over all pairs."""
    pairs = [(a, b) for i, a in enumerate(values) for b in values[i + 1:]]
    return sum((b > a) - (b < a) for a, b in pairs) / max(1, len(pairs))


def edge_share(record):
    """What 95% of the edges keep to, over what was asked for."""
    edges = report_of(record)["edges"]
    return edges["p95"] / edges["asked"]


def series(records, model):
    return [r for r in records if r["model"] == model and hexes(r)]


def rises(counts):
    """Rank correlation, greatest fall in percent, greatest step of a series of counts."""
    steps = [b / a for a, b in zip(counts, counts[1:])]
    return [f"{kendall(counts):.2f}", f"{100 * max(0, 1 - min(steps)):.0f}", f"{max(steps):.2f}"]


def summary_row(records, model):
    runs = series(records, model)
    counts = [hexes(r) for r in runs]
    fine = [hexes(r) for r in runs if float(r["variant"].rstrip("%")) <= FINE]
    done = sum(r["steps"][-1]["exit"] == 0 for r in runs)
    return [model, f"{counts[0]:,} to {counts[-1]:,}", *rises(counts), *rises(fine), f"{max(map(edge_share, runs)):.3f}",
            f"{done} of {len(SIZES)}"]


def count_row(records, model):
    found = {r["variant"]: hexes(r) for r in series(records, model)}
    return [model] + [f"{found.get(f'{100 * size:.2f}%', 0):,}" for size in SIZES]


def page(records, args):
    models = [m for m in MODELS if len(series(records, m)) > 1]
    return (f"""# Counts and edges by size

Made by `{args.command}`: ten sizes per model, from 8% to 1% of the diagonal, each 2^(1/3) below the one before, where twice as many hexes are
ideal. "tau" is Kendall's rank correlation of hexes with 1/size, "fall" the greatest drop of a count when the size shrinks, "step" its greatest rise;
first over all sizes, then over those of at most 4%. Coarser cells are larger than the thin parts of most of these models, which then need one level more than the
rest: there counts fall. "edges" is the greatest ratio, over the sizes, of the length that 95% of the edges keep to and the size asked for; the goal is 1.05.
Exit 1 is a mesh that misses the gate.

""" + table(["model", "hexes", "tau", "fall %", "step", "tau to 4%", "fall to 4%", "step to 4%", "edges", "exit 0"], "lrrrrrrrrr",
            [summary_row(records, m) for m in models])
            + "\n" + table(["model"] + [f"{100 * size:.2f}%" for size in SIZES], "l" + "r" * len(SIZES), [count_row(records, m) for m in models]))
