// The engine, in a thread of its own. It answers each message once; the page sends the next one
// only then, so that no queue grows.
import { load } from 'arap-deformation';

let arap,
  session,
  shape,
  states = new Map(),
  statesMade = 0;
let hasStiffness = false,
  status = new Int32Array(0),
  vertices = [],
  pointHandles = [];

const rotationOf = (m) => [m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]];
const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

function listOf(values, wanted) {
  const list = [];
  for (let v = 0; v < values.length; ++v) if (values[v] === wanted) list.push(v);
  return Int32Array.from(list);
}

// Replaces the session by a new one, after prepare() has made it ready. If that fails, all is as
// before.
function newSession(next, points, weights, prepare) {
  const before = { shape, session, hasStiffness, status, vertices, pointHandles };
  try {
    shape = next;
    session = undefined; // not to be disposed of if there is no new one
    session = arap.session(points, shape.simplices, {
      corners: shape.corners,
      volume: shape.volume,
      weights,
    });
    hasStiffness = false;
    status = new Int32Array(points.length / 3).fill(1);
    vertices = [];
    pointHandles = [];
    prepare();
  } catch (error) {
    session?.dispose();
    ({ shape, session, hasStiffness, status, vertices, pointHandles } = before);
    throw error;
  }
  states.forEach((state) => state.dispose());
  states.clear();
  before.session?.dispose();
}

// to set none again would cost a factorization
function setStiffness(values) {
  if (values.length || hasStiffness) session.setStiffness(values);
  hasStiffness = values.length > 0;
}

// the control vertices and points of the painted regions; only what has changed is told to the
// session
function hold(next, handles) {
  const erased = [],
    inserted = [];
  for (let v = 0; v < next.length; ++v)
    if ((next[v] === 1) !== (status[v] === 1)) (next[v] === 1 ? erased : inserted).push(v);
  session.eraseHandles(erased);
  session.insertHandles(inserted);
  status = next;
  const fixed = listOf(status, 0);
  session.setWeight(fixed, Infinity);
  session.transform(fixed, identity, { fromRest: true });
  session.eraseRotations(fixed); // a handle may have turned them
  session.eraseHandles(pointHandles);
  pointHandles = [];
  vertices = handles.map((handle, k) => {
    if (!handle.point) return listOf(status, k + 2);
    pointHandles.push(session.insertPoint(handle.point.simplex, handle.point.coordinates));
    return pointHandles.slice(-1);
  });
  handles.forEach((handle, k) => session.setWeight(vertices[k], handle.weight));
  move(handles);
}

function move(handles) {
  handles.forEach((handle, k) => {
    if (!vertices[k].length) return;
    session.transform(vertices[k], handle.matrix, { fromRest: true });
    if (handle.point) return;
    if (handle.turns) session.setRotation(vertices[k], rotationOf(handle.matrix));
    else session.eraseRotations(vertices[k]);
  });
}

const positions = () => session.points(new Float32Array(3 * session.numberOfVertices));

const operations = {
  async load({ wasm }) {
    arap = await load({ wasmBinary: wasm });
  },
  open({ points, simplices, corners, volume, weights, options }) {
    newSession({ simplices, corners, volume }, points, weights, () => session.setOptions(options));
  },
  weights({ weights, handles, options, stiffness }) {
    const kept = status,
      present = session.points();
    newSession(shape, session.restPoints(), weights, () => {
      session.setOptions(options);
      setStiffness(stiffness);
      hold(kept, handles);
      session.setPoints(present);
    });
  },
  options({ options }) {
    session.setOptions(options);
  },
  stiffness({ values }) {
    setStiffness(values);
  },
  hold({ status: next, handles }) {
    hold(next, handles);
  },
  step({ handles, iterations, tolerance, buffer }) {
    const start = performance.now();
    if (handles) move(handles);
    const {
      status: result,
      energy,
      finalEnergy,
      iterations: done,
      unconstrainedComponents,
    } = session.deform({ iterations, tolerance });
    const milliseconds = performance.now() - start;
    const points = session.points(buffer ?? new Float32Array(3 * session.numberOfVertices));
    return {
      points,
      result,
      milliseconds,
      iterations: done,
      energy: finalEnergy,
      firstEnergy: energy[0],
      unconstrained: unconstrainedComponents.length,
    };
  },
  reset() {
    session.reset();
    return { points: positions() };
  },
  rest() {
    session.makeRestShape();
    return { rest: session.points() };
  },
  points() {
    return { points: session.points(), rest: session.restPoints() };
  },
  colors({ measure }) {
    return { values: session.qualityAtVertices(measure), quality: session.quality() };
  },
  locate({ point }) {
    return { place: session.locate(point) };
  },
  keep() {
    states.set(
      ++statesMade,
      Object.assign(session.state(), { held: { status, vertices, pointHandles } }),
    );
    return { state: statesMade };
  },
  restore({ state }) {
    const known = states.get(state);
    session.restore(known);
    ({ status, vertices, pointHandles } = known.held);
    return { points: positions(), rest: session.restPoints() };
  },
  forget({ state }) {
    states.get(state)?.dispose();
    states.delete(state);
  },
  heap() {
    return { bytes: arap.heapBytes() };
  },
};

onmessage = async ({ data }) => {
  try {
    const answer = (await operations[data.operation](data)) ?? {};
    const moved = ['points', 'rest', 'values'].map((name) => answer[name]?.buffer).filter(Boolean);
    postMessage(answer, moved);
  } catch (error) {
    postMessage({ error: error.message || String(error) });
  }
};
postMessage({ isReady: true });
