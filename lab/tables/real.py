"""Inputs as people bring them, in kinds that are hard (`DATA/*` and `DATA/real/*`), each beside what is right.

What is right is read from the table of `DATA/CATALOG.md`: columns kind, file, what an earlier version made of it, what is
right; a row may name several files.
"""
import re

from measures import measures, reasons, surfaces, table
from tables.models import mesh_job, stored  # noqa: F401

PAGE = "real.md"
DATA = "field"


def jobs(args):
    folders = [args.data, *(p for p in [args.data / "real"] if p.is_dir())]
    return [mesh_job(p, args.options) for folder in folders for p in surfaces(folder)]


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


def row(record, catalog):
    step, m = record["steps"][-1], measures(record)
    kind, right = catalog.get(record["model"], ("", ""))
    head = [kind, record["model"], "-" if step["exit"] is None else step["exit"]]
    if m is None:
        figures = [""] * 6
    else:
        topology, surface = m.verdict["topology"], m.verdict.get("surface") or {}
        figures = [m.hexes, f"{m.least:.2f}", f"{m.average:.2f}", f"{100 * m.distance:.2f}", "-" if m.creases is None else f"{100 * m.creases:.1f}",
                   f"{topology['boundary_components']} / {topology['genus']} ({surface.get('components', '-')} / {surface.get('genus', '-')})"]
    return head + figures + [f"{step['cpu_seconds']:.1f}", f"{step['peak_mib']:.0f}", right, "; ".join(reasons(record))[:300]]


def page(records, args):
    catalog = read_catalog(args.data / "CATALOG.md")
    codes = [r["steps"][-1]["exit"] for r in records]
    return (f"""# Field inputs

Made by `{args.command}`. Boundary components / genus of the mesh, the surface's in brackets; distances are shares of the diagonal.
Exit code 0: {codes.count(0)} of {len(codes)}; 1: {codes.count(1)}; 3: {codes.count(3)}; stopped: {codes.count(None)}.

""" + table(["kind", "file", "exit", "hexes", "min SJ", "avg SJ", "max %", "features %", "components / genus", "CPU s", "MiB", "what is right",
             "what was said"], "llrrrrrrlrrll", [row(r, catalog) for r in records]))
