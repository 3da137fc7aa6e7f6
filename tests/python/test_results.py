"""Results: views without a copy, names, files, and other packages' objects."""
import gc
import xml.etree.ElementTree

import hexwright as hw
import numpy as np
import pytest
from conftest import COARSE


def test_arrays_are_read_only_views_that_outlive_their_mesh(cube):
    mesh = hw.mesh(*cube, **COARSE)
    for name in ("points", "hexes", "regions", "corners"):
        view = getattr(mesh, name)
        assert not view.flags.owndata and not view.flags.writeable
        with pytest.raises(ValueError):
            view[0] = 0
    assert mesh.points.__array_interface__["data"] == mesh.points.__array_interface__["data"], "a copy was made"
    points, expected = mesh.points, mesh.points.copy()
    quads = mesh.patches["PATCH_0"].quads
    total = quads.sum()
    del mesh
    gc.collect()
    np.zeros_like(expected)  # what was freed would be taken
    assert np.array_equal(points, expected) and quads.sum() == total


def test_types_and_shapes_are_as_documented(cube_mesh):
    m, n, k = cube_mesh, len(cube_mesh.points), len(cube_mesh.hexes)
    assert (m.points.dtype, m.points.shape) == (np.float64, (n, 3))
    assert (m.hexes.dtype, m.hexes.shape) == (np.int32, (k, 8))
    assert (m.regions.dtype, m.regions.shape) == (np.int32, (k,))
    assert m.valid and not m.failures and m.report["hexes"] == k


def test_patches_are_faces_of_their_hexes(cube_mesh):
    faces = [(0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)]
    for facets in cube_mesh.patches.values():
        of_hex = np.array([cube_mesh.hexes[owner][list(faces[side])] for owner, side in zip(facets.owner, facets.side)])
        assert np.array_equal(np.sort(of_hex, axis=1), np.sort(facets.quads, axis=1))
        p = cube_mesh.points[facets.quads]
        normals = np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1])
        assert (np.einsum("ij,ij->i", normals, p.mean(axis=1) - 0.5) > 0).all(), "quads are seen from outside"
    for name, edges in cube_mesh.curves.items():
        on_side = np.isclose(cube_mesh.points[edges], 0) | np.isclose(cube_mesh.points[edges], 1)
        assert (on_side.all(axis=1).sum(axis=1) == 2).all(), name


def test_both_sides_have_two_regions(cube):
    vertices, faces = cube
    mesh = hw.mesh(vertices * [1, 1, 0.3], faces, side="both", max_level=5, rounds=0)
    assert set(np.unique(mesh.regions)) == {1, 2}
    inside = mesh.quality("volume")[mesh.regions == 1].sum()
    assert inside == pytest.approx(0.3, rel=0.05)
    sides = {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"}
    assert sides < set(mesh.patches)
    for name, facets in mesh.patches.items():
        assert (mesh.regions[facets.owner] == (2 if name in sides else 1)).all(), "the owner sees the quad as the object does"


def test_quality_measures(cube_mesh):
    assert cube_mesh.quality().min() == pytest.approx(cube_mesh.report["verdict"]["quality"]["min_scaled_jacobian"])
    assert cube_mesh.quality("volume").sum() == pytest.approx(1, rel=1e-9)
    assert set(cube_mesh.quality("positivity")) == {1}
    with pytest.raises(hw.BadInput, match="none of scaled_jacobian, volume, positivity"):
        cube_mesh.quality("beauty")


@pytest.mark.parametrize("extension", ["vtu", "vtk", "mesh"])
def test_files_come_back(cube_mesh, tmp_path, extension):
    path = tmp_path / f"cube.{extension}"
    cube_mesh.save(path)
    again = hw.read(path)
    assert np.array_equal(again.points, cube_mesh.points) and np.array_equal(again.hexes, cube_mesh.hexes)
    assert {n: len(f.quads) for n, f in again.patches.items()} == {n: len(f.quads) for n, f in cube_mesh.patches.items()}
    assert again.valid


def test_fields_are_written_and_checked(cube_mesh, tmp_path):
    meshio = pytest.importorskip("meshio")
    cube_mesh.save(tmp_path / "a.vtu", fields={"number": np.arange(len(cube_mesh.hexes))})
    written = meshio.read(tmp_path / "a.vtu").cell_data
    assert written["number"][0][7] == 7 and "scaled_jacobian" in written
    with pytest.raises(hw.BadInput, match="number: has 1 values"):
        cube_mesh.save(tmp_path / "b.vtu", fields={"number": [1]})
    with pytest.raises(hw.BadInput):
        cube_mesh.save(tmp_path / "b.docx")
    assert not (tmp_path / "b.vtu").exists() and not (tmp_path / "b.docx").exists()


def test_a_mesh_that_misses_the_gate_is_given_with_a_warning_or_raised_when_strict(part):
    coarse = {"max_level": 3, "rounds": 0, "tolerance": "0.1%"}
    with pytest.warns(hw.HexwrightWarning):
        mesh = hw.mesh(part, **coarse)
    assert mesh.failures and not mesh.valid and len(mesh.hexes)
    with pytest.raises(hw.InvalidMesh) as caught:
        hw.mesh(part, strict=True, **coarse)
    assert len(caught.value.mesh.hexes) == len(mesh.hexes)


def test_pyvista_sees_the_same_mesh(cube_mesh):
    pytest.importorskip("pyvista")
    grid = cube_mesh.to_pyvista()
    assert grid.n_cells == len(cube_mesh.hexes) and grid.volume == pytest.approx(1)
    assert grid["scaled_jacobian"].min() == pytest.approx(cube_mesh.quality().min())
    assert grid.hexwright.check().valid
    assert len(grid.hexwright.improve(rounds=1).hexes) == grid.n_cells


def test_pyvista_reads_meshes_and_grids(cube, cube_mesh, tmp_path):
    pyvista = pytest.importorskip("pyvista", minversion="0.48")
    meshio = pytest.importorskip("meshio")
    cube_mesh.save(tmp_path / "cube.mesh")
    assert "scaled_jacobian" in pyvista.read(tmp_path / "cube.mesh").cell_data
    grid = hw.grid(*cube)
    grid.save(tmp_path / "cube.cells")
    assert pyvista.read(tmp_path / "cube.cells").n_cells == len(grid)
    tets = meshio.Mesh(np.eye(4, 3), [("tetra", [[0, 1, 2, 3]])])
    tets.write(tmp_path / "tets.mesh")
    assert pyvista.read(tmp_path / "tets.mesh").n_cells == 1


def test_meshio_gets_names(cube_mesh, tmp_path):
    meshio = pytest.importorskip("meshio")
    mesh = cube_mesh.to_meshio()
    assert sum(len(block.data) for block in mesh.cells if block.type == "quad") == sum(
        len(f.quads) for f in cube_mesh.patches.values())
    assert set(mesh.cell_sets) == set(cube_mesh.patches) | set(cube_mesh.curves) | {"corners"}
    mesh.write(tmp_path / "a.vtk")
    assert len(meshio.read(tmp_path / "a.vtk").points) == len(cube_mesh.points)
    assert np.array_equal(hw.check(mesh).report["topology"]["hexes"], len(cube_mesh.hexes))


def test_scikit_fem_integrates_over_volume_and_patches(cube_mesh):
    skfem = pytest.importorskip("skfem")
    mesh = cube_mesh.to_skfem()
    one = skfem.Functional(lambda w: 1.0 + 0 * w.x[0])
    assert one.assemble(skfem.Basis(mesh, skfem.ElementHex1())) == pytest.approx(1)
    assert set(mesh.boundaries) == set(cube_mesh.patches)
    for name in cube_mesh.patches:
        area = one.assemble(skfem.FacetBasis(mesh, skfem.ElementHex1(), facets=name))
        assert area == pytest.approx(1, rel=1e-6), name
    tags = np.where(np.arange(len(cube_mesh.hexes)) % 2, -2, 5)
    regions = hw.HexMesh(cube_mesh.points, cube_mesh.hexes, tags).to_skfem().subdomains
    assert set(regions) == {"REGION_MINUS_2", "REGION_5"}, "as in files"


def test_pictures_and_html(cube_mesh):
    image = cube_mesh.image(width=64, height=48)
    assert image.shape == (48, 64, 3) and image.dtype == np.uint8 and image.std() > 0
    assert not np.array_equal(image, cube_mesh.image(cut="none", width=64, height=48))
    for wrong in ({"cut": "w"}, {"at": 2}, {"width": 3}):
        with pytest.raises(hw.BadInput):
            cube_mesh.image(**wrong)
    page = cube_mesh._repr_html_()
    xml.etree.ElementTree.fromstring(page.replace("<img ", "<img/><x ").replace('">', '"/>', 1))
    assert "data:image/png" in page and f"{len(cube_mesh.hexes):,}" in page


def test_grids_through_the_stages(cube, tmp_path):
    grid = hw.grid(*cube, max_level=4)
    assert not grid.levels.flags.owndata and not grid.corners.flags.owndata
    assert sum(grid.counts) == len(grid) == grid.report["cells"]
    assert (grid.edges ** 3).sum() == pytest.approx(grid.size ** 3)
    again = hw.Grid(grid.levels, grid.indices, grid.roots, grid.origin, grid.size)
    assert np.array_equal(again.corners, grid.corners) and np.allclose(again.centers, grid.centers)
    grid.save(tmp_path / "a.cells")
    assert np.array_equal(hw.read_grid(tmp_path / "a.cells").levels, grid.levels)
    paired = hw.complete(grid)
    assert paired.find_problem(balance="weak", blocks=True, before=grid) is None
    hexes = hw.dual(paired)
    assert hexes.valid
    fitted = hw.fit(hexes, cube)
    assert fitted.valid and fitted.report["verdict"]["distance"]
    assert hw.check(fitted, cube).valid


def test_stages_say_what_they_miss(cube):
    corner = np.indices((2, 2, 2)).reshape(3, -1).T
    deep = hw.Grid([1] * 7 + [2] * 7 + [3] * 8, np.vstack([corner[1:], corner[:-1], corner + 2]))
    assert deep.find_problem() is None
    assert "level" in str(deep.find_problem(balance="weak"))
    with pytest.raises(hw.HexwrightError, match="complete"):
        hw.dual(deep, mode="blocks")
    far = (cube[0] + 100, cube[1])
    with pytest.raises(hw.BadGeometry, match="overlap"):
        hw.fit(hw.dual(hw.complete(deep)), far)


def test_a_mesh_that_no_gate_has_judged_is_checked_when_asked():
    corner = np.indices((2, 2, 2)).reshape(3, -1).T
    cells = hw.Grid([1] * 7 + [2] * 8, np.vstack([corner[1:], corner])).to_hexes()
    better = hw.improve(cells, rounds=1)
    for mesh in (cells, better):
        report = dict(mesh.report)
        assert not mesh.valid and mesh.failures, "levels meet with hanging nodes"
        assert mesh.report == report
    assert "failures</th><td>none" not in cells._repr_html_()


def test_improve_leaves_its_input_and_makes_it_better(cube_mesh):
    points = np.array(cube_mesh.points)
    inner = np.ones(len(points), dtype=bool)
    for facets in cube_mesh.patches.values():
        inner[facets.quads] = False
    points[inner] += 0.03 * np.random.default_rng(1).uniform(-1, 1, (inner.sum(), 3))
    rough = hw.HexMesh(points, cube_mesh.hexes)
    better = hw.improve(rough)
    assert np.array_equal(rough.points, points)
    assert better.quality().min() > rough.quality().min()
    assert better.report["min_after"] == pytest.approx(better.quality().min())


def test_evaluate_gives_the_record_of_bench(cube):
    record = hw.evaluate(*cube, grid_max_level=3, no_mesh=True, no_dual=True)
    assert record["methods"]["blocks"]["cells"] >= record["input"]["cells"]


def tets_of_a_bar():
    """Two cubes in a row, six tets each."""
    points = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1, 2)], dtype=float)
    paths = [(0, 1, 4, 10), (0, 4, 3, 10), (0, 3, 9, 10), (0, 9, 6, 10), (0, 6, 7, 10), (0, 7, 1, 10)]
    return points, np.array([[v + shift for v in tet] for shift in (0, 1) for tet in paths])


def test_polycubes_of_arrays_with_a_size_by_function():
    points, tets = tets_of_a_bar()
    bent = points + np.column_stack([0 * points[:, 0], 0.1 * points[:, 0] ** 2, 0 * points[:, 0]])
    coarse = hw.polycube((bent, tets), (points, tets), max_level=2)
    assert coarse.valid and len(coarse.grid)
    fine = hw.polycube((bent, tets), (points, tets), max_level=3, max_edge=lambda x, y, z: 0.15 if x > 1 else 1.0)
    assert len(fine.hexes) > len(coarse.hexes)
    with pytest.raises(ZeroDivisionError):
        hw.polycube((bent, tets), (points, tets), max_edge=lambda x, y, z: 1 / 0)
    with pytest.raises(hw.BadInput, match="max_edge"):
        hw.polycube((bent, tets), (points, tets), max_edge=-1.0)
    with pytest.raises(hw.BadGeometry):
        hw.polycube((bent, tets), (points, tets[:-1]))


def test_names_of_arrays_reach_the_mesh(cube):
    vertices, faces = cube
    z = vertices[faces].mean(axis=1)[:, 2]
    mesh = hw.mesh(vertices, faces, patches={"inlet": np.flatnonzero(z == 0), "outlet": z == 1}, **COARSE)
    assert np.abs(mesh.points[mesh.patches["inlet"].quads][..., 2]).max() < 1e-9
    assert np.abs(mesh.points[mesh.patches["outlet"].quads][..., 2] - 1).max() < 1e-9
    assert len(mesh.patches) == 6


def test_parts_of_one_name_are_found_together(cube):
    vertices, faces = cube
    z = vertices[faces].mean(axis=1)[:, 2]
    mesh = hw.mesh(vertices, faces, patches={"wall": z < 1}, **COARSE)
    assert {"wall.1", "wall.5"} <= set(mesh.patches)
    whole = mesh.facets("wall")
    assert len(whole.quads) == sum(len(f.quads) for name, f in mesh.patches.items() if name.startswith("wall"))
    assert {"wall", "wall.1"} <= set(mesh.to_skfem().boundaries)
    with pytest.raises(hw.BadInput, match="there are .*wall.1"):
        mesh.facets("ceiling")


def test_surfaces_keep_names(cube, tmp_path):
    surface = hw.Surface(*cube, patches={"base": [0, 1]})
    surface.save(tmp_path / "a.obj")
    again = hw.read_surface(tmp_path / "a.obj")
    assert again.patches["base"].tolist() == [0, 1]
    assert set(hw.Surface(*cube).patches) == set()


@pytest.mark.parametrize("patches, words", [
    ({"a": [12]}, "'a' holds 12, which is none of the 12 faces"), ({"a": [-1]}, "holds -1"),
    ({"a": [0], "b": [0, 1]}, "face 0 is in 'b' and in another"), ({"": [0]}, "is no name"), ({7: [0]}, "7 is no name"),
    ({"a": [True]}, "1 truth values for 12 faces"), ({"a": [0.5]}, "list of face numbers")])
def test_wrong_patches_are_refused(cube, patches, words):
    with pytest.raises(hw.BadInput, match=words):
        hw.mesh(*cube, patches=patches)


def test_the_page_to_look_into_a_mesh_is_that_of_the_command_line(cube_mesh, tmp_path, program):
    import subprocess

    cube_mesh.save(tmp_path / "cube.vtu")
    subprocess.run([program, "view", tmp_path / "cube.vtu", "-o", tmp_path / "a.html", "--no-open", "-q"], check=True)
    assert cube_mesh.view(tmp_path / "cube.vtu.html", open=False) == str(tmp_path / "cube.vtu.html")
    assert (tmp_path / "cube.vtu.html").read_bytes() == (tmp_path / "a.html").read_bytes()


def test_the_page_without_a_name_lies_in_a_folder_of_its_own(cube, cube_mesh, tmp_path):
    import pathlib

    first, second = (pathlib.Path(cube_mesh.view(surface=cube, open=False)) for _ in range(2))
    assert first != second and first.suffix == ".html" and "array-distance" in first.read_text()
    for page in (first, second):
        page.unlink()
        page.parent.rmdir()
    with pytest.raises(hw.BadInput, match="missing"):
        cube_mesh.view(tmp_path / "missing/a.html", open=False)


def test_a_notebook_shows_the_page_below_the_cell(cube_mesh, tmp_path, monkeypatch):
    import html
    import types

    from hexwright import _mesh, _view

    opened = []
    monkeypatch.setattr(_mesh.webbrowser, "open", opened.append)
    page = cube_mesh.view(tmp_path / "a.html")
    assert opened == [(tmp_path / "a.html").resolve().as_uri()]
    monkeypatch.setitem(_view.sys.modules, "IPython", types.SimpleNamespace(get_ipython=lambda: types.SimpleNamespace(kernel=1)))
    page = cube_mesh.view(tmp_path / "a.html")
    assert len(opened) == 1
    shown = page._repr_html_()
    start = shown.index('srcdoc="') + len('srcdoc="')
    assert html.unescape(shown[start : shown.index('"', start)]) == (tmp_path / "a.html").read_text(encoding="utf-8")
    monkeypatch.setattr(_view, "LARGEST", 1000)
    assert "iframe" not in page._repr_html_() and 'href="file:' in page._repr_html_()


def test_names_that_a_format_cannot_take_are_told(cube, tmp_path):
    mesh = hw.mesh(*cube, patches={"a b/c": [0, 1], "inlet": [2, 3]}, **COARSE)
    assert {"a b/c", "inlet"} <= set(mesh.patches)
    with pytest.warns(hw.HexwrightWarning, match="'a b/c' is 'a_b_c'"):
        mesh.save(tmp_path / "a.vtu")
    assert {"a_b_c", "inlet"} <= set(hw.read(tmp_path / "a.vtu").patches)


def test_patches_may_be_rules(cube):
    mesh = hw.mesh(*cube, patches={"left": "plane:x<0.5", "base": [0, 1]})
    left = mesh.points[mesh.facets("left").quads]
    assert left[..., 0].max() == pytest.approx(0.5, abs=0.01) and "base" in mesh.patches
    surface = hw.Surface(*cube, patches={"left": "plane:x<0.5"})
    assert np.array_equal(surface.vertices[:8], cube[0]), "vertices keep their numbers, which features name"
    assert "fits the rule of 'far'" in hw.mesh(*cube, patches={"far": "plane:x>9"}, **COARSE).warnings[0]
    with pytest.raises(hw.BadInput, match="nonsense"):
        hw.mesh(*cube, patches={"left": "nonsense:3"})
