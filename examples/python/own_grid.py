"""Pairs an octree of one's own and makes hexes of it: the method without a surface. Usage: own_grid.py OUTPUT"""
from __future__ import annotations

import sys

import hexwright as hw
import numpy as np
from numpy.typing import NDArray

CORNER = np.indices((2, 2, 2)).reshape(3, -1).T


def refine_towards(point: NDArray[np.float64], depth: int) -> hw.Grid:
    """An octree over the unit cube whose cells split where they hold the point."""
    levels: list[int] = []
    indices = []
    parent = np.zeros(3, dtype=int)
    for level in range(1, depth + 1):
        children = 2 * parent + CORNER
        holds = (children == np.floor(point * 2**level)).all(axis=1)
        kept = children if level == depth else children[~holds]
        levels += [level] * len(kept)
        indices.append(kept)
        parent = children[holds][0]
    return hw.Grid(levels, np.vstack(indices), size=10.0)


def main(output: str) -> None:
    grid = refine_towards(np.array([0.3, 0.4, 0.6]), depth=6)
    paired = hw.complete(grid, pairing="blocks", balance="weak")
    mesh = hw.dual(paired)
    mesh.save(output)
    print(f"{len(grid)} cells, paired {len(paired)}, {len(mesh.hexes)} hexes, valid: {mesh.valid}")


if __name__ == "__main__":
    main(sys.argv[1])
