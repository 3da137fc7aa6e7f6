// The keyboard: all that the panel's buttons do, and turning and moving.
import {element, make} from './dom.js';

/// Key, what it does as text, and what it does. Keys for the camera work when the drawing has the focus.
const KEYS = [
  ['0', 'look from aslant', app => app.orbit.look('iso')],
  ['1 2 3', 'look along x, along y, from above (with Alt: the other way)', null],
  ['x y z', 'cut across an axis', null],
  ['v', 'cut across the direction of sight', app => app.setCut('view')],
  ['o', 'no cut', app => app.setCut('off')],
  ['f', 'the other side of the cut', app => app.change('hexes', {flip: !app.state.flip})],
  [', .', 'move the cut', null],
  ['p P', 'peel a layer, put one back', null],
  ['[ ]', 'lower, raise the upper limit of quality', null],
  ['w W', 'fly to the worst hex, the next, the one before', null],
  ['c', 'colour by the next', app => {
    const at = app.colorings.indexOf(app.coloring());
    app.change('colors', {color: app.colorings[(at + 1) % app.colorings.length].key});
  }],
  ['h', 'hexes: without them, lines inside are seen', app => app.change('frame', {faces: !app.state.faces})],
  ['e', 'edges of quads', app => app.change('frame', {edges: !app.state.edges})],
  ['i', 'irregular edges', app => app.change('lines', {irregular: !app.state.irregular})],
  ['a', 'input surface', app => app.change('frame', {surface: !app.state.surface})],
  ['s', 'save the view as a picture', app => app.picture()],
  ['l', 'a link that restores the view', () => element('link').click()],
  ['r', 'all as at the start', app => app.reset()],
  ['t', 'light or dark', () => element('theme').click()],
  ['?', 'these keys', () => element('help').click()],
];
const DRAWING_KEYS = [['arrows', 'turn; with Shift: move'], ['+ \u2212', 'zoom']];

const MORE = {
  x: app => app.setCut('x'), y: app => app.setCut('y'), z: app => app.setCut('z'),
  ',': app => app.stepOffset(-1), '.': app => app.stepOffset(1),
  p: app => app.change('hexes', {peel: Math.min(app.mesh.deepest, app.state.peel + 1)}), P: app => app.change('hexes', {peel: Math.max(0, app.state.peel - 1)}),
  '[': app => app.setHigh(app.state.high - 1), ']': app => app.setHigh(app.state.high + 1),
  w: app => app.flyToWorst(1), W: app => app.flyToWorst(-1),
};
const LOOKS = {1: ['+x', '-x'], 2: ['+y', '-y'], 3: ['-z', '+z']};

function onDrawing(app, event) {
  const direction = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
  if (direction && event.shiftKey) app.orbit.move(direction[0] * 0.04, direction[1] * 0.04);
  else if (direction) app.orbit.turn(direction[0] * 6, direction[1] * 6);
  else if (event.key === '+' || event.key === '=') app.orbit.zoom(0.87);
  else if (event.key === '-') app.orbit.zoom(1 / 0.87);
  else return false;
  return true;
}

export function bindKeys(app) {
  const list = document.querySelector('#keys dl');
  for (const [key, text] of [...DRAWING_KEYS, ...KEYS]) {
    list.append(make('dt', {textContent: key}), make('dd', {textContent: text}));
  }
  const actions = {...MORE};
  for (const [key, , action] of KEYS) if (action) actions[key] = action;
  addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || document.querySelector('dialog[open]')) return;
    const {target} = event;
    if (target.matches?.('input[type=search], textarea, select')) return;
    if (target === app.canvas && onDrawing(app, event)) return event.preventDefault();
    const digit = LOOKS[event.code?.replace('Digit', '')];
    if (digit && event.code.startsWith('Digit')) return app.orbit.look(digit[event.altKey ? 1 : 0]);
    if (event.altKey) return;
    actions[event.key]?.(app);
  });
}
