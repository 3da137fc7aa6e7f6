#!/usr/bin/env python3
"""Laminar flow between two plates in OpenFOAM, on a mesh with wall layers, beside the exact solution.

Usage: poiseuille.py PROGRAM OPTION...

Meshes the channel of walls.py (plates 2 apart, 4 long) with 8 layers along the plates and the further options of
`hexwright mesh`, lets the parabola of mean velocity 1 in and runs simpleFoam. Prints one JSON object: cells; the largest error
of the velocity over its largest value, and the relative error of the pressure gradient, both over the middle half of the
channel. {} where OpenFOAM is not installed.
"""
import re
import sys
from pathlib import Path

import simple_foam
import walls

NU, GAP = 0.1, 2.0
LAYERS = "wall=first:0.05h,growth:1.2,count:8"
SCHEMES = """ddtSchemes { default steadyState; }
gradSchemes { default Gauss linear; }
divSchemes { default none; div(phi,U) bounded Gauss linear; div((nuEff*dev2(T(grad(U))))) Gauss linear; }
laplacianSchemes { default Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes { default corrected; }
"""
SOLUTION = """solvers
{
    p { solver PCG; preconditioner DIC; tolerance 1e-10; relTol 0.01; }
    U { solver PBiCGStab; preconditioner DILU; tolerance 1e-10; relTol 0.01; }
}
SIMPLE { nNonOrthogonalCorrectors 1; consistent yes; residualControl { p 1e-7; U 1e-7; } }
relaxationFactors { equations { U 0.9; } fields { p 0.9; } }
"""
CONTROL = """application simpleFoam; startFrom startTime; startTime 0; stopAt endTime; endTime 400; deltaT 1;
writeControl timeStep; writeInterval 400; writePrecision 10;
"""
NUMBER = r"[-+0-9.e]+"
TRIPLE = re.compile(rf"\(\s*({NUMBER})\s+({NUMBER})\s+({NUMBER})\s*\)")


def body(path):
    """A file of OpenFOAM without comments and head."""
    text = re.sub(r"/\*.*?\*/|//[^\n]*", "", Path(path).read_text(), flags=re.S)
    return text[text.index("}") + 1:]


def vectors(text):
    return [tuple(map(float, m)) for m in TRIPLE.findall(text)]


def cell_labels(path):
    text = body(path)
    return list(map(int, text[text.index("(") + 1:text.rindex(")")].split()))


class Mesh:
    def __init__(self, folder):
        self.points = vectors(body(folder / "points"))
        self.faces = [list(map(int, m.split())) for m in re.findall(r"(?<!\d)4\(([\d\s]+)\)", body(folder / "faces"))]
        owner, neighbour = cell_labels(folder / "owner"), cell_labels(folder / "neighbour")
        self.patches = {m[0]: (int(m[1]), int(m[2])) for m in
                        re.findall(r"([\w.]+)\s*\{[^}]*?nFaces\s+(\d+);[^}]*?startFace\s+(\d+);", body(folder / "boundary"))}
        corners = [set() for _ in range(max(owner + neighbour) + 1)]
        for face, cell in list(zip(self.faces, owner)) + list(zip(self.faces, neighbour)):
            corners[cell].update(face)
        self.centers = [tuple(sum(self.points[i][k] for i in c) / len(c) for k in range(3)) for c in corners]


def velocity(y):
    return 1.5 * (1 - (y - 1) ** 2)


def inlet_value(mesh, face):
    """Mean of the parabola over a face's extent across the plates."""
    low, high = (f(mesh.points[i][1] for i in face) - 1 for f in (min, max))
    return 1.5 * (1 - (high**3 - low**3) / (3 * (high - low)))


def write(case, name, kind, text):
    path = case / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"FoamFile\n{{\n version 2.0;\n format ascii;\n class {kind};\n object {path.name};\n}}\n{text}")


def write_fields(case, mesh):
    count, start = mesh.patches["inlet"]
    given = " ".join(f"({inlet_value(mesh, f):.10g} 0 0)" for f in mesh.faces[start:start + count])
    plates = [name for name in mesh.patches if name.startswith("wall")]
    sides = [name for name in mesh.patches if name not in ("inlet", "outlet", *plates)]

    def patches(inlet, outlet, plate):
        rows = {"inlet": inlet, "outlet": outlet, **dict.fromkeys(plates, plate), **dict.fromkeys(sides, "type slip;")}
        return "boundaryField\n{\n" + "".join(f' "{name}" {{ {text} }}\n' for name, text in rows.items()) + "}\n"
    write(case, "0/U", "volVectorField", "dimensions [0 1 -1 0 0 0 0];\ninternalField uniform (1 0 0);\n" + patches(
        f"type fixedValue; value nonuniform List<vector> {count} ({given});", "type zeroGradient;", "type noSlip;"))
    write(case, "0/p", "volScalarField", "dimensions [0 2 -2 0 0 0 0];\ninternalField uniform 0;\n" + patches(
        "type zeroGradient;", "type fixedValue; value uniform 0;", "type zeroGradient;"))
    write(case, "constant/transportProperties", "dictionary", f"transportModel Newtonian;\nnu [0 2 -1 0 0 0 0] {NU};\n")
    write(case, "constant/turbulenceProperties", "dictionary", "simulationType laminar;\n")
    write(case, "system/fvSchemes", "dictionary", SCHEMES)
    write(case, "system/fvSolution", "dictionary", SOLUTION)
    write(case, "system/controlDict", "dictionary", CONTROL)


def slope(pairs):
    mean_x, mean_y = (sum(p[k] for p in pairs) / len(pairs) for k in (0, 1))
    return sum((x - mean_x) * (y - mean_y) for x, y in pairs) / sum((x - mean_x) ** 2 for x, _ in pairs)


def compare(case, mesh):
    last = max((p for p in case.iterdir() if p.name.isdigit()), key=lambda p: int(p.name))
    inside = {name: body(last / name).split("internalField")[1].split("boundaryField")[0] for name in ("U", "p")}
    flow, text = vectors(inside["U"]), inside["p"]
    pressure = list(map(float, text[text.index("(") + 1:text.rindex(")")].split()))
    middle = [c for c, center in enumerate(mesh.centers) if 1 < center[0] < 3]
    gradient = slope([(mesh.centers[c][0], pressure[c]) for c in middle])
    return {"cells": len(mesh.centers), "velocity_off": max(abs(flow[c][0] - velocity(mesh.centers[c][1])) for c in middle) / 1.5,
            "gradient_off": gradient / (-12 * NU / GAP**2) - 1}


if __name__ == "__main__":
    simple_foam.run(sys.argv[1:], __doc__, lambda path: walls.make("channel", path), ["--layers", LAYERS],
                    write_fields, Mesh, compare)
