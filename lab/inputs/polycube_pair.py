#!/usr/bin/env python3
"""Makes a pair of tetrahedral meshes whose polycube map compresses the part that has the detail.

Usage: polycube_pair.py OUT_STEM [--refine N]

Writes OUT_STEM_object.mesh and OUT_STEM_polycube.mesh (MEDIT). The polycube is a 4 x 4 x 2 base with a post of 1 x 1 x 1.5 on
it. In the object the post has become a head three times as wide and four times as high, with four fins around it: one unit of
the polycube stands for three to five units there, so that a regular grid of the polycube is coarsest where the object is finest.
--refine N cuts every cell of the tensor grid N times per axis (the number of tets grows with N cubed); the shape converges.

The map is exact on vertices and increasing along every axis, so all tets are positive in both meshes.
"""
import argparse
import itertools
import math

BASE = 2.0   # height of the base
POST = 1.5   # height of the post in the polycube
FINS = 4


def lines(stops, refine):
    """Grid lines through (coordinate, number of intervals up to it) stops."""
    result = [stops[0][0]]
    for (a, _), (b, count) in zip(stops, stops[1:]):
        n = count * refine
        result += [a + (b - a) * i / n for i in range(1, n + 1)]
    return result


def width(t):
    """Half the width of the head at height t in [0, 1] of the post: a neck, then fins."""
    neck = min(1.0, t / 0.4)
    core = 0.5 + 0.7 * neck * neck * (3 - 2 * neck)
    wave = 0.5 - 0.5 * math.cos(2 * math.pi * FINS * max(0.0, t - 0.3) / 0.7)
    return core + 0.3 * wave


def carry(p):
    """The object's point for a point of the polycube."""
    x, y, z = p
    if z <= BASE:
        return p
    t = (z - BASE) / POST
    scale = width(t) / 0.5
    return x * scale, y * scale, BASE + POST * t * (1 + 3 * min(1.0, 2 * t) * (1 - 0.25 * min(1.0, 2 * t)))


def make(refine):
    xs = lines([(-2, 0), (-0.5, 2), (0.5, 4), (2, 2)], refine)
    zs = lines([(0, 0), (BASE, 2), (BASE + POST, 30)], refine)
    ids, points, tets = {}, [], []

    def vertex(i, j, k):
        if (i, j, k) not in ids:
            ids[i, j, k] = len(points) + 1
            points.append((xs[i], xs[j], zs[k]))
        return ids[i, j, k]

    for k, j, i in itertools.product(range(len(zs) - 1), range(len(xs) - 1), range(len(xs) - 1)):
        center = [(xs[i] + xs[i + 1]) / 2, (xs[j] + xs[j + 1]) / 2, (zs[k] + zs[k + 1]) / 2]
        if center[2] > BASE and max(abs(center[0]), abs(center[1])) > 0.5:
            continue
        for order in itertools.permutations(range(3)):  # six tets around the cell's diagonal (Kuhn)
            at, tet = [i, j, k], [vertex(i, j, k)]
            for axis in order:
                at[axis] += 1
                tet.append(vertex(*at))
            if order in ((0, 2, 1), (1, 0, 2), (2, 1, 0)):  # odd permutations are mirrored
                tet[2], tet[3] = tet[3], tet[2]
            tets.append(tet)
    return points, tets


def write(path, points, tets):
    with open(path, "w", encoding="ascii") as out:
        out.write(f"MeshVersionFormatted 2\nDimension 3\nVertices\n{len(points)}\n")
        for p in points:
            out.write(" ".join(f"{c:.6g}" for c in p) + " 0\n")
        out.write(f"Tetrahedra\n{len(tets)}\n")
        for t in tets:
            out.write(" ".join(map(str, t)) + " 0\n")
        out.write("End\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("stem")
    parser.add_argument("--refine", type=int, default=1)
    args = parser.parse_args()
    points, tets = make(args.refine)
    write(args.stem + "_polycube.mesh", points, tets)
    write(args.stem + "_object.mesh", [carry(p) for p in points], tets)
    print(f"{args.stem}: {len(points)} vertices, {len(tets)} tets")


if __name__ == "__main__":
    main()
