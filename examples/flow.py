#!/usr/bin/env python3
"""Three domains of flow: an airfoil between two walls, half a car on the ground, and a junction of two pipes.

Usage: flow.py PROGRAM FOLDER [--coarse] [--only NAME]

PROGRAM is hexwright. FOLDER gets NAME.obj, NAME.vtu, NAME.json (the report) and NAME.png of each. `--coarse` doubles the sizes:
what a test has time for. Prints one line per mesh. Exit code 1 when one misses its gate.
"""
import argparse
import json
import math
import subprocess
import sys
from pathlib import Path


def prism(outline, axis, low, high, name):
    """Over a polygon (counter-clockwise seen from the axis' end); its coordinates are the two others, in order."""
    def place(p, at):
        q = list(p)
        q.insert(axis, at)
        return tuple(q)
    n = len(outline)
    verts = [place(p, low) for p in outline] + [place(p, high) for p in outline]
    faces = [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    faces += [list(range(n))[::-1], list(range(n, 2 * n))]
    if axis == 1:  # z, x, y turn the other way
        faces = [f[::-1] for f in faces]
    return verts, {name: faces}


def tube(start, end, radius, names, segments=96):
    """Along one axis; names of its side, start and end."""
    axis = next(k for k in range(3) if start[k] != end[k])
    center = [c for k, c in enumerate(start) if k != axis]
    outline = [(center[0] + radius * math.cos(2 * math.pi * k / segments), center[1] + radius * math.sin(2 * math.pi * k / segments))
               for k in range(segments)]
    low, high = sorted((start[axis], end[axis]))
    verts, groups = prism(outline, axis, low, high, "all")
    faces = groups["all"]
    ends = faces[-2:] if start[axis] < end[axis] else faces[:-3:-1]
    parts = {}
    for name, some in zip(names, (faces[:-2], ends[:1], ends[1:])):
        parts.setdefault(name, []).extend(some)
    return verts, parts


def joined(*parts):
    verts, groups = [], {}
    for some, of in parts:
        for name, faces in of.items():
            groups.setdefault(name, []).extend([len(verts) + i for i in face] for face in faces)
        verts = verts + some
    return verts, groups


def write_obj(path, verts, groups):
    lines = ["v %.10g %.10g %.10g" % v for v in verts]
    for name, faces in groups.items():
        lines += [f"g {name}"] + ["f " + " ".join(str(i + 1) for i in face) for face in faces]
    path.write_text("\n".join(lines) + "\n")


def airfoil(count=60, thickness=0.12):
    """NACA 0012 of chord 1, with a sharp trailing edge; longer than the domain is wide."""
    def half(x):
        return 5 * thickness * (0.2969 * math.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    stations = [0.5 * (1 - math.cos(math.pi * i / count)) for i in range(count + 1)]
    outline = [(x, -half(x)) for x in stations[:-1]] + [(1, 0)] + [(x, half(x)) for x in stations[-2:0:-1]]
    return prism(outline, 2, -0.2, 0.6, "wing")


def car():
    """A body with a round nose and a slanted back on four legs, which go into the ground."""
    def arc(x, z, radius, first, last, steps=8):
        return [(x + radius * math.cos(math.radians(first + (last - first) * k / steps)),
                 z + radius * math.sin(math.radians(first + (last - first) * k / steps))) for k in range(steps + 1)]
    profile = (arc(0.1, 0.15, 0.1, 180, 270) + [(1.04, 0.05), (1.04, 0.25), (0.84, 0.34)] + arc(0.1, 0.24, 0.1, 90, 180))
    body = prism(profile, 1, -0.19, 0.19, "body")
    legs = [tube((x, y, -0.02), (x, y, 0.1), 0.03, ("legs",) * 3, 24) for x in (0.2, 0.8) for y in (-0.13, 0.13)]
    return joined(body, *legs)


def junction():
    return joined(tube((-3, 0, 0), (3, 0, 0), 1, ("wall", "inlet", "outlet")), tube((0, 0, 0), (0, 0, 3), 0.7, ("wall", "wall", "branch")))


LAYERS = "first:0.05h,growth:1.2,count:5"
CASES = {  # shape, sizes that --coarse doubles, other options
    "airfoil": (airfoil, {"--size": 0.02, "--max-size": 0.32, "--refine": ("box:1,-0.15,0,2.5,0.15,0.4={:g}", 0.04)},
                ["--side", "outside", "--box", "-2,-2,0,4,2,0.4", "--growth", "1.3"]),
    "car": (car, {"--size": 0.02, "--max-size": 0.16, "--refine": ("box:1,0,0,2,0.25,0.4={:g}", 0.04)},
            ["--side", "outside", "--box", "-1.5,0,0,3.5,1,1", "--growth", "1.3"]),
    "junction": (junction, {"--size": 0.12}, ["--layers", f"wall={LAYERS}"]),
}


CUTS = {"airfoil": ("z", 0.5), "car": ("y", 0.95), "junction": ("y", 0.5)}  # of the pictures


def mesh(program, folder, name, scale):
    shape, sizes, options = CASES[name]
    write_obj(folder / f"{name}.obj", *shape())
    command = [program, "mesh", f"{name}.obj", "-o", f"{name}.vtu", "--report", f"{name}.json", "--quiet"]
    for option, size in sizes.items():
        form, size = size if isinstance(size, tuple) else ("{:g}", size)
        command += [option, form.format(scale * size)]
    code = subprocess.run(command + options, cwd=folder).returncode
    axis, place = CUTS[name]
    subprocess.run([program, "picture", f"{name}.vtu", "-o", f"{name}.png", "--cut", axis, "--cut-at", str(place), "--quiet"], cwd=folder, check=True)
    report = json.loads((folder / f"{name}.json").read_text())
    quality = report["verdict"]["quality"]
    patches = sorted(s["name"] for s in report["sets"] if s["kind"] == "patch")
    line = f"{name}: {report['hexes']:,} hexes, scaled Jacobian {quality['min_scaled_jacobian']:.2f} at least, {quality['avg_scaled_jacobian']:.2f} on average; patches {', '.join(patches)}"
    if "layers" in report:
        line += f"; layers on {100 * report['layers']['coverage']:.1f}% of the walls"
    print(line, flush=True)
    return code


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--coarse", action="store_true")
    parser.add_argument("--only", choices=list(CASES))
    args = parser.parse_args(arguments)
    args.folder.mkdir(parents=True, exist_ok=True)
    program = str(Path(args.program).resolve())
    codes = [mesh(program, args.folder, name, 2 if args.coarse else 1) for name in CASES if args.only in (None, name)]
    sys.exit(1 if any(codes) else 0)


if __name__ == "__main__":
    main(sys.argv[1:])
