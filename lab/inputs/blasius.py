#!/usr/bin/env python3
"""Laminar flow along a flat plate in OpenFOAM, on a mesh with wall layers, beside Blasius' solution.

Usage: blasius.py PROGRAM OPTION...

A plate of length 2 begins 0.5 behind the inlet of a channel 1 high, whose upper side is open. Meshes it with 16 layers along the
plate and the way to it, and the further options of `hexwright mesh`, and runs simpleFoam at a Reynolds number of 20,000 at the
end of the plate. Prints one JSON object: cells; over the places 0.5 to 1.5 behind the plate's edge the largest error of the
velocity along the plate over that of the stream, and the largest error of the friction at the wall over Blasius' own.
{} where OpenFOAM is not installed.
"""
import math
import sys
from pathlib import Path

import poiseuille
import simple_foam
import walls
from poiseuille import Mesh, body, vectors, write

NU, LEAD, LENGTH, HEIGHT, DEPTH = 1e-4, 0.5, 2.0, 1.0, 0.1
LAYERS = "plate*=first:0.001,growth:1.2,count:16"
OUTLINE = [(-LEAD, 0), (0, 0), (LENGTH, 0), (LENGTH, HEIGHT), (-LEAD, HEIGHT)]
NAMES = ["plate_before", "plate", "outlet", "top", "inlet"]
FROM, TO = 0.5, 1.5
SCHEMES = poiseuille.SCHEMES.replace("bounded Gauss linear;", "bounded Gauss linearUpwind grad(U);", 1)


def profile():
    """f' of f''' + f f'' / 2 = 0 by Runge and Kutta, every 0.01 of eta up to 10."""
    def slope(state):
        f, df, ddf = state
        return df, ddf, -0.5 * f * ddf
    step, state, values = 0.01, (0.0, 0.0, 0.332057336215), [0.0]
    for _ in range(1000):
        a = slope(state)
        b = slope([s + step / 2 * d for s, d in zip(state, a)])
        c = slope([s + step / 2 * d for s, d in zip(state, b)])
        d = slope([s + step * d for s, d in zip(state, c)])
        state = tuple(s + step / 6 * (p + 2 * q + 2 * r + t) for s, p, q, r, t in zip(state, a, b, c, d))
        values.append(state[1])
    return values


def velocity(table, x, y):
    eta = y * math.sqrt(1 / (NU * x)) / 0.01
    k = min(int(eta), len(table) - 2)
    return table[k] + min(1.0, eta - k) * (table[k + 1] - table[k])


def write_case(case, mesh):
    rows = {"inlet": ("type fixedValue; value uniform (1 0 0);", "type zeroGradient;"),
            "outlet": ("type zeroGradient;", "type fixedValue; value uniform 0;"),
            "top": ("type pressureInletOutletVelocity; value uniform (1 0 0);", "type fixedValue; value uniform 0;"),
            "plate": ("type noSlip;", "type zeroGradient;")}
    slip = ("type slip;", "type zeroGradient;")

    def patches(which):
        return "boundaryField\n{\n" + "".join(f' "{name}" {{ {rows.get(name, slip)[which]} }}\n' for name in mesh.patches) + "}\n"
    write(case, "0/U", "volVectorField", "dimensions [0 1 -1 0 0 0 0];\ninternalField uniform (1 0 0);\n" + patches(0))
    write(case, "0/p", "volScalarField", "dimensions [0 2 -2 0 0 0 0];\ninternalField uniform 0;\n" + patches(1))
    write(case, "constant/transportProperties", "dictionary", f"transportModel Newtonian;\nnu [0 2 -1 0 0 0 0] {NU};\n")
    write(case, "constant/turbulenceProperties", "dictionary", "simulationType laminar;\n")
    write(case, "system/fvSchemes", "dictionary", SCHEMES)
    write(case, "system/fvSolution", "dictionary", poiseuille.SOLUTION)
    write(case, "system/controlDict", "dictionary", poiseuille.CONTROL.replace("400", "1500"))


def compare(case, mesh):
    last = max((p for p in case.iterdir() if p.name.isdigit()), key=lambda p: int(p.name))
    flow = vectors(body(last / "U").split("internalField")[1].split("boundaryField")[0])
    table = profile()
    cells = [c for c, center in enumerate(mesh.centers) if FROM < center[0] < TO]
    off = max(abs(flow[c][0] - velocity(table, *mesh.centers[c][:2])) for c in cells)
    # Cells at the wall are so thin that the velocity there is linear.
    lowest = 0.75 * min(mesh.centers[c][1] for c in cells) * 2
    at_wall = [c for c in cells if mesh.centers[c][1] < lowest]
    friction = {c: flow[c][0] / mesh.centers[c][1] for c in at_wall}
    exact = {c: 0.332057 * math.sqrt(1 / (NU * mesh.centers[c][0])) for c in at_wall}
    return {"cells": len(mesh.centers), "velocity_off": off,
            "friction_off": max(abs(friction[c] / exact[c] - 1) for c in at_wall), "iterations": int(last.name)}


if __name__ == "__main__":
    simple_foam.run(sys.argv[1:], __doc__, lambda path: walls.write_obj(*walls.prism(OUTLINE, DEPTH, NAMES), path), ["--layers", LAYERS],
                    write_case, Mesh, compare)
