// What is open, painted and held: the state that all modules of the page share.
import { FIXED } from './colors.js';
import { Engine } from './engine.js';
import { View } from './view.js';

export const $ = (id) => document.getElementById(id);

// for what the page cannot do without
export function giveUp(sentence) {
  $('help').hidden = $('tools').inert = $('panel').inert = true;
  document.querySelector('main').inert = $('message').hidden = false;
  $('message').className = 'error';
  $('message').firstElementChild.textContent = $('spoken').textContent = sentence;
}

export const view = (() => {
  try {
    return new View($('view'));
  } catch (error) {
    giveUp('This browser does not draw in three dimensions: WebGL 2 is missing or switched off.');
    throw error;
  }
})();

export const engine = new Engine(...window.arapParts());

export const page = {
  // what is open: points are those of the rest shape less origin, as are positions and handles
  // { name, model, points, origin, simplices, starts, volume, weights, faces, simplexOf, diagonal,
  //   status, fixed, handles, stiffness, held }
  // status and stiffness are as they are painted, by strokes too whose turn is to come; held is
  // what the engine has been told, { status, stiffness, options }, which others replace but do not
  // change, for the steps of undo have them too
  shape: null,
  tool: 'grab',
  paints: FIXED,
  chosen: -1, // the handle with the gizmo
  hasNewTargets: false,
  isSettled: true,
  isHeld: false,
  isSaved: true,
  failed: '',
  keys: [],
  playing: null,
  spare: null, // an array for the next points
  dragging: null,
  stroke: null,
};

// A model is soon deformed again; work on a file is not.
export const hasUnsavedWork = () => !!page.shape && !page.shape.model && !page.isSaved;

export const measured = {
  energy: NaN,
  milliseconds: NaN,
  iterations: 0,
  perIteration: 1,
  frames: 0,
  steps: 0,
};
export const history = { energy: [], milliseconds: [] };

// Who shows the state is told when it has changed.
const shows = [];
export const whenChanged = (show) => shows.push(show);
export const changed = () => shows.forEach((show) => show());
