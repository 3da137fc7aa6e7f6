"""The stages: one function for each, with the options of the command line."""
from __future__ import annotations

import json
import warnings as _warnings
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._cad import cad_file, is_cad, to_rules
from ._errors import BadInput, HexwrightWarning
from ._grid import Grid, as_grid
from ._inputs import Patches, SurfaceLike, as_edges, as_surface, as_tets, tell_unmatched
from ._mesh import HexMesh, InvalidMesh, as_mesh
from ._options import Progress, to_call
from ._sizes import size_rules, take_sizes
from ._verdict import Verdict, judge

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._keywords import (
        CheckOptions,
        CompleteOptions,
        DualOptions,
        EvaluateOptions,
        FitOptions,
        GridOptions,
        ImproveOptions,
        InspectOptions,
        MeshOptions,
        PolycubeOptions,
    )


def _finish(mesh: HexMesh, strict: bool) -> HexMesh:
    """A mesh that misses the gate is given all the same, to look at: with a warning, or in the error when strict."""
    if mesh.failures and strict:
        raise InvalidMesh(mesh)
    if mesh.failures:
        _warnings.warn("; ".join(mesh.failures), HexwrightWarning, stacklevel=3)
    return mesh


def mesh(
    surface: SurfaceLike,
    faces: ArrayLike | None = None,
    *,
    patches: Patches | None = None,
    features: ArrayLike | None = None,
    strict: bool = False,
    threads: int | None = None,
    progress: Progress | None = None,
    **options: Unpack[MeshOptions],
) -> HexMesh:
    """Meshes the inside of a surface with hexahedra.

    Parameters
    ----------
    surface : path, array_like of shape (n, 3), or object
        A file (OBJ, OFF, STL, PLY, VTP, VTK, Gmsh, Nastran, 3MF); vertices, with ``faces``; a pair of arrays; or an object
        with vertices and faces such as ``trimesh.Trimesh`` and ``pyvista.PolyData``. Arrays may be of any number type and are copied once. Where the
        package was built with its reader of CAD files also STEP, IGES and BREP files, and parts of cadquery and build123d.
    faces : array_like of shape (m, 3), optional
        Vertex numbers from 0, counter-clockwise seen from outside.
    patches : mapping of str to array_like or str, optional
        Names of parts of the surface, each with its faces: their numbers, a truth value per face, or a rule as ``--patch``
        of the command line takes, such as ``"plane:x<0.1"``. The mesh follows the borders between them, and its
        ``patches`` have these names. Names in files (STL, OBJ, PLY) are kept.
    features : array_like of shape (e, 2), optional
        Pairs of the surface's vertices: edges to follow whatever their angle.
    strict : bool
        Raise ``InvalidMesh`` for a mesh that misses the gate, instead of a warning.
    threads : int, optional
        One per core when left out. The result does not depend on it.
    progress : callable, optional
        Called as ``progress(stage, fraction)``; returning False stops the work with ``Cancelled``.
    **options
        Those of ``hexwright mesh``, with underscores for hyphens: see ``hexwright.options`` and the command line's
        page. The most used: ``tolerance``, the distance goal as a share of the bounding box's diagonal (0.005 or
        ``"0.5%"``); ``size``, the edge of the cells; ``max_level``; ``side``; ``feature_angle`` in degrees. ``sizes``
        takes more than the command line's file: a function of places, shape (n, 3) in the surface's coordinates, that
        gives the largest edge of cells at each, shape (n,), infinity where nothing is asked for; an array of one size per
        vertex or per face of the surface, which holds for cells at the surface; ``(points, sizes)``; or ``(values, box)``,
        an array of three axes whose outer values lie on the sides of the box x0, y0, z0, x1, y1, z1. A function is called
        with 27 places of each cell that is looked at, from the library's threads and one at a time; what it raises is
        raised here.

    Returns
    -------
    HexMesh
        With ``report``, ``failures`` and ``warnings`` of the run, ``grid``, and with wall layers ``layer``.

    Raises
    ------
    BadInput, BadGeometry, OutOfResources, Cancelled, InvalidMesh
    KeyboardInterrupt
        Ctrl-C stops the work.

    Examples
    --------
    >>> import numpy as np
    >>> vertices = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)])
    >>> faces = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
    ...          [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]]
    >>> m = hexwright.mesh(vertices, faces, max_level=3)
    >>> m.valid, len(m.patches), len(m.curves), len(m.corners)
    (True, 6, 12, 8)
    """
    sizes, texts = take_sizes(options)

    def call(core: _core.Surface | None) -> _core.Call:
        # In no variable: what a function of sizes raises would hold on to it, and it to the function.
        return to_call("mesh", texts, progress, threads, size_rules(sizes, core))

    said: list[str] = []
    if faces is None and is_cad(surface):
        if features is not None:
            raise BadInput("features: a CAD part brings its own; tangent_edges=True adds the smooth edges")
        rules = to_rules(patches)
        with cad_file(surface) as path:
            core, grid, text, layer, matched, read = _core.mesh_cad(path, rules, call(None))
        said = read + tell_unmatched(patches or {}, matched)
    else:
        given = as_surface(surface, faces, patches)
        said = given.warnings
        core, grid, text, layer = _core.mesh(given._core, as_edges(features), call(given._core))
    report = json.loads(text)
    result = HexMesh._wrap(core, report, said + report["warnings"], report["failures"])
    result.grid = Grid._wrap(grid)
    result.layer = layer
    return _finish(result, strict)


def inspect(
    surface: SurfaceLike,
    faces: ArrayLike | None = None,
    *,
    patches: Patches | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    **options: Unpack[InspectOptions],
) -> dict[str, Any]:
    """What a surface is before it is meshed: solids, cavities, open edges, crossings, thin walls, sharp edges, names.

    Parameters are those of ``mesh``; options those of ``hexwright inspect``.

    Returns
    -------
    dict
        What ``hexwright inspect --json`` prints; ``refusal`` says why ``mesh`` would refuse the surface, and is empty when it
        would not. ``warnings`` has those of the file and of rules that fit no face, too.
    """
    call = to_call("inspect", options, progress, threads)
    if faces is None and is_cad(surface):
        rules = to_rules(patches)
        with cad_file(surface) as path:
            text, matched, read = _core.inspect_cad(path, rules, call)
        said = read + tell_unmatched(patches or {}, matched)
    else:
        given = as_surface(surface, faces, patches)
        text, said = _core.inspect(given._core, call), given.warnings
    found: dict[str, Any] = json.loads(text)
    found["warnings"] = said + found["warnings"]
    return found


def grid(
    surface: SurfaceLike,
    faces: ArrayLike | None = None,
    *,
    patches: Patches | None = None,
    features: ArrayLike | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    **options: Unpack[GridOptions],
) -> Grid:
    """The adaptive grid of a surface, before completion.

    Parameters are those of ``mesh``; options those of ``hexwright grid``.

    Returns
    -------
    Grid
        With ``report``.
    """
    given = as_surface(surface, faces, patches)
    core, report, warnings = _core.grid(given._core, as_edges(features), to_call("grid", options, progress, threads))
    return Grid._wrap(core, json.loads(report), given.warnings + warnings)


def complete(
    grid: Grid | Any,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
    **options: Unpack[CompleteOptions],
) -> Grid:
    """Makes an adaptive grid hexmeshable: balance and pairing, as coarse as can be.

    Parameters
    ----------
    grid : Grid or path
    **options
        Those of ``hexwright complete``: ``pairing`` and ``balance``.

    Returns
    -------
    Grid
        Its cells refine those of the input. ``report`` counts them.
    """
    core, report, warnings = _core.complete(as_grid(grid)._core, to_call("complete", options, progress, threads))
    return Grid._wrap(core, json.loads(report), warnings)


def dual(
    grid: Grid | Any,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
    **options: Unpack[DualOptions],
) -> HexMesh:
    """The conforming hex mesh of a completed grid's whole domain.

    Parameters
    ----------
    grid : Grid or path
        Balanced, and for ``mode="blocks"`` paired: see ``complete``.
    **options
        Those of ``hexwright dual``: ``mode`` and ``no_optimize``.
    """
    core, report, warnings = _core.dual(as_grid(grid)._core, to_call("dual", options, progress, threads))
    return HexMesh._wrap(core, {"dual": json.loads(report)}, warnings)


def fit(
    mesh: HexMesh | Any,
    surface: SurfaceLike,
    *,
    patches: Patches | None = None,
    features: ArrayLike | None = None,
    strict: bool = False,
    threads: int | None = None,
    progress: Progress | None = None,
    **options: Unpack[FitOptions],
) -> HexMesh:
    """Carves a hex mesh, of any program, to the inside of a surface and fits it, never inverting an element.

    Parameters
    ----------
    mesh : HexMesh, path, or (points, hexes)
        Conforming, with a positive Jacobian at every corner of every hex.
    surface : as for ``mesh``
    **options
        Those of ``hexwright fit``.

    Returns
    -------
    HexMesh
        ``report`` has ``fit`` and ``verdict``.
    """
    given = as_surface(surface, patches=patches)
    call = to_call("fit", options, progress, threads)
    core, report, text, warnings = _core.fit(as_mesh(mesh)._core, given._core, as_edges(features), call)
    verdict = json.loads(text)
    warnings = given.warnings + warnings + verdict["warnings"]
    result = HexMesh._wrap(core, {"fit": json.loads(report), "verdict": verdict}, warnings, verdict["failures"])
    return _finish(result, strict)


def check(
    mesh: HexMesh | Any,
    surface: SurfaceLike | None = None,
    *,
    features: ArrayLike | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    **options: Unpack[CheckOptions],
) -> Verdict:
    """Judges a hex mesh of any program, alone or against the surface it stands for.

    Valid is a mesh with at least one hex, a valid topology and no inverted hex. Distance and features are reported.

    Parameters
    ----------
    mesh : HexMesh, path, or (points, hexes)
    surface : as for ``mesh``, optional
    **options
        Those of ``hexwright check`` for meshes: ``feature_angle``.
    """
    if features is not None and surface is None:
        raise BadInput("features: are edges of the surface; give the surface too")
    against = None if surface is None else as_surface(surface)._core
    return judge(as_mesh(mesh)._core, against, as_edges(features), to_call("check", options, progress, threads))


def improve(
    mesh: HexMesh | Any,
    surface: SurfaceLike | None = None,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
    **options: Unpack[ImproveOptions],
) -> HexMesh:
    """A mesh of the same connectivity with better shapes. Inverted hexes are untangled where that is possible.

    Parameters
    ----------
    mesh : HexMesh, path, or (points, hexes)
        Left as it is.
    surface : as for ``mesh``, optional
        Boundary vertices slide on it; without one they stay.
    **options
        Those of ``hexwright improve``: ``rounds`` and ``goal``.

    Returns
    -------
    HexMesh
        ``report`` has the least and average scaled Jacobian before and after, and the bound that the held boundary sets.
    """
    against = None if surface is None else as_surface(surface)._core
    call = to_call("improve", options, progress, threads)
    core, report, warnings = _core.improve(as_mesh(mesh)._core, against, call)
    if report["min_after"] > 0:
        return HexMesh._wrap(core, report, warnings)
    return _finish(HexMesh._wrap(core, report, warnings, ["some hexes are still inverted"]), strict=False)


def polycube(
    object: Any,
    cube: Any,
    *,
    max_edge: float | Callable[[float, float, float], float] | None = None,
    strict: bool = False,
    threads: int | None = None,
    progress: Progress | None = None,
    **options: Unpack[PolycubeOptions],
) -> HexMesh:
    """A hex mesh of an object from its polycube map, sampled adaptively.

    Parameters
    ----------
    object, cube : path, (points, tets), or meshio.Mesh
        The same tets, on the object and deformed to a polycube.
    max_edge : float or callable, optional
        The longest edge wanted, in world units: everywhere, or as a function of x, y and z on the object.
    **options
        Those of ``hexwright polycube``.

    Returns
    -------
    HexMesh
        Patches are the polycube's faces. ``grid`` lies on the polycube's lattice.
    """
    if max_edge is not None and not callable(max_edge):
        max_edge = _to_length(max_edge, "max_edge")
    call = to_call("polycube", options, progress, threads)
    core, grid, report, text, warnings = _core.polycube(as_tets(object)._core, as_tets(cube)._core, max_edge, call)
    verdict = json.loads(text)
    result = HexMesh._wrap(core, {"polycube": json.loads(report), "verdict": verdict}, warnings, verdict["failures"])
    result.grid = Grid._wrap(grid)
    return _finish(result, strict)


def _to_length(value: float, name: str) -> float:
    length = float(value)
    if not (np.isfinite(length) and length > 0):
        raise BadInput(f"{name}: {value} is not a length above 0")
    return length


def evaluate(
    surface: SurfaceLike,
    faces: ArrayLike | None = None,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
    **options: Unpack[EvaluateOptions],
) -> dict[str, Any]:
    """The paper's evaluation of one surface: the same grid through every completion, and the whole pipeline beside it.

    Parameters are those of ``mesh``; options those of ``hexwright bench``.

    Returns
    -------
    dict
        The record that ``hexwright bench`` keeps of a model.
    """
    call = to_call("evaluate", options, progress, threads)
    record: dict[str, Any] = json.loads(_core.evaluate(as_surface(surface, faces)._core, call))
    return record
