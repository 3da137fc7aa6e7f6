"""Flow along named walls in OpenFOAM's simpleFoam, on meshes with wall layers."""
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from walls import openfoam


def run(arguments, usage, write_surface, options, write_case, read_mesh, compare):
    """Meshes the surface with the options and the rest of the arguments, which begin with the program, solves, and prints
    what compare(case, mesh) finds as JSON; {} where OpenFOAM is not installed."""
    if not arguments:
        sys.exit(usage)
    if not shutil.which("simpleFoam"):
        return print("{}")
    with tempfile.TemporaryDirectory() as folder:
        case = Path(folder)
        (case / "constant").mkdir()
        surface, poly_mesh = case / "surface.obj", case / "constant/polyMesh"
        write_surface(surface)
        subprocess.run([arguments[0], "mesh", surface, "-o", poly_mesh, "--quiet", *options, *arguments[1:]], check=True)
        mesh = read_mesh(poly_mesh)
        write_case(case, mesh)
        subprocess.run(["simpleFoam", "-case", case], check=True, capture_output=True, env=openfoam.environment())
        print(json.dumps(compare(case, mesh)))
