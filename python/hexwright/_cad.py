"""CAD parts: STEP, IGES and BREP files, and objects of cadquery and build123d."""
from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Iterator
from typing import Any

from . import _core
from ._errors import BadInput
from ._inputs import is_path


def is_cad(surface: Any) -> bool:
    """Whether this is a CAD file's path or an object that holds a shape of OpenCASCADE."""
    if is_path(surface):
        return bool(_core.is_cad_file(os.fspath(surface)))
    return _shape_of(surface) is not None


def _shape_of(part: Any) -> Any:
    """The TopoDS_Shape of a build123d or cadquery object, of a cadquery workplane or of itself."""
    for given in (part, getattr(part, "part", None)):
        shape = getattr(given, "wrapped", None)
        if type(shape if shape is not None else given).__name__.startswith("TopoDS_"):
            return shape if shape is not None else given
    if callable(getattr(part, "val", None)) and hasattr(part, "objects"):  # cadquery.Workplane
        return getattr(part.val(), "wrapped", None)
    return None


@contextlib.contextmanager
def cad_file(part: Any) -> Iterator[str]:
    """The path of a file with the part, which is removed afterwards where it was made for an object."""
    if not _core.can_read_cad():
        raise BadInput(
            "surface: this hexwright was built without its reader of CAD files; build the package with "
            "-DHEXWRIGHT_CAD=ON (docs/reference/python.md), use the command line program, or export the part as STL"
        )
    if is_path(part):
        yield os.fspath(part)
        return
    from OCP.BRepTools import BRepTools  # what made the object has it

    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "part.brep")
        BRepTools.Write_s(_shape_of(part), path)
        yield path


def to_rules(patches: Any) -> list[str]:
    """Patches of a CAD part are given by rules; its faces have no numbers that callers could know."""
    rules = []
    for name, rule in (patches or {}).items():
        if not isinstance(rule, str):
            raise BadInput(f"patches: '{name}' must be a rule such as 'cylinder:r=5' or 'face:face_12', for a CAD part")
        rules.append(f"{name}={rule}")
    return rules
