#!/usr/bin/env python3
"""The union of the closed pieces of an STL file, by the package manifold3d: what a mesh of the file is compared with.

Usage: united.py IN.stl OUT.obj
"""
import struct
import sys
from pathlib import Path

import numpy as np
from manifold3d import Manifold, Mesh64, OpType


def read_stl(path):
    """Corners of the triangles, n x 3 x 3."""
    data = Path(path).read_bytes()
    if data[:5] == b"solid" and b"facet" in data[:300]:
        numbers = [line.split()[1:] for line in data.decode().splitlines() if line.split()[:1] == ["vertex"]]
        return np.array(numbers, float).reshape(-1, 3, 3)
    count = struct.unpack("<I", data[80:84])[0]
    rows = np.frombuffer(data, np.dtype([("numbers", "<12f4"), ("attribute", "<u2")]), count, 84)
    return rows["numbers"][:, 3:].reshape(-1, 3, 3).astype(float)


def pieces(corners):
    """Meshes of what hangs together by runs of the file: a part's triangles follow each other there and share vertices."""
    verts, index = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    tris = index.reshape(-1, 3)
    start, known = 0, set()
    for t in range(len(tris) + 1):
        part = tris[start:t]
        if t < len(tris) and (t == start or known & set(tris[t]) or not is_closed(part)):
            known.update(tris[t])
            continue
        yield verts, part
        start, known = t, set(tris[t]) if t < len(tris) else set()


def is_closed(tris):
    sides = {(a, b) for t in tris for a, b in zip(t, np.roll(t, -1))}
    return all((b, a) in sides for a, b in sides)


def solid_of(verts, tris):
    used, index = np.unique(tris, return_inverse=True)
    solid = Manifold(Mesh64(vert_properties=verts[used], tri_verts=index.reshape(-1, 3).astype(np.uint64)))
    if solid.is_empty():
        sys.exit(f"a piece is no solid: {solid.status()}")
    return solid


def main(source, target):
    mesh = Manifold.batch_boolean([solid_of(*p) for p in pieces(read_stl(source))], OpType.Add).to_mesh64()
    lines = ["v " + " ".join(repr(float(x)) for x in p[:3]) for p in mesh.vert_properties]
    lines += ["f " + " ".join(str(v + 1) for v in t) for t in mesh.tri_verts]
    Path(target).write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
