"""Draws the pressure on the sphere that potentialFoam found, beside the exact one, and says how far they are apart.

Usage: look.py CASE sphere.png. The exact pressure of potential flow about a sphere is Cp = 1 - 9/4 sin^2(angle from the stream).
"""
import re
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent))
from draw_solution import draw_faces


def read_list(path, start=r"^\d+\s*\("):
    """The numbers of an OpenFOAM list, row by row."""
    text = Path(path).read_text()
    rows = text[re.search(start, text, re.M).end():].split("\n)")[0].strip().splitlines()
    return [[float(word) for word in re.sub(r"^\d+\(|[()]", " ", row).split()] for row in rows]


def read_patch(path, name):
    """First face and number of faces."""
    text = re.search(rf"^\s*{name}\s*\{{(.*?)\}}", path.read_text(), re.M | re.S)[1]
    return (int(re.search(rf"{key}\s+(\d+)", text)[1]) for key in ("startFace", "nFaces"))


case = Path(sys.argv[1])
mesh = case / "constant/polyMesh"
start, count = read_patch(mesh / "boundary", "sphere")
points = np.array(read_list(mesh / "points"))
faces = np.array(read_list(mesh / "faces")[start:start + count], int)[:, ::-1]  # seen from the flow
owner = np.array(read_list(mesh / "owner")[start:start + count], int)[:, 0]
velocity = -np.array(read_list(case / "0/grad(Phi)", r"internalField[^(]*\("))[owner]  # in the thin cells at the sphere

pressure = 1 - np.sum(velocity**2, axis=1)
direction = points[faces].mean(axis=1)
cosine = direction[:, 0] / np.linalg.norm(direction, axis=1)
exact = 1 - 9 / 4 * (1 - cosine**2)
error = np.abs(pressure - exact).max() / (exact.max() - exact.min())
print(f"{count} faces on the sphere: Cp from {pressure.min():.4f} to {pressure.max():.4f}; largest error {100 * error:.2f} % of its range")

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

figure, (left, right) = pyplot.subplots(1, 2, figsize=(11, 5), layout="constrained", width_ratios=(1.2, 1))
draw_faces(left, points, faces, pressure, (0.5, 0.75, -0.45))
left.set_title("pressure coefficient, flow along x")
angle = np.degrees(np.arccos(cosine))
right.plot(angle, pressure, ".", markersize=3, label=f"{count} faces of the mesh")
line = np.linspace(0, 180, 181)
right.plot(line, 1 - 9 / 4 * np.sin(np.radians(line))**2, "k", linewidth=1, label="exact: 1 - 9/4 sin²")
right.set_xlabel("degrees from the stream")
right.legend()
figure.savefig(sys.argv[2], dpi=110)
