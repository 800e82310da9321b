// How the shape is shown: colors, measures, marks, and the gizmo of the chosen handle.
import { FIXED, HANDLE, colorOf, gray, ramp, rampColor, red } from './colors.js';
import { facesOfInverted } from './faces.js';
import { complain } from './messages.js';
import { rigidParts } from './motion.js';
import { drawPlot } from './plot.js';
import { $, changed, engine, history, measured, page, view } from './state.js';

let values = null,
  range = [0, 1];

export function drawColors() {
  if ($('measure').value === 'stiffness') {
    const s = page.shape.stiffness;
    view.setColors((v) => (s && s[v] !== 1 ? rampColor((Math.log10(s[v]) + 2) / 5) : gray));
  } else if (values)
    view.setColors((v) => rampColor((values[v] - range[0]) / (range[1] - range[0])));
  else view.setColors((v) => colorOf(page.shape.status[v]));
}

const percent = (x) => `${(100 * x).toPrecision(3)}%`;

let isMeasuring = false;

// the measure at the vertices, when the shape has come to rest or another one is chosen
export async function showMeasure() {
  const measure = $('measure').value,
    of = page.shape;
  if (!measure || measure === 'stiffness') {
    values = null;
    $('legend').hidden = true;
    $('quality').textContent = '';
    if (page.shape) drawColors();
    return;
  }
  if (isMeasuring || !page.shape) return;
  isMeasuring = true;
  try {
    const answer = await engine.call('colors', { measure });
    if (of !== page.shape || $('measure').value !== measure) return;
    values = answer.values;
    const sizes = Float64Array.from(values, Math.abs).sort(),
      top = sizes[Math.floor(0.995 * (sizes.length - 1))] || 1e-3;
    range = measure === 'size_change' ? [-top, top] : [0, top];
    const unit = (x) => (measure === 'angle_change' ? `${x.toPrecision(3)}°` : percent(x));
    $('legend').hidden = false;
    $('legend').firstElementChild.style.background =
      `linear-gradient(90deg, ${ramp.map((c) => `rgb(${c})`).join()})`;
    $('legend').lastElementChild.replaceChildren(
      ...range.map((x) => Object.assign(document.createElement('b'), { textContent: unit(x) })),
    );
    const { edgeLengthError, areaChange, volumeChange, invertedSimplices } = answer.quality;
    $('quality').textContent =
      `Edges ${percent(edgeLengthError)}, area ${percent(areaChange)}` +
      (Number.isFinite(volumeChange) ? `, volume ${percent(volumeChange)}` : '') +
      (page.shape.volume ? `, ${invertedSimplices} inverted` : '');
    drawColors();
  } catch (error) {
    complain(error);
  } finally {
    isMeasuring = false;
    if ($('measure').value !== measure) showMeasure(); // another one was chosen meanwhile
  }
}

// what is painted is seen
export function drawPaint(measure) {
  if ($('measure').value === measure) return drawColors();
  $('measure').value = measure;
  measureChanged();
}

export function measureChanged() {
  values = null;
  showMeasure();
  drawColors();
}

export function drawInverted() {
  const corners = page.shape.volume ? facesOfInverted(page.shape, view.positions) : [];
  page.shape.inverted = corners.length / 36;
  view.setInverted(corners);
}

// points for what is too small to be seen as a region
export function drawMarks() {
  const { shape } = page;
  const points = [],
    colors = [];
  shape.handles.forEach((handle, k) => {
    if (!handle.point && (handle.size === 0 || handle.size > 6)) return;
    points.push(...rigidParts(handle).place.toArray());
    colors.push(colorOf(k + HANDLE));
  });
  if (shape.fixed && shape.fixed <= 12)
    for (let v = 0; v < shape.status.length; ++v)
      if (shape.status[v] === FIXED) {
        points.push(...view.positions.subarray(3 * v, 3 * v + 3));
        colors.push(red);
      }
  view.setMarks(points, colors);
}

export function draw() {
  drawColors();
  drawMarks();
  drawInverted();
  drawPlot($('plot'), history, measured);
  placeGizmo();
  changed();
}

export function placeGizmo() {
  const handle = page.shape?.handles[page.chosen];
  if (!handle) {
    if (view.gizmo.dragging) view.gizmo.pointerUp(null);
    view.gizmo.detach();
  } else if (!view.gizmo.dragging) {
    const { q, place } = rigidParts(handle);
    view.proxy.position.copy(place);
    view.proxy.quaternion.copy(q);
    if (view.gizmo.object !== view.proxy) view.gizmo.attach(view.proxy);
  }
  view.gizmo.enabled = view.gizmo.getHelper().visible =
    page.tool === 'grab' && !!handle && !page.playing;
  view.isDirty = true;
}
