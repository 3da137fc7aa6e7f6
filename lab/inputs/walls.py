#!/usr/bin/env python3
"""Shapes with named walls, and how high the layers along them came out.

Usage: walls.py make SHAPE OUT.obj
       walls.py measure SHAPE MESH.mesh REPORT.json PROGRAM

`measure` prints one JSON object: for each layer the median over its corners of the height across the wall (by the shape's
exact distance) over the one asked for (a share of the mean wall edge there times the growth), and, where OpenFOAM is
installed, what its checkMesh says of the mesh.
"""
import json
import math
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.append(str(Path(__file__).parents[2] / "tests/solver"))
import openfoam  # noqa: E402


def prism(outline, height, names, caps=("back", "front")):
    """Over a counter-clockwise polygon; one name per edge. Triangulated caps."""
    n = len(outline)
    verts = [(x, y, 0) for x, y in outline] + [(x, y, height) for x, y in outline]
    groups = {}
    for i in range(n):
        j = (i + 1) % n
        groups.setdefault(names[i], []).extend([(i, j, n + j), (i, n + j, n + i)])
    ears = triangulate(outline)
    groups.setdefault(caps[0], []).extend((a, c, b) for a, b, c in ears)
    groups.setdefault(caps[1], []).extend((n + a, n + b, n + c) for a, b, c in ears)
    return verts, groups


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def triangulate(outline):
    """By cutting ears."""
    def is_ear(a, b, c):
        pa, pb, pc = outline[a], outline[b], outline[c]
        if turn(pa, pb, pc) <= 1e-14:
            return False
        return not any(turn(pa, pb, outline[p]) >= -1e-14 and turn(pb, pc, outline[p]) >= -1e-14 and turn(pc, pa, outline[p]) >= -1e-14
                       for p in left if p not in (a, b, c))

    left, triangles = list(range(len(outline))), []
    while len(left) > 3:
        k = next(k for k in range(len(left)) if is_ear(left[k - 1], left[k], left[(k + 1) % len(left)]))
        triangles.append((left[k - 1], left[k], left[(k + 1) % len(left)]))
        left.pop(k)
    return triangles + [tuple(left)]


def tube(start, end, radius, names, segments=128):
    """A closed cylinder; names of its side, its start and its end."""
    axis = [(e - s) for s, e in zip(start, end)]
    length = math.sqrt(sum(a * a for a in axis))
    axis = [a / length for a in axis]
    other = (0, 1, 0) if abs(axis[1]) < 0.5 else (1, 0, 0)
    x = cross(other, axis)
    size = math.sqrt(sum(a * a for a in x))
    x = [a / size for a in x]
    y = cross(axis, x)
    verts, groups = [], {}
    for place in (start, end):
        for k in range(segments):
            c, s = radius * math.cos(2 * math.pi * k / segments), radius * math.sin(2 * math.pi * k / segments)
            verts.append(tuple(p + c * a + s * b for p, a, b in zip(place, x, y)))
    verts += [tuple(start), tuple(end)]
    for k in range(segments):
        j = (k + 1) % segments
        groups.setdefault(names[0], []).extend([(k, j, segments + j), (k, segments + j, segments + k)])
        groups.setdefault(names[1], []).append((2 * segments, j, k))
        groups.setdefault(names[2], []).append((2 * segments + 1, segments + k, segments + j))
    return verts, groups


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def joined(*parts):
    verts, groups = [], {}
    for some, of in parts:
        for name, faces in of.items():
            groups.setdefault(name, []).extend(tuple(len(verts) + i for i in f) for f in faces)
        verts = verts + some
    return verts, groups


def sphere(rings=64):
    verts, faces, around = [(0, 0, 1)], [], 2 * rings
    for i in range(1, rings):
        t = math.pi * i / rings
        verts += [(math.sin(t) * math.cos(math.pi * j / rings), math.sin(t) * math.sin(math.pi * j / rings), math.cos(t)) for j in range(around)]
    verts.append((0, 0, -1))
    for j in range(around):
        k = (j + 1) % around
        faces += [(0, 1 + j, 1 + k), (len(verts) - 2 - (around - 1 - j), len(verts) - 1, len(verts) - 2 - (around - 1 - k))]
        for i in range(rings - 2):
            a, b = 1 + i * around + j, 1 + i * around + k
            faces += [(a, a + around, b + around), (a, b + around, b)]
    return verts, {"wall": faces}


def wing_outline(count=80, thickness=0.12):
    """NACA 0012 with a sharp trailing edge, counter-clockwise."""
    def half(x):
        return 5 * thickness * (0.2969 * math.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    stations = [0.5 * (1 - math.cos(math.pi * i / count)) for i in range(count + 1)]
    lower = [(x, -half(x)) for x in stations[:-1]] + [(1, 0)]
    return lower + [(x, half(x)) for x in stations[-2:0:-1]]


ELL = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
WEDGE = [(0, 0), (1, -math.tan(math.radians(10))), (1, math.tan(math.radians(10)))]
BOX = [(0, 0), (4, 0), (4, 2), (0, 2)]


def to_segments(outline, is_wall):
    """Distance across the prism's walls, which are those edges."""
    edges = [(outline[i], outline[(i + 1) % len(outline)]) for i in range(len(outline)) if is_wall(i)]

    def distance(p):
        return min(to_segment(p, a, b) for a, b in edges)
    return distance


def to_segment(p, a, b):
    d = (b[0] - a[0], b[1] - a[1])
    t = max(0.0, min(1.0, ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / (d[0] ** 2 + d[1] ** 2)))
    return math.sqrt((p[0] - a[0] - t * d[0]) ** 2 + (p[1] - a[1] - t * d[1]) ** 2)


def radius_of(p):
    return math.sqrt(p[0] ** 2 + p[1] ** 2 + p[2] ** 2)


SHAPES = {
    "plate": lambda: prism(BOX, 1.5, ["wall", "outlet", "top", "inlet"]),
    "channel": lambda: prism(BOX, 1.5, ["wall", "outlet", "wall", "inlet"]),
    "inner edge": lambda: prism([(0, 0), (2, 0), (2, 2), (0, 2)], 1, ["wall", "o1", "o2", "wall"]),
    "outer edge": lambda: prism(ELL, 1, ["o1", "o2", "wall", "wall", "o3", "o4"]),
    "sphere, inside": sphere,
    "sphere, outside": sphere,
    "pipe": lambda: tube((0, 0, 0), (0, 0, 4), 1, ("wall", "inlet", "outlet")),
    "T-junction": lambda: joined(tube((-3, 0, 0), (3, 0, 0), 1, ("wall", "inlet", "outlet0")),
                                 tube((0, 0, 0), (0, 0, 3), 0.7, ("wall", "wall", "outlet1"))),
    "wing, outside": lambda: prism(wing_outline(), 1, ["wall"] * 160, ("tip", "tip")),
    "edge of 20 degrees, outside": lambda: prism(WEDGE, 1, ["wall", "wall", "wall"], ("tip", "tip")),
}
# Distance across the wall, where one formula gives it.
HEIGHT = {
    "plate": lambda p: p[1],
    "channel": lambda p: min(p[1], 2 - p[1]),
    "inner edge": lambda p: min(p[0], p[1]),
    "outer edge": to_segments(ELL, lambda i: i in (2, 3)),
    "sphere, inside": lambda p: 1 - radius_of(p),
    "sphere, outside": lambda p: radius_of(p) - 1,
    "pipe": lambda p: 1 - math.sqrt(p[0] ** 2 + p[1] ** 2),
    "T-junction": lambda p: max(1 - math.sqrt(p[1] ** 2 + p[2] ** 2), (0.7 - math.sqrt(p[0] ** 2 + p[1] ** 2)) if p[2] > 0 else -9),
    "wing, outside": to_segments(wing_outline(), lambda i: True),
    "edge of 20 degrees, outside": to_segments(WEDGE, lambda i: True),
}
SPAN = {"wing, outside": 1, "edge of 20 degrees, outside": 1}  # heights are measured between the tips


def make(shape, path):
    write_obj(*SHAPES[shape](), path)


def write_obj(verts, groups, path):
    lines = ["v %.12g %.12g %.12g" % v for v in verts]
    for name, faces in groups.items():
        lines += [f"g {name}"] + ["f %d %d %d" % tuple(i + 1 for i in f) for f in faces]
    Path(path).write_text("\n".join(lines) + "\n")


def read_mesh(path):
    """Vertices and hexes of a MEDIT file."""
    tokens = Path(path).read_text().split()

    def rows(word, width):
        at = tokens.index(word)
        count = int(tokens[at + 1])
        return [tokens[at + 2 + width * i:at + 2 + width * (i + 1)] for i in range(count)]
    verts = [tuple(map(float, row[:3])) for row in rows("Vertices", 4)]
    return verts, [[int(i) - 1 for i in row[:8]] for row in rows("Hexahedra", 9)]


def layer_ratios(shape, verts, hexes, report):
    """Median height over the wish per layer. Layers of a sheet's hex are the last hexes, from the wall on."""
    spec, sheet = report["options"]["layers"][0], report["layers"]["sheet_hexes"]
    count, growth = spec["count"], spec["growth"]
    stacks = [hexes[len(hexes) - count * (sheet - q):][:count] for q in range(sheet)]
    edges = {}
    for stack in stacks:
        wall = stack[0][4:]
        for a, b in zip(wall, wall[1:] + wall[:1]):
            length = math.dist(verts[a], verts[b])
            for v in (a, b):
                edges.setdefault(v, []).append(length)
    across, span, ratios = HEIGHT[shape], SPAN.get(shape), [[] for _ in range(count)]
    for stack in stacks:
        for k in range(4):
            wall = stack[0][4 + k]
            wish = spec["first"] * sum(edges[wall]) / len(edges[wall])
            if span and not all(0.02 < verts[v][2] < span - 0.02 for v in (wall, stack[-1][k])):
                continue
            for layer, cells in enumerate(stack):
                height = across(verts[cells[k]]) - across(verts[cells[4 + k]])
                ratios[layer].append(height / (wish * growth**layer))
    return [round(sorted(r)[len(r) // 2], 4) for r in ratios]


def check_mesh(mesh, program):
    """Non-orthogonality, skewness and verdict of OpenFOAM's checkMesh; None where it is not installed."""
    if not shutil.which("checkMesh"):
        return None
    with tempfile.TemporaryDirectory() as case:
        (Path(case) / "constant").mkdir()
        subprocess.run([program, "convert", mesh, f"{case}/constant/polyMesh"], check=True, capture_output=True)
        said = openfoam.check_mesh(Path(case))
    figures = openfoam.read_figures(said)
    return {"ok": openfoam.is_content(said), "non_orthogonality": figures.get("non-orthogonality"),
            "mean_non_orthogonality": figures.get("mean non-orthogonality"), "skewness": figures.get("skewness"),
            "failed": openfoam.list_failures(said)}


def measure(shape, mesh, report, program):
    report = json.loads(Path(report).read_text())
    quality = report["verdict"]["quality"]
    print(json.dumps({"ratios": layer_ratios(shape, *read_mesh(mesh), report), "check_mesh": check_mesh(mesh, program),
                      "mesh": {"hexes": report["hexes"], "coverage": report["layers"]["coverage"], "inverted": quality["inverted"],
                               "least": quality["min_scaled_jacobian"]}}))


def main(arguments):
    if len(arguments) == 3 and arguments[0] == "make":
        return make(*arguments[1:])
    if len(arguments) == 5 and arguments[0] == "measure":
        return measure(*arguments[1:])
    sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
