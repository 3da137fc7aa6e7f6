"""Adaptive grids: the leaves of an octree over one or more root cubes."""
from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._errors import BadInput
from ._inputs import PathLike, is_path, to_array
from ._mesh import HexMesh


class Grid:
    """An adaptive grid.

    Parameters
    ----------
    levels : array_like, shape (n,)
        Depth of each cell; 0 is a root cube.
    indices : array_like, shape (n, 3)
        Position of each cell on the lattice of its own level: at level L a root cube has 2**L cells along each axis.
    roots : array_like, shape (r, 3), optional
        Positions of the root cubes; one at (0, 0, 0) when left out.
    origin : sequence of 3 floats
        Where the low corner of root cube (0, 0, 0) lies.
    size : float
        Edge of a root cube.

    Raises
    ------
    BadInput
        When cells overlap, leave a gap, or lie outside the roots; names the first.

    Attributes
    ----------
    report : dict
        What the stage that made the grid says about it; empty for grids from files and arrays.
    warnings : list of str
        What it warned of.

    Examples
    --------
    Eight cells, one of which is split again:

    >>> import numpy as np
    >>> corner = np.indices((2, 2, 2)).reshape(3, -1).T
    >>> grid = hexwright.Grid([1] * 7 + [2] * 8, np.vstack([corner[1:], corner]))
    >>> grid.counts
    [0, 7, 8]
    >>> grid.find_problem(balance="weak", blocks=True) is None
    True
    """

    def __init__(
        self,
        levels: ArrayLike,
        indices: ArrayLike,
        roots: ArrayLike | None = None,
        origin: Sequence[float] = (0.0, 0.0, 0.0),
        size: float = 1.0,
    ):
        cubes = np.zeros((1, 3), dtype=np.int32) if roots is None else to_array(roots, "roots")
        if len(origin) != 3:
            raise BadInput("origin: must be three numbers")
        place = [float(x) for x in origin]
        self._take(_core.Grid(to_array(levels, "levels"), to_array(indices, "indices"), cubes, place, float(size)))

    def _take(self, core: _core.Grid, report: dict[str, Any] | None = None, warnings: Sequence[str] = ()) -> None:
        self._core = core
        self.report: dict[str, Any] = report or {}
        self.warnings: list[str] = list(warnings)

    @classmethod
    def _wrap(cls, core: _core.Grid, report: dict[str, Any] | None = None, warnings: Sequence[str] = ()) -> Grid:
        grid = cls.__new__(cls)
        grid._take(core, report, warnings)
        return grid

    @property
    def levels(self) -> NDArray[np.int8]:
        """Depth of each cell, shape (n,); a read-only view."""
        return self._core.levels

    @property
    def corners(self) -> NDArray[np.int32]:
        """Low corner of each cell on the lattice of the deepest level, shape (n, 3); a read-only view."""
        return self._core.corners

    @property
    def indices(self) -> NDArray[np.int32]:
        """Position of each cell on the lattice of its own level, shape (n, 3)."""
        shift = (self._core.finest_level - self.levels).astype(np.int32)
        return self.corners >> shift[:, None]

    @property
    def roots(self) -> NDArray[np.int32]:
        """Positions of the root cubes, shape (r, 3); a read-only view."""
        return self._core.roots

    @property
    def origin(self) -> NDArray[np.float64]:
        """Where the low corner of root cube (0, 0, 0) lies."""
        return np.array(self._core.origin)

    @property
    def size(self) -> float:
        """Edge of a root cube."""
        return self._core.size

    @property
    def counts(self) -> list[int]:
        """Number of cells per level."""
        counts: list[int] = np.bincount(self.levels).tolist()
        return counts

    @property
    def edges(self) -> NDArray[np.float64]:
        """Edge of each cell, shape (n,)."""
        edges: NDArray[np.float64] = np.ldexp(self.size, -self.levels.astype(np.int32))
        return edges

    @property
    def centers(self) -> NDArray[np.float64]:
        """Centre of each cell, shape (n, 3)."""
        centers: NDArray[np.float64] = self.origin + (self.indices + 0.5) * self.edges[:, None]
        return centers

    def find_problem(self, balance: str = "relaxed", blocks: bool = False, before: Grid | None = None) -> str | None:
        """The first place where the grid is not what a stage needs, as a sentence; None when there is none.

        Parameters
        ----------
        balance : {"relaxed", "weak", "strong"}
        blocks : bool
            Whether it must be paired by blocks.
        before : Grid, optional
            A grid that it must be nowhere coarser than.
        """
        problem = self._core.find_unbalanced(balance)
        if problem is None and blocks:
            problem = self._core.find_unpaired()
        if problem is None and before is not None:
            problem = self._core.find_coarsened(before._core)
        return problem

    def to_hexes(self) -> HexMesh:
        """A hex per cell, with the level as its region. Not conforming where levels meet."""
        return HexMesh._wrap(self._core.as_hexes())

    def to_pyvista(self) -> Any:
        """A ``pyvista.UnstructuredGrid`` of the cells, with cell data ``region``: the level."""
        return self.to_hexes().to_pyvista()

    def save(self, path: PathLike) -> None:
        """Writes .cells, .htg, .vtu or .mesh by extension. The file appears whole or not at all."""
        self._core.save(os.fspath(path))

    def __len__(self) -> int:
        return len(self.levels)

    def __repr__(self) -> str:
        return f"<hexwright.Grid: {len(self)} cells, levels to {self._core.finest_level}>"


def read_grid(path: PathLike) -> Grid:
    """Reads a grid: .cells, .htg, or .vtu and .mesh hexes with hanging nodes.

    Raises
    ------
    BadInput
        Naming the file, and the line or cell.
    """
    return Grid._wrap(_core.read_grid(os.fspath(path)))


def as_grid(grid: Any) -> Grid:
    """A Grid or a path."""
    if isinstance(grid, Grid):
        return grid
    if is_path(grid):
        return read_grid(grid)
    raise BadInput(f"grid: {type(grid).__name__} is no grid; give a hexwright.Grid or a path")
