// What can be chosen about a view, and its form as the end of an address.

export const AXES = {x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1]};
export const SWITCHES = ['faces', 'edges', 'pale', 'curves', 'corners', 'irregular', 'surface'];

export function initialState(mesh) {
  return {cut: null, offset: mesh.summary.sample ? mesh.summary.sample.slices[1] : 0.503, flip: false, peel: 0, low: 0, high: 50, color: 'quality', hiddenRegions: new Set(), hiddenPatches: new Set(), hiddenCurves: new Set(),
    faces: true, edges: true, pale: true, curves: true, corners: true, irregular: false, surface: false, opacity: 0.4, chosen: null, chosenPatch: -1, chosenCurve: -1, worst: -1};
}

/// Where a cut may stand. A part of a mesh has whole slices at a few places only: a cut across an axis stays at these.
export function placeOfCut(mesh, kind, offset) {
  const {sample} = mesh.summary, place = Math.min(1, Math.max(0, offset));
  return sample && kind !== 'view' ? sample.slices.reduce((best, s) => Math.abs(s - place) < Math.abs(best - place) ? s : best) : place;
}

/// Only what differs from the start is written.
export function toHash(state, orbit, start) {
  const parts = new URLSearchParams({eye: orbit.save().join()});
  if (state.cut) parts.set('cut', [state.cut.kind, ...state.cut.normal, state.offset, state.flip ? 1 : 0].join());
  if (state.peel) parts.set('peel', state.peel);
  if (state.low > 0 || state.high < 50) parts.set('quality', `${state.low},${state.high}`);
  if (state.color !== start.color) parts.set('color', state.color);
  if (state.hiddenRegions.size) parts.set('regions', [...state.hiddenRegions].join());
  if (state.hiddenPatches.size) parts.set('patches', [...state.hiddenPatches].join());
  if (state.hiddenCurves.size) parts.set('lines', [...state.hiddenCurves].join());
  for (const name of SWITCHES) if (state[name] !== start[name]) parts.set(name, state[name] ? 1 : 0);
  if (state.opacity !== start.opacity) parts.set('opacity', state.opacity);
  if (state.chosen) parts.set('hex', `${state.chosen.hex},${state.chosen.face}`);
  if (state.chosenPatch >= 0) parts.set('patch', state.chosenPatch);
  if (state.chosenCurve >= 0) parts.set('line', state.chosenCurve);
  if (state.worst >= 0) parts.set('worst', state.worst);
  return parts.toString().replaceAll('%2C', ',');
}

/// What does not fit the mesh is passed over: addresses come from anywhere.
export function fromHash(text, mesh, colors) {
  const parts = new URLSearchParams(text), state = initialState(mesh);
  const numbers = (name, count) => {
    const list = (parts.get(name) ?? '').split(',').filter(x => x !== '').map(Number);
    return list.every(Number.isFinite) && (count === undefined || list.length === count) ? list : null;
  };
  const whole = (value, low, high) => Number.isInteger(value) && value >= low && value <= high;
  const [kind, ...cut] = (parts.get('cut') ?? '').split(',');
  if ((Object.hasOwn(AXES, kind) || kind === 'view') && cut.length === 5 && cut.map(Number).every(Number.isFinite)) {
    const [x, y, z, offset, flip] = cut.map(Number), length = Math.hypot(x, y, z), scale = Math.abs(length - 1) < 1e-12 || length === 0 ? 1 : 1 / length;
    state.cut = {kind, normal: AXES[kind] ?? [x * scale, y * scale, z * scale]};
    Object.assign(state, {offset: placeOfCut(mesh, kind, offset), flip: flip === 1});
  }
  const peel = Number(parts.get('peel')), quality = numbers('quality', 2), hex = numbers('hex', 2);
  if (whole(peel, 0, mesh.deepest)) state.peel = peel;
  if (quality?.every(x => whole(x, 0, 50)) && quality[0] < Math.max(1, quality[1])) [state.low, state.high] = quality;
  if (colors.includes(parts.get('color'))) state.color = parts.get('color');
  state.hiddenRegions = new Set(numbers('regions') ?? []);
  state.hiddenPatches = new Set(numbers('patches') ?? []);
  state.hiddenCurves = new Set(numbers('lines') ?? []);
  for (const name of SWITCHES) if (parts.has(name)) state[name] = parts.get(name) === '1';
  if (parts.has('opacity')) state.opacity = Math.max(0.05, Math.min(1, Number(parts.get('opacity')) || 0.4));
  if (hex && whole(hex[0], 0, mesh.numHexes - 1) && whole(hex[1], -1, 5)) state.chosen = {hex: hex[0], face: hex[1]};
  if (parts.has('patch') && whole(Number(parts.get('patch')), 0, mesh.summary.patches.length - 1)) state.chosenPatch = Number(parts.get('patch'));
  if (parts.has('line') && whole(Number(parts.get('line')), 0, mesh.summary.curves.length - 1)) state.chosenCurve = Number(parts.get('line'));
  if (parts.has('worst') && whole(Number(parts.get('worst')), 0, mesh.summary.worst.length - 1)) state.worst = Number(parts.get('worst'));
  const eye = numbers('eye', 6);
  return {state, eye: eye?.[2] > 0 ? eye : null};
}
