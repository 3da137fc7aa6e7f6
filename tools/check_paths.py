#!/usr/bin/env python3
"""Checks that source files named in the documentation, and with their folder in comments of C++, exist.

Usage: check_paths.py SOURCE_DIR. Prints every name without a file; exit code 1 when there is one.
Pages of results are left out: they speak of the version that made them.
"""
import re
import sys
from pathlib import Path

IN_PAGE = re.compile(r"`([\w./-]+\.(?:h|cpp|py))`")
IN_COMMENT = re.compile(r"[\w.-]+/[\w./-]+\.(?:h|cpp|py)\b")


def names(path: Path):
    """(line, name) of every source file that is spoken of."""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if path.suffix == ".md":
            yield from ((number, name) for name in IN_PAGE.findall(line))
        elif "//" in line:
            yield from ((number, name) for name in IN_COMMENT.findall(line.split("//", 1)[1]))


def missing(root: Path):
    sources = {p for folder in ("src", "include", "cli", "python", "tools", "lab", "tests", "bench", "fuzz", "examples")
               for p in (root / folder).rglob("*") if p.suffix in {".h", ".cpp", ".py"}}
    file_names = {p.name for p in sources}
    pages = [p for p in [*root.glob("*.md"), *root.glob("docs/**/*.md")] if "results" not in p.parts]
    for path in pages + sorted(p for p in sources if p.suffix != ".py"):
        for number, name in names(path):
            bases = (root, root / "src", root / "include", root / "include/hexwright", path.parent)
            if "/" in name and not any((base / name).is_file() for base in bases) or Path(name).name not in file_names:
                yield f"{path.relative_to(root)}:{number}: {name} does not exist"


def main() -> int:
    found = list(missing(Path(sys.argv[1])))
    print("\n".join(found) if found else "every source file that is spoken of exists")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
