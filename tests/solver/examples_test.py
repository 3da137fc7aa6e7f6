#!/usr/bin/env python3
"""Runs the commands that an example's README shows, and looks at what they leave.

Usage: examples_test.py HEXWRIGHT SOURCE_DIR EXAMPLE. Exit code 77 (skipped) when what the example needs is not installed.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import openfoam
import support

#: Modules and programs; the picture; what is printed, and between which values the number in it lies. Of the flow about a
#: sphere it is the largest error of the pressure, in percent.
EXAMPLES = {
    "calculix": (["numpy", "matplotlib"], ["ccx"], "bracket.png", r"von Mises stress ([0-9.]+)", (95, 125)),
    "scikit-fem": (["skfem", "meshio", "matplotlib"], [], "heat.png", r"heat flow ([0-9.]+)", (714, 715)),
    "mfem": (["mfem", "numpy", "matplotlib"], [], "bracket.png", r"von Mises stress ([0-9.]+)", (90, 115)),
    "openfoam": (["numpy", "matplotlib"], ["checkMesh", "potentialFoam", "postProcess"], "sphere.png",
                 r"(?s)Mesh OK.*largest error ([0-9.]+) %", (0, 3)),
}


def main() -> int:
    hexwright, source, name = sys.argv[1], Path(sys.argv[2]), sys.argv[3]
    modules, programs, picture, pattern, (low, high) = EXAMPLES[name]
    if support.is_missing(modules, programs):
        return support.SKIPPED
    with tempfile.TemporaryDirectory() as temporary:
        examples, tools = Path(temporary) / "examples", Path(temporary) / "bin"
        tools.mkdir()
        (tools / "hexwright").symlink_to(Path(hexwright).resolve())
        # A link to an interpreter of a virtual environment would leave its packages behind.
        (tools / "python3").write_text(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n')
        (tools / "python3").chmod(0o755)
        environment = openfoam.environment()
        environment["PATH"] = os.pathsep.join([str(tools), environment["PATH"]])
        shutil.copytree(source / "examples", examples)
        commands = re.search(r"```\n(.*?)```", (examples / name / "README.md").read_text(), re.S)[1].splitlines()
        output = ""
        for command in commands:
            done = subprocess.run(["bash", "-c", command], cwd=examples / name, env=environment, capture_output=True, text=True,
                                  timeout=300)
            assert done.returncode == 0, f"{command}\n{done.stdout[-3000:]}{done.stderr[-3000:]}"
            output += done.stdout
        value = float(re.search(pattern, output)[1])
        assert (examples / name / picture).stat().st_size > 10000
    print(f"{name}: {value}")
    assert low < value < high, output
    return 0


if __name__ == "__main__":
    sys.exit(main())
