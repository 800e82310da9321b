// Files that are saved, and the command that does the same with them.
import { writeMesh, writeSelection, writeTransforms } from './files.js';
import { handlesWithVertices, keyFrames, withoutGaps } from './handles.js';
import { complain, say } from './messages.js';
import { diagonalOf, shifted, shiftedMotion } from './motion.js';
import { options } from './options.js';
import { engine, hasUnsavedWork, page, view } from './state.js';

export function save(name, content, note = '') {
  const url = URL.createObjectURL(
    content instanceof Blob ? content : new Blob([content], { type: 'text/plain' }),
  );
  Object.assign(document.createElement('a'), { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
  say(`${name} was saved${note}.`);
}

// the handles of the files, which are numbered without gaps and have vertices
function filed() {
  const numbers = handlesWithVertices();
  return { numbers, status: withoutGaps(page.shape.held.status, numbers) };
}

// for a shell; where it cannot tell all, a second line has what is left out
export function commandLine() {
  const { name, volume, weights } = page.shape,
    { cells, minimizer, bending_length } = options(),
    diagonal = diagonalOf(page.shape.points), // of the rest shape that is saved
    ending = volume ? 'mesh' : 'off',
    held = filed().numbers.map((k) => page.shape.handles[k]),
    path = name.replace(/^-/, './-'); // not an option
  const file = (end) =>
    /^[\w./-]+$/.test(path) ? path + end : `'${(path + end).replaceAll("'", "'\\''")}'`;
  const differ = (what) => held.some((handle) => handle[what] !== held[0][what]);
  const ofAll = (what) => (held.length && !differ(what) ? held[0][what] : null);
  const untold = [
    differ('weight') && 'weights that differ between handles',
    differ('turns') && 'which handles turn the cells around them',
    page.shape.stiffness?.some((k) => k !== 1) && 'painted stiffness',
    page.shape.handles.some((handle) => handle.point) && 'handles that are points in a face',
  ].filter(Boolean);
  return (
    `arap_deform ${file(`_rest.${ending}`)} -o out.${ending} --selection ${file('.sel')}` +
    (held.length ? ` --transform ${file('.def')}` : '') +
    ` --cells ${cells} --weights ${weights}` +
    ` --minimizer ${minimizer} --bending ${+(bending_length / diagonal).toPrecision(10)}` +
    (ofAll('weight') === null ? '' : ` --soft ${ofAll('weight')}`) +
    (ofAll('turns') ? ' --turn' : '') +
    (untold.length ? `\nThis line leaves out: ${untold.join(', ')}.` : '')
  );
}

const inFile = (matrix) => shiftedMotion(matrix, page.shape.origin, 1);

// f gets the numbers of the handles with vertices
const ofHandles = (f) => () => {
  const numbers = handlesWithVertices();
  if (!numbers.length) return say('There is no handle with vertices, and so no transform.', true);
  f(numbers);
};

async function saveMesh(ending, which, suffix) {
  const { shape } = page, // another one may be opened meanwhile
    isWork = which === 'points',
    isCut = ending === 'mesh' && !!shape.simplexOf; // which polygons have
  if (isWork) page.isSaved = true; // what is done from now on is not
  try {
    const answer = await engine.call('points');
    save(
      `${shape.name}${suffix}.${ending}`,
      writeMesh(ending, { ...shape, points: shifted(answer[which], shape.origin, 1) }),
      isCut ? ', with its polygons cut into triangles' : '',
    );
  } catch (error) {
    if (isWork && shape === page.shape) page.isSaved = false;
    complain(error);
  }
}

export const saves = {
  'Mesh .off': () => saveMesh('off', 'points', ''),
  '.obj': () => saveMesh('obj', 'points', ''),
  '.mesh': () => saveMesh('mesh', 'points', ''),
  'Rest shape': () => saveMesh(page.shape.volume ? 'mesh' : 'off', 'rest', '_rest'),
  Selection: () => save(`${page.shape.name}.sel`, writeSelection(filed().status, commandLine())),
  Transforms: ofHandles((numbers) =>
    save(
      `${page.shape.name}.def`,
      writeTransforms(numbers.map((k) => inFile(page.shape.handles[k].matrix))),
    ),
  ),
  'Key frames': ofHandles((numbers) => {
    if (!page.keys.length)
      return say('There is no key frame: move a handle, and choose Add.', true);
    keyFrames().forEach((key, i) =>
      save(
        `${page.shape.name}-${i + 1}.def`,
        writeTransforms(numbers.map((k) => inFile(key[k]))),
      ),
    );
  }),
  Picture: () => {
    const { name } = page.shape,
      shown = view.gizmo.getHelper().visible;
    view.gizmo.getHelper().visible = false;
    view.render();
    view.canvas.toBlob((blob) =>
      blob ? save(`${name}.png`, blob) : say('The picture could not be made.', true),
    );
    view.gizmo.getHelper().visible = shown;
    view.isDirty = true;
  },
};

addEventListener('beforeunload', (event) => {
  if (hasUnsavedWork()) {
    event.preventDefault();
    event.returnValue = true; // browsers before 2023
  }
});
