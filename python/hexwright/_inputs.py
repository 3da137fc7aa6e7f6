"""What may stand for a surface or a tet mesh: files, arrays, and objects of other packages, none of which is imported."""
from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._errors import BadInput

#: A path, a pair of arrays, a Surface, or an object with vertices and faces (trimesh) or points and faces (pyvista).
SurfaceLike = Any
PathLike = Union[str, "os.PathLike[str]"]
#: A file; a function of places, shape (n, 3), that gives sizes, shape (n,); one size per vertex or face; points and their
#: sizes; or a lattice of sizes and its box.
Sizes = Union[PathLike, Callable[[NDArray[np.float64]], ArrayLike], ArrayLike, "tuple[ArrayLike, ArrayLike]"]
#: Faces by name.
Patches = Mapping[str, ArrayLike]  # rules are strings, which ArrayLike has too


def to_array(values: Any, name: str) -> NDArray[Any]:
    """An array whose memory the compiled part can read: any strides, this machine's byte order."""
    try:
        array = np.asarray(values)
    except ValueError as error:
        raise BadInput(f"{name}: rows of different lengths are no array ({error})") from None
    if array.dtype.kind not in "fiu":
        raise BadInput(f"{name}: must hold integers or floating-point numbers, not {array.dtype.name}")
    if array.size == 0 and array.ndim == 1:  # np.asarray([])
        raise BadInput(f"{name}: is empty")
    if array.dtype.kind == "f" and array.dtype.itemsize not in (4, 8):
        array = array.astype(np.float64)
    if not array.dtype.isnative:
        array = array.astype(array.dtype.newbyteorder("="))
    if any(stride % array.itemsize for stride in array.strides):  # a field of records
        array = array.copy()
    return array


def is_path(value: Any) -> bool:
    return isinstance(value, (str, os.PathLike))


class Surface:
    """A triangle surface.

    Parameters
    ----------
    vertices : array_like, shape (n, 3)
        Positions, of any number type. Copied once.
    faces : array_like, shape (m, 3)
        Vertex numbers from 0, counter-clockwise seen from outside.
    patches : mapping of str to array_like or str, optional
        Names of parts of the surface, each with its faces: their numbers, a truth value per face, or a rule as the command
        line's ``--patch`` takes, such as ``"plane:x<0.1"``. Where two parts meet is an edge that the mesh follows.

    Attributes
    ----------
    warnings : list of str
        What the reader of a file said about it.
    """

    def __init__(self, vertices: ArrayLike, faces: ArrayLike, patches: Patches | None = None):
        self._core = _core.Surface(to_array(vertices, "vertices"), _to_faces(faces))
        self.warnings: list[str] = []
        if patches is not None:
            self._core = self._with_patches(patches)._core

    def _with_patches(self, patches: Patches) -> Surface:
        """The same with these names; faces that have none keep the names of the file. Rules come after faces by number,
        because they divide faces."""
        rules = {name: rule for name, rule in patches.items() if isinstance(rule, str)}
        given = self._with_numbered({name: ids for name, ids in patches.items() if name not in rules})
        if not rules:
            return given
        core, counts = _core.name_by_rules(given._core, [f"{name}={rule}" for name, rule in rules.items()])
        return Surface._wrap(core, self.warnings + tell_unmatched(rules, counts))

    def _with_numbered(self, patches: Mapping[str, Any]) -> Surface:
        names = list(self._core.group_names) or [""]
        group = self._core.group.copy() if len(self._core.group) else np.zeros(len(self.faces), dtype=np.int32)
        taken = np.zeros(len(group), dtype=bool)
        for name, ids in patches.items():
            chosen = _to_face_ids(ids, len(group), name)
            if taken[chosen].any():
                raise BadInput(f"patches: face {chosen[taken[chosen]][0]} is in '{name}' and in another patch")
            taken[chosen] = True
            if name not in names:
                names.append(name)
            group[chosen] = names.index(name)
        return Surface._wrap(_core.Surface(self.vertices, self.faces, group, names), self.warnings)

    @classmethod
    def _wrap(cls, core: _core.Surface, warnings: list[str]) -> Surface:
        surface = cls.__new__(cls)
        surface._core = core
        surface.warnings = warnings
        return surface

    @property
    def vertices(self) -> NDArray[np.float64]:
        """Positions, shape (n, 3); a read-only view."""
        return self._core.vertices

    @property
    def faces(self) -> NDArray[np.int32]:
        """Vertex numbers, shape (m, 3); a read-only view."""
        return self._core.faces

    @property
    def patches(self) -> dict[str, NDArray[np.int64]]:
        """Numbers of the faces under each name; empty when none is named."""
        parts = {name: np.flatnonzero(self._core.group == k) for k, name in enumerate(self._core.group_names)}
        return {name: ids for name, ids in parts.items() if name and len(ids)}

    def save(self, path: PathLike) -> None:
        """Writes OBJ, OFF, STL or PLY by extension. The file appears whole or not at all."""
        _core.write_surface(os.fspath(path), self._core)

    def __repr__(self) -> str:
        return f"<hexwright.Surface: {len(self.faces)} triangles, {len(self.vertices)} vertices>"


def tell_unmatched(names: Iterable[str], counts: Iterable[int]) -> list[str]:
    """A sentence for each rule that has found nothing."""
    return [f"no part of the surface fits the rule of '{name}'" for name, count in zip(names, counts) if count == 0]


def _to_face_ids(ids: Any, count: int, name: str) -> NDArray[np.int64]:
    where = f"patches: '{name}'"
    if not isinstance(name, str) or not name.strip():
        raise BadInput(f"patches: {name!r} is no name")
    array = np.asarray(ids)
    if array.dtype == bool:
        if array.shape != (count,):
            raise BadInput(f"{where} has {array.size} truth values for {count} faces")
        return np.flatnonzero(array)
    if array.ndim != 1 or array.dtype.kind not in "iu" and array.size:
        raise BadInput(f"{where} must be a list of face numbers or a truth value per face")
    outside = array[(array < 0) | (array >= count)]
    if outside.size:
        raise BadInput(f"{where} holds {outside[0]}, which is none of the {count} faces (counted from 0)")
    return array.astype(np.int64)


def _to_faces(faces: Any) -> NDArray[Any]:
    array = to_array(faces, "faces")
    if array.ndim == 2 and array.shape[1] == 4:
        raise BadInput("faces: has 4 columns; split quads into triangles: faces[:, [0, 1, 2]] and faces[:, [0, 2, 3]]")
    return array


def read_surface(path: PathLike) -> Surface:
    """Reads a triangle surface: OBJ, OFF, STL, PLY, VTP, VTK, Gmsh, Nastran or 3MF, by content first and extension second.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    Surface
        Polygons are triangulated; nothing is welded or dropped.

    Raises
    ------
    BadInput
        Naming the file, the line or element, and the remedy.
    """
    core, warnings = _core.read_surface(os.fspath(path))
    return Surface._wrap(core, warnings)


def as_surface(surface: SurfaceLike, faces: ArrayLike | None = None, patches: Patches | None = None) -> Surface:
    """The surface that arguments stand for."""
    given = _to_surface(surface, faces)
    return given if patches is None else given._with_patches(patches)


def _to_surface(surface: SurfaceLike, faces: ArrayLike | None) -> Surface:
    if faces is not None:
        return Surface(surface, faces)
    if isinstance(surface, Surface):
        return surface
    if is_path(surface):
        return read_surface(surface)
    if isinstance(surface, tuple) and len(surface) == 2:
        return Surface(*surface)
    if hasattr(surface, "is_all_triangles"):  # pyvista.PolyData: faces with their counts before them
        return _from_polydata(surface)
    if hasattr(surface, "vertices") and hasattr(surface, "faces"):
        return Surface(surface.vertices, surface.faces)
    if hasattr(surface, "points") and hasattr(surface, "cells_dict"):  # meshio.Mesh
        return _from_meshio(surface)
    raise BadInput(
        f"surface: {type(surface).__name__} is no surface; give a path, (vertices, faces), or an object with vertices and "
        "faces such as trimesh.Trimesh or pyvista.PolyData"
    )


def _from_polydata(data: Any) -> Surface:
    triangles = data if data.is_all_triangles else data.triangulate()
    return Surface(triangles.points, np.asarray(triangles.faces).reshape(-1, 4)[:, 1:])


def _from_meshio(data: Any) -> Surface:
    others = sorted(set(data.cells_dict) - {"triangle", "line", "vertex"})
    if "triangle" not in data.cells_dict or others:
        raise BadInput(f"surface: the meshio.Mesh must hold triangles and no {', '.join(others) or 'other cells'}")
    return Surface(np.asarray(data.points)[:, :3], data.cells_dict["triangle"])


class TetMesh:
    """A tetrahedral mesh, for polycube maps.

    Parameters
    ----------
    points : array_like, shape (n, 3)
    tets : array_like, shape (m, 4)
        Vertex numbers from 0, of positive volume.
    """

    def __init__(self, points: ArrayLike, tets: ArrayLike):
        self._core = _core.TetMesh(to_array(points, "points"), to_array(tets, "tets"))

    @property
    def points(self) -> NDArray[np.float64]:
        """Positions, shape (n, 3); a read-only view."""
        return self._core.points


def as_tets(tets: Any) -> TetMesh:
    """A path (MEDIT, VTK, VTU, Gmsh, Abaqus, MFEM, Exodus), a pair of arrays, or a meshio.Mesh."""
    if isinstance(tets, TetMesh):
        return tets
    if is_path(tets):
        mesh = TetMesh.__new__(TetMesh)
        mesh._core = _core.read_tets(os.fspath(tets))
        return mesh
    if isinstance(tets, tuple) and len(tets) == 2:
        return TetMesh(*tets)
    if hasattr(tets, "cells_dict") and "tetra" in tets.cells_dict:
        return TetMesh(tets.points, tets.cells_dict["tetra"])
    raise BadInput(f"tets: {type(tets).__name__} is no tet mesh; give a path or (points, tets)")


def as_edges(features: Any) -> NDArray[Any] | None:
    """Pairs of vertices, or None."""
    if features is None:
        return None
    array = to_array(features, "features")
    if array.ndim != 2 or array.shape[1] != 2:
        raise BadInput(f"features: has the shape {array.shape}, but must have (n, 2): pairs of the surface's vertices")
    return array
