#!/usr/bin/env python3
"""Adaptive against regular sampling of polycube maps (the claim of Figure 14 of Pitzalis et al. 2021).

Usage: polycube_table.py HEXWRIGHT OUT.md PAIRS_DIR...

For every pair X_object.mesh, X_polycube.mesh: adaptive runs, by the paper's criterion alone and together with the surface's
distance, and the regular runs (every cell on one level) whose element counts are nearest below and above each.
"""
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ADAPTIVE = [
    ("adaptive, stretch 10% alone", ["--max-stretch", "10%", "--ignore-distance"]),
    ("adaptive, stretch 8% alone", ["--max-stretch", "8%", "--ignore-distance"]),
    ("adaptive, stretch 12%, distance 0.3%", ["--max-stretch", "12%"]),
    ("adaptive, defaults (2%, 0.3%)", []),
]
LEVELS = range(1, 6)
MOST_CELLS = "1000000"


def run(program, stem, options, work):
    report = Path(work) / "report.json"
    command = [program, "polycube", f"{stem}_object.mesh", f"{stem}_polycube.mesh", "-o", str(Path(work) / "out.vtu"),
               "--report", str(report), "--quiet", "--max-cells", MOST_CELLS, *options]
    started = time.monotonic()
    status = subprocess.run(command, capture_output=True, text=True, timeout=900)
    if status.returncode == 4:
        return None  # more cells than that
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


def rows_of_pair(program, stem, work):
    name = Path(stem).name
    regular = [(level, run(program, stem, ["--min-level", str(level), "--max-level", str(level), "--ignore-distance"], work))
               for level in LEVELS]
    regular = [(level, r) for level, r in regular if r]
    shown, lines = set(), []
    for kind, options in ADAPTIVE:
        adaptive = run(program, stem, options, work)
        if not adaptive:
            continue
        lines.append(row(name, kind, adaptive))
        below = [r for r in regular if r[1]["hexes"] <= adaptive["hexes"]][-1:]
        above = [r for r in regular if r[1]["hexes"] > adaptive["hexes"]][:1]
        lines += [row(name, f"regular, level {level}", r) for level, r in below + above if level not in shown]
        shown.update(level for level, _ in below + above)
    return lines


def main():
    program, out = sys.argv[1], Path(sys.argv[2])
    lines = ["# Polycube maps: adaptive against regular sampling", "",
             "Made by `tools/polycube_table.py`. Distances are shares of the object's diagonal (two-way maximum; mean from the surface to "
             "the mesh). Regular runs split every cell to one level; those nearest in count to the adaptive runs are shown, once.", "",
             "| map | sampling | exit | hexes | inverted | min SJ | avg SJ | max % | mean % | s |",
             "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|"]
    with tempfile.TemporaryDirectory() as work:
        for folder in sys.argv[3:]:
            for path in sorted(Path(folder).glob("*_object.mesh")):
                lines += rows_of_pair(program, str(path)[: -len("_object.mesh")], work)
                out.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
