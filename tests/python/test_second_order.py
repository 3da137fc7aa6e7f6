"""Meshes whose edges have nodes on the surface."""
import hexwright as hw
import numpy as np
import pytest


@pytest.fixture(scope="module")
def ball():
    """A sphere of radius 1 as the boundary of a cube, inflated."""
    n = 24
    grid = np.linspace(-1, 1, n + 1)
    u, v = np.meshgrid(grid, grid, indexing="ij")
    first = np.arange((n + 1) * n).reshape(n, n + 1)[:, :n].ravel()
    quads = np.stack([first, first + n + 1, first + n + 2, first + 1], axis=1)
    points, faces = [], []
    for axis in range(3):
        for side in (-1, 1):
            p = np.empty((u.size, 3))
            p[:, axis], p[:, (axis + 1) % 3], p[:, (axis + 2) % 3] = side, u.ravel(), v.ravel()
            turned = quads if side > 0 else quads[:, ::-1]
            faces.append(len(points) * u.size + np.concatenate([turned[:, :3], turned[:, [0, 2, 3]]]))
            points.append(np.tan(p * np.pi / 4))
    points = np.concatenate(points)
    return points / np.linalg.norm(points, axis=1)[:, None], np.concatenate(faces)


def test_the_nodes_of_boundary_edges_are_on_the_surface(ball, tmp_path):
    mesh = hw.mesh(*ball, order=2, tolerance="1%")
    assert mesh.valid and mesh.order == 2
    assert mesh.report["curving"]["curved_edges"] > 0
    points, hexes = mesh.second_order()
    assert hexes.shape == (len(mesh.hexes), 20)
    assert (points[: len(mesh.points)] == mesh.points).all()
    radius = np.linalg.norm(points, axis=1)
    assert radius.max() < 1 + 1e-9
    # Middles of chords on the sphere are inside of it by a percent or so; those of the boundary are on its facets.
    on_surface = radius > 0.995
    ends = np.array([(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)])
    boundary = {tuple(sorted(pair)) for facets in mesh.patches.values() for q in facets.quads for pair in zip(q, np.roll(q, 1))}
    for corners in hexes:
        for k, pair in enumerate(np.sort(corners[ends], axis=1)):
            if tuple(pair) in boundary:
                assert on_surface[corners[8 + k]]
    path = tmp_path / "ball.vtu"
    mesh.save(path)
    again = hw.read(path)
    assert again.order == 2 and np.allclose(again.second_order().points, points)
    mesh.save(path, nodes=8)
    assert hw.read(path).order == 1


def test_of_order_1_edges_are_straight(ball):
    mesh = hw.mesh(*ball, tolerance="2%")
    assert mesh.order == 1
    points, hexes = mesh.second_order()
    assert np.allclose(points[hexes[:, 8]], (points[hexes[:, 0]] + points[hexes[:, 1]]) / 2)


def test_what_cannot_be_written_is_said(ball, tmp_path):
    mesh = hw.mesh(*ball, order=2, tolerance="2%")
    with pytest.raises(hw.BadInput, match="no hexes of second order"):
        mesh.save(tmp_path / "ball.mesh")
    with pytest.raises(hw.BadInput, match="nodes"):
        mesh.save(tmp_path / "ball.vtu", nodes=9)
    assert not list(tmp_path.iterdir())
