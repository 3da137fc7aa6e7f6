#!/usr/bin/env python3
"""The linear patch test on models: a linear function is found exactly, by elements of first and of second order.

Usage: patch_test.py HEXWRIGHT FOLDER-OF-MODELS. Exit code 77 (skipped) without scikit-fem and meshio.
"""
import sys
import tempfile
from pathlib import Path

import support

ORDERS = {"first": [], "second": ["--order", "2"]}


def linear(x):
    return 1 + 2 * x[0] - 3 * x[1] + 0.5 * x[2]


def main() -> int:
    if support.is_missing(("numpy", "meshio", "skfem")):
        return support.SKIPPED
    import fem
    import numpy as np

    models = support.list_models(sys.argv[2])
    failed = []
    for model in models:
        for order, options in ORDERS.items():
            with tempfile.TemporaryDirectory() as folder:
                mesh = Path(folder) / "mesh.msh"
                support.make_mesh(sys.argv[1], model, mesh, ["--tolerance", "2%", "--rounds", "2", *options],
                                  may_miss_gate=True)
                basis = fem.basis_of(mesh)
            exact = linear(basis.doflocs)
            error = np.abs(fem.solve_poisson(basis, linear) - exact).max() / np.abs(exact).max()
            print(f"{model.name}, {order} order, {basis.mesh.nelements} hexes: {error:.1e}", flush=True)
            if not error < 1e-10:
                failed.append(f"{model.name}, {order} order")
    support.report(failed, 2 * len(models))
    return 0


if __name__ == "__main__":
    sys.exit(main())
