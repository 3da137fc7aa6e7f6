#!/usr/bin/env python3
"""Benchmarks of NAFEMS and the plate with a hole, in hexes of second order solved by CalculiX.

Usage: nafems_test.py HEXWRIGHT [NAME ...]. Exit code 77 (skipped) without CalculiX (ccx) or numpy.

Sources: NAFEMS, "The Standard NAFEMS Benchmarks", TNSB rev. 3, 1990 (LE1, LE10, LE11, FV52); Kirsch 1898 and, for a plate of
finite width, the fit of Heywood 1952.
"""
import math
import sys
import tempfile
from pathlib import Path

import support

STEEL = "*ELASTIC\n210000., 0.3\n"


def fixed(**axes):
    """u = 0 along axes 1, 2, 3 for the nodes of patches: fixed(xmin=1, outer0=12)."""
    return "*BOUNDARY\n" + "".join(f"{patch}_NODES, {axis}, {axis}\n" for patch, all_axes in axes.items()
                                   for axis in str(all_axes))


def static(loads):
    return f"*STEP\n*STATIC\n{loads}*NODE FILE\nU\n*EL FILE\nS\n*END STEP\n"


class Problem:
    """Its surface, the options of its mesh, the deck around the mesh and what is found in it."""
    options: list[str] = []
    material = STEEL
    element = "C3D20R"

    def results(self, deck: Path) -> dict[str, tuple[float, float, float]]:
        """By name: the value, the one it should be, and the relative error allowed."""
        import calculix

        found, nodes = calculix.solve(deck), calculix.read_nodes(deck.parent / "mesh.inp")
        node = min(nodes, key=lambda n: sum((a - b) ** 2 for a, b in zip(nodes[n], self.point)))
        assert math.dist(nodes[node], self.point) < 1e-6, (nodes[node], self.point)
        return {self.stress: (found["STRESS"][node][self.component], self.expected, self.tolerance)}


class EllipticMembrane(Problem):
    """LE1 as a plate of thickness 0.1 in plane stress: pulled outwards at its outer edge."""
    options = ["--tolerance", "0.1%", "--refine", "ball:2,0,0.05,0.3=0.1"]
    point, stress, component, expected, tolerance = (2, 0, 0), "sigma_yy at D", 1, 92.7, 0.01

    def write(self, path):
        import bodies
        bodies.quarter_ellipse(path, (0.0, 0.1))

    def deck(self, nodes, sets):
        return fixed(xmin=1, ymin=2, bottom=3) + static("*DSLOAD\nouter0, P, -10.\n")


class ThickPlate(Problem):
    """LE10: pressed from above, held at its outer wall and there, in mid-plane, from below."""
    options = ["--tolerance", "0.1%", "--refine", "ball:2,0,0.6,0.3=0.1"]
    point, stress, component, expected, tolerance = (2, 0, 0.6), "sigma_yy at D", 1, -5.38, 0.01

    def write(self, path):
        import bodies
        bodies.quarter_ellipse(path, (0.0, 0.3, 0.6))

    def deck(self, nodes, sets):
        line = sorted(set(sets("outer0_NODES")) & set(sets("outer1_NODES")))
        assert all(abs(nodes[n][2] - 0.3) < 0.01 for n in line) and len(line) > 8, line
        held = fixed(xmin=1, ymin=2, outer0=12, outer1=12) + "".join(f"{n}, 3, 3\n" for n in line)
        return held + static("*DSLOAD\ntop, P, 1.\n")


class CylinderTaperSphere(Problem):
    """LE11: heated by T = r + z between two planes."""
    options = ["--tolerance", "0.2%"]
    material = STEEL + "*EXPANSION\n2.3E-4\n"
    point, stress, component, expected, tolerance = (1, 0, 0), "sigma_zz at A", 2, -105, 0.01

    def write(self, path):
        import bodies

        def arc(radius, degrees, n=90):
            return [(radius * math.cos(math.radians(degrees * k / n)), radius * math.sin(math.radians(degrees * k / n)))
                    for k in range(n + 1)]

        sphere, ball = arc(1.0, 45), arc(1.4, 30)
        corner, shoulder = sphere[-1], ball[-1]
        bodies.quarter_of_revolution(
            path, [("in_sphere", sphere), ("in_wall", [corner, (corner[0], 1.39), (corner[0], 1.79)])],
            [("out_sphere", ball), ("out_taper", [shoulder, (1.0, 1.39)]), ("out_wall", [(1.0, 1.39), (1.0, 1.79)])])

    def deck(self, nodes, sets):
        heat = "".join(f"{n}, {math.hypot(p[0], p[1]) + p[2]:.9g}\n" for n, p in nodes.items())
        start = "*NSET, NSET=ALL_NODES, GENERATE\n1, {}\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL_NODES, 0.\n"
        return start.format(max(nodes)) + fixed(xmin=1, ymin=2, bottom=3, top=3) + static("*TEMPERATURE\n" + heat)


class PlateWithHole(Problem):
    """In plane strain, pulled along x."""
    options = ["--tolerance", "0.05%", "--refine", "cylinder:0,0,0,0,0,1,1.5=0.2"]
    width = 1 / 20  # of the hole, as a share of the plate's
    point, stress, component, expected, tolerance = (0, 1, 0), "stress concentration", 0, (2 + (1 - width)**3) / (1 - width), 0.002

    def write(self, path):
        import bodies
        bodies.quarter_plate_with_hole(path)

    def deck(self, nodes, sets):
        return fixed(xmin=1, ymin=2, bottom=3, top=3) + static("*DSLOAD\nxmax, P, -1.\n")


class SolidPlate(Problem):
    """FV52: a plate of 10 x 10 x 1 m whose sides move neither down nor along themselves; its frequencies of bending in Hz.
    (The benchmark's 193.59 Hz is a mode in the plane, of sides that are free to move along themselves.)"""
    options = ["--size", "0.5"]
    material = "*ELASTIC\n200.E9, 0.3\n*DENSITY\n8000.\n"
    frequencies = (45.897, 109.44, 109.44, 167.89, 206.19, 206.19)

    def write(self, path):
        import bodies
        bodies.box(path, (0, 0, -0.5), (10, 10, 0.5))

    def deck(self, nodes, sets):
        return fixed(xmin=23, xmax=23, ymin=13, ymax=13) + "*STEP\n*FREQUENCY\n10\n*END STEP\n"

    def results(self, deck):
        import calculix
        found, results = calculix.frequencies(deck), {}
        for k, wanted in enumerate(self.frequencies):
            nearest = min(found, key=lambda f: abs(f - wanted))
            found.remove(nearest)
            results[f"bending mode {k + 1}"] = (nearest, wanted, 0.01)
        return results


PROBLEMS = {"LE1": EllipticMembrane, "LE10": ThickPlate, "LE11": CylinderTaperSphere, "hole": PlateWithHole,
            "FV52": SolidPlate}


def solve(hexwright: str, name: str, folder: Path) -> tuple[int, dict]:
    import calculix

    problem = PROBLEMS[name]()
    surface, mesh, deck = folder / "body.obj", folder / "mesh.inp", folder / "case.inp"
    problem.write(surface)
    support.make_mesh(hexwright, surface, mesh, ["--order", "2", *problem.options])
    mesh.write_text(mesh.read_text().replace("TYPE=C3D20,", f"TYPE={problem.element},"))
    nodes = calculix.read_nodes(mesh)
    body = problem.deck(nodes, lambda set_name: calculix.set_nodes(mesh, set_name))
    deck.write_text(f"*INCLUDE, INPUT=mesh.inp\n*MATERIAL, NAME=M\n{problem.material}"
                    f"*SOLID SECTION, ELSET=EALL, MATERIAL=M\n{body}")
    return calculix.count_elements(mesh, 20), problem.results(deck)


def main() -> int:
    if support.is_missing(("numpy",), ("ccx",)):
        return support.SKIPPED
    is_good = True
    for name in sys.argv[2:] or PROBLEMS:
        with tempfile.TemporaryDirectory() as folder:
            hexes, results = solve(sys.argv[1], name, Path(folder))
        for what, (value, wanted, tolerance) in results.items():
            error = value / wanted - 1
            is_good = is_good and abs(error) < tolerance
            print(f"{name}, {hexes} hexes, {what}: {value:.4f}, {100 * error:+.2f} % of {wanted:.6g}", flush=True)
    assert is_good
    return 0


if __name__ == "__main__":
    sys.exit(main())
