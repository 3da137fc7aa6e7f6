"""Keywords of Python to options of the table that the command line is made from too."""
from __future__ import annotations

import difflib
import operator
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

from . import _core
from ._errors import BadInput

Progress = Callable[[str, float], Any]

STAGES = tuple(_core.stage_names())


class Option(NamedTuple):
    """One option of a stage."""

    name: str  #: keyword in Python; with hyphens for underscores, and two before, that of the command line
    kind: str  #: flag, whole, number, share (of the diagonal), length, degrees, choice, file, text or list
    allowed: str  #: the range, or the names with ``|`` between them
    default: str
    help: str


def options(stage: str) -> list[Option]:
    """The options of a stage, as the command line has them.

    Parameters
    ----------
    stage : str
        One of mesh, grid, complete, dual, fit, improve, polycube, inspect, check, evaluate.

    Returns
    -------
    list of Option
        Name, kind, allowed values, default and one sentence of help.

    Examples
    --------
    >>> [option.name for option in hexwright.options("complete")]
    ['pairing', 'balance']
    """
    return [Option(row[0].replace("-", "_"), *row[1:]) for row in _core.option_table(stage)]


def to_call(
    stage: str,
    given: Mapping[str, Any],
    progress: Progress | None = None,
    threads: int | None = None,
    sizes: Sequence[_core.SizeRule] = (),
) -> _core.Call:
    """What the compiled stages are called with. An unknown keyword is a TypeError, as of any function."""
    known = [option.name for option in options(stage)]
    texts: dict[str, str] = {}
    for name, value in given.items():
        if name not in known:
            near = difflib.get_close_matches(name, known, n=1)
            hint = f"did you mean '{near[0]}'?" if near else "it has " + ", ".join(known)
            raise TypeError(f"{stage}() has no option '{name}'; {hint}")
        if value is not None:
            texts[name.replace("_", "-")] = _to_text(name, value)
    if progress is not None and not callable(progress):
        raise TypeError("progress must be a function of a stage's name and a fraction from 0 to 1")
    return _core.Call(texts, progress, _to_threads(threads), list(sizes))


def _to_text(name: str, value: Any) -> str:
    if len(getattr(value, "shape", (0, 0))) <= 1:  # scalars and rows of numpy
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, str):
        return value
    if isinstance(value, (list, tuple)):  # rules one per line, numbers side by side
        parts = [_to_text(name, part) for part in value]
        return ("\n" if all(isinstance(part, str) for part in value) else ",").join(parts)
    raise BadInput(
        f"{name}: {type(value).__name__} is neither a number, a string, a path or a truth value, nor a row of numbers or strings"
    )


def _to_threads(threads: int | None) -> int:
    if threads is None:
        return 0
    number = operator.index(threads)
    if not 0 <= number <= 1024:
        raise BadInput(f"threads: {number} is not from 0 to 1024; 0 and None are one per core")
    return number
