// Files that are chosen or dropped: a mesh, and a selection and transforms for it or for what is
// open.
import { HANDLE } from './colors.js';
import { endingOf, meshFormats, readMesh, readSelection, readTransforms } from './files.js';
import {
  handlesWithVertices,
  hold,
  isDeformed,
  matrices,
  moveHandles,
  takePaint,
  withoutGaps,
} from './handles.js';
import { busy, closeHelp, complain, say } from './messages.js';
import { originOf, shiftedMotion } from './motion.js';
import { chooseTool, openInTurn, stopAll } from './opening.js';
import { engine, page } from './state.js';
import { change, inTurn } from './undo.js';

export const formats = [...meshFormats, 'sel', 'def'];

const mostHandles = 99;

// with handles that are numbered without gaps, and which numbers they have in the file
function selectionOf({ name, bytes }, n) {
  const status = readSelection(name, bytes, n),
    handles = [...new Set(status)].filter((s) => s >= HANDLE),
    numbers = handles.map((s) => s - HANDLE).sort((a, b) => a - b);
  if (numbers.length > mostHandles)
    throw new Error(`${name} has ${numbers.length} handles, this page takes ${mostHandles}`);
  return { status: withoutGaps(status, numbers), numbers };
}

// Replaces what is painted, and points.
function select(status) {
  const fits = isDeformed();
  Object.assign(page.shape, { status, handles: [] });
  page.keys = [];
  takePaint(fits);
  chooseTool();
}

// Each key has a matrix for each handle with vertices. Several keys are key frames.
function pose(keys) {
  const numbers = handlesWithVertices(),
    all = keys.map((key) =>
      matrices().map((matrix, k) => key[numbers.indexOf(k)] ?? matrix),
    );
  moveHandles(all.at(-1));
  if (all.length > 1) page.keys = all;
}

async function openTogether(mesh, meshName, selection, transforms) {
  const shape = mesh ?? page.shape;
  if (!shape) throw new Error('no shape is open');
  const origin = mesh ? originOf(mesh.points) : shape.origin;
  // what is wrong with a file changes nothing
  const selected = selection && selectionOf(selection, shape.points.length / 3),
    numbers = selected?.numbers ?? (mesh ? [] : handlesWithVertices().map((_, i) => i)),
    keys = transforms.map(({ name, bytes }) => {
      const key = readTransforms(name, bytes, numbers.length && numbers.at(-1) + 1, (matrix) =>
        shiftedMotion(matrix, origin, -1),
      );
      return numbers.map((k) => key[k]);
    });
  if (mesh)
    await openInTurn(
      { ...mesh, origin, status: selected?.status },
      meshName.replace(/(_rest)?\.\w+$/, ''), // the rest shape that was saved
      { note: mesh.note || (selected ? '' : `${meshName}: paint what stays, then what you hold.`) },
    );
  if (!keys.length && (mesh || !selected)) return;
  await stopAll();
  await change(async () => {
    if (!mesh && selected) select(selected.status);
    if (keys.length) pose(keys);
    await hold();
    const names = [selection, ...transforms].map((file) => file?.name).filter(Boolean);
    say(`Opened: ${names.join(', ')}. ${mesh?.note ?? ''}`.trim());
  });
  if (mesh) page.isSaved = true;
}

export async function openFiles(list) {
  const files = [...list].sort((a, b) => a.name.localeCompare(b.name, 'en', { numeric: true })),
    of = (...endings) => files.filter(({ name }) => endings.includes(endingOf(name)));
  try {
    await engine.ready;
  } catch {
    return; // the page has said it
  }
  try {
    const other = files.find(({ name }) => !formats.includes(endingOf(name)));
    if (other) throw new Error(`${other.name}: only .${formats.join(', .')} files are read`);
    const [meshFile, ...meshes] = of(...meshFormats),
      [selectionFile, ...selections] = of('sel');
    if (meshes.length || selections.length)
      throw new Error('these are too many files: a shape has one mesh and one selection');
    if (!files.length) return;
    const contentOf = async (file) => ({ name: file.name, bytes: await file.arrayBuffer() }),
      mesh =
        meshFile &&
        (await busy(
          `Reading ${meshFile.name}…`,
          async () => readMesh(meshFile.name, await meshFile.arrayBuffer()),
          meshFile.size > 1e6,
        )),
      selection = selectionFile && (await contentOf(selectionFile)),
      transforms = await Promise.all(of('def').map(contentOf));
    closeHelp();
    await inTurn(() =>
      busy('Opening…', () => openTogether(mesh, meshFile?.name, selection, transforms)),
    );
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
