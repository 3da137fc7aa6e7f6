#!/usr/bin/env python3
"""A manufactured solution on a quarter of a thick cylinder whose cells are halved twice: from the first to the last mesh
the error falls with the square of the hexes' size in elements of first order, with its cube in those of second order.

Usage: convergence_test.py HEXWRIGHT. Exit code 77 (skipped) without scikit-fem and meshio.
"""
import math
import sys
import tempfile
from pathlib import Path

import support

UNIFORM = ["--rounds", "0", "--placement", "as-given"]
LEVELS = (2, 3, 4)
#: Options and least order.
VARIANTS = {
    "balanced, hex8": ([], 1.9),
    "on the surface, hex8": (["--vertices", "on-surface"], 1.9),
    "order 2, hex27": (["--order", "2"], 2.8),
}


def order_between(errors, counts, first: int, last: int) -> float:
    return 3 * math.log(errors[first] / errors[last]) / math.log(counts[last] / counts[first])


def main() -> int:
    if support.is_missing(("meshio", "skfem")):
        return support.SKIPPED
    import bodies
    import fem

    for name, (options, least) in VARIANTS.items():
        errors, counts = [], []
        for level in LEVELS:
            with tempfile.TemporaryDirectory() as folder:
                surface, mesh = Path(folder) / "ring.obj", Path(folder) / "mesh.msh"
                bodies.quarter_ring(surface, height=1.0, segments=1440)
                support.make_mesh(sys.argv[1], surface, mesh,
                                  ["--min-level", str(level), "--max-level", str(level), *UNIFORM, *options], may_miss_gate=True)
                basis = fem.basis_of(mesh)
            solution = fem.solve_poisson(basis, fem.manufactured, fem.manufactured_source)
            errors.append(fem.l2_error(basis, solution, fem.manufactured))
            counts.append(basis.mesh.nelements)
        order = order_between(errors, counts, 0, -1)
        print(f"{name}: " + ", ".join(f"{n} hexes {e:.2e}" for n, e in zip(counts, errors)) + f"; order {order:.2f}")
        assert order >= least, (name, order)
    return 0


if __name__ == "__main__":
    sys.exit(main())
