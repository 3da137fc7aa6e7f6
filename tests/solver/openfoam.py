"""Runs programs of OpenFOAM on a case whose mesh hexwright wrote."""
import os
import re
import subprocess
from pathlib import Path

HEADER = "FoamFile {{ version 2.0; format ascii; class dictionary; object {}; }}\n"
DICTIONARIES = {
    "controlDict": "application checkMesh; startFrom startTime; startTime 0; stopAt endTime; endTime 1;\n"
                   "deltaT 1; writeControl timeStep; writeInterval 1;\n",
    "fvSchemes": "ddtSchemes {} gradSchemes {} divSchemes {}\nlaplacianSchemes {} interpolationSchemes {} snGradSchemes {}\n",
    "fvSolution": "",
}


def environment():
    """Debian's package is where it is when nobody says otherwise."""
    return {**os.environ, "WM_PROJECT_DIR": os.environ.get("WM_PROJECT_DIR") or "/usr/share/openfoam"}


def check_mesh(case: Path, *options: str) -> str:
    """What checkMesh says of case/constant/polyMesh."""
    (case / "system").mkdir(parents=True, exist_ok=True)
    for name, text in DICTIONARIES.items():
        (case / "system" / name).write_text(HEADER.format(name) + text)
    run = subprocess.run(["checkMesh", "-case", str(case), *options], capture_output=True, text=True,
                         env=environment(), check=False)
    return run.stdout + run.stderr


FIGURES = {"cells": r"cells: +(\d+)", "non-orthogonality": r"non-orthogonality Max: ([0-9.e+-]+)",
           "mean non-orthogonality": r"non-orthogonality Max: [0-9.e+-]+ average: ([0-9.e+-]+)",
           "skewness": r"Max skewness = ([0-9.e+-]+)"}


def read_figures(said: str) -> dict[str, float]:
    """Those that checkMesh gives."""
    found = {name: re.search(pattern, said) for name, pattern in FIGURES.items()}
    return {name: float(match[1]) for name, match in found.items() if match}


def is_content(said: str) -> bool:
    return "\nMesh OK." in said


def list_failures(said: str) -> list[str]:
    return [line.strip(" *") for line in said.splitlines() if line.startswith(" ***")]
