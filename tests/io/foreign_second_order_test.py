#!/usr/bin/env python3
"""Opens meshes of second order with other programs' readers, and compares the volume of their curved elements, which only
the right order of nodes gives, and the nodes of their sets.

Usage: foreign_second_order_test.py READER WRITE_SAMPLES_PROGRAM. Exit code 77 (skipped) when the reader is not installed.
"""
import shutil
import subprocess
import sys
from pathlib import Path

import foreign_reader

#: Gauss points and weights on [0, 1], exact up to degree 7.
GAUSS = [(0.5 + 0.5 * x, 0.5 * w) for x, w in ((-0.8611363115940526, 0.3478548451374538), (-0.3399810435848563, 0.6521451548625461),
                                             (0.3399810435848563, 0.6521451548625461), (0.8611363115940526, 0.3478548451374538))]


def near(found, expected, tolerance=1e-9):
    assert abs(found - expected) < tolerance * expected, (found, expected)


def determinant(a, b, c):
    return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]))


def vtk_volume(grid, num_nodes):
    """By VTK's own shape functions."""
    total = 0.0
    for c in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(c)
        n = cell.GetNumberOfPoints()
        if cell.GetCellDimension() < 3:
            continue
        assert n == num_nodes, n
        points = [cell.GetPoints().GetPoint(k) for k in range(n)]
        for x, wx in GAUSS:
            for y, wy in GAUSS:
                for z, wz in GAUSS:
                    derivs = [0.0] * (3 * n)
                    cell.InterpolateDerivs([x, y, z], derivs)
                    rows = [[sum(derivs[axis * n + k] * points[k][i] for k in range(n)) for i in range(3)] for axis in range(3)]
                    total += wx * wy * wz * determinant(*rows)
    return total


def read_vtk(folder, samples):
    from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

    for num_nodes in (20, 27):
        for name, reader in (("vtu", vtkXMLUnstructuredGridReader()), ("vtk", vtkUnstructuredGridReader())):
            reader.SetFileName(str(folder / f"curved{num_nodes}.{name}"))
            reader.Update()
            near(vtk_volume(reader.GetOutputDataObject(0), num_nodes), samples["curved"]["volume"])


def read_exodus(folder, samples):
    from vtkmodules.vtkIOExodus import vtkExodusIIReader

    reader = vtkExodusIIReader()
    reader.SetFileName(str(folder / "curved20.exodus"))
    reader.UpdateInformation()
    for kind in (reader.ELEM_BLOCK, reader.NODE_SET):
        for i in range(reader.GetNumberOfObjects(kind)):
            reader.SetObjectStatus(kind, i, 1)
    reader.Update()
    output = reader.GetOutput()
    total, nodes = 0.0, {}
    for b in range(output.GetNumberOfBlocks()):
        group = output.GetBlock(b)
        for i in range(group.GetNumberOfBlocks() if group else 0):
            grid = group.GetBlock(i)
            if grid and grid.GetCell(0).GetCellDimension() == 3:
                total += vtk_volume(grid, 20)
            elif grid and grid.GetCell(0).GetCellDimension() == 0:
                nodes[group.GetMetaData(i).Get(output.NAME())] = grid.GetNumberOfCells()
    near(total, samples["curved"]["volume"], 1e-7)  # the reader has single precision
    assert nodes["rim"] == 3, nodes  # two ends and the node between them


def read_vtkhdf(folder, samples):
    from vtkmodules.vtkIOHDF import vtkHDFReader

    for num_nodes in (20, 27):
        reader = vtkHDFReader()
        reader.SetFileName(str(folder / f"curved{num_nodes}.vtkhdf"))
        reader.Update()
        output = reader.GetOutputDataObject(0)
        grids = {output.GetMetaData(i).Get(output.NAME()): output.GetPartition(i, 0)
                 for i in range(output.GetNumberOfPartitionedDataSets())}
        near(sum(vtk_volume(grid, num_nodes) for grid in grids.values()), samples["curved"]["volume"])
        assert grids["rim"].GetNumberOfPoints() == 3  # two ends and the node between them


def read_cgns(folder, samples):
    from vtkmodules.vtkIOCGNSReader import vtkCGNSReader

    for num_nodes in (20, 27):
        reader = vtkCGNSReader()
        reader.SetFileName(str(folder / f"curved{num_nodes}.cgns"))
        reader.UpdateInformation()
        reader.EnableAllBases()
        reader.Update()
        near(vtk_volume(reader.GetOutput().GetBlock(0).GetBlock(0), num_nodes), samples["curved"]["volume"])


def serendipity(x, y):
    """Shape functions of a quad of 8 nodes on [-1, 1]^2."""
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    return ([(1 + x * a) * (1 + y * b) * (x * a + y * b - 1) / 4 for a, b in corners] +
            [(1 - x * x) * (1 - y) / 2, (1 - y * y) * (1 + x) / 2, (1 - x * x) * (1 + y) / 2, (1 - y * y) * (1 - x) / 2])


def flux(points):
    """Of the place through a curved quad of 8 nodes: three times the volume of the cone to the origin."""
    def at(x, y):
        return [sum(w * p[axis] for w, p in zip(serendipity(x, y), points)) for axis in range(3)]

    def slope(one, other):  # exact: of second degree along a line
        return [a - b for a, b in zip(one, other)]

    total, h = 0.0, 0.5
    for u, wu in GAUSS:
        for v, wv in GAUSS:
            x, y = 2 * u - 1, 2 * v - 1
            total += 4 * wu * wv * determinant(at(x, y), slope(at(x + h, y), at(x - h, y)), slope(at(x, y + h), at(x, y - h)))
    return total


def read_med(folder, samples):
    """By MEDCoupling: its measure of such hexes takes the corners alone, but it knows which nodes its faces have."""
    import medcoupling

    mesh = medcoupling.ReadUMeshFromFile(str(folder / "curved20.med"), 0)
    assert mesh.getNumberOfCells() == samples["hexes"]
    points = mesh.getCoords().getValuesAsTuple()
    total = 0.0
    for c in range(mesh.getNumberOfCells()):
        faces = mesh[c].buildDescendingConnectivity()[0]
        faces = [faces.getNodeIdsOfCell(f) for f in range(faces.getNumberOfCells())]
        assert [len(face) for face in faces] == 6 * [8], faces
        total += sum(flux([points[v] for v in face]) for face in faces) / 3
    near(total, samples["curved"]["volume"])


def read_gmsh(folder, samples):
    import gmsh

    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    for num_nodes in (20, 27):
        for name in ("gmsh", "gmsh2"):
            path = folder / f"{name}_{num_nodes}.msh"
            shutil.copy(folder / f"curved{num_nodes}.{name}", path)
            gmsh.open(str(path))
            (kind,) = gmsh.model.mesh.getElementTypes(3)
            assert gmsh.model.mesh.getElementProperties(kind)[3] == num_nodes
            points, weights = gmsh.model.mesh.getIntegrationPoints(kind, "Gauss8")
            _, found, _ = gmsh.model.mesh.getJacobians(kind, points)
            near(sum(w * found[i] for i, w in enumerate(list(weights) * (len(found) // len(weights)))),
                 samples["curved"]["volume"])
            assert [gmsh.model.mesh.getElementProperties(k)[3] for k in gmsh.model.mesh.getElementTypes(1)] == [3]
            gmsh.clear()
    gmsh.finalize()


def read_mfem(folder, samples):
    import mfem.ser as mfem

    mesh = mfem.Mesh(str(folder / "curved27.mfem"), 1, 1)
    rule = mfem.IntRules.Get(mfem.Geometry.CUBE, 8)
    total = 0.0
    for e in range(mesh.GetNE()):
        map_of = mesh.GetElementTransformation(e)
        for i in range(rule.GetNPoints()):
            point = rule.IntPoint(i)
            map_of.SetIntPoint(point)
            total += point.weight * map_of.Weight()
    near(total, samples["curved"]["volume"])


def check_middles(point, element, edges):
    """Each node of an edge lies by the middle of its corners."""
    for node, (a, b) in enumerate(edges, 8):
        middle = [0.5 * (x + y) for x, y in zip(point[element[a]], point[element[b]])]
        off = max(abs(x - y) for x, y in zip(middle, point[element[node]]))
        assert off < 0.06, (node, off)


BOTTOM, TOP = [(0, 1), (1, 2), (2, 3), (3, 0)], [(4, 5), (5, 6), (6, 7), (7, 4)]
UPRIGHT = [(0, 4), (1, 5), (2, 6), (3, 7)]


def read_nastran(folder, samples):
    import numpy

    if not hasattr(numpy, "in1d"):  # removed by newer numpy, still used by the reader
        numpy.in1d = numpy.isin
    from pyNastran.bdf.bdf import BDF

    model = BDF(debug=False)
    model.read_bdf(str(folder / "curved20.nastran"), xref=False)
    point = {n: [float(x) for x in node.xyz] for n, node in model.nodes.items()}
    assert len(model.elements) == samples["hexes"]
    for element in model.elements.values():
        assert element.type == "CHEXA" and len(element.node_ids) == 20
        check_middles(point, element.node_ids, BOTTOM + UPRIGHT + TOP)


def read_ansys(folder, samples):
    from mapdl_archive import Archive

    path = folder / "curved20.cdb"
    shutil.copy(folder / "curved20.ansys", path)
    archive = Archive(str(path), parse_vtk=False)
    point = {int(n): list(p) for n, p in zip(archive.nnum, archive.nodes[:, :3])}
    assert len(archive.elem) == samples["hexes"]
    for element in archive.elem:
        nodes = [int(n) for n in element[10:]]
        assert len(nodes) == 20, nodes
        check_middles(point, nodes, BOTTOM + TOP + UPRIGHT)


def read_calculix(folder, samples):
    text = (folder / "curved20.abaqus").read_text()
    text += "*MATERIAL, NAME=M\n*ELASTIC\n1., 0.3\n*SOLID SECTION, ELSET=EALL, MATERIAL=M\n*STEP\n*STATIC\n"
    text += "*BOUNDARY\nCORNERS, 1, 3\nRIM, 1, 3\n*EL PRINT, ELSET=EALL, TOTALS=ONLY\nEVOL\n*END STEP\n"
    (folder / "case.inp").write_text(text)
    run = subprocess.run(["ccx", "case"], cwd=folder, capture_output=True, text=True, check=False)
    output = run.stdout + run.stderr
    assert run.returncode == 0 and "*ERROR" not in output and "*WARNING" not in output, output[-3000:]
    (volume,) = [float(line) for line in (folder / "case.dat").read_text().splitlines()
                 if len(line.split()) == 1 and line.split()[0][0].isdigit()]
    assert abs(volume - samples["curved"]["volume"]) < 1e-4, volume


READERS = {
    "vtkmodules": ("module", read_vtk),
    "vtkmodules.vtkIOExodus": ("module", read_exodus),
    "vtkmodules.vtkIOHDF": ("module", read_vtkhdf),
    "vtkmodules.vtkIOCGNSReader": ("module", read_cgns),
    "medcoupling": ("module", read_med),
    "gmsh": ("module", read_gmsh),
    "mfem": ("module", read_mfem),
    "pyNastran": ("module", read_nastran),
    "mapdl_archive": ("module", read_ansys),
    "ccx": ("program", read_calculix),
}


if __name__ == "__main__":
    sys.exit(foreign_reader.run(READERS, "finds the curved elements as they were written"))
