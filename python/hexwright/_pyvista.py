"""``surface.hexwright.mesh()`` on pyvista's surfaces, and ``pyvista.read`` of meshes and grids; pyvista imports this by
the package's entry points."""
from __future__ import annotations

from typing import Any

import pyvista

from . import _grid, _stages
from ._errors import BadInput
from ._mesh import HexMesh, read


def read_grid(path: str, **_: Any) -> pyvista.UnstructuredGrid:
    """The cells of a grid, for ``pyvista.read("grid.cells")``."""
    return _grid.read_grid(path).to_pyvista()


def read_mesh(path: str, **keywords: Any) -> pyvista.DataSet:
    """A MEDIT file for ``pyvista.read``: hexes with their regions and patches; what has none, as meshio sees it."""
    try:
        return read(path).to_pyvista()
    except BadInput:
        try:
            return pyvista.read_meshio(path, **keywords)
        except Exception:
            pass
        raise


@pyvista.register_dataset_accessor("hexwright", pyvista.PolyData)
class SurfaceAccessor:
    """Hexwright's stages that start from a surface."""

    def __init__(self, surface: pyvista.PolyData):
        self._surface = surface

    def mesh(self, **options: Any) -> HexMesh:
        """As ``hexwright.mesh`` of this surface."""
        return _stages.mesh(self._surface, **options)

    def grid(self, **options: Any) -> Any:
        """As ``hexwright.grid`` of this surface."""
        return _stages.grid(self._surface, **options)


@pyvista.register_dataset_accessor("hexwright", pyvista.UnstructuredGrid)
class MeshAccessor:
    """Hexwright's stages that start from a mesh."""

    def __init__(self, mesh: pyvista.UnstructuredGrid):
        self._mesh = mesh

    def check(self, surface: Any = None, **options: Any) -> Any:
        """As ``hexwright.check`` of this mesh's hexes."""
        return _stages.check(self._mesh, surface, **options)

    def improve(self, surface: Any = None, **options: Any) -> HexMesh:
        """As ``hexwright.improve`` of this mesh's hexes."""
        return _stages.improve(self._mesh, surface, **options)
