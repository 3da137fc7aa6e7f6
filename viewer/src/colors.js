// Colours as [r, g, b] in 0 .. 255.

// From red through yellow to blue, as in the program's pictures; see src/render/color.cpp.
const QUALITY = [[165, 0, 38], [215, 48, 39], [244, 109, 67], [253, 174, 97], [254, 224, 144], [224, 243, 248], [171, 217, 233], [126, 180, 219], [92, 145, 204], [62, 104, 186]];
// From dark blue through green to yellow: rising, in print too.
const RISING = [[68, 70, 135], [52, 104, 142], [36, 135, 142], [39, 165, 132], [94, 196, 100], [165, 215, 62], [240, 226, 60]];
// Neighbours in the list differ much; after the last the hues come again, lighter.
const CATEGORIES = [[86, 133, 186], [232, 150, 62], [102, 166, 92], [214, 99, 96], [150, 117, 180], [158, 124, 96], [222, 136, 186], [130, 138, 146], [190, 184, 70], [82, 181, 190],
  [62, 96, 150], [190, 106, 40], [60, 120, 66], [160, 60, 70], [104, 78, 140]];

export const INVERTED = [255, 0, 200];
export const NEUTRAL = [198, 204, 211];
export const PALE = [243, 241, 236];
export const HIGHLIGHT = [255, 150, 20];

export const mix = (a, b, share) => [0, 1, 2].map(k => a[k] + (b[k] - a[k]) * share);
export const css = color => `rgb(${color.map(Math.round).join(' ')})`;

function sample(scale, value) {
  const at = Math.min(1, Math.max(0, value)) * (scale.length - 1), i = Math.min(scale.length - 2, Math.floor(at));
  return mix(scale[i], scale[i + 1], at - i);
}
export const qualityColor = value => sample(QUALITY, value);
export const risingColor = value => sample(RISING, value);
export function categoryColor(i) {
  const round = Math.floor(i / CATEGORIES.length);
  return mix(CATEGORIES[i % CATEGORIES.length], [255, 255, 255], round % 3 * 0.28);
}
export const isDark = () => document.documentElement.dataset.theme === 'dark';
/// Dark on a light page, light on a dark one. -1 = of no name.
export function curveColor(curve) {
  if (curve < 0) return isDark() ? [200, 206, 214] : [30, 34, 42];
  return isDark() ? mix(categoryColor(curve), [255, 255, 255], 0.25) : categoryColor(curve).map(x => x * 0.6);
}
/// Of an edge with so many hexes about it, inside or on the boundary.
export const valenceColor = valence => valence <= 2 ? [140, 40, 160] : valence === 3 ? [215, 48, 39] : valence === 5 ? [36, 140, 70] : [30, 90, 200];
