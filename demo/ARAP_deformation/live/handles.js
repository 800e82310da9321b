// A handle is what is painted with one color, or one point in a face: it moves with its matrix,
// from the rest shape.
import { FIXED, HANDLE } from './colors.js';
import { drawMarks, placeGizmo } from './drawing.js';
import { cornersOf } from './faces.js';
import { center, fittedMotion, identity } from './motion.js';
import { changed, engine, page, view } from './state.js';

export function membersOf(k) {
  const list = [],
    { status } = page.shape.held;
  for (let v = 0; v < status.length; ++v) if (status[v] === k + HANDLE) list.push(v);
  return list;
}

// whether the shape is elsewhere than at rest, by more than single precision rounds
export const isDeformed = () => {
  const { points, diagonal } = page.shape;
  return view.positions.some((x, i) => Math.abs(x - points[i]) > 1e-5 * diagonal);
};

export function newHandle(rest = {}) {
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

export const messageOfHandles = () =>
  page.shape.handles.map(({ matrix, weight, turns, point }) => ({
    matrix,
    weight: weight ?? Infinity,
    turns,
    point,
  }));

export const hold = () =>
  engine.call('hold', { status: page.shape.held.status, handles: messageOfHandles() });

// the place of a point handle when the vertices are at these points
export function placeOf({ simplex, coordinates }, points) {
  const corners = cornersOf(page.shape, simplex);
  return [0, 1, 2].map((i) =>
    coordinates.reduce((sum, b, k) => sum + b * points[3 * corners[k] + i], 0),
  );
}

export const isThere = (handle) => handle.size > 0 || !!handle.point;

// the numbers of the handles that have vertices
export const handlesWithVertices = () =>
  [...page.shape.handles.keys()].filter((k) => page.shape.handles[k].size > 0);

// statuses for files: the handles with these numbers get others, without gaps
export function withoutGaps(status, numbers) {
  const place = new Map(numbers.map((k, i) => [k + HANDLE, i + HANDLE]));
  return status.map((s) => place.get(s) ?? s);
}

// the number of the first handle that is not there
export const nextHandle = () =>
  Array.from({ length: page.shape.handles.length + 1 }, (_, k) => k).find(
    (k) => !page.shape.handles[k] || !isThere(page.shape.handles[k]),
  );

// Holds what is painted by the strokes that have ended; hold() then tells the engine.
export function takePaint(fits) {
  page.shape.held.status = (page.stroke?.before ?? page.shape).status.slice();
  recountHandles(fits);
}

// which handles are held, and where they turn about
export function recountHandles(fits) {
  const { shape } = page;
  const sizes = new Map();
  let fixed = 0;
  for (const s of shape.held.status) {
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
    if (!size) {
      Object.assign(handle, newHandle());
      page.keys = page.keys.map((key) => key.map((m, j) => (j === k ? identity() : m)));
    }
    handle.size = size;
  });
  while (shape.handles.length && !isThere(shape.handles.at(-1))) shape.handles.pop();
  shape.fixed = fixed;
  page.isHeld = fixed > 0 || shape.handles.length > 0;
  if (
    page.chosen >= shape.handles.length ||
    (page.chosen >= 0 && !isThere(shape.handles[page.chosen]))
  )
    page.chosen = -1;
}

// a matrix for each handle
export const matrices = () => page.shape.handles.map((h) => h.matrix.slice());

// The key frames, for the handles that there are: those of later handles have none of these.
export const keyFrames = () =>
  page.keys.map((key) => page.shape.handles.map((_, k) => key[k] ?? identity()));

export function moveHandles(key) {
  page.shape.handles.forEach((h, k) => {
    h.matrix = key[k].slice();
  });
}

export function handlesMoved() {
  page.hasNewTargets = true;
  page.isSettled = false;
  drawMarks();
}

export function choose(k) {
  page.chosen = k;
  if (k >= 0 && !page.shape.handles[k].point) page.paints = k + HANDLE;
  placeGizmo();
  changed();
}
