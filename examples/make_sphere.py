"""Writes a sphere of radius 1 as OBJ: triangles of an octahedron, divided. Its one group is called sphere.

Usage: make_sphere.py sphere.obj
"""
import sys

import numpy as np

DIVISIONS = 40  # per edge of the octahedron: 12,800 triangles

lines, number_of = ["g sphere"], {}


def number(point):
    """Of a point of the octahedron, as the vertex of the sphere in its direction."""
    if point not in number_of:
        number_of[point] = len(number_of) + 1
        # the tangents of equal angles, so that the triangles are of like size
        angles = np.tan(np.array(point) / DIVISIONS * np.pi / 4)
        lines.append("v {:.9f} {:.9f} {:.9f}".format(*(angles / np.linalg.norm(angles))))
    return number_of[point]


faces = []
for signs in np.array(np.meshgrid([1, -1], [1, -1], [1, -1])).reshape(3, -1).T:
    order = (0, 1, 2) if np.prod(signs) > 0 else (0, 2, 1)  # counter-clockwise from outside

    def corner(i, j):
        x, y, z = signs * np.array([DIVISIONS - i - j, i, j])
        return number((int(x), int(y), int(z)))

    for i in range(DIVISIONS):
        for j in range(DIVISIONS - i):
            triangles = [(corner(i, j), corner(i + 1, j), corner(i, j + 1))]
            if i + j < DIVISIONS - 1:
                triangles.append((corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)))
            faces += ["f {} {} {}".format(*(t[k] for k in order)) for t in triangles]

with open(sys.argv[1], "w") as file:
    file.write("\n".join(lines + faces) + "\n")
