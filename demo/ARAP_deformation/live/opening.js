// Opening a shape, from a file or a model.
import { FIXED, FREE, HANDLE } from './colors.js';
import { draw, measureChanged, placeGizmo } from './drawing.js';
import { boundary, readMesh } from './files.js';
import { stopPlaying } from './follow.js';
import { handlesMoved, hold, isThere, recountHandles } from './handles.js';
import { busy, closeHelp, complain, say } from './messages.js';
import { models } from './models.js';
import { diagonalOf } from './motion.js';
import { options, sendOptions } from './options.js';
import { cancelStroke, setTool } from './painting.js';
import { $, engine, history, measured, page, view } from './state.js';
import { commit, commitNow, forgetPast, inTurn } from './undo.js';

export const open = (mesh, name, note) =>
  inTurn(() => busy('Opening…', () => openInTurn(mesh, name, note)));

async function openInTurn({ points, simplices, corners, volume, status }, name, note) {
  const n = points.length / 3,
    weights = $('weights').value;
  if (!n || !simplices.length) throw new Error(`${name} has no faces`);
  if (view.gizmo.dragging) view.gizmo.pointerUp(null);
  await commitNow();
  stopPlaying();
  cancelStroke();
  page.dragging = null;
  const { shape, chosen } = page;
  Object.assign(page, { shape: null, chosen: -1 }); // nothing takes input meanwhile
  const parts = document.querySelectorAll('header, main'),
    focused = document.activeElement;
  parts.forEach((part) => {
    part.inert = true;
  });
  placeGizmo();
  try {
    await engine.call('open', { points, simplices, corners, volume, weights });
    page.shape = {
      name,
      points,
      simplices,
      corners,
      volume,
      weights,
      faces: volume ? boundary(simplices, points) : simplices,
      handles: [],
      status: status?.slice() ?? new Int32Array(n).fill(FREE),
      stiffness: null,
      diagonal: diagonalOf(points),
    };
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
    recountHandles(false);
    await sendOptions(options());
    await hold();
    if (page.shape.handles.length) page.chosen = page.shape.handles.findIndex(isThere);
    page.paints = page.shape.fixed ? HANDLE : FIXED;
    setTool(page.shape.handles.length ? 'grab' : 'brush');
    page.isSettled = true;
    draw();
    await commit();
    say(note ?? '');
    // the first step does all that is done once, before anything is dragged
    if (page.shape.handles.length && n < 150000) handlesMoved();
  } finally {
    if (!page.shape) Object.assign(page, { shape, chosen });
    parts.forEach((part) => {
      part.inert = false;
    });
    focused?.focus({ preventScroll: true });
    placeGizmo();
  }
}

export async function openFile(file) {
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

export async function openModel(id) {
  try {
    const [title, make] = models[id];
    $('model').value = id;
    await open(make(), title.toLowerCase().replace(/ /g, '_'));
  } catch (error) {
    complain(error);
  }
}

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
