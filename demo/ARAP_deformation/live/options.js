// The options of the energy, as the panel has them, and the stiffness that is painted.
import { ofSimplices } from './regions.js';
import { $, changed, engine, page } from './state.js';

export const options = ({ diagonal } = page.shape) => ({
  cells: $('cells').value,
  minimizer: $('minimizer').value,
  bending_length: String(($('bending').value / 100) * diagonal),
});

export async function sendOptions(wanted) {
  await engine.call('options', { options: wanted });
  page.shape.held.options = wanted;
}

export function showOptions(kept) {
  $('cells').value = kept.cells;
  $('minimizer').value = kept.minimizer;
  $('bending').value = (kept.bending_length / page.shape.diagonal) * 100;
  changed();
}

export function stiffnessOfVertices() {
  if (!page.shape.stiffness)
    page.shape.stiffness = new Float64Array(page.shape.status.length).fill(1);
  return page.shape.stiffness;
}

// what the session wants: of its cells, and nothing where nothing is painted
export function cellStiffness(stiffness) {
  return stiffness && page.shape.held.options.cells === 'elements'
    ? ofSimplices(page.shape, stiffness)
    : (stiffness ?? []);
}

export async function sendStiffness(stiffness) {
  await engine.call('stiffness', { values: cellStiffness(stiffness) });
  page.shape.held.stiffness = stiffness;
}
