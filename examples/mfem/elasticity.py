"""A bracket of steel, held at its end and pulled by a pin in its bore (N, mm, MPa), in elements of second order.

Usage: elasticity.py mesh.mfem bracket.png
"""
import sys
from pathlib import Path

import mfem.ser as mfem
import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent))
from draw_solution import draw_solution

MODULUS, POISSON, PRESSURE = 210000.0, 0.3, 40.0
SHEAR = MODULUS / (2 * (1 + POISSON))
LAMBDA = MODULUS * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))


def read_boundary_sets(path):
    """Boundary attributes by name. (The library has them too, its Python interface does not.)"""
    lines = Path(path).read_text().splitlines()
    at = lines.index("bdr_attribute_sets")
    rows = (line.rsplit('"', 1) for line in lines[at + 2:at + 2 + int(lines[at + 1])])
    return {name[1:]: [int(word) for word in numbers.split()[1:]] for name, numbers in rows}


def marker(mesh, attributes):
    return mfem.intArray([int(a in attributes) for a in range(1, mesh.bdr_attributes.Max() + 1)])


def solve(mesh, space, patches):
    load = mfem.LinearForm(space)
    pressure, pin = mfem.ConstantCoefficient(-PRESSURE), marker(mesh, patches["pin"])
    load.AddBoundaryIntegrator(mfem.VectorBoundaryFluxLFIntegrator(pressure), pin)
    load.Assemble()
    lame, shear = mfem.ConstantCoefficient(LAMBDA), mfem.ConstantCoefficient(SHEAR)
    stiffness = mfem.BilinearForm(space)
    stiffness.AddDomainIntegrator(mfem.ElasticityIntegrator(lame, shear))
    stiffness.Assemble()
    held, displacement = mfem.intArray(), mfem.GridFunction(space)
    space.GetEssentialTrueDofs(marker(mesh, patches["support"]), held)
    displacement.Assign(0.0)
    matrix, x, b = mfem.OperatorPtr(), mfem.Vector(), mfem.Vector()
    stiffness.FormLinearSystem(held, displacement, load, matrix, x, b)
    sparse = mfem.OperatorHandle2SparseMatrix(matrix)
    mfem.PCG(sparse, mfem.GSSmoother(sparse), b, x, 0, 3000, 1e-16, 0.0)
    stiffness.RecoverFEMSolution(x, load, displacement)
    return displacement


def at_vertices(mesh, displacement):
    """Displacement and von Mises stress at each vertex, the stress as the mean of its elements."""
    moved, mises, count = np.zeros((mesh.GetNV(), 3)), np.zeros(mesh.GetNV()), np.zeros(mesh.GetNV())
    corners = mfem.Geometries.GetVertices(mfem.Geometry.CUBE)
    value, gradient = mfem.Vector(3), mfem.DenseMatrix(3)
    for element in range(mesh.GetNE()):
        place = mesh.GetElementTransformation(element)
        for k, vertex in enumerate(mesh.GetElementVertices(element)):
            place.SetIntPoint(corners.IntPoint(k))
            displacement.GetVectorValue(element, corners.IntPoint(k), value)
            displacement.GetVectorGradient(place, gradient)
            strain = np.array(gradient.GetDataArray())
            strain = (strain + strain.T) / 2
            deviator = 2 * SHEAR * (strain - np.eye(3) * np.trace(strain) / 3)
            moved[vertex] = value.GetDataArray()
            mises[vertex] += np.sqrt(1.5 * np.sum(deviator**2))
            count[vertex] += 1
    return moved, mises / count


mesh = mfem.Mesh(sys.argv[1], 1, 1)
collection = mfem.H1_FECollection(2, 3)
space = mfem.FiniteElementSpace(mesh, collection, 3)
moved, mises = at_vertices(mesh, solve(mesh, space, read_boundary_sets(sys.argv[1])))
largest = np.linalg.norm(moved, axis=1).max()
print(f"{mesh.GetNE()} elements: largest displacement {largest:.4g} mm, largest von Mises stress {mises.max():.4g} MPa")

points = np.array([mesh.GetVertexArray(v) for v in range(mesh.GetNV())])
faces = np.array([mesh.GetBdrElementVertices(b) for b in range(mesh.GetNBE())])
draw_solution(points + 3 / largest * moved, faces, mises, sys.argv[2], "von Mises stress, MPa (displacement magnified)")
