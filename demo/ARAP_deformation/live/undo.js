// Undo and redo.
import { draw } from './drawing.js';
import { pump, stopPlaying } from './follow.js';
import { hold, recountHandles } from './handles.js';
import { complain, say } from './messages.js';
import { sendOptions, sendStiffness, showOptions } from './options.js';
import { changed, engine, page, view } from './state.js';

let past = [],
  now = -1,
  timer = 0; // of a commit to come

// how many steps can be undone, and done again
export const steps = () => ({ undo: now, redo: past.length - 1 - now });

// Runs what changes the shape, or opens another one, one after the other.
let last = Promise.resolve();
export const inTurn = (f) => (last = last.then(f, f));

// to be called when another session begins
export function forgetPast() {
  clearTimeout(timer);
  timer = 0;
  past = [];
  now = -1;
}

export async function commit() {
  clearTimeout(timer);
  timer = 0;
  const { shape } = page;
  if (!shape) return;
  page.isSaved = false;
  const kept = {
    held: { ...shape.held },
    keys: page.keys.slice(),
    chosen: page.chosen,
    handles: structuredClone(shape.handles),
  };
  const dropped = past.splice(now + 1);
  past.push(kept);
  now = past.length - 1;
  const largest = Math.max(3, Math.min(60, Math.floor(1.2e7 / shape.points.length)));
  while (past.length > largest) {
    dropped.push(past.shift());
    --now;
  }
  changed();
  kept.state = engine.call('keep').then(
    (answer) => answer.state,
    () => null,
  );
  for (const old of dropped)
    old.state.then(
      (state) => shape === page.shape && state && engine.call('forget', { state }).catch(() => {}),
    );
  await kept.state;
}

// Commits after what is under way, whose step it then joins; with a delay, once no key has been
// pressed for that long.
export function commitSoon(milliseconds = 0) {
  clearTimeout(timer);
  timer = setTimeout(() => inTurn(commitNow), milliseconds);
}

// before anything else is changed, so that it is a step of its own; for what has its turn
export async function commitNow() {
  if (timer) await commit();
}

// Runs what changes the shape, which then follows. What fails is undone; what returns false has
// changed nothing, and is no step. For what has its turn.
export async function change(f, stops = true) {
  if (stops) stopPlaying();
  try {
    if ((await f()) === false) return;
    page.failed = '';
    page.isSettled = false;
    page.hasNewTargets = page.shape.handles.length > 0;
    draw();
    await commit();
    pump();
  } catch (error) {
    complain(error);
    clearTimeout(timer);
    timer = 0;
    // and what the pointer is about, which began after it
    page.dragging = page.stroke = null;
    if (view.gizmo.dragging) view.gizmo.pointerUp(null);
    await goTo(now);
  }
}

export const changing = (f, stops) => inTurn(() => change(f, stops));

async function goTo(index) {
  if (index < 0 || index >= past.length || page.dragging || page.stroke) return;
  stopPlaying();
  const kept = past[index],
    state = await kept.state;
  if (!state) {
    if (index === now) return;
    past.splice(index, 1);
    if (index < now) --now;
    changed();
    return say('There was not enough memory to keep this step.', true);
  }
  if (index !== now) page.isSaved = false;
  now = index;
  const { held } = page.shape,
    { status, stiffness, options } = kept.held;
  try {
    held.status = status;
    Object.assign(page.shape, {
      status: status.slice(),
      handles: structuredClone(kept.handles),
      stiffness: stiffness?.slice() ?? null,
    });
    page.keys = kept.keys.slice();
    page.isSettled = true;
    page.hasNewTargets = false;
    // options and stiffness first: the state has the rotations of their cells
    if (JSON.stringify(options) !== JSON.stringify(held.options)) {
      await sendStiffness(null); // it may be of other cells
      showOptions(options);
      await sendOptions(options);
    }
    // to set it costs a factorization
    if (stiffness !== held.stiffness) await sendStiffness(stiffness);
    const { points, rest } = await engine.call('restore', { state });
    page.shape.points = rest;
    page.spare = view.setPositions(points);
  } catch (error) {
    complain(error);
    // the handles are those of this step; the shape follows them from where it is
    showOptions(held.options);
    page.shape.stiffness = held.stiffness?.slice() ?? null;
    await hold().catch(complain);
  }
  page.chosen = kept.chosen;
  recountHandles(false);
  page.isSettled = false;
  page.hasNewTargets = page.shape.handles.length > 0;
  draw();
  pump();
}

const step = (by) =>
  inTurn(async () => {
    await commitNow();
    await goTo(now + by);
  });

export const undo = () => step(-1),
  redo = () => step(1);
