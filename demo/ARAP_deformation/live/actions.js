// What buttons and keys do with the shape that is open.
import { FREE, HANDLE } from './colors.js';
import { placeGizmo } from './drawing.js';
import { stopPlaying } from './follow.js';
import {
  handlesMoved,
  hold,
  isThere,
  membersOf,
  messageOfHandles,
  placeOf,
  takePaint,
} from './handles.js';
import { busy, say } from './messages.js';
import { center, identity, matrixOf, rigidParts } from './motion.js';
import { chooseTool } from './opening.js';
import { cellStiffness, options, sendOptions, sendStiffness, showOptions } from './options.js';
import { cancelStroke, painted, setTool } from './painting.js';
import { endDrag } from './pointers.js';
import { $, engine, page, view } from './state.js';
import { changing, commitSoon, forgetPast } from './undo.js';
import { THREE } from './view.js';

// while a film goes on
export const optionsChanged = () =>
  changing(async () => {
    if ($('cells').value === 'elements') $('bending').value = 0;
    const wanted = options(),
      isOfElements = wanted.cells === 'elements',
      wasOfElements = page.shape.held.options.cells === 'elements';
    if (isOfElements !== wasOfElements && page.shape.stiffness) {
      cancelStroke();
      page.shape.stiffness = null;
      await sendStiffness(null);
      say('The painted stiffness was of other cells, and is cleared.');
    }
    await sendOptions(wanted).catch((error) => {
      showOptions(page.shape.held.options);
      throw error;
    });
  }, false);

export async function weightsChanged() {
  await changing(async () => {
    const weights = $('weights').value;
    await busy('Weights…', () =>
      engine.call('weights', {
        weights,
        handles: messageOfHandles(),
        options: page.shape.held.options,
        stiffness: cellStiffness(page.shape.held.stiffness),
      }),
    );
    page.shape.weights = weights;
    forgetPast();
  });
  $('weights').value = page.shape.weights;
}

// f for the handle that is chosen now and its number, unless it is gone when its turn comes
function ofChosen(f) {
  const { shape, chosen } = page;
  return () => {
    const handle = shape === page.shape && shape.handles[chosen];
    return !!handle && isThere(handle) && f(handle, chosen);
  };
}

export function changeHandle(to) {
  if (!page.shape?.handles[page.chosen]) return;
  changing(
    ofChosen((handle) => {
      Object.assign(handle, to);
      return hold();
    }),
  );
}

export async function removeHandle() {
  if (!page.shape?.handles[page.chosen]) return;
  cancelStroke();
  setTool('grab');
  await painted(
    ofChosen((handle, k) => {
      cancelStroke();
      const { status } = page.shape; // strokes that wait for their turn may have taken some
      for (const v of membersOf(k)) if (status[v] === k + HANDLE) status[v] = FREE;
      handle.point = null;
    }),
  );
}

export const clearPaint = () =>
  changing(async () => {
    cancelStroke();
    endDrag(true);
    page.shape.status.fill(FREE);
    page.shape.handles = [];
    page.keys = [];
    takePaint(false);
    chooseTool();
    const { points } = await engine.call('reset');
    page.spare = view.setPositions(points);
    await hold();
  });

export const reset = () =>
  changing(async () => {
    endDrag(true);
    page.shape.handles.forEach((h) => {
      h.matrix = identity();
    });
    const { points } = await engine.call('reset');
    page.spare = view.setPositions(points);
  });

export const restFromNow = () =>
  changing(async () => {
    const { rest } = await engine.call('rest');
    endDrag(true); // it was of the old rest shape
    page.shape.points = rest;
    page.shape.handles.forEach((handle, k) => {
      if (handle.point) handle.pivot = placeOf(handle.point, rest);
      else if (handle.size) handle.pivot = center(rest, membersOf(k));
      handle.matrix = identity();
    });
    page.keys = [];
    await hold();
    say('This is the rest shape from now on.');
  });

export function moveByKey(key, turns) {
  const handle = page.shape?.handles[page.chosen],
    direction = {
      ArrowLeft: [-1, 0, 0],
      ArrowRight: [1, 0, 0],
      ArrowUp: [0, 1, 0],
      ArrowDown: [0, -1, 0],
      PageUp: [0, 0, -1],
      PageDown: [0, 0, 1],
    }[key];
  if (!handle || !direction) return false;
  stopPlaying();
  const { q, place } = rigidParts(handle),
    axis = new THREE.Vector3(...direction).transformDirection(view.camera.matrixWorld);
  if (turns) q.premultiply(new THREE.Quaternion().setFromAxisAngle(axis, Math.PI / 36));
  else place.addScaledVector(axis, 0.01 * page.shape.diagonal);
  handle.matrix = matrixOf(handle.pivot, q, place);
  handlesMoved();
  placeGizmo();
  commitSoon(400);
  return true;
}
