// A camera that turns about a point, z up, and what moves it: pointer, wheel, keys.
import {PerspectiveCamera, Vector3} from 'three';

const FIELD = 28;  // degrees
const LOOKS = {iso: [-115, 24], '+x': [180, 0], '-x': [0, 0], '+y': [-90, 0], '-y': [90, 0], '+z': [-90, -90], '-z': [-90, 90]};  // azimuth, elevation of the eye

export class Orbit {
  /// `half` is half the extent of what is looked at, about the origin.
  constructor(half, onChange) {
    this.half = half;
    this.camera = new PerspectiveCamera(FIELD, 1, 0.01, 10);
    this.camera.up.set(0, 0, 1);
    this.onChange = onChange;
    this.look('iso');
  }

  /// From a fixed direction, all of the mesh in sight.
  look(name) {
    [this.azimuth, this.elevation] = LOOKS[name];
    this.target = new Vector3();
    this.fit();
  }

  /// So far away that all corners of the box are in sight, with a margin.
  fit() {
    this.distance = 1;
    this.update();
    const {camera} = this, slope = 0.93 * Math.tan(FIELD / 2 * Math.PI / 180), corner = new Vector3();
    let distance = 0.1;
    for (let i = 0; i < 8; ++i) {
      corner.set(...this.half.map((x, k) => i >> k & 1 ? x : -x)).applyMatrix4(camera.matrixWorldInverse);
      const depth = corner.z + this.distance;
      distance = Math.max(distance, depth + Math.abs(corner.x) / slope / camera.aspect, depth + Math.abs(corner.y) / slope);
    }
    this.distance = distance;
    this.update();
  }

  /// From the target to the eye.
  direction() {
    const a = this.azimuth * Math.PI / 180, e = this.elevation * Math.PI / 180;
    return new Vector3(Math.cos(a) * Math.cos(e), Math.sin(a) * Math.cos(e), Math.sin(e));
  }

  update() {
    const {camera} = this, out = this.direction();
    // Straight from above or below, the azimuth says which way is up.
    const a = this.azimuth * Math.PI / 180;
    if (Math.abs(this.elevation) > 89.9) camera.up.set(-Math.cos(a), -Math.sin(a), 0).multiplyScalar(Math.sign(this.elevation)); else camera.up.set(0, 0, 1);
    camera.position.copy(this.target).addScaledVector(out, this.distance);
    camera.lookAt(this.target);
    const reach = this.target.length() + 0.75;
    camera.near = Math.max(this.distance - reach, this.distance * 0.02);
    camera.far = this.distance + reach;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    this.onChange();
  }

  resize(aspect) { this.camera.aspect = aspect; this.update(); }

  turn(dx, dy) {
    this.azimuth -= dx;
    this.elevation = Math.max(-90, Math.min(90, this.elevation + dy));
    this.update();
  }

  /// By shares of the view's height.
  move(dx, dy) {
    const height = 2 * this.distance * Math.tan(FIELD / 2 * Math.PI / 180), e = this.camera.matrixWorld.elements;
    this.target.addScaledVector(new Vector3(e[0], e[1], e[2]), -dx * height).addScaledVector(new Vector3(e[4], e[5], e[6]), dy * height);
    this.update();
  }

  /// Towards a place in the view: x and y from -1 to 1.
  zoom(factor, x = 0, y = 0) {
    const before = this.distance;
    this.distance = Math.max(0.002, Math.min(20, this.distance * factor));
    const half = (before - this.distance) * Math.tan(FIELD / 2 * Math.PI / 180), e = this.camera.matrixWorld.elements;
    this.target.addScaledVector(new Vector3(e[0], e[1], e[2]), x * half * this.camera.aspect).addScaledVector(new Vector3(e[4], e[5], e[6]), y * half);
    this.update();
  }

  /// Glides to a place and distance; at once where people asked for less motion.
  fly(target, distance) {
    const from = this.target.clone(), to = new Vector3(...target), near = this.distance, start = performance.now();
    const duration = matchMedia('(prefers-reduced-motion: reduce)').matches ? 0 : 350;
    const step = now => {
      const t = duration ? Math.min(1, (now - start) / duration) : 1, s = t * t * (3 - 2 * t);
      this.target.lerpVectors(from, to, s);
      this.distance = near * (distance / near) ** s;
      this.update();
      if (t < 1) requestAnimationFrame(step);
    };
    step(start);
  }

  /// Where a point is seen: pixels from the view's top left.
  project(point, width, height) {
    const p = new Vector3(...point).project(this.camera);
    return [(p.x + 1) / 2 * width, (1 - p.y) / 2 * height];
  }

  /// Numbers that restore it to the pixel, and back.
  save() { return [this.azimuth, this.elevation, this.distance, ...this.target.toArray()]; }
  restore([azimuth, elevation, distance, ...target]) {
    Object.assign(this, {azimuth, elevation, distance});
    this.target.set(...target);
    this.update();
  }
}

/// Left drag turns, right or Shift drag moves, the wheel zooms; a press without a move is a click.
export function steer(canvas, orbit, onClick) {
  let last = null, moved = 0;
  canvas.addEventListener('contextmenu', event => event.preventDefault());
  canvas.addEventListener('pointerdown', event => {
    canvas.setPointerCapture(event.pointerId);
    last = [event.clientX, event.clientY];
    moved = 0;
  });
  canvas.addEventListener('pointermove', event => {
    if (!last) return;
    const dx = event.clientX - last[0], dy = event.clientY - last[1];
    last = [event.clientX, event.clientY];
    moved += Math.abs(dx) + Math.abs(dy);
    if (moved < 4) return;
    if (event.buttons & 2 || event.shiftKey) orbit.move(dx / canvas.clientHeight, dy / canvas.clientHeight); else orbit.turn(dx * 0.4, dy * 0.4);
  });
  canvas.addEventListener('pointerup', event => {
    if (last && moved < 4 && event.button === 0) onClick(event);
    last = null;
  });
  canvas.addEventListener('pointercancel', () => { last = null; });
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    const box = canvas.getBoundingClientRect();
    orbit.zoom(Math.exp(Math.max(-60, Math.min(60, event.deltaY)) * 0.004), 2 * (event.clientX - box.left) / box.width - 1, 1 - 2 * (event.clientY - box.top) / box.height);
  }, {passive: false});
}
