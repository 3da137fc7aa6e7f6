"""Pages to look into meshes with, in notebooks."""
from __future__ import annotations

import html
import pathlib
import sys

LARGEST = 30_000_000  # bytes; a notebook keeps what it shows


class ViewPage(str):
    """The path of a page to look into a mesh with. A notebook shows the page itself; of one of more than 30 MB, a link."""

    def _repr_html_(self) -> str:
        page = pathlib.Path(self)
        if page.stat().st_size > LARGEST:
            return f'<a href="{html.escape(page.resolve().as_uri())}" target="_blank">{html.escape(page.name)}</a>'
        text = html.escape(page.read_text(encoding="utf-8"))
        return f'<iframe srcdoc="{text}" title="{html.escape(page.name)}" style="width: 100%; height: 640px; border: 0"></iframe>'


def is_notebook() -> bool:
    """Whether a notebook shows what its cells give; a terminal of IPython does not."""
    ipython = sys.modules.get("IPython")
    shell = None if ipython is None else ipython.get_ipython()
    return hasattr(shell, "kernel")
