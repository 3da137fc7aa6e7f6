#!/usr/bin/env python3
"""Reads files that other programs write: their regions, patches, curves and corners arrive with their names.

Usage: foreign_files_test.py WRITER HEXWRIGHT_PROGRAM, with one of WRITERS below. Exit code 77 (skipped) when the writer is
not installed; scripts/setup unpacks the Python modules under build/deps. Each writes the same box, 2 x 1 x 1, of hexes of
edge 1/2: the regions steel (x < 1) and copper, the patches inlet (x = 0), outlet (x = 2) and wall, the curve rim around
the inlet, and pins, the four corners of the outlet. `hexwright check` says what was read.
"""
import itertools
import json
import subprocess
import sys

import foreign_reader

COUNTS = (4, 2, 2)
STEEL, COPPER = ("region", "steel"), ("region", "copper")
REGIONS = {STEEL: 1, COPPER: 1}
PATCHES = {("patch", "inlet"): 1, ("patch", "outlet"): 1, ("patch", "wall"): 8}
CURVES = {("curve", "rim"): 4}
CORNERS = {("corners", "CORNERS"): 4}
NORMALS = {"inlet": [-1, 0, 0], "outlet": [1, 0, 0]}
FACES = [(0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)]  # -x +x -y +y -z +z


class Box:
    """Points, hexes and sets, counted from 0. `sides`: patch -> (hex, local face of FACES)."""

    def __init__(self):
        nx, ny, nz = COUNTS
        self.points = [[x / 2, y / 2, z / 2] for z in range(nz + 1) for y in range(ny + 1) for x in range(nx + 1)]
        self.hexes, self.sides = [], {"inlet": [], "outlet": [], "wall": []}
        for z, y, x in itertools.product(range(nz), range(ny), range(nx)):
            bottom = [self.node(x, y, z), self.node(x + 1, y, z), self.node(x + 1, y + 1, z), self.node(x, y + 1, z)]
            self.hexes.append(bottom + [v + (nx + 1) * (ny + 1) for v in bottom])
            h = len(self.hexes) - 1
            outer = [x == 0, x == nx - 1, y == 0, y == ny - 1, z == 0, z == nz - 1]
            for face, is_outer in enumerate(outer):
                if is_outer:
                    self.sides[{0: "inlet", 1: "outlet"}.get(face, "wall")].append((h, face))
        self.regions = {"steel": [h for h, p in enumerate(self.hexes) if self.points[p[0]][0] < 1],
                        "copper": [h for h, p in enumerate(self.hexes) if self.points[p[0]][0] >= 1]}
        self.rim = [v for v, p in enumerate(self.points) if p[0] == 0 and (p[1] in (0, 1) or p[2] in (0, 1))]
        self.pins = [v for v, p in enumerate(self.points) if p[0] == 2 and p[1] in (0, 1) and p[2] in (0, 1)]

    @staticmethod
    def node(x, y, z):
        return (z * (COUNTS[1] + 1) + y) * (COUNTS[0] + 1) + x

    def quads(self, patch):
        return [[self.hexes[h][k] for k in FACES[face]] for h, face in self.sides[patch]]

    def edges(self):
        """Of the rim."""
        pairs = itertools.combinations(self.rim, 2)
        return [pair for pair in pairs if sum(abs(a - b) for a, b in zip(*(self.points[v] for v in pair))) == 0.5]


class Checker:
    """Runs `hexwright check` and compares the sets that it tells with what is expected: name -> measure."""

    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def verdict(self, path):
        run = subprocess.run([self.program, "check", path, "--json", "-q"], capture_output=True, text=True, check=False)
        assert run.returncode == 0, (path, run.returncode, run.stdout, run.stderr)
        return json.loads(run.stdout)

    def expect(self, path, *expected):
        verdict = self.verdict(path)
        found = {}
        for entry in verdict["sets"]:
            measures = [entry[key] for key in ("volume", "area", "length") if key in entry]
            found[entry["kind"], entry["name"]] = measures[0] if measures else entry["elements"]
            if entry["name"] in NORMALS and entry["kind"] == "patch":
                assert max(abs(a - b) for a, b in zip(entry["normal"], NORMALS[entry["name"]])) < 1e-9, entry
        wanted = {key: value for part in expected for key, value in part.items()}
        found = {key: value for key, value in found.items() if key[0] != "group"}
        assert found.keys() == wanted.keys(), (path, sorted(found), sorted(wanted))
        for key, value in wanted.items():
            assert abs(found[key] - value) < 1e-9 * max(value, 1), (path, key, found[key], value)
        assert abs(verdict["quality"]["volume"] - 2) < 1e-9 and verdict["quality"]["inverted"] == 0
        assert verdict["topology"]["hexes"] == 16 and verdict["topology"]["boundary_quads"] == 40

    def refuse(self, path, *words):
        run = subprocess.run([self.program, "check", path], capture_output=True, text=True, check=False)
        assert run.returncode not in (0, 1) and all(word in run.stderr for word in words), (path, words, run.stderr)


def build_reads_netcdf4(check, path):
    run = subprocess.run([check.program, "check", path, "-q"], capture_output=True, text=True, check=False)
    if "HEXWRIGHT_NETCDF" not in run.stderr:
        return True
    print("this build has no netCDF library: netCDF-4 files are left out")
    assert "nccopy -k cdf5" in run.stderr, run.stderr
    return False


def write_exodus(netCDF4, path, box, kind, names):
    """By the netCDF library, as the Exodus manual lays it out."""
    side_number = [4, 2, 1, 3, 5, 6]  # for our faces
    order = box.regions["steel"] + box.regions["copper"]
    element = {h: i + 1 for i, h in enumerate(order)}
    with netCDF4.Dataset(path, "w", format=kind) as out:
        out.title, out.version, out.api_version, out.floating_point_word_size = "by hand", 5.1, 5.1, 8
        out.createDimension("len_name", 33)
        out.createDimension("time_step", None)
        out.createDimension("num_dim", 3)
        out.createDimension("num_nodes", len(box.points))
        out.createDimension("num_elem", len(box.hexes))
        out.createVariable("time_whole", "f8", ("time_step",))[0] = 0.5
        out.createDimension("num_nod_var", 1)
        out.createVariable("vals_nod_var1", "f8", ("time_step", "num_nodes"))[0] = range(len(box.points))
        for axis, letter in enumerate("xyz"):
            out.createVariable("coord" + letter, "f8", ("num_nodes",))[:] = [p[axis] for p in box.points]

        def write_list(prefix, dimension, ids, list_names):
            out.createDimension(dimension, len(ids))
            out.createVariable(prefix + "_status", "i4", (dimension,))[:] = 1
            out.createVariable(prefix + "_prop1", "i4", (dimension,))[:] = ids
            if names:
                letters = netCDF4.stringtochar(netCDF4.numpy.array([n.encode() for n in list_names], "S33"))
                out.createVariable(prefix + "_names", "S1", (dimension, "len_name"))[:] = letters

        def write_numbers(name, values, *dimensions):
            for dimension, length in dimensions:
                if dimension not in out.dimensions:
                    out.createDimension(dimension, length)
            variable = out.createVariable(name, "i4", tuple(d for d, _ in dimensions))
            variable[:] = values
            return variable

        write_list("eb", "num_el_blk", [10, 20], ["steel", "copper"])
        for b, region in enumerate(("steel", "copper"), 1):
            rows = [[v + 1 for v in box.hexes[h]] for h in box.regions[region]]
            write_numbers(f"connect{b}", rows, (f"num_el_in_blk{b}", len(rows)),
                          (f"num_nod_per_el{b}", 8)).elem_type = "HEX8" if b == 1 else "hex"
        write_list("ss", "num_side_sets", [100, 7, 200], ["inlet", "outlet", "wall"])
        for s, patch in enumerate(("inlet", "outlet", "wall"), 1):
            size = (f"num_side_ss{s}", len(box.sides[patch]))
            write_numbers(f"elem_ss{s}", [element[h] for h, _ in box.sides[patch]], size)
            write_numbers(f"side_ss{s}", [side_number[f] for _, f in box.sides[patch]], size)
        inlet = sorted({v for quad in box.quads("inlet") for v in quad})
        write_list("ns", "num_node_sets", [100, 5, 6], ["inlet", "rim", "pins"])
        for s, nodes in enumerate((inlet, box.rim, box.pins), 1):
            write_numbers(f"node_ns{s}", [v + 1 for v in nodes], (f"num_nod_ns{s}", len(nodes)))


def write_by_netcdf(check, box):
    import netCDF4

    path = check.folder / "box.exo"
    for kind in ("NETCDF3_CLASSIC", "NETCDF3_64BIT_OFFSET", "NETCDF3_64BIT_DATA", "NETCDF4", "NETCDF4_CLASSIC"):
        write_exodus(netCDF4, path, box, kind, True)
        if kind.startswith("NETCDF4") and not build_reads_netcdf4(check, path):
            continue
        check.expect(path, REGIONS, PATCHES, CURVES, CORNERS)
        # Truncated files are refused; of classic ones with the place.
        cut = check.folder / "cut.exo"
        cut.write_bytes(path.read_bytes()[:path.stat().st_size // 2])
        check.refuse(cut, "cut.exo", "export it again")
    write_exodus(netCDF4, path, box, "NETCDF3_64BIT_OFFSET", False)
    check.expect(path, {("region", "block_10"): 1, ("region", "block_20"): 1, ("patch", "sideset_100"): 1,
                        ("patch", "sideset_7"): 1, ("patch", "sideset_200"): 8, ("curve", "nodeset_5"): 4}, CORNERS)


def meshio_box(box):
    """A mesh of meshio with cells of one kind per set, as it reads from Gmsh."""
    import meshio
    import numpy

    cells, tags = [], []

    def add(kind, rows, tag):
        cells.append((kind, numpy.array(rows)))
        tags.append(numpy.full(len(rows), tag))

    for tag, (_, hexes) in enumerate(box.regions.items(), 1):
        add("hexahedron", [box.hexes[h] for h in hexes], tag)
    for tag, patch in enumerate(box.sides, 11):
        add("quad", box.quads(patch), tag)
    add("line", box.edges(), 21)
    add("vertex", [[v] for v in box.pins], 31)
    names = {"steel": [1, 3], "copper": [2, 3], "inlet": [11, 2], "outlet": [12, 2], "wall": [13, 2], "rim": [21, 1],
             "pins": [31, 0]}
    return meshio.Mesh(box.points, cells, field_data={k: numpy.array(v) for k, v in names.items()},
                       cell_data={"gmsh:physical": tags, "gmsh:geometrical": tags})


def write_by_meshio(check, box):
    import meshio

    mesh = meshio_box(box)
    path = check.folder / "box.msh"
    meshio.write(path, mesh, "gmsh22", binary=False)
    check.expect(path, REGIONS, PATCHES, CURVES, CORNERS)
    write_abaqus_by_meshio(check, box)
    if not foreign_reader.is_installed("module", "netCDF4"):
        print("netCDF4 is not installed: meshio writes no Exodus files")
        return
    # meshio names sets of nodes only; blocks of quads are patches.
    mesh = meshio_box(box)
    mesh.point_sets = {"rim": meshio_array(box.rim), "pins": meshio_array(box.pins)}
    mesh.cell_data, mesh.field_data = {}, {}
    mesh.cells = [block for block in mesh.cells if block.type in ("hexahedron", "quad")]
    path = check.folder / "box.e"
    meshio.write(path, mesh, "exodus")
    if build_reads_netcdf4(check, path):
        check.expect(path, {("region", "block_0"): 1, ("region", "block_1"): 1, ("patch", "block_2"): 1,
                            ("patch", "block_3"): 1, ("patch", "block_4"): 8}, CURVES, CORNERS)


def write_abaqus_by_meshio(check, box):
    """Sets of hexes, of quads and of nodes, none of them named by the lines of elements."""
    import meshio

    sides = {name: box.quads(name) for name in box.sides}
    quads = [quad for rows in sides.values() for quad in rows]
    cells = [("hexahedron", box.hexes), ("quad", quads)]
    sets, first = {name: [meshio_array(hexes), meshio_array([])] for name, hexes in box.regions.items()}, 0
    for name, rows in sides.items():
        sets[name] = [meshio_array([]), meshio_array(range(first, first + len(rows)))]
        first += len(rows)
    points = {"rim": meshio_array(box.rim), "pins": meshio_array(box.pins)}
    path = check.folder / "box.inp"
    meshio.write(path, meshio.Mesh(box.points, cells, cell_sets=sets, point_sets=points), "abaqus")
    check.expect(path, REGIONS, PATCHES, CURVES, CORNERS)


def write_by_gmsh(check, _):
    """Two boxes that share a face, meshed by Gmsh itself, with physical groups of every dimension."""
    import gmsh

    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    occ, mesh = gmsh.model.occ, gmsh.model.mesh
    occ.fragment([(3, occ.addBox(0, 0, 0, 1, 1, 1))], [(3, occ.addBox(1, 0, 0, 1, 1, 1))])
    occ.synchronize()

    def tags(dimension, x0, x1):
        found = gmsh.model.getEntitiesInBoundingBox(x0 - 0.1, -0.1, -0.1, x1 + 0.1, 1.1, 1.1, dimension)
        return [tag for _, tag in found]

    inlet, outlet, middle = tags(2, 0, 0), tags(2, 2, 2), tags(2, 1, 1)
    wall = [tag for _, tag in gmsh.model.getEntities(2) if tag not in inlet + outlet + middle]
    for number, (dimension, members, name) in enumerate([
            (3, tags(3, 0, 1), "steel"), (3, tags(3, 1, 2), "copper"), (2, inlet, "inlet"), (2, outlet, "outlet"),
            (2, wall, "wall"), (1, tags(1, 0, 0), "rim"), (0, tags(0, 2, 2), "pins")], 11):
        gmsh.model.addPhysicalGroup(dimension, members, number, name)
    for _, tag in gmsh.model.getEntities(1):
        mesh.setTransfiniteCurve(tag, 3)
    for _, tag in gmsh.model.getEntities(2):
        mesh.setTransfiniteSurface(tag)
        mesh.setRecombine(2, tag)
    for _, tag in gmsh.model.getEntities(3):
        mesh.setTransfiniteVolume(tag)
    mesh.generate(3)
    for order in (1, 2):
        mesh.setOrder(order)
        for version in (2.2, 4.1):
            gmsh.option.setNumber("Mesh.MshFileVersion", version)
            gmsh.write(str(check.folder / "box.msh"))
            check.expect(check.folder / "box.msh", REGIONS, PATCHES, CURVES, CORNERS)
        for has_nodes in (0, 1):
            gmsh.option.setNumber("Mesh.SaveGroupsOfNodes", has_nodes)
            gmsh.write(str(check.folder / "box.inp"))
            check.expect(check.folder / "box.inp", REGIONS, PATCHES, CURVES, CORNERS if has_nodes else {})
            second_order = check.verdict(check.folder / "box.inp").get("second_order")
            assert (second_order is None) == (order == 1)
            assert order == 1 or second_order["curved_hexes"] == 0, second_order  # their nodes are in place
    gmsh.finalize()


def meshio_array(numbers):
    import numpy

    return numpy.array(numbers)


def write_by_mfem(check, box):
    import mfem.ser as mfem

    mesh = mfem.Mesh.MakeCartesian3D(*COUNTS, mfem.Element.HEXAHEDRON, 2.0, 1.0, 1.0)
    for e in range(mesh.GetNE()):
        mesh.SetAttribute(e, 3 if mesh.GetVertexArray(mesh.GetElementVertices(e)[0])[0] < 0.75 else 8)
    path = check.folder / "box.mesh"
    mesh.SetAttributes()
    mesh.Save(str(path), 16)
    sides = {("patch", f"bdr_attribute_{a}"): 1 if a in (3, 5) else 2 for a in range(1, 7)}
    check.expect(path, {("region", "attribute_3"): 1, ("region", "attribute_8"): 1}, sides)
    mesh.attribute_sets.SetAttributeSet("steel", mfem.intArray([3]))
    mesh.attribute_sets.SetAttributeSet("copper", mfem.intArray([8]))
    mesh.attribute_sets.SetAttributeSet("all", mfem.intArray([3, 8]))
    for name, attributes in {"inlet": [5], "outlet": [3], "wall": [1, 2, 4, 6]}.items():
        mesh.bdr_attribute_sets.SetAttributeSet(name, mfem.intArray(attributes))
    walls = {("patch", f"wall.{k}"): 2 for k in range(1, 5)}
    for degree, name in ((0, "straight"), (1, "linear"), (2, "curved")):
        if degree > 0:
            mesh.SetCurvature(degree, False, 3, mfem.Ordering.byNODES if degree == 1 else mfem.Ordering.byVDIM)
        path = check.folder / (name + ".mesh")
        mesh.Save(str(path), 16)
        assert path.read_text().startswith("MFEM mesh v1.3")
        check.expect(path, REGIONS, {("patch", "inlet"): 1, ("patch", "outlet"): 1}, walls)
    bend_mfem(check, mesh, mfem)


def bend_mfem(check, mesh, mfem):
    """Nodes of second order, refined and moved: the volume is MFEM's own."""
    mesh.UniformRefinement()
    nodes = mesh.GetNodes().GetDataArray()
    nodes += [0.01 * ((7 * i) % 11 - 5) / 5 for i in range(len(nodes))]
    rule = mfem.IntRules.Get(mfem.Geometry.CUBE, 8)  # the library's own GetElementVolume is not exact here
    volume = 0
    for e in range(mesh.GetNE()):
        map_of = mesh.GetElementTransformation(e)
        for k in range(rule.GetNPoints()):
            map_of.SetIntPoint(rule.IntPoint(k))
            volume += rule.IntPoint(k).weight * map_of.Weight()
    path = check.folder / "bent.mesh"
    for ordering in (mfem.Ordering.byVDIM, mfem.Ordering.byNODES):
        mesh.SetCurvature(2, False, 3, ordering)
        mesh.Save(str(path), 17)
        verdict = check.verdict(path)
        assert verdict["topology"]["hexes"] == 128, verdict["topology"]
        assert abs(verdict["second_order"]["volume"] - volume) < 1e-9, (verdict["second_order"], volume)
    mesh.SetCurvature(3)
    mesh.Save(str(path), 17)
    check.refuse(path, "bent.mesh:", "order 1 or 2")


WRITERS = {"gmsh": write_by_gmsh, "meshio": write_by_meshio, "netCDF4": write_by_netcdf, "mfem": write_by_mfem}


def main():
    return foreign_reader.run_writers(lambda writer, *where: WRITERS[writer](Checker(*where), Box()),
                                      "what {} writes is read with its sets")


if __name__ == "__main__":
    sys.exit(main())
