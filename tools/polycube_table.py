#!/usr/bin/env python3
"""Adaptive against regular sampling of polycube maps (the claim of Figure 14 of Pitzalis et al. 2021).

Usage: polycube_table.py HEXWRIGHT PAIRS_DIR OUT.md

For every pair X_object.mesh, X_polycube.mesh: an adaptive run at several values of --max-stretch, and the regular runs
(every cell on one level) whose element counts are nearest below and above.
"""
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

STRETCHES = ["12%", "6%", "4%"]
LEVELS = range(1, 6)


def run(program, stem, options, work):
    report = Path(work) / "report.json"
    command = [program, "polycube", f"{stem}_object.mesh", f"{stem}_polycube.mesh", "-o", str(Path(work) / "out.vtu"),
               "--report", str(report), "--quiet", *options]
    started = time.monotonic()
    status = subprocess.run(command, capture_output=True, text=True, timeout=300)
    if status.returncode not in (0, 1):
        sys.exit(f"{' '.join(command)}: {status.stderr}")
    result = json.loads(report.read_text())
    verdict = result["verdict"]
    return {"exit": status.returncode, "hexes": sum(verdict["quality"]["histogram"]["counts"]), "inverted": verdict["quality"]["inverted"],
            "min": verdict["quality"]["min_scaled_jacobian"], "avg": verdict["quality"]["avg_scaled_jacobian"],
            "to_mesh": verdict["distance"]["max_to_mesh"], "to_surface": verdict["distance"]["max_to_surface"],
            "mean": verdict["distance"]["mean_to_mesh"], "seconds": time.monotonic() - started,
            "bad_tets": result["polycube"]["nonpositive_tets_polycube"]}


def row(name, kind, r):
    worst = max(r["to_mesh"], r["to_surface"])
    return (f"| {name} | {kind} | {r['exit']} | {r['hexes']} | {r['inverted']} | {r['min']:.2f} | {r['avg']:.2f} | {100 * worst:.3f} | "
            f"{100 * r['mean']:.4f} | {r['seconds']:.1f} |")


def main():
    program, folder, out = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    lines = ["# Polycube maps: adaptive against regular sampling", "",
             "Made by `tools/polycube_table.py`. Distances are shares of the object's diagonal (two-way maximum; mean from the surface to "
             "the mesh). Regular runs split every cell to one level; those nearest in count to the adaptive runs are shown.", "",
             "| map | sampling | exit | hexes | inverted | min SJ | avg SJ | max % | mean % | s |",
             "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|"]
    with tempfile.TemporaryDirectory() as work:
        for path in sorted(folder.glob("*_object.mesh")):
            stem = str(path)[: -len("_object.mesh")]
            name = Path(stem).name
            regular = [(level, run(program, stem, ["--min-level", str(level), "--max-level", str(level)], work)) for level in LEVELS]
            shown = set()
            for stretch in STRETCHES:
                adaptive = run(program, stem, ["--max-stretch", stretch, "--max-level", "6"], work)
                lines.append(row(name, f"adaptive, {stretch}", adaptive))
                below = [r for r in regular if r[1]["hexes"] <= adaptive["hexes"]][-1:]
                above = [r for r in regular if r[1]["hexes"] > adaptive["hexes"]][:1]
                for level, r in below + above:
                    if level not in shown:
                        lines.append(row(name, f"regular, level {level}", r))
                    shown.add(level)
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
