// The page: follows the shape and draws it, frame by frame.
import { FREE, HANDLE } from './colors.js';
import { pump } from './follow.js';
import { choose } from './handles.js';
import { identity, rigidParts } from './motion.js';
import { open, openModel } from './opening.js';
import { setTool } from './painting.js';
import './keyboard.js';
import { actions } from './panel.js';
import { playFrame } from './playing.js';
import './pointers.js';
import { commandLine } from './saving.js';
import { $, engine, giveUp, measured, page, view } from './state.js';
import { steps } from './undo.js';

function frame(time) {
  requestAnimationFrame(frame);
  if (page.playing) playFrame(time);
  pump();
  if (view.isDirty) {
    view.render();
    ++measured.frames;
  }
}

const ready = engine.ready.then(async () => {
  if (matchMedia('(max-width: 700px)').matches) actions.more();
  try {
    $('help').hidden = localStorage.getItem('arap-help') === 'seen';
  } catch {
    /* not allowed for files */
  }
  await openModel('cactus');
  requestAnimationFrame(frame);
});
ready.catch((error) => giveUp(`The engine could not be started: ${error.message}.`));

// for tests and for tinkering
window.arap = {
  ready,
  state: () =>
    page.shape && {
      name: page.shape.name,
      vertices: page.shape.points.length / 3,
      simplices: page.shape.starts.length - 1,
      volume: page.shape.volume,
      fixed: page.shape.fixed,
      inverted: page.shape.inverted ?? 0,
      tool: page.tool,
      isSettled: page.isSettled && engine.isIdle,
      ...measured,
      ...steps(),
      keys: page.keys.length,
      message: $('message').hidden ? '' : $('message').innerText,
      handles: page.shape.handles.map((handle, k) => {
        const place = rigidParts(handle).place.toArray(),
          box = view.canvas.getBoundingClientRect(),
          [x, y] = view.toScreen(...place);
        return {
          number: k + 1,
          vertices: handle.size,
          point: !!handle.point,
          weight: handle.weight,
          matrix: handle.matrix.slice(),
          space: place,
          screen: [x + box.left, y + box.top],
        };
      }),
    },
  // how far vertices of hard handles are from their targets, relative to the diagonal
  distanceToTargets() {
    let worst = 0;
    const p = view.positions,
      r = page.shape.points;
    for (let v = 0; v < page.shape.status.length; ++v) {
      const s = page.shape.status[v],
        handle = page.shape.handles[s - HANDLE];
      if (s === FREE || (handle && handle.weight !== null)) continue;
      const m = handle?.matrix ?? identity();
      for (let i = 0; i < 3; ++i) {
        const target =
          m[4 * i] * r[3 * v] +
          m[4 * i + 1] * r[3 * v + 1] +
          m[4 * i + 2] * r[3 * v + 2] +
          m[4 * i + 3];
        worst = Math.max(worst, Math.abs(p[3 * v + i] - target) / page.shape.diagonal);
      }
    }
    return worst;
  },
  positions: () => view.positions.slice(),
  status: () => page.shape.status.slice(),
  open,
  openModel,
  setTool,
  choose,
  heap: async () => (await engine.call('heap')).bytes,
  commandLine,
  view,
  engine,
};
