"""The hex mesh that stages give and take."""
from __future__ import annotations

import html
import os
import pathlib
import re
import tempfile
import warnings
import webbrowser
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _convert, _core
from ._errors import BadInput, HexwrightError, HexwrightWarning
from ._inputs import PathLike, as_surface, is_path, to_array
from ._verdict import judge
from ._view import ViewPage, is_notebook

if TYPE_CHECKING:
    from ._grid import Grid


class Facets(NamedTuple):
    """The quads of one patch, each as a face of a hex."""

    quads: NDArray[np.int32]  #: (n, 4) point numbers, counter-clockwise seen from outside
    owner: NDArray[np.int32]  #: (n,) the hex that has the quad as a face
    side: NDArray[np.int8]  #: (n,) which face of it: -x, +x, -y, +y, -z, +z of its local axes


class SecondOrder(NamedTuple):
    """Elements of second order."""

    points: NDArray[np.float64]  #: (n + e, 3) the mesh's points, then the node of each edge
    hexes: NDArray[np.int32]  #: (k, 20) point numbers in VTK's order: corners, then edges


class HexMesh:
    """A hexahedral mesh. Its arrays are views that cannot be written to; no data is copied for them.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        Positions, of any number type. Copied once.
    hexes : array_like, shape (k, 8)
        Point numbers from 0 in VTK's order.
    regions : array_like, shape (k,), optional
        A tag per hex.

    Attributes
    ----------
    report : dict
        What the stage that made the mesh says about it; empty for meshes from files and arrays.
    warnings : list of str
        What else fell short.
    grid : Grid or None
        The completed grid behind a mesh of ``mesh`` and ``polycube``. In the first, the lattice is turned with the part
        (option ``placement``).
    layer : ndarray of shape (k,), or None
        With the option ``layers``: the wall layer of each hex, counted from the wall; 0 in none. It is written to files, and
        in the cell data of ``to_pyvista`` and ``to_meshio``.
    """

    def __init__(self, points: ArrayLike, hexes: ArrayLike, regions: ArrayLike | None = None):
        tags = None if regions is None else to_array(regions, "regions")
        self._take(_core.HexMesh(to_array(points, "points"), to_array(hexes, "hexes"), tags))

    def _take(
        self,
        core: _core.HexMesh,
        report: dict[str, Any] | None = None,
        warnings: Sequence[str] = (),
        failures: list[str] | None = None,
    ) -> None:
        self._core = core
        self.report: dict[str, Any] = report or {}
        self.warnings: list[str] = list(warnings)
        self.grid: Grid | None = None
        self.layer: NDArray[np.int32] | None = None
        if failures is not None:
            self.failures = failures

    @classmethod
    def _wrap(
        cls,
        core: _core.HexMesh,
        report: dict[str, Any] | None = None,
        warnings: Sequence[str] = (),
        failures: list[str] | None = None,
    ) -> HexMesh:
        """``failures`` are those of the stage's gate; None when it has none."""
        mesh = cls.__new__(cls)
        mesh._take(core, report, warnings, failures)
        return mesh

    @property
    def points(self) -> NDArray[np.float64]:
        """Positions, shape (n, 3)."""
        return self._core.points

    @property
    def hexes(self) -> NDArray[np.int32]:
        """Point numbers, shape (k, 8), in VTK's order."""
        return self._core.hexes

    @property
    def order(self) -> int:
        """2 when edges have nodes of their own, as of ``mesh(..., order=2)``; else 1."""
        return self._core.order

    def second_order(self) -> SecondOrder:
        """The elements with 20 nodes; of a mesh of order 1, with straight edges. A copy."""
        return SecondOrder(*self._core.second_order())

    @property
    def regions(self) -> NDArray[np.int32]:
        """A tag per hex, shape (k,); with ``side="both"`` 1 is inside and 2 outside."""
        return self._core.regions

    @property
    def corners(self) -> NDArray[np.int32]:
        """Points that stand for the surface's corners."""
        return self._core.corners

    @cached_property
    def patches(self) -> dict[str, Facets]:
        """The boundary by patches of the surface: smooth parts between its sharp edges, by name."""
        quads, owner, side, start, names = self._core.facets()
        found = {}
        for name, first, last in zip(_tell_apart(names), start, start[1:]):
            if last > first:
                found[name] = Facets(quads[first:last], owner[first:last], side[first:last])
        return found

    def facets(self, name: str) -> Facets:
        """The quads of all patches of a name: of "wall" those of "wall" or of "wall.1", "wall.2" and so on, which sharp
        edges part. A copy.

        Raises
        ------
        BadInput
            When there is none; names those there are.
        """
        parts = [f for own, f in self.patches.items() if own == name or re.fullmatch(re.escape(name) + r"\.\d+", own)]
        if not parts:
            raise BadInput(f"name: no patch is called '{name}'; there are {', '.join(self.patches) or 'none'}")
        return Facets(*(np.concatenate(arrays) for arrays in zip(*parts)))

    @property
    def region_names(self) -> list[str]:
        """Names of regions by tag; empty where there are none."""
        return self._core.region_names

    @cached_property
    def curves(self) -> dict[str, NDArray[np.int32]]:
        """Mesh edges along the surface's sharp edges, shape (n, 2) for each, by name."""
        edges, start, names = self._core.curves()
        return {name: edges[a:b] for name, a, b in zip(_tell_apart(names), start, start[1:]) if b > a}

    def quality(self, measure: str = "scaled_jacobian") -> NDArray[np.float64]:
        """One value per hex.

        Parameters
        ----------
        measure : {"scaled_jacobian", "volume", "positivity"}
            The least scaled Jacobian of the corners, in [-1, 1]; the volume; or whether the Jacobian is proven positive
            everywhere inside (1), proven not to be (-1), or neither (0).
        """
        values: NDArray[np.float64] = self._core.quality(measure)
        return values

    @cached_property
    def failures(self) -> list[str]:
        """Why the mesh is not valid, one sentence each: by the gate of the stage that made it, or else by ``check`` without
        a surface, which is called when this is first asked for."""
        return judge(self._core).failures

    @property
    def valid(self) -> bool:
        """Whether there are no ``failures``."""
        return not self.failures

    def save(
        self, path: PathLike, fields: Mapping[str, ArrayLike] | None = None, format: str = "", nodes: int = 0
    ) -> None:
        """Writes the mesh by extension: .vtu, .vtk, .mesh, .msh (Gmsh 4.1), .inp (Abaqus), polyMesh (OpenFOAM), ...

        The same bytes as the command line writes. The file appears whole or not at all. Names of patches that a format
        cannot take are changed, with a ``HexwrightWarning`` that says to what.

        Parameters
        ----------
        path : path-like
        fields : mapping of str to array_like of shape (k,), optional
            Values per hex to write beside the scaled Jacobian and ``layer``, in the formats that have them.
        format : str, optional
            The format where the extension does not tell, as ``--format`` of the command line.
        nodes : {0, 8, 20, 27}, optional
            Of a mesh of order 2, nodes per hex: 0 what is usual in the format, 8 to leave the further ones out.
        """
        if nodes not in (0, 8, 20, 27):
            raise BadInput(f"nodes: {nodes} is none of 0, 8, 20, 27")
        known: dict[str, ArrayLike] = {} if self.layer is None else {"layer": self.layer}
        pairs = [(name, to_array(values, name)) for name, values in {**known, **(fields or {})}.items()]
        changed = self._core.save(os.fspath(path), pairs, format, nodes)
        if changed:
            told = ", ".join(f"'{given}' is '{written}'" for given, written in changed)
            warnings.warn(f"{os.fspath(path)}: names that the format cannot take: {told}", HexwrightWarning, stacklevel=2)

    def view(self, path: PathLike | None = None, surface: Any = None, open: bool | None = None) -> ViewPage:
        """Writes a page to look into the mesh with, and opens it in a browser: cut, peel, filter by quality, names. In a
        notebook it is shown below the cell that ends with this call.

        The same page as ``hexwright view`` writes. The file appears whole or not at all.

        Parameters
        ----------
        path : path-like, optional
            The page (.html), which needs no network; in a new folder for temporary files when left out.
        surface : as for ``mesh``, optional
            Drawn over the mesh.
        open : bool, optional
            Whether to open it in a browser; when left out, unless this is a notebook.

        Returns
        -------
        ViewPage
            The page's path.
        """
        against = None if surface is None else as_surface(surface)._core
        name = os.path.join(tempfile.mkdtemp(prefix="hexwright-"), "mesh.html") if path is None else os.fspath(path)
        page = pathlib.Path(name)
        fields = [] if self.layer is None else [("layer", self.layer)]
        _core.write_view(name, self._core, page.stem, against, fields)
        if not is_notebook() if open is None else open:
            webbrowser.open(page.resolve().as_uri())
        return ViewPage(name)

    def to_pyvista(self) -> Any:
        """A ``pyvista.UnstructuredGrid`` with cell data ``region``, ``scaled_jacobian`` and, with wall layers, ``layer``. Points
        are copied."""
        return _convert.to_pyvista(self)

    def to_meshio(self) -> Any:
        """A ``meshio.Mesh`` of hexes, patches' quads, curves' edges and corners, with a cell set per name."""
        return _convert.to_meshio(self)

    def to_skfem(self) -> Any:
        """A ``skfem.MeshHex`` with a boundary per patch and a subdomain per region."""
        return _convert.to_skfem(self)

    def image(self, cut: str = "auto", at: float | None = None, width: int = 800, height: int = 600) -> NDArray[np.uint8]:
        """A picture drawn without a display: cut open, coloured by the scaled Jacobian.

        Parameters
        ----------
        cut : {"auto", "x", "y", "z", "none"}
            Axis across which the mesh is cut.
        at : float, optional
            Place of the cut between the box's ends, 0 to 1; when left out, near the middle, clear of faces that lie along it.
        width, height : int
            Pixels, 16 to 16384.

        Returns
        -------
        ndarray, shape (height, width, 3)
        """
        if cut not in ("auto", "x", "y", "z", "none"):
            raise BadInput(f"cut: '{cut}' is none of auto, x, y, z, none")
        if at is not None and not 0 <= at <= 1:
            raise BadInput(f"at: {at} is not from 0 to 1")
        pixels: NDArray[np.uint8] = _core.image(self._core, cut, at, width, height)
        return pixels.reshape(height, width, 3)

    def plot(self, **keywords: Any) -> Any:
        """Shows the mesh with pyvista, coloured by the scaled Jacobian; keywords are those of ``pyvista.plot``."""
        keywords = {"scalars": "scaled_jacobian", "show_edges": True, "cmap": "RdYlBu", **keywords}
        return self.to_pyvista().plot(**keywords)

    def __repr__(self) -> str:
        return f"<hexwright.HexMesh: {len(self.hexes)} hexes, {len(self.points)} points, {len(self.patches)} patches>"

    def _repr_html_(self) -> str:
        """For notebooks: the picture of ``image``, and figures. ``view`` is the page to look into the mesh with."""
        rows = {"hexes": f"{len(self.hexes):,}", "points": f"{len(self.points):,}"}
        picture = ""
        if len(self.hexes):
            quality = self.quality()
            rows["scaled Jacobian"] = f"least {quality.min():.3f}, average {quality.mean():.3f}"
            picture = _convert.to_png_tag(self.image(width=560, height=420), "a cut through the mesh")
        rows["patches"] = ", ".join(list(self.patches)[:12]) + (" …" if len(self.patches) > 12 else "")
        rows["failures"] = "; ".join(self.failures) or "none"
        cells = "".join(f"<tr><th>{k}</th><td>{html.escape(v)}</td></tr>" for k, v in rows.items())
        return f"<div>{picture}<table>{cells}</table></div>"


class InvalidMesh(HexwrightError):
    """With ``strict=True``: the mesh was made but misses the gate.

    Attributes
    ----------
    mesh : HexMesh
        The mesh all the same: to look at it is the way to see why.
    """

    def __init__(self, mesh: HexMesh):
        super().__init__("; ".join(mesh.failures))
        self.mesh = mesh


def _tell_apart(names: list[str]) -> list[str]:
    """With their numbers where a file gives one name twice."""
    return [f"{name}.{k}" if names.count(name) > 1 else name for k, name in enumerate(names)]


def read(path: PathLike) -> HexMesh:
    """Reads a hex mesh of any program: VTU, legacy VTK, MEDIT, Gmsh, Abaqus, MFEM or Exodus, by content first and extension second.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    HexMesh
        Boundary quads, edges and corners of the file become patches, curves and corners.

    Raises
    ------
    BadInput
        Naming the file, the line or element, and the remedy.
    """
    return HexMesh._wrap(_core.read_mesh(os.fspath(path)))


def as_mesh(mesh: Any) -> HexMesh:
    """A HexMesh, a path, a pair of arrays, or a meshio.Mesh with hexes."""
    if isinstance(mesh, HexMesh):
        return mesh
    if is_path(mesh):
        return read(mesh)
    if isinstance(mesh, tuple) and len(mesh) in (2, 3):
        return HexMesh(*mesh)
    cells = getattr(mesh, "cells_dict", {})
    for hexahedron in ("hexahedron", 12):  # meshio.Mesh; pyvista.UnstructuredGrid
        if hexahedron in cells:
            return HexMesh(mesh.points, cells[hexahedron])
    raise BadInput(f"mesh: {type(mesh).__name__} is no hex mesh; give a HexMesh, a path, or (points, hexes)")
