// What faces are coloured by: each choice gives a colour per face and a legend.
import {categoryColor, HIGHLIGHT, INVERTED, mix, NEUTRAL, PALE, qualityColor, risingColor} from './colors.js';
import {markedIndex, patchOf, regionOf} from './data.js';

/// {key, label, ofHex or ofFace, legend} of all that the mesh has data for.
export function makeColorings(mesh) {
  const {summary} = mesh, list = [];
  const quality = Array.from({length: 251}, (_, code) => code === 0 ? INVERTED : qualityColor((code - 0.5) / 250));
  list.push({key: 'quality', label: 'scaled Jacobian', ofHex: h => quality[mesh.quality[h]], legend: {color: qualityColor, low: '0', high: '1'}});
  if (summary.patches.length) list.push({key: 'patch', label: 'patch', ofFace: (h, lf) => { const p = patchOf(mesh, h, lf); return p < 0 ? NEUTRAL : categoryColor(p); }});
  if (summary.regions.length > 1) list.push({key: 'region', label: 'region', ofHex: h => categoryColor(regionOf(mesh, h))});
  list.push({key: 'layer', label: 'layer from the boundary', ofHex: h => risingColor(1 - Math.min(1, mesh.depth[h] / Math.max(1, mesh.deepest))), legend: {color: x => risingColor(1 - x), low: '0', high: String(mesh.deepest)}});
  if (mesh.distance) {
    const most = summary.distance.max;
    list.push({key: 'distance', label: 'distance to the surface', ofFace: (h, lf) => { const i = markedIndex(mesh, h, lf); return i < 0 ? NEUTRAL : risingColor(mesh.distance[i] / 255); },
      legend: {color: risingColor, low: '0', high: `${most.toPrecision(3)} (${(100 * most / summary.distance.diagonal).toPrecision(2)}% of the diagonal)`}});
  }
  summary.fields.forEach((field, i) => list.push(fieldColoring(field, mesh.fields[i], i)));
  list.push({key: 'plain', label: 'one colour', ofHex: () => NEUTRAL});
  return list;
}

function fieldColoring({name, low, high, whole}, values, i) {
  const colors = Array.from({length: 256}, (_, byte) => risingColor(high > low ? byte / 255 : 0.5));
  const coloring = {key: `field_${i}`, label: name, ofHex: h => colors[values[h]]};
  if (whole && high - low < 12) coloring.legend = {steps: Array.from({length: high - low + 1}, (_, k) => [String(low + k), risingColor(high > low ? k / (high - low) : 0.5)])};
  else coloring.legend = {color: risingColor, low: String(+low.toPrecision(4)), high: String(+high.toPrecision(4))};
  return coloring;
}

/// Four bytes of colour per face. Under a cut or a filter the outside is pale, so that the inside stands out.
export function colorFaces(mesh, faces, coloring, state) {
  const colors = new Uint8Array(4 * faces.length), isOpen = state.cut || state.peel || state.low > 0 || state.high < 50;
  const isPale = state.pale && isOpen && coloring.ofHex && coloring.key !== 'plain';
  for (let i = 0; i < faces.length; ++i) {
    const h = faces[i] >>> 3, lf = faces[i] & 7;
    let color = coloring.ofHex ? coloring.ofHex(h) : coloring.ofFace(h, lf);
    if (isPale && mesh.neighbors[6 * h + lf] < 0 && mesh.marked[h] >> lf & 1) color = mix(color, PALE, 0.85);
    if (state.chosenPatch >= 0 && patchOf(mesh, h, lf) === state.chosenPatch) color = mix(color, HIGHLIGHT, 0.7);
    colors[4 * i] = color[0]; colors[4 * i + 1] = color[1]; colors[4 * i + 2] = color[2]; colors[4 * i + 3] = 255;
  }
  return colors;
}
