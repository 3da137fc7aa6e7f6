#!/usr/bin/env python3
"""Draws the figures of docs/algorithms/dual.md: the dual stage in two dimensions.

Usage: draw_pillows.py OUTPUT_DIR [HEXWRIGHT]. Writes pillow_2d.svg (the pillows around one block) and
sheet_2d.svg (a sheet through a thin layer). Everything is computed: the lattice, the split nodes,
their core lines and the closed curves around them. With the program hexwright also pillow_3d.png and
sheet_3d.png: the real meshes of such a block and of such a layer, cut open.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

UNIT = 60  # pixels per coarse cell


class Figure:
    def __init__(self, width, height):
        self.width, self.height = width, height
        self.parts = []

    def line(self, a, b, color, width=1.0, dash=""):
        (x0, y0), (x1, y1) = self.at(a), self.at(b)
        extra = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(f'<line x1="{x0:g}" y1="{y0:g}" x2="{x1:g}" y2="{y1:g}" stroke="{color}" '
                          f'stroke-width="{width:g}"{extra}/>')

    def rounded(self, low, high, color):
        (x0, y1), (x1, y0) = self.at(low), self.at(high)
        self.parts.append(f'<rect x="{x0:g}" y="{y0:g}" width="{x1 - x0:g}" height="{y1 - y0:g}" rx="9" '
                          f'fill="none" stroke="{color}" stroke-width="2.5"/>')

    def cell(self, low, size, color):
        x0, y1 = self.at(low)
        self.parts.append(f'<rect x="{x0:g}" y="{y1 - size * UNIT:g}" width="{size * UNIT:g}" '
                          f'height="{size * UNIT:g}" fill="{color}"/>')

    def at(self, p):
        return 10 + p[0] * UNIT, 10 + (self.height - p[1]) * UNIT

    def write(self, path):
        w, h = self.width * UNIT + 20, self.height * UNIT + 20
        body = "\n".join(self.parts)
        path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" width="{w}" height="{h}" '
                        f'viewBox="0 0 {w} {h}">\n<rect width="100%" height="100%" fill="white"/>\n{body}\n</svg>\n')


def core_coordinate(c, parity):
    """The end of the node [c, c + 1] that lies on a core line of this parity."""
    return c if c % 2 == parity else c + 1


def runs(values):
    """Maximal runs of consecutive integers."""
    out = []
    for v in sorted(values):
        if out and out[-1][1] == v:
            out[-1][1] = v + 1
        else:
            out.append([v, v + 1])
    return out


def draw(path, width, height, split, parity):
    figure = Figure(width, height)
    for node in split:
        figure.cell(node, 1, "#e8eef7")
    for x in range(width + 1):
        figure.line((x, 0), (x, height), "#999999")
    for y in range(height + 1):
        figure.line((0, y), (width, y), "#999999")
    for axis, color in ((0, "#c0392b"), (1, "#2471a3")):
        other = 1 - axis
        lines = {}
        for node in split:
            lines.setdefault(core_coordinate(node[axis], parity[axis]), set()).add(node[other])
        for line, along in lines.items():
            for first, last in runs(along):
                low, high = [0, 0], [0, 0]
                low[axis], high[axis] = line - 0.5, line + 0.5
                # Half a cap's height beyond the nodes; the later axis is the inner one.
                margin = 0.28 if axis == 0 else 0.16
                low[other], high[other] = first - margin, last + margin
                core_low, core_high = list(low), list(high)
                core_low[axis] = core_high[axis] = line
                core_low[other], core_high[other] = first, last
                figure.line(core_low, core_high, color, 3, "2 4")
                figure.rounded(low, high, color)
    figure.write(path)


def picture(program, path, level, split):
    """Meshes the grid of 2^level cubed cells of which `split` are split once, and draws it cut open."""
    n = 2 ** level
    lines = []
    for cell in ((x, y, z) for x in range(n) for y in range(n) for z in range(n)):
        if cell not in split:
            lines.append("%d %d %d %d" % (level, *cell))
            continue
        lines += ["%d %d %d %d" % (level + 1, *(2 * c + (q >> a & 1) for a, c in enumerate(cell))) for q in range(8)]
    with tempfile.TemporaryDirectory() as folder:
        grid, mesh = Path(folder) / "grid.cells", Path(folder) / "mesh.vtu"
        grid.write_text("\n".join(lines) + "\n")
        subprocess.run([program, "dual", grid, "-o", mesh, "--quiet"], check=True)
        subprocess.run([program, "picture", mesh, "-o", path, "--cut", "x", "--cut-at", "0.45", "--width", "700",
                        "--height", "600", "--quiet"], check=True)


def main() -> int:
    out = Path(sys.argv[1])
    out.mkdir(parents=True, exist_ok=True)
    block = [(x, y) for x in (1, 2) for y in (1, 2)]
    draw(out / "pillow_2d.svg", 4, 4, block, (0, 0))
    layer = [(x, 1) for x in range(1, 7)]
    draw(out / "sheet_2d.svg", 8, 3, layer, (0, 0))
    if len(sys.argv) > 2:
        box = [(x, y, z) for x in (1, 2) for y in (1, 2) for z in (1, 2)]
        picture(sys.argv[2], out / "pillow_3d.png", 2, set(box))
        picture(sys.argv[2], out / "sheet_3d.png", 3, {(x, y, 3) for x in range(1, 7) for y in range(1, 7)})
    return 0


if __name__ == "__main__":
    sys.exit(main())
