#!/usr/bin/env python3
"""Builds the page of viewer/ anew and compares it with viewer/dist/viewer.html, byte by byte. Its colours and those of the report are
those of the program's pictures.

Usage: rebuild_test.py SOURCE_DIR. Exit code 77 (skipped) without node and npm, or when npm cannot get the packages of the lock file.
"""
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path


def check_colors(source):
    program, page = ((source / name).read_text() for name in ("src/render/color.cpp", "viewer/src/colors.js"))
    for table, name in (("kScale", "QUALITY"), ("kCategories", "CATEGORIES")):
        rows = [re.search(pattern, text, re.S)[1] for pattern, text in ((table + r" = \{\{(.*?)\}\};", program), (name + r" = \[\[(.*?)\]\];", page))]
        first, second = (re.findall(r"\d+", text) for text in rows)
        assert first == second and len(first) >= 30, f"{table} of src/render/color.cpp is not {name} of viewer/src/colors.js"
    scale = re.search(r"kScale = \{\{(.*?)\}\};", program, re.S)[1]
    bar = re.search(r"\.scale i \{.*?linear-gradient\((.*?)\); \}", (source / "cli/bench/page/report.css").read_text(), re.S)[1]
    assert re.findall(r"\d+", scale) == re.findall(r"\d+", bar), "kScale of src/render/color.cpp is not the scale of the report"


def main():
    source = Path(sys.argv[1])
    check_colors(source)
    lock = (source / "viewer/package-lock.json").read_text()
    assert '"resolved"' not in lock, "the lock file names an address: see viewer/.npmrc"
    if not shutil.which("node") or not shutil.which("npm"):
        print("skipped: node and npm are not installed")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "viewer"
        shutil.copytree(source / "viewer", copy, ignore=shutil.ignore_patterns("node_modules", "dist"))
        shutil.copy(source / "LICENSE", folder)
        # The builder's own binary comes as a package; no package's script is run.
        install = subprocess.run(["npm", "ci", "--ignore-scripts"], cwd=copy, capture_output=True, text=True, timeout=200)
        if install.returncode != 0:
            print(f"skipped: npm could not get the packages: {install.stderr[-300:]}")
            return 77
        built = Path(folder) / "viewer.html"
        subprocess.run(["node", "build.mjs", built], cwd=copy, check=True, timeout=60)
        stored = source / "viewer/dist/viewer.html"
        assert built.read_bytes() == stored.read_bytes(), "viewer/dist/viewer.html is not what viewer/ makes: run 'npm ci && npm run build' there"
        print(f"{stored.stat().st_size} bytes, the same")
    return 0


if __name__ == "__main__":
    sys.exit(main())
