// The panel: its tools and buttons, and what they show.
import {
  changeHandle,
  clearPaint,
  optionsChanged,
  removeHandle,
  reset,
  restFromNow,
  weightsChanged,
} from './actions.js';
import { FIXED, FREE, HANDLE, colorOf, css } from './colors.js';
import { measureChanged } from './drawing.js';
import { stopPlaying } from './follow.js';
import {
  handlesMoved,
  handlesWithVertices,
  keyFrames,
  moveHandles,
  nextHandle,
} from './handles.js';
import { formats, openFiles } from './importing.js';
import { closeHelp } from './messages.js';
import { models } from './models.js';
import { identity } from './motion.js';
import { openModel } from './opening.js';
import { paintWith, paintsRegions, setTool } from './painting.js';
import { addKey, film, play } from './playing.js';
import { saves } from './saving.js';
import { $, page, view, whenChanged } from './state.js';
import { commitSoon, redo, steps, undo } from './undo.js';

const shown = (id, text) => {
  $(id).parentElement.querySelector('output').textContent = text;
};
const weightText = () => (10 ** $('weight').value).toPrecision(2);

const icon = (path) =>
  `<svg viewBox="0 0 24 24" width="22" height="22" fill="none" stroke="currentColor" ` +
  `stroke-width="1.8" aria-hidden="true">${path}</svg>`;

export const tools = {
  grab: ['M12 3v18M3 12h18M9 6l3-3 3 3M9 18l3 3 3-3M6 9l-3 3 3 3M18 9l3 3-3 3', 'Grab', 'g'],
  brush: ['M20 4l-9 9M11 12c-3-1-5 1-5 4 0 2-1 3-3 3 4 3 10 1 10-5z', 'Brush', 'b'],
  box: ['M4 6h16v12H4z', 'Box', 'x'],
  lasso: ['M7 15c-6-2-4-10 5-10s11 8 5 10c-4 1-7 0-10 0zm0 0c-2 1-2 4 1 5', 'Lasso', 'l'],
  flood: ['M5 12l7-7 7 7-7 7zM5 12h14M20 15c2 3 2 5 0 5s-2-2 0-5', 'Flood', 'f'],
  point: ['M12 2v6M12 16v6M2 12h6M16 12h6M12 10.5a1.5 1.5 0 100 3 1.5 1.5 0 100-3', 'Point', 'p'],
  stiffness: ['M12 3l8 5v8l-8 5-8-5V8zM12 12l8-4M12 12v9M12 12L4 8', 'Stiff', 's'],
};

const button = (text, press) =>
  Object.assign(document.createElement('button'), { textContent: text, onclick: press });

const mark = (b, isOn) => b.setAttribute('aria-pressed', isOn);

// Shows a list as buttons. Those that are there stay, and with them the focus.
function showButtons(parent, list) {
  while (parent.children.length > list.length) parent.lastChild.remove();
  list.forEach(({ content, isOn, ...rest }, k) => {
    const b = Object.assign(parent.children[k] ?? parent.appendChild(button()), rest);
    if (b.content !== content) b.innerHTML = b.content = content;
    if (isOn !== undefined) mark(b, isOn);
  });
}

function showPanel() {
  for (const b of $('tools').children) mark(b, b.dataset.tool === page.tool);
  const { shape } = page;
  if (!shape) return;
  const region = (status, text) => ({
    title: '',
    content: `<i style="background:${css(colorOf(status))}"></i>${text}`,
    isOn: page.paints === status && paintsRegions(),
    onclick: () => paintWith(status),
  });
  const next = nextHandle();
  showButtons($('regions'), [
    region(FREE, 'Free'),
    { ...region(FIXED, 'Fixed'), title: 'What stays where it is at rest' },
    ...handlesWithVertices().map((k) => region(k + HANDLE, `Handle ${k + 1}`)),
    region(next + HANDLE, next ? 'New handle' : 'Handle 1'),
  ]);
  const handle = shape.handles[page.chosen];
  $('handle').hidden = !handle;
  if (handle) {
    $('handle').querySelector('h2').textContent = handle.point
      ? `Point ${page.chosen + 1}`
      : `Handle ${page.chosen + 1}`;
    $('soft').checked = handle.weight !== null;
    $('weight').disabled = handle.weight === null;
    if (handle.weight !== null) $('weight').value = Math.log10(handle.weight);
    $('frame').checked = handle.turns;
    $('frame').disabled = !!handle.point;
  }
  mark($('moves'), view.gizmo.mode === 'translate');
  mark($('turns'), view.gizmo.mode === 'rotate');
  $('undo').disabled = steps().undo <= 0;
  $('redo').disabled = steps().redo <= 0;
  $('name').textContent =
    `${shape.name}: ${(shape.points.length / 3).toLocaleString('en')} vertices, ` +
    `${(shape.starts.length - 1).toLocaleString('en')} ` +
    (shape.volume
      ? 'tetrahedra'
      : shape.simplices.length === 3 * (shape.starts.length - 1)
        ? 'triangles'
        : 'polygons');
  shown('brush', `${$('brush').value} px`);
  shown('weight', handle?.weight != null ? weightText() : 'hard');
  shown('bending', $('bending').value === '0' ? 'none' : `${$('bending').value}%`);
  shown('stiffness', `× ${10 ** $('stiffness').value}`);
  $('bending').disabled = $('cells').value === 'elements';
  $('up').textContent = `Up: ${view.up}`;
  showButtons(
    $('keys'),
    page.keys.map((_, i) => ({
      content: String(i + 1),
      title: 'Go there',
      onclick() {
        const key = keyFrames()[i];
        if (!key) return;
        stopPlaying();
        moveHandles(key);
        handlesMoved();
        commitSoon();
      },
    })),
  );
  $('play').textContent = page.playing ? 'Stop' : 'Play';
  view.isDirty = true;
}

for (const [id, [path, text, key]] of Object.entries(tools)) {
  const b = button('', () => setTool(id));
  b.title = `${text} (${key.toUpperCase()})`;
  b.innerHTML = `${icon(`<path d="${path}" stroke-linejoin="round"/>`)}${text}`;
  b.dataset.tool = id;
  $('tools').append(b);
}

for (const [id, [title]] of Object.entries(models)) $('model').append(new Option(title, id));
$('model').append(new Option('from a file', '', false, false));
$('model').lastChild.hidden = true;
for (const [text, press] of Object.entries(saves)) $('saves').append(button(text, press));

export const actions = {
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
  home: () => changeHandle({ matrix: identity() }),
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
  clear: clearPaint,
  more: () => {
    const closed = document.querySelector('main').classList.toggle('closed');
    $('more').setAttribute('aria-expanded', String(!closed));
  },
};

for (const [id, act] of Object.entries(actions)) $(id).onclick = act;
$('model').onchange = () => openModel($('model').value);
$('file').accept = formats.map((ending) => `.${ending}`).join();
$('file').onchange = () => {
  openFiles($('file').files);
  $('file').value = '';
};
for (const id of ['cells', 'minimizer', 'bending']) $(id).onchange = optionsChanged;
for (const id of ['bending', 'brush', 'stiffness']) $(id).oninput = showPanel;
$('weights').onchange = weightsChanged;
$('measure').onchange = measureChanged;
$('soft').onchange = () =>
  changeHandle({ weight: $('soft').checked ? 10 ** $('weight').value : null });
$('weight').onchange = () => changeHandle({ weight: 10 ** $('weight').value });
$('weight').oninput = () => shown('weight', weightText());
$('frame').onchange = () => changeHandle({ turns: $('frame').checked });

whenChanged(showPanel);
