#!/usr/bin/env python3
"""examples/flow.py makes its three domains.

Usage: flow_example_test.py PROGRAM
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SIDES = {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"}


def patches(report):
    return {s["name"] for s in report["sets"] if s["kind"] == "patch"}


def main(program):
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([sys.executable, ROOT / "examples/flow.py", program, folder, "--coarse"], capture_output=True, text=True)
        print(done.stdout, done.stderr)
        assert done.returncode == 0, "a domain misses its gate"
        reports = {name: json.loads((Path(folder) / f"{name}.json").read_text()) for name in ("airfoil", "car", "junction")}
        for name, report in reports.items():
            assert report["valid"] and report["verdict"]["quality"]["inverted"] == 0, name
            assert (Path(folder) / f"{name}.png").stat().st_size > 10000, name
            distance = report["verdict"]["distance"]
            assert distance["max"] <= 2 * report["edges"]["tolerance_used"], (name, distance)
        assert patches(reports["airfoil"]) == SIDES | {"wing"}
        assert reports["airfoil"]["verdict"]["features"]["length_share"] > 0.9  # the trailing edge, from side to side
        assert patches(reports["car"]) >= SIDES and any("body" in p for p in patches(reports["car"]))
        assert patches(reports["junction"]) == {"wall", "inlet", "outlet", "branch"}
        assert reports["junction"]["layers"]["coverage"] >= 0.99


if __name__ == "__main__":
    main(sys.argv[1])
