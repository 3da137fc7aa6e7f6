#!/usr/bin/env python3
"""OpenFOAM's checkMesh, with all checks of topology, on meshes of the inside and of the outside of models.

Usage: check_mesh_test.py HEXWRIGHT FOLDER-OF-MODELS [OPTIONS OF MESH]. Exit code 77 (skipped) without checkMesh.
"""
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import openfoam

SKIPPED = 77
SURFACES = {".obj", ".off", ".stl", ".ply"}


def judge(hexwright: str, model: Path, side: str, options: list[str]) -> tuple[bool, str]:
    """Whether checkMesh is content, and its figures."""
    with tempfile.TemporaryDirectory() as folder:
        case = Path(folder)
        (case / "constant").mkdir()
        margin = ["--margin", "0.2L"] if side == "outside" else []
        subprocess.run([hexwright, "mesh", model, "-o", case / "constant/polyMesh", "-q", "--side", side, *margin, *options],
                       timeout=600, stderr=subprocess.DEVNULL)
        if not (case / "constant/polyMesh").exists():
            return False, "no mesh"
        said = openfoam.check_mesh(case, "-allTopology")
    found = {name: re.search(pattern, said) for name, pattern in
             {"cells": r"cells: +(\d+)", "non-orthogonality": r"non-orthogonality Max: ([0-9.]+)",
              "skewness": r"Max skewness = ([0-9.]+)"}.items()}
    figures = ", ".join(f"{name} {match[1]}" for name, match in found.items() if match)
    failures = "; ".join(line.strip(" *") for line in said.splitlines() if line.startswith(" ***"))
    return "\nMesh OK." in said, f"{figures} {failures}".strip()


def main() -> int:
    if not shutil.which("checkMesh"):
        print("skipped: OpenFOAM (checkMesh) is not installed")
        return SKIPPED
    models = sorted(p for p in Path(sys.argv[2]).iterdir() if p.suffix.lower() in SURFACES)
    assert models, f"no model in {sys.argv[2]}"
    failed = []
    for model in models:
        for side in ("inside", "outside"):
            is_good, figures = judge(sys.argv[1], model, side, sys.argv[3:])
            print(f"{model.name}, {side}: {figures}", flush=True)
            if not is_good:
                failed.append(f"{model.name}, {side}")
    print(f"{2 * len(models) - len(failed)} of {2 * len(models)} meshes pass")
    assert not failed, failed
    return 0


if __name__ == "__main__":
    sys.exit(main())
