"""What is taken for a surface, and that everything else is refused with a sentence that helps."""
import hexwright as hw
import numpy as np
import pytest
from conftest import COARSE


def same(a, b):
    return np.array_equal(a.points, b.points) and np.array_equal(a.hexes, b.hexes)


@pytest.mark.parametrize("type_of_points", ["f2", "f4", "f8", ">f8", "i1", "u2", "i4", "u4", "i8", "u8", "longdouble"])
@pytest.mark.parametrize("type_of_faces", ["i1", "u1", "i2", "u2", "i4", ">i4", "u4", "i8", "u8"])
def test_any_number_type_gives_the_same_surface(cube, type_of_points, type_of_faces):
    vertices, faces = cube
    surface = hw.Surface(vertices.astype(type_of_points), faces.astype(type_of_faces))
    assert np.array_equal(surface.vertices, vertices)
    assert np.array_equal(surface.faces, faces)


def test_memory_may_lie_in_any_way(cube):
    vertices, faces = cube
    for points in (np.asfortranarray(vertices), np.repeat(vertices, 2, axis=0)[::2], vertices.tolist(),
                   np.hstack([vertices, vertices])[:, :3], vertices[::-1][::-1], as_field_of_records(vertices)):
        assert np.array_equal(hw.Surface(points, faces[:, ::-1][:, ::-1]).vertices, vertices)


def as_field_of_records(vertices):
    """Rows whose distance is no multiple of a number's size."""
    records = np.zeros(len(vertices), dtype=[("place", "f8", 3), ("kind", "u1")])
    records["place"] = vertices
    return records["place"]


def test_read_only_arrays_are_taken_and_nothing_is_changed(cube):
    vertices, faces = (array.copy() for array in cube)
    for array in (vertices, faces):
        array.setflags(write=False)
    before = vertices.tobytes(), faces.tobytes()
    hw.mesh(vertices, faces, **COARSE)
    assert (vertices.tobytes(), faces.tobytes()) == before


def test_objects_of_other_packages_are_surfaces(cube, cube_mesh, tmp_path):
    meshio, pyvista, trimesh = (pytest.importorskip(name) for name in ("meshio", "pyvista", "trimesh"))
    vertices, faces = cube
    polydata = pyvista.PolyData.from_regular_faces(vertices, faces)
    quads = pyvista.PolyData.from_regular_faces(vertices, [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3],
                                                           [0, 4, 6, 2], [1, 3, 7, 5]])
    hw.Surface(*cube).save(tmp_path / "cube.stl")
    for surface in (trimesh.Trimesh(vertices, faces, process=False), polydata, quads, (vertices, faces),
                    meshio.Mesh(vertices, [("triangle", faces)]), hw.Surface(*cube), tmp_path / "cube.stl",
                    str(tmp_path / "cube.stl")):
        assert len(hw.mesh(surface, **COARSE).hexes) == len(cube_mesh.hexes), surface
    assert same(polydata.hexwright.mesh(**COARSE), cube_mesh)


def faults(cube):
    vertices, faces = cube
    holed = vertices.copy()
    holed[3, 1] = np.nan
    yield (vertices[:, :2], faces), "vertices: has the shape (8, 2), but must have (n, 3)"
    yield (vertices.ravel(), faces), "vertices: has the shape (24,)"
    yield (vertices, faces.ravel()), "faces: has the shape (36,)"
    yield (vertices, np.hstack([faces, faces[:, :1]])), "split quads"
    yield (holed, faces), "vertices: row 3 is not finite"
    yield (vertices + np.inf, faces), "is not finite"
    yield (vertices, faces + 1), "which is none of the 8 points"
    yield (vertices, faces - 1), "row 0 holds -1"
    yield (vertices, np.full((1, 3), 2**63, dtype=np.uint64)), "holds 9223372036854775808"
    yield (vertices, faces.astype(float)), "faces: must hold integers"
    yield (vertices.astype(complex), faces), "integers or floating-point numbers"
    yield (vertices.astype(str), faces), "numbers, not str"
    yield (vertices > 0, faces), "numbers, not bool"
    yield ([[0, 0, 0], [1, 2]], faces), "rows of different lengths"
    yield ([None] * 8, faces), "must hold integers"
    yield ([], []), "is empty"
    yield (np.zeros((0, 3)), np.zeros((0, 3), dtype=int)), "no triangles"
    yield (vertices * [1, 1, 0], faces), "volume"


def test_misuse_is_refused_with_a_sentence(cube):
    for arguments, words in faults(cube):
        with pytest.raises(hw.HexwrightError) as caught:
            hw.mesh(*arguments)
        assert words in str(caught.value), (words, str(caught.value))
        assert isinstance(caught.value, ValueError)


@pytest.mark.parametrize("what", [None, 7, object(), {"vertices": []}])
def test_what_is_no_surface_is_said_to_be_none(what):
    with pytest.raises(hw.BadInput, match="is no surface; give a path"):
        hw.mesh(what)


def test_files_that_do_not_read_name_the_place(tmp_path):
    with pytest.raises(hw.BadInput, match="missing.stl"):
        hw.mesh(tmp_path / "missing.stl")
    (tmp_path / "bad.obj").write_text("v 0 0 0\nv 1 0 0\nf 1 2 9\n")
    with pytest.raises(hw.BadInput, match="bad.obj:3") as caught:
        hw.mesh(tmp_path / "bad.obj")
    assert caught.value.where.endswith("bad.obj:3")


def test_features_must_be_pairs_of_vertices(cube):
    for features, words in (([[0, 8]], "none of the surface's 8 vertices"), ([0, 1], "pairs"), ([[0.5, 1]], "integers")):
        with pytest.raises(hw.BadInput, match=words):
            hw.mesh(*cube, features=features, **COARSE)
    with pytest.raises(hw.BadInput, match="give the surface too"):
        hw.check(hw.mesh(*cube, **COARSE), features=[[0, 1]])


def test_features_of_ones_own_become_curves():
    box = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1, 2)], dtype=float)
    faces = np.array([[0, 3, 1], [1, 3, 4], [1, 4, 2], [2, 4, 5], [6, 7, 9], [7, 10, 9], [7, 8, 10], [8, 11, 10],
                      [0, 1, 6], [1, 7, 6], [1, 2, 7], [2, 8, 7], [3, 9, 4], [4, 9, 10], [4, 10, 5], [5, 10, 11],
                      [0, 6, 3], [3, 6, 9], [2, 5, 8], [5, 11, 8]])
    plain = hw.mesh(box, faces)
    split = hw.mesh(box, faces, features=[[1, 4], [4, 10], [10, 7], [7, 1]])
    assert len(plain.patches) == 6
    assert len(split.patches) == 10


def test_unknown_and_wrong_options_are_said(cube):
    with pytest.raises(TypeError, match="no option 'max_lvl'; did you mean 'max_level'"):
        hw.mesh(*cube, max_lvl=3)
    for options, words in (({"tolerance": 5}, "tolerance: '5' is not a share"), ({"rounds": 2.5}, "no whole number"),
                           ({"pairing": "all"}, "pairing: 'all' is none of"), ({"tolerance": [1]}, "'1' is not a share"),
                           ({"tolerance": np.array([0.1, 0.2])}, "is not a share"),
                           ({"threads": -1}, "threads: -1"), ({"max_level": True}, "no whole number"),
                           ({"tolerance": np.nan}, "not a share"), ({"min_level": 5, "max_level": 4}, "level")):
        with pytest.raises(hw.BadInput, match=words):
            hw.mesh(*cube, **options)
    with pytest.raises(hw.BadInput, match="'meshing' is none of mesh, grid, .*evaluate"):
        hw.options("meshing")
    with pytest.raises(TypeError):
        hw.mesh(*cube, progress="yes")
    with pytest.raises(TypeError):
        hw.mesh(*cube, threads="two")
    hw.mesh(*cube, **{**COARSE, "tolerance": np.float32(0.05), "max_level": np.int16(3), "no_loop": np.bool_(True)})


def test_hex_meshes_and_grids_are_checked_too(cube_mesh):
    points, hexes = np.array(cube_mesh.points), np.array(cube_mesh.hexes)
    for arguments, words in (((points, hexes + len(points)), "hexes: row 0"), ((points[:, :1], hexes), "points: has"),
                             ((points, hexes[:, :4]), "hexes: has"), ((points, hexes, [1, 2]), "2 tags for")):
        with pytest.raises(hw.BadInput, match=words):
            hw.HexMesh(*arguments)
    for arguments, words in ((([0], [[0, 0, 1]]), "outside|roots"), (([1], [[0, 0, 0]]), "gap|cover|tile"),
                             (([99], [[0, 0, 0]]), "levels: row 0 holds 99"), (([0, 0], [[0, 0, 0]]), "1 rows for 2")):
        with pytest.raises(hw.BadInput, match=words):
            hw.Grid(*arguments)
    with pytest.raises(hw.BadInput, match="size"):
        hw.Grid([0], [[0, 0, 0]], size=-1)
    with pytest.raises(hw.BadInput, match="no grid"):
        hw.complete(7)
    with pytest.raises(hw.BadInput, match="no hex mesh"):
        hw.check(7)


def test_rows_of_numpy_and_paths_are_options_too(cube, tmp_path):
    rows = hw.mesh(*cube, side="outside", box=np.array([-1.0, -1, -1, 2, 2, 2]), size=np.float64(0.5))
    assert np.allclose([rows.points.min(), rows.points.max()], [-1, 2])
    sizes = tmp_path / "sizes.json"
    sizes.write_text('{"size": 0.1}')
    assert len(hw.mesh(*cube, sizes=sizes).hexes) == 1000
    with pytest.raises(hw.BadInput, match="box: ndarray is neither a number"):
        hw.mesh(*cube, side="outside", box=np.ones((2, 3)))
