"""Meshes made here for the tests of the page, and what the page must say about them, computed from the mesh itself with numpy."""
import numpy as np

CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
FACES = np.array(((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)))
FRAMES = np.array(((1, 3, 4), (2, 0, 5), (3, 1, 6), (0, 2, 7), (7, 5, 0), (4, 6, 1), (5, 7, 2), (6, 4, 3)))


class HexMesh:
    def __init__(self, points, hexes, regions=None):
        self.points, self.hexes = np.asarray(points, float), np.asarray(hexes, np.int64)
        self.regions = np.zeros(len(self.hexes), int) if regions is None else np.asarray(regions)

    def centers(self):
        return self.points[self.hexes].mean(1)

    def scaled_jacobians(self):
        p = self.points[self.hexes]
        edges = p[:, FRAMES] - p[:, :, None]  # hex, corner, edge, axis
        edges /= np.linalg.norm(edges, axis=-1, keepdims=True)
        return np.linalg.det(edges).min(1)

    def neighbors(self):
        """The hex beyond each face, -1 where there is none."""
        faces = np.sort(self.hexes[:, FACES].reshape(-1, 4), 1)
        order = np.lexsort(faces.T)
        same = (faces[order[1:]] == faces[order[:-1]]).all(1)
        beyond = np.full(len(faces), -1)
        a, b = order[:-1][same], order[1:][same]
        beyond[a], beyond[b] = b // 6, a // 6
        return beyond.reshape(-1, 6)

    def depths(self):
        beyond, depth = self.neighbors(), np.full(len(self.hexes), 255)
        layer = np.flatnonzero((beyond < 0).any(1))
        for d in range(255):
            if not len(layer):
                break
            depth[layer] = d
            reached = np.unique(beyond[layer])
            layer = reached[(reached >= 0)]
            layer = layer[depth[layer] == 255]
        return depth

    def num_faces(self, kept):
        """Faces of kept hexes that no kept one covers."""
        beyond = self.neighbors()
        return int((kept[:, None] & ~((beyond >= 0) & kept[beyond])).sum())

    def clear_place(self, axis, near):
        """A multiple of 0.001 of the extent at which no centre is so near a plane across the axis that the page's rounding decides."""
        along, extent = self.centers()[:, axis], self.points[:, axis]
        for step in range(1000):
            offset = round(near + step / 1000, 3)
            if np.abs(along - extent.min() - offset * np.ptp(extent)).min() > np.ptp(extent) / 60000:
                return offset
        raise ValueError("centres everywhere")

    def below(self, axis, offset):
        """Hexes whose centre is not beyond the plane at a share of the mesh's extent."""
        extent = self.points[:, axis]
        return self.centers()[:, axis] < extent.min() + offset * np.ptp(extent)

    def area(self, quads):
        """Of each quad as four triangles about its centre."""
        p = self.points[quads]
        spokes = p - p.mean(1, keepdims=True)
        return np.linalg.norm(np.cross(spokes, np.roll(spokes, -1, 1)), axis=-1).sum(1) / 2


def grid_hexes(shape, at):
    k, j, i = np.meshgrid(*[np.arange(n) for n in shape[::-1]], indexing="ij")
    return np.stack([at(i + a, j + b, k + c) for a, b, c in CORNERS], -1).reshape(-1, 8)


def make_block(shape, jitter, seed=1):
    """A grid of unit cubes whose inner vertices are moved."""
    i, j, k = shape
    points = np.stack(np.meshgrid(np.arange(k + 1), np.arange(j + 1), np.arange(i + 1), indexing="ij"), -1).reshape(-1, 3)[:, ::-1].astype(float)
    inner = ((points > 0) & (points < shape)).all(1)
    points[inner] += np.random.default_rng(seed).uniform(-jitter, jitter, (inner.sum(), 3))
    return HexMesh(points, grid_hexes(shape, lambda a, b, c: (c * (j + 1) + b) * (i + 1) + a))


def make_step():
    """A block with a corner cut out, in two regions."""
    block = make_block((14, 10, 8), 0.22)
    x, _, z = block.centers().T
    kept = ~((x > 7) & (z > 4))
    used, hexes = np.unique(block.hexes[kept], return_inverse=True)
    mesh = HexMesh(block.points[used], hexes.reshape(-1, 8))
    mesh.regions = (mesh.centers()[:, 0] > 7).astype(int) + 1
    return mesh


def step_patches(mesh):
    """Boundary quads and a number for each, by normal and place: -x +x -y +y -z +z, and the two of the step."""
    beyond = mesh.neighbors()
    hexes, faces = np.nonzero(beyond < 0)
    quads = mesh.hexes[hexes[:, None], FACES[faces]]
    middles = mesh.points[quads].mean(1)
    patches = faces.copy()
    patches[(faces == 1) & (middles[:, 0] < 8)] = 6
    patches[(faces == 5) & (middles[:, 2] < 5)] = 7
    return quads, patches


def feature_edges(quads, patches):
    """Edges between two patches, as two vertices and a number from 1 for each pair of patches."""
    sides = {}
    for quad, patch in zip(quads, patches):
        for a, b in zip(quad, np.roll(quad, -1)):
            sides.setdefault((min(a, b), max(a, b)), []).append(patch)
    pairs = sorted({tuple(sorted(s)) for s in sides.values() if s[0] != s[-1]})
    return [(*verts, pairs.index(tuple(sorted(s))) + 1) for verts, s in sides.items() if s[0] != s[-1]]


def write_medit(path, mesh, quads, patches):
    """With the quads' patches as references, and the edges between two patches as feature edges."""
    edges = feature_edges(quads, patches)
    ends = np.bincount([v for a, b, _ in edges for v in (a, b)], minlength=len(mesh.points))
    corners = np.flatnonzero(ends >= 3)
    with open(path, "w") as file:
        file.write(f"MeshVersionFormatted 2\nDimension 3\nVertices\n{len(mesh.points)}\n")
        file.writelines(f"{x!r} {y!r} {z!r} 0\n" for x, y, z in mesh.points.tolist())
        file.write(f"Edges\n{len(edges)}\n")
        file.writelines(f"{a + 1} {b + 1} {ref}\n" for a, b, ref in edges)
        file.write(f"Corners\n{len(corners)}\n")
        file.writelines(f"{v + 1}\n" for v in corners)
        file.write(f"Quadrilaterals\n{len(quads)}\n")
        file.writelines(" ".join(str(v + 1) for v in quad) + f" {patch + 1}\n" for quad, patch in zip(quads, patches))
        file.write(f"Hexahedra\n{len(mesh.hexes)}\n")
        file.writelines(" ".join(str(v + 1) for v in verts) + f" {tag}\n" for verts, tag in zip(mesh.hexes, mesh.regions))
        file.write("End\n")
    return max(ref for _, _, ref in edges), len(corners)


def write_vtk(path, mesh):
    """Legacy VTK, binary: fast for a million hexes."""
    count = len(mesh.hexes)
    with open(path, "wb") as file:
        file.write(b"# vtk DataFile Version 3.0\ngrid\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS %d double\n" % len(mesh.points))
        file.write(mesh.points.astype(">f8").tobytes())
        file.write(b"\nCELLS %d %d\n" % (count, 9 * count) + np.hstack([np.full((count, 1), 8), mesh.hexes]).astype(">i4").tobytes())
        file.write(b"\nCELL_TYPES %d\n" % count + np.full(count, 12).astype(">i4").tobytes())
