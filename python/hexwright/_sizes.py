"""Sizes of cells as functions and arrays: each becomes a rule of the compiled part."""
from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._errors import BadInput
from ._inputs import is_path, to_array

Places = NDArray[np.float64]  # of shape (n, 3)


def take_sizes(options: Mapping[str, Any]) -> tuple[Any, dict[str, Any]]:
    """The option ``sizes`` where it is no file, else None, and the other options."""
    sizes = options.get("sizes")
    if sizes is None or is_path(sizes):
        return None, dict(options)
    return sizes, {name: value for name, value in options.items() if name != "sizes"}


def size_rules(sizes: Any, surface: _core.Surface | None) -> list[_core.SizeRule]:
    """The rule that they are, if any. `surface`: whose vertices and faces may have sizes."""
    if sizes is None:
        return []
    if callable(sizes):
        return [_core.function_rule(_checked(sizes))]
    if isinstance(sizes, tuple) and len(sizes) == 2:
        return [_pair(*sizes)]
    array = to_array(sizes, "sizes")
    if array.ndim != 1:
        raise BadInput(
            f"sizes: has the shape {array.shape}; give a function, one value per vertex or face, (points, values), or (values, "
            "box) with values of three axes; one size for all is the option size"
        )
    if surface is None:
        raise BadInput("sizes: the triangles of a CAD part are not its caller's; give a function of places")
    return [_core.surface_rule(surface, array)]


def _checked(function: Callable[[Places], Any]) -> Callable[[Places], NDArray[np.float64]]:
    """The function with its result as the compiled part takes it."""

    def sizes(places: Places) -> NDArray[np.float64]:
        given = to_array(function(places), "sizes: what the function gives")
        if given.shape != (len(places),):
            raise BadInput(
                f"sizes: the function gives the shape {given.shape} for places of the shape {places.shape}; it must give one "
                f"size per place, ({len(places)},)"
            )
        return np.ascontiguousarray(given, dtype=np.float64)

    return sizes


def _pair(first: Any, second: Any) -> _core.SizeRule:
    """Points and their sizes, or values of a lattice and its box."""
    array = to_array(first, "sizes: the first of two")
    if array.ndim == 2 and array.shape[1] == 3:
        return _core.points_rule(array, to_array(second, "sizes: those of the points"))
    if array.ndim != 3:
        raise BadInput(
            f"sizes: the first of two has the shape {array.shape}; give points (n, 3), or a lattice of values with the axes x, y "
            "and z"
        )
    box = to_array(second, "sizes: the box").astype(np.float64)
    if box.shape != (6,) or not np.isfinite(box).all() or not (box[3:] > box[:3]).all():
        raise BadInput("sizes: the box must be x0, y0, z0, x1, y1, z1 with positive lengths")
    for axis in range(3):  # one layer of values holds from side to side
        if array.shape[axis] == 1:
            array = np.repeat(array, 2, axis)
    return _core.lattice_rule(array.ravel(order="F"), list(array.shape), box)
