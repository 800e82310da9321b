// The tools: what they paint, and what they draw over the view.
import { HANDLE, colorOf, css } from './colors.js';
import { drawColors, drawPaint, placeGizmo } from './drawing.js';
import { cornersOf } from './faces.js';
import {
  choose,
  hold,
  isDeformed,
  isThere,
  newHandle,
  placeOf,
  takePaint,
} from './handles.js';
import { say } from './messages.js';
import { matrixOf } from './motion.js';
import { sendStiffness, stiffnessOfVertices } from './options.js';
import { brushed, isInside, nearestSeen } from './regions.js';
import { $, changed, engine, page, view } from './state.js';
import { changing } from './undo.js';
import { THREE } from './view.js';

const drawing = $('drawing').getContext('2d');

export function drawStroke(x, y) {
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
  drawing.fillStyle = `${css(page.tool === 'stiffness' ? 0x444444 : colorOf(page.paints))}40`;
  drawing.beginPath();
  if (page.tool === 'brush' || page.tool === 'stiffness') {
    if (x === undefined) return;
    drawing.arc(x, y, Number($('brush').value), 0, 7);
  } else if (page.stroke?.path && page.tool === 'box') {
    const [[x0, y0], [x1, y1]] = [page.stroke.path[0], page.stroke.path.at(-1)];
    drawing.rect(x0, y0, x1 - x0, y1 - y0);
  } else if (page.stroke?.path)
    page.stroke.path.forEach(([a, b], i) => (i ? drawing.lineTo(a, b) : drawing.moveTo(a, b)));
  else return;
  drawing.fill();
  drawing.stroke();
}

export function cancelStroke() {
  if (!page.stroke) return;
  Object.assign(page.shape, page.stroke.before);
  page.stroke = null;
  drawStroke();
  drawColors();
}

// not while a stroke goes on, which is of one tool
export function setTool(name) {
  if (page.stroke) return;
  page.tool = name;
  drawStroke();
  placeGizmo();
  view.canvas.style.cursor =
    { grab: 'grab', brush: 'none', stiffness: 'none' }[name] ?? 'crosshair';
  changed();
}

export const paintsRegions = () => !['grab', 'point', 'stiffness'].includes(page.tool);

// from now on
export function paintWith(status) {
  page.paints = status;
  if (!paintsRegions()) setTool('brush');
  if (page.shape.handles[status - HANDLE]?.size) choose(status - HANDLE); // no point
  changed();
}

export function paint(vertices) {
  if (page.tool === 'stiffness') {
    const values = stiffnessOfVertices(),
      k = 10 ** Number($('stiffness').value);
    for (const v of vertices) values[v] = k;
  } else for (const v of vertices) page.shape.status[v] = page.paints;
  page.stroke.hasPainted ||= vertices.length > 0;
  if (vertices.length) drawPaint(page.tool === 'stiffness' ? 'stiffness' : '');
}

export function brushAt(x, y) {
  const list = brushed(
    view.screen(),
    page.stroke.last ?? [x, y],
    [x, y],
    Number($('brush').value),
  );
  if (!list.length && !page.stroke.last) {
    // the shape is coarser than the brush
    const v = nearestSeen(view.screen(), x, y, 40);
    if (v >= 0) list.push(v);
  }
  page.stroke.last = [x, y];
  paint(list);
}

export function paintArea() {
  const screen = view.screen(),
    { path } = page.stroke,
    [[x0, y0], [x1, y1]] = [path[0], path.at(-1)],
    list = [];
  if (Math.hypot(x1 - x0, y1 - y0) < 3 && path.length < 4) return;
  const hits =
    page.tool === 'box'
      ? (x, y) => (x - x0) * (x - x1) <= 0 && (y - y0) * (y - y1) <= 0
      : (x, y) => isInside(path, x, y);
  for (let v = 0; v < screen.xs.length; ++v)
    if ((screen.seen[v] || $('through').checked) && hits(screen.xs[v], screen.ys[v])) list.push(v);
  paint(list);
}

// `prepare` is called first, when it is its turn; if it returns false, there is nothing to do
export async function painted(prepare = () => {}) {
  const fits = isDeformed(),
    { tool, paints } = page; // they may change until it is their turn
  await changing(async () => {
    if (prepare() === false) return false;
    if (tool === 'stiffness') {
      const { stiffness } = page.stroke?.before ?? page.shape;
      await sendStiffness(stiffness?.slice() ?? null);
    } else {
      takePaint(fits);
      const handle = page.shape.handles[paints - HANDLE];
      if (tool !== 'grab' && handle && isThere(handle)) page.chosen = paints - HANDLE;
      await hold();
    }
    if (!page.shape.fixed && page.shape.handles.length === 1)
      say('Now paint what stays: choose Fixed. Else the whole shape moves with its handle.');
  });
}

// a handle in a face, or at a vertex if that is clicked
export async function placePoint(x, y) {
  view.mesh.geometry.computeBoundingSphere(); // that of the present positions
  const { shape } = page,
    hit = view.ray(x, y).intersectObject(view.mesh)[0];
  if (!hit) return;
  const triangle = [hit.face.a, hit.face.b, hit.face.c],
    points = triangle.map((v) => new THREE.Vector3().fromArray(view.positions, 3 * v));
  const b = THREE.Triangle.getBarycoord(hit.point, ...points, new THREE.Vector3());
  await changing(async () => {
    if (shape !== page.shape) return false; // another one was opened before
    let place;
    if (!shape.volume) {
      const simplex = shape.simplexOf?.[hit.faceIndex] ?? hit.faceIndex,
        weights = b?.toArray() ?? [1, 0, 0];
      place = {
        simplex,
        coordinates: Array.from(
          cornersOf(shape, simplex),
          (v) => weights[triangle.indexOf(v)] ?? 0,
        ),
      };
    } else
      ({ place } = await engine.call('locate', { point: hit.point.toArray() }));
    if (!place) throw new Error('there is no tetrahedron at this place');
    const pivot = placeOf(place, shape.points); // in the rest shape
    const matrix = matrixOf(pivot, new THREE.Quaternion(), hit.point);
    // not with a number that a stroke has, whose turn is to come
    const used = shape.status.reduce((a, b) => Math.max(a, b), page.stroke ? page.paints : 0);
    while (shape.handles.length <= used - HANDLE) shape.handles.push(newHandle());
    shape.handles.push(newHandle({ pivot, matrix, point: place }));
    await hold();
    page.isHeld = true;
    setTool('grab');
    choose(shape.handles.length - 1);
  });
}
