#!/usr/bin/env python3
"""One problem of second order solved by scikit-fem and by MFEM, each from its own format: the energies agree, so nodes,
edges, faces and boundaries are numbered as both expect.

Usage: same_number_test.py HEXWRIGHT. Exit code 77 (skipped) without scikit-fem, meshio and mfem.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

import support


def energy_of_skfem(path: Path) -> float:
    """Of the Poisson problem whose values are manufactured ones where the patch is inner or outer, and free elsewhere."""
    import fem
    import numpy as np
    import skfem

    basis = fem.basis_of(path)
    r = np.hypot(basis.doflocs[0], basis.doflocs[1])
    given = np.where((abs(r - 1) < 1e-3) | (abs(r - 2) < 1e-3))[0]
    matrix = fem.stiffness.assemble(basis)
    u = skfem.solve(*skfem.condense(matrix, x=fem.manufactured(basis.doflocs), D=given))
    return float(u @ (matrix @ u))


def energy_of_mfem(path: Path) -> float:
    import math

    import mfem.ser as mfem

    class Manufactured(mfem.PyCoefficient):
        def EvalValue(self, x):
            return math.sin(x[0]) * math.cos(2 * x[1]) * math.exp(x[2])

    mesh = mfem.Mesh(str(path), 1, 1)
    collection = mfem.H1_FECollection(2, 3)
    space = mfem.FiniteElementSpace(mesh, collection)
    fixed = mfem.intArray([1 if attribute in fixed_attributes(path) else 0
                           for attribute in range(1, mesh.bdr_attributes.Max() + 1)])
    given = mfem.intArray()
    space.GetEssentialTrueDofs(fixed, given)
    one = mfem.ConstantCoefficient(1.0)
    rule = mfem.IntRules.Get(mfem.Geometry.CUBE, 7)
    form = mfem.BilinearForm(space)
    integrator = mfem.DiffusionIntegrator(one)
    integrator.SetIntRule(rule)
    form.AddDomainIntegrator(integrator)
    form.Assemble()
    load = mfem.LinearForm(space)
    load.Assemble()
    u = mfem.GridFunction(space)
    u.Assign(0.0)
    u.ProjectBdrCoefficient(Manufactured(), fixed)
    matrix, x, b = mfem.OperatorPtr(), mfem.Vector(), mfem.Vector()
    form.FormLinearSystem(given, u, load, matrix, x, b)
    sparse = mfem.OperatorHandle2SparseMatrix(matrix)
    mfem.PCG(sparse, mfem.GSSmoother(sparse), b, x, 0, 2000, 1e-26, 0.0)
    form.RecoverFEMSolution(x, load, u)
    free = mfem.BilinearForm(space)
    again = mfem.DiffusionIntegrator(one)
    again.SetIntRule(rule)
    free.AddDomainIntegrator(again)
    free.Assemble()
    free.Finalize()
    return free.InnerProduct(u, u)


def fixed_attributes(path: Path) -> list[int]:
    """Attributes of the patches inner and outer, by the names that the file gives them."""
    attributes, is_inside = [], False
    for line in path.read_text().splitlines():
        is_inside = line == "bdr_attribute_sets" or (is_inside and line != "" and line[0] in '"0123456789')
        if is_inside and line.startswith(('"inner"', '"outer"')):
            attributes.append(int(line.split()[-1]))
    assert len(attributes) == 2, attributes
    return attributes


def main() -> int:
    if support.is_missing(("meshio", "mfem.ser", "skfem")):
        return support.SKIPPED
    import bodies

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        bodies.quarter_ring(folder / "ring.obj", segments=720)
        support.make_mesh(sys.argv[1], folder / "ring.obj", folder / "mesh.vtu", ["--order", "2", "--tolerance", "1%"],
                          may_miss_gate=True)
        for output in ("mesh.msh", "mesh.mfem"):
            subprocess.run([sys.argv[1], "convert", folder / "mesh.vtu", folder / output, "-q"], check=True)
        ours, theirs = energy_of_skfem(folder / "mesh.msh"), energy_of_mfem(folder / "mesh.mfem")
    print(f"scikit-fem {ours:.12g}, MFEM {theirs:.12g}")
    assert abs(ours - theirs) < 1e-7 * abs(ours)
    return 0


if __name__ == "__main__":
    sys.exit(main())
