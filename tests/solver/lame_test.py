#!/usr/bin/env python3
"""A thick cylinder and a hollow sphere under inner pressure, solved by CalculiX and compared with Lame's solutions.

Usage: lame_test.py HEXWRIGHT [STEP-FILE]. Exit code 77 (skipped) without CalculiX (ccx) or numpy, or where HEXWRIGHT
does not read the CAD file of the cylinder that is given instead of triangles.
With --table it prints a table of variants on the cylinder instead.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

import support

INNER, OUTER, PRESSURE, MODULUS, POISSON = 1.0, 2.0, 1.0, 1000.0, 0.3


class Cylinder:
    """A quarter in plane strain. Its surface, exact solution, and what is held along which axis."""

    held = {"xmin": 1, "ymin": 2, "bottom": 3, "top": 3}
    options = ["--tolerance", "0.2%"]
    largest_hoop = PRESSURE * (INNER**2 + OUTER**2) / (OUTER**2 - INNER**2)
    most = {"hexes": 1300, "u": 1e-4, "hoop": 0.01}

    @staticmethod
    def write(path):
        import bodies

        bodies.quarter_ring(path, INNER, OUTER)

    @staticmethod
    def displacement(points):
        import numpy as np

        flat = points * np.array([1, 1, 0])
        r = np.linalg.norm(flat, axis=1)[:, None]
        factor = PRESSURE * INNER**2 / (MODULUS * (OUTER**2 - INNER**2)) * (1 + POISSON)
        return factor * ((1 - 2 * POISSON) * r + OUTER**2 / r) * flat / r

    @staticmethod
    def hoop(stress, point):
        xx, yy, _, xy = stress[:4]
        c, s = point[0] / INNER, point[1] / INNER
        return xx * s * s + yy * c * c - 2 * xy * s * c


class Sphere:
    """An eighth of the shell."""

    held = {"xmin": 1, "ymin": 2, "zmin": 3}
    largest_hoop = PRESSURE * (INNER**3 + OUTER**3 / 2) / (OUTER**3 - INNER**3)
    #: The tolerance's grading follows the shape; here the solution, steep at the inner sphere, asks for more.
    options = ["--size", "0.1"]
    most = {"hexes": 5000, "u": 1e-4, "hoop": 0.01}

    @staticmethod
    def write(path):
        import bodies

        bodies.eighth_shell(path, INNER, OUTER, segments=240)

    @staticmethod
    def displacement(points):
        import numpy as np

        r = np.linalg.norm(points, axis=1)[:, None]
        factor = PRESSURE * INNER**3 / (MODULUS * (OUTER**3 - INNER**3))
        return factor * ((1 - 2 * POISSON) * r + (1 + POISSON) * OUTER**3 / (2 * r**2)) * points / r

    @staticmethod
    def hoop(stress, point):
        """The mean of the two along the sphere: the trace without the radial one."""
        import numpy as np

        xx, yy, zz, xy, yz, zx = stress[:6]
        n = point / np.linalg.norm(point)
        radial = n @ np.array([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]) @ n
        return (xx + yy + zz - radial) / 2


STEP = """*INCLUDE, INPUT=mesh.inp
*MATERIAL, NAME=STEEL
*ELASTIC
{modulus}, {poisson}
*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL
*BOUNDARY
{held}
*STEP
*STATIC
*DLOAD
{loads}
*NODE FILE
U
*EL FILE
S
*END STEP
"""


def write_deck(folder: Path, body, element: str):
    """Pressure on the faces of the patch, one by one: CalculiX takes no surfaces there."""
    mesh = folder / "mesh.inp"
    text = mesh.read_text().replace("TYPE=C3D20,", f"TYPE={element},")
    mesh.write_text(text)
    faces, is_inside = [], False
    for line in text.splitlines():
        if line.startswith("*"):
            is_inside = line.startswith("*SURFACE, NAME=inner,")
        elif is_inside:
            number, side = line.split(",")
            faces.append(f"{number}, P{side.strip()[1]}, {PRESSURE}")
    assert faces, "no face of the patch 'inner'"
    deck = folder / "lame.inp"
    held = "\n".join(f"{patch}_NODES, {axis}, {axis}" for patch, axis in body.held.items())
    deck.write_text(STEP.format(modulus=MODULUS, poisson=POISSON, held=held, loads="\n".join(faces)))
    return deck


def measure(hexwright: str, folder: Path, body, options: list[str], element: str, surface: Path | None = None):
    """Number of hexes, relative error of u over the nodes, of the largest hoop stress among the nodes inside, and the
    largest error of any of these."""
    import numpy as np

    import calculix

    if surface is None:
        surface = folder / "body.obj"
        body.write(surface)
    mesh = folder / "mesh.inp"
    support.make_mesh(hexwright, surface, mesh, options)
    found = calculix.solve(write_deck(folder, body, element))
    nodes = calculix.read_nodes(mesh)
    numbers = sorted(found["DISP"])
    u = np.array([found["DISP"][n][:3] for n in numbers])
    exact = body.displacement(np.array([nodes[n] for n in numbers]))
    hoop = [
        body.hoop(found["STRESS"][n], nodes[n]) / body.largest_hoop - 1 for n in calculix.set_nodes(mesh, "inner_NODES")
    ]
    return (
        calculix.count_elements(mesh, 20 if element.startswith("C3D20") else 8),
        np.linalg.norm(u - exact) / np.linalg.norm(exact),
        abs(max(hoop)),
        max(map(abs, hoop)),
    )


SECOND = ["--order", "2"]
ON_SURFACE = ["--vertices", "on-surface"]
VARIANTS = [
    ("balanced, hex8", [], "C3D8"),
    ("on the surface, hex8", ON_SURFACE, "C3D8"),
    ("0.1%, balanced, hex8", ["--tolerance", "0.1%"], "C3D8"),
    ("0.1%, on the surface, hex8", ["--tolerance", "0.1%", *ON_SURFACE], "C3D8"),
    ("order 2, hex20", SECOND, "C3D20"),
    ("0.2%, order 2, hex20", ["--tolerance", "0.2%", *SECOND], "C3D20"),
    ("0.2%, order 2, hex20, reduced integration", ["--tolerance", "0.2%", *SECOND], "C3D20R"),
    ("0.02%, order 2, hex20, reduced integration", ["--tolerance", "0.02%", *SECOND], "C3D20R"),
]


def print_table(hexwright: str):
    print("| options | hexes | u, % | largest hoop stress, % | worst hoop stress, % |\n|---|--:|--:|--:|--:|")
    for name, options, element in VARIANTS:
        with tempfile.TemporaryDirectory() as folder:
            count, u, hoop, worst = measure(hexwright, Path(folder), Cylinder, options, element)
            print(f"| {name} | {count} | {100 * u:.4f} | {100 * hoop:.2f} | {100 * worst:.2f} |")


def check(hexwright: str, step: Path | None):
    for body in (Cylinder,) if step else (Cylinder, Sphere):
        with tempfile.TemporaryDirectory() as folder:
            count, u, hoop, worst = measure(
                hexwright, Path(folder), body, [*body.options, *SECOND], "C3D20R", step
            )
        print(
            f"{body.__name__}, {count} hexes: u {100 * u:.4f} %, largest hoop stress {100 * hoop:.2f} %, "
            f"worst {100 * worst:.2f} % off"
        )
        assert count < body.most["hexes"], count
        assert u < body.most["u"], u
        assert worst < body.most["hoop"], worst


def main() -> int:
    if support.is_missing(("numpy",), ("ccx",)):
        return support.SKIPPED
    if "--table" in sys.argv:
        print_table(sys.argv[1])
        return 0
    step = Path(sys.argv[2]) if len(sys.argv) > 2 else None
    if step and "scripts/setup cad" in subprocess.run([sys.argv[1], "inspect", step], capture_output=True, text=True).stderr:
        print("skipped: built without OpenCASCADE")
        return support.SKIPPED
    check(sys.argv[1], step)
    return 0


if __name__ == "__main__":
    sys.exit(main())
