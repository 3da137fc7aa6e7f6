"""Hexes per second and core of carve and fit together (docs/results/fit_speed.md): per model the rate and the passes that cost
most, from the processor seconds of all passes of the best round's fit; then the median, the worst, and the mean shares."""
import statistics

from measures import surfaces, table
from tables.models import mesh_job

PAGE = "fit_speed.md"
DATA = "models"


def jobs(args):
    return [mesh_job(p, ["--threads", "1", *args.options]) for p in surfaces(args.data)]


def largest(passes, seconds, count=3):
    top = sorted(passes.items(), key=lambda item: -item[1])[:count]
    return ", ".join(f"{name} {100 * s / seconds:.0f}%" for name, s in top)


def page(records, args):
    rows = []
    for record in records:
        report = record["steps"][-1].get("report") or {}
        passes = (report.get("fit") or {}).get("processor_seconds")
        if passes and report.get("hexes") and sum(passes.values()) > 0:
            rows.append((record["model"], report["hexes"], sum(passes.values()), passes))
    if not rows:
        return "# Speed of carve and fit\n\nNo report with a fit in it.\n"
    shares = {}
    for _, _, seconds, passes in rows:
        for name, s in passes.items():
            shares[name] = shares.get(name, 0) + s / seconds / len(rows)
    rates = [hexes / seconds for _, hexes, seconds, _ in rows]
    return (f"# Speed of carve and fit\n\nMade by `{args.command}`, {args.jobs} run(s) at a time: processor seconds of all passes of the best "
            f"round's fit.\n\n{len(rows)} models: median {statistics.median(rates):,.0f}, worst {min(rates):,.0f} hexes/s; "
            f"mean shares: {largest(shares, 1, 8)}.\n\n"
            + table(["model", "hexes", "processor s", "hexes/s", "most of it"], "lrrrl",
                    [[name, f"{hexes:,}", f"{s:.2f}", f"{hexes / s:,.0f}", largest(p, s)]
                     for name, hexes, s, p in sorted(rows, key=lambda r: r[1] / r[2])]))
