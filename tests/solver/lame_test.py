#!/usr/bin/env python3
"""A thick cylinder under pressure, solved by CalculiX and compared with Lame's solution.

Usage: lame_test.py HEXWRIGHT. Exit code 77 (skipped) without CalculiX (ccx) or numpy.
With --table it prints a table of all variants instead of checking one.
"""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
INNER, OUTER, PRESSURE, MODULUS, POISSON = 1.0, 2.0, 1.0, 1000.0, 0.3


def exact_displacement(points):
    import numpy as np

    r = np.hypot(points[:, 0], points[:, 1])
    factor = PRESSURE * INNER**2 / (MODULUS * (OUTER**2 - INNER**2)) * (1 + POISSON)
    radial = factor * ((1 - 2 * POISSON) * r + OUTER**2 / r)
    return radial[:, None] * points * np.array([1, 1, 0]) / r[:, None]


def largest_hoop():
    return PRESSURE * (INNER**2 + OUTER**2) / (OUTER**2 - INNER**2)


STEP = """*INCLUDE, INPUT=mesh.inp
*MATERIAL, NAME=STEEL
*ELASTIC
{modulus}, {poisson}
*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL
*BOUNDARY
xmin_NODES, 1, 1
ymin_NODES, 2, 2
bottom_NODES, 3, 3
top_NODES, 3, 3
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


def write_deck(folder: Path, element: str):
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
    deck.write_text(STEP.format(modulus=MODULUS, poisson=POISSON, loads="\n".join(faces)))
    return deck


def count_hexes(mesh: Path, nodes_per_hex: int) -> int:
    """Elements of a mesh in Abaqus's format."""
    numbers, is_inside = 0, False
    for line in mesh.read_text().splitlines():
        if line.startswith("*"):
            is_inside = line.startswith("*ELEMENT")
        elif is_inside:
            numbers += sum(1 for word in line.split(",") if word.strip())
    return numbers // (nodes_per_hex + 1)


def measure(hexwright: str, folder: Path, options: list[str], element: str):
    """Number of hexes, relative error of u over the nodes, of the largest hoop stress among the nodes inside, and the
    largest error of any of these."""
    import numpy as np

    import bodies
    import calculix

    bodies.quarter_ring(folder / "ring.obj")
    mesh = folder / "mesh.inp"
    run = [hexwright, "mesh", folder / "ring.obj", "-o", mesh, "-q", *options]
    subprocess.run(run, check=True, timeout=300, stderr=subprocess.DEVNULL)
    found = calculix.solve(write_deck(folder, element))
    nodes = calculix.read_nodes(mesh)
    numbers = sorted(found["DISP"])
    u = np.array([found["DISP"][n][:3] for n in numbers])
    exact = exact_displacement(np.array([nodes[n] for n in numbers]))
    hoop = []
    for n in calculix.set_nodes(mesh, "inner_NODES"):
        xx, yy, _, xy = found["STRESS"][n][:4]
        c, s = nodes[n][0] / INNER, nodes[n][1] / INNER
        hoop.append((xx * s * s + yy * c * c - 2 * xy * s * c) / largest_hoop() - 1)
    return (
        count_hexes(mesh, 20 if element.startswith("C3D20") else 8),
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
            count, u, hoop, worst = measure(hexwright, Path(folder), options, element)
            print(f"| {name} | {count} | {100 * u:.4f} | {100 * hoop:.2f} | {100 * worst:.2f} |")


def check(hexwright: str):
    with tempfile.TemporaryDirectory() as folder:
        count, u, hoop, worst = measure(hexwright, Path(folder), ["--tolerance", "0.2%", *SECOND], "C3D20R")
    print(f"{count} hexes: u {100 * u:.4f} %, largest hoop stress {100 * hoop:.2f} %, worst {100 * worst:.2f} % off")
    assert count < 1300, count
    assert u < 1e-4, u
    assert worst < 0.01, worst


def main() -> int:
    try:
        import numpy  # noqa: F401
    except ImportError:
        print("skipped: numpy is not installed")
        return SKIPPED
    if not shutil.which("ccx"):
        print("skipped: CalculiX (ccx) is not installed")
        return SKIPPED
    sys.path.insert(0, str(Path(__file__).parent))
    (print_table if "--table" in sys.argv else check)(sys.argv[1])
    return 0


if __name__ == "__main__":
    sys.exit(main())
