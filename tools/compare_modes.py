#!/usr/bin/env python3
"""Meshes some models with each kind of pairing and writes a Markdown table of the fitted meshes.

Example: tools/compare_modes.py build/release/hexwright ../shared/data/models -o docs/results/modes.md

The evidence for which pairing is the default: same surface, same gates, other grid. Results are kept in a work folder
(--fresh starts over).
"""
import argparse
import sys
from pathlib import Path
from types import SimpleNamespace

import run_corpus

MODES = {"blocks": ["--pairing", "blocks"], "sheets": ["--pairing", "sheets"],
         "sheets, weak": ["--pairing", "sheets", "--balance", "weak"]}
MODELS = ["3holes.obj", "airplane1.obj", "anchor.off", "bone.obj", "chair1.obj", "cube_minus_sphere.obj", "fandisk.off", "hand.obj",
          "hull-body.obj", "joint.off", "kitten.obj", "knot2.off", "pinion.off", "plate_holes.STL", "spot_low_resolution.obj",
          "wrench.obj"]


def run_mode(model, mode, args):
    work = args.work / mode.replace(", ", "_")
    work.mkdir(parents=True, exist_ok=True)
    return run_corpus.mesh_model(model, SimpleNamespace(
        binary=args.binary, work=work, fresh=args.fresh, keep=False, seconds=args.seconds, memory=args.memory,
        options=MODES[mode]))


def measures(result):
    """Exit code, hexes, background hexes, min and average scaled Jacobian, distances, refinements, seconds; None when missing."""
    report = result.get("report")
    if not report or not report.get("hexes"):
        return None
    verdict = report["verdict"]
    quality = verdict["quality"]
    return SimpleNamespace(
        hexes=report["hexes"], background=report["rounds"][report["best_round"]].get("background_hexes", 0),
        least=quality["min_scaled_jacobian"], mean=quality["avg_scaled_jacobian"],
        distance=100 * run_corpus.distance(verdict)[0], mean_distance=100 * run_corpus.distance(verdict)[1],
        rounds=len(report["rounds"]) - 1, seconds=result["cpu_seconds"])


def row(model, mode, result):
    exit_code = "-" if result["exit"] is None else result["exit"]
    m = measures(result)
    if m is None:
        return f"| {model} | {mode} | {exit_code} | | | | | | | {result['cpu_seconds']:.1f} |"
    return (f"| {model} | {mode} | {exit_code} | {m.hexes} | {m.least:.2f} | {m.mean:.3f} | {m.distance:.2f} | "
            f"{m.mean_distance:.3f} | {m.rounds} | {m.seconds:.1f} |")


def summary_row(mode, results, reference):
    """Means over the models that blocks and this mode both meshed."""
    both = [(measures(r), measures(b)) for r, b in zip(results, reference) if measures(r) and measures(b)]
    n = max(1, len(both))
    ratio = sum(r.hexes / b.hexes for r, b in both) / n
    time = sum(r.seconds for r, _ in both) / max(1e-9, sum(b.seconds for _, b in both))
    return (f"| {mode} | {sum(r['exit'] == 0 for r in results)} of {len(results)} | {sum(run_corpus.is_valid(r) for r in results)} | "
            f"{ratio:.2f} | {min((r.least for r, _ in both), default=0):.2f} | {sum(r.least for r, _ in both) / n:.2f} | "
            f"{sum(r.mean for r, _ in both) / n:.3f} | {sum(r.distance for r, _ in both) / n:.2f} | {time:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=Path)
    parser.add_argument("models", type=Path)
    parser.add_argument("-o", "--output", type=Path, default=Path("docs/results/modes.md"))
    parser.add_argument("--work", type=Path, default=Path("build/modes"), help="folder for reports")
    parser.add_argument("--seconds", type=float, default=120)
    parser.add_argument("--memory", type=int, default=4096, help="MiB")
    parser.add_argument("--only", nargs="*", default=MODELS, help="model names")
    parser.add_argument("--modes", nargs="*", default=list(MODES), choices=MODES)
    parser.add_argument("--fresh", action="store_true")
    args = parser.parse_args()
    results = {mode: [] for mode in args.modes}
    rows = []
    for name in args.only:
        for mode in args.modes:
            result = run_mode(args.models / name, mode, args)
            results[mode].append(result)
            rows.append(row(name, mode, result))
            print(rows[-1], flush=True)
    summary = [summary_row(mode, results[mode], results[args.modes[0]]) for mode in args.modes]
    args.output.write_text(f"""# Fitted meshes by pairing

Made by `tools/compare_modes.py` over {len(args.only)} models, one at a time on a shared machine: seconds (of all threads) are rough.
"sheets" has its default balance, relaxed. Distances are shares of the bounding box's diagonal; "valid" as in [models](models.md);
the means are over models meshed by {args.modes[0]} too; hexes and seconds are relative to it.

| pairing | exit 0 | valid | hexes | least min SJ | mean min SJ | mean avg SJ | mean max % | seconds |
|---|--:|--:|--:|--:|--:|--:|--:|--:|
""" + "\n".join(summary) + """

| model | pairing | exit | hexes | min SJ | avg SJ | max % | mean % | refinements | CPU s |
|---|---|--:|--:|--:|--:|--:|--:|--:|--:|
""" + "\n".join(rows) + "\n")
    print("\n".join(summary))
    return 0


if __name__ == "__main__":
    sys.exit(main())
