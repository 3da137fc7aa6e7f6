// Which of the faces drawn a ray meets first, by the triangles that they are drawn with.
import {DIVISIONS, GRID_INDEX, QUAD_INDEX} from './places.js';
import {FACE_EDGES, FACES} from './topology.js';

/// The face (8 hex + local face) and the distance along the ray, or null. `origin` and `direction` are triples in the drawing's frame.
export function pickFace(mesh, faces, origin, direction) {
  const face = mesh.mids ? new CurvedFace(mesh) : new StraightFace(mesh);
  let nearest = Infinity, found = null;
  for (const code of faces) {
    if (!face.isNear(code, origin, direction)) continue;
    const points = face.place(), index = face.index;
    for (let k = 0; k < index.length; k += 3) {
      const t = meet(points, 3 * index[k + 2], 3 * index[k], 3 * index[k + 1], origin, direction);
      if (t < nearest) { nearest = t; found = code; }
    }
  }
  return found === null ? null : {code: found, distance: nearest};
}

/// Corners and centre of one face after the other.
class StraightFace {
  constructor(mesh) {
    this.mesh = mesh;
    this.points = new Float64Array(15);
    this.index = QUAD_INDEX;
  }
  /// Most faces are far from the ray: a ball around them tells.
  isNear(code, origin, direction) {
    const {positions, hexes} = this.mesh, base = 8 * (code >>> 3), f = FACES[code & 7], c = this.points;
    for (let axis = 0; axis < 3; ++axis) {
      let sum = 0;
      for (let k = 0; k < 4; ++k) sum += c[3 * k + axis] = positions[3 * hexes[base + f[k]] + axis];
      c[12 + axis] = sum / 4;
    }
    return isBallMet(c, 4, 12, 1, origin, direction);
  }
  place() { return this.points; }
}

/// The same for faces of second order: their nodes, as rows of three, and a grid of places between them.
class CurvedFace {
  constructor(mesh) {
    this.mesh = mesh;
    this.nodes = new Float64Array(27);
    this.points = new Float64Array(3 * (DIVISIONS + 1) ** 2);
    this.index = GRID_INDEX;
  }
  isNear(code, origin, direction) {
    const {positions, hexes, mids} = this.mesh, hex = code >>> 3, f = FACES[code & 7], edges = FACE_EDGES[code & 7], n = this.nodes;
    for (let axis = 0; axis < 3; ++axis) {
      for (let k = 0; k < 4; ++k) n[3 * CORNER[k] + axis] = positions[3 * hexes[8 * hex + f[k]] + axis];
      let middle = 0;
      for (let k = 0; k < 4; ++k) {
        const mid = mids.ofHex[12 * hex + edges[k]], a = n[3 * CORNER[k] + axis], b = n[3 * CORNER[(k + 1) % 4] + axis];
        const x = n[3 * SIDE[k] + axis] = mid ? mids.positions[3 * (mid - 1) + axis] : (a + b) / 2;
        middle += x / 2 - a / 4;
      }
      n[12 + axis] = middle;
    }
    // Weights of nodes are of either sign; along an axis their sizes add up to 1.25 at most.
    return isBallMet(n, 9, 12, 1.25 * 1.25, origin, direction);
  }
  place() {
    const n = this.nodes, points = this.points;
    for (let j = 0, at = 0; j <= DIVISIONS; ++j)
      for (let i = 0; i <= DIVISIONS; ++i, at += 3)
        for (let axis = 0; axis < 3; ++axis) {
          let sum = 0;
          for (let k = 0; k < 9; ++k) sum += WEIGHTS[i][k % 3] * WEIGHTS[j][k / 3 | 0] * n[3 * k + axis];
          points[at + axis] = sum;
        }
    return points;
  }
}
/// Of the nine nodes, those at corner k and on side k.
const CORNER = [0, 2, 8, 6], SIDE = [1, 5, 7, 3];
const WEIGHTS = Array.from({length: DIVISIONS + 1}, (_, i) => i / DIVISIONS).map(t => [(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)]);

/// Whether a ray comes near points: a ball about the one at `center`, `room` times as large as to hold all.
function isBallMet(points, count, center, room, [ox, oy, oz], [dx, dy, dz]) {
  const cx = points[center], cy = points[center + 1], cz = points[center + 2], mx = cx - ox, my = cy - oy, mz = cz - oz, along = mx * dx + my * dy + mz * dz;
  let reach = 0;
  for (let k = 0; k < 3 * count; k += 3) reach = Math.max(reach, (points[k] - cx) ** 2 + (points[k + 1] - cy) ** 2 + (points[k + 2] - cz) ** 2);
  return mx * mx + my * my + mz * mz - along * along <= reach * room * room;
}

/// Ray against the triangle of points o, i and j, by the usual determinants (Moeller and Trumbore 1997).
function meet(c, o, i, j, [ox, oy, oz], [dx, dy, dz]) {
  const ax = c[i] - c[o], ay = c[i + 1] - c[o + 1], az = c[i + 2] - c[o + 2], bx = c[j] - c[o], by = c[j + 1] - c[o + 1], bz = c[j + 2] - c[o + 2];
  const px = dy * bz - dz * by, py = dz * bx - dx * bz, pz = dx * by - dy * bx, det = ax * px + ay * py + az * pz;
  if (det === 0) return Infinity;
  const tx = ox - c[o], ty = oy - c[o + 1], tz = oz - c[o + 2], u = (tx * px + ty * py + tz * pz) / det;
  if (u < -1e-9 || u > 1) return Infinity;
  const qx = ty * az - tz * ay, qy = tz * ax - tx * az, qz = tx * ay - ty * ax, v = (dx * qx + dy * qy + dz * qz) / det;
  if (v < -1e-9 || u + v > 1 + 1e-9) return Infinity;
  const t = (bx * qx + by * qy + bz * qz) / det;
  return t > 0 ? t : Infinity;
}
