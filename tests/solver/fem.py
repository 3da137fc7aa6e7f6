"""Meshes of hexwright in scikit-fem, and the problems that are solved on them."""
import contextlib
import io
from pathlib import Path

import numpy as np
import skfem
from skfem.helpers import dot, grad


def basis_of(path: Path):
    """Elements of the mesh's own order on a Gmsh file; of second order those with 27 nodes."""
    with contextlib.redirect_stdout(io.StringIO()):  # meshio's remarks
        mesh = skfem.Mesh.load(path)
    if isinstance(mesh, skfem.MeshHex2):
        return skfem.Basis(mesh, skfem.ElementHex2(), intorder=6)
    return skfem.Basis(mesh, skfem.ElementHex1(), intorder=4)


@skfem.BilinearForm
def stiffness(u, v, w):
    return dot(grad(u), grad(v))


def solve_poisson(basis, value, source=None):
    """-div grad u = source with u = value on the boundary; the solution at the nodes."""
    load = skfem.LinearForm(lambda v, w: source(w.x) * v).assemble(basis) if source else basis.zeros()
    boundary = basis.get_dofs().all()
    given = value(basis.doflocs)
    return skfem.solve(*skfem.condense(stiffness.assemble(basis), load, x=given, D=boundary))


def l2_error(basis, solution, value) -> float:
    """Relative."""
    found = basis.interpolate(solution)
    error = skfem.Functional(lambda w: (w["u"] - value(w.x)) ** 2).assemble(basis, u=found)
    size = skfem.Functional(lambda w: value(w.x) ** 2).assemble(basis)
    return float(np.sqrt(error / size))


def manufactured(x):
    """Of no polynomial space, and with a source of its own."""
    return np.sin(x[0]) * np.cos(2 * x[1]) * np.exp(x[2])


def manufactured_source(x):
    return 4 * manufactured(x)
