// Opening a shape.
import { FIXED, FREE, HANDLE } from './colors.js';
import { draw, measureChanged, placeGizmo } from './drawing.js';
import { boundary, startsOf, trianglesOf } from './faces.js';
import { stopPlaying } from './follow.js';
import { handlesMoved, hold, isThere, takePaint } from './handles.js';
import { busy, complain, say } from './messages.js';
import { models } from './models.js';
import { diagonalOf, originOf, shifted } from './motion.js';
import { options } from './options.js';
import { cancelStroke, setTool } from './painting.js';
import { $, engine, hasUnsavedWork, history, measured, page, view } from './state.js';
import { commit, commitNow, forgetPast, inTurn } from './undo.js';

export const open = (mesh, name, rest) =>
  inTurn(() => busy('Opening…', () => openInTurn(mesh, name, rest)));

// Ends what the user and the shape are about.
export async function stopAll() {
  if (view.gizmo.dragging) view.gizmo.pointerUp(null);
  await (page.dragging?.hasMoved ? commit() : commitNow());
  stopPlaying();
  cancelStroke();
  page.dragging = null;
}

// what is to be done first with what is painted
export function chooseTool() {
  const { handles, fixed } = page.shape;
  page.chosen = handles.findIndex(isThere);
  page.paints = fixed ? HANDLE : FIXED;
  setTool(handles.length ? 'grab' : 'brush');
}

export async function openInTurn(
  { points: given, simplices, corners, volume, status, origin = originOf(given) },
  name,
  { note = '', model = '' } = {},
) {
  const n = given.length / 3,
    points = shifted(given, origin, -1),
    starts = startsOf(simplices, corners),
    weights = $('weights').value;
  if (!n || !simplices.length) throw new Error(`${name} has no faces`);
  const opened = {
    name,
    model,
    points,
    origin,
    simplices,
    starts,
    volume,
    weights,
    ...(volume ? { faces: boundary(simplices, points) } : trianglesOf({ points, simplices, starts })),
    handles: [],
    status: status?.slice() ?? new Int32Array(n).fill(FREE),
    stiffness: null,
    diagonal: diagonalOf(points),
  };
  opened.held = { stiffness: null, options: options(opened) };
  await stopAll();
  const { shape, chosen } = page;
  $('model').value = shape?.model ?? '';
  if (
    hasUnsavedWork() &&
    !confirm(`${shape.name} was changed and not saved. Open ${name} instead?`)
  )
    throw new Error(`${name} was not opened`);
  Object.assign(page, { shape: null, chosen: -1 }); // nothing takes input meanwhile
  const parts = document.querySelectorAll('header, main'),
    focused = document.activeElement;
  parts.forEach((part) => {
    part.inert = true;
  });
  placeGizmo();
  let isHalfOpen = false; // the engine has it, but not the page
  try {
    await engine.call('open', {
      points,
      simplices,
      corners,
      volume,
      weights,
      options: opened.held.options,
    });
    isHalfOpen = true;
    page.shape = opened;
    forgetPast();
    page.keys = [];
    page.spare = null;
    page.failed = '';
    Object.assign(measured, { energy: NaN, milliseconds: NaN, perIteration: n / 10000 });
    history.energy.length = history.milliseconds.length = 0;
    view.setShape(points, page.shape.faces);
    view.fit();
    $('measure').value = '';
    measureChanged();
    takePaint(false);
    await hold();
    chooseTool();
    page.isSettled = true;
    draw();
    await commit();
    page.isSaved = true;
    say(note);
    // the first step does all that is done once, before anything is dragged
    if (page.shape.handles.length && n < 150000) handlesMoved();
    isHalfOpen = false;
  } catch (error) {
    if (!isHalfOpen) throw error;
    Object.assign(page, { shape: null, chosen: -1 });
    throw new Error(`${name} could not be opened (${error.message}): open another shape`);
  } finally {
    if (!page.shape && !isHalfOpen) Object.assign(page, { shape, chosen });
    $('model').value = page.shape?.model ?? '';
    parts.forEach((part) => {
      part.inert = false;
    });
    for (const id of ['tools', 'panel']) $(id).inert = !page.shape;
    focused?.focus({ preventScroll: true });
    placeGizmo();
  }
}

export async function openModel(id) {
  try {
    const [title, make] = models[id];
    await open(make(), title.toLowerCase().replace(/ /g, '_'), { model: id });
  } catch (error) {
    complain(error);
  }
}
