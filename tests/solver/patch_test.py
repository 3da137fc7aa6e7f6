#!/usr/bin/env python3
"""The linear patch test on models: a linear function is found exactly, by elements of first and of second order.

Usage: patch_test.py HEXWRIGHT FOLDER-OF-MODELS. Exit code 77 (skipped) without scikit-fem and meshio.
"""
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
ORDERS = {"first": [], "second": ["--order", "2"]}
SURFACES = {".obj", ".off", ".stl", ".ply"}


def linear(x):
    return 1 + 2 * x[0] - 3 * x[1] + 0.5 * x[2]


def main() -> int:
    try:
        import meshio  # noqa: F401
        import numpy as np
        import skfem  # noqa: F401
    except ImportError as missing:
        print(f"skipped: {missing.name} is not installed")
        return SKIPPED
    import fem

    models = sorted(p for p in Path(sys.argv[2]).iterdir() if p.suffix.lower() in SURFACES)
    assert models, f"no model in {sys.argv[2]}"
    failed = []
    for model in models:
        for order, options in ORDERS.items():
            with tempfile.TemporaryDirectory() as folder:
                mesh = Path(folder) / "mesh.msh"
                fem.make_mesh(sys.argv[1], model, mesh, ["--tolerance", "2%", "--rounds", "2", *options])
                basis = fem.basis_of(mesh)
            exact = linear(basis.doflocs)
            error = np.abs(fem.solve_poisson(basis, linear) - exact).max() / np.abs(exact).max()
            print(f"{model.name}, {order} order, {basis.mesh.nelements} hexes: {error:.1e}", flush=True)
            if not error < 1e-10:
                failed.append(f"{model.name}, {order} order")
    print(f"{2 * len(models) - len(failed)} of {2 * len(models)} meshes pass")
    assert not failed, failed
    return 0


if __name__ == "__main__":
    sys.exit(main())
