"""Adaptive against regular sampling of polycube maps: Figure 14 of Pitzalis et al. 2021 (docs/results/polycube.md).

DATA: folders with pairs X_object.mesh, X_polycube.mesh. For each pair adaptive runs, by the paper's criterion alone and with
the surface's distance, and the regular runs (every cell on one level) whose counts are nearest below and above each.
"""
from pathlib import Path

from measures import table
from pool import Job

ROOT = Path(__file__).resolve().parents[2]
PAGE = "polycube_pairs.md"
DATA = "polycube"
SECONDS = 900
ADAPTIVE = {
    "adaptive, stretch 5% alone": ["--max-stretch", "5%", "--ignore-distance"],
    "adaptive, stretch 4% alone": ["--max-stretch", "4%", "--ignore-distance"],
    "adaptive, stretch 12%, distance 0.3%": ["--max-stretch", "12%"],
    "adaptive, defaults (2%, 0.3%)": [],
    "adaptive, 25,000 hexes wanted": ["--cells", "25000"],
}
REGULAR = {f"regular, level {n}": ["--min-level", str(n), "--max-level", str(n), "--ignore-distance"] for n in range(1, 5)}
MOST_CELLS = "1000000"


def jobs(args):
    pairs = sorted(args.data.glob("*_object.mesh")) + sorted((ROOT / "data/polycube").glob("*_object.mesh"))
    return [job(p, kind, options) for p in pairs for kind, options in {**REGULAR, **ADAPTIVE}.items()]


def job(path, kind, options):
    other = path.with_name(path.name.replace("_object.mesh", "_polycube.mesh"))
    return Job(path.name.removesuffix("_object.mesh"), [["{program}", "polycube", "{input}", other, "-o", "{out}/out.vtu", "--report",
               "{out}/report.json", "--quiet", "--max-cells", MOST_CELLS, *options]], path, kind, [other])


def hexes(record):
    return sum(record["steps"][0]["report"]["verdict"]["quality"]["histogram"]["counts"])


def row(record):
    step = record["steps"][0]
    quality, distance = (step["report"]["verdict"][k] for k in ("quality", "distance"))
    worst = max(distance["max_to_mesh"], distance["max_to_surface"])
    return [record["model"], record["variant"], step["exit"], hexes(record), quality["inverted"], f"{quality['min_scaled_jacobian']:.2f}",
            f"{quality['avg_scaled_jacobian']:.2f}", f"{100 * worst:.3f}", f"{100 * distance['mean_to_mesh']:.4f}", f"{step['seconds']:.1f}"]


def rows_of_pair(records):
    """The adaptive runs, each followed by the nearest regular ones that are not shown yet. Runs of too many cells have none."""
    done = [r for r in records if r["steps"][0]["exit"] in (0, 1)]
    regular, shown = [r for r in done if r["variant"] in REGULAR], []
    for record in (r for r in done if r["variant"] in ADAPTIVE):
        yield row(record)
        below = [r for r in regular if hexes(r) <= hexes(record)][-1:]
        above = [r for r in regular if hexes(r) > hexes(record)][:1]
        yield from (row(r) for r in below + above if r not in shown)
        shown += below + above


def page(records, args):
    names = list(dict.fromkeys(r["model"] for r in records))
    rows = [row for name in names for row in rows_of_pair([r for r in records if r["model"] == name])]
    return (f"# Polycube maps: adaptive against regular sampling\n\nMade by `{args.command}`. Distances are shares of the object's diagonal "
            "(two-way maximum; mean from the surface to the mesh). Regular runs split every cell to one level; those nearest in count to the "
            "adaptive runs are shown, once.\n\n"
            + table(["map", "sampling", "exit", "hexes", "inverted", "min SJ", "avg SJ", "max %", "mean %", "s"], "llrrrrrrrr", rows))
