#!/usr/bin/env python3
"""Writes a box of equal cubes around a surface: a background for `hexwright fit` that no sizing has touched.

Example: lab/inputs/uniform_background.py part.off 40 background.mesh && hexwright fit background.mesh part.off -o part.vtu

`cells` cubes lie along the longest side of the surface's bounding box; two more on each side cover it. The box is set
off the surface's symmetry planes, as grids in practice are.
"""
import argparse
import math
from pathlib import Path

OFF_CENTER = (0.137, 0.071, 0.113)  # in cubes


def read_vertices(path):
    """Vertices of an OBJ, OFF or text PLY file."""
    lines = [l for l in Path(path).read_text(errors="replace").splitlines() if l.strip() and not l.startswith("#")]
    suffix = Path(path).suffix.lower()
    if suffix == ".obj":
        return [tuple(map(float, l.split()[1:4])) for l in lines if l.startswith("v ")]
    if suffix == ".off":
        count = int(lines[1].split()[0])
        return [tuple(map(float, l.split()[:3])) for l in lines[2:2 + count]]
    raise SystemExit(f"{path}: only OBJ and OFF are read here")


def write_medit(path, origin, h, counts):
    nx, ny, nz = counts

    def index(x, y, z):
        return (z * (ny + 1) + y) * (nx + 1) + x + 1

    with open(path, "w") as out:
        out.write("MeshVersionFormatted 2\nDimension 3\nVertices\n%d\n" % ((nx + 1) * (ny + 1) * (nz + 1)))
        for z in range(nz + 1):
            for y in range(ny + 1):
                for x in range(nx + 1):
                    out.write("%.17g %.17g %.17g 0\n" % (origin[0] + h * x, origin[1] + h * y, origin[2] + h * z))
        out.write("Hexahedra\n%d\n" % (nx * ny * nz))
        for z in range(nz):
            for y in range(ny):
                for x in range(nx):
                    ring = ((x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1))
                    verts = [index(a, b, z) for a, b in ring] + [index(a, b, z + 1) for a, b in ring]
                    out.write(" ".join(map(str, verts)) + " 0\n")
        out.write("End\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("surface")
    parser.add_argument("cells", type=int)
    parser.add_argument("output", help="MEDIT .mesh")
    args = parser.parse_args()
    vertices = read_vertices(args.surface)
    lo = [min(v[k] for v in vertices) for k in range(3)]
    hi = [max(v[k] for v in vertices) for k in range(3)]
    h = max(b - a for a, b in zip(lo, hi)) / args.cells
    counts = [math.ceil((b - a) / h) + 4 for a, b in zip(lo, hi)]
    origin = [(a + b) / 2 - 0.5 * h * n + h * s for a, b, n, s in zip(lo, hi, counts, OFF_CENTER)]
    write_medit(args.output, origin, h, counts)


if __name__ == "__main__":
    main()
