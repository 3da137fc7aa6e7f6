"""Sizes by function, by array and on a lattice."""
import os

import hexwright as hw
import numpy as np
import pytest


def longest_edges(mesh):
    """Of each hex."""
    corners = mesh.points[mesh.hexes]
    pairs = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
    return np.max([np.linalg.norm(corners[:, a] - corners[:, b], axis=1) for a, b in pairs], axis=0)


def halves(mesh):
    """Median of the longest edges below and above x = 0.5."""
    edges, x = longest_edges(mesh), mesh.points[mesh.hexes].mean(axis=1)[:, 0]
    return np.median(edges[x < 0.4]), np.median(edges[x > 0.6])


def fine_below(places):
    return np.where(places[:, 0] < 0.5, 0.07, np.inf)


def test_a_function_of_places_bounds_the_cells(cube):
    mesh = hw.mesh(*cube, sizes=fine_below)
    fine, coarse = halves(mesh)
    assert mesh.valid and fine < 0.09 and coarse > 1.5 * fine


def test_a_constant_function_is_met_exactly(cube):
    assert len(hw.mesh(*cube, sizes=lambda places: np.full(len(places), 0.1)).hexes) == 1000


def test_threads_change_nothing(cube):
    one, many = (hw.mesh(*cube, sizes=fine_below, threads=threads) for threads in (1, 4))
    assert one.points.tobytes() == many.points.tobytes() and one.hexes.tobytes() == many.hexes.tobytes()


def test_the_function_gets_places_of_the_surface_in_its_unit(cube):
    seen = []

    def sizes(places):
        assert places.dtype == np.float64 and not places.flags.writeable
        seen.append(places)
        return np.full(len(places), 20.0)

    vertices, faces = cube
    hw.mesh(vertices * 100 + [1000, 0, 0], faces, sizes=sizes)
    assert {places.shape for places in seen} == {(27, 3)}
    assert np.allclose(np.concatenate(seen[:64]).mean(axis=0), [1050, 50, 50])  # those of the box come first


def test_lists_and_single_precision_are_sizes_too(cube):
    same = [hw.mesh(*cube, sizes=sizes).points.tobytes() for sizes in (
        lambda places: [0.25] * len(places), lambda places: np.full(len(places), 0.25, dtype=np.float32),
        lambda places: np.full(2 * len(places), 0.25)[::2])]
    assert same[0] == same[1] == same[2]


def test_a_lattice_of_values_is_interpolated(cube):
    values = np.full((3, 2, 2), 0.3)
    values[0] = 0.05
    fine, coarse = halves(hw.mesh(*cube, sizes=(values, [0, 0, 0, 1, 1, 1])))
    assert fine < 0.2 and coarse > 1.3 * fine


def test_a_lattice_is_the_function_that_is_linear_between_its_values(cube):
    x = np.linspace(0, 1, 5)
    values = np.repeat((0.05 + 0.2 * x)[:, None, None], 2, axis=1)  # one layer of values along z
    by_lattice = hw.mesh(*cube, sizes=(values, [0, 0, 0, 1, 1, 1]), max_size=0.25)
    inside = lambda places: ((places >= 0) & (places <= 1)).all(axis=1)
    by_function = hw.mesh(
        *cube, sizes=lambda places: np.where(inside(places), 0.05 + 0.2 * places[:, 0], np.inf), max_size=0.25)
    assert len(by_lattice.hexes) == len(by_function.hexes)
    uniform = hw.mesh(*cube, sizes=(np.full((2, 3, 4), 0.125), [0, 0, 0, 1, 1, 1]))
    assert len(uniform.hexes) == 512
    nothing_beyond = hw.mesh(*cube, sizes=(np.full((2, 2, 2), 0.01), [2, 2, 2, 3, 3, 3]), max_size=0.25)
    assert len(nothing_beyond.hexes) == 64


def test_points_have_sizes(cube):
    at_a_corner = hw.mesh(*cube, sizes=(np.array([[0.1, 0.1, 0.1]]), [0.06]), max_size=0.25)
    x = at_a_corner.points[at_a_corner.hexes].mean(axis=1)
    here = np.abs(x - 0.1).max(axis=1).argmin()
    assert longest_edges(at_a_corner)[here] < 0.08 and len(at_a_corner.hexes) > 64


def test_rules_in_words_hold_with_them(cube):
    mesh = hw.mesh(*cube, sizes=fine_below, refine=["box:0.8,0,0,1,1,1=0.07"])
    x = mesh.points[mesh.hexes].mean(axis=1)[:, 0]
    edges = longest_edges(mesh)
    assert np.median(edges[x > 0.9]) < 0.09 and np.median(edges[x < 0.3]) < 0.09


def test_a_field_of_a_file_is_the_lattice(cube, tmp_path):
    path = tmp_path / "sizes.vti"
    numbers = " ".join(str(v) for v in [0.05, 0.25] * 4)
    path.write_text(
        '<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian"><ImageData WholeExtent="0 1 0 1 0 1" Origin="0 0 0" '
        'Spacing="1 1 1"><Piece Extent="0 1 0 1 0 1"><PointData><DataArray type="Float64" Name="size" format="ascii">'
        f"{numbers}</DataArray></PointData></Piece></ImageData></VTKFile>")
    values = np.full((2, 2, 2), 0.25)
    values[0] = 0.05
    by_file = hw.mesh(*cube, refine=f"field:{path}")
    by_lattice = hw.mesh(*cube, sizes=(values, [0, 0, 0, 1, 1, 1]))
    assert by_file.points.tobytes() == by_lattice.points.tobytes()
    assert by_file.hexes.tobytes() == by_lattice.hexes.tobytes()


def test_values_per_vertex_and_per_face_hold_at_the_surface(cube):
    vertices, faces = cube
    fine, coarse = halves(hw.mesh(vertices, faces, sizes=np.where(vertices[:, 0] < 0.5, 0.06, 0.5)))
    assert fine < 0.15 and coarse > 1.3 * fine
    everywhere = hw.mesh(vertices, faces, sizes=np.full(len(faces), 0.07))
    by_function = hw.mesh(vertices, faces, sizes=lambda places: np.full(len(places), 0.07))
    assert len(everywhere.hexes) < len(by_function.hexes)
    x = everywhere.points[everywhere.hexes].mean(axis=1)
    outer = longest_edges(everywhere)[np.abs(x - 0.5).max(axis=1) > 0.45]
    assert np.quantile(outer, 0.9) < 0.09


def test_a_file_of_sizes_may_be_a_path(cube, tmp_path):
    path = tmp_path / "sizes.json"
    path.write_text('{"size": 0.1}')
    for given in (path, os.fspath(path)):
        assert len(hw.mesh(*cube, sizes=given).hexes) == 1000


BOX = [0, 0, 0, 1, 1, 1]


@pytest.mark.parametrize("sizes, words", [
    (np.ones(5), "sizes: has 5 values; give one per vertex .8. or per face .12."),
    ([], "sizes: is empty"),
    (["a"] * 8, "sizes: must hold"),
    (np.ones((8, 2)), r"sizes: has the shape \(8, 2\)"),
    (0.1, "one size for all is the option size"),
    (np.zeros(8), r"sizes: the size at \(0, 0, 0\) is 0; give lengths above 0"),
    (np.r_[np.ones(11), np.nan], "sizes: value 11 is not finite"),
    ((np.ones((2, 2)), BOX), r"sizes: the first of two has the shape \(2, 2\)"),
    ((np.ones((2, 2, 2)), [0, 0, 0, 1, 1, 0]), "sizes: the box must be"),
    ((-np.ones((2, 2, 2)), BOX), "lengths above 0"),
    ((np.full((2, 2, 2), np.nan), BOX), "sizes: the lattice: value 0 is not finite"),
    ((np.ones((4, 3)), np.ones(3)), "has 3 values for 4 elements"),
    ((np.ones((4, 3)), -np.ones(4)), r"the size at \(1, 1, 1\) is -1"),
    (lambda places: -np.ones(len(places)), "the size at .* is -1; give lengths above 0"),
    (lambda places: np.full(len(places), np.nan), "the size at .* is nan; give lengths above 0"),
    (lambda places: 0.1, r"the function gives the shape \(\) for places of the shape \(27, 3\)"),
    (lambda places: places, r"the function gives the shape \(27, 3\)"),
    (lambda places: np.full(len(places), "a"), "what the function gives: must hold"),
])
def test_wrong_sizes_are_refused(cube, sizes, words):
    with pytest.raises(hw.BadInput, match=words):
        hw.mesh(*cube, sizes=sizes)


@pytest.mark.parametrize("threads", [1, 4])
def test_an_exception_of_the_function_comes_back_as_it_was(cube, threads):
    mine = ZeroDivisionError("mine")

    def sizes(places):
        raise mine

    with pytest.raises(ZeroDivisionError) as caught:
        hw.mesh(*cube, sizes=sizes, threads=threads)
    assert caught.value is mine
    assert hw.mesh(*cube, size=0.5).valid  # and the package goes on


def test_sizes_hold_with_the_other_options(cube):
    mesh = hw.mesh(*cube, sizes=lambda places: np.full(len(places), 1e-6), min_size=0.1)
    assert len(mesh.hexes) <= 20**3
    with pytest.raises(hw.OutOfResources, match="ask for larger cells"):
        hw.mesh(*cube, sizes=lambda places: np.full(len(places), 1e-6), max_hexes=10000)


def test_other_stages_have_no_functions(cube):
    with pytest.raises(TypeError, match="no option 'sizes'"):
        hw.grid(*cube, sizes=lambda places: np.ones(len(places)))
