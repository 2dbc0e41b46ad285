'use strict';
// The viewer: decodes the runs of this page, draws them, and joins them to the controls.
(() => {
const started = performance.now();
const element = (id) => document.getElementById(id);
const canvas = element('canvas');
const LINE_SPACING = 0.05;

// ---- Data.

// Bytes of the base64 text of an element.
function bytesOf(id) {
  const text = element(id).textContent.trim();
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Reader of the parts of a buffer, one after the other.
class Parts {
  constructor(bytes) { this.bytes = bytes; this.at = 0; }
  take(count) { const part = this.bytes.subarray(this.at, this.at + count); this.at += count; return part; }
  copied(Type, count) { return new Type(this.take(count * Type.BYTES_PER_ELEMENT).slice().buffer); }
  // Frames of 16-bit numbers: low bytes, then high bytes, each as the difference from the frame before.
  words(frames, count) {
    const all = new Uint16Array(frames * count);
    for (let frame = 0; frame < frames; frame++) {
      const low = this.take(count), high = this.take(count), own = frame * count;
      for (let i = 0; i < count; i++) all[own + i] = (low[i] | high[i] << 8) + (frame ? all[own - count + i] : 0);
    }
    return all;
  }
  octets(frames, count) {
    const all = new Uint8Array(frames * count);
    for (let frame = 0; frame < frames; frame++) {
      const part = this.take(count), own = frame * count;
      for (let i = 0; i < count; i++) all[own + i] = part[i] + (frame ? all[own - count + i] : 0);
    }
    return all;
  }
}

async function readRun(number) {
  const run = JSON.parse(element(`run-${number}`).textContent);
  const parts = new Parts(await inflate(bytesOf(`data-${number}`)));
  run.triangleData = parts.copied(Uint32Array, 3 * run.triangles);
  run.materialData = parts.copied(Float32Array, 2 * run.vertices);
  run.bodyTriangleData = parts.copied(Uint32Array, 3 * run.bodyTriangles);
  run.pairData = parts.copied(Uint32Array, 2 * run.pairs);
  run.positionData = parts.words(run.frames.length, 3 * run.vertices);
  run.bodyData = parts.words(run.bodyStates, 3 * run.bodyVertices);
  for (const field of run.fields) field.data = parts.octets(field.first < 0 ? 1 : run.frames.length, run.vertices);
  return run;
}

// ---- Colours.

function scaleColour(stops, fraction) {
  const place = Math.min(Math.max(fraction, 0), 1) * (stops.length - 1);
  const lower = Math.min(Math.floor(place), stops.length - 2), part = place - lower;
  return stops[lower].map((channel, k) => Math.round(channel + part * (stops[lower + 1][k] - channel)));
}

function scaleTexture(stops) {
  const data = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; i++) data.set([...scaleColour(stops, i / 255), 255], 4 * i);
  const texture = new THREE.DataTexture(data, 256, 1, THREE.RGBAFormat, THREE.UnsignedByteType);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
const scales = new Map();
function scaleOf({ stops }) {
  const key = JSON.stringify(stops);
  if (!scales.has(key)) scales.set(key, scaleTexture(stops));
  return scales.get(key);
}

// Material of cloth: the colour of a side or of a field, with lines along warp and weft.
function clothMaterial(front, back) {
  const material = new THREE.MeshStandardMaterial({ side: THREE.DoubleSide, roughness: 0.85 });
  material.userData = {
    front: { value: new THREE.Color(front) }, back: { value: new THREE.Color(back) },
    scale: { value: null }, mapped: { value: 0 }, lines: { value: 1 },
  };
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, material.userData);
    shader.vertexShader = 'attribute float fieldValue;\nattribute vec2 yarn;\nvarying float vField;\nvarying vec2 vYarn;\n' +
      shader.vertexShader.replace('#include <begin_vertex>', '#include <begin_vertex>\nvField = fieldValue;\nvYarn = yarn;');
    shader.fragmentShader = 'uniform vec3 front;\nuniform vec3 back;\nuniform sampler2D scale;\nuniform float mapped;\nuniform float lines;\nvarying float vField;\nvarying vec2 vYarn;\n' +
      shader.fragmentShader.replace('#include <color_fragment>', `
      vec3 side = gl_FrontFacing ? front : back;
      diffuseColor.rgb = mapped > 0.5 ? texture2D(scale, vec2(vField * 0.99609375 + 0.001953125, 0.5)).rgb : side;
      vec2 cell = vYarn / ${LINE_SPACING.toFixed(4)};
      vec2 width = fwidth(cell);
      vec2 far = abs(fract(cell - 0.5) - 0.5) / max(width, vec2(1e-6));
      float line = (1.0 - min(min(far.x, far.y), 1.0)) * (1.0 - smoothstep(0.2, 0.5, max(width.x, width.y)));
      diffuseColor.rgb *= 1.0 - 0.4 * line * lines;`);
  };
  return material;
}

// ---- A run in its scene.

class View {
  constructor(run) {
    this.run = run;
    this.scene = new THREE.Scene();
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8478, 1.5));
    for (const [x, y, z, light] of [[1, 2, 3, 1.9], [-2, 1, -2, 0.7]]) {
      const lamp = new THREE.DirectionalLight(0xffffff, light);
      lamp.position.set(x, y, z);
      this.scene.add(lamp);
    }
    const attribute = (array, size) => new THREE.BufferAttribute(array, size);
    this.position = attribute(new Float32Array(3 * run.vertices), 3);
    this.normal = attribute(new Float32Array(3 * run.vertices), 3);
    this.value = attribute(new Float32Array(run.vertices), 1);
    this.material = attribute(run.materialData, 2);
    this.clothes = this.meshes(run.panels, run.triangleData, (part) => clothMaterial(part.colour, part.back),
      { position: this.position, normal: this.normal, fieldValue: this.value, yarn: this.material });
    this.bodyPosition = attribute(new Float32Array(3 * run.bodyVertices), 3);
    this.bodyNormal = attribute(new Float32Array(3 * run.bodyVertices), 3);
    const grey = () => new THREE.MeshStandardMaterial({ color: 0xb9b9b5, roughness: 0.9, side: THREE.DoubleSide });
    this.bodies = this.meshes(run.bodies, run.bodyTriangleData, grey, { position: this.bodyPosition, normal: this.bodyNormal });
    this.bodyState = -1;
    this.frame = -1;
    this.mark = new THREE.Mesh(new THREE.SphereGeometry(1, 12, 8), new THREE.MeshBasicMaterial({ color: 0xe03131 }));
    this.mark.visible = false;
    this.scene.add(this.mark);
  }

  // A mesh for each part; all share the attributes.
  meshes(parts, triangles, material, attributes) {
    let first = 0;
    return parts.map((part) => {
      const geometry = new THREE.BufferGeometry();
      for (const [name, attribute] of Object.entries(attributes)) geometry.setAttribute(name, attribute);
      geometry.setIndex(new THREE.BufferAttribute(triangles.subarray(first, first += 3 * part.triangles), 1));
      geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), Infinity);
      const mesh = new THREE.Mesh(geometry, material(part));
      mesh.frustumCulled = false;
      mesh.name = part.name;
      this.scene.add(mesh);
      return mesh;
    });
  }

  show(frame) {
    const run = this.run;
    if (this.frame === frame) return;
    this.frame = frame;
    place(this.position.array, run.positionData, frame * 3 * run.vertices, 0, run.vertices, run.box);
    normals(this.position.array, run.triangleData, this.normal.array, run.pairData);
    const state = run.frames[frame].bodies;
    if (state !== this.bodyState && state >= 0) {
      this.bodyState = state;
      let first = 0;
      for (const body of run.bodies) {
        place(this.bodyPosition.array, run.bodyData, state * 3 * run.bodyVertices, first, body.vertices, body.box);
        first += body.vertices;
      }
      normals(this.bodyPosition.array, run.bodyTriangleData, this.bodyNormal.array, []);
      this.bodyPosition.needsUpdate = this.bodyNormal.needsUpdate = true;
    }
    this.position.needsUpdate = this.normal.needsUpdate = true;
    this.paint();
  }

  // Field at a frame: its data and where they begin, or nothing where it is not known.
  fieldAt(field, frame) {
    if (!field) return null;
    if (field.first >= 0) return { data: field.data, from: frame * this.run.vertices };
    return frame === this.run.frames.length - 1 ? { data: field.data, from: 0 } : null;
  }

  paint() {
    const field = this.run.fields.find((own) => own.key === state.field);
    const at = this.fieldAt(field, this.frame);
    if (at) {
      for (let i = 0; i < this.run.vertices; i++) this.value.array[i] = at.data[at.from + i] / 255;
      this.value.needsUpdate = true;
    }
    for (const mesh of this.clothes) {
      const uniforms = mesh.material.userData;
      uniforms.mapped.value = at ? 1 : 0;
      if (field) uniforms.scale.value = scaleOf(field);
      uniforms.lines.value = state.lines ? 1 : 0;
      mesh.material.wireframe = state.edges;
    }
  }

  // Section: what is beyond the plane is not drawn.
  cut(planes) {
    for (const mesh of [...this.clothes, ...this.bodies]) mesh.material.clippingPlanes = planes;
  }

  box() {
    const box = new THREE.Box3(), point = new THREE.Vector3();
    for (const mesh of this.clothes.filter((own) => own.visible)) {
      for (const vertex of mesh.geometry.index.array) box.expandByPoint(point.fromArray(this.position.array, 3 * vertex));
    }
    return box;
  }
}

// Writes positions in m from 16-bit fractions of a box.
function place(to, data, from, first, count, [low, high]) {
  const scale = [0, 1, 2].map((k) => (high[k] - low[k]) / 65535);
  for (let i = 0; i < count; i++) {
    for (let k = 0; k < 3; k++) to[3 * (first + i) + k] = low[k] + scale[k] * data[from + 3 * (first + i) + k];
  }
}

// Writes unit normals at vertices, weighted by area; vertices that are sewn together at one place share theirs.
function normals(p, triangles, n, pairs) {
  n.fill(0);
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
    const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    n[a] += x; n[a + 1] += y; n[a + 2] += z;
    n[b] += x; n[b + 1] += y; n[b + 2] += z;
    n[c] += x; n[c + 1] += y; n[c + 2] += z;
  }
  for (let k = 0; k < pairs.length; k += 2) {
    const a = 3 * pairs[k], b = 3 * pairs[k + 1];
    const gap = Math.abs(p[a] - p[b]) + Math.abs(p[a + 1] - p[b + 1]) + Math.abs(p[a + 2] - p[b + 2]);
    if (gap < 1e-3) for (let i = 0; i < 3; i++) n[a + i] = n[b + i] = n[a + i] + n[b + i];
  }
  for (let i = 0; i < n.length; i += 3) {
    const length = Math.hypot(n[i], n[i + 1], n[i + 2]) || 1;
    n[i] /= length; n[i + 1] /= length; n[i + 2] /= length;
  }
}

// ---- The page.

const state = { field: '', lines: true, edges: false, time: 0, playing: false, plane: null };
const camera = new THREE.PerspectiveCamera(30, 1, 0.01, 100);
let renderer, controls, views = [], times = [], needsDraw = true;

function option(select, value, text) {
  const own = document.createElement('option');
  own.value = value;
  own.textContent = text;
  select.append(own);
}

function fillParts() {
  const box = element('parts');
  for (const view of views) {
    for (const [mesh, colour] of [...view.clothes.map((m, k) => [m, view.run.panels[k].colour]), ...view.bodies.map((m) => [m, '#b9b9b5'])]) {
      const label = document.createElement('label');
      const check = document.createElement('input');
      check.type = 'checkbox';
      check.checked = mesh.visible;
      check.addEventListener('change', () => { mesh.visible = check.checked; needsDraw = true; });
      const chip = document.createElement('i');
      chip.style.background = colour;
      label.append(check, chip, views.length > 1 ? `${view.run.name}: ${mesh.name}` : mesh.name);
      box.append(label);
    }
  }
}

function table(caption, rows) {
  const own = document.createElement('table');
  if (caption) own.createCaption().textContent = caption;
  for (const row of rows) {
    const line = own.insertRow();
    for (const cell of row) line.insertCell().textContent = cell;
  }
  return own;
}

// Table of measures: rows of a name and values; a row of one cell is the heading of those that follow.
function measureTable({ title, columns, rows }) {
  const own = document.createElement('table');
  own.createCaption().textContent = title;
  const width = 1 + Math.max(1, columns.length);
  const heading = (line, text, attributes) => {
    const cell = document.createElement('th');
    cell.textContent = text;
    Object.assign(cell, attributes);
    line.append(cell);
  };
  if (columns.length) {
    const line = own.createTHead().insertRow();
    for (const name of ['', ...columns]) heading(line, name, { scope: 'col' });
  }
  const body = own.createTBody();
  for (const [name, ...values] of rows) {
    const line = body.insertRow();
    if (values.length) heading(line, name, { scope: 'row' });
    else heading(line, name, { scope: 'rowgroup', colSpan: width });
    for (const value of values) {
      const cell = line.insertCell();
      cell.textContent = value;
      // Long texts are wrapped; a number stays beside its unit.
      if (value.length > 16) cell.className = 'text';
    }
  }
  return own;
}

// Legend of the fabrics, where there are several.
function fillFabrics() {
  for (const { name, colour } of JSON.parse(element('fabrics-data').textContent)) {
    const line = document.createElement('li');
    const chip = document.createElement('i');
    chip.style.background = colour;
    line.append(chip, name || 'fabric without a name');
    element('fabrics').append(line);
  }
}

function digits(value) {
  const size = Math.abs(value);
  return size >= 100 ? value.toFixed(0) : size >= 10 ? value.toFixed(1) : size >= 1 || size === 0 ? value.toFixed(2) : value.toPrecision(2);
}

function showLegend() {
  const field = views.flatMap((view) => view.run.fields).find((own) => own.key === state.field);
  const known = views.some((view) => view.fieldAt(view.run.fields.find((own) => own.key === state.field), view.frame));
  element('legend').hidden = !field;
  element('fabrics').hidden = known || !element('fabrics').childElementCount;
  if (!field) return;
  element('legend-label').textContent = `${field.label}, ${field.unit}` + (known ? '' : ': known in the last frame only');
  const ends = element('legend-ends');
  ends.replaceChildren(...[field.low, (field.low + field.high) / 2, field.high].map((value) => {
    const own = document.createElement('span');
    own.textContent = digits(value);
    return own;
  }));
  const context = element('legend-scale').getContext('2d');
  for (let x = 0; x < 256; x++) {
    context.fillStyle = `rgb(${scaleColour(field.stops, x / 255)})`;
    context.fillRect(x, 0, 1, 12);
  }
}

// Shows the frame of each run that is nearest before a time.
function showTime(index) {
  const at = times[index];
  state.index = index;
  for (const view of views) {
    let frame = 0;
    view.run.frames.forEach((own, k) => { if (own.time <= at + 1e-12) frame = k; });
    view.show(frame);
    view.plot?.show(frame);
  }
  element('scrub').value = index;
  element('clock').textContent = `${at.toFixed(3)} s, frame ${views.map((view) => view.run.frames[view.frame].number).join(' | ')}`;
  showLegend();
  needsDraw = true;
}

// Shows the last instant that is not after a time.
function seek(time) {
  play(false);
  showTime(Math.max(times.findLastIndex((own) => own <= time), 0));
}

function fit() {
  const box = new THREE.Box3();
  views.forEach((view) => box.union(view.box()));
  if (box.isEmpty()) return;
  const centre = box.getCenter(new THREE.Vector3());
  const radius = 0.5 * box.getSize(new THREE.Vector3()).length();
  const away = camera.position.clone().sub(controls.target).normalize();
  const aspect = Math.min(1, camera.aspect);
  const distance = radius / Math.sin(Math.PI * camera.fov / 360) / aspect;
  controls.target.copy(centre);
  camera.position.copy(centre).addScaledVector(away, distance);
  camera.near = distance / 200;
  camera.far = distance * 20;
  camera.updateProjectionMatrix();
  views.forEach((view) => view.mark.scale.setScalar(radius / 120));
  controls.update();
  needsDraw = true;
}

function look(x, y, z) {
  camera.position.copy(controls.target).add(new THREE.Vector3(x, y, z));
  fit();
}

function updateSection() {
  const axis = element('axis').value;
  element('cut').disabled = !axis;
  state.plane = null;
  element('cut-place').textContent = '';
  if (axis) {
    const box = new THREE.Box3();
    views.forEach((view) => box.union(view.box()));
    const place = box.min[axis] + (box.max[axis] - box.min[axis]) * element('cut').value / 1000;
    const normal = new THREE.Vector3();
    const sign = element('flip').checked ? 1 : -1;
    normal[axis] = sign;
    state.plane = new THREE.Plane(normal, -sign * place);
    element('cut-place').textContent = `${axis} = ${(1000 * place).toFixed(0)} mm`;
  }
  views.forEach((view) => view.cut(state.plane ? [state.plane] : []));
  needsDraw = true;
}

// Parts of the canvas, one for each run: left, bottom, width, height in pixels of the page.
function ports() {
  const width = canvas.clientWidth, height = canvas.clientHeight, count = views.length;
  const upright = width < height;
  return views.map((_, k) => upright
    ? [0, height * (count - 1 - k) / count, width, height / count]
    : [width * k / count, 0, width / count, height]);
}

function draw() {
  const width = canvas.clientWidth, height = canvas.clientHeight;
  const size = renderer.getSize(new THREE.Vector2());
  if (size.x !== width || size.y !== height) renderer.setSize(width, height, false);
  const ground = getComputedStyle(document.body).backgroundColor;
  ports().forEach(([x, y, w, h], k) => {
    renderer.setViewport(x, y, w, h);
    renderer.setScissor(x, y, w, h);
    renderer.setScissorTest(true);
    if (camera.aspect !== w / h) { camera.aspect = w / h; camera.updateProjectionMatrix(); }
    views[k].scene.background = new THREE.Color(ground);
    renderer.render(views[k].scene, camera);
  });
}

// Says what is at a point of the page.
function pick(event) {
  const frame = canvas.getBoundingClientRect();
  const x = event.clientX - frame.left, y = frame.bottom - event.clientY;
  const port = ports().findIndex(([l, b, w, h]) => x >= l && x < l + w && y >= b && y < b + h);
  if (port < 0) return;
  const [l, b, w, h] = ports()[port], view = views[port];
  const ray = new THREE.Raycaster();
  ray.setFromCamera(new THREE.Vector2(2 * (x - l) / w - 1, 2 * (y - b) / h - 1), camera);
  const shown = [...view.clothes, ...view.bodies].filter((mesh) => mesh.visible);
  const hits = ray.intersectObjects(shown, false);
  const hit = hits.find((own) => !state.plane || state.plane.distanceToPoint(own.point) >= 0);
  views.forEach((own) => { own.mark.visible = false; });
  needsDraw = true;
  const box = element('picked');
  if (!hit) { box.textContent = 'Click on the cloth.'; return; }
  view.mark.position.copy(hit.point);
  view.mark.visible = true;
  const rows = [['part', hit.object.name], ['place, mm', hit.point.toArray().map((c) => (1000 * c).toFixed(1)).join(', ')]];
  if (view.clothes.includes(hit.object)) {
    const { a, b: second, c } = hit.face;
    const corners = [a, second, c];
    const nearest = corners.reduce((best, vertex) => away(view, vertex, hit.point) < away(view, best, hit.point) ? vertex : best);
    const [weft, warp] = [view.run.materialData[2 * nearest], view.run.materialData[2 * nearest + 1]];
    rows.push(['vertex', String(nearest)], ['weft, warp, mm', `${(1000 * weft).toFixed(1)}, ${(1000 * warp).toFixed(1)}`]);
    for (const field of view.run.fields) {
      const at = view.fieldAt(field, view.frame);
      if (!at) continue;
      const level = at.data[at.from + nearest];
      const bound = level === 255 ? '≥ ' : level === 0 && field.signed ? '≤ ' : '';
      rows.push([`${field.label}, ${field.unit}`, bound + digits(field.low + (field.high - field.low) * level / 255)]);
    }
  }
  box.replaceChildren(table('', rows));
}

function away(view, vertex, point) {
  return new THREE.Vector3().fromArray(view.position.array, 3 * vertex).distanceToSquared(point);
}

function setField(key) {
  state.field = key;
  element('field').value = key;
  views.forEach((view) => view.paint());
  showLegend();
  needsDraw = true;
}

function play(on) {
  state.playing = on && times.length > 1;
  element('play').textContent = state.playing ? '❚❚ pause' : '▶ play';
  if (state.playing && state.index === times.length - 1) showTime(0);
  state.time = times[state.index];
}

function theme() {
  const dark = matchMedia('(prefers-color-scheme: dark)').matches;
  const now = document.documentElement.dataset.theme || (dark ? 'dark' : 'light');
  document.documentElement.dataset.theme = now === 'dark' ? 'light' : 'dark';
  needsDraw = true;
}

function join() {
  const on = (id, kind, action) => element(id).addEventListener(kind, action);
  on('play', 'click', () => play(!state.playing));
  on('scrub', 'input', () => { play(false); showTime(+element('scrub').value); });
  on('field', 'change', () => setField(element('field').value));
  on('lines', 'change', () => { state.lines = element('lines').checked; views.forEach((view) => view.paint()); needsDraw = true; });
  on('edges', 'change', () => { state.edges = element('edges').checked; views.forEach((view) => view.paint()); needsDraw = true; });
  for (const [id, kind] of [['axis', 'change'], ['flip', 'change'], ['cut', 'input']]) on(id, kind, updateSection);
  on('fit', 'click', fit);
  on('front', 'click', () => look(0, 0.1, 1));
  on('flank', 'click', () => look(1, 0.1, 0));
  on('back', 'click', () => look(0, 0.1, -1));
  on('top', 'click', () => look(0, 1, 0.001));
  on('theme', 'click', theme);
  on('drawer', 'click', () => element('drawer').setAttribute('aria-expanded', element('side').classList.toggle('open')));
  let down = null;
  canvas.addEventListener('pointerdown', (event) => { down = [event.clientX, event.clientY]; });
  canvas.addEventListener('pointerup', (event) => {
    if (down && event.button === 0 && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 4) pick(event);
    down = null;
  });
  addEventListener('resize', () => { needsDraw = true; });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { needsDraw = true; });
  const step = (by) => { play(false); showTime(Math.min(Math.max(state.index + by, 0), times.length - 1)); };
  const fields = ['', ...new Set(views.flatMap((view) => view.run.fields.map((own) => own.key)))];
  const keys = {
    ' ': () => play(!state.playing), ArrowLeft: () => step(-1), ArrowRight: () => step(1), f: fit, t: theme,
    m: () => setField(fields[(fields.indexOf(state.field) + 1) % fields.length]), l: () => element('lines').click(),
    1: () => element('front').click(), 2: () => element('flank').click(), 3: () => element('back').click(), 4: () => element('top').click(),
  };
  addEventListener('keydown', (event) => {
    const typing = /^(INPUT|SELECT|BUTTON)$/.test(event.target.tagName) && [' ', 'ArrowLeft', 'ArrowRight'].includes(event.key);
    if (typing || event.ctrlKey || event.metaKey || event.altKey || !keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  });
}

let last = 0;
function tick(now) {
  requestAnimationFrame(tick);
  const passed = Math.min((now - last) / 1000, 0.25);
  last = now;
  if (state.playing) {
    state.time += passed * element('speed').value;
    let index = state.index;
    while (index < times.length - 1 && times[index + 1] <= state.time) index++;
    if (index !== state.index) showTime(index);
    if (index === times.length - 1) play(false);
  }
  controls.update();
  if (needsDraw) { needsDraw = false; draw(); }
}

async function start() {
  const count = document.querySelectorAll('script[id^="run-"]').length;
  const runs = await Promise.all(Array.from({ length: count }, (_, k) => readRun(k)));
  renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  renderer.localClippingEnabled = true;
  views = runs.map((run) => new View(run));
  times = [...new Set(runs.flatMap((run) => run.frames.map((frame) => frame.time)))].sort((a, b) => a - b);
  element('title').textContent = runs.map((run) => run.name).join(' | ');
  element('note').textContent = runs.map((run) => run.note).join(' | ');
  for (const run of runs) {
    for (const warning of run.warnings) {
      const item = document.createElement('li');
      item.textContent = runs.length > 1 ? `${run.name}: ${warning}` : warning;
      element('warnings').append(item);
    }
  }
  element('scrub').max = times.length - 1;
  option(element('field'), '', 'fabric');
  const seen = new Set();
  for (const field of runs.flatMap((run) => run.fields)) {
    if (!seen.has(field.key)) option(element('field'), field.key, `${field.label}, ${field.unit}`);
    seen.add(field.key);
  }
  for (const view of views) {
    const { name, frames, measures, energy } = view.run;
    if (energy) {
      view.plot = energyPlot(energy, frames.map((frame) => frame.time), seek);
      element('measures').append(view.plot.element);
    }
    if (views.length > 1 && measures.length) {
      const heading = document.createElement('h3');
      heading.textContent = name;
      element('measures').append(heading);
    }
    element('measures').append(...measures.map(measureTable));
  }
  controls = new THREE.OrbitControls(camera, canvas);
  controls.enableDamping = true;
  controls.addEventListener('change', () => { needsDraw = true; });
  camera.position.set(0.6, 0.35, 1);
  fillParts();
  fillFabrics();
  join();
  showTime(times.length - 1);
  draw();
  fit();
  draw();
  element('message').textContent = '';
  requestAnimationFrame(tick);
  window.drapeViewer = { loaded: performance.now() - started, views, camera, state };
}
start().catch((error) => { element('message').textContent = `This page cannot be shown: ${error.message}`; throw error; });
})();
