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
    "target": {"base", "mesh", "geometry"},
    "labelling": {"base"},
    "cad": {"base", "mesh", "geometry"},
    "grid": {"base", "mesh", "geometry", "target", "labelling"},
    "quality": {"base", "mesh", "geometry", "target"},
    "relax": {"base", "mesh", "geometry", "target", "quality"},
    "dual": {"base", "mesh", "geometry", "target", "grid", "quality", "relax"},
    "fit": {"base", "mesh", "geometry", "target", "quality", "relax"},
    "curving": {"base", "mesh", "geometry", "target", "quality"},
    "polycube": {"base", "mesh", "geometry", "target", "grid", "dual", "fit", "quality", "relax"},
    "io": {"base", "mesh", "grid"},
    "layers": {"base", "mesh", "geometry", "target", "quality", "relax", "fit", "io"},
    "render": {"base", "mesh", "geometry", "quality", "io"},
    "pipeline": {"base", "mesh", "geometry", "target", "grid", "dual", "quality", "relax", "fit", "curving", "polycube", "io", "layers", "render", "cad"},
}
# Rooms inside a module, lowest first: a room includes itself and those before it.
ROOMS = {
    "cad": ["occt"],
    "geometry": ["frame", "tree", "topology", "prepare", "features", "walls"],
    "dual": ["domain", "complex", "pillows"],
    "grid": ["cells", "sets", "sizing", "pairing", "ilp"],
    "quality": ["jacobian", "topology", "distance"],
    "io": ["text", "vtk", "surface", "sets", "content", "field", "solver", "mesh", "grid"],
    "relax": ["kernel", "state", "passes", "joint"],
    "fit": ["carve", "curves", "sheets"],
    "polycube": ["tets", "lattice", "map", "labels"],
    "pipeline": ["options", "loop", "report"],
}
# Heavy third parties stay out of public headers: users compile against ours alone.
FORBIDDEN_IN_PUBLIC = re.compile(r"#include <([A-Z]\w+\.hxx|gp_|tbb|oneapi|iostream|nlohmann|fmt|Highs|CLI)")
# Of glibc 2.35: the one function that would keep wheels from systems of 2.34 (docs/reference/python.md).
TOO_NEW = re.compile(r"\bhypot\(")
ROOM_INCLUDE = re.compile(r'#include "([a-z]+)/([a-z]+)/[\w./]+"')
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
                    yield from room_violations(path.relative_to(root), line, where)
                    if TOO_NEW.search(line):
                        yield f"{where}: hypot asks for glibc 2.35; take norm() or std::sqrt"
                    if folder.startswith("include") and FORBIDDEN_IN_PUBLIC.match(line):
                        yield f"{where}: a public header may not include a heavy third party"


def room_violations(path: Path, line: str, where: str):
    """Between the rooms of one module; files beside the rooms (its driver) include all of them."""
    match = ROOM_INCLUDE.match(line)
    if not match or len(path.parts) < 4 or path.parts[1] != match[1] or match[1] not in ROOMS:
        return
    order = ROOMS[match[1]]
    if path.parts[2] not in order:
        yield f"{where}: room {path.parts[2]} is not in the list of {match[1]}'s rooms"
    elif match[2] not in order or order.index(match[2]) > order.index(path.parts[2]):
        yield f"{where}: room {path.parts[2]} may not include {match[2]}"


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
