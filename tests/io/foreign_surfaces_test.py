#!/usr/bin/env python3
"""Reads surfaces that other programs write: the names of their parts arrive.

Usage: foreign_surfaces_test.py WRITER HEXWRIGHT_PROGRAM, with one of WRITERS below. Exit code 77 (skipped) when the writer
is not installed; scripts/setup unpacks the Python modules under build/deps. Each writes a box of 2 x 1 x 1 whose side
x = 0 is the inlet, x = 2 the outlet and all else the wall. `hexwright inspect` says what was read.
"""
import json
import subprocess
import sys

import foreign_reader

CORNERS = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 2)]
QUADS = {"inlet": [(0, 4, 6, 2)], "outlet": [(1, 3, 7, 5)],
         "wall": [(0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]}
NAMES = {"inlet", "outlet", "wall"}


class Checker:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def expect(self, path, names=NAMES, volume=2):
        run = subprocess.run([self.program, "inspect", path, "--json", "-q"], capture_output=True, text=True, check=False)
        assert run.returncode == 0, (path, run.stdout, run.stderr)
        said = json.loads(run.stdout)
        assert {entry["name"] for entry in said["names"]} == set(names), (path, said["names"])
        assert abs(said["volume"] - volume) < 1e-6 and said["open_edges"] == 0, said
        assert not said["warnings"], said["warnings"]


def write_by_vtk(check):
    """Polygons in all encodings, with the numbers as cell data, and their names as field data."""
    from vtkmodules.vtkCommonCore import vtkIntArray, vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkFiltersCore import vtkStripper, vtkTriangleFilter
    from vtkmodules.vtkIOLegacy import vtkPolyDataWriter
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

    points, cells, label = vtkPoints(), vtkCellArray(), vtkIntArray()
    for point in CORNERS:
        points.InsertNextPoint(point)
    label.SetName("patch")
    data = vtkPolyData()
    for number, (name, quads) in enumerate(QUADS.items(), 3):
        for quad in quads:
            cells.InsertNextCell(4, quad)
            label.InsertNextValue(number)
        array = vtkIntArray()
        array.SetName(name)
        array.InsertNextValue(number)
        array.InsertNextValue(2)
        data.GetFieldData().AddArray(array)
    data.SetPoints(points)
    data.SetPolys(cells)
    data.GetCellData().AddArray(label)
    for mode in ("Ascii", "Binary", "Appended"):
        writer = vtkXMLPolyDataWriter()
        writer.SetInputData(data)
        writer.SetFileName(str(check.folder / "box.vtp"))
        getattr(writer, f"SetDataModeTo{mode}")()
        writer.Write()
        check.expect(check.folder / "box.vtp")
    for version in (42, 51):
        for file_type in (1, 2):  # text, binary
            writer = vtkPolyDataWriter()
            writer.SetInputData(data)
            writer.SetFileName(str(check.folder / "box.vtk"))
            writer.SetFileVersion(version)
            writer.SetFileType(file_type)
            writer.Write()
            check.expect(check.folder / "box.vtk")
    triangles, strips = vtkTriangleFilter(), vtkStripper()
    data.GetCellData().Initialize()
    triangles.SetInputData(data)
    strips.SetInputConnection(triangles.GetOutputPort())
    strips.Update()
    assert strips.GetOutput().GetNumberOfStrips() > 0
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(strips.GetOutput())
    writer.SetFileName(str(check.folder / "strips.vtp"))
    writer.Write()
    check.expect(check.folder / "strips.vtp", names=())


def write_by_gmsh(check):
    """Physical surfaces, and elementary ones where there are none; Nastran files have the numbers alone."""
    import gmsh

    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.model.occ.addBox(0, 0, 0, 2, 1, 1)
    gmsh.model.occ.synchronize()

    def write(name, *names):
        gmsh.write(str(check.folder / name))
        check.expect(check.folder / name, *names)

    for order in (1, 2):
        gmsh.model.mesh.generate(2)
        gmsh.model.mesh.setOrder(order)
        for version in (2.2, 4.1):
            gmsh.option.setNumber("Mesh.MshFileVersion", version)
            write("box.msh", {f"surface_{k}" for k in range(1, 7)})
        gmsh.model.mesh.clear()
    for number, (name, members) in enumerate({"inlet": [1], "outlet": [2], "wall": [3, 4, 5, 6]}.items(), 7):
        gmsh.model.addPhysicalGroup(2, members, number, name)
    gmsh.model.mesh.generate(2)
    for version in (2.2, 4.1):
        gmsh.option.setNumber("Mesh.MshFileVersion", version)
        write("box.msh")
    gmsh.option.setNumber("Mesh.SaveElementTagType", 2)
    for field_format in (0, 1, 2):  # free, small, large
        gmsh.option.setNumber("Mesh.BdfFieldFormat", field_format)
        write("box.bdf", {"property_7", "property_8", "property_9"})
    gmsh.finalize()


def write_by_pynastran(check):
    """Properties with the comments that name them, in fields of 8 and of 16 characters."""
    import numpy

    if not hasattr(numpy, "in1d"):  # removed by newer numpy, still used by the writer
        numpy.in1d = numpy.isin
    from pyNastran.bdf.bdf import BDF

    model, element = BDF(debug=False), 1
    for number, point in enumerate(CORNERS, 1):
        model.add_grid(number, [float(x) for x in point])
    model.add_mat1(1, 1.0, None, 0.3)
    for number, (name, quads) in enumerate(QUADS.items(), 5):
        model.add_pshell(number, mid1=1, t=0.1, comment=f"$ Femap Property {number} : {name}")
        for quad in quads:
            a, b, c, d = (v + 1 for v in quad)
            if name == "inlet":
                model.add_ctria3(element, number, [a, b, c])
                model.add_ctria3(element + 1, number, [a, c, d])
            else:
                model.add_cquad4(element, number, [a, b, c, d])
            element += 2
    for size, is_double in ((8, False), (16, False), (16, True)):
        model.write_bdf(str(check.folder / "box.bdf"), size=size, is_double=is_double, enddata=True)
        check.expect(check.folder / "box.bdf")


def write_by_lib3mf(check):
    """Three cubes: two objects by name, one of them built twice, mirrored and shifted, and one of components."""
    import lib3mf

    wrapper = lib3mf.get_wrapper() if hasattr(lib3mf, "get_wrapper") else lib3mf.Wrapper()
    model = wrapper.CreateModel()

    def cube(name):
        mesh = model.AddMeshObject()
        mesh.SetName(name)
        for point in CORNERS:
            position = lib3mf.Position()
            position.Coordinates[:] = point
            mesh.AddVertex(position)
        for a, b, c, d in [quad for quads in QUADS.values() for quad in quads]:
            for corners in ((a, b, c), (a, c, d)):
                triangle = lib3mf.Triangle()
                triangle.Indices[:] = corners
                mesh.AddTriangle(triangle)
        return mesh

    def transform(x_scale, shift):
        result = wrapper.GetIdentityTransform()
        result.Fields[0][0] = x_scale
        result.Fields[3][0] = shift
        return result

    bolt, plate = cube("bolt"), cube("plate")
    both = model.AddComponentsObject()
    both.SetName("assembly")
    both.AddComponent(plate, transform(1, 20))
    unnamed = cube("")
    both.AddComponent(unnamed, transform(1, 30))
    model.AddBuildItem(bolt, transform(1, 0))
    model.AddBuildItem(bolt, transform(-1, 10))
    model.AddBuildItem(both, transform(1, 100))
    path = check.folder / "parts.3mf"
    model.QueryWriter("3mf").WriteToFile(str(path))
    check.expect(path, {"bolt", "plate", "assembly"}, 8)
    cut = check.folder / "cut.3mf"
    cut.write_bytes(path.read_bytes()[:-40])
    run = subprocess.run([check.program, "inspect", cut], capture_output=True, text=True, check=False)
    assert run.returncode not in (0, 1) and "has no directory" in run.stderr, run.stderr


WRITERS = {"vtkmodules": write_by_vtk, "gmsh": write_by_gmsh, "pyNastran": write_by_pynastran, "lib3mf": write_by_lib3mf}


def main():
    return foreign_reader.run_writers(lambda writer, *where: WRITERS[writer](Checker(*where)),
                                      "the surfaces that {} writes are read with their names")


if __name__ == "__main__":
    sys.exit(main())
