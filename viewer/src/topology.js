// Neighbours, what is laid open, irregular edges. Numbering: include/hexwright/mesh/hex_numbering.h.

export const FACES = [[0, 4, 7, 3], [1, 2, 6, 5], [0, 1, 5, 4], [3, 7, 6, 2], [0, 3, 2, 1], [4, 5, 6, 7]];
export const EDGES = [[0, 1], [1, 2], [3, 2], [0, 3], [4, 5], [5, 6], [7, 6], [4, 7], [0, 4], [1, 5], [2, 6], [3, 7]];

/// Edges of each face: side k runs from its vertex k to k + 1.
export const FACE_EDGES = FACES.map(f => f.map((v, k) => EDGES.findIndex(e => e.includes(v) && e.includes(f[(k + 1) % 4]))));

/// The hex beyond each face, 6 per hex; -1 where there is none, or where more than two hexes share the face.
export function findNeighbors(hexes, numVerts) {
  const n = hexes.length / 8, offset = new Uint32Array(numVerts + 1);
  const least = (h, f) => Math.min(hexes[8 * h + f[0]], hexes[8 * h + f[1]], hexes[8 * h + f[2]], hexes[8 * h + f[3]]);
  for (let h = 0; h < n; ++h)
    for (let lf = 0; lf < 6; ++lf) ++offset[least(h, FACES[lf]) + 1];
  for (let v = 0; v < numVerts; ++v) offset[v + 1] += offset[v];
  // Faces in buckets by least vertex. Of the others the opposite one and the greater of the two beside it tell them apart but for faces that have
  // three vertices in common, which the lesser of these two does.
  const next = offset.slice(0, numVerts), face = new Uint32Array(6 * n), opposite = new Uint32Array(6 * n), greater = new Uint32Array(6 * n), lesser = new Uint32Array(6 * n);
  for (let h = 0; h < n; ++h)
    for (let lf = 0; lf < 6; ++lf) {
      const f = FACES[lf];
      let k = 0;
      for (let j = 1; j < 4; ++j) if (hexes[8 * h + f[j]] < hexes[8 * h + f[k]]) k = j;
      const at = next[hexes[8 * h + f[k]]]++;
      const a = hexes[8 * h + f[k + 1 & 3]], b = hexes[8 * h + f[k + 3 & 3]];
      face[at] = 6 * h + lf;
      opposite[at] = hexes[8 * h + f[k + 2 & 3]];
      greater[at] = a > b ? a : b;
      lesser[at] = a > b ? b : a;
    }
  return pairFaces({numVerts, offset, face, opposite, greater, lesser});
}

function pairFaces({numVerts, offset, face, opposite, greater, lesser}) {
  const neighbors = new Int32Array(face.length).fill(-1), partner = new Int32Array(face.length).fill(-1);
  for (let v = 0; v < numVerts; ++v)
    for (let i = offset[v]; i < offset[v + 1]; ++i) {
      if (partner[i] !== -1) continue;
      let count = 0, found = -1;
      for (let j = i + 1; j < offset[v + 1]; ++j)
        if (opposite[j] === opposite[i] && greater[j] === greater[i] && lesser[j] === lesser[i]) {
          ++count;
          found = j;
          partner[j] = i;
        }
      if (count !== 1) continue;
      neighbors[face[i]] = face[found] / 6 | 0;
      neighbors[face[found]] = face[i] / 6 | 0;
    }
  return neighbors;
}

/// Edges inside with other than four hexes about them, edges of the boundary with other than two: {verts: 2 per edge, valence, onBoundary}.
export function findIrregularEdges({hexes, neighbors, marked, positions}) {
  const n = hexes.length / 8, numVerts = positions.length / 3, offset = new Uint32Array(numVerts + 1);
  const ends = (h, e) => { const a = hexes[8 * h + e[0]], b = hexes[8 * h + e[1]]; return a < b ? [a, b] : [b, a]; };
  for (let h = 0; h < n; ++h) for (const e of EDGES) ++offset[Math.min(hexes[8 * h + e[0]], hexes[8 * h + e[1]]) + 1];
  for (let v = 0; v < numVerts; ++v) offset[v + 1] += offset[v];
  const next = offset.slice(0, numVerts), other = new Uint32Array(12 * n), outer = new Uint8Array(12 * n);
  for (let h = 0; h < n; ++h)
    for (let le = 0; le < 12; ++le) {
      const a = hexes[8 * h + EDGES[le][0]], b = hexes[8 * h + EDGES[le][1]], at = next[a < b ? a : b]++;
      other[at] = a < b ? b : a;
      for (const lf of EDGE_FACES[le]) if (neighbors[6 * h + lf] < 0) outer[at] |= marked[h] >> lf & 1 ? BOUNDARY : ABSENT;
    }
  const verts = [], valence = [], onBoundary = [];
  for (let v = 0; v < numVerts; ++v) {
    const counts = new Map();
    for (let i = offset[v]; i < offset[v + 1]; ++i) {
      const entry = counts.get(other[i]);
      if (entry) { ++entry.count; entry.outer |= outer[i]; } else counts.set(other[i], {count: 1, outer: outer[i]});
    }
    for (const [w, entry] of counts)
      if (!(entry.outer & ABSENT) && entry.count !== (entry.outer ? 2 : 4)) { verts.push(v, w); valence.push(entry.count); onBoundary.push(entry.outer); }
  }
  return {verts, valence, onBoundary};
}
/// Beside an edge lies the boundary, or hexes that the page has not.
const BOUNDARY = 1, ABSENT = 2;
const EDGE_FACES = EDGES.map(([a, b]) => FACES.flatMap((f, lf) => f.includes(a) && f.includes(b) ? [lf] : []));

/// Which hexes a state leaves: {kept: 1 per hex, count}.
export function selectHexes(mesh, state) {
  const n = mesh.numHexes, kept = new Uint8Array(n);
  const lowest = state.low === 0 ? 0 : 5 * state.low + 1, highest = 5 * state.high;
  const plane = state.cut && statePlane(mesh, state), sign = state.flip ? -1 : 1;
  const hidden = mesh.summary.regions.map((_, i) => state.hiddenRegions.has(i));
  let count = 0;
  for (let h = 0; h < n; ++h) {
    if (mesh.depth[h] < state.peel || mesh.quality[h] < lowest || mesh.quality[h] > highest) continue;
    if (hidden[mesh.regions ? mesh.regions[h] : 0]) continue;
    if (plane) {
      const along = mesh.centers[3 * h] * plane.normal[0] + mesh.centers[3 * h + 1] * plane.normal[1] + mesh.centers[3 * h + 2] * plane.normal[2];
      if (sign * (along - plane.at) > 0) continue;
    }
    kept[h] = 1;
    ++count;
  }
  return {kept, count};
}

/// Vertices of kept hexes; null when all are kept.
export function findKeptVerts({hexes, numHexes, positions}, {kept, count}) {
  if (count === numHexes) return null;
  const verts = new Uint8Array(positions.length / 3);
  for (let h = 0; h < numHexes; ++h) if (kept[h]) for (let k = 0; k < 8; ++k) verts[hexes[8 * h + k]] = 1;
  return verts;
}

/// A cut's plane, its place measured between the mesh's extremes along the normal: points p with normal . p = at.
export function cutPlane(mesh, normal, offset) {
  const key = normal.join();
  if (mesh.extremes?.key !== key) {
    let low = Infinity, high = -Infinity;
    const p = mesh.positions;
    for (let i = 0; i < p.length; i += 3) {
      const along = p[i] * normal[0] + p[i + 1] * normal[1] + p[i + 2] * normal[2];
      if (along < low) low = along;
      if (along > high) high = along;
    }
    mesh.extremes = {key, low, high};
  }
  const {low, high} = mesh.extremes;
  return {normal, low, high, at: low + offset * (high - low)};
}

export const statePlane = (mesh, {cut, offset}) => cutPlane(mesh, cut.normal, offset);

/// Whether nothing lets people look behind the skin and the slices of a page that holds a part of a mesh.
export function isClosed({cut, peel, low, high, hiddenRegions, hiddenPatches}) {
  return cut?.kind !== 'view' && peel === 0 && low === 0 && high === 50 && hiddenRegions.size === 0 && hiddenPatches.size === 0;
}

/// Faces of kept hexes that no other kept one covers, as 8 hex + local face; those of hidden patches are left out, and, where the kept ones are
/// closed, those towards hexes that the page has not: nobody sees them.
export function collectFaces(mesh, kept, state) {
  const {hiddenPatches} = state, isHollow = mesh.summary.sample && isClosed(state);
  let faces = new Uint32Array(1 << 16), count = 0;
  const neighbors = mesh.neighbors, hides = mesh.patches && hiddenPatches.size > 0;
  for (let h = 0; h < mesh.numHexes; ++h) {
    if (!kept[h]) continue;
    if (count + 6 > faces.length) { const larger = new Uint32Array(2 * faces.length); larger.set(faces); faces = larger; }
    let index = mesh.firstMarked[h];
    const bits = mesh.marked[h];
    for (let lf = 0; lf < 6; ++lf) {
      const isMarked = bits >> lf & 1, other = neighbors[6 * h + lf], patch = isMarked && mesh.patches ? mesh.patches[index] - 1 : -1;
      index += isMarked;
      if (other >= 0 ? kept[other] : isHollow && !isMarked) continue;
      if (hides && patch >= 0 && hiddenPatches.has(patch)) continue;
      faces[count++] = 8 * h + lf;
    }
  }
  return faces.subarray(0, count);
}
