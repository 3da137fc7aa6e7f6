"""Heat conduction through the bracket: 100 degrees in its bore, 20 at its end, no flow through the other faces.

Usage: heat.py mesh.msh heat.png. The mesh is one of hexwright, of first or of second order.
"""
import sys
from pathlib import Path

import meshio
import numpy as np
import skfem
from skfem.helpers import dot, grad

sys.path.insert(0, str(Path(__file__).parent.parent))
from draw_solution import draw_solution



def find_named_facets(path, mesh):
    """Facets by the name of their physical surface. (scikit-fem finds these itself in meshes of first order only.)"""
    file = meshio.read(path)
    facet_of = {tuple(verts): i for i, verts in enumerate(np.sort(mesh.facets, axis=0).T)}
    names = {tag: name for name, (tag, dimension) in file.field_data.items() if dimension == 2}
    found = {}
    for block, tags in zip(file.cells, file.cell_data["gmsh:physical"]):
        if block.type in ("quad", "quad9"):
            for quad, tag in zip(np.sort(block.data[:, :4]), tags):
                found.setdefault(names[tag], []).append(facet_of[tuple(quad)])
    return {name: np.array(facets) for name, facets in found.items()}


mesh = skfem.Mesh.load(sys.argv[1])
patches = find_named_facets(sys.argv[1], mesh)
element = skfem.ElementHex2() if isinstance(mesh, skfem.MeshHex2) else skfem.ElementHex1()
basis = skfem.Basis(mesh, element)
hot = basis.get_dofs(np.concatenate([patches["pin"], patches["bore"]])).all()
cold = basis.get_dofs(patches["support"]).all()

conduction = skfem.BilinearForm(lambda u, v, _: dot(grad(u), grad(v))).assemble(basis)
temperature = basis.zeros()
temperature[hot], temperature[cold] = 100, 20
temperature = skfem.solve(*skfem.condense(conduction, x=temperature, D=np.union1d(hot, cold)))

flow = float(temperature @ (conduction @ temperature)) / 80  # the energy is the flow times the difference
print(f"{mesh.nelements} hexes, {basis.N} unknowns: heat flow {flow:.6g} per unit of conductivity")

corners = temperature[basis.nodal_dofs[0]]
facets = mesh.facets[:, mesh.boundary_facets()].T
centers = mesh.p[:, mesh.t].mean(axis=1)[:, mesh.f2t[0, mesh.boundary_facets()]].T
points = mesh.p.T[: len(corners)]
normal = np.cross(points[facets[:, 2]] - points[facets[:, 0]], points[facets[:, 3]] - points[facets[:, 1]])
is_inwards = np.sum(normal * (points[facets].mean(axis=1) - centers), axis=1) < 0
facets[is_inwards] = facets[is_inwards][:, ::-1]
draw_solution(points, facets, corners, sys.argv[2], "temperature", direction=(-0.6, -0.6, -0.5))
