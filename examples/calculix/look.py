"""Draws what CalculiX found: von Mises stress on the deformed bracket, and says the largest values.

Usage: look.py mesh.inp bracket.frd bracket.png
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent))
from draw_solution import draw_solution

#: Nodes around the faces S1 to S6 of an element, counter-clockwise seen from outside.
FACES = [
    (0, 11, 3, 10, 2, 9, 1, 8), (4, 12, 5, 13, 6, 14, 7, 15), (0, 8, 1, 17, 5, 12, 4, 16),
    (1, 9, 2, 18, 6, 13, 5, 17), (2, 10, 3, 19, 7, 14, 6, 18), (3, 11, 0, 16, 4, 15, 7, 19),
]


def read_mesh(path):
    """Positions by node, nodes by element, and the element faces of all surfaces."""
    nodes, elements, faces, keyword, pending = {}, {}, [], "", []
    for line in Path(path).read_text().splitlines():
        if line.startswith("*"):
            keyword = line.split(",")[0]
        elif keyword == "*NODE":
            number, *p = line.split(",")
            nodes[int(number)] = [float(x) for x in p]
        elif keyword == "*ELEMENT":
            pending += [int(word) for word in line.split(",") if word.strip()]
            if len(pending) == 21:  # an element of 20 nodes
                elements[pending[0]] = pending[1:]
                pending = []
        elif keyword == "*SURFACE":
            number, side = line.split(",")
            faces.append((int(number), int(side.strip()[1]) - 1))
    return nodes, elements, faces


def read_results(path):
    """Values by node of each block, as "DISP" and "STRESS"."""
    blocks, block = {}, None
    for line in Path(path).read_text().splitlines():
        if line.startswith(" -4"):
            block = blocks.setdefault(line.split()[1], {})
        elif line.startswith(" -3"):
            block = None
        elif line.startswith(" -1") and block is not None:
            values = line[13:].rstrip()
            block[int(line[3:13])] = [float(values[k:k + 12]) for k in range(0, len(values), 12)]
    return blocks


def main():
    nodes, elements, faces = read_mesh(sys.argv[1])
    results = read_results(sys.argv[2])
    numbers = sorted(nodes)
    index = {number: i for i, number in enumerate(numbers)}
    shift = np.array([results["DISP"][n][:3] for n in numbers])
    xx, yy, zz, xy, yz, zx = np.array([results["STRESS"][n] for n in numbers]).T
    mises = np.sqrt(((xx - yy)**2 + (yy - zz)**2 + (zz - xx)**2) / 2 + 3 * (xy**2 + yz**2 + zx**2))
    around = np.array([[index[elements[e][k]] for k in FACES[side]] for e, side in faces])
    largest = np.linalg.norm(shift, axis=1).max()
    points = np.array([nodes[n] for n in numbers]) + 3 / largest * shift
    draw_solution(points, around, mises, sys.argv[3], "von Mises stress, MPa (displacement magnified)")
    print(f"{len(elements)} elements: largest displacement {largest:.4g} mm, largest von Mises stress {mises.max():.4g} MPa")


if __name__ == "__main__":
    main()
