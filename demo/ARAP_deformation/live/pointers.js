// Mouse, pen and fingers in the view.
import { HANDLE } from './colors.js';
import { placeGizmo } from './drawing.js';
import { choose, handlesMoved, nextHandle } from './handles.js';
import { closeHelp } from './messages.js';
import { matrixOf, rigidParts } from './motion.js';
import {
  brushAt,
  cancelStroke,
  drawStroke,
  paint,
  paintArea,
  painted,
  placePoint,
} from './painting.js';
import { flood, nearestSeen } from './regions.js';
import { $, page, view } from './state.js';
import { commitNow, commitSoon, inTurn } from './undo.js';
import { THREE } from './view.js';

const pointers = new Set();
let point = null; // where a finger or button went down to place one, { id, x, y }

const at = (event) => {
  const box = view.canvas.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
};

function pressed(event) {
  point = null;
  if (event.target !== view.canvas || !page.shape) return;
  view.canvas.focus({ preventScroll: true });
  pointers.add(event.pointerId);
  if (pointers.size > 1) {
    // two fingers change the view
    cancelStroke();
    endDrag(true);
    return;
  }
  view.letTurn(true);
  view.letMove(page.tool === 'grab'); // one finger turns the view
  if (event.button !== 0 || page.playing) return;
  const [x, y] = at(event);
  if (page.tool === 'grab') {
    const { clientWidth: w, clientHeight: h } = view.container;
    if (page.chosen >= 0)
      view.gizmo.pointerHover({ x: (2 * x) / w - 1, y: 1 - (2 * y) / h, button: -1 });
    if (page.chosen >= 0 && view.gizmo.axis) return view.letTurn(false);
    const k = handleAt(x, y, event.pointerType === 'touch' ? 30 : 16);
    if (!page.shape.handles[k]) return; // or it is still to come
    view.letTurn(false);
    choose(k);
    grab(event, x, y, k);
    return;
  }
  const screen = view.screen();
  if (page.tool !== 'box' && page.tool !== 'lasso' && !screen.isOn(x, y)) return; // the view turns
  view.letTurn(false);
  if (page.tool === 'point') {
    point = { id: event.pointerId, x, y };
    return;
  }
  if (page.shape.handles[page.paints - HANDLE]?.point) page.paints = nextHandle() + HANDLE;
  page.stroke = {
    before: {
      status: page.shape.status.slice(),
      stiffness: page.shape.stiffness?.slice() ?? null,
    },
    id: event.pointerId,
  };
  view.canvas.setPointerCapture(event.pointerId);
  if (page.tool === 'flood') {
    const seed = nearestSeen(screen, x, y, 60);
    if (seed >= 0) paint(flood(page.shape, seed));
  } else if (page.tool === 'box' || page.tool === 'lasso') page.stroke.path = [[x, y]];
  else brushAt(x, y);
  drawStroke(x, y);
}

function handleAt(x, y, within) {
  let best = -1,
    least = within;
  page.shape.handles.forEach((handle, k) => {
    if (!handle.point) return;
    const [a, b] = view.toScreen(...rigidParts(handle).place),
      d = Math.hypot(a - x, b - y);
    if (d < least) {
      least = d;
      best = k;
    }
  });
  if (best >= 0 || !page.shape.handles.length) return best;
  const v = nearestSeen(view.screen(), x, y, within, (w) => page.shape.status[w] >= HANDLE);
  return v < 0 ? -1 : page.shape.status[v] - HANDLE;
}

// in the plane of the screen through the handle
function grab(event, x, y, k) {
  const { place, q } = rigidParts(page.shape.handles[k]);
  const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(
    view.camera.getWorldDirection(new THREE.Vector3()),
    place,
  );
  const hit = (a, b) => view.ray(a, b).ray.intersectPlane(plane, new THREE.Vector3());
  const start = hit(x, y);
  if (!start) return;
  view.canvas.setPointerCapture(event.pointerId);
  page.dragging = {
    id: event.pointerId,
    k,
    before: page.shape.handles[k].matrix,
    hasMoved: false,
    to: (a, b) => {
      const p = hit(a, b),
        handle = page.shape.handles[k];
      if (!p || !handle) return;
      handle.matrix = matrixOf(handle.pivot, q, p.sub(start).add(place));
      page.dragging.hasMoved = true;
      handlesMoved();
    },
  };
}

// The motion is a step that can be undone, unless it is cancelled.
export function endDrag(isCancelled = false) {
  if (!page.dragging) return;
  const { k, before, hasMoved } = page.dragging;
  page.dragging = null;
  if (view.gizmo.dragging) view.gizmo.pointerUp(null);
  const handle = page.shape.handles[k];
  if (isCancelled && hasMoved && handle) {
    handle.matrix = before;
    handlesMoved();
  }
  placeGizmo();
  if (hasMoved && !isCancelled) {
    closeHelp();
    commitSoon();
  }
  page.isSettled = false;
}

function movedTo(event) {
  if (!page.shape) return;
  const [x, y] = at(event);
  if (page.dragging?.to && page.dragging.id === event.pointerId) return page.dragging.to(x, y);
  if (page.stroke && page.stroke.id === event.pointerId) {
    if (page.stroke.path) page.stroke.path.push([x, y]);
    else if (page.tool !== 'flood') brushAt(x, y);
  }
  if (page.stroke || event.pointerType !== 'touch') drawStroke(x, y);
}

function released(event) {
  pointers.delete(event.pointerId);
  const isCancelled = event.type === 'pointercancel';
  if (point?.id === event.pointerId) {
    if (!isCancelled && page.shape && page.tool === 'point') placePoint(point.x, point.y);
    point = null;
  }
  if (page.dragging?.to ? page.dragging.id === event.pointerId : isCancelled)
    endDrag(isCancelled);
  if (!page.stroke || page.stroke.id !== event.pointerId) return;
  if (isCancelled) return cancelStroke();
  if (page.stroke.path) paintArea();
  const { hasPainted } = page.stroke;
  page.stroke = null;
  drawStroke();
  if (hasPainted) painted();
}

addEventListener('pointerdown', () => inTurn(commitNow), true);

$('view').addEventListener('pointerdown', pressed, true);

addEventListener('pointermove', movedTo);

addEventListener('pointerup', released);

addEventListener('pointercancel', released);

$('view').addEventListener('pointerleave', () => !page.stroke && drawStroke());

$('view').addEventListener('contextmenu', (event) => event.preventDefault());

view.gizmo.addEventListener('objectChange', () => {
  const handle = page.shape?.handles[page.chosen];
  if (!handle) return;
  handle.matrix = matrixOf(handle.pivot, view.proxy.quaternion, view.proxy.position);
  if (page.dragging) page.dragging.hasMoved = true;
  handlesMoved();
});

view.gizmo.addEventListener('dragging-changed', ({ value }) => {
  view.orbit.enabled = !value;
  if (!value) return endDrag();
  const k = page.chosen;
  page.dragging = { k, before: page.shape.handles[k].matrix, hasMoved: false };
});
