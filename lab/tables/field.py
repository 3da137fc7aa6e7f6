"""Inputs as people bring them, in kinds that are hard: `DATA/*` and `DATA/real/*`, each beside what is right.

What is right is read from the table of `DATA/CATALOG.md`: columns kind, file, what an earlier version made of it, what is
right; a row may name several files. Files named overlap_* and touch_* are meshed a second time, united beforehand by
lab/inputs/united.py (the packages manifold3d and numpy): both meshes should be alike.
"""
import importlib.util
import re
import sys
from pathlib import Path

from measures import measures, reasons, surfaces, table
from pool import Job
from tables import models
from tables.models import mesh_job

PAGE = "field.md"
DATA = "field"
SECONDS = 1800
UNITED = Path(__file__).resolve().parent.parent / "inputs/united.py"
MOST = 1.2  # times the hexes of the united shape


def jobs(args):
    folders = [args.data, *(p for p in [args.data / "real"] if p.is_dir())]
    return [job(p, args.options) for folder in folders for p in surfaces(folder)]


def job(path, options):
    single = mesh_job(path, options)
    has_library = importlib.util.find_spec("manifold3d") is not None
    if not has_library or not re.match(r"(overlap|touch)_", path.name) or "reference" in path.name:
        return single
    mesh = [text.replace("{input}", "{out}/united.obj") for text in single.steps[0]]
    return Job(path.name, [*single.steps, [sys.executable, UNITED, "{input}", "{out}/united.obj"], mesh], path, others=[UNITED])


def read_catalog(path):
    """{file: (kind, what is right)} of the catalogue's table; an empty kind is the one above."""
    known, kind = {}, ""
    for line in path.read_text().splitlines() if path.exists() else []:
        cells = [c.strip() for c in line.strip().strip("|").split("|")]
        if not line.startswith("|") or len(cells) < 4 or set(cells[0]) == {"-"}:
            continue
        kind = cells[0] or kind
        for name in re.findall(r"\w[\w.]*\.(?:stl|obj|off|ply)\b", cells[1]):
            known[name] = (kind, cells[3])
    return known


def united(record):
    """Measures of the mesh of the united shape, where there is one."""
    steps = record["steps"]
    return measures({"model": record["model"], "steps": steps[2:]}) if len(steps) == 3 else None


def own(record):
    """Without what became of the united shape."""
    return {**record, "steps": record["steps"][:1]}


def stored(records):
    return models.stored(list(map(own, records)))


def problems(records):
    return [f"{r['model']}: exit {r['steps'][0]['exit']}" for r in records if r["steps"][0]["exit"] not in (0, 1, 3, 4)]


def beside_united(record):
    m, u = measures(own(record)), united(record)
    return ["", ""] if m is None or u is None else [f"{m.hexes / u.hexes:.2f}", f"{u.least:.2f} / {u.average:.2f} / {100 * u.distance:.2f}"]


def row(record, catalog):
    step, m = record["steps"][0], measures(own(record))
    kind, right = catalog.get(record["model"], ("", ""))
    head = [kind, record["model"], "-" if step["exit"] is None else step["exit"]]
    if m is None:
        figures = [""] * 6
    else:
        topology, surface = m.verdict["topology"], m.verdict.get("surface") or {}
        figures = [m.hexes, f"{m.least:.2f}", f"{m.average:.2f}", f"{100 * m.distance:.2f}", "-" if m.creases is None else f"{100 * m.creases:.1f}",
                   f"{topology['boundary_components']} / {topology['genus']} ({surface.get('components', '-')} / {surface.get('genus', '-')})"]
    said = "; ".join(reasons(own(record)))[:300]
    return head + figures + beside_united(record) + [f"{step['cpu_seconds']:.1f}", f"{step['peak_mib']:.0f}", right, said]


def summary(records):
    codes = [r["steps"][0]["exit"] for r in records]
    pairs = [(measures(own(r)), united(r)) for r in records if united(r) and measures(own(r))]
    alike = sum(m.hexes <= MOST * u.hexes and m.least >= u.least - 0.05 and m.average >= u.average - 0.02 for m, u in pairs)
    return (f"- exit code 0: {codes.count(0)} of {len(codes)}; 1: {codes.count(1)}; 3 (refused): {codes.count(3)}; stopped after {SECONDS} s: {codes.count(None)}\n"
            f"- at most {MOST} times the hexes of the shape united beforehand, the least scaled Jacobian within 0.05 and the average within 0.02 of its: "
            f"{alike} of {len(pairs)} files of parts that overlap or touch")


def page(records, args):
    catalog = read_catalog(args.data / "CATALOG.md")
    return (f"""# Field inputs

Made by `{args.command}`. Boundary components / genus of the mesh, the surface's in brackets; distances are shares of the diagonal in percent;
"times united" and "united": hexes over those of the shape united beforehand by `lab/inputs/united.py`, and the least and average scaled Jacobian and the
largest distance of that; "CPU s" counts all threads.

{summary(records)}

""" + table(["kind", "file", "exit", "hexes", "min SJ", "avg SJ", "max %", "features %", "components / genus", "times united", "united", "CPU s", "MiB",
             "what is right", "what was said"], "llrrrrrrlrlrrll", [row(r, catalog) for r in records]))
