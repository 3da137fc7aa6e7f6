// What is written about a hex or a patch.
import {hexId, markedIndex, patchOf, regionOf, vertId} from './data.js';
import {make} from './dom.js';
import {count, measure} from './text.js';

const terms = pairs => make('dl', {}, ...pairs.flatMap(([term, text]) => [make('dt', {textContent: term}), make('dd', {textContent: text})]));

export function describePatch(mesh, patch) {
  const {name, quads, area} = mesh.summary.patches[patch];
  return [make('h3', {textContent: name}), terms([['quads', count(quads)], ['area', measure(area)]])];
}

/// Quality to the width of its byte; hexes among the worst have it exactly, with exact corners.
export function describeHex(mesh, {chosen, worst}) {
  const {hex, face} = chosen, {summary} = mesh, id = hexId(mesh, hex), code = mesh.quality[hex];
  const exact = worst >= 0 ? summary.worst[worst] : summary.worst.find(w => w.hex === id);
  const pairs = [['scaled Jacobian', exact ? exact.scaled_jacobian.toPrecision(6) : code ? `${((code - 1) / 250).toFixed(3)} to ${(code / 250).toFixed(3)}` : 'inverted']];
  pairs.push(['depth', String(mesh.depth[hex])]);
  if (summary.regions.length > 1) pairs.push(['region', summary.regions[regionOf(mesh, hex)].name]);
  summary.fields.forEach(({name, low, high, whole}, i) => {
    const value = low + mesh.fields[i][hex] / 255 * (high - low);
    pairs.push([name, whole ? String(Math.round(value)) : measure(value)]);
  });
  const patch = face >= 0 ? patchOf(mesh, hex, face) : -1;
  if (patch >= 0) {
    const {name, quads, area} = summary.patches[patch];
    pairs.unshift(['patch', name], ['of it', `${count(quads)} quads, area ${measure(area)}`]);
  }
  const at = mesh.distance && face >= 0 ? markedIndex(mesh, hex, face) : -1;
  if (at >= 0) pairs.push(['distance', `about ${measure(mesh.distance[at] / 255 * summary.distance.max)}`]);
  return [make('h3', {textContent: `hex ${count(id)}`}), terms(pairs), cornerTable(mesh, hex, exact)];
}

function cornerTable(mesh, hex, exact) {
  const table = make('table');
  for (let k = 0; k < 8; ++k) {
    const vert = mesh.hexes[8 * hex + k], id = exact ? exact.verts[k] : vertId(mesh, vert);
    const point = exact ? exact.corners[k] : mesh.frame.toWorld(Array.from(mesh.positions.subarray(3 * vert, 3 * vert + 3)));
    table.append(make('tr', {}, make('td', {textContent: `vertex ${id}`}), ...point.map(x => make('td', {textContent: measure(x)}))));
  }
  return table;
}
