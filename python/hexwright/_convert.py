"""To other packages' objects. Each is imported when it is asked for."""
from __future__ import annotations

import base64
import importlib
import re
import struct
import zlib
from collections.abc import Mapping
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

VTK_HEXAHEDRON = 12
#: Position in VTK's order of each vertex of scikit-fem's hexahedron.
SKFEM_ORDER = [0, 4, 3, 1, 7, 5, 2, 6]


class Hexes(Protocol):
    """What is converted: a hexwright.HexMesh, which calls these functions."""

    layer: NDArray[np.int32] | None
    _core: Any

    @property
    def points(self) -> NDArray[np.float64]: ...
    @property
    def hexes(self) -> NDArray[np.int32]: ...
    @property
    def regions(self) -> NDArray[np.int32]: ...
    @property
    def patches(self) -> Mapping[str, Any]: ...
    @property
    def curves(self) -> Mapping[str, NDArray[np.int32]]: ...
    @property
    def corners(self) -> NDArray[np.int32]: ...
    def facets(self, name: str) -> Any: ...
    def quality(self) -> NDArray[np.float64]: ...


def need(package: str, extra: str) -> Any:
    try:
        return importlib.import_module(package)
    except ImportError as error:
        raise ImportError(f"{error}; install it with: pip install 'hexwright[{extra}]'") from error


def to_pyvista(mesh: Hexes) -> Any:
    pyvista = need("pyvista", "pyvista")
    grid = pyvista.UnstructuredGrid({VTK_HEXAHEDRON: mesh.hexes.astype(np.int64)}, np.array(mesh.points))
    grid.cell_data["region"] = np.array(mesh.regions)
    grid.cell_data["scaled_jacobian"] = mesh.quality()
    if mesh.layer is not None:
        grid.cell_data["layer"] = np.array(mesh.layer)
    return grid


def to_meshio(mesh: Hexes) -> Any:
    meshio = need("meshio", "meshio")
    cells: list[tuple[str, NDArray[np.int32]]] = [("hexahedron", mesh.hexes)]
    names: list[str | None] = [None]
    cells += [("quad", facets.quads) for facets in mesh.patches.values()]
    names += list(mesh.patches)
    cells += [("line", edges) for edges in mesh.curves.values()]
    names += list(mesh.curves)
    if len(mesh.corners):
        cells.append(("vertex", mesh.corners.reshape(-1, 1)))
        names.append("corners")
    sets = {
        name: [np.arange(len(block)) if name == own else None for own, (_, block) in zip(names, cells)]
        for name in names
        if name is not None
    }
    data = {"region": mesh.regions} if mesh.layer is None else {"region": mesh.regions, "layer": mesh.layer}
    none = [np.zeros(len(block), dtype=np.int32) for _, block in cells[1:]]
    cell_data = {name: [values, *none] for name, values in data.items()}
    return meshio.Mesh(mesh.points, cells, cell_data=cell_data, cell_sets=sets)


def to_skfem(mesh: Hexes) -> Any:
    skfem = need("skfem", "skfem")
    result = skfem.MeshHex(np.ascontiguousarray(mesh.points.T), np.ascontiguousarray(mesh.hexes[:, SKFEM_ORDER].T))
    facets = np.sort(result.facets, axis=0).T
    order = np.lexsort(facets.T[::-1])
    keys = _as_keys(facets[order])
    boundaries = {}
    for name, patch in mesh.patches.items():
        boundaries[name] = order[np.searchsorted(keys, _as_keys(np.sort(patch.quads, axis=1)))]
    for name in {re.sub(r"\.\d+$", "", name) for name in boundaries} - set(boundaries):
        boundaries[name] = order[np.searchsorted(keys, _as_keys(np.sort(mesh.facets(name).quads, axis=1)))]
    if boundaries:
        result = result.with_boundaries(boundaries)
    tags = np.unique(mesh.regions)
    if len(tags) > 1:
        names = {tag: mesh._core.region_name(int(tag)) for tag in tags}
        result = result.with_subdomains({name: np.flatnonzero(mesh.regions == tag) for tag, name in names.items()})
    return result


def _as_keys(rows: NDArray[Any]) -> NDArray[np.bytes_]:
    """Rows of four point numbers as byte strings, which sort and compare like the rows."""
    return np.ascontiguousarray(rows).astype(">u4").view("S16").ravel()


def to_png(pixels: NDArray[np.uint8]) -> bytes:
    """8-bit RGB, rows from the top."""
    height, width, _ = pixels.shape
    rows = np.zeros((height, 1 + 3 * width), dtype=np.uint8)  # each row begins with its filter: none
    rows[:, 1:] = pixels.reshape(height, -1)

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows.tobytes())) + chunk(b"IEND", b"")


def to_png_tag(pixels: NDArray[np.uint8], text: str) -> str:
    return f'<img alt="{text}" src="data:image/png;base64,{base64.b64encode(to_png(pixels)).decode()}">'
