"""The notebooks of docs/notebooks run, and carry no outputs."""
import nbformat
import pytest
from conftest import SOURCE
from nbclient import NotebookClient

NOTEBOOKS = sorted((SOURCE / "docs/notebooks").glob("*.ipynb"))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook_runs(path):
    notebook = nbformat.read(path, as_version=4)
    for cell in notebook.cells:
        assert not cell.get("outputs"), "strip the outputs: they are made anew for the documentation"
    NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": path.parent}}).execute()
