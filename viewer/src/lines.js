// Lines of a view: curves, irregular edges, the outline of a hex, the cutting plane in the box. Each gives {segments, colors}.
import {curveColor, HIGHLIGHT, isDark, valenceColor} from './colors.js';
import {midNode} from './data.js';
import {EDGES} from './topology.js';

/// `pointsOf` gives two points or more of line i.
function makeLines(count, pointsOf, colorOf) {
  const segments = [], colors = [];
  for (let i = 0; i < count; ++i) {
    const points = pointsOf(i), color = colorOf(i);
    for (let k = 1; k < points.length; ++k) {
      segments.push(...points[k - 1], ...points[k]);
      colors.push(color[0], color[1], color[2], color[3] ?? 255);
    }
  }
  return {segments: new Float32Array(segments), colors: new Uint8Array(colors)};
}

const pointOf = (mesh, v) => [mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]];

/// The ends of an edge, and points between them where it is curved.
function edgePoints(mesh, v, w) {
  const a = pointOf(mesh, v), b = pointOf(mesh, w), mid = midNode(mesh, v, w), points = [a];
  for (let i = 1; mid && i < CURVE_STEPS; ++i) {
    const t = i / CURVE_STEPS;
    points.push(a.map((x, k) => (1 - t) * (1 - 2 * t) * x + 4 * t * (1 - t) * mid[k] + t * (2 * t - 1) * b[k]));
  }
  return [...points, b];
}
const CURVE_STEPS = 8;

/// Faint where the hexes are gone.
export function curveLines(mesh, keptVerts, {hiddenCurves, chosenCurve}) {
  const {curves, curveIds} = mesh, shown = [];
  curveIds?.forEach((id, i) => { if (!hiddenCurves.has(id - 1)) shown.push(i); });
  const isKept = i => !keptVerts || (keptVerts[curves[2 * i]] && keptVerts[curves[2 * i + 1]]);
  return makeLines(shown.length, i => edgePoints(mesh, curves[2 * shown[i]], curves[2 * shown[i] + 1]), i => {
    const curve = curveIds[shown[i]] - 1, isChosen = curve === chosenCurve && curve >= 0;
    return [...(isChosen ? HIGHLIGHT : curveColor(curve)), isChosen || isKept(shown[i]) ? 255 : 70];
  });
}

/// `groups` are those shown, as `valence` and whether on the boundary: "3", "boundary 1".
export function irregularLines(mesh, edges, groups) {
  const shown = [];
  edges.valence.forEach((valence, i) => { if (groups.has(groupOf(valence, edges.onBoundary[i]))) shown.push(i); });
  return makeLines(shown.length, i => edgePoints(mesh, edges.verts[2 * shown[i]], edges.verts[2 * shown[i] + 1]), i => valenceColor(edges.valence[shown[i]]));
}
export const groupOf = (valence, onBoundary) => (onBoundary ? 'boundary ' : '') + valence;

export function hexOutline(mesh, hex) {
  return makeLines(12, i => edgePoints(mesh, mesh.hexes[8 * hex + EDGES[i][0]], mesh.hexes[8 * hex + EDGES[i][1]]), () => [225, 0, 170]);
}

/// Where the plane meets the box of the mesh.
export function planeOutline(frame, {normal, at}) {
  const half = frame.extent.map(x => x / frame.diagonal / 2), corner = i => half.map((x, k) => i >> k & 1 ? x : -x), points = [];
  for (let i = 0; i < 8; ++i)
    for (let k = 0; k < 3; ++k) {
      if (i >> k & 1) continue;
      const a = corner(i), b = corner(i | 1 << k), along = p => p[0] * normal[0] + p[1] * normal[1] + p[2] * normal[2] - at, s = along(a), t = along(b);
      if (s * t > 0 || s === t) continue;
      points.push(a.map((x, j) => x + (b[j] - x) * s / (s - t)));
    }
  if (points.length < 3) return makeLines(0);
  const middle = [0, 1, 2].map(k => points.reduce((sum, p) => sum + p[k], 0) / points.length);
  const u = points[0].map((x, k) => x - middle[k]), v = [normal[1] * u[2] - normal[2] * u[1], normal[2] * u[0] - normal[0] * u[2], normal[0] * u[1] - normal[1] * u[0]];
  const angle = p => Math.atan2(...[v, u].map(w => w.reduce((sum, x, k) => sum + x * (p[k] - middle[k]), 0)));
  points.sort((a, b) => angle(a) - angle(b));
  return makeLines(points.length, i => [points[i], points[(i + 1) % points.length]], () => isDark() ? [127, 176, 255] : [31, 95, 191]);
}
