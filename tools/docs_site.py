#!/usr/bin/env python3
"""Gathers the pages of the documentation site: docs/ as it is, notebooks run and turned into pages, and the pictures of
code blocks that make one (```python picture=NAME, whose code leaves an image in `picture`).

Usage: docs_site.py OUT. Run by scripts/docs, in the environment of the Python tests. Every python block of the guide runs,
a page's blocks in order and in one namespace, so that what the site shows works.
"""
import base64
import contextlib
import io
import os
import re
import shutil
import sys
import tempfile
import warnings
from pathlib import Path

import nbformat
from nbclient import NotebookClient

ROOT = Path(__file__).resolve().parent.parent
BLOCK = re.compile(r"^```python(?: picture=(\w+))?\n(.*?)^```\n", re.M | re.S)


def run_blocks(page, images):
    """The page with each block's output, and its picture, behind it."""
    from hexwright._convert import to_png

    names = {}

    def run(match):
        name, code = match.groups()
        shown = io.StringIO()
        with contextlib.redirect_stdout(shown), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            exec(compile(code, page.name, "exec"), names)
        text = f"```python\n{code}```\n"
        if shown.getvalue():
            text += f"\n```text\n{shown.getvalue()}```\n"
        if name:
            (images / f"{name}.png").write_bytes(to_png(names["picture"]))
            text += f"\n![What the code above makes]({os.path.relpath(images, page.parent)}/{name}.png)\n"
        return text

    return BLOCK.sub(run, page.read_text())


def run_guide(out):
    """In a folder of its own that has the data, as a clone has."""
    images = out / "images"
    with tempfile.TemporaryDirectory() as folder:
        os.symlink(ROOT / "data", Path(folder) / "data")
        with contextlib.chdir(folder):
            for page in [out / "index.md", out / "gallery.md", *sorted((out / "guide").glob("*.md"))]:
                page.write_text(run_blocks(page, images))


def output_text(output, name, images):
    data = output.get("data", {})
    if "image/png" in data:
        (images / f"{name}.png").write_bytes(base64.b64decode(data["image/png"]))
        return f"\n![Output]({'../images'}/{name}.png)\n"
    if "text/html" in data:
        return "\n" + data["text/html"] + "\n"
    text = output.get("text") or data.get("text/plain", "")
    return f"\n```text\n{text.rstrip()}\n```\n" if text else ""


def run_notebook(path, out):
    notebook = nbformat.read(path, as_version=4)
    NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": path.parent}}).execute()
    parts = []
    for number, cell in enumerate(notebook.cells):
        if cell.cell_type == "markdown":
            parts.append(cell.source + "\n")
            continue
        parts.append(f"```python\n{cell.source}\n```\n")
        for k, output in enumerate(cell.outputs):
            parts.append(output_text(output, f"{path.stem}_{number}_{k}", out / "images"))
    (out / "notebooks" / f"{path.stem}.md").write_text("\n".join(parts))


def main(out):
    shutil.rmtree(out, ignore_errors=True)
    shutil.copytree(ROOT / "docs", out)
    for path in sorted((out / "notebooks").glob("*.ipynb")):
        run_notebook(ROOT / "docs/notebooks" / path.name, out)
        path.unlink()
    run_guide(out)
    # Links into the sources lead nowhere on the site; their text stays.
    for page in out.rglob("*.md"):
        text = re.sub(r"\[([^\]]+)\]\((?:\.\./)+(?:include|src|lab|bench|tests|tools|scripts|data|examples)/[^)]*\)", r"\1",
                      page.read_text())
        page.write_text(text)


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
