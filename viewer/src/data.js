// Unpacks the page's arrays. Their formats: src/render/page/view_arrays.h.
import {EDGES} from './topology.js';

function bytesOfBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const characters = atob(text), bytes = new Uint8Array(characters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = characters.charCodeAt(i);
  return bytes;
}

/// The bytes of an array, or null where the page has none of this name. The element gives up its text: it is as large again.
async function unpack(name) {
  const element = document.getElementById(`array-${name}`);
  if (!element) return null;
  const stream = new Blob([bytesOfBase64(element.textContent)]).stream().pipeThrough(new DecompressionStream('deflate'));
  element.remove();
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function joinPlanes(bytes, numBytes, begin = 0, count = bytes.length / numBytes) {
  const numbers = new Uint32Array(count);
  for (let byte = 0; byte < numBytes; ++byte) {
    const plane = begin + byte * count, shift = 8 * byte;
    for (let i = 0; i < count; ++i) numbers[i] |= bytes[plane + i] << shift;
  }
  return numbers;
}

const unzigzag = code => code >>> 1 ^ -(code & 1);

function sumDeltas(codes, mask) {
  let last = 0;
  for (let i = 0; i < codes.length; ++i) codes[i] = last = last + unzigzag(codes[i]) & mask;
  return codes;
}

const readNumbers = bytes => bytes && sumDeltas(joinPlanes(bytes, 4), -1);
const readCodes = bytes => bytes && joinPlanes(bytes, 4);

/// Positions in the drawing's frame: the box's centre at 0, its diagonal 1 long.
function readPositions(bytes, frame) {
  const count = bytes.length / 6, positions = new Float32Array(3 * count);
  for (let axis = 0; axis < 3; ++axis) {
    const shares = sumDeltas(joinPlanes(bytes, 2, 2 * count * axis, count), 0xffff);
    const extent = frame.extent[axis] / frame.diagonal;
    for (let i = 0; i < count; ++i) positions[3 * i + axis] = (shares[i] / 65535 - 0.5) * extent;
  }
  return positions;
}

function readHexes(bytes) {
  const codes = joinPlanes(bytes, 4);
  let first = 0;
  for (let h = 0; h < codes.length; h += 8) {
    let last = first;
    for (let k = 0; k < 8; ++k) codes[h + k] = last = last + unzigzag(codes[h + k]) | 0;
    first = codes[h];
  }
  return codes;
}

/// From the world's coordinates to the drawing's and back.
function makeFrame({low, high}) {
  const extent = low.map((l, k) => high[k] - l);
  const diagonal = Math.hypot(...extent) || 1;
  return {extent, diagonal, center: low.map((l, k) => (l + high[k]) / 2),
    toWorld(p) { return p.map((x, k) => x * diagonal + this.center[k]); },
    toScene(p) { return p.map((x, k) => (x - this.center[k]) / diagonal); }};
}

/// Index of each hex's first marked face in the lists of these.
function countMarked(marked) {
  const first = new Uint32Array(marked.length + 1);
  for (let h = 0; h < marked.length; ++h) {
    let bits = marked[h], count = 0;
    for (; bits; bits &= bits - 1) ++count;
    first[h + 1] = first[h] + count;
  }
  return first;
}

function findCenters(positions, hexes) {
  const n = hexes.length / 8, centers = new Float32Array(3 * n);
  for (let h = 0; h < n; ++h)
    for (let axis = 0; axis < 3; ++axis) {
      let sum = 0;
      for (let k = 0; k < 8; ++k) sum += positions[3 * hexes[8 * h + k] + axis];
      centers[3 * h + axis] = sum / 8;
    }
  return centers;
}

export async function readMesh() {
  const summary = JSON.parse(document.getElementById('summary').textContent);
  const frame = makeFrame(summary.box);
  const positions = readPositions(await unpack('positions'), frame);
  const hexes = readHexes(await unpack('hexes'));
  const marked = await unpack('faces');
  const mesh = {
    summary, frame, positions, hexes, numHexes: hexes.length / 8, marked, firstMarked: countMarked(marked), centers: findCenters(positions, hexes),
    quality: await unpack('quality'), depth: await unpack('depth'), patches: readCodes(await unpack('patches')), regions: readCodes(await unpack('regions')),
    hexIds: readNumbers(await unpack('hex_ids')), vertIds: readNumbers(await unpack('vert_ids')), distance: await unpack('distance'),
    curves: readNumbers(await unpack('curves')), curveIds: readNumbers(await unpack('curve_ids')), corners: readNumbers(await unpack('corners')), fields: []};
  mesh.deepest = mesh.depth.reduce((most, d) => d < 255 && d > most ? d : most, 0);  // 255: no boundary leads there
  for (let i = 0; i < summary.fields.length; ++i) mesh.fields.push(await unpack(`field_${i}`));
  const midBytes = await unpack('mid_positions');
  if (midBytes) mesh.mids = {positions: readPositions(midBytes, frame), ofHex: readNumbers(await unpack('hex_mids'))};
  const surfaceBytes = await unpack('surface_positions');
  if (surfaceBytes) mesh.surface = {positions: readPositions(surfaceBytes, frame), tris: readNumbers(await unpack('surface_tris'))};
  return mesh;
}

/// The node of a curved edge, by its vertices in any order; null for a straight one.
export function midNode(mesh, a, b) {
  if (!mesh.mids) return null;
  const numVerts = mesh.positions.length / 3, keyOf = (v, w) => v < w ? v * numVerts + w : w * numVerts + v;
  if (!mesh.mids.ofEdge) {
    mesh.mids.ofEdge = new Map();
    mesh.mids.ofHex.forEach((mid, i) => {
      if (!mid) return;
      const base = 8 * Math.floor(i / 12), [k, l] = EDGES[i % 12];
      mesh.mids.ofEdge.set(keyOf(mesh.hexes[base + k], mesh.hexes[base + l]), mid - 1);
    });
  }
  const mid = mesh.mids.ofEdge.get(keyOf(a, b));
  return mid === undefined ? null : Array.from(mesh.mids.positions.subarray(3 * mid, 3 * mid + 3));
}

/// Place in the lists of marked faces, or -1.
export function markedIndex(mesh, hex, face) {
  const bits = mesh.marked[hex];
  if (!(bits >> face & 1)) return -1;
  let before = 0;
  for (let lf = 0; lf < face; ++lf) before += bits >> lf & 1;
  return mesh.firstMarked[hex] + before;
}

/// Patch of a face, or -1.
export function patchOf(mesh, hex, face) {
  const index = mesh.patches ? markedIndex(mesh, hex, face) : -1;
  return index < 0 ? -1 : mesh.patches[index] - 1;
}
export const regionOf = (mesh, hex) => mesh.regions ? mesh.regions[hex] : 0;
export const hexId = (mesh, hex) => mesh.hexIds ? mesh.hexIds[hex] : hex;
export const vertId = (mesh, vert) => mesh.vertIds ? mesh.vertIds[vert] : vert;
/// The hex with this number in the mesh, or -1 when the page has it not.
export function findHex(mesh, id) {
  if (!mesh.hexIds) return id < mesh.numHexes ? id : -1;
  let low = 0, high = mesh.hexIds.length;
  while (low < high) {
    const middle = low + high >> 1;
    if (mesh.hexIds[middle] < id) low = middle + 1; else high = middle;
  }
  return mesh.hexIds[low] === id ? low : -1;
}
