#!/usr/bin/env python3
"""Opens files written by hexwright with the readers of VTK and meshio.

Usage: foreign_readers_test.py vtkmodules|meshio WRITE_SAMPLES_PROGRAM
Exit code 77 (skipped) when the module is not installed; scripts/setup unpacks both under build/deps. Of VTK only the
modules that read files are loaded: the rest would need a display's libraries.
"""
import sys

import foreign_reader


def read_vtk(reader, path):
    reader.SetFileName(str(path))
    if hasattr(reader, "ReadAllFieldsOn"):
        reader.ReadAllFieldsOn()
    reader.Update()
    return reader.GetOutputDataObject(0)


def check_vtk_mesh(grid, samples, has_sets):
    sets = samples["quads"] + samples["edges"] + samples["corners"] if has_sets else 0
    assert grid.GetNumberOfPoints() == samples["verts"]
    assert grid.GetNumberOfCells() == samples["hexes"] + sets
    assert all(grid.GetCellType(c) == 12 for c in range(samples["hexes"]))
    for name in ("region", "quality") + (("patch", "curve") if has_sets else ()):
        assert grid.GetCellData().HasArray(name), name
    assert grid.GetPointData().HasArray("feature")
    fields = grid.GetFieldData()
    assert fields.GetArray("boundary_quads").GetNumberOfTuples() == samples["quads"]
    assert fields.GetArray("boundary_quad_patch").GetNumberOfTuples() == samples["quads"]
    assert fields.GetArray("feature_edges").GetNumberOfTuples() == samples["edges"]
    assert fields.GetArray("corners").GetNumberOfTuples() == samples["corners"]


def check_vtk_htg(tree_grid, samples):
    """Walks VTK's trees and compares centre and level of every leaf."""
    from vtkmodules.vtkCommonDataModel import vtkHyperTreeGridNonOrientedGeometryCursor

    levels = tree_grid.GetCellData().GetArray("level")
    leaves = []
    cursor = vtkHyperTreeGridNonOrientedGeometryCursor()

    def visit():
        if cursor.IsLeaf():
            box = [0.0] * 6
            cursor.GetBounds(box)
            centre = [(box[0] + box[1]) / 2, (box[2] + box[3]) / 2, (box[4] + box[5]) / 2]
            level = cursor.GetLevel()
            assert levels.GetValue(cursor.GetGlobalNodeIndex()) == level
            leaves.append([round(x, 9) for x in centre] + [level])
            return
        for child in range(8):
            cursor.ToChild(child)
            visit()
            cursor.ToParent()

    trees = 0
    for index in range(tree_grid.GetMaxNumberOfTrees()):
        if tree_grid.GetTree(index) is None:
            continue
        trees += 1
        tree_grid.InitializeNonOrientedGeometryCursor(cursor, index)
        visit()
    assert trees == 8, trees
    expected = sorted([round(x, 9) for x in leaf[:3]] + [leaf[3]] for leaf in samples["leaves"])
    assert sorted(leaves) == expected
    assert tree_grid.GetNumberOfLeaves() == len(expected)


def run_vtk(folder, samples):
    from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader
    from vtkmodules.vtkIOXML import vtkXMLHyperTreeGridReader, vtkXMLUnstructuredGridReader

    check_vtk_mesh(read_vtk(vtkXMLUnstructuredGridReader(), folder / "box.vtu"), samples, False)
    check_vtk_mesh(read_vtk(vtkXMLUnstructuredGridReader(), folder / "sets.vtu"), samples, True)
    check_vtk_mesh(read_vtk(vtkUnstructuredGridReader(), folder / "box.vtk"), samples, False)
    check_vtk_mesh(read_vtk(vtkUnstructuredGridReader(), folder / "sets.vtk"), samples, True)
    check_vtk_htg(read_vtk(vtkXMLHyperTreeGridReader(), folder / "grid.htg"), samples)
    grid = read_vtk(vtkXMLUnstructuredGridReader(), folder / "grid.vtu")
    assert grid.GetNumberOfCells() == len(samples["leaves"])


def run_meshio(folder, samples):
    import meshio

    reference = meshio.read(folder / "box.vtu")
    # None: meshio has none of these, reads only its own layout (CGNS), or keeps the order of MED's nodes, which is not VTK's;
    # MEDCoupling and cgnscheck read these two in foreign_sets_test.py.
    formats = {".msh2": "gmsh", ".mfem": None, ".exo": None, ".cdb": None, ".k": None, ".cgns": None, ".med": None,
               ".vtkhdf": None}
    for extension in samples["extensions"]:
        if formats.get(extension, extension) is None:
            continue
        mesh = meshio.read(folder / ("box" + extension), file_format=formats.get(extension))
        cells = mesh.cells_dict
        assert cells["hexahedron"].shape == (samples["hexes"], 8), extension
        assert abs(mesh.points - reference.points).max() < 1e-6, extension
        # Regions are blocks of their own in some formats, so the order of the hexes may differ.
        assert sorted(map(tuple, cells["hexahedron"])) == sorted(
            map(tuple, reference.cells_dict["hexahedron"])), extension
        if extension in (".mesh", ".msh", ".msh2"):
            assert cells["quad"].shape == (samples["quads"], 4), extension
            assert cells["line"].shape == (samples["edges"], 2), extension
    gmsh = meshio.read(folder / "box.msh")
    names = set(gmsh.field_data)
    assert {"REGION_0", "REGION_1", "REGION_2", "PATCH_0", "PATCH_5", "PATCH_NONE", "CURVE_0",
            "CURVE_NONE", "CORNERS"} <= names, names
    abaqus = meshio.read(folder / "box.inp")
    assert {"CORNERS", "CURVE_0", "PATCH_0_NODES"} <= set(abaqus.point_sets), abaqus.point_sets
    assert len(abaqus.point_sets["CORNERS"]) == samples["corners"]


READERS = {"vtkmodules": ("module", run_vtk), "meshio": ("module", run_meshio)}


if __name__ == "__main__":
    sys.exit(foreign_reader.run(READERS, "reads everything as it was written"))
