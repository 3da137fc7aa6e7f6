"""What `hexwright mesh` makes of every surface of a folder (docs/results/models.md), with default settings or those after `--`."""
import os
import platform

from measures import figures, is_valid, measures, reasons, surfaces, table
from pool import Job

PAGE = "models.md"
DATA = "models"
HEAD = ["model", "exit", "hexes", "min SJ", "avg SJ", "max %", "mean %", "features %", "boundary components / genus", "round", "s",
        "CPU s", "MiB", "reason"]


def mesh_job(path, options, variant="", name=None):
    return Job(name or path.name, [["{program}", "mesh", "{input}", "-o", "{out}/mesh.vtu", "--report", "{out}/report.json", "--quiet",
                                    *options]], path, variant)


def jobs(args):
    return [mesh_job(p, args.options) for p in surfaces(args.data)]


def beside(value, expected):
    return f"{value}" if expected in (None, value) else f"{value} ({expected})"


def row(record):
    step, m = record["steps"][-1], measures(record)
    head = [record["model"], "-" if step["exit"] is None else step["exit"]]
    tail = [f"{step['seconds']:.1f}", f"{step['cpu_seconds']:.1f}", f"{step['peak_mib']:.0f}", "; ".join(reasons(record))]
    if m is None:
        return head + [""] * 8 + tail
    topology, surface = m.verdict["topology"], m.verdict.get("surface") or {}
    numbers = " / ".join((beside(topology["boundary_components"], surface.get("components")), beside(topology["genus"], surface.get("genus"))))
    creases = "-" if m.creases is None else f"{100 * m.creases:.1f}"
    return head + [m.hexes, f"{m.least:.2f}", f"{m.average:.2f}", f"{100 * m.distance:.2f}", f"{100 * m.mean_distance:.3f}", creases,
                   numbers, f"{m.best_round}/{m.rounds}"] + tail


def summary(records):
    last = [r["steps"][-1] for r in records]
    done = [m for m in map(measures, records) if m]
    valid = sum(is_valid(s["exit"], s.get("report")) for s in last)
    return "\n".join([
        f"- fully valid (nothing inverted, closed manifold boundary, the surface's components, within 1% of the diagonal): {valid} of {len(last)}",
        f"- exit code 0: {sum(s['exit'] == 0 for s in last)}; 1: {sum(s['exit'] == 1 for s in last)}; "
        f"other: {sum(s['exit'] not in (0, 1) for s in last)}",
        f"- inverted hexes: {sum(m.verdict['quality']['inverted'] for m in done)} in all",
        f"- least scaled Jacobian at least 0.2: {sum(m.least >= 0.2 for m in done)}; "
        f"mean of the averages {sum(m.average for m in done) / max(1, len(done)):.3f}",
        f"- two-way distance at most 0.5%: {sum(m.distance <= 0.005 for m in done)}; at most 1%: {sum(m.distance <= 0.01 for m in done)}",
        f"- longest run {max(s['seconds'] for s in last):.0f} s, largest memory {max(s['peak_mib'] for s in last):.0f} MiB",
    ])


def page(records, args):
    return (f"""# Results over the models

Made by `{args.command}`, {args.jobs} run(s) at a time, on {platform.machine()} with {os.cpu_count()} cores; distances are shares of
the bounding box's diagonal (two-way maximum and mean); numbers in brackets are the surface's where they differ; "round" is the
best refinement of those made; "CPU s" counts all threads.

{summary(records)}

""" + table(HEAD, "lrrrrrrrllrrrl", map(row, records)))


def stored(records):
    return [figures(r) for r in records]
