"""``surface.hexwright.mesh()`` on pyvista's surfaces; pyvista imports this by the package's entry point."""
from __future__ import annotations

from typing import Any

import pyvista

from . import _stages
from ._mesh import HexMesh


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
