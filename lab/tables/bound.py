"""The upper bound of the largest distance (docs/results/bound.md): every model meshed once, then judged without and with it."""
from measures import surfaces, table
from pool import Job

PAGE = "bound.md"
DATA = "models"
TOLERANCE = 0.005  # of `check`, where it is not told


def jobs(args):
    mesh = ["{program}", "mesh", "{input}", "-o", "{out}/mesh.vtu", "--quiet", *args.options]
    check = ["{program}", "check", "{out}/mesh.vtu", "{input}", "--json", "--threads", "1"]
    return [Job(p.name, [mesh, [*check, "--tolerance", "0"], check], p) for p in surfaces(args.data)]


def is_judged(record):
    steps = record["steps"]
    return len(steps) == 3 and all("report" in s and s["report"].get("distance") for s in steps[1:])


def figures(record):
    """Shares of the diagonal: by samples, then the largest found and its bound; the processor seconds of both judgements."""
    before, after = (s["report"]["distance"] for s in record["steps"][1:])
    return before["max"], after["max"], after["max_upper_bound"], [s["cpu_seconds"] for s in record["steps"][1:]]


def row(record):
    if not is_judged(record):
        return [record["model"]] + [""] * 6
    sampled, found, bound, (before, after) = figures(record)
    return [record["model"], record["steps"][1]["report"]["topology"]["hexes"], f"{100 * sampled:.4f}", f"{100 * found:.4f}", f"{100 * bound:.4f}",
            f"{100 * (bound - found) / TOLERANCE:.2f}", f"{before:.2f} / {after:.2f}"]


def summary(records):
    known = [figures(r) for r in records if is_judged(r)]
    if not known:
        return "no mesh was judged"
    ratios = sorted(after / before for *_, (before, after) in known)
    moved = sorted(abs(found - sampled) / TOLERANCE for sampled, found, *_ in known)
    return "\n".join([
        f"- judged: {len(known)} of {len(records)}; bounded to within 2% of the tolerance: {sum(b - f <= 0.02 * TOLERANCE for _, f, b, _ in known)}",
        f"- bound at most the tolerance: {sum(b <= TOLERANCE for _, _, b, _ in known)}; samples at most the tolerance: {sum(s <= TOLERANCE for s, *_ in known)}",
        f"- the largest distance moves by {100 * moved[len(moved) // 2]:.2f}% of the tolerance at the median, by {100 * moved[-1]:.1f}% at most",
        f"- processor time of the whole judgement, with the bound over without: {ratios[len(ratios) // 2]:.2f} at the median, {ratios[-1]:.2f} at most; "
        f"{sum(a for *_, (_, a) in known) / sum(b for *_, (b, _) in known):.2f} in all",
    ])


def page(records, args):
    return (f"""# The largest distance and its upper bound

Made by `{args.command}`. Shares of the diagonal in percent; "samples": as it was measured before, at points of facets; "largest": found on the
patches; "gap": bound less largest, in percent of the tolerance of {100 * TOLERANCE:g}%. The definition is in [quality](../algorithms/quality.md).

{summary(records)}

""" + table(["model", "hexes", "samples", "largest", "bound", "gap", "CPU s"], "lrrrrrr", map(row, records)))
