// The page: what is open, painted and held, and what happened to it.
import { Engine } from './engine.js';
import { FIXED, FREE, HANDLE, colorOf, css, gray, ramp, rampColor, red } from './colors.js';
import {
  boundary,
  facesOfInverted,
  readMesh,
  writeMesh,
  writeSelection,
  writeTransforms,
} from './files.js';
import { models } from './models.js';
import { center, fittedMotion, identity, matrixOf, rigidParts } from './motion.js';
import { drawPlot } from './plot.js';
import { brushed, flood, isInside, nearestSeen, ofSimplices } from './regions.js';
import { THREE, View } from './view.js';

const $ = (id) => document.getElementById(id);
const view = (() => {
  try {
    return new View($('view'));
  } catch (error) {
    $('message').hidden = false;
    $('message').className = 'error';
    $('message').firstElementChild.textContent =
      'This browser does not draw in three dimensions: WebGL 2 is missing or switched off.';
    throw error;
  }
})();
const engine = new Engine(...window.arapParts());

// what is open: points are those of the rest shape
// { name, points, simplices, corners, volume, faces, diagonal, status, handles, stiffness }
let shape = null;
let tool = 'grab',
  paints = FIXED,
  chosen = -1; // the handle with the gizmo
let hasNewTargets = false,
  isSettled = true,
  isHeld = false,
  failed = '';
let past = [],
  now = -1; // undo and redo
let keys = [],
  playing = null;
let spare = null; // an array for the next points
let dragging = null,
  stroke = null;
const measured = {
  energy: NaN,
  milliseconds: NaN,
  iterations: 0,
  perIteration: 1,
  frames: 0,
  steps: 0,
};
const history = { energy: [], milliseconds: [] };

// ---- messages

let messageTimer = 0;
function say(sentence, isError = false) {
  clearTimeout(messageTimer);
  $('message').hidden = !sentence;
  $('message').className = isError ? 'error' : '';
  $('message').firstElementChild.textContent = sentence;
  if (sentence && !isError) messageTimer = setTimeout(() => say(''), 6000);
}
$('message').lastElementChild.onclick = () => say('');
const sentence = ({ message }) =>
  // names of files keep their letters
  (/^[a-z]+[ ,]/.test(message) ? message[0].toUpperCase() : message[0]) +
  message.slice(1) +
  (/[.!?]$/.test(message) ? '' : '.');
const complain = (error) => say(sentence(error), true);

let work = 0;
async function busy(what, f) {
  ++work;
  $('busy').textContent = what;
  const timer = setTimeout(() => {
    $('busy').hidden = false;
  }, 150);
  try {
    return await f();
  } finally {
    clearTimeout(timer);
    if (!--work) $('busy').hidden = true;
  }
}

// ---- handles

// A handle is what is painted with one color, or one point in a face: it moves with its matrix,
// from the rest shape.
function membersOf(k) {
  const list = [];
  for (let v = 0; v < shape.status.length; ++v) if (shape.status[v] === k + HANDLE) list.push(v);
  return list;
}

const isDeformed = () =>
  shape.handles.some((h) => h.matrix.some((x, i) => Math.abs(x - identity()[i]) > 1e-12));

function newHandle(rest = {}) {
  return {
    matrix: identity(),
    pivot: [0, 0, 0],
    weight: null,
    turns: false,
    point: null,
    size: 0,
    ...rest,
  };
}

const messageOfHandles = () =>
  shape.handles.map(({ matrix, weight, turns, point }) => ({
    matrix,
    weight: weight ?? Infinity,
    turns,
    point,
  }));

const hold = () =>
  engine.call('hold', { status: shape.status.slice(), handles: messageOfHandles() });

// after painting: which handles there are, and where they turn about
function recountHandles(fits) {
  const sizes = new Map();
  let fixed = 0;
  for (const s of shape.status) {
    if (s >= HANDLE) sizes.set(s - HANDLE, (sizes.get(s - HANDLE) ?? 0) + 1);
    fixed += s === FIXED;
  }
  while (shape.handles.length < Math.max(0, ...[...sizes.keys()].map((k) => k + 1)))
    shape.handles.push(newHandle());
  shape.handles.forEach((handle, k) => {
    if (handle.point) return;
    const size = sizes.get(k) ?? 0;
    if (size && (size !== handle.size || fits)) {
      const list = membersOf(k),
        isNew = !handle.size;
      if (isNew && fits) handle.matrix = fittedMotion(list, shape.points, view.positions);
      if (isNew) handle.turns = size === 1;
      handle.pivot = center(shape.points, list);
    }
    if (!size) handle.matrix = identity();
    handle.size = size;
  });
  while (shape.handles.length && !shape.handles.at(-1).size && !shape.handles.at(-1).point)
    shape.handles.pop();
  shape.fixed = fixed;
  isHeld = fixed > 0 || shape.handles.length > 0;
  if (chosen >= shape.handles.length || (chosen >= 0 && !isThere(shape.handles[chosen])))
    chosen = -1;
}
const isThere = (handle) => handle.size > 0 || !!handle.point;

function placeGizmo() {
  const handle = shape?.handles[chosen];
  if (!handle) view.gizmo.detach();
  else if (!view.gizmo.dragging) {
    const { q, place } = rigidParts(handle);
    view.proxy.position.copy(place);
    view.proxy.quaternion.copy(q);
    if (view.gizmo.object !== view.proxy) view.gizmo.attach(view.proxy);
  }
  view.gizmo.enabled = view.gizmo.getHelper().visible = tool === 'grab' && !!handle && !playing;
  view.isDirty = true;
}

view.gizmo.addEventListener('objectChange', () => {
  if (chosen < 0) return;
  const handle = shape.handles[chosen];
  handle.matrix = matrixOf(handle.pivot, view.proxy.quaternion, view.proxy.position);
  handlesMoved();
});
view.gizmo.addEventListener('dragging-changed', ({ value }) => {
  view.orbit.enabled = !value;
  dragging = value ? { gizmo: true } : null;
  if (!value) {
    closeHelp();
    isSettled = false;
    commit();
  }
});

function handlesMoved() {
  hasNewTargets = true;
  isSettled = false;
  drawMarks();
}

function choose(k) {
  chosen = k;
  if (k >= 0) paints = k + HANDLE;
  placeGizmo();
  showPanel();
}

// ---- the shape follows

function pump() {
  if (!shape || !engine.isIdle || isSettled) return;
  if (!isHeld) return void (isSettled = true);
  const moves = hasNewTargets,
    fast = moves || dragging || playing;
  const share = measured.perIteration || 1;
  const iterations = fast
    ? Math.max(1, Math.min(3, Math.round(50 / share)))
    : Math.max(5, Math.min(200, Math.round(60 / share)));
  hasNewTargets = false;
  const of = shape,
    buffer = spare && spare.length === shape.points.length ? spare : null;
  spare = null;
  engine
    .call(
      'step',
      {
        handles: moves ? messageOfHandles() : null,
        iterations,
        tolerance: fast ? 0 : 1e-6,
        buffer,
      },
      buffer ? [buffer.buffer] : [],
    )
    .then(
      (step) => {
        if (of !== shape) return;
        if (!(isSettled && !hasNewTargets)) spare = view.setPositions(step.points);
        failed = '';
        ++measured.steps;
        Object.assign(measured, {
          energy: step.energy,
          milliseconds: step.milliseconds,
          iterations: step.iterations,
        });
        if (step.iterations)
          measured.perIteration =
            0.5 * measured.perIteration + (0.5 * step.milliseconds) / step.iterations;
        history.energy.push(step.energy);
        history.milliseconds.push(step.milliseconds / Math.max(1, step.iterations));
        for (const list of Object.values(history)) if (list.length > 110) list.shift();
        const done =
          step.result === 'converged' ||
          (!fast && step.firstEnergy - step.energy <= 1e-12 * step.energy);
        if (done && !hasNewTargets && !dragging && !playing) settle(step);
        drawPlot($('plot'), history, measured);
        drawInverted();
        drawMarks();
        placeGizmo();
        pump();
      },
      (error) => {
        if (of !== shape) return;
        isSettled = true;
        if (failed !== error.message) complain(error);
        failed = error.message;
        spare = null;
      },
    );
}

function settle(step) {
  isSettled = true;
  if (step.unconstrained)
    say(
      step.unconstrained === 1
        ? '1 part of the shape is held by nothing and stays.'
        : `${step.unconstrained} parts of the shape are held by nothing and stay.`,
    );
  showMeasure();
}

// ---- undo and redo

async function commit() {
  const of = shape;
  const kept = {
    status: shape.status.slice(),
    stiffness: shape.stiffness && shape.stiffness.slice(),
    keys: keys.slice(),
    chosen,
    handles: structuredClone(shape.handles),
    options: options(),
    measure: $('measure').value,
    points: shape.points,
  };
  const dropped = past.splice(now + 1);
  past.push(kept);
  now = past.length - 1;
  const largest = Math.max(3, Math.min(60, Math.floor(1.2e7 / shape.points.length)));
  while (past.length > largest) {
    dropped.push(past.shift());
    --now;
  }
  showPanel();
  kept.state = engine.call('keep').then(
    (answer) => answer.state,
    () => null,
  );
  for (const old of dropped)
    old.state.then(
      (state) => of === shape && state && engine.call('forget', { state }).catch(() => {}),
    );
  await kept.state;
}

// Runs what changes the shape, which then follows. What fails is undone.
async function changing(f) {
  try {
    await f();
    failed = '';
    isSettled = false;
    hasNewTargets = shape.handles.length > 0;
    draw();
    await commit();
    pump();
  } catch (error) {
    complain(error);
    await goTo(now);
  }
}

async function goTo(index) {
  if (index < 0 || index >= past.length || dragging || stroke) return;
  stopPlaying();
  const kept = past[index],
    before = past[now];
  now = index;
  const state = await kept.state;
  if (!state) return;
  try {
    Object.assign(shape, {
      status: kept.status.slice(),
      handles: structuredClone(kept.handles),
      stiffness: kept.stiffness?.slice() ?? null,
    });
    keys = kept.keys.slice();
    isSettled = true;
    hasNewTargets = false;
    const { points, rest } = await engine.call('restore', { state });
    shape.points = rest;
    if (JSON.stringify(kept.options) !== JSON.stringify(before.options)) {
      showOptions(kept.options);
      await sendOptions(kept.options);
    }
    if (kept.stiffness !== before.stiffness)
      await engine.call('stiffness', { values: cellStiffness() });
    spare = view.setPositions(points);
    chosen = kept.chosen;
    recountHandles(false);
    isSettled = false;
    hasNewTargets = shape.handles.length > 0;
    draw();
    pump();
  } catch (error) {
    complain(error);
  }
}
const undo = () => goTo(now - 1),
  redo = () => goTo(now + 1);

// ---- opening

async function open(mesh, name, note) {
  stopPlaying();
  return busy('Opening…', async () => {
    const { points, simplices, corners, volume } = mesh,
      n = points.length / 3,
      weights = $('weights').value;
    if (!n || !simplices.length) throw new Error(`${name} has no faces`);
    await engine.call('open', { points, simplices, corners, volume, weights });
    const box = new THREE.Box3().setFromArray(points);
    shape = {
      name,
      points,
      simplices,
      corners,
      volume,
      weights,
      faces: volume ? boundary(simplices, points) : simplices,
      handles: [],
      status: mesh.status?.slice() ?? new Int32Array(n).fill(FREE),
      stiffness: null,
      diagonal: box.getSize(new THREE.Vector3()).length(),
    };
    past = [];
    now = -1;
    keys = [];
    chosen = -1;
    spare = null;
    failed = '';
    Object.assign(measured, { energy: NaN, milliseconds: NaN, perIteration: n / 10000 });
    history.energy.length = history.milliseconds.length = 0;
    view.setShape(points, shape.faces);
    view.fit();
    if ($('measure').value) $('measure').value = '';
    recountHandles(false);
    await sendOptions(options());
    await hold();
    if (shape.handles.length) chosen = shape.handles.findIndex(isThere);
    paints = shape.fixed ? HANDLE : FIXED;
    setTool(shape.handles.length ? 'grab' : 'brush');
    isSettled = true;
    draw();
    await commit();
    say(note ?? '');
    // the first step does all that is done once, before anything is dragged
    if (shape.handles.length && n < 150000) handlesMoved();
  });
}

async function openFile(file) {
  try {
    const mesh = await busy(`Reading ${file.name}…`, async () =>
      readMesh(file.name, await file.arrayBuffer()),
    );
    closeHelp();
    await open(
      mesh,
      file.name.replace(/\.\w+$/, ''),
      mesh.note || `${file.name}: paint what stays, then what you hold.`,
    );
    $('model').value = '';
  } catch (error) {
    complain(error);
  }
}

async function openModel(id) {
  try {
    const [title, make] = models[id];
    $('model').value = id;
    await open(make(), title.toLowerCase().replace(/ /g, '_'));
  } catch (error) {
    complain(error);
  }
}

// ---- options

const options = () => ({
  cells: $('cells').value,
  minimizer: $('minimizer').value,
  bending_length: String(($('bending').value / 100) * (shape?.diagonal ?? 1)),
});
// in an order in which none refuses the other
async function sendOptions({ cells, minimizer, bending_length }) {
  for (const some of [{ bending_length: '0' }, { cells, minimizer }, { bending_length }])
    await engine.call('options', { options: some });
}
function showOptions(kept) {
  $('cells').value = kept.cells;
  $('minimizer').value = kept.minimizer;
  $('bending').value = (kept.bending_length / shape.diagonal) * 100;
  showPanel();
}

async function optionsChanged() {
  const before = past[now].options;
  if ($('cells').value === 'elements') $('bending').value = 0;
  const wanted = options();
  try {
    if ((wanted.cells === 'elements') !== (before.cells === 'elements') && shape.stiffness) {
      shape.stiffness = null;
      await engine.call('stiffness', { values: [] });
      say('The painted stiffness was of other cells, and is cleared.');
    }
    await sendOptions(wanted);
    isSettled = false;
    await commit();
    pump();
  } catch (error) {
    complain(error);
    showOptions(before);
    await sendOptions(before).catch(complain);
  }
  showPanel();
}

async function weightsChanged() {
  const weights = $('weights').value,
    handles = messageOfHandles(),
    stiffness = cellStiffness();
  await changing(async () => {
    await busy('Weights…', () =>
      engine.call('weights', { weights, handles, options: options(), stiffness }),
    );
    shape.weights = weights;
    past = []; // of another session
    now = -1;
  });
  $('weights').value = shape.weights;
}

// ---- painting

function stiffnessOfVertices() {
  if (!shape.stiffness) shape.stiffness = new Float64Array(shape.status.length).fill(1);
  return shape.stiffness;
}

// what the session wants: of its cells, and nothing where nothing is painted
const cellStiffness = () =>
  !shape.stiffness || $('cells').value !== 'elements'
    ? (shape.stiffness ?? [])
    : ofSimplices(shape, shape.stiffness);

function paint(vertices) {
  if (tool === 'stiffness') {
    const values = stiffnessOfVertices(),
      k = 10 ** Number($('stiffness').value);
    for (const v of vertices) values[v] = k;
  } else for (const v of vertices) shape.status[v] = paints;
  stroke.hasPainted ||= vertices.length > 0;
  if (vertices.length) drawColors();
}

function brushAt(x, y) {
  const list = brushed(stroke.screen, stroke.last ?? [x, y], [x, y], Number($('brush').value));
  if (!list.length && !stroke.last) {
    // the shape is coarser than the brush
    const v = nearestSeen(stroke.screen, x, y, 40);
    if (v >= 0) list.push(v);
  }
  stroke.last = [x, y];
  paint(list);
}

function paintArea() {
  const { screen, path } = stroke,
    [[x0, y0], [x1, y1]] = [path[0], path.at(-1)],
    list = [];
  if (Math.hypot(x1 - x0, y1 - y0) < 3 && path.length < 4) return;
  const hits =
    tool === 'box'
      ? (x, y) => (x - x0) * (x - x1) <= 0 && (y - y0) * (y - y1) <= 0
      : (x, y) => isInside(path, x, y);
  for (let v = 0; v < screen.xs.length; ++v)
    if ((screen.seen[v] || $('through').checked) && hits(screen.xs[v], screen.ys[v])) list.push(v);
  paint(list);
}

async function painted() {
  const fits = isDeformed();
  await changing(async () => {
    if (tool === 'stiffness') {
      $('measure').value = 'stiffness';
      await engine.call('stiffness', { values: cellStiffness() });
    } else {
      recountHandles(fits);
      if (paints >= HANDLE && shape.handles[paints - HANDLE]) chosen = paints - HANDLE;
      await hold();
    }
    if (!shape.fixed && shape.handles.length === 1)
      say('Now paint what stays: choose Fixed. Else the whole shape moves with its handle.');
  });
}

// a handle in a face, or at a vertex if that is clicked
async function placePoint(x, y) {
  const hit = view.ray(x, y).intersectObject(view.mesh)[0];
  if (!hit) return;
  // the place in the rest shape: the same barycentric coordinates in the face that was hit
  const face = [hit.face.a, hit.face.b, hit.face.c],
    corners = face.map((v) => new THREE.Vector3().fromArray(view.positions, 3 * v));
  const b = THREE.Triangle.getBarycoord(hit.point, ...corners, new THREE.Vector3())?.toArray() ?? [
    1, 0, 0,
  ];
  const pivot = [0, 1, 2].map((i) =>
    face.reduce((sum, v, k) => sum + b[k] * shape.points[3 * v + i], 0),
  );
  await changing(async () => {
    let place = { simplex: hit.faceIndex, coordinates: b };
    if (shape.volume) ({ place } = await engine.call('locate', { point: hit.point.toArray() }));
    if (!place) throw new Error('there is no tetrahedron at this place');
    const matrix = matrixOf(pivot, new THREE.Quaternion(), hit.point);
    shape.handles.push(newHandle({ pivot, matrix, point: place }));
    await hold();
    isHeld = true;
    setTool('grab');
    choose(shape.handles.length - 1);
  });
}

// ---- pointers

const drawing = $('drawing').getContext('2d');
function drawStroke(x, y) {
  const { clientWidth: w, clientHeight: h } = $('view'),
    canvas = drawing.canvas,
    ratio = devicePixelRatio;
  if (canvas.width !== Math.round(w * ratio) || canvas.height !== Math.round(h * ratio)) {
    canvas.width = Math.round(w * ratio);
    canvas.height = Math.round(h * ratio);
  }
  drawing.setTransform(ratio, 0, 0, ratio, 0, 0);
  drawing.clearRect(0, 0, w, h);
  drawing.lineWidth = 1.5;
  drawing.strokeStyle = '#222';
  drawing.fillStyle = `${css(tool === 'stiffness' ? 0x444444 : colorOf(paints))}40`;
  drawing.beginPath();
  if (tool === 'brush' || tool === 'stiffness') {
    if (x === undefined) return;
    drawing.arc(x, y, Number($('brush').value), 0, 7);
  } else if (stroke?.path && tool === 'box') {
    const [[x0, y0], [x1, y1]] = [stroke.path[0], stroke.path.at(-1)];
    drawing.rect(x0, y0, x1 - x0, y1 - y0);
  } else if (stroke?.path)
    stroke.path.forEach(([a, b], i) => (i ? drawing.lineTo(a, b) : drawing.moveTo(a, b)));
  else return;
  drawing.fill();
  drawing.stroke();
}

const pointers = new Set();
const at = (event) => {
  const box = view.canvas.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
};

function pressed(event) {
  if (event.target !== view.canvas || !shape) return;
  view.canvas.focus({ preventScroll: true });
  pointers.add(event.pointerId);
  if (pointers.size > 1) {
    // two fingers turn the view
    cancelStroke();
    return;
  }
  view.letTurn(true);
  if (event.button !== 0 || playing) return;
  const [x, y] = at(event);
  if (tool === 'grab') {
    const { clientWidth: w, clientHeight: h } = view.container;
    if (chosen >= 0)
      view.gizmo.pointerHover({ x: (2 * x) / w - 1, y: 1 - (2 * y) / h, button: -1 });
    if (chosen >= 0 && view.gizmo.axis) return view.letTurn(false);
    const k = handleAt(x, y, event.pointerType === 'touch' ? 30 : 16);
    if (k < 0) return;
    view.letTurn(false);
    choose(k);
    grab(event, x, y, k);
    return;
  }
  const screen = view.screen();
  if (tool !== 'box' && tool !== 'lasso' && !screen.isOn(x, y)) return; // the view turns
  view.letTurn(false);
  if (tool === 'point') return void placePoint(x, y);
  stroke = {
    screen,
    before: shape.status.slice(),
    stiffness: shape.stiffness?.slice() ?? null,
    id: event.pointerId,
  };
  view.canvas.setPointerCapture(event.pointerId);
  if (tool === 'flood') {
    const seed = nearestSeen(screen, x, y, 60);
    if (seed >= 0) paint(flood(shape, seed));
  } else if (tool === 'box' || tool === 'lasso') stroke.path = [[x, y]];
  else brushAt(x, y);
  drawStroke(x, y);
}

function handleAt(x, y, within) {
  let best = -1,
    least = within;
  shape.handles.forEach((handle, k) => {
    if (!handle.point) return;
    const [a, b] = view.toScreen(...rigidParts(handle).place),
      d = Math.hypot(a - x, b - y);
    if (d < least) {
      least = d;
      best = k;
    }
  });
  if (best >= 0 || !shape.handles.length) return best;
  const v = nearestSeen(view.screen(), x, y, within, (w) => shape.status[w] >= HANDLE);
  return v < 0 ? -1 : shape.status[v] - HANDLE;
}

// in the plane of the screen through the handle
function grab(event, x, y, k) {
  const { place, q } = rigidParts(shape.handles[k]);
  const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(
    view.camera.getWorldDirection(new THREE.Vector3()),
    place,
  );
  const hit = (a, b) => view.ray(a, b).ray.intersectPlane(plane, new THREE.Vector3());
  const start = hit(x, y);
  if (!start) return;
  view.canvas.setPointerCapture(event.pointerId);
  dragging = {
    id: event.pointerId,
    k,
    hasMoved: false,
    to: (a, b) => {
      const p = hit(a, b);
      if (!p) return;
      const handle = shape.handles[k];
      handle.matrix = matrixOf(handle.pivot, q, p.sub(start).add(place));
      dragging.hasMoved = true;
      handlesMoved();
    },
  };
}

function cancelStroke() {
  if (!stroke) return;
  shape.status = stroke.before;
  shape.stiffness = stroke.stiffness;
  stroke = null;
  drawStroke();
  drawColors();
}

function movedTo(event) {
  if (!shape) return;
  const [x, y] = at(event);
  if (dragging?.to && dragging.id === event.pointerId) return dragging.to(x, y);
  if (stroke && stroke.id === event.pointerId) {
    if (stroke.path) stroke.path.push([x, y]);
    else if (tool !== 'flood') brushAt(x, y);
  }
  if (stroke || event.pointerType !== 'touch') drawStroke(x, y);
}

function released(event) {
  pointers.delete(event.pointerId);
  if (dragging?.to && dragging.id === event.pointerId) {
    const { hasMoved } = dragging;
    dragging = null;
    placeGizmo();
    if (hasMoved) {
      closeHelp();
      commit();
    }
    isSettled = false;
  }
  if (!stroke || stroke.id !== event.pointerId) return;
  if (event.type === 'pointercancel') return cancelStroke();
  if (stroke.path) paintArea();
  const { hasPainted } = stroke;
  stroke = null;
  drawStroke();
  if (hasPainted) painted();
}
$('view').addEventListener('pointerdown', pressed, true);
addEventListener('pointermove', movedTo);
addEventListener('pointerup', released);
addEventListener('pointercancel', released);
$('view').addEventListener('pointerleave', () => !stroke && drawStroke());
$('view').addEventListener('contextmenu', (event) => event.preventDefault());

// ---- drawing

let values = null,
  range = [0, 1];
function drawColors() {
  if ($('measure').value === 'stiffness' || (stroke && tool === 'stiffness')) {
    const s = shape.stiffness;
    view.setColors((v) => (s && s[v] !== 1 ? rampColor((Math.log10(s[v]) + 2) / 5) : gray));
  } else if (values)
    view.setColors((v) => rampColor((values[v] - range[0]) / (range[1] - range[0])));
  else view.setColors((v) => colorOf(shape.status[v]));
}

// the measure at the vertices, where the shape has come to rest or now and then
const percent = (x) => `${(100 * x).toPrecision(3)}%`;
let isMeasuring = false;
async function showMeasure() {
  const measure = $('measure').value,
    of = shape;
  if (!measure || measure === 'stiffness') {
    values = null;
    $('legend').hidden = true;
    if (shape) drawColors();
    if (!measure) return void ($('quality').textContent = '');
  }
  if (isMeasuring || !shape || measure === 'stiffness') return;
  isMeasuring = true;
  try {
    const answer = await engine.call('colors', { measure });
    if (of !== shape || $('measure').value !== measure) return;
    values = answer.values;
    const sizes = Float64Array.from(values, Math.abs).sort(),
      top = sizes[Math.floor(0.995 * (sizes.length - 1))] || 1e-3;
    range = measure === 'size_change' ? [-top, top] : [0, top];
    const unit = (x) => (measure === 'angle_change' ? `${x.toPrecision(3)}°` : percent(x));
    $('legend').hidden = false;
    $('legend').firstElementChild.style.background =
      `linear-gradient(90deg, ${ramp.map((c) => `rgb(${c})`).join()})`;
    $('legend').lastElementChild.replaceChildren(
      ...range.map((x) => Object.assign(document.createElement('b'), { textContent: unit(x) })),
    );
    const { edgeLengthError, areaChange, volumeChange, invertedSimplices } = answer.quality;
    $('quality').textContent =
      `Edges ${percent(edgeLengthError)}, area ${percent(areaChange)}` +
      (Number.isFinite(volumeChange) ? `, volume ${percent(volumeChange)}` : '') +
      (shape.volume ? `, ${invertedSimplices} inverted` : '');
    drawColors();
  } catch (error) {
    complain(error);
  } finally {
    isMeasuring = false;
  }
}

function drawInverted() {
  const corners = shape.volume ? facesOfInverted(shape, view.positions) : [];
  shape.inverted = corners.length / 36;
  view.setInverted(corners);
}

// points for what is too small to be seen as a region
function drawMarks() {
  const points = [],
    colors = [];
  shape.handles.forEach((handle, k) => {
    if (!handle.point && (handle.size === 0 || handle.size > 6)) return;
    points.push(...rigidParts(handle).place.toArray());
    colors.push(colorOf(k + HANDLE));
  });
  if (shape.fixed && shape.fixed <= 12)
    for (let v = 0; v < shape.status.length; ++v)
      if (shape.status[v] === FIXED) {
        points.push(...view.positions.subarray(3 * v, 3 * v + 3));
        colors.push(red);
      }
  view.setMarks(points, colors);
}

function draw() {
  drawColors();
  drawMarks();
  drawInverted();
  drawPlot($('plot'), history, measured);
  placeGizmo();
  showPanel();
}

// ---- key frames

function addKey() {
  keys.push(shape.handles.map((h) => h.matrix.slice()));
  commit();
}

function stopPlaying() {
  playing?.recorder?.stop();
  playing = null;
  if (shape) {
    placeGizmo();
    showPanel();
  }
}

function play(record) {
  if (playing) return stopPlaying();
  const usable = keys.filter((key) => key.length === shape.handles.length);
  if (!usable.length) return say('There is no key frame: move a handle, and choose Add.', true);
  const path = [shape.handles.map(identity), ...usable];
  playing = {
    path,
    start: performance.now(),
    seconds: 1.5,
    recorder: record?.(),
  };
  placeGizmo();
  showPanel();
}

function playFrame(time) {
  const { path, start, seconds } = playing,
    t = (time - start) / 1000 / seconds,
    i = Math.floor(t);
  const isEnd = i >= path.length - 1,
    share = isEnd ? 1 : t - i,
    from = path[isEnd ? path.length - 2 : Math.max(0, i)],
    to = path[isEnd ? path.length - 1 : i + 1];
  shape.handles.forEach((handle, k) => {
    const a = rigidParts({ ...handle, matrix: from[k] }),
      b = rigidParts({ ...handle, matrix: to[k] });
    handle.matrix = isEnd
      ? to[k].slice()
      : matrixOf(handle.pivot, a.q.slerp(b.q, share), a.place.lerp(b.place, share));
  });
  handlesMoved();
  if (isEnd) {
    stopPlaying();
    commit();
  }
}

function film() {
  const type = ['video/webm;codecs=vp9', 'video/webm', 'video/mp4'].find((t) =>
    window.MediaRecorder?.isTypeSupported(t),
  );
  if (!type) return say('This browser cannot record films.', true);
  play(() => {
    const stream = view.canvas.captureStream(30),
      recorder = new MediaRecorder(stream, { mimeType: type, videoBitsPerSecond: 6e6 }),
      parts = [];
    recorder.ondataavailable = ({ data }) => parts.push(data);
    recorder.onstop = () => {
      stream.getTracks().forEach((track) => track.stop());
      save(`${shape.name}.${type.includes('mp4') ? 'mp4' : 'webm'}`, new Blob(parts, { type }));
    };
    recorder.start();
    return recorder;
  });
}

// ---- saving

function save(name, content) {
  const url = URL.createObjectURL(
    content instanceof Blob ? content : new Blob([content], { type: 'text/plain' }),
  );
  Object.assign(document.createElement('a'), { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
  say(`${name} was saved.`);
}

// the handles of the files, which are numbered without gaps and have vertices
function filed() {
  const numbers = shape.handles.map((handle, k) => k).filter((k) => shape.handles[k].size > 0);
  const place = new Map(numbers.map((k, i) => [k + HANDLE, i + HANDLE]));
  return { numbers, status: shape.status.map((s) => place.get(s) ?? s) };
}

// for a shell; where it cannot tell all, a second line has what is left out
function commandLine() {
  const { name, volume, weights } = shape,
    { cells, minimizer } = options(),
    ending = volume ? 'mesh' : 'off',
    held = filed().numbers.map((k) => shape.handles[k]);
  const file = (end) =>
    /^[\w.-]+$/.test(name) ? name + end : `'${(name + end).replaceAll("'", "'\\''")}'`;
  const differ = (what) => held.some((handle) => handle[what] !== held[0][what]);
  const ofAll = (what) => (held.length && !differ(what) ? held[0][what] : null);
  const untold = [
    differ('weight') && 'weights that differ between handles',
    differ('turns') && 'which handles turn the cells around them',
    shape.stiffness?.some((k) => k !== 1) && 'painted stiffness',
    shape.handles.some((handle) => handle.point) && 'handles that are points in a face',
  ].filter(Boolean);
  return (
    `arap_deform ${file(`_rest.${ending}`)} -o out.${ending} --selection ${file('.sel')}` +
    (held.length ? ` --transform ${file('.def')}` : '') +
    ` --cells ${cells} --weights ${weights}` +
    ` --minimizer ${minimizer} --bending ${$('bending').value / 100}` +
    (ofAll('weight') === null ? '' : ` --soft ${ofAll('weight')}`) +
    (ofAll('turns') ? ' --turn' : '') +
    (untold.length ? `\nThis line leaves out: ${untold.join(', ')}.` : '')
  );
}

const saves = {
  'Mesh .off': () => saveMesh('off', 'points', ''),
  '.obj': () => saveMesh('obj', 'points', ''),
  '.mesh': () => saveMesh('mesh', 'points', ''),
  'Rest shape': () => saveMesh(shape.volume ? 'mesh' : 'off', 'rest', '_rest'),
  Selection: () => save(`${shape.name}.sel`, writeSelection(filed().status, commandLine())),
  Transforms: () => {
    const { numbers } = filed();
    if (!numbers.length) return say('There is no handle with vertices, and so no transform.', true);
    save(`${shape.name}.def`, writeTransforms(numbers.map((k) => shape.handles[k].matrix)));
  },
  'Key frames': () => {
    const { numbers } = filed();
    if (!keys.length) return say('There is no key frame: move a handle, and choose Add.', true);
    keys.forEach((key, i) =>
      save(`${shape.name}-${i + 1}.def`, writeTransforms(numbers.map((k) => key[k] ?? identity()))),
    );
  },
  Picture: () => {
    const shown = view.gizmo.getHelper().visible;
    view.gizmo.getHelper().visible = false;
    view.render();
    view.canvas.toBlob((blob) => save(`${shape.name}.png`, blob));
    view.gizmo.getHelper().visible = shown;
    view.isDirty = true;
  },
};

async function saveMesh(ending, which, suffix) {
  try {
    const answer = await engine.call('points');
    save(
      `${shape.name}${suffix}.${ending}`,
      writeMesh(ending, { ...shape, points: answer[which] }),
    );
  } catch (error) {
    complain(error);
  }
}

// ---- the panel

const icon = (path) =>
  `<svg viewBox="0 0 24 24" width="22" height="22" fill="none" stroke="currentColor" ` +
  `stroke-width="1.8" aria-hidden="true">${path}</svg>`;
const tools = {
  grab: ['M12 3v18M3 12h18M9 6l3-3 3 3M9 18l3 3 3-3M6 9l-3 3 3 3M18 9l3 3-3 3', 'Grab', 'g'],
  brush: ['M20 4l-9 9M11 12c-3-1-5 1-5 4 0 2-1 3-3 3 4 3 10 1 10-5z', 'Brush', 'b'],
  box: ['M4 6h16v12H4z', 'Box', 'x'],
  lasso: ['M7 15c-6-2-4-10 5-10s11 8 5 10c-4 1-7 0-10 0zm0 0c-2 1-2 4 1 5', 'Lasso', 'l'],
  flood: ['M5 12l7-7 7 7-7 7zM5 12h14M20 15c2 3 2 5 0 5s-2-2 0-5', 'Flood', 'f'],
  point: ['M12 2v6M12 16v6M2 12h6M16 12h6M12 10.5a1.5 1.5 0 100 3 1.5 1.5 0 100-3', 'Point', 'p'],
  stiffness: ['M12 3l8 5v8l-8 5-8-5V8zM12 12l8-4M12 12v9M12 12L4 8', 'Stiff', 's'],
};

function setTool(name) {
  tool = name;
  drawStroke();
  placeGizmo();
  view.canvas.style.cursor =
    { grab: 'grab', brush: 'none', stiffness: 'none' }[name] ?? 'crosshair';
  showPanel();
}

const button = (text, press, title = '') =>
  Object.assign(document.createElement('button'), { textContent: text, onclick: press, title });

function showPanel() {
  for (const b of $('tools').children) b.classList.toggle('on', b.dataset.tool === tool);
  if (!shape) return;
  const region = (status, text) => {
    const b = button('', () => {
      paints = status;
      if (tool === 'grab' || tool === 'point' || tool === 'stiffness') setTool('brush');
      if (
        status >= HANDLE &&
        shape.handles[status - HANDLE] &&
        isThere(shape.handles[status - HANDLE])
      )
        choose(status - HANDLE);
      showPanel();
    });
    b.innerHTML = `<i style="background:${css(colorOf(status))}"></i>${text}`;
    b.classList.toggle('on', paints === status && !['grab', 'point', 'stiffness'].includes(tool));
    return b;
  };
  const painted = shape.handles.map((h, k) => k).filter((k) => !shape.handles[k].point);
  const next = Array.from({ length: 99 }, (_, k) => k).find(
    (k) => !shape.handles[k] || !isThere(shape.handles[k]),
  );
  $('regions').replaceChildren(
    region(FREE, 'Free'),
    region(FIXED, 'Fixed'),
    ...painted.filter((k) => k !== next).map((k) => region(k + HANDLE, `Handle ${k + 1}`)),
    region(next + HANDLE, next ? 'New handle' : 'Handle 1'),
  );
  const handle = shape.handles[chosen];
  $('handle').hidden = !handle;
  if (handle) {
    $('handle').querySelector('h2').textContent = handle.point
      ? `Point ${chosen + 1}`
      : `Handle ${chosen + 1}`;
    $('soft').checked = handle.weight !== null;
    $('weight').disabled = handle.weight === null;
    if (handle.weight !== null) $('weight').value = Math.log10(handle.weight);
    $('frame').checked = handle.turns;
    $('frame').disabled = !!handle.point;
  }
  $('moves').classList.toggle('on', view.gizmo.mode === 'translate');
  $('turns').classList.toggle('on', view.gizmo.mode === 'rotate');
  $('undo').disabled = now <= 0;
  $('redo').disabled = now >= past.length - 1;
  $('name').textContent =
    `${shape.name}: ${(shape.points.length / 3).toLocaleString('en')} vertices, ` +
    `${(shape.simplices.length / shape.corners).toLocaleString('en')} ` +
    (shape.volume ? 'tetrahedra' : 'triangles');
  const shown = (id, text) => {
    $(id).parentElement.querySelector('output').textContent = text;
  };
  shown('brush', `${$('brush').value} px`);
  shown('weight', handle?.weight != null ? (10 ** $('weight').value).toPrecision(2) : 'hard');
  shown('bending', $('bending').value === '0' ? 'none' : `${$('bending').value}%`);
  shown('stiffness', `× ${10 ** $('stiffness').value}`);
  $('bending').disabled = $('cells').value === 'elements';
  $('up').textContent = `Up: ${view.up}`;
  $('keys').replaceChildren(
    ...keys.map((key, i) =>
      button(
        String(i + 1),
        () => {
          if (key.length !== shape.handles.length)
            return say('This key frame is of other handles.', true);
          shape.handles.forEach((h, k) => {
            h.matrix = key[k].slice();
          });
          handlesMoved();
          commit();
        },
        'Go there',
      ),
    ),
  );
  $('play').textContent = playing ? 'Stop' : 'Play';
  view.isDirty = true;
}

function changeHandle(change) {
  const handle = shape?.handles[chosen];
  if (!handle) return;
  change(handle);
  changing(hold);
}

async function removeHandle() {
  const handle = shape?.handles[chosen];
  if (!handle) return;
  for (let v = 0; v < shape.status.length; ++v)
    if (shape.status[v] === chosen + HANDLE) shape.status[v] = FREE;
  handle.point = null;
  stroke = null;
  tool = 'grab';
  await painted();
}

async function reset() {
  stopPlaying();
  await changing(async () => {
    shape.handles.forEach((h) => {
      h.matrix = identity();
    });
    const { points } = await engine.call('reset');
    spare = view.setPositions(points);
  });
}

async function restFromNow() {
  stopPlaying();
  await changing(async () => {
    const { rest } = await engine.call('rest');
    shape.points = rest;
    shape.handles.forEach((handle, k) => {
      if (handle.point) handle.pivot = rigidParts(handle).place.toArray();
      else if (handle.size) handle.pivot = center(rest, membersOf(k));
      handle.matrix = identity();
    });
    keys = [];
    await hold();
    showMeasure();
    say('This is the rest shape from now on.');
  });
}

function closeHelp() {
  $('help').hidden = true;
  try {
    localStorage.setItem('arap-help', 'seen');
  } catch {
    /* not allowed for files */
  }
}

function moveByKey(key, turns) {
  const handle = shape?.handles[chosen],
    direction = {
      ArrowLeft: [-1, 0, 0],
      ArrowRight: [1, 0, 0],
      ArrowUp: [0, 1, 0],
      ArrowDown: [0, -1, 0],
      PageUp: [0, 0, -1],
      PageDown: [0, 0, 1],
    }[key];
  if (!handle || !direction) return false;
  const { q, place } = rigidParts(handle),
    axis = new THREE.Vector3(...direction).transformDirection(view.camera.matrixWorld);
  if (turns) q.premultiply(new THREE.Quaternion().setFromAxisAngle(axis, Math.PI / 36));
  else place.addScaledVector(axis, 0.01 * shape.diagonal);
  handle.matrix = matrixOf(handle.pivot, q, place);
  handlesMoved();
  placeGizmo();
  clearTimeout(moveByKey.timer);
  moveByKey.timer = setTimeout(commit, 400);
  return true;
}

for (const [id, [path, text, key]] of Object.entries(tools)) {
  const b = button('', () => setTool(id), `${text} (${key.toUpperCase()})`);
  b.innerHTML = `${icon(`<path d="${path}" stroke-linejoin="round"/>`)}${text}`;
  b.dataset.tool = id;
  $('tools').append(b);
}
for (const [id, [title]] of Object.entries(models)) $('model').append(new Option(title, id));
$('model').append(new Option('from a file', '', false, false));
$('model').lastChild.hidden = true;
for (const [text, press] of Object.entries(saves)) $('saves').append(button(text, press));

const actions = {
  open: () => $('file').click(),
  undo,
  redo,
  reset,
  rest: restFromNow,
  begin: closeHelp,
  addkey: addKey,
  play: () => play(),
  film,
  fit: () => view.fit(),
  remove: removeHandle,
  home: () =>
    changeHandle((h) => {
      h.matrix = identity();
    }),
  moves: () => {
    view.gizmo.setMode('translate');
    showPanel();
  },
  turns: () => {
    view.gizmo.setMode('rotate');
    showPanel();
  },
  up: () => {
    view.up = view.up === 'z' ? 'y' : 'z';
    view.makeOrbit();
    view.fit();
    showPanel();
  },
  how: () => {
    $('help').hidden = false;
  },
  clear: () => {
    shape.status.fill(FREE);
    shape.handles = [];
    chosen = -1;
    paints = FIXED;
    tool = 'brush';
    reset().then(painted);
  },
  more: () => {
    const closed = document.querySelector('main').classList.toggle('closed');
    $('more').setAttribute('aria-expanded', String(!closed));
  },
};
for (const [id, act] of Object.entries(actions)) $(id).onclick = act;
$('model').onchange = () => openModel($('model').value);
$('file').onchange = () => {
  if ($('file').files[0]) openFile($('file').files[0]);
  $('file').value = '';
};
for (const id of ['cells', 'minimizer', 'bending']) $(id).onchange = optionsChanged;
for (const id of ['bending', 'brush', 'stiffness']) $(id).oninput = showPanel;
$('weights').onchange = weightsChanged;
$('measure').onchange = () => {
  values = null;
  showMeasure();
  drawColors();
};
$('soft').onchange = () =>
  changeHandle((h) => {
    h.weight = $('soft').checked ? 10 ** $('weight').value : null;
  });
$('weight').onchange = () =>
  changeHandle((h) => {
    h.weight = 10 ** $('weight').value;
  });
$('weight').oninput = () => {
  $('weight').parentElement.querySelector('output').textContent = (
    10 ** $('weight').value
  ).toPrecision(2);
};
$('frame').onchange = () =>
  changeHandle((h) => {
    h.turns = $('frame').checked;
  });

addEventListener('keydown', (event) => {
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  if (!shape || event.altKey || event.target.closest?.('input[type=text], select')) return;
  if (event.target.closest?.('input') && /^(Arrow|Page)/.test(key)) return;
  const found = Object.keys(tools).find((id) => tools[id][2] === key);
  if (event.ctrlKey || event.metaKey) {
    if (key === 'z') (event.shiftKey ? redo : undo)();
    else if (key === 'y') redo();
    else return;
  } else if (found) setTool(found);
  else if (/^\d$/.test(key)) {
    paints = key === '0' ? FREE : key === '1' ? FIXED : Number(key);
    if (tool === 'grab') setTool('brush');
    showPanel();
  } else if (key === 'Escape') {
    cancelStroke();
    stopPlaying();
    say('');
    closeHelp();
  } else if (moveByKey(key, event.shiftKey)) closeHelp();
  else if (key === ' ' && event.target.closest?.('button')) return;
  else
    (
      ({
        o: actions.open,
        r: reset,
        v: actions.fit,
        u: actions.up,
        w: actions.moves,
        e: actions.turns,
        k: addKey,
        ' ': () => play(),
        h: actions.more,
        '?': actions.how,
        Delete: removeHandle,
      })[key] ??
      (() => {
        event.handled = true;
      })
    )();
  if (!event.handled) event.preventDefault();
});

addEventListener('dragover', (event) => {
  event.preventDefault();
  document.body.classList.add('dropping');
});
addEventListener(
  'dragleave',
  (event) => !event.relatedTarget && document.body.classList.remove('dropping'),
);
addEventListener('drop', (event) => {
  event.preventDefault();
  document.body.classList.remove('dropping');
  const file = event.dataTransfer.files[0];
  if (file) openFile(file);
});

function frame(time) {
  requestAnimationFrame(frame);
  if (playing) playFrame(time);
  pump();
  if (view.isDirty) {
    view.render();
    ++measured.frames;
  }
}

// ---- for tests and for tinkering

window.arap = {
  ready: engine.ready.then(async () => {
    if (matchMedia('(max-width: 700px)').matches) actions.more();
    try {
      $('help').hidden = localStorage.getItem('arap-help') === 'seen';
    } catch {
      /* as above */
    }
    await openModel('cactus');
    requestAnimationFrame(frame);
  }),
  state: () =>
    shape && {
      name: shape.name,
      vertices: shape.points.length / 3,
      simplices: shape.simplices.length / shape.corners,
      volume: shape.volume,
      fixed: shape.fixed,
      inverted: shape.inverted ?? 0,
      tool,
      isSettled: isSettled && engine.isIdle,
      ...measured,
      undo: now,
      redo: past.length - 1 - now,
      keys: keys.length,
      message: $('message').hidden ? '' : $('message').innerText,
      handles: shape.handles.map((handle, k) => {
        const place = rigidParts(handle).place.toArray(),
          box = view.canvas.getBoundingClientRect(),
          [x, y] = view.toScreen(...place);
        return {
          number: k + 1,
          vertices: handle.size,
          point: !!handle.point,
          weight: handle.weight,
          matrix: handle.matrix.slice(),
          space: place,
          screen: [x + box.left, y + box.top],
        };
      }),
    },
  // how far vertices of hard handles are from their targets, relative to the diagonal
  distanceToTargets() {
    let worst = 0;
    const p = view.positions,
      r = shape.points;
    for (let v = 0; v < shape.status.length; ++v) {
      const s = shape.status[v],
        handle = shape.handles[s - HANDLE];
      if (s === FREE || (handle && handle.weight !== null)) continue;
      const m = handle?.matrix ?? identity();
      for (let i = 0; i < 3; ++i) {
        const target =
          m[4 * i] * r[3 * v] +
          m[4 * i + 1] * r[3 * v + 1] +
          m[4 * i + 2] * r[3 * v + 2] +
          m[4 * i + 3];
        worst = Math.max(worst, Math.abs(p[3 * v + i] - target) / shape.diagonal);
      }
    }
    return worst;
  },
  positions: () => view.positions.slice(),
  status: () => shape.status.slice(),
  open,
  openModel,
  openFile,
  setTool,
  choose,
  heap: async () => (await engine.call('heap')).bytes,
  commandLine,
  view,
  engine,
};
engine.ready.catch((error) => say(`The engine could not be started: ${error.message}.`, true));
