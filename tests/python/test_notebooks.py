"""The notebooks of docs/notebooks carry no outputs; scripts/docs runs them, and with them the guide (Python.site)."""
import nbformat
import pytest
from conftest import SOURCE

NOTEBOOKS = sorted((SOURCE / "docs/notebooks").glob("*.ipynb"))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook_is_stripped(path):
    for cell in nbformat.read(path, as_version=4).cells:
        assert not cell.get("outputs") and not cell.get("execution_count"), "strip the outputs: the site makes them anew"
