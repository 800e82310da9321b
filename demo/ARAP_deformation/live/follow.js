// The shape follows the handles, a few iterations at a time.
import { drawInverted, drawMarks, placeGizmo, showMeasure } from './drawing.js';
import { messageOfHandles } from './handles.js';
import { complain, say } from './messages.js';
import { drawPlot } from './plot.js';
import { $, changed, engine, history, measured, page, view } from './state.js';

export function pump() {
  if (!page.shape || !engine.isIdle || page.isSettled) return;
  if (!page.isHeld) {
    page.isSettled = true;
    return void showMeasure();
  }
  const moves = page.hasNewTargets,
    fast = moves || page.dragging || page.playing;
  const share = measured.perIteration || 1;
  const iterations = fast
    ? Math.max(1, Math.min(3, Math.round(50 / share)))
    : Math.max(5, Math.min(200, Math.round(60 / share)));
  page.hasNewTargets = false;
  const of = page.shape,
    buffer = page.spare && page.spare.length === page.shape.points.length ? page.spare : null;
  page.spare = null;
  engine
    .call(
      'step',
      {
        handles: moves ? messageOfHandles() : null,
        iterations,
        tolerance: fast ? 0 : 1e-6,
        buffer,
      },
      buffer ? [buffer.buffer] : [],
    )
    .then(
      (step) => {
        if (of !== page.shape) return;
        if (!(page.isSettled && !page.hasNewTargets)) page.spare = view.setPositions(step.points);
        page.failed = '';
        ++measured.steps;
        Object.assign(measured, {
          energy: step.energy,
          milliseconds: step.milliseconds,
          iterations: step.iterations,
        });
        if (step.iterations)
          measured.perIteration =
            0.5 * measured.perIteration + (0.5 * step.milliseconds) / step.iterations;
        history.energy.push(step.energy);
        history.milliseconds.push(step.milliseconds / Math.max(1, step.iterations));
        for (const list of Object.values(history)) if (list.length > 110) list.shift();
        const done =
          step.result === 'converged' ||
          (!fast && step.firstEnergy - step.energy <= 1e-12 * step.energy);
        if (done && !page.hasNewTargets && !page.dragging && !page.playing) settle(step);
        drawPlot($('plot'), history, measured);
        drawInverted();
        drawMarks();
        placeGizmo();
        pump();
      },
      (error) => {
        if (of !== page.shape) return;
        page.isSettled = true;
        if (page.failed !== error.message) complain(error);
        page.failed = error.message;
        page.spare = null;
      },
    );
}

function settle(step) {
  page.isSettled = true;
  if (step.unconstrained)
    say(
      step.unconstrained === 1
        ? '1 part of the shape is held by nothing and stays.'
        : `${step.unconstrained} parts of the shape are held by nothing and stay.`,
    );
  showMeasure();
}

export function stopPlaying() {
  page.playing?.recorder?.stop();
  page.playing = null;
  if (page.shape) {
    placeGizmo();
    changed();
  }
}
