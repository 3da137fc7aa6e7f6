"""Surfaces that the problems of this folder are solved on, as OBJ files with named groups."""
import math
from pathlib import Path


class Surface:
    """Quads in named groups; points are welded by the reader."""

    def __init__(self):
        self.points, self.groups = [], {}

    def grid(self, name, rows):
        """Quads between rows of points; counter-clockwise from outside when (along the row) x (to the next row) points
        outwards."""
        quads = self.groups.setdefault(name, [])
        for row, above in zip(rows, rows[1:]):
            for k in range(len(row) - 1):
                first = len(self.points) + 1
                self.points += [row[k], row[k + 1], above[k + 1], above[k]]
                quads.append(tuple(range(first, first + 4)))

    def write(self, path: Path):
        with open(path, "w") as out:
            for p in self.points:
                out.write("v {:.17g} {:.17g} {:.17g}\n".format(*p))
            for name, quads in self.groups.items():
                out.write(f"g {name}\n")
                for a, b, c, d in quads:
                    out.write(f"f {a} {b} {c}\nf {a} {c} {d}\n")


def quarter_ring(path: Path, inner=1.0, outer=2.0, height=0.5, segments=360):
    """A quarter of a thick cylinder about z: patches inner, outer, bottom, top and, where it is cut, xmin and ymin."""
    angles = [math.pi / 2 * k / segments for k in range(segments + 1)]

    def arc(radius, z):
        return [(radius * math.cos(t) if k < segments else 0.0, radius * math.sin(t), z) for k, t in enumerate(angles)]

    ring = Surface()
    ring.grid("outer", [arc(outer, 0), arc(outer, height)])
    ring.grid("inner", [arc(inner, height), arc(inner, 0)])
    ring.grid("bottom", [arc(inner, 0), arc(outer, 0)])
    ring.grid("top", [arc(outer, height), arc(inner, height)])
    ring.grid("xmin", [[(0.0, outer, 0), (0.0, inner, 0)], [(0.0, outer, height), (0.0, inner, height)]])
    ring.grid("ymin", [[(inner, 0.0, 0), (outer, 0.0, 0)], [(inner, 0.0, height), (outer, 0.0, height)]])
    ring.write(path)


def eighth_shell(path: Path, inner=1.0, outer=2.0, segments=120):
    """An eighth of a hollow sphere: patches inner, outer and, where it is cut, xmin, ymin and zmin."""
    angles = [math.pi / 2 * k / segments for k in range(segments + 1)]

    def point(radius, up, around):  # exactly on the planes of the cuts
        x, y, z = math.cos(up) * math.cos(around), math.cos(up) * math.sin(around), math.sin(up)
        return tuple(radius * c if abs(c) > 1e-12 else 0.0 for c in (x, y, z))

    def circle(radius, up):
        return [point(radius, up, around) for around in angles]

    shell = Surface()
    shell.grid("outer", [circle(outer, up) for up in angles])
    shell.grid("inner", [circle(inner, up) for up in angles[::-1]])
    shell.grid("zmin", [circle(inner, 0), circle(outer, 0)])
    shell.grid("ymin", [[point(r, up, 0) for up in angles] for r in (outer, inner)])
    shell.grid("xmin", [[point(r, up, math.pi / 2) for up in angles] for r in (inner, outer)])
    shell.write(path)


def quarter_ellipse(path: Path, heights, segments=360):
    """A quarter of an elliptic plate with an elliptic hole (of the NAFEMS benchmarks LE1 and LE10) between the first and
    the last of the heights: patches inner, bottom, top, xmin, ymin, and outer0, outer1 ... between the heights."""
    angles = [math.pi / 2 * k / segments for k in range(segments + 1)]

    def arc(a, b, z):
        return [(a * math.cos(t) if k < segments else 0.0, b * math.sin(t), z) for k, t in enumerate(angles)]

    def inner(z):
        return arc(2.0, 1.0, z)

    def outer(z):
        return arc(3.25, 2.75, z)

    low, high = heights[0], heights[-1]
    plate = Surface()
    for k, (z, above) in enumerate(zip(heights, heights[1:])):
        plate.grid(f"outer{k}", [outer(z), outer(above)])
    plate.grid("inner", [inner(z) for z in heights[::-1]])
    plate.grid("bottom", [inner(low), outer(low)])
    plate.grid("top", [outer(high), inner(high)])
    plate.grid("xmin", [[outer(z)[-1], inner(z)[-1]] for z in heights])
    plate.grid("ymin", [[inner(z)[0], outer(z)[0]] for z in heights])
    plate.write(path)


def quarter_of_revolution(path: Path, inner, outer, segments=180):
    """A quarter of a body between two profiles, lists of (name, points (r, z)) from below; both have the same number of
    points. Patches of these names, bottom, top and, where it is cut, xmin and ymin."""
    angles = [math.pi / 2 * k / segments for k in range(segments + 1)]

    def circle(point):
        r, z = point
        return [(r * math.cos(t) if k < segments else 0.0, r * math.sin(t), z) for k, t in enumerate(angles)]

    body = Surface()
    for name, points in outer:
        body.grid(name, [circle(p) for p in points])
    for name, points in inner:
        body.grid(name, [circle(p) for p in points[::-1]])
    inside, outside = ([p for _, points in part for p in points] for part in (inner, outer))
    body.grid("bottom", [circle(inside[0]), circle(outside[0])])
    body.grid("top", [circle(outside[-1]), circle(inside[-1])])
    body.grid("ymin", [[(a[0], 0.0, a[1]), (b[0], 0.0, b[1])] for a, b in zip(inside, outside) if a != b])
    body.grid("xmin", [[(0.0, b[0], b[1]), (0.0, a[0], a[1])] for a, b in zip(inside, outside) if a != b])
    body.write(path)


def quarter_plate_with_hole(path: Path, radius=1.0, width=20.0, height=1.0, segments=180):
    """A quarter of a square plate: patches hole, xmax, ymax, bottom, top and, where it is cut, xmin and ymin."""
    angles = [math.pi / 2 * k / segments for k in range(segments + 1)]

    def hole(z):
        return [(radius * math.cos(t) if k < segments else 0.0, radius * math.sin(t), z) for k, t in enumerate(angles)]

    def edge(z):
        """Where the ray of each angle leaves the plate; one of them meets its corner."""
        return [(width if t < math.pi / 4 + 1e-9 else width / math.tan(t) if k < segments else 0.0,
                 width * math.tan(t) if t < math.pi / 4 - 1e-9 else width, z) for k, t in enumerate(angles)]

    half = segments // 2
    plate = Surface()
    plate.grid("xmax", [edge(0)[:half + 1], edge(height)[:half + 1]])
    plate.grid("ymax", [edge(0)[half:], edge(height)[half:]])
    plate.grid("hole", [hole(height), hole(0)])
    plate.grid("bottom", [hole(0), edge(0)])
    plate.grid("top", [edge(height), hole(height)])
    plate.grid("xmin", [[edge(z)[-1], hole(z)[-1]] for z in (0, height)])
    plate.grid("ymin", [[hole(z)[0], edge(z)[0]] for z in (0, height)])
    plate.write(path)


def box(path: Path, low, high):
    """Patches xmin, xmax ... zmax."""
    def corner(bits):
        return tuple((low, high)[bits >> axis & 1][axis] for axis in range(3))

    faces = {"xmin": (0, 4, 6, 2), "xmax": (1, 3, 7, 5), "ymin": (0, 1, 5, 4), "ymax": (2, 6, 7, 3), "zmin": (0, 2, 3, 1),
             "zmax": (4, 5, 7, 6)}
    body = Surface()
    for name, (a, b, c, d) in faces.items():
        body.grid(name, [[corner(a), corner(b)], [corner(d), corner(c)]])
    body.write(path)
