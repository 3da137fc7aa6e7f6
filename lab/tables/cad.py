"""What `hexwright mesh` makes of the CAD files of a folder (docs/results/cad.md): names, edges, and how exact the boundary is."""
from measures import measures, reasons, table
from tables.models import mesh_job, stored  # noqa: F401

PAGE = "cad.md"
DATA = "cad"
CAD = {".step", ".stp", ".iges", ".igs", ".brep"}


def jobs(args):
    files = sorted((p for p in args.data.iterdir() if p.suffix.lower() in CAD), key=lambda p: p.name.lower())
    return [mesh_job(p, args.options) for p in files]


def row(record):
    step, m = record["steps"][-1], measures(record)
    head = [record["model"], "-" if step["exit"] is None else step["exit"]]
    if m is None:
        return head + [""] * 12 + [f"{step['cpu_seconds']:.1f}", "; ".join(reasons(record))]
    report = step["report"]
    cad, exact, features = report["cad"], report["exact_boundary"], m.verdict.get("features") or {}
    patches = len({f["patch"] for f in cad["faces"]})
    followed = "-" if m.creases is None else f"{100 * m.creases:.1f}"
    return head + [
        len(cad["solids"]), f"{len(cad['faces'])} ({cad['named_faces']})", patches, cad["sharp_edges"], followed,
        f"{features.get('corners_recovered', 0)} of {features.get('corners', 0)}",
        f"{100 * exact['exact'] / max(1, exact['vertices']):.1f}", f"{100 * exact['max_after']:.3f}",
        f"{100 * m.distance:.2f}", m.hexes, f"{m.least:.2f}", f"{m.average:.2f}", f"{step['cpu_seconds']:.1f}",
        "; ".join(reasons(record))]


def page(records, args):
    found = [m for m in map(measures, records) if m]
    exact = [r["steps"][-1]["report"]["exact_boundary"] for r in records if measures(r)]
    vertices, on_shape = sum(e["vertices"] for e in exact), sum(e["exact"] for e in exact)
    creases = [m.creases for m in found if m.creases is not None]
    return f"""# CAD files

Made by `{args.command}`, of the program built with `-DHEXWRIGHT_CAD=ON`. Distances are shares of the diagonal. *Faces*: in brackets those
that the file names. *Patches*: names on the mesh's boundary, of faces that meet smoothly together. *Followed*: the length of sharp edges, and of
borders between names, that mesh edges follow. *Exact*: boundary vertices on the CAD surface or curve, and how far the farthest of the others is
from where it belongs. *Max*: two-way distance of the whole boundary.

Valid: {sum(m.valid for m in found)} of {len(records)}. Edges followed: {100 * min(creases, default=0):.1f}% at least. Exact: {on_shape:,} of
{vertices:,} boundary vertices ({100 * on_shape / max(1, vertices):.1f}%).

""" + table(["file", "exit", "solids", "faces (named)", "patches", "sharp edges", "followed %", "corners met", "exact %", "off by %", "max %", "hexes",
             "min SJ", "avg SJ", "CPU s", "reason"], "lrrrrrrrrrrrrrrl", [row(r) for r in records])
