#!/usr/bin/env python3
"""What selective padding saves against a layer everywhere, as a Markdown table over the featured models of a folder.

Example: tools/padding_economy.py build/release/hexwright ../shared/data/models

Both meshes of a model start from the same grid, the first of the loop (--rounds 0), unless other
options follow `--`. A model counts as featured when its surface has feature curves of which a tenth
or more of the length is mapped.
"""
import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

SURFACES = {".obj", ".off", ".stl", ".ply"}
LEAST_MAPPED = 0.1


def mesh(model, padding, args, folder):
    """The report of one run; None when it gave no mesh."""
    report = Path(folder) / "report.json"
    report.unlink(missing_ok=True)
    command = [str(args.binary), "mesh", str(model), "-o", str(Path(folder) / "mesh.vtu"), "--report", str(report),
               "--quiet", "--threads", "1", "--padding", padding, *args.options]
    try:
        subprocess.run(command, capture_output=True, timeout=args.seconds)
    except subprocess.TimeoutExpired:
        return None
    result = json.loads(report.read_text()) if report.exists() else None
    return result if result and result.get("hexes") else None


def is_featured(report):
    fit = report["fit"]
    return fit["curve_length"] > 0 and fit["curve_length_mapped"] >= LEAST_MAPPED * fit["curve_length"]


def figures(report):
    quality, distance = report["verdict"]["quality"], report["verdict"]["distance"]
    return {"hexes": report["hexes"], "min": quality["min_scaled_jacobian"], "avg": quality["avg_scaled_jacobian"],
            "max": 100 * distance["max"], "mean": 100 * distance["mean"]}


def row(name, selective, everywhere):
    saved = 100 * (1 - selective["hexes"] / everywhere["hexes"])
    both = [f"{selective[k]:{f}} / {everywhere[k]:{f}}" for k, f in
            (("hexes", ","), ("min", ".2f"), ("avg", ".2f"), ("max", ".2f"), ("mean", ".4f"))]
    return f"| {name} | {both[0]} | {saved:.0f}% | " + " | ".join(both[1:]) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=Path)
    parser.add_argument("models", type=Path, help="folder of surfaces, or one surface")
    parser.add_argument("--seconds", type=float, default=120, help="time limit of a run")
    parser.add_argument("options", nargs="*", default=[], help="after --: options of `hexwright mesh`")
    args = parser.parse_args()
    args.options = args.options or ["--rounds", "0"]
    models = sorted(m for m in args.models.iterdir() if m.suffix.lower() in SURFACES) if args.models.is_dir() else [args.models]
    total = {"selective": 0, "everywhere": 0}
    savings, poorer = [], 0
    print("| model | hexes selective / everywhere | saved | least scaled Jacobian | average | max % | mean % |")
    print("|---|--:|--:|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for model in models:
            reports = {"selective": mesh(model, "selective", args, folder)}
            if not reports["selective"] or not is_featured(reports["selective"]):
                continue
            reports["everywhere"] = mesh(model, "everywhere", args, folder)
            if not reports["everywhere"]:
                continue
            pair = {k: figures(r) for k, r in reports.items()}
            print(row(model.stem, pair["selective"], pair["everywhere"]), flush=True)
            for k in total:
                total[k] += pair[k]["hexes"]
            savings.append(1 - pair["selective"]["hexes"] / pair["everywhere"]["hexes"])
            poorer += pair["selective"]["min"] < pair["everywhere"]["min"] - 0.02
    if not savings:
        sys.exit("no featured model")
    print(f"\n{len(savings)} featured models: {total['selective']:,} hexes for {total['everywhere']:,}, "
          f"{100 * (1 - total['selective'] / total['everywhere']):.0f}% saved in all, {100 * sum(savings) / len(savings):.0f}% "
          f"in the mean; the least scaled Jacobian is lower by more than 0.02 on {poorer}")


if __name__ == "__main__":
    main()
