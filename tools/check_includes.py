#!/usr/bin/env python3
"""Checks that modules include downwards only (docs/architecture.md, "Modules").

Usage: check_includes.py SOURCE_DIR. Prints every violation; exit code 1 when there is one.
"""
import re
import sys
from pathlib import Path

ALLOWED = {
    "base": set(),
    "mesh": {"base"},
    "geometry": {"base", "mesh"},
    "grid": {"base", "mesh", "geometry"},
    "dual": {"base", "mesh", "grid"},
    "quality": {"base", "mesh", "geometry"},
    "fit": {"base", "mesh", "geometry", "quality"},
    "polycube": {"base", "mesh", "geometry", "grid", "dual", "fit", "quality"},
    "io": {"base", "mesh", "grid"},
    "render": {"base", "mesh", "geometry", "quality", "io"},
    "pipeline": {"base", "mesh", "geometry", "grid", "dual", "quality", "fit", "polycube", "io", "render"},
}
# Heavy third parties stay out of public headers: users compile against ours alone.
FORBIDDEN_IN_PUBLIC = re.compile(r"#include <(Eigen|tbb|oneapi|embree3|iostream|nlohmann|fmt|Highs|CLI)")
INCLUDE = re.compile(r'#include [<"](?:hexwright/)?([a-z]+)/[\w./]+[>"]')


def violations(root: Path):
    for folder in ("include/hexwright", "src"):
        for module, allowed in ALLOWED.items():
            for path in sorted((root / folder / module).rglob("*")):
                if path.suffix not in {".h", ".cpp", ".inc"}:
                    continue
                for number, line in enumerate(path.read_text().splitlines(), 1):
                    match = INCLUDE.match(line)
                    where = f"{path.relative_to(root)}:{number}"
                    if match and match[1] in ALLOWED and match[1] not in allowed | {module}:
                        yield f"{where}: module {module} may not include {match[1]}"
                    if folder.startswith("include") and FORBIDDEN_IN_PUBLIC.match(line):
                        yield f"{where}: a public header may not include a heavy third party"


def main() -> int:
    root = Path(sys.argv[1])
    if not (root / "include/hexwright/base").is_dir():
        print(f"{root} is not the project's root")
        return 2
    found = list(violations(root))
    print("\n".join(found) if found else "modules include downwards only")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
