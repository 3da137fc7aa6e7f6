// The controls beside the drawing, and what is written over it.
import {categoryColor, css, INVERTED, qualityColor, valenceColor} from './colors.js';
import {element, make} from './dom.js';
import {describeHex, describePatch} from './info.js';
import {SWITCHES} from './state.js';
import {count, measure} from './text.js';
import {statePlane} from './topology.js';

function swatch(color) {
  const made = make('span', {className: 'swatch'});
  made.style.background = css(color);
  return made;
}

export class Panel {
  constructor(app) {
    this.app = app;
    this.bins = this.countBins();
    this.writeHead();
    this.bindButtons();
    this.bindSliders();
    this.bindHistogram();
    this.bindSwitches();
    this.listColorings();
    this.listRegions();
    this.listPatches();
    this.listCurves();
    this.writeVerdict();
  }

  writeHead() {
    const {summary} = this.app.mesh, {quality, verdict, sample} = summary;
    element('title').textContent = summary.title;
    element('figures').textContent = `${count(summary.hexes)} hexes, ${count(summary.verts)} vertices. Scaled Jacobian: least ${measure(quality.min)}, average ${measure(quality.avg)}.`;
    const inverted = quality.inverted ? `${count(quality.inverted)} inverted` : 'none inverted';
    const isGood = verdict ? verdict.valid : quality.inverted === 0;
    element('verdict').append(make('span', {className: isGood ? 'good' : 'bad', textContent: verdict ? (verdict.valid ? 'valid' : 'not valid') : inverted}));
    if (verdict) element('verdict').append(`, ${inverted}`);
    if (!sample) return;
    element('sample').hidden = false;
    element('sample').textContent = `Too large for a page as a whole: it shows ${count(summary.shown_hexes)} of ${count(summary.hexes)} hexes, namely the skin (${count(sample.skin)}), slices across each axis at ` +
      `${sample.slices.map(s => `${Math.round(100 * s)}%`).join(', ')} and the worst ${count(sample.worst)}. Cuts stay at the slices. Counts and the histogram are of what is shown.`;
  }

  writeVerdict() {
    const {verdict} = this.app.mesh.summary;
    element('judged').hidden = !verdict;
    if (!verdict) return;
    for (const text of [...verdict.failures, ...verdict.warnings]) element('failures').append(make('li', {textContent: text}));
    element('report').textContent = verdict.figures;
  }

  bindButtons() {
    const {app} = this;
    for (const button of document.querySelectorAll('[data-look]')) button.addEventListener('click', () => app.orbit.look(button.dataset.look));
    for (const button of document.querySelectorAll('[data-cut]')) button.addEventListener('click', () => app.setCut(button.dataset.cut));
    const actions = {flip: () => app.change('hexes', {flip: !app.state.flip}), picture: () => app.picture(), reset: () => app.reset(), worst: () => app.flyToWorst(0), next: () => app.flyToWorst(1),
      previous: () => app.flyToWorst(-1), link: () => this.showLink(), help: () => element('keys').showModal(), theme: () => this.switchTheme(),
      'all-patches': () => this.hidePatches(false), 'no-patches': () => this.hidePatches(true)};
    for (const [id, action] of Object.entries(actions)) element(id).addEventListener('click', action);
    element('link').hidden = location.protocol === 'about:';  // inside a notebook no address leads here
  }

  switchTheme() {
    const root = document.documentElement;
    root.dataset.theme = root.dataset.theme === 'dark' ? 'light' : 'dark';
    this.app.refresh('lines', 'panel');
  }

  showLink() {
    const address = this.app.link();
    document.querySelector('#share textarea').value = address;
    element('share').showModal();
    document.querySelector('#share textarea').select();
    navigator.clipboard?.writeText(address).catch(() => {});  // not all browsers let pages from files write there
  }

  bindSliders() {
    const {app} = this, number = id => Number(element(id).value);
    element('peel').max = app.mesh.deepest;
    element('offset').addEventListener('input', () => app.setOffset(number('offset')));
    element('peel').addEventListener('input', () => app.change('hexes', {peel: number('peel')}));
    element('low').addEventListener('input', () => app.setLow(number('low')));
    element('low').max = 49;
    element('high').addEventListener('input', () => app.setHigh(number('high')));
    element('opacity').addEventListener('input', () => app.change('frame', {opacity: number('opacity')}));
  }

  /// A drag over it keeps the hexes of these bins.
  bindHistogram() {
    const {app} = this, canvas = element('histogram');
    const binAt = event => {
      const box = canvas.getBoundingClientRect();
      return Math.min(50, Math.max(0, Math.floor((event.clientX - box.left) / box.width * 51)));
    };
    let first = null;
    canvas.addEventListener('pointerdown', event => {
      canvas.setPointerCapture(event.pointerId);
      first = binAt(event);
      app.setRange(first, first);
    });
    canvas.addEventListener('pointermove', event => { if (first !== null) app.setRange(first, binAt(event)); });
    for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, () => { first = null; });
    canvas.addEventListener('dblclick', () => app.setRange(0, 50));
  }

  bindSwitches() {
    const {app} = this, {summary, surface} = app.mesh, redo = {pale: 'colors', irregular: 'lines'};
    for (const id of SWITCHES)
      element(id).addEventListener('change', () => app.change(redo[id] ?? 'frame', {[id]: element(id).checked}));
    const {curves, corners} = summary, edges = curves.reduce((sum, c) => sum + c.edges, 0);
    element('curves-label').hidden = !edges;
    element('curves-label').querySelector('span').textContent = `${count(curves.length)}`;
    element('corners-label').hidden = !corners;
    element('corners-label').querySelector('span').textContent = count(corners);
    element('surface-label').hidden = !surface;
    element('color').addEventListener('change', () => app.change('colors', {color: element('color').value}));
  }

  listColorings() {
    for (const {key, label} of this.app.colorings) element('color').append(make('option', {value: key, textContent: label}));
  }

  listRegions() {
    const {app} = this, {regions} = app.mesh.summary;
    element('regions-section').hidden = regions.length < 2;
    regions.forEach((region, i) => element('regions').append(this.listEntry(region.name, categoryColor(i), `${count(region.hexes)} hexes, volume ${measure(region.volume)}`,
      isShown => { this.toggle(app.state.hiddenRegions, i, isShown); app.refresh('hexes'); }, () => app.change('colors', {color: 'region'}))));
  }

  listPatches() {
    const {app} = this, {patches} = app.mesh.summary;
    element('patches-section').hidden = patches.length === 0;
    patches.forEach((patch, i) => {
      if (patch.quads === 0) return;
      const entry = this.listEntry(patch.name, categoryColor(i), `${count(patch.quads)}, ${measure(patch.area)}`,
        isShown => { this.toggle(app.state.hiddenPatches, i, isShown); app.refresh('faces'); }, () => app.choosePatch(i));
      entry.dataset.patch = i;
      element('patches').append(entry);
    });
    element('find').addEventListener('input', () => {
      const text = element('find').value.toLowerCase();
      for (const entry of element('patches').children) entry.hidden = !patches[entry.dataset.patch].name.toLowerCase().includes(text);
    });
  }

  listCurves() {
    const {app} = this, {curves} = app.mesh.summary;
    element('curves-section').hidden = curves.every(curve => curve.edges === 0);
    curves.forEach(({name, edges, length}, i) => {
      if (edges === 0) return;
      const entry = this.listEntry(name, categoryColor(i), `${count(edges)}, ${measure(length)}`,
        isShown => { this.toggle(app.state.hiddenCurves, i, isShown); app.refresh('lines'); }, () => app.chooseCurve(i));
      entry.dataset.curve = i;
      element('curve-list').append(entry);
    });
  }

  listEntry(name, color, figures, onToggle, onName) {
    const box = make('input', {type: 'checkbox', checked: true, ariaLabel: `Show ${name}`}), button = make('button', {type: 'button', textContent: name, title: name});
    box.addEventListener('change', () => onToggle(box.checked));
    button.addEventListener('click', onName);
    return make('li', {}, box, swatch(color), button, make('small', {textContent: figures}));
  }

  toggle(hidden, i, isShown) { if (isShown) hidden.delete(i); else hidden.add(i); }

  /// Those that the filter by name leaves.
  hidePatches(isHidden) {
    for (const entry of element('patches').children) if (!entry.hidden) this.toggle(this.app.state.hiddenPatches, Number(entry.dataset.patch), !isHidden);
    this.app.refresh('faces');
  }

  countBins() {
    const bins = new Array(51).fill(0);  // inverted, then steps of 0.02
    for (const code of this.app.mesh.quality) ++bins[Math.ceil(code / 5)];
    return bins;
  }

  drawHistogram() {
    const canvas = element('histogram'), context = canvas.getContext('2d'), {width, height} = canvas, {low, high} = this.app.state, most = Math.max(...this.bins, 1);
    context.clearRect(0, 0, width, height);
    const ink = getComputedStyle(document.documentElement).getPropertyValue('--soft'), step = width / 51;
    this.bins.forEach((bin, i) => {
      const isKept = i === 0 ? low === 0 : i > low && i <= high, size = bin ? Math.max(3, bin / most * (height - 4)) : 0;
      context.globalAlpha = isKept ? 1 : 0.22;
      context.fillStyle = css(i === 0 ? INVERTED : qualityColor((i - 0.5) / 50));
      context.fillRect(i * step, height - 2 - size, step - 1.5, size);
    });
    context.globalAlpha = 1;
    context.fillStyle = ink;
    context.fillRect(0, height - 1, width, 1);
  }

  /// Everything that follows from the state.
  follow() {
    const {app} = this, {mesh, state, selection} = app, {summary} = mesh;
    element('status').textContent = `${count(selection.count)} of ${count(mesh.numHexes)} hexes${summary.sample ? ` (of ${count(summary.hexes)})` : ''}, ${count(app.faces.length)} faces`;
    Object.assign(element('status').dataset, {hexes: selection.count, faces: app.faces.length});
    for (const button of document.querySelectorAll('[data-cut]')) button.ariaPressed = String(button.dataset.cut === (state.cut?.kind ?? 'off'));
    element('flip').ariaPressed = String(state.flip);
    element('offset').value = state.offset;
    element('offset').disabled = element('flip').disabled = !state.cut;
    element('offset-value').textContent = this.describeOffset();
    element('peel').value = state.peel;
    element('peel-value').textContent = state.peel ? `${state.peel} of ${mesh.deepest}` : 'none';
    element('low').value = state.low;
    element('low-value').textContent = state.low ? (state.low / 50).toFixed(2) : 'inverted';
    element('high').value = state.high;
    element('high-value').textContent = state.high === 50 ? 'all' : state.high ? (state.high / 50).toFixed(2) : '0';
    element('color').value = app.coloring().key;
    for (const id of SWITCHES) element(id).checked = state[id];
    element('opacity-label').hidden = !state.surface || !mesh.surface;
    element('opacity').value = state.opacity;
    element('opacity-label').querySelector('output').textContent = `${Math.round(100 * state.opacity)}%`;
    [...element('regions').children].forEach((entry, i) => { entry.querySelector('input').checked = !state.hiddenRegions.has(i); });
    for (const entry of element('patches').children) {
      const patch = Number(entry.dataset.patch);
      entry.querySelector('input').checked = !state.hiddenPatches.has(patch);
      entry.classList.toggle('chosen', patch === state.chosenPatch);
    }
    for (const entry of element('curve-list').children) {
      const curve = Number(entry.dataset.curve);
      entry.querySelector('input').checked = !state.hiddenCurves.has(curve);
      entry.classList.toggle('chosen', curve === state.chosenCurve);
    }
    this.drawHistogram();
    this.followLegend();
    this.followValences();
    this.followChoice();
  }

  describeOffset() {
    const {state, mesh} = this.app;
    if (!state.cut) return '';
    const axis = 'xyz'.indexOf(state.cut.kind);
    if (axis < 0) return `${(100 * state.offset).toFixed(1)}%`;
    return measure(mesh.frame.center[axis] + statePlane(mesh, state).at * mesh.frame.diagonal);
  }

  followChoice() {
    const {state, mesh} = this.app, box = element('picked');
    box.hidden = !state.chosen && state.chosenPatch < 0;
    if (state.chosen) box.replaceChildren(...describeHex(mesh, state));
    else if (state.chosenPatch >= 0) box.replaceChildren(...describePatch(mesh, state.chosenPatch));
    element('worst-value').textContent = state.worst >= 0 ? `${state.worst + 1}: ${mesh.summary.worst[state.worst].scaled_jacobian.toFixed(4)}` : '';
  }

  followLegend() {
    const coloring = this.app.coloring(), box = element('legend'), {legend} = coloring;
    box.hidden = !legend;
    if (!legend) return;
    box.replaceChildren(make('h3', {textContent: coloring.label}));
    if (legend.steps) return box.append(...legend.steps.map(([text, color]) => make('div', {}, swatch(color), text)));
    const bar = make('canvas', {width: 200, height: 1}), context = bar.getContext('2d');
    for (let x = 0; x < 200; ++x) { context.fillStyle = css(legend.color((x + 0.5) / 200)); context.fillRect(x, 0, 1, 1); }
    box.append(bar, make('div', {className: 'ends'}, make('span', {textContent: legend.low}), make('span', {textContent: legend.high})));
    if (coloring.key === 'quality' && this.bins[0]) box.append(make('div', {}, swatch(INVERTED), 'inverted'));
    return undefined;
  }

  followValences() {
    const {app} = this, box = element('valences');
    box.hidden = !app.state.irregular;
    if (!app.state.irregular || !app.irregular || box.children.length) return;
    for (const [group, number] of [...app.irregular.groups].sort()) {
      const check = make('input', {type: 'checkbox', checked: app.valences.has(group)});
      check.addEventListener('change', () => { if (check.checked) app.valences.add(group); else app.valences.delete(group); app.refresh('lines'); });
      box.append(make('div', {}, make('label', {}, check, ' ', swatch(valenceColor(Number(group.replace('boundary ', '')))), ` ${group.replace('boundary ', 'boundary, ')} about it `),
        make('small', {textContent: count(number)})));
    }
    if (!box.children.length) box.append(make('small', {textContent: 'none: every edge is regular'}));
    if (app.mesh.summary.sample) box.append(make('small', {textContent: 'Of edges whose hexes are all on this page.'}));
  }

  /// What stands over the drawing and moves with the camera: axes, handle.
  followCamera() {
    const {app} = this, {camera} = app.orbit, e = camera.matrixWorldInverse.elements, triad = element('triad'), handle = element('handle');
    const space = 'http://www.w3.org/2000/svg', colors = ['#d6403a', '#2f9e44', '#2f6fd6'];
    const axes = [0, 1, 2].map(k => ({k, x: e[4 * k] * 32, y: -e[4 * k + 1] * 32, z: e[4 * k + 2]})).sort((a, b) => a.z - b.z);
    triad.replaceChildren(...axes.flatMap(({k, x, y}) => {
      const line = document.createElementNS(space, 'line'), text = document.createElementNS(space, 'text');
      for (const [name, value] of Object.entries({x1: 0, y1: 0, x2: x, y2: y, stroke: colors[k], 'stroke-width': 3})) line.setAttribute(name, value);
      for (const [name, value] of Object.entries({x: x * 1.32, y: y * 1.32, fill: colors[k]})) text.setAttribute(name, value);
      text.textContent = 'xyz'[k];
      return [line, text];
    }));
    handle.hidden = !app.state.cut || app.state.worst >= 0;
    if (handle.hidden) return;
    const {x, y} = app.handlePlace();
    handle.style.left = `${x}px`;
    handle.style.top = `${y}px`;
  }
}
