"""A picture of a solution on the boundary of a hex mesh, with numpy and matplotlib alone."""
import numpy as np


def draw_faces(axes, points, faces, values, direction):
    """Faces (n, 4), or (n, 8) with the nodes between the corners, of points (m, 3), counter-clockwise from outside, coloured
    by their values (n,), as seen along `direction`."""
    from matplotlib.collections import PolyCollection

    forward = np.array(direction) / np.linalg.norm(direction)
    right = np.cross(forward, [0, 0, 1])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    shapes = points[faces]
    step = faces.shape[1] // 4
    normal = np.cross(shapes[:, 2 * step] - shapes[:, 0], shapes[:, 3 * step] - shapes[:, step])
    is_seen = normal @ forward < 0
    order = np.flatnonzero(is_seen)[np.argsort(-(shapes[is_seen].mean(axis=1) @ forward))]  # far ones first
    flat = np.stack([shapes[order] @ right, shapes[order] @ up], axis=-1)
    drawn = PolyCollection(flat, array=values[order], cmap="viridis", edgecolors=(0, 0, 0, 0.35), linewidths=0.4)
    axes.add_collection(drawn)
    axes.autoscale()
    axes.set_aspect("equal")
    axes.axis("off")
    axes.figure.colorbar(drawn, ax=axes, shrink=0.7)


def draw_solution(points, faces, values, path, title, direction=(-0.55, 0.65, -0.5)):
    """A picture of draw_faces alone; the values are those at the points (m,)."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(9, 6), layout="constrained")
    draw_faces(axes, points, faces, values[faces].mean(axis=1), direction)
    axes.set_title(title)
    figure.savefig(path, dpi=110)
