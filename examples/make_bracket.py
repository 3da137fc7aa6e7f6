"""Writes bracket.obj: a bracket with a bore, its faces in named groups (`g`). Millimetres."""
import math
import sys

LENGTH, RADIUS, BORE, THICKNESS = 60.0, 20.0, 10.0, 12.0


def outer(angle):
    """Where the ray from the bore's middle leaves the bracket: half a circle, then a rectangle."""
    x, y = math.cos(angle), math.sin(angle)
    if x >= -1e-12:
        scale = RADIUS
    else:
        scale = min(LENGTH / -x, RADIUS / abs(y) if abs(y) > 1e-12 else math.inf)
    return rounded(scale * x), rounded(scale * y)


def rounded(x):
    return round(x, 9) + 0.0


def main():
    corner = math.atan2(RADIUS, -LENGTH)
    angles = sorted({round(2 * math.pi * k / 144 - math.pi, 12) for k in range(144)} | {corner, -corner})
    groups, points = {}, {}

    def quad(name, *corners):
        groups.setdefault(name, []).append([points.setdefault(p, len(points) + 1) for p in corners])

    for a, b in zip(angles, angles[1:] + [angles[0] + 2 * math.pi]):
        (ax, ay), (bx, by) = outer(a), outer(b)
        (cx, cy), (dx, dy) = ((rounded(BORE * math.cos(t)), rounded(BORE * math.sin(t))) for t in (a, b))
        is_end = max(ax, bx) < -LENGTH + 1e-9
        quad("support" if is_end else "rim", (ax, ay, 0), (bx, by, 0), (bx, by, THICKNESS), (ax, ay, THICKNESS))
        is_pulled = math.cos((a + b) / 2) > 0
        quad("pin" if is_pulled else "bore", (dx, dy, 0), (cx, cy, 0), (cx, cy, THICKNESS), (dx, dy, THICKNESS))
        quad("top", (ax, ay, THICKNESS), (bx, by, THICKNESS), (dx, dy, THICKNESS), (cx, cy, THICKNESS))
        quad("bottom", (bx, by, 0), (ax, ay, 0), (cx, cy, 0), (dx, dy, 0))
    with open(sys.argv[1], "w") as out:
        for x, y, z in points:
            out.write(f"v {x:.12g} {y:.12g} {z:.12g}\n")
        for name, quads in groups.items():
            out.write(f"g {name}\n")
            for quad_points in quads:
                out.write("f {} {} {} {}\n".format(*quad_points))


if __name__ == "__main__":
    main()
