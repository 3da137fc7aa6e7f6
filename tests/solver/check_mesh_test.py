#!/usr/bin/env python3
"""OpenFOAM's checkMesh, with all checks of topology, on meshes of the inside and of the outside of models.

Usage: check_mesh_test.py HEXWRIGHT FOLDER-OF-MODELS [OPTIONS OF MESH]. Exit code 77 (skipped) without checkMesh.
"""
import sys
import tempfile
from pathlib import Path

import openfoam
import support


def judge(hexwright: str, model: Path, side: str, options: list[str]) -> tuple[bool, str]:
    """Whether checkMesh is content, and its figures."""
    with tempfile.TemporaryDirectory() as folder:
        case = Path(folder)
        (case / "constant").mkdir()
        margin = ["--margin", "0.2L"] if side == "outside" else []
        try:
            support.make_mesh(hexwright, model, case / "constant/polyMesh", ["--side", side, *margin, *options], may_miss_gate=True)
        except AssertionError as error:
            return False, str(error)
        said = openfoam.check_mesh(case, "-allTopology")
    figures = ", ".join(f"{name} {value:g}" for name, value in openfoam.read_figures(said).items())
    return openfoam.is_content(said), f"{figures} {'; '.join(openfoam.list_failures(said))}".strip()


def main() -> int:
    if support.is_missing(programs=("checkMesh",)):
        return support.SKIPPED
    models = support.list_models(sys.argv[2])
    failed = []
    for model in models:
        for side in ("inside", "outside"):
            is_good, figures = judge(sys.argv[1], model, side, sys.argv[3:])
            print(f"{model.name}, {side}: {figures}", flush=True)
            if not is_good:
                failed.append(f"{model.name}, {side}")
    support.report(failed, 2 * len(models))
    return 0


if __name__ == "__main__":
    sys.exit(main())
