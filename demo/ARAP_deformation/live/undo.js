// Undo and redo.
import { draw } from './drawing.js';
import { pump, stopPlaying } from './follow.js';
import { heldStatus, recountHandles } from './handles.js';
import { complain, say } from './messages.js';
import { cellStiffness, heldStiffness, options, sendOptions, showOptions } from './options.js';
import { changed, engine, page, view } from './state.js';

let past = [],
  now = -1,
  timer = 0, // of a commit to come
  isSure = true; // that the engine has the options and the stiffness of now

// how many steps can be undone, and done again
export const steps = () => ({ undo: now, redo: past.length - 1 - now });

export const optionsOfNow = () => past[now].options;

// Runs what changes the shape, or opens another one, one after the other.
let last = Promise.resolve();
export const inTurn = (f) => (last = last.then(f, f));

// to be called when another session begins
export function forgetPast() {
  clearTimeout(timer);
  timer = 0;
  past = [];
  now = -1;
  isSure = true;
}

export async function commit() {
  clearTimeout(timer);
  timer = 0;
  const { shape } = page;
  if (!shape) return;
  page.isSaved = false;
  const stiffness = heldStiffness(),
    before = past[now]?.stiffness;
  const kept = {
    status: heldStatus().slice(),
    // the same object where it is the same: to set it costs a factorization
    stiffness: stiffness && before?.every((k, v) => k === stiffness[v]) ? before : stiffness?.slice(),
    keys: page.keys.slice(),
    chosen: page.chosen,
    handles: structuredClone(shape.handles),
    options: options(),
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

// before anything else is changed, so that it is a step of its own
export async function commitNow() {
  if (timer) await commit();
}

// Runs what changes the shape, which then follows. What fails is undone. For what has its turn.
export async function change(f, stops = true) {
  if (stops) stopPlaying();
  try {
    await f();
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
    isSure = false;
    await goTo(now);
  }
}

export const changing = (f, stops) => inTurn(() => change(f, stops));

async function goTo(index) {
  if (index < 0 || index >= past.length || page.dragging || page.stroke) return;
  stopPlaying();
  const kept = past[index],
    before = past[now],
    state = await kept.state;
  if (!state) {
    if (kept === before) return;
    past.splice(index, 1);
    if (index < now) --now;
    changed();
    return say('There was not enough memory to keep this step.', true);
  }
  now = index;
  if (kept !== before) page.isSaved = false;
  const wasSure = isSure;
  isSure = false;
  try {
    Object.assign(page.shape, {
      status: kept.status.slice(),
      handles: structuredClone(kept.handles),
      stiffness: kept.stiffness?.slice() ?? null,
    });
    page.keys = kept.keys.slice();
    page.isSettled = true;
    page.hasNewTargets = false;
    // options and stiffness first: the state has the rotations of their cells
    const hasOptions =
      !wasSure || JSON.stringify(kept.options) !== JSON.stringify(before.options);
    if (hasOptions) {
      await engine.call('stiffness', { values: [] }); // it may be of other cells
      showOptions(kept.options);
      await sendOptions(kept.options);
    }
    if (hasOptions || kept.stiffness !== before.stiffness)
      await engine.call('stiffness', { values: cellStiffness() });
    isSure = true;
    const { points, rest } = await engine.call('restore', { state });
    page.shape.points = rest;
    page.spare = view.setPositions(points);
    page.chosen = kept.chosen;
    recountHandles(false);
    page.isSettled = false;
    page.hasNewTargets = page.shape.handles.length > 0;
    draw();
    pump();
  } catch (error) {
    complain(error);
  }
}

const step = (by) =>
  inTurn(async () => {
    await commitNow();
    await goTo(now + by);
  });

export const undo = () => step(-1),
  redo = () => step(1);
