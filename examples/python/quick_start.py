"""Meshes a surface and writes the mesh for a solver. Usage: quick_start.py SURFACE OUTPUT"""
from __future__ import annotations

import sys

import hexwright as hw


def tell(stage: str, fraction: float) -> None:
    print(f"\r{stage:<12} {fraction:4.0%}", end="", file=sys.stderr)


def main(surface: str, output: str) -> int:
    mesh = hw.mesh(surface, tolerance="0.5%", progress=tell)
    mesh.save(output)
    quality = mesh.quality()
    print(f"\n{output}: {len(mesh.hexes)} hexes, scaled Jacobian {quality.min():.3f} to {quality.max():.3f}")
    for name, facets in mesh.patches.items():
        print(f"  {name}: {len(facets.quads)} quads")
    return 0 if mesh.valid else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:3]))
