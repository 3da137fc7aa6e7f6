"""Adaptive all-hexahedral meshing: a surface in, a verified hex mesh out.

>>> import hexwright as hw
>>> mesh = hw.mesh("part.stl")        # doctest: +SKIP
>>> mesh.save("part.vtu")             # doctest: +SKIP
"""
from ._core import version as __version__
from ._errors import BadGeometry, BadInput, Cancelled, HexwrightError, HexwrightWarning, OutOfResources
from ._grid import Grid, read_grid
from ._inputs import Surface, TetMesh, read_surface
from ._mesh import Facets, HexMesh, InvalidMesh, SecondOrder, read
from ._options import Option, options
from ._stages import check, complete, dual, evaluate, fit, grid, improve, inspect, mesh, polycube
from ._verdict import Verdict

__all__ = [
    "BadGeometry",
    "BadInput",
    "Cancelled",
    "Facets",
    "Grid",
    "HexMesh",
    "HexwrightError",
    "HexwrightWarning",
    "InvalidMesh",
    "Option",
    "OutOfResources",
    "SecondOrder",
    "Surface",
    "TetMesh",
    "Verdict",
    "__version__",
    "check",
    "complete",
    "dual",
    "evaluate",
    "fit",
    "grid",
    "improve",
    "inspect",
    "mesh",
    "options",
    "polycube",
    "read",
    "read_grid",
    "read_surface",
]
