// Opening a shape, from a file or a model, and selections and transforms for it.
import { FIXED, FREE, HANDLE } from './colors.js';
import { draw, measureChanged, placeGizmo } from './drawing.js';
import { boundary, startsOf, trianglesOf } from './faces.js';
import { endingOf, meshFormats, readMesh, readSelection, readTransforms } from './files.js';
import { stopPlaying } from './follow.js';
import {
  handlesMoved,
  handlesWithVertices,
  hold,
  isDeformed,
  isThere,
  recountHandles,
} from './handles.js';
import { busy, closeHelp, complain, say } from './messages.js';
import { models } from './models.js';
import { diagonalOf } from './motion.js';
import { options, sendOptions } from './options.js';
import { cancelStroke, setTool } from './painting.js';
import { $, engine, history, measured, page, view } from './state.js';
import { changing, commit, commitNow, forgetPast, inTurn } from './undo.js';

export const open = (mesh, name, note) =>
  inTurn(() => busy('Opening…', () => openInTurn(mesh, name, note)));

async function openInTurn({ points, simplices, corners, volume, status }, name, note) {
  const n = points.length / 3,
    starts = startsOf(simplices, corners),
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
      starts,
      volume,
      weights,
      ...(volume
        ? { faces: boundary(simplices, points) }
        : trianglesOf({ points, simplices, starts })),
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
    page.isSaved = true;
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

async function openMesh(file) {
  const mesh = await busy(
    `Reading ${file.name}…`,
    async () => readMesh(file.name, await file.arrayBuffer()),
    file.size > 1e6,
  );
  closeHelp();
  await open(
    mesh,
    file.name.replace(/\.\w+$/, ''),
    mesh.note || `${file.name}: paint what stays, then what you hold.`,
  );
  $('model').value = '';
}

// The selection is the only one: what was painted, and points, are gone.
async function openSelection(file) {
  const bytes = await file.arrayBuffer();
  closeHelp();
  await changing(async () => {
    const { shape } = page,
      status = readSelection(file.name, bytes, shape.status.length),
      fits = isDeformed();
    cancelStroke();
    Object.assign(shape, { status, handles: [] });
    page.chosen = -1;
    recountHandles(fits);
    page.chosen = shape.handles.findIndex(isThere);
    setTool('grab');
    await hold();
    say(`${file.name} was opened.`);
  });
}

// One file moves the handles, several are key frames, of which the last one moves them.
async function openTransforms(files) {
  const contents = await Promise.all(files.map((file) => file.arrayBuffer()));
  closeHelp();
  await changing(async () => {
    const { handles } = page.shape,
      numbers = handlesWithVertices();
    const keys = files.map(({ name }, i) => {
      const matrices = readTransforms(name, contents[i], numbers.length);
      return handles.map((h, k) => (h.size ? matrices[numbers.indexOf(k)] : h.matrix.slice()));
    });
    handles.forEach((h, k) => {
      h.matrix = keys.at(-1)[k].slice();
    });
    if (keys.length > 1) page.keys = keys;
    await hold();
    say(keys.length > 1 ? `${keys.length} key frames were opened.` : `${files[0].name} was opened.`);
  });
}

// a mesh, and a selection and transforms for it or for what is open
export async function openFiles(list) {
  const files = [...list].sort((a, b) => a.name.localeCompare(b.name, 'en', { numeric: true })),
    of = (...endings) => files.filter(({ name }) => endings.includes(endingOf(name))),
    meshes = of(...meshFormats),
    selections = of('sel'),
    transforms = of('def');
  try {
    const other = files.find((file) => ![...meshes, ...selections, ...transforms].includes(file));
    if (other)
      throw new Error(`${other.name}: only .off, .obj, .ply, .stl, .mesh, .sel and .def files are read.`);
    if (meshes.length > 1 || selections.length > 1)
      throw new Error('these are too many files: a shape has one mesh and one selection');
    if (meshes.length) await openMesh(meshes[0]);
    if (selections.length) await openSelection(selections[0]);
    if (transforms.length) await openTransforms(transforms);
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
  openFiles(event.dataTransfer.files);
});
