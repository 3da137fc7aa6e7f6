#!/usr/bin/env python3
"""Surfaces with a polycube labelling, for `hexwright polycube-map`.

Usage: labelled_surface.py SHAPE OUT_DIR [--cuts N]. Writes OUT_DIR/SHAPE.obj and OUT_DIR/SHAPE.labels.txt: one number per
triangle, 0 to 5 for +x, -x, +y, -y, +z, -z. Each shape is a polycube of unit cubes whose surface is cut into triangles and bent:
the labels are those of the polycube, whichever way the triangles look afterwards.
"""
import argparse
import math
from pathlib import Path

import numpy as np


def blob(p):
    """A cube rounded to a ball."""
    q = p - 0.5
    most = np.abs(q).max(axis=1, keepdims=True)
    length = np.linalg.norm(q, axis=1, keepdims=True)
    return q * most / np.where(length > 0, length, 1)


def bent(p, degrees):
    """A bar along x, bent about an axis along y."""
    angle = p[:, 0] / p[:, 0].max() * math.radians(degrees)
    radius = p[:, 0].max() / math.radians(degrees) + 0.5 - p[:, 2]
    return np.column_stack([radius * np.sin(angle), p[:, 1], -radius * np.cos(angle)])


def swollen(p):
    """Sides that bulge, and a twist."""
    middle = (p.min(axis=0) + p.max(axis=0)) / 2
    q = p - middle
    turn = 0.15 * q[:, 2:3]
    x, y = q[:, :1] * np.cos(turn) - q[:, 1:2] * np.sin(turn), q[:, :1] * np.sin(turn) + q[:, 1:2] * np.cos(turn)
    wave = 1 + 0.06 * np.sin(2 * q[:, [1, 2, 0]])
    return np.column_stack([x, y, q[:, 2:]]) * wave


def ring(p):
    """A square frame about z made round."""
    q = p - np.array([1.5, 1.5, 0.5])
    most = np.abs(q[:, :2]).max(axis=1, keepdims=True)
    length = np.linalg.norm(q[:, :2], axis=1, keepdims=True)
    return np.column_stack([q[:, :2] * most / np.where(length > 0, length, 1), q[:, 2]])


SHAPES = {
    "blob": ([(0, 0, 0)], blob),
    "ell": ([(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 0, 1), (0, 0, 2)], swollen),
    "bent_bar": ([(x, 0, 0) for x in range(5)], lambda p: bent(p, 100)),
    "hook": ([(x, 0, 0) for x in range(8)], lambda p: bent(p, 230)),
    "frame": ([(x, y, 0) for x in range(3) for y in range(3) if (x, y) != (1, 1)], swollen),
    "ring": ([(x, y, 0) for x in range(3) for y in range(3) if (x, y) != (1, 1)], ring),
    "stair": ([(0, 0, 0), (1, 0, 0), (2, 0, 0), (1, 0, 1), (2, 0, 1), (2, 0, 2)], swollen),
    # Refused: six faces meet in its inner corner.
    "tripod": ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], swollen),
}


def boundary_quads(cubes):
    """Unit squares between a cube and none, counter-clockwise seen from outside, with their labels."""
    inside = set(cubes)
    for cube in sorted(inside):
        for axis in range(3):
            for sign in (1, -1):
                other = list(cube)
                other[axis] += sign
                if tuple(other) in inside:
                    continue
                b, c = (axis + 1) % 3, (axis + 2) % 3
                corner = np.array(cube, float)
                corner[axis] += sign > 0
                u, v = np.zeros(3), np.zeros(3)
                u[b], v[c] = 1, 1
                yield corner, (u, v) if sign > 0 else (v, u), 2 * axis + (sign < 0)


def triangles(cubes, cuts):
    ids, points, tris, labels = {}, [], [], []

    def vertex(p):
        key = tuple(np.rint(p * cuts).astype(int))
        if key not in ids:
            ids[key] = len(points)
            points.append(p)
        return ids[key]

    for corner, (u, v), label in boundary_quads(cubes):
        for i in range(cuts):
            for j in range(cuts):
                a, b, c, d = (vertex(corner + (u * (i + k) + v * (j + l)) / cuts) for k, l in ((0, 0), (1, 0), (1, 1), (0, 1)))
                tris += [(a, b, c), (a, c, d)]
                labels += [label, label]
    return np.array(points), tris, labels


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("shape", choices=sorted(SHAPES))
    parser.add_argument("out", type=Path)
    parser.add_argument("--cuts", type=int, default=10, help="triangles along the edge of a unit cube")
    args = parser.parse_args()
    cubes, bend = SHAPES[args.shape]
    points, tris, labels = triangles(cubes, args.cuts)
    args.out.mkdir(parents=True, exist_ok=True)
    lines = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in bend(points)] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in tris]
    (args.out / f"{args.shape}.obj").write_text("\n".join(lines) + "\n")
    (args.out / f"{args.shape}.labels.txt").write_text("".join(f"{label}\n" for label in labels))


if __name__ == "__main__":
    main()
