#!/usr/bin/env python3
"""Pictures of docs/algorithms/surface.md: what files hold, and the mesh that comes of it, a pair for each step of preparation.

Usage: surface_pictures.py [PROGRAM] [FOLDER], default build/release/hexwright and docs/images.
Triangles of a file are drawn as thin plates, a little apart from each other, so that those inside are seen where the cut
opens the object; both pictures of a pair are cut at the same place.
"""
import math
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SIZE = ["--width", "420", "--height", "320"]


def add(a, b, s=1.0):
    return tuple(x + s * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def box(lo, hi):
    """Triangles of a box, pointing outwards."""
    p = [tuple((lo, hi)[(i >> k) & 1][k] for k in range(3)) for i in range(8)]
    quads = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
    return [(p[q[i]], p[q[j]], p[q[k]]) for q in quads for i, j, k in ((0, 1, 2), (0, 2, 3))]


def finer(tris, times=2):
    """Each triangle in four, so that plates show the shape."""
    for _ in range(times):
        parts = []
        for a, b, c in tris:
            ab, bc, ca = (tuple((x + y) / 2 for x, y in zip(p, q)) for p, q in ((a, b), (b, c), (c, a)))
            parts += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        tris = parts
    return tris


def turn_every_third(tris):
    return [t if i % 3 else (t[0], t[2], t[1]) for i, t in enumerate(tris)]


def slit_tris():
    """A block with a slit of no width from one side, whose walls have other corners."""
    lower, upper = [(0, 0), (10, 0), (10, 5), (8, 5), (5, 5), (3, 5)], [(0, 10), (0, 0), (3, 5), (10, 5), (10, 10)]
    tris = []
    for ring in (lower, upper):
        for b, c in zip(ring[1:], ring[2:]):
            a = ring[0]
            tris += [((*a, 4.0), (*b, 4.0), (*c, 4.0)), ((*a, 0.0), (*c, 0.0), (*b, 0.0))]
    loop = [*lower, (10, 5), (10, 10), (0, 10)]
    for i, a in enumerate(loop):
        b = loop[(i + 1) % len(loop)]
        tris += [((*a, 0.0), (*b, 0.0), (*b, 4.0)), ((*a, 0.0), (*b, 4.0), (*a, 4.0))]
    return tris


BLOCK, POST = box((0, 0, 0), (10, 10, 4)), box((3, 3, -2), (7, 7, 9))

# Name, triangles, axis and place of the cut.
STEPS = [
    ("weld", [tuple(add(p, (1e-6 * (i % 3),) * 3) for p in t) for i, t in enumerate(BLOCK)], "y", 0.6),
    ("flat", [*finer(BLOCK), ((0, 0, 4), (2.5, 0, 4), (5, 0, 4)), ((0, 10, 4), (5, 10, 4), (7.5, 10, 4))], "y", 0.6),
    ("copies", BLOCK + box((10, 0, 0), (16, 10, 4)) + BLOCK[:2], "y", 0.6),
    ("orient", turn_every_third(finer(BLOCK)), "y", 0.6),
    ("holes", [t for t in finer(BLOCK) if not all(p[2] == 4 and 2 < p[0] < 8 and 2 < p[1] < 8 for p in t)], "y", 0.85),
    ("unite", BLOCK + POST, "y", 0.55),
    ("slit", slit_tris(), "z", 0.6),
    ("small", BLOCK + box((11, 5, 2), (11.03, 5.03, 2.03)), "y", 0.6),
    ("hidden", BLOCK + [((5, 2, 1), (5, 8, 1), (5, 8, 3)), ((5, 2, 1), (5, 8, 3), (5, 2, 3))], "y", 0.6),
    ("apart", BLOCK + box((2, 2, 4.02), (8, 8, 8)), "y", 0.6),
]


def write_obj(path, tris):
    lines = [f"v {x!r} {y!r} {z!r}" for t in tris for x, y, z in map(lambda p: tuple(map(float, p)), t)]
    lines += [f"f {3 * i + 1} {3 * i + 2} {3 * i + 3}" for i in range(len(tris))]
    path.write_text("\n".join(lines) + "\n")


def write_plates(path, tris, thickness=0.06, room=0.06):
    """Three hexes for each triangle, in the MEDIT format."""
    verts, hexes = [], []
    for t in tris:
        center = tuple(sum(p[k] for p in t) / 3 for k in range(3))
        a, b, c = (add(p, add(center, p, -1), room) for p in t)
        normal = cross(add(b, a, -1), add(c, a, -1))
        length = math.sqrt(sum(x * x for x in normal)) or 1
        up = tuple(thickness * x / length for x in normal)
        mids = [tuple((x + y) / 2 for x, y in zip(p, q)) for p, q in ((a, b), (b, c), (c, a))]
        corners = (a, b, c)
        for k in range(3):
            quad = [corners[k], mids[k], center, mids[k - 1]]
            first = len(verts) + 1
            verts += [add(p, up, -0.5) for p in quad] + [add(p, up, 0.5) for p in quad]
            hexes.append(range(first, first + 8))
    lines = ["MeshVersionFormatted 2", "Dimension 3", "Vertices", str(len(verts))]
    lines += [f"{x} {y} {z} 0" for x, y, z in verts] + ["Hexahedra", str(len(hexes))]
    lines += [" ".join(map(str, h)) + " 1" for h in hexes] + ["End"]
    path.write_text("\n".join(lines) + "\n")


def main(program, folder):
    for name, tris, axis, place in STEPS:
        with tempfile.TemporaryDirectory() as out:
            surface, plates, mesh = (Path(out) / n for n in ("s.obj", "plates.mesh", "mesh.vtu"))
            write_obj(surface, tris)
            write_plates(plates, tris)
            subprocess.run([program, "mesh", surface, "-o", mesh, "--size", "5%", "--quiet"], check=False)
            for path, kind in ((plates, "before"), (mesh, "after")):
                subprocess.run([program, "picture", path, "-o", folder / f"surface_{name}_{kind}.png", "--cut", axis, "--cut-at", str(place),
                                "--quiet", *SIZE], check=True)


if __name__ == "__main__":
    given = sys.argv[1:]
    main(*(list(map(Path, given)) + [ROOT / "build/release/hexwright", ROOT / "docs/images"][len(given):]))
