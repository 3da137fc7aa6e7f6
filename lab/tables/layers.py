"""Wall layers: their heights on shapes with a formula, and their coverage outside of the models (docs/results/layers.md).

Shapes get 8 layers, the first a twentieth of the wall's edges high, each 1.2 times the one before; the models 5. On the shapes
OpenFOAM's checkMesh is asked too, where it is installed.
"""
import sys
from pathlib import Path

from measures import measures, reasons, surfaces, table
from pool import Job

ROOT = Path(__file__).resolve().parents[2]
WALLS, FLOW, PLATE = (str(ROOT / "lab/inputs" / name) for name in ("walls.py", "poiseuille.py", "blasius.py"))
PAGE = "layers.md"
DATA = "models"
SECONDS = 900
EIGHT, FIVE = "first:0.05h,growth:1.2,count:8", "first:0.05h,growth:1.2,count:5"
SHAPES = {  # options, and which patches are walls
    "plate": (["--min-level", "4"], "wall"),
    "channel": (["--min-level", "4"], "wall"),
    "inner edge": (["--min-level", "4"], "wall"),
    "outer edge": (["--min-level", "4"], "wall"),
    "pipe": (["--min-level", "4"], "wall"),
    "T-junction": (["--min-level", "4"], "wall"),
    "sphere, inside": (["--min-level", "4"], "*"),
    "sphere, outside": (["--min-level", "5", "--side", "outside"], "*"),
    # With room around: the cube that is taken by itself ends 2% beyond the shape, where layers have no place.
    "wing, outside": (["--min-level", "5", "--side", "outside", "--margin", "0.5L"], "*"),
    "edge of 20 degrees, outside": (["--min-level", "5", "--side", "outside", "--margin", "0.5L"], "*"),
}


def jobs(args):
    flows = [Job("Poiseuille", [[sys.executable, FLOW, "{program}", "--min-level", str(level)]], Path(FLOW), f"level {level}")
             for level in (4, 5)]
    flows += [Job("Blasius", [[sys.executable, PLATE, "{program}", "--size", size]], Path(PLATE), f"edges of {size}")
              for size in ("0.05", "0.025")]
    return [shape_job(*item) for item in SHAPES.items()] + flows + [model_job(p, args.options) for p in surfaces(args.data)]


def shape_job(shape, how):
    options, wall = how
    return Job(shape, [
        [sys.executable, WALLS, "make", shape, "{out}/shape.obj"],
        ["{program}", "mesh", "{out}/shape.obj", "-o", "{out}/mesh.mesh", "--report", "{out}/kept.json", "--quiet", "--layers",
         f"{wall}={EIGHT}", *options],
        [sys.executable, WALLS, "measure", shape, "{out}/mesh.mesh", "{out}/kept.json", "{program}"]], Path(WALLS), "shape")


def model_job(path, options):
    return Job(path.name, [["{program}", "mesh", "{input}", "-o", "{out}/mesh.vtu", "--report", "{out}/report.json", "--quiet", "--side",
                            "outside", "--layers", f"*={FIVE}", *options]], path, "outside")


def mean(patches, key):
    return sum(p["area"] * p[key] for p in patches) / (sum(p["area"] for p in patches) or 1)


def shape_row(record):
    report = record["steps"][-1].get("report")
    if not report or "mesh" not in report:
        return [record["model"], "failed"] + [""] * 7
    mesh, check = report["mesh"], report["check_mesh"]
    off = max(abs(r - 1) for r in report["ratios"])
    angles = ["-"] * 3 if check is None else ["yes" if check["ok"] else "no", f"{check['non_orthogonality']:.0f}", f"{check['skewness']:.1f}"]
    return [record["model"], mesh["hexes"], f"{100 * mesh['coverage']:.1f}", f"{100 * off:.1f}", f"{mesh['least']:.2f}", mesh["inverted"], *angles]


def seconds(report, *names):
    return sum(s["seconds"] for s in report["stages"] if s["name"] in names)


def reduced(patches):
    total = {}
    for p in patches:
        for reason, share in p["reduced"].items():
            total[reason] = total.get(reason, 0) + share * p["area"]
    area = sum(p["area"] for p in patches) or 1
    return ", ".join(f"{reason} {100 * share / area:.1f}" for reason, share in total.items() if share / area >= 0.0005)


def model_row(record):
    step, m = record["steps"][-1], measures(record)
    if m is None or not step["report"]["layers"]["patches"]:
        return [record["model"], "-" if step["exit"] is None else step["exit"]] + [""] * 8 + ["; ".join(reasons(record))]
    report = step["report"]
    patches = report["layers"]["patches"]
    fit = seconds(report, "fit", "lift")
    before = report["rounds"][report["best_round"]]["min_scaled_jacobian"]
    return [record["model"], step["exit"], m.hexes, f"{100 * report['layers']['coverage']:.1f}", f"{100 * mean(patches, 'mean_thickness'):.1f}",
            reduced(patches), f"{before:.2f}", f"{m.least:.2f}", report["verdict"]["quality"]["inverted"],
            f"{seconds(report, 'layers') / max(fit, 1e-9):.2f}", "; ".join(reasons(record))]


def flow_row(record):
    report = record["steps"][-1].get("report")
    if not report:
        return [record["variant"], "no OpenFOAM", "", ""]
    return [record["variant"], report["cells"], f"{100 * report['velocity_off']:.2f}", f"{100 * report['gradient_off']:+.2f}"]


def plate_row(record):
    report = record["steps"][-1].get("report")
    if not report:
        return [record["variant"], "no OpenFOAM", "", ""]
    return [record["variant"], report["cells"], f"{100 * report['velocity_off']:.2f}", f"{100 * report['friction_off']:.2f}"]


def summary(records):
    done = [r["steps"][-1]["report"] for r in records if measures(r) and r["steps"][-1]["report"]["layers"]["patches"]]
    shares = sorted(r["layers"]["coverage"] for r in done)
    if not shares:
        return ""
    ratio = [seconds(r, "layers") / max(1e-9, seconds(r, "fit", "lift")) for r in done]
    return (f"{len(done)} of {len(records)} models have layers; coverage at least 99%: {sum(s >= 0.99 for s in shares)}, at least 90%: "
            f"{sum(s >= 0.9 for s in shares)}, median {100 * shares[len(shares) // 2]:.1f}%, least {100 * shares[0]:.1f}%; inverted hexes: "
            f"{sum(r['verdict']['quality']['inverted'] for r in done)}; least scaled Jacobian at least 0.2: "
            f"{sum(r['verdict']['quality']['min_scaled_jacobian'] >= 0.2 for r in done)}; seconds over those of the fit: median "
            f"{sorted(ratio)[len(ratio) // 2]:.2f}, largest {max(ratio):.2f}.")


def page(records, args):
    shapes, models = ([r for r in records if r["variant"] == v] for v in ("shape", "outside"))
    flows, plates = ([r for r in records if r["model"] == m] for m in ("Poiseuille", "Blasius"))
    return (f"# Wall layers\n\nMade by `{args.command}`. First layer: a twentieth of the wall's edges; growth 1.2. Covered: all layers, each at "
            "least half as high as asked for.\n\n## Shapes, 8 layers\n\nHeights by the shape's exact distance: the largest deviation, over the "
            "layers, of the median height from the one asked for. The last three columns are those of OpenFOAM's `checkMesh` (mesh OK; largest "
            "non-orthogonality in degrees; skewness).\n\n"
            + table(["shape", "hexes", "covered %", "height off %", "min SJ", "inverted", "OK", "non-orth.", "skewness"], "lrrrrrlrr",
                    map(shape_row, shapes))
            + "\n## Laminar flow between two plates\n\nThe channel with `--min-level` 4 and 5, in OpenFOAM's simpleFoam: largest error of the "
            "velocity over its largest value, and error of the pressure gradient, over the middle half of the channel.\n\n"
            + table(["mesh", "cells", "velocity off %", "gradient off %"], "lrrr", map(flow_row, flows))
            + "\n## Laminar flow along a plate\n\n16 layers of growth 1.2 along a plate of length 2, the first 0.001 high, in simpleFoam at a Reynolds "
            "number of 20,000: largest error of the velocity over that of the stream, and of the friction over Blasius' own, 0.5 to 1.5 behind "
            "the plate's edge.\n\n"
            + table(["mesh", "cells", "velocity off %", "friction off %"], "lrrr", map(plate_row, plates))
            + f"\n## Outside of the models, 5 layers\n\n{summary(models)}\n\n\"height %\" is the mean over the wish; \"lower\" the share of the "
            "area that is lower by more than 5%, by reason; \"time\" the seconds of the layers over those of the best round's fit.\n\n"
            + table(["model", "exit", "hexes", "covered %", "height %", "lower %", "min SJ before", "min SJ", "inverted", "time", "reason"],
                    "lrrrrlrrrrl", map(model_row, models)))


def problems(records):
    for r in records:
        if any(step["exit"] not in (0, 1) for step in r["steps"]):
            yield f"{r['model']}: exit {r['steps'][-1]['exit']}"
