#!/usr/bin/env python3
"""The linear patch test on the bundled models: a linear function is found exactly, by elements of first and of second
order.

Usage: patch_test.py HEXWRIGHT SOURCE_DIR. Exit code 77 (skipped) without scikit-fem and meshio.
"""
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
ORDERS = {"first": [], "second": ["--order", "2"]}
#: Without 20mm-xyz-cube: so coarse, its letters leave hexes whose Jacobian is not positive inside, which is warned of.
MODELS = ["cube_minus_sphere.obj", "plate_holes.stl", "3holes.obj", "spot_low_resolution.obj"]


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

    for model in MODELS:
        for order, options in ORDERS.items():
            with tempfile.TemporaryDirectory() as folder:
                mesh = Path(folder) / "mesh.msh"
                fem.make_mesh(sys.argv[1], Path(sys.argv[2]) / "data/models" / model, mesh,
                              ["--tolerance", "2%", "--rounds", "2", *options])
                basis = fem.basis_of(mesh)
            exact = linear(basis.doflocs)
            error = np.abs(fem.solve_poisson(basis, linear) - exact).max() / np.abs(exact).max()
            print(f"{model}, {order} order, {basis.mesh.nelements} hexes: {error:.1e}")
            assert error < 1e-10, (model, order, error)
    return 0


if __name__ == "__main__":
    sys.exit(main())
