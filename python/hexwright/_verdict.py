"""What is found of a mesh that is judged."""
from __future__ import annotations

import json
from typing import Any

from numpy.typing import NDArray

from . import _core
from ._options import to_call


class Verdict:
    """What ``check`` found.

    Attributes
    ----------
    valid : bool
    failures, warnings : list of str
        One sentence each.
    report : dict
        Topology, quality and, with a surface, distance and features. Distances are shares of the diagonal.
    """

    def __init__(self, report: dict[str, Any], text: str):
        self.report = report
        self.valid: bool = report["valid"]
        self.failures: list[str] = report["failures"]
        self.warnings: list[str] = report.get("warnings", [])
        self._text = text

    def __bool__(self) -> bool:
        return self.valid

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return f"<hexwright.Verdict: {'valid' if self.valid else 'not valid: ' + '; '.join(self.failures)}>"


def judge(
    mesh: _core.HexMesh,
    surface: _core.Surface | None = None,
    features: NDArray[Any] | None = None,
    call: _core.Call | None = None,
) -> Verdict:
    report, text, _ = _core.check(mesh, surface, features, call or to_call("check", {}))
    return Verdict(json.loads(report), text)
