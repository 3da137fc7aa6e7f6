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
