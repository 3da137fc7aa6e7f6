#!/usr/bin/env python3
"""What selective padding saves against a layer everywhere, as a Markdown table over the featured models of a folder.

Example: tools/padding_economy.py build/release/hexwright ../shared/data/models
         tools/padding_economy.py build/release/hexwright ../shared/data/models -- --rounds 0

The grid of a model is that of its result (`hexwright mesh --save-grid`, with the options after `--`); `--rounds 0` gives
the loop's first grid. Its hexes are fitted with either padding. A model counts as featured when its surface has feature
curves of which a tenth or more of the length is mapped.
"""
import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

SURFACES = {".obj", ".off", ".stl", ".ply"}
LEAST_MAPPED = 0.1
POORER = 0.02  # of the scaled Jacobian, from which a least one counts as lower


def run(args, *command):
    """Standard output; None when the time is up. Meshes that miss the tolerance count too."""
    try:
        return subprocess.run([str(args.binary), *map(str, command)], capture_output=True, text=True,
                              timeout=args.seconds).stdout
    except subprocess.TimeoutExpired:
        return None


def make_background(model, args, folder):
    """The dual of the grid that the model's result stands on; None when there is none or the model has no features."""
    grid, report, hexes = folder / "grid.cells", folder / "report.json", folder / "background.mesh"
    for path in (grid, report, hexes):
        path.unlink(missing_ok=True)
    run(args, "mesh", model, "-o", folder / "mesh.vtu", "--save-grid", grid, "--report", report, "--quiet",
        "--threads", 1, *args.options)
    if not report.exists() or not grid.exists() or not is_featured(json.loads(report.read_text())):
        return None
    run(args, "dual", grid, "-o", hexes, "--quiet")
    return hexes if hexes.exists() else None


def is_featured(report):
    fit = report["fit"]
    return fit["curve_length"] > 0 and fit["curve_length_mapped"] >= LEAST_MAPPED * fit["curve_length"]


def fit(background, model, padding, args, folder):
    """Figures of one fit; None when it gave no mesh."""
    mesh = folder / "fitted.vtu"
    mesh.unlink(missing_ok=True)
    run(args, "fit", background, model, "-o", mesh, "--padding", padding, "--quiet", "--threads", 1)
    if not mesh.exists():
        return None
    verdict = json.loads(run(args, "check", mesh, model, "--json"))
    quality, distance = verdict["quality"], verdict["distance"]
    return {"hexes": verdict["topology"]["hexes"], "min": quality["min_scaled_jacobian"],
            "avg": quality["avg_scaled_jacobian"], "max": 100 * distance["max"], "mean": 100 * distance["mean"],
            "share": 100 * verdict["features"]["length_share"]}


def saved(pair):
    return 1 - pair["selective"]["hexes"] / pair["everywhere"]["hexes"]


def row(name, pair):
    columns = [" / ".join(f"{pair[p][k]:{f}}" for p in ("selective", "everywhere")) for k, f in
               (("hexes", ","), ("min", ".2f"), ("avg", ".2f"), ("max", ".2f"), ("mean", ".4f"), ("share", ".1f"))]
    return f"| {name} | {columns[0]} | {100 * saved(pair):.0f}% | " + " | ".join(columns[1:]) + " |"


def summary(pairs):
    total = {p: sum(pair[p]["hexes"] for pair in pairs) for p in ("selective", "everywhere")}
    poorer = sum(pair["selective"]["min"] < pair["everywhere"]["min"] - POORER for pair in pairs)
    better = sum(pair["selective"]["min"] > pair["everywhere"]["min"] + POORER for pair in pairs)
    return (f"\n{len(pairs)} featured models: {total['selective']:,} hexes for {total['everywhere']:,}, "
            f"{100 * (1 - total['selective'] / total['everywhere']):.0f}% saved in all, "
            f"{100 * sum(map(saved, pairs)) / len(pairs):.0f}% in the mean; the least scaled Jacobian is lower by more than "
            f"{POORER} on {poorer}, higher on {better}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=Path)
    parser.add_argument("models", type=Path, help="folder of surfaces, or one surface")
    parser.add_argument("--seconds", type=float, default=900, help="time limit of a command")
    parser.add_argument("options", nargs="*", default=[], help="after --: options of `hexwright mesh`")
    args = parser.parse_args()
    models = sorted(m for m in args.models.iterdir() if m.suffix.lower() in SURFACES) if args.models.is_dir() else [args.models]
    pairs = []
    print("| model | hexes selective / everywhere | saved | least scaled Jacobian | average | max % | mean % | curves met % |")
    print("|---|--:|--:|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for model in models:
            background = make_background(model, args, folder)
            if not background:
                continue
            pair = {p: fit(background, model, p, args, folder) for p in ("selective", "everywhere")}
            if all(pair.values()):
                print(row(model.stem, pair), flush=True)
                pairs.append(pair)
    if not pairs:
        sys.exit("no featured model")
    print(summary(pairs))


if __name__ == "__main__":
    main()
