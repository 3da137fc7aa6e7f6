// Draws faces, lines, points and the input surface. The hex of a face, its vertices and their places come from textures, so that another choice of
// faces costs eight bytes each, and the edges of quads are drawn by the fragment, without diagonals.
import {BufferAttribute, BufferGeometry, DataTexture, DoubleSide, FloatType, GLSL3, InstancedBufferAttribute, InstancedBufferGeometry, IntType, Mesh, NearestFilter, Points,
  RawShaderMaterial, RGBAFormat, RGBAIntegerFormat, RGIntegerFormat, Scene, UnsignedIntType, Vector2, WebGLRenderer} from 'three';
import {GRID, GRID_INDEX, QUAD_INDEX} from './places.js';
import {FACE_EDGES, FACES} from './topology.js';

const WIDTH = 2048;  // of data textures

const LIGHT = `
vec3 lit(vec3 color, vec3 normal) {
  float key = max(0., dot(normal, normalize(vec3(-.45, .65, .65)))), fill = max(0., dot(normal, normalize(vec3(.7, .1, .7))));
  return color * min(1., .62 + .30 * key + .2 * fill);
}`;

const FACE_VERTEX = `precision highp float; precision highp int;
uniform highp usampler2D hexes; uniform highp sampler2D verts; uniform mat4 modelViewMatrix, projectionMatrix;
#ifdef CURVED
in vec3 position; in uint face; in vec4 color;
#else
uniform highp usampler2D faces; in uint corner;
#endif
out vec2 place; flat out vec3 shade;
#ifdef CURVED
out vec3 normal;
#else
flat out vec3 normal;
#endif
const uint corners[24] = uint[24](${FACES.flat().map(v => `${v}u`).join(',')});
ivec2 texel(uint i) { return ivec2(i % ${WIDTH}u, i / ${WIDTH}u); }
vec3 cornerAt(uvec4 low, uvec4 high, uint lf, uint k) {
  uint lv = corners[lf * 4u + k];
  return texelFetch(verts, texel(lv < 4u ? low[lv] : high[lv - 4u]), 0).xyz;
}
#ifdef CURVED
uniform highp usampler2D hexMids; uniform highp sampler2D mids;
const uint sides[24] = uint[24](${FACE_EDGES.flat().map(e => `${e}u`).join(',')});
vec3 side(uint hex, uint lf, uint k, vec3 a, vec3 b) {
  uint le = sides[lf * 4u + k], mid = texelFetch(hexMids, texel(3u * hex + le / 4u), 0)[le % 4u];
  return mid == 0u ? (a + b) * .5 : texelFetch(mids, texel(mid - 1u), 0).xyz;
}
vec3 weights(float t) { return vec3((1. - t) * (1. - 2. * t), 4. * t * (1. - t), t * (2. * t - 1.)); }
vec3 slopes(float t) { return vec3(4. * t - 3., 4. - 8. * t, 4. * t - 1.); }
#endif
void main() {
#ifndef CURVED
  uvec2 given = texelFetch(faces, texel(uint(gl_VertexID) / ${QUAD_INDEX.length}u), 0).xy;
  uint face = given.x;
  vec3 color = vec3(uvec3(given.y, given.y >> 8u, given.y >> 16u) & 255u) / 255.;
#endif
  uint hex = face >> 3u, lf = face & 7u;
  uvec4 low = texelFetch(hexes, texel(2u * hex), 0), high = texelFetch(hexes, texel(2u * hex + 1u), 0);
  vec3 a = cornerAt(low, high, lf, 0u), b = cornerAt(low, high, lf, 1u), c = cornerAt(low, high, lf, 2u), d = cornerAt(low, high, lf, 3u);
#ifdef CURVED
  vec3 ab = side(hex, lf, 0u, a, b), bc = side(hex, lf, 1u, b, c), cd = side(hex, lf, 2u, c, d), da = side(hex, lf, 3u, d, a);
  vec3 middle = (ab + bc + cd + da) * .5 - (a + b + c + d) * .25;
  place = position.xy;
  mat3 u = mat3(a, ab, b), v = mat3(da, middle, bc), w = mat3(d, cd, c);
  vec3 along = weights(place.x), up = weights(place.y), dAlong = slopes(place.x), dUp = slopes(place.y);
  vec3 p = mat3(u * along, v * along, w * along) * up;
  vec3 n = cross(mat3(u * dAlong, v * dAlong, w * dAlong) * up, mat3(u * along, v * along, w * along) * dUp);
#else
  int k = int(corner);
  vec3 p = k == 0 ? a : k == 1 ? b : k == 2 ? c : k == 3 ? d : (a + b + c + d) * .25;
  place = k == 4 ? vec2(.5) : vec2(k == 1 || k == 2 ? 1. : 0., k >= 2 ? 1. : 0.);
  vec3 n = cross(c - a, d - b);
#endif
  normal = mat3(modelViewMatrix) * (n / max(length(n), 1e-30));
  shade = color.rgb;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(p, 1.);
}`;
const FACE_FRAGMENT = `precision highp float;
uniform float edges; in vec2 place; flat in vec3 shade; out vec4 pixel;
#ifdef CURVED
in vec3 normal;
#else
flat in vec3 normal;
#endif
${LIGHT}
void main() {
  vec3 color = lit(shade, gl_FrontFacing ? normal : -normal);
  vec2 width = fwidth(place), near = min(place, 1. - place) / max(width, 1e-6);
  float line = 1. - smoothstep(.35, 1.1, min(near.x, near.y));
  // Lines fade where quads become so small that lines would cover them.
  float size = 1. / max(max(width.x, width.y), 1e-6);
  line *= edges * clamp((size - 2.) / 9., 0., 1.);
  pixel = vec4(mix(color, vec3(.1, .11, .14), line * .72), 1.);
}`;

const LINE_VERTEX = `precision highp float;
uniform mat4 modelViewMatrix, projectionMatrix; uniform vec2 resolution; uniform float width, lift;
in vec3 position; in vec3 begin; in vec3 end; in vec4 color; flat out vec4 shade;
void main() {
  vec4 a = projectionMatrix * modelViewMatrix * vec4(begin, 1.), b = projectionMatrix * modelViewMatrix * vec4(end, 1.);
  vec2 along = (b.xy / b.w - a.xy / a.w) * resolution;
  float length_ = max(length(along), 1e-6);
  along /= length_;
  vec4 p = position.x < .5 ? a : b;
  // A little longer than the segment, so that joints have no gaps.
  vec2 offset = vec2(-along.y, along.x) * position.y + along * (position.x < .5 ? -.35 : .35);
  p.xy += offset * width / resolution * p.w;
  p.z -= lift * p.w;
  shade = color;
  gl_Position = p;
}`;
const POINT_VERTEX = `precision highp float;
uniform mat4 modelViewMatrix, projectionMatrix; uniform float size, lift; in vec3 position;
void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.); gl_Position.z -= lift * gl_Position.w; gl_PointSize = size; }`;
const SURFACE_VERTEX = `precision highp float;
uniform mat4 modelViewMatrix, projectionMatrix; in vec3 position; out vec3 seen;
void main() { vec4 p = modelViewMatrix * vec4(position, 1.); seen = p.xyz; gl_Position = projectionMatrix * p; }`;

const shader = (vertexShader, fragmentShader, uniforms = {}, more = {}) => new RawShaderMaterial({glslVersion: GLSL3, vertexShader, fragmentShader, uniforms, side: DoubleSide, ...more});

/// `size` numbers per texel.
function dataTexture(numbers, size, format, internalFormat) {
  const height = Math.max(1, Math.ceil(numbers.length / size / WIDTH)), data = new numbers.constructor(size * WIDTH * height);
  data.set(numbers);
  const texture = new DataTexture(data, WIDTH, height, format, internalFormat === 'RGBA32F' ? FloatType : UnsignedIntType);
  texture.internalFormat = internalFormat;
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

function withFourth(positions) {
  const padded = new Float32Array(positions.length / 3 * 4);
  for (let i = 0; i < positions.length / 3; ++i) padded.set(positions.subarray(3 * i, 3 * i + 3), 4 * i);
  return padded;
}

const indexTexture = numbers => dataTexture(numbers, 4, RGBAIntegerFormat, 'RGBA32UI');
const placeTexture = positions => dataTexture(withFourth(positions), 4, RGBAFormat, 'RGBA32F');

/// Instances with arrays that may be replaced by longer ones.
class Instances {
  constructor(base, index, material, order) {
    this.base = new BufferAttribute(new Float32Array(base), 3);
    this.index = index;
    this.mesh = new Mesh(new InstancedBufferGeometry(), material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = order;
    this.mesh.visible = false;
  }
  /// Arrays by name: {array, size, normalized}.
  set(count, arrays) {
    this.mesh.geometry.dispose();
    const geometry = this.mesh.geometry = new InstancedBufferGeometry();
    geometry.setAttribute('position', this.base);
    geometry.setIndex(this.index);
    for (const [name, {array, size, normalized}] of Object.entries(arrays)) geometry.setAttribute(name, new InstancedBufferAttribute(array, size, normalized));
    geometry.instanceCount = count;
    this.mesh.visible = count > 0;
  }
}

/// Flat faces, by triangles of their own: drawn as instances, a face of four triangles costs ten times as much where the processor draws.
class Faces {
  constructor(uniforms) {
    uniforms.faces = {value: null};
    this.texture = uniforms.faces;
    this.mesh = new Mesh(new BufferGeometry(), shader(FACE_VERTEX, FACE_FRAGMENT, uniforms));
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
    this.room = 0;
  }
  /// Faces as collectFaces gives them, and four bytes of colour each.
  set(faces, colors) {
    this.grow(faces.length);
    const pairs = new Uint32Array(2 * faces.length), bytes = new Uint32Array(colors.buffer);
    for (let i = 0; i < faces.length; ++i) { pairs[2 * i] = faces[i]; pairs[2 * i + 1] = bytes[i]; }
    this.texture.value?.dispose();
    this.texture.value = dataTexture(pairs, 2, RGIntegerFormat, 'RG32UI');
    this.mesh.geometry.setDrawRange(0, QUAD_INDEX.length * faces.length);
    this.mesh.visible = faces.length > 0;
  }
  /// Which place of its face each vertex is.
  grow(count) {
    if (count <= this.room) return;
    this.room = Math.ceil(1.3 * count);
    const corners = new Uint8Array(QUAD_INDEX.length * this.room);
    for (let i = 0; i < corners.length; ++i) corners[i] = QUAD_INDEX[i % QUAD_INDEX.length];
    this.mesh.geometry.dispose();
    this.mesh.geometry = new BufferGeometry();
    const attribute = new BufferAttribute(corners, 1);
    attribute.gpuType = IntType;
    this.mesh.geometry.setAttribute('corner', attribute);
  }
}

const SEGMENT = [0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0], SEGMENT_INDEX = [0, 1, 2, 0, 2, 3];

export class Drawing {
  constructor(canvas, mesh) {
    this.renderer = new WebGLRenderer({canvas, antialias: true, alpha: true, preserveDrawingBuffer: false});
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setClearColor(0, 0);
    this.scene = new Scene();
    this.resolution = new Vector2();
    this.faceUniforms = {hexes: {value: indexTexture(mesh.hexes)}, verts: {value: placeTexture(mesh.positions)}, edges: {value: 1}};
    this.faces = mesh.mids ? this.makeCurvedFaces(mesh.mids) : new Faces(this.faceUniforms);
    this.scene.add(this.faces.mesh);
    this.curves = this.makeLines(2.4, 4e-5, 2);
    this.irregular = this.makeLines(1.6, 3e-5, 1);
    this.chosen = this.makeLines(3, 0, 5, {depthTest: false});
    this.plane = this.makeLines(1.6, 0, 4);
    this.makePoints();
    if (mesh.surface) this.makeSurface(mesh.surface);
  }

  makeCurvedFaces(mids) {
    this.faceUniforms.hexMids = {value: indexTexture(mids.ofHex)};
    this.faceUniforms.mids = {value: placeTexture(mids.positions)};
    return new Instances(GRID, GRID_INDEX, shader(FACE_VERTEX, FACE_FRAGMENT, this.faceUniforms, {defines: {CURVED: 1}}), 0);
  }

  makeLines(width, lift, order, more) {
    const fragment = 'precision highp float; flat in vec4 shade; out vec4 pixel; void main() { pixel = shade; }';
    const lines = new Instances(SEGMENT, SEGMENT_INDEX,
      shader(LINE_VERTEX, fragment, {resolution: {value: this.resolution}, width: {value: width}, lift: {value: lift}}, {transparent: true, ...more}), order);
    this.scene.add(lines.mesh);
    return lines;
  }

  makePoints() {
    const fragment = 'precision highp float; out vec4 pixel; void main() { float r = length(gl_PointCoord - .5); if (r > .5) discard; pixel = vec4(r < .34 ? vec3(1.) : vec3(.1, .11, .14), 1.); }';
    this.corners = new Points(new BufferGeometry(), shader(POINT_VERTEX, fragment, {size: {value: 7 * this.renderer.getPixelRatio()}, lift: {value: 6e-5}}));
    this.corners.frustumCulled = false;
    this.corners.renderOrder = 3;
    this.scene.add(this.corners);
  }

  /// Corners of the surface on what is kept; null = all.
  setCorners(mesh, keptVerts) {
    const at = (mesh.corners ?? new Uint32Array()).filter(v => !keptVerts || keptVerts[v]), positions = new Float32Array(3 * at.length);
    at.forEach((v, i) => positions.set(mesh.positions.subarray(3 * v, 3 * v + 3), 3 * i));
    this.corners.geometry.dispose();
    this.corners.geometry = new BufferGeometry();
    this.corners.geometry.setAttribute('position', new BufferAttribute(positions, 3));
    this.cornerCount = at.length;
  }

  makeSurface(surface) {
    const fragment = `precision highp float; uniform float opacity; in vec3 seen; out vec4 pixel; ${LIGHT}
      void main() { vec3 n = normalize(cross(dFdx(seen), dFdy(seen))); pixel = vec4(lit(vec3(.98, .72, .30), n) * opacity, opacity); }`;
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(surface.positions, 3));
    geometry.setIndex(new BufferAttribute(surface.tris, 1));
    this.surface = new Mesh(geometry, shader(SURFACE_VERTEX, fragment, {opacity: {value: 0.4}},
      {transparent: true, premultipliedAlpha: true, depthWrite: false, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -2}));
    this.surface.frustumCulled = false;
    this.surface.renderOrder = 3.5;
    this.surface.visible = false;
    this.scene.add(this.surface);
  }

  /// Faces as collectFaces gives them, and four bytes of colour each.
  setFaces(faces, colors) {
    if (this.faces instanceof Faces) this.faces.set(faces, colors);
    else this.faces.set(faces.length, {face: {array: faces, size: 1, normalized: false}, color: {array: colors, size: 4, normalized: true}});
  }

  /// Segments as 6 numbers each, colours as 4 bytes.
  setLines(lines, segments, colors) {
    const n = segments.length / 6, begin = new Float32Array(3 * n), end = new Float32Array(3 * n);
    for (let i = 0; i < n; ++i)
      for (let k = 0; k < 3; ++k) { begin[3 * i + k] = segments[6 * i + k]; end[3 * i + k] = segments[6 * i + 3 + k]; }
    lines.set(n, {begin: {array: begin, size: 3}, end: {array: end, size: 3}, color: {array: colors, size: 4, normalized: true}});
  }

  resize(width, height) {
    this.renderer.setSize(width, height, false);
    this.resolution.set(width, height);
  }
  render(camera) { this.renderer.render(this.scene, camera); }
}
