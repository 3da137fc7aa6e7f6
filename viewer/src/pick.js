// Which of the faces drawn a ray meets first.
import {FACES} from './topology.js';

/// The face (8 hex + local face) and the distance along the ray, or null. `origin` and `direction` are triples in the drawing's frame.
export function pickFace(mesh, faces, origin, direction) {
  const [ox, oy, oz] = origin, [dx, dy, dz] = direction, {positions: p, hexes} = mesh;
  let nearest = Infinity, found = null;
  const c = new Float64Array(15);
  for (const code of faces) {
    const base = 8 * (code >>> 3), f = FACES[code & 7];
    for (let axis = 0; axis < 3; ++axis) {
      let sum = 0;
      for (let k = 0; k < 4; ++k) sum += c[3 * k + axis] = p[3 * hexes[base + f[k]] + axis];
      c[12 + axis] = sum / 4;
    }
    // Most faces are far from the ray: their centre tells.
    const mx = c[12] - ox, my = c[13] - oy, mz = c[14] - oz, along = mx * dx + my * dy + mz * dz;
    let reach = 0;
    for (let k = 0; k < 12; k += 3) reach = Math.max(reach, (c[k] - c[12]) ** 2 + (c[k + 1] - c[13]) ** 2 + (c[k + 2] - c[14]) ** 2);
    if (mx * mx + my * my + mz * mz - along * along > reach) continue;
    for (let k = 0; k < 4; ++k) {
      const t = meet(c, 3 * k, 3 * ((k + 1) % 4), ox, oy, oz, dx, dy, dz);
      if (t < nearest) { nearest = t; found = code; }
    }
  }
  return found === null ? null : {code: found, distance: nearest};
}

// Ray against the triangle of two corners and the centre, by the usual determinants (Moeller and Trumbore 1997).
function meet(c, i, j, ox, oy, oz, dx, dy, dz) {
  const ax = c[i] - c[12], ay = c[i + 1] - c[13], az = c[i + 2] - c[14], bx = c[j] - c[12], by = c[j + 1] - c[13], bz = c[j + 2] - c[14];
  const px = dy * bz - dz * by, py = dz * bx - dx * bz, pz = dx * by - dy * bx, det = ax * px + ay * py + az * pz;
  if (det === 0) return Infinity;
  const tx = ox - c[12], ty = oy - c[13], tz = oz - c[14], u = (tx * px + ty * py + tz * pz) / det;
  if (u < -1e-9 || u > 1) return Infinity;
  const qx = ty * az - tz * ay, qy = tz * ax - tx * az, qz = tx * ay - ty * ax, v = (dx * qx + dy * qy + dz * qz) / det;
  if (v < -1e-9 || u + v > 1 + 1e-9) return Infinity;
  const t = (bx * qx + by * qy + bz * qz) / det;
  return t > 0 ? t : Infinity;
}
