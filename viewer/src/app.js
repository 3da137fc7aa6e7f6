// The view's state and what follows from it: which hexes, which faces, their colours, lines, the panel.
import {Orbit, steer} from './camera.js';
import {colorFaces, makeColorings} from './coloring.js';
import {findHex, patchOf} from './data.js';
import {element} from './dom.js';
import {Drawing} from './draw.js';
import {bindKeys} from './keys.js';
import {curveLines, groupOf, hexOutline, irregularLines, planeOutline} from './lines.js';
import {Panel} from './panel.js';
import {pickFace} from './pick.js';
import {savePicture} from './picture.js';
import {AXES, fromHash, initialState, placeOfCut, toHash} from './state.js';
import {collectFaces, cutPlane, findIrregularEdges, findKeptVerts, selectHexes, statePlane} from './topology.js';

export class App {
  constructor(mesh) {
    this.mesh = mesh;
    this.canvas = element('view');
    this.colorings = makeColorings(mesh);
    this.state = initialState(mesh);
    this.pending = new Set();
    this.drawing = new Drawing(this.canvas, mesh);
    this.orbit = new Orbit(mesh.frame.extent.map(x => x / mesh.frame.diagonal / 2), () => this.refresh('frame'));
    this.valences = new Set();
    this.panel = new Panel(this);
  }

  start() {
    steer(this.canvas, this.orbit, event => this.click(event));
    this.steerHandle();
    bindKeys(this);
    addEventListener('hashchange', () => this.restore());
    this.restore();
    new ResizeObserver(() => this.resize()).observe(element('stage'));
  }

  /// Drawn at once: a canvas is blank after its size has changed.
  resize() {
    const {clientWidth, clientHeight} = element('stage');
    if (!clientWidth || !clientHeight) return;
    const isFitted = !this.selection;
    this.drawing.resize(clientWidth, clientHeight);
    this.orbit.resize(clientWidth / clientHeight);
    if (isFitted && !location.hash) this.orbit.fit();
    this.work();
  }

  /// Asks for work before the next frame: 'hexes' = what is kept, 'faces' = their patches, 'colors', 'lines', 'panel', 'frame' = draw.
  refresh(...what) {
    if (this.pending.size === 0) requestAnimationFrame(() => this.work());
    for (const part of what) this.pending.add(part);
  }

  work() {
    const todo = new Set(this.pending), {mesh, state, drawing} = this;
    this.pending.clear();
    if (!this.selection) todo.add('hexes');
    if (todo.has('hexes')) this.selection = selectHexes(mesh, state);
    if (todo.has('hexes') || todo.has('faces')) this.faces = collectFaces(mesh, this.selection.kept, state);
    if (todo.has('hexes') || todo.has('faces') || todo.has('colors')) drawing.setFaces(this.faces, colorFaces(mesh, this.faces, this.coloring(), state));
    if (todo.has('lines') || todo.has('hexes')) this.drawLines();
    drawing.faces.mesh.visible = state.faces && this.faces.length > 0;
    drawing.faceUniforms.edges.value = state.edges ? 1 : 0;
    drawing.curves.mesh.visible = state.curves && Boolean(mesh.curves);
    drawing.corners.visible = state.corners && drawing.cornerCount > 0;
    if (drawing.surface) {
      drawing.surface.visible = state.surface;
      drawing.surface.material.uniforms.opacity.value = state.opacity;
    }
    drawing.render(this.orbit.camera);
    this.panel.followCamera();
    if (todo.size > 1 || !todo.has('frame')) this.panel.follow();  // more than the camera has moved
  }

  coloring() { return this.colorings.find(c => c.key === this.state.color) ?? this.colorings[0]; }

  drawLines() {
    const {mesh, state, drawing} = this, none = [new Float32Array(), new Uint8Array()];
    const set = (lines, made) => drawing.setLines(lines, ...(made ? [made.segments, made.colors] : none));
    const keptVerts = findKeptVerts(mesh, this.selection);
    set(drawing.curves, curveLines(mesh, keptVerts, state));
    drawing.setCorners(mesh, keptVerts);
    set(drawing.plane, state.cut && planeOutline(mesh.frame, statePlane(mesh, state)));
    set(drawing.chosen, state.chosen && hexOutline(mesh, state.chosen.hex));
    set(drawing.irregular, state.irregular && irregularLines(mesh, this.irregularEdges(), this.valences));
  }

  /// Found when first asked for: it takes a second per million hexes. Those of the boundary are left out until chosen, for creases have them by right.
  irregularEdges() {
    if (!this.irregular) {
      this.irregular = findIrregularEdges(this.mesh);
      this.irregular.groups = new Map();
      this.irregular.valence.forEach((valence, i) => {
        const group = groupOf(valence, this.irregular.onBoundary[i]);
        this.irregular.groups.set(group, (this.irregular.groups.get(group) ?? 0) + 1);
        if (!this.irregular.onBoundary[i]) this.valences.add(group);
      });
    }
    return this.irregular;
  }

  change(part, values) {
    Object.assign(this.state, values);
    this.refresh(part, 'panel');
  }

  /// What lies towards the eye goes.
  setCut(kind) {
    if (kind === 'off') return this.change('hexes', {cut: null});
    const eye = this.orbit.direction().toArray(), normal = kind === 'view' ? eye : AXES[kind];
    return this.change('hexes', {cut: {kind, normal}, offset: placeOfCut(this.mesh, kind, this.state.offset), flip: normal.reduce((sum, x, k) => sum + x * eye[k], 0) < -1e-9});
  }

  setOffset(offset) { this.change('hexes', {offset: placeOfCut(this.mesh, this.state.cut?.kind, offset)}); }
  stepOffset(steps) {
    const {sample} = this.mesh.summary;
    if (!sample || this.state.cut?.kind === 'view') return this.setOffset(this.state.offset + 0.02 * steps);
    const at = sample.slices.indexOf(this.state.offset) + Math.sign(steps);
    return this.setOffset(sample.slices[Math.min(sample.slices.length - 1, Math.max(0, at))]);
  }

  /// Limits of the filter, in steps of 1/50; each takes the other along, for between them is a step. Below 0 are the inverted hexes alone.
  setLow(low) { this.change('hexes', {low, high: Math.max(low + 1, this.state.high)}); }
  setHigh(limit) {
    const high = Math.min(50, Math.max(0, limit));
    this.change('hexes', {high, low: Math.min(Math.max(0, high - 1), this.state.low)});
  }

  click(event) {
    const box = this.canvas.getBoundingClientRect(), {camera} = this.orbit;
    const x = 2 * (event.clientX - box.left) / box.width - 1, y = 1 - 2 * (event.clientY - box.top) / box.height;
    const origin = camera.position.toArray(), far = camera.position.clone().set(x, y, 0.5).unproject(camera).sub(camera.position).normalize();
    const picked = pickFace(this.mesh, this.faces, origin, far.toArray());
    this.choose(picked ? {hex: picked.code >>> 3, face: picked.code & 7} : null);
  }

  choose(chosen) {
    this.change('lines', {chosen, worst: -1, chosenPatch: chosen ? patchOf(this.mesh, chosen.hex, chosen.face) : -1});
    this.refresh('colors');
  }

  choosePatch(patch) {
    this.change('lines', {chosen: null, worst: -1, chosenPatch: this.state.chosenPatch === patch ? -1 : patch});
    this.refresh('colors');
  }

  chooseCurve(curve) { this.change('lines', {chosenCurve: this.state.chosenCurve === curve ? -1 : curve, curves: true}); }

  /// Bins of the histogram, in any order: 0 is inverted, i from (i - 1)/50 to i/50.
  setRange(bin, other) {
    const first = Math.min(bin, other), last = Math.max(bin, other);
    this.change('hexes', {low: Math.max(0, first - 1), high: last});
  }

  /// Cuts open what hides the hex, towards the eye, and goes there.
  flyToWorst(step) {
    const {worst} = this.mesh.summary, {mesh, state, orbit} = this;
    const index = state.worst < 0 ? 0 : Math.min(worst.length - 1, Math.max(0, state.worst + step)), hex = findHex(mesh, worst[index].hex);
    const center = Array.from(mesh.centers.subarray(3 * hex, 3 * hex + 3)), normal = orbit.direction().toArray();
    const plane = cutPlane(mesh, normal, 0), along = center.reduce((sum, x, k) => sum + x * normal[k], 0);
    let size = 0;
    for (let k = 0; k < 8; ++k) for (let axis = 0; axis < 3; ++axis) size = Math.max(size, Math.abs(mesh.positions[3 * mesh.hexes[8 * hex + k] + axis] - center[axis]));
    this.change('hexes', {cut: {kind: 'view', normal}, offset: Math.min(1, (along - plane.low) / (plane.high - plane.low || 1) + 1e-4), flip: false, peel: 0, low: 0, high: 50, hiddenRegions: new Set(),
      worst: index, chosen: {hex, face: -1}, chosenPatch: -1});
    orbit.fly(center, Math.max(0.02, 24 * size));
  }

  reset() {
    this.state = initialState(this.mesh);
    if (location.hash) location.hash = '';  // not by history, which a page inside a notebook has not
    this.orbit.look('iso');
    this.refresh('hexes', 'lines');
  }

  link() {
    this.linked = `#${toHash(this.state, this.orbit, initialState(this.mesh))}`;
    location.hash = this.linked;
    return location.href;
  }

  restore() {
    if (this.linked && location.hash === this.linked) { this.linked = null; return; }
    const {state, eye} = fromHash(location.hash.slice(1), this.mesh, this.colorings.map(c => c.key));
    this.state = state;
    if (eye) this.orbit.restore(eye); else this.orbit.look('iso');
    this.refresh('hexes', 'lines');
  }

  picture() { savePicture(this); }

  /// The point of the plane at the middle of the mesh, and how far it moves on the screen when its place moves by the mesh's extent.
  handlePlace() {
    const {mesh, state, orbit, canvas} = this, plane = statePlane(mesh, state);
    const [w, h] = [canvas.clientWidth, canvas.clientHeight], point = plane.normal.map(x => x * plane.at), size = plane.high - plane.low || 1;
    const [x, y] = orbit.project(point, w, h), [u, v] = orbit.project(point.map((c, k) => c + plane.normal[k] * 0.01), w, h);
    return {x, y, along: [(u - x) / 0.01 * size, (v - y) / 0.01 * size]};
  }

  steerHandle() {
    const handle = element('handle');
    let from = null;
    handle.addEventListener('pointerdown', event => {
      handle.setPointerCapture(event.pointerId);
      from = {x: event.clientX, y: event.clientY, offset: this.state.offset, along: this.handlePlace().along};
    });
    handle.addEventListener('pointermove', event => {
      if (!from) return;
      const [u, v] = from.along, length = Math.hypot(u, v), dx = event.clientX - from.x, dy = event.clientY - from.y;
      // A plane seen face on does not move on the screen: up and down stand for it then.
      this.setOffset(from.offset + (length > 60 ? (dx * u + dy * v) / (length * length) : -dy / 400));
    });
    for (const end of ['pointerup', 'pointercancel']) handle.addEventListener(end, () => { from = null; });
    handle.addEventListener('keydown', event => {
      const step = {ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1}[event.key];
      if (!step) return;
      event.preventDefault();
      this.stepOffset(step);
    });
  }
}
