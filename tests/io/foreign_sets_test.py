#!/usr/bin/env python3
"""Opens a mesh with named sets, written in every format, with other programs' readers.

Usage: foreign_sets_test.py READER WRITE_SAMPLES_PROGRAM, with one of the readers of READERS below. Exit code 77 (skipped)
when the reader is not installed; scripts/setup unpacks the Python modules under build/deps. Judged are, for every set with
its name: the volume of each hex of a region (all are unit cubes, so a wrong order of nodes shows), the area and the
direction of each face of a patch, and the places of the nodes of patches, curves and corners.
"""
import shutil
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

import foreign_reader

sys.path.append(str(Path(__file__).parents[1] / "solver"))
import openfoam  # noqa: E402


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def centre(points):
    return [sum(axis) / len(points) for axis in zip(*points)]


def hex_volume(p):
    """Of a cube whose nodes are bottom 0-3, counter-clockwise seen from the top 4-7; by the faces, so that any other
    order gives another number."""
    faces = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    return sum(dot(centre([p[i] for i in f]), cross(sub(p[f[2]], p[f[0]]), sub(p[f[3]], p[f[1]]))) / 6 for f in faces)


class Found:
    """What a reader found; a kind that stays None is not judged."""

    def __init__(self):
        self.regions = defaultdict(list)  # name -> hexes, each 8 points
        self.patches = None  # name -> quads, each 4 points
        self.nodes = None  # name -> points


class Judge:
    def __init__(self, samples, format_name):
        self.expected = samples["named"]
        self.names = samples["written_names"].get(format_name) or {}
        self.format = format_name

    def written(self, name):
        return self.names.get(name, name)

    def check(self, found, node_kinds=("patches", "groups", "curves", "corners"), groups=False, outward=True):
        self.check_regions(found)
        if found.patches is not None:
            self.check_patches(found, groups, outward)
        if found.nodes is not None:
            for kind in node_kinds:
                for name, entry in self.expected[kind].items():
                    self.check_points(self.written(name), entry["points"], found.nodes)

    def check_regions(self, found):
        for name, entry in self.expected["regions"].items():
            hexes = found.regions[self.written(name)]
            assert len(hexes) == entry["elements"], (self.format, name, len(hexes), list(found.regions))
            for points in hexes:
                assert abs(hex_volume(points) - 1) < 1e-5, (self.format, name, hex_volume(points))

    def check_patches(self, found, groups, outward):
        middle = centre([p for entry in self.expected["regions"].values() for p in entry["points"]])
        wanted = dict(self.expected["patches"])
        if groups:
            wanted.update(self.expected["groups"])
        for name, entry in wanted.items():
            quads = found.patches.get(self.written(name), [])
            assert len(quads) == entry["elements"], (self.format, name, len(quads), list(found.patches))
            for q in quads:
                normal = [x / 2 for x in cross(sub(q[2], q[0]), sub(q[3], q[1]))]
                assert abs(dot(normal, normal) - 1) < 1e-5, (self.format, name, normal)
                assert not outward or dot(normal, sub(centre(q), middle)) > 0, (self.format, name, "looks inwards")
            points = {tuple(round(x, 5) for x in p) for q in quads for p in q}
            assert points == {tuple(round(x, 5) for x in p) for p in entry["points"]}, (self.format, name)

    def check_points(self, name, points, nodes):
        def rounded(list_of_points):
            return sorted(tuple(round(float(x), 5) + 0.0 for x in p) for p in list_of_points)

        assert name in nodes, (self.format, name, list(nodes))
        assert rounded(nodes[name]) == rounded(points), (self.format, name)


def read_meshio(folder, samples):
    import meshio

    for name in ("gmsh", "gmsh2"):
        mesh = meshio.read(folder / ("named." + name), file_format="gmsh")
        found = Found()
        found.patches = defaultdict(list)
        groups = {(int(tag), int(dim)): group for group, (tag, dim) in mesh.field_data.items()}
        for block, tags in zip(mesh.cells, mesh.cell_data["gmsh:physical"]):
            for cell, tag in zip(block.data, tags):
                points = [list(mesh.points[v]) for v in cell]
                if block.type == "hexahedron":
                    found.regions[groups[int(tag), 3]].append(points)
                elif block.type == "quad":
                    found.patches[groups[int(tag), 2]].append(points)
        Judge(samples, name).check(found)
    mesh = meshio.read(folder / "named.abaqus", file_format="abaqus")
    found = Found()
    found.nodes = {name: [mesh.points[v] for v in nodes] for name, nodes in mesh.point_sets.items()}
    for name, sets in mesh.cell_sets.items():
        for block, members in zip(mesh.cells, sets):
            found.regions[name] += [[list(mesh.points[v]) for v in block.data[i]] for i in (members if members is not None else [])]
    suffixed = {name: found.nodes.get(name + "_NODES", found.nodes.get(name)) for name in
                [n.removesuffix("_NODES") for n in found.nodes]}
    found.nodes = suffixed
    Judge(samples, "abaqus").check(found)
    mesh = meshio.read(folder / "named.su2", file_format="su2")
    assert len(mesh.cells_dict["hexahedron"]) == sum(e["elements"] for e in samples["named"]["regions"].values())
    assert len(mesh.cells_dict["quad"]) == sum(e["elements"] for e in samples["named"]["patches"].values())
    read_meshio_vtu(meshio.read(folder / "named.vtu", file_format="vtu"), samples)


def read_meshio_vtu(mesh, samples):
    """Sets as cells, and their names as Gmsh's physical groups. (Of legacy VTK, meshio drops the field data.)"""
    found = Found()
    found.patches = defaultdict(list)
    number_name = {}
    for key, value in mesh.field_data.items():
        if value.size == 2:
            number_name[tuple(int(x) for x in value.ravel())] = key
    for b, block in enumerate(mesh.cells):
        for i, cell in enumerate(block.data):
            points = [list(mesh.points[v]) for v in cell]
            if block.type == "hexahedron":
                r = int(mesh.cell_data["region"][b].ravel()[i])
                found.regions[number_name.get((r, 3), f"REGION_{r}")].append(points)
            elif block.type == "quad":
                p = int(mesh.cell_data["patch"][b].ravel()[i])
                found.patches[number_name.get((p, 2), f"PATCH_{p}")].append(points)
    Judge(samples, "vtu").check(found)


def read_vtk(folder, samples):
    from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

    for name, reader in (("vtu", vtkXMLUnstructuredGridReader()), ("vtk", vtkUnstructuredGridReader())):
        reader.SetFileName(str(folder / ("named." + name)))
        if hasattr(reader, "ReadAllFieldsOn"):
            reader.ReadAllFieldsOn()
        reader.Update()
        grid = reader.GetOutputDataObject(0)
        fields = grid.GetFieldData()
        number_name = {}
        for a in range(fields.GetNumberOfArrays()):
            array = fields.GetArray(a)
            if array.GetNumberOfTuples() * array.GetNumberOfComponents() == 2:
                number_name[int(array.GetValue(0)), int(array.GetValue(1))] = array.GetName()
        found = Found()
        found.patches = defaultdict(list)
        for c in range(grid.GetNumberOfCells()):
            cell = grid.GetCell(c)
            points = [list(cell.GetPoints().GetPoint(k)) for k in range(cell.GetNumberOfPoints())]
            if grid.GetCellType(c) == 12:
                r = int(grid.GetCellData().GetArray("region").GetValue(c))
                found.regions[number_name.get((r, 3), f"REGION_{r}")].append(points)
            elif grid.GetCellType(c) == 9:
                p = int(grid.GetCellData().GetArray("patch").GetValue(c))
                found.patches[number_name.get((p, 2), f"PATCH_{p}")].append(points)
        Judge(samples, name).check(found)


def read_exodus(folder, samples):
    """By VTK's reader, which is built on the Exodus library itself."""
    from vtkmodules.vtkIOExodus import vtkExodusIIReader

    reader = vtkExodusIIReader()
    reader.SetFileName(str(folder / "named.exodus"))
    reader.UpdateInformation()
    kinds = {"regions": reader.ELEM_BLOCK, "patches": reader.SIDE_SET, "nodes": reader.NODE_SET}
    for kind in kinds.values():
        for i in range(reader.GetNumberOfObjects(kind)):
            reader.SetObjectStatus(kind, i, 1)
    reader.Update()
    output = reader.GetOutput()
    found = Found()
    found.patches, found.nodes = defaultdict(list), {}
    for b in range(output.GetNumberOfBlocks()):
        group = output.GetBlock(b)
        for i in range(group.GetNumberOfBlocks() if group else 0):
            grid = group.GetBlock(i)
            name = group.GetMetaData(i).Get(output.NAME()) if grid else None
            if not grid:
                continue
            cells = [[list(grid.GetPoint(grid.GetCell(c).GetPointId(k))) for k in range(grid.GetCell(c).GetNumberOfPoints())]
                     for c in range(grid.GetNumberOfCells())]
            size = len(cells[0])
            if size == 8:
                found.regions[name] = cells
            elif size == 4:
                found.patches[name] = cells
            else:
                found.nodes[name] = [cell[0] for cell in cells]
    Judge(samples, "exodus").check(found, groups=True)


def read_gmsh(folder, samples):
    import gmsh

    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    for name in ("gmsh", "gmsh2"):
        path = folder / (name + ".msh")
        shutil.copy(folder / ("named." + name), path)
        gmsh.open(str(path))
        tags, coords, _ = gmsh.model.mesh.getNodes()
        point = {int(t): list(coords[3 * i:3 * i + 3]) for i, t in enumerate(tags)}
        found = Found()
        found.patches = defaultdict(list)
        found.nodes = {}
        for dim, tag in gmsh.model.getPhysicalGroups():
            group = gmsh.model.getPhysicalName(dim, tag)
            nodes = set()
            for entity in gmsh.model.getEntitiesForPhysicalGroup(dim, tag):
                types, _, verts = gmsh.model.mesh.getElements(dim, entity)
                for element_type, flat in zip(types, verts):
                    size = {15: 1, 1: 2, 3: 4, 5: 8}[int(element_type)]
                    for i in range(0, len(flat), size):
                        cell = [point[int(v)] for v in flat[i:i + size]]
                        nodes.update(int(v) for v in flat[i:i + size])
                        if dim == 3:
                            found.regions[group].append(cell)
                        elif dim == 2:
                            found.patches[group].append(cell)
            found.nodes[group] = [point[v] for v in nodes]
        kinds = ("patches", "curves", "corners") + (("groups",) if name == "gmsh" else ())
        Judge(samples, name).check(found, node_kinds=kinds, groups=name == "gmsh")
        gmsh.clear()
    gmsh.finalize()


def read_mfem(folder, samples):
    import mfem.ser as mfem

    mesh = mfem.Mesh(str(folder / "named.mfem"))
    assert mesh.GetNE() == sum(e["elements"] for e in samples["named"]["regions"].values())
    verts = [list(mesh.GetVertexArray(v)) for v in range(mesh.GetNV())]
    for e in range(mesh.GetNE()):
        assert abs(mesh.GetElementVolume(e) - 1) < 1e-5
    found = Found()
    found.patches = defaultdict(list)
    regions, patches = read_mfem_names(folder / "named.mfem")
    for e in range(mesh.GetNE()):
        for name, attributes in regions.items():
            if mesh.GetAttribute(e) in attributes:
                found.regions[name].append([verts[v] for v in mesh.GetElementVertices(e)])
    for b in range(mesh.GetNBE()):
        for name, attributes in patches.items():
            if mesh.GetBdrAttribute(b) in attributes:
                found.patches[name].append([verts[v] for v in mesh.GetBdrElementVertices(b)])
    Judge(samples, "mfem").check(found, groups=True)


def read_mfem_names(path):
    """The library's Python interface does not give the sets: they are read from the text beside it."""
    lines = path.read_text().splitlines()

    def section(title):
        at = lines.index(title)
        sets = {}
        for line in lines[at + 2:at + 2 + int(lines[at + 1])]:
            name, numbers = line.rsplit('"', 1)
            sets[name[1:]] = [int(n) for n in numbers.split()[1:]]
        return sets

    return section("attribute_sets"), section("bdr_attribute_sets")


def read_nastran(folder, samples):
    import numpy

    if not hasattr(numpy, "in1d"):  # removed by newer numpy, still used by the reader
        numpy.in1d = numpy.isin
    from pyNastran.bdf.bdf import BDF

    model = BDF(debug=False)
    model.read_bdf(str(folder / "named.nastran"), xref=False)
    point = {n: [float(x) for x in node.xyz] for n, node in model.nodes.items()}
    names = {}
    for line in (folder / "named.nastran").read_text().splitlines():
        words = line.split(maxsplit=3)
        if line.startswith("$") and len(words) == 4:
            names[words[1], int(words[2])] = words[3]
    found = Found()
    found.nodes = {}
    for element in model.elements.values():
        assert element.type == "CHEXA"
        found.regions[names["region", element.pid]].append([point[n] for n in element.node_ids])
    for number, card in model.sets.items():
        found.nodes[names["set", number]] = [point[n] for n in card.ids]
    Judge(samples, "nastran").check(found)
    count_bsurfs(folder / "named.nastran", samples, names, model, point)


def count_bsurfs(path, samples, names, model, point):
    """Faces of BSURFS by their three grid points; the reader keeps the card as text in some versions."""
    cards, current = [], None
    for line in path.read_text().splitlines():
        fields = [line[i:i + 8].strip() for i in range(8, min(len(line), 72), 8)]
        if line.startswith("BSURFS"):
            current = fields
            cards.append(current)
        elif line.startswith("+") and current is not None:
            current += fields
        else:
            current = None
    found = Found()
    found.regions = None
    found.patches = defaultdict(list)
    for card in cards:
        entries = card[4:]
        for i in range(0, len(entries), 4):
            hex_points = [point[n] for n in model.elements[int(entries[i])].node_ids]
            a, b, c = (point[int(n)] for n in entries[i + 1:i + 4])
            d = [x + y - z for x, y, z in zip(a, c, b)]
            assert min(max(abs(x) for x in sub(d, p)) for p in hex_points) < 1e-5, "not a face of the element"
            found.patches[names["patch", int(card[0])]].append([a, b, c, d])
    judge = Judge(samples, "nastran")
    judge.check_patches(found, True, True)


def read_ansys(folder, samples):
    from mapdl_archive import Archive

    shutil.copy(folder / "named.ansys", folder / "named.cdb")
    archive = Archive(str(folder / "named.cdb"), parse_vtk=False)
    point = {int(n): list(map(float, p[:3])) for n, p in zip(archive.nnum, archive.nodes)}
    element = {int(number): [point[int(n)] for n in row[10:18]] for number, row in zip(archive.enum, archive.elem)}
    found = Found()
    found.nodes = {}
    for name, members in archive.element_components.items():
        found.regions[name] = [element[int(e)] for e in members]
    for name, members in archive.node_components.items():
        found.nodes[name] = [point[int(n)] for n in members]
    Judge(samples, "ansys").check(found)


def read_lsdyna(folder, samples):
    import lsdyna_mesh_reader

    deck = lsdyna_mesh_reader.Deck(str(folder / "named.lsdyna"))
    nodes = deck.node_sections[0]
    point = {int(n): list(map(float, p)) for n, p in zip(nodes.nid, nodes.coordinates)}
    text = (folder / "named.lsdyna").read_text().splitlines()
    parts = {}
    for i, line in enumerate(text):
        if line == "*PART":
            parts[int(text[i + 2].split()[0])] = text[i + 1]
    found = Found()
    solids = deck.element_solid_sections[0]
    for pid, row in zip(solids.pid, solids.node_ids.reshape(len(solids), -1)):
        found.regions[parts[int(pid)]].append([point[int(n)] for n in row[:8]])
    found.nodes, found.patches = {}, defaultdict(list)
    for i, line in enumerate(text):  # the reader knows nodes and elements only
        if not line.startswith("*SET_"):
            continue
        end = next(k for k in range(i + 1, len(text)) if text[k].startswith("*"))
        numbers = [[int(row[k:k + 10]) for k in range(0, len(row), 10)] for row in text[i + 3:end]]
        if line.startswith("*SET_SEGMENT"):
            found.patches[text[i + 1]] = [[point[n] for n in row] for row in numbers]
        else:
            found.nodes[text[i + 1]] = [point[n] for row in numbers for n in row]
    Judge(samples, "lsdyna").check(found, groups=True)


def read_checkmesh(folder, samples):
    case = folder / "case"
    (case / "constant").mkdir(parents=True)
    shutil.copytree(folder / "named.openfoam", case / "constant/polyMesh")
    output = openfoam.check_mesh(case, "-allTopology", "-allGeometry")
    assert openfoam.is_content(output), output[-3000:]
    names = samples["written_names"].get("openfoam") or {}
    for kind in ("regions", "patches"):
        for name, entry in samples["named"][kind].items():
            rows = [line.split() for line in output.splitlines() if line.split()[:1] == [names.get(name, name)]]
            count = str(entry["elements"])
            assert any(row[1:2] == [count] for row in rows), (name, count, rows, output[-3000:])
    num_point_zones = len(samples["named"]["curves"]) + len(samples["named"]["corners"])
    assert f"point zones:      {num_point_zones}\n" in output, output[-3000:]
    total = sum(e["elements"] for e in samples["named"]["regions"].values())
    assert f"Total volume = {total}." in output, output[-3000:]


def read_calculix(folder, samples):
    """One step with a load on every patch and a support at every node set: the program knows all sets by name."""
    text = (folder / "named.abaqus").read_text()
    judge = Judge(samples, "abaqus")
    text += "*MATERIAL, NAME=M\n*ELASTIC\n1., 0.3\n*SOLID SECTION, ELSET=EALL, MATERIAL=M\n*STEP\n*STATIC\n*BOUNDARY\n"
    text += "CORNERS, 1, 3\n"
    for name in samples["named"]["curves"]:
        text += f"{judge.written(name)}, 1, 1\n"
    text += "*DSLOAD\n"
    for kind in ("patches", "groups"):
        for name in samples["named"][kind]:
            text += f"{judge.written(name)}, P, 0.001\n"
    text += "*EL PRINT, ELSET=EALL, TOTALS=ONLY\nEVOL\n"
    for name in samples["named"]["regions"]:
        text += f"*EL PRINT, ELSET={judge.written(name)}, TOTALS=ONLY\nEVOL\n"
    (folder / "case.inp").write_text(text + "*END STEP\n")
    run = subprocess.run(["ccx", "case"], cwd=folder, capture_output=True, text=True, check=False)
    output = run.stdout + run.stderr
    assert run.returncode == 0 and "*ERROR" not in output and "*WARNING" not in output, output[-3000:]
    volumes = [float(line.split()[-1]) for line in (folder / "case.dat").read_text().splitlines()
               if len(line.split()) == 1 and line.split()[0][0].isdigit()]
    expected = [entry["elements"] for entry in samples["named"]["regions"].values()]
    expected = [sum(expected)] + expected
    assert len(volumes) == len(expected), (folder / "case.dat").read_text()
    assert all(abs(a - b) < 1e-4 for a, b in zip(volumes, expected)), (volumes, expected)


def cells_of(grid):
    """Of a VTK grid, as lists of points."""
    return [[list(grid.GetPoint(grid.GetCell(c).GetPointId(k))) for k in range(grid.GetCell(c).GetNumberOfPoints())]
            for c in range(grid.GetNumberOfCells())]


def read_vtkhdf(folder, samples):
    """By VTK, which is built on the HDF5 library."""
    import vtkmodules.vtkCommonDataModel  # noqa: F401
    from vtkmodules.vtkIOHDF import vtkHDFReader

    reader = vtkHDFReader()
    reader.SetFileName(str(folder / "named.vtkhdf"))
    reader.Update()
    output = reader.GetOutputDataObject(0)
    found = Found()
    found.patches, found.nodes = {}, {}
    for i in range(output.GetNumberOfPartitionedDataSets()):
        grid, name = output.GetPartition(i, 0), output.GetMetaData(i).Get(output.NAME())
        if len(cells_of(grid)[0]) == 8:
            found.regions[name] = cells_of(grid)
        elif len(cells_of(grid)[0]) == 4:
            found.patches[name] = cells_of(grid)
        found.nodes[name] = [grid.GetPoint(k) for k in range(grid.GetNumberOfPoints())]
    Judge(samples, "vtkhdf").check(found, node_kinds=("patches", "curves", "corners"))


def read_cgns(folder, samples):
    """Its elements by VTK's reader, which is built on the CGNS library, and what that does not give one by one by h5py."""
    from vtkmodules.vtkIOCGNSReader import vtkCGNSReader

    if not foreign_reader.is_installed("module", "h5py"):
        print("'h5py' is not installed: skipped")
        sys.exit(foreign_reader.SKIPPED)
    reader = vtkCGNSReader()
    path = folder / "named.cgns"
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    reader.EnableAllBases()
    reader.EnableAllFamilies()
    reader.Update()
    zone = reader.GetOutput().GetBlock(0).GetBlock(0)
    hexes = cells_of(zone)
    points = [zone.GetPoint(k) for k in range(zone.GetNumberOfPoints())]
    found = Found()
    found.patches, found.nodes = {}, {}
    read_cgns_sets(path, hexes, points, found)
    Judge(samples, "cgns").check(found, node_kinds=("patches", "curves", "corners"))


def read_cgns_sets(path, hexes, points, found):
    """Sections and boundary conditions."""
    import h5py

    with h5py.File(path) as file:
        zone = file["Base/Zone"]
        conditions = zone["ZoneBC"]
        elements = {}
        for name, node in zone.items():
            if node.attrs.get("label") != b"Elements_t":
                continue
            size = {7: 4, 17: 8}[int(node[" data"][0])]
            rows = node["ElementConnectivity/ data"][:].reshape(-1, size) - 1
            first, last = node["ElementRange/ data"][:]
            assert last - first + 1 == len(rows)
            elements.update({first + i: [list(points[v]) for v in row] for i, row in enumerate(rows)})
            if size == 8:
                found.regions[name] = [list(map(list, cell)) for cell in hexes[first - 1:last]]
                assert found.regions[name] == [elements[i] for i in range(first, last + 1)]
        for name, node in conditions.items():
            if node.attrs.get("label") != b"BC_t":
                continue
            assert bytes(node["FamilyName/ data"][:].astype("u1")).decode() == name and name in file["Base"]
            if "PointRange" in node:
                first, last = node["PointRange/ data"][:, 0]
                found.patches[name] = [elements[i] for i in range(first, last + 1)]
                found.nodes[name] = {tuple(p): p for quad in found.patches[name] for p in quad}.values()
            else:
                found.nodes[name] = [points[v - 1] for v in node["PointList/ data"][:, 0]]


def check_cgns(folder, samples):
    for name in ("named.cgns", "curved20.cgns", "curved27.cgns"):
        run = subprocess.run(["cgnscheck", str(folder / name)], capture_output=True, text=True, check=False)
        output = run.stdout + run.stderr
        warnings = [line for line in output.splitlines() if line.startswith("WARNING") and "dataclass" not in line
                    and "not boundary nodes" not in line]  # of curves inside
        assert "checking complete" in output and "ERROR" not in output and not warnings, (name, output[-3000:])


def read_med(folder, samples):
    """By MEDCoupling, which is built on the MED library; measures are signed by the order of the nodes."""
    import medcoupling

    path = folder / "named.med"
    file = medcoupling.MEDFileUMesh(str(path))
    found = Found()
    found.patches, found.nodes = {}, {}
    order = [0, 3, 2, 1, 4, 7, 6, 5]  # from theirs to VTK's, and back
    for level in file.getNonEmptyLevels():
        for name in file.getGroupsOnSpecifiedLev(level):
            group = file.getGroup(level, name)
            points = group.getCoords().getValuesAsTuple()
            cells = [[list(points[v]) for v in group.getNodeIdsOfCell(c)] for c in range(group.getNumberOfCells())]
            if level == 0:
                assert group.getMeasureField(False).getArray().getMinValueInArray() > 0, name
                found.regions[name] = [[cell[k] for k in order] for cell in cells]
            elif level == -1:
                found.patches[name] = cells
            found.nodes[name] = {tuple(p): p for cell in cells for p in cell}.values()
    Judge(samples, "med").check(found, groups=True)


READERS = {
    "vtkmodules.vtkIOHDF": ("module", read_vtkhdf),
    "vtkmodules.vtkIOCGNSReader": ("module", read_cgns),
    "cgnscheck": ("program", check_cgns),
    "medcoupling": ("module", read_med),
    "meshio": ("module", read_meshio),
    "vtkmodules": ("module", read_vtk),
    "vtkmodules.vtkIOExodus": ("module", read_exodus),
    "gmsh": ("module", read_gmsh),
    "mfem": ("module", read_mfem),
    "pyNastran": ("module", read_nastran),
    "mapdl_archive": ("module", read_ansys),
    "lsdyna_mesh_reader": ("module", read_lsdyna),
    "checkMesh": ("program", read_checkmesh),
    "ccx": ("program", read_calculix),
}


if __name__ == "__main__":
    sys.exit(foreign_reader.run(READERS, "finds every set as it was written"))
