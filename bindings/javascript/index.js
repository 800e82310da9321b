// As-rigid-as-possible deformation of surfaces and tetrahedral volumes, for arrays of numbers.
// See index.d.ts for what each function means.
import createArap from './arap.mjs';

export class ArapError extends Error {
  constructor(status, message) {
    super(message);
    this.name = 'ArapError';
    this.status = status || 'misuse';
  }
}

const ends = ['unknown', 'minimum', 'flat', 'undecided'];
const initialGuesses = ['automatic', 'previous', 'rotations', 'laplacian'];

async function machineCode() {
  const url = new URL('./arap.wasm', import.meta.url);
  if (url.protocol === 'file:' && typeof process === 'object') {
    const files = ['node:fs', 'promises'].join('/'); // bundlers for browsers would look for it
    const { readFile } = await import(/* webpackIgnore: true */ /* @vite-ignore */ files);
    return readFile(url);
  }
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url} could not be loaded: ${response.status}`);
  return response.arrayBuffer();
}

// a typed array of numbers, with a message for what is none
function numbersOf(values, what, Kind) {
  const isList = Array.isArray(values) || (ArrayBuffer.isView(values) && 'length' in values);
  if (!isList) throw new TypeError(`${what} must be a typed array or an array of numbers`);
  if (typeof values[0] === 'bigint') throw new TypeError(`${what} must be numbers, not bigints`);
  if (values instanceof Kind) return values;
  const result = Kind.from(values, (value, i) => {
    if (typeof value === 'number') return value;
    throw new TypeError(
      `${what}: the element ${i} is no number; arrays are flat, one number after another`,
    );
  });
  if (Kind === Int32Array)
    for (let i = 0; i < result.length; ++i)
      if (result[i] !== values[i])
        throw new TypeError(`${what}: the element ${i} is ${values[i]}, which is no index`);
  return result;
}

function numberOf(value, what) {
  if (typeof value !== 'number') throw new TypeError(`${what} is ${value}; it must be a number`);
  return value;
}

function booleanOf(value, what) {
  if (typeof value !== 'boolean') throw new TypeError(`${what} must be true or false`);
  return value;
}

function refuseUnknown(rest, call) {
  for (const name of Object.keys(rest)) throw new TypeError(`${call} has no option '${name}'`);
}

const actions = new Map([
  [undefined, 0],
  [null, 0],
  ['proceed', 0],
  ['stop', 1],
  ['cancel', 2],
]);

function actionOf(answer) {
  if (actions.has(answer)) return actions.get(answer);
  const what = typeof answer === 'string' ? `'${answer}'` : String(answer);
  throw new TypeError(
    `a visitor returns nothing, 'proceed', 'stop' or 'cancel', and not ${what}` +
      (typeof answer?.then === 'function' ? '; it cannot be asynchronous' : ''),
  );
}

// an option as JavaScript has it
function valueOf(text) {
  if (text === 'true' || text === 'false') return text === 'true';
  return Number.isNaN(Number(text)) ? text : Number(text);
}

function rowsOf(array, columns, what) {
  if (array.length % columns !== 0)
    throw new RangeError(`${what}: ${array.length} numbers are no rows of ${columns}`);
  return array.length / columns;
}

// The corners of simplices as rows: those of polygons of different numbers of corners end with -1.
function simplexRows(simplices, corners, what, least) {
  const s = numbersOf(simplices, what, Int32Array);
  const isCount = (k) => Number.isInteger(k) && k > 0;
  if (typeof corners === 'number') {
    if (!isCount(corners)) throw new TypeError('corners must be a positive integer');
    return { rows: s, m: rowsOf(s, corners, what), k: corners };
  }
  const counts = numbersOf(corners, 'corners', Int32Array);
  if (!counts.every(isCount)) throw new TypeError('corners must be positive integers');
  const sum = counts.reduce((a, b) => a + b, 0),
    m = counts.length,
    k = counts.reduce((a, b) => Math.max(a, b), least);
  if (sum !== s.length)
    throw new RangeError(`${what}: ${s.length} numbers, but ${sum} corners of ${m} faces`);
  const rows = new Int32Array(m * k).fill(-1);
  for (let i = 0, begin = 0; i < m; begin += counts[i++])
    rows.set(s.subarray(begin, begin + counts[i]), i * k);
  return { rows, m, k };
}

function vectorOf(values, what) {
  const v = numbersOf(values, what, Float64Array);
  if (v.length !== 3) throw new RangeError(`${what} has 3 coordinates, not ${v.length}`);
  return v;
}

const forgotten = new FinalizationRegistry((free) => free());

export async function load({ wasmBinary, ...rest } = {}) {
  refuseUnknown(rest, 'load()');
  const visitors = [];
  const module = await createArap({
    wasmBinary: wasmBinary ?? (await machineCode()),
    visit: (iteration, energy) => visitors.at(-1)(iteration, energy),
  });
  const text = (pointer) => module.UTF8ToString(pointer >>> 0);
  const fail = () => {
    throw new ArapError(text(module._arap_status()), text(module._arap_message()));
  };

  // Calls f with pointers to copies of the arrays in the heap. A view of the heap is made anew for
  // each use: the heap may have grown.
  function withCopies(arrays, f) {
    const pointers = [];
    try {
      for (const array of arrays) {
        const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
        const pointer = module._malloc(bytes.length || 1) >>> 0;
        if (!pointer) throw new ArapError('out_of_memory', 'there is not enough memory');
        pointers.push(pointer);
        module.HEAPU8.set(bytes, pointer);
      }
      return f(...pointers);
    } finally {
      pointers.forEach((pointer) => module._free(pointer));
    }
  }
  function withText(values, f) {
    const strings = values.map(String);
    if (strings.some((s) => s.includes('\0'))) throw new TypeError('a text has a null character');
    return withCopies([new TextEncoder().encode(strings.map((s) => `${s}\0`).join(''))], f);
  }
  function withOptions(options, f) {
    const given = Object.entries(options).filter(([, value]) => value !== undefined);
    return withText(given.flat(), (pointer) => f(pointer, given.length));
  }
  const heapNumbers = (pointer, length) =>
    new Float64Array(module.HEAPU8.buffer, pointer >>> 0, length);
  const answer = () => heapNumbers(module._arap_numbers(), module._arap_size()).slice();

  function reportOf(a) {
    const firstEnergy = 25 + a[24],
      energy = a.slice(firstEnergy);
    return {
      status: text(module._arap_status()),
      message: text(module._arap_message()),
      initialGuess: initialGuesses[a[23]],
      iterations: a[0],
      energyScale: a[1],
      roundingLevel: a[2],
      estimatedRelativeGap: a[3],
      freeVertices: a[4],
      simplices: a[5],
      invertedSimplices: a[6],
      end: ends[a[19]],
      saddlesLeft: a[20],
      plateausLeft: a[21],
      lookingIterations: a[22],
      stages: {
        region: !!a[7],
        weights: !!a[8],
        order: !!a[9],
        factor: !!a[10],
        border: !!a[11],
      },
      seconds: {
        preprocess: a[12],
        transfer: a[13],
        initialGuess: a[14],
        localSteps: a[15],
        globalSteps: a[16],
        visitor: a[17],
        total: a[18],
      },
      unconstrainedComponents: Int32Array.from(a.subarray(25, firstEnergy)),
      energy,
      finalEnergy: energy.length > 0 ? energy.at(-1) : NaN,
    };
  }
  function stepReportOf(numbers) {
    const a = numbers.slice(-12);
    return {
      ...reportOf(numbers.subarray(0, -12)),
      mass: a[0],
      kineticEnergy: a[1],
      elasticEnergy: a[2],
      centerOfMass: [...a.subarray(3, 6)],
      momentum: [...a.subarray(6, 9)],
      angularMomentum: [...a.subarray(9, 12)],
    };
  }

  class State {
    constructor(pointer) {
      this.pointer = pointer;
      forgotten.register(this, () => module._arap_delete_state(pointer), this);
    }
    dispose() {
      if (!this.pointer) return;
      forgotten.unregister(this);
      module._arap_delete_state(this.pointer);
      this.pointer = 0;
    }
  }

  class Session {
    #pointer = 0;
    #runs = 0;

    constructor(
      points,
      simplices,
      { corners, volume = false, weights = 'safe_cotangent', ...options } = {},
    ) {
      booleanOf(volume, 'volume');
      const least = volume ? 4 : 3;
      corners ??= least;
      const p = numbersOf(points, 'points', Float64Array);
      const n = rowsOf(p, 3, 'points');
      const { rows, m, k } = simplexRows(simplices, corners, 'simplices', least);
      this.#pointer =
        withCopies([p, rows], (pp, sp) =>
          withText([weights], (wp) => module._arap_create(pp, n, sp, m, k, volume, wp)),
        ) || fail();
      this.numberOfVertices = n;
      this.numberOfSimplices = m;
      this.isVolume = volume;
      const pointer = this.#pointer;
      forgotten.register(this, () => module._arap_delete(pointer), this);
      try {
        this.setOptions(options);
      } catch (error) {
        this.dispose();
        throw error;
      }
    }

    dispose() {
      if (this.#runs)
        throw new ArapError('in_a_run', 'a visitor disposed of the session that it visits');
      if (!this.#pointer) return;
      forgotten.unregister(this);
      module._arap_delete(this.#pointer);
      this.#pointer = 0;
    }

    #this() {
      return (
        this.#pointer ||
        (() => {
          throw new ArapError('misuse', 'the session was disposed of');
        })()
      );
    }
    #call(name, ...rest) {
      return module[`_arap_${name}`](this.#this(), ...rest) ? answer() : fail();
    }
    // arrays of indices, or of one of them
    #indices(values, what) {
      return numbersOf(typeof values === 'number' ? [values] : values, what, Int32Array);
    }
    #callWithIndices(name, what, values, ...rest) {
      const indices = this.#indices(values, what);
      return withCopies([indices], (pointer) => this.#call(name, pointer, indices.length, ...rest));
    }
    // indices, with rows of numbers: [what they are, the numbers, how many there are in a row]
    #callWithRows(name, what, values, ...arrays) {
      const numbers = arrays.map(([of, x]) => numbersOf(x, of, Float64Array)),
        rows = arrays.map(([of, , columns], k) => rowsOf(numbers[k], columns, of));
      withCopies(numbers, (...pointers) =>
        this.#callWithIndices(name, what, values, ...pointers.flatMap((p, k) => [p, rows[k]])),
      );
    }
    // what there is of a handle, or of handles
    #valuesOf(name, handles) {
      return this.#callWithIndices(name, 'the handle', handles);
    }
    #copyOf(pointer, out) {
      const view = heapNumbers(pointer, 3 * this.numberOfVertices);
      return out ? this.#put(view, out) : view.slice();
    }
    #put(view, out) {
      if (!(out instanceof Float64Array || out instanceof Float32Array))
        throw new TypeError('points need a Float64Array or a Float32Array');
      if (out.length !== view.length)
        throw new RangeError(`points need a typed array of ${view.length} numbers`);
      out.set(view);
      return out;
    }

    points(out) {
      return this.#copyOf(module._arap_points(this.#this()), out);
    }
    setPoints(points) {
      const p = numbersOf(points, 'points', Float64Array);
      const rows = rowsOf(p, 3, 'points');
      withCopies([p], (pointer) => this.#call('set_points', pointer, rows));
    }
    restPoints(out) {
      const view = this.#call('rest_points');
      return out ? this.#put(view, out) : view;
    }

    setOption(name, value) {
      if (value === undefined) throw new TypeError(`the option ${name} has no value`);
      this.setOptions({ [name]: value });
    }
    setOptions(options) {
      withOptions(options, (pointer, n) => this.#call('set_options', pointer, n));
    }
    option(name) {
      withText([name], (pointer) => this.#call('option', pointer));
      const value = text(module._arap_message());
      if (!value) throw new ArapError('invalid_option', `the option '${name}' is not known`);
      return valueOf(value);
    }

    setRegion(vertices) {
      this.#callWithIndices('set_region', 'vertices', vertices);
    }
    region() {
      return Int32Array.from(this.#call('region'));
    }

    insertHandles(vertices) {
      this.#callWithIndices('insert_handles', 'vertices', vertices);
    }
    eraseHandles(handles) {
      this.#callWithIndices('erase_handles', 'handles', handles);
    }
    clearHandles() {
      this.#call('clear_handles');
    }
    clearPoints() {
      this.#call('clear_points');
    }
    handles() {
      return Int32Array.from(this.#call('handles'));
    }

    locate(point) {
      return this.locateAll(vectorOf(point, 'the point'))[0];
    }
    locateAll(points) {
      const p = numbersOf(points, 'points', Float64Array);
      const rows = rowsOf(p, 3, 'points');
      const a = withCopies([p], (pointer) => this.#call('locate', pointer, rows));
      const places = [];
      for (let i = 0; places.length < rows; ) {
        const size = a[i++];
        if (!size) {
          places.push(null);
          continue;
        }
        const [simplex, distance, ...coordinates] = a.subarray(i, (i += 2 + size));
        places.push({ simplex, distance, coordinates });
      }
      return places;
    }
    insertPoint(simplex, coordinates) {
      if (typeof simplex !== 'number') throw new TypeError('the simplex must be a number');
      return this.insertPoints([{ simplex, coordinates }])[0];
    }
    // simplices, and coordinates in rows of the same length, which NaN fills
    #callWithPlaces(name, places) {
      if (!Array.isArray(places)) throw new TypeError('places must be an array');
      const none = places.findIndex((place) => place == null);
      if (none >= 0)
        throw new TypeError(`place ${none} is ${places[none]}: the point was not located`);
      const of = places.map(({ coordinates }, i) => {
        const c = numbersOf(coordinates, `the coordinates of place ${i}`, Float64Array);
        if (!c.some(Number.isNaN)) return c;
        throw new ArapError('invalid_coordinates', `place ${i} has a coordinate that is NaN`);
      });
      const k = of.reduce((most, c) => Math.max(most, c.length), 0),
        rows = new Float64Array(k * places.length).fill(NaN);
      of.forEach((c, i) => rows.set(c, i * k));
      const simplices = places.map(({ simplex }) => simplex);
      return withCopies([rows], (pointer) =>
        this.#callWithIndices(name, 'the simplex', simplices, pointer, k),
      );
    }
    insertPoints(places) {
      return Int32Array.from(this.#callWithPlaces('insert_points', places));
    }
    positions(places) {
      return this.#callWithPlaces('positions', places);
    }
    pointPosition(handles) {
      return this.#valuesOf('point_positions', handles);
    }

    setTargets(handles, targets) {
      this.#callWithRows('set_targets', 'handles', handles, ['targets', targets, 3]);
    }
    #setTargetSets(name, handles, point, direction, what) {
      this.#callWithRows(name, 'handles', handles, ['the point', point, 3], [what, direction, 3]);
    }
    setTargetPlane(handles, point, normal) {
      this.#setTargetSets('set_target_planes', handles, point, normal, 'the normal');
    }
    setTargetLine(handles, point, direction) {
      this.#setTargetSets('set_target_lines', handles, point, direction, 'the direction');
    }
    setTargetSurface(handles, points, faces, { corners = 3, ...rest } = {}) {
      refuseUnknown(rest, 'setTargetSurface()');
      const p = numbersOf(points, 'points', Float64Array);
      const n = rowsOf(p, 3, 'points');
      const { rows, m, k } = simplexRows(faces, corners, 'faces', 3);
      withCopies([p, rows], (pp, fp) =>
        this.#callWithIndices('set_target_surface', 'handles', handles, pp, n, fp, m, k),
      );
    }
    target(handles) {
      return this.#valuesOf('targets', handles);
    }
    transform(handles, matrix, { fromRest = false, ...rest } = {}) {
      refuseUnknown(rest, 'transform()');
      booleanOf(fromRest, 'fromRest');
      const h = this.#indices(handles, 'handles'),
        m = numbersOf(matrix, 'the matrix', Float64Array);
      const rows = rowsOf(m, 4, 'the matrix');
      withCopies([h, m], (hp, mp) => this.#call('transform', hp, h.length, mp, rows, fromRest));
    }
    weight(handles) {
      const weights = this.#valuesOf('weights', handles);
      return typeof handles === 'number' ? weights[0] : weights;
    }
    setWeight(handles, weight) {
      const weights = typeof weight === 'number' ? [weight] : weight;
      this.#callWithRows('set_weights', 'handles', handles, ['the weight', weights, 1]);
    }
    setRotation(vertices, matrix) {
      this.#callWithRows('set_rotations', 'vertices', vertices, ['the matrix', matrix, 9]);
    }
    setRotationsOfMotion(vertices) {
      this.#callWithIndices('set_rotations_of_motion', 'vertices', vertices);
    }
    eraseRotations(vertices) {
      this.#callWithIndices('erase_rotations', 'vertices', vertices);
    }

    setStiffness(values) {
      const v = numbersOf(values ?? [], 'stiffness', Float64Array);
      withCopies([v], (pointer) => this.#call('set_stiffness', pointer, v.length));
    }
    setGroups(groups) {
      this.#callWithIndices('set_groups', 'groups', groups ?? []);
    }

    preprocess() {
      this.#call('preprocess');
      return text(module._arap_message());
    }
    deform({ iterations, tolerance, visitor, ...rest } = {}) {
      refuseUnknown(rest, 'deform()');
      if (iterations !== undefined) numberOf(iterations, 'iterations');
      if (tolerance !== undefined) numberOf(tolerance, 'tolerance');
      return withOptions({ iterations, tolerance }, (pointer, n) =>
        this.#run(visitor, (visits) => reportOf(this.#call('deform', pointer, n, visits))),
      );
    }
    advance({
      timeStep = 1 / 60,
      density = 1,
      modulus = 1,
      damping = 0,
      acceleration = [0, 0, 0],
      forces,
      visitor,
      ...rest
    } = {}) {
      refuseUnknown(rest, 'advance()');
      const numbers = Object.entries({ timeStep, density, modulus, damping });
      const a = vectorOf(acceleration, 'the acceleration'),
        f = numbersOf(forces ?? [], 'forces', Float64Array);
      const rows = rowsOf(f, 3, 'forces');
      if (forces && !rows && this.numberOfVertices)
        throw new ArapError('', 'forces have three coordinates for each of the vertices; there are none');
      return withCopies([a, f], (ap, fp) =>
        this.#run(visitor, (visits) =>
          stepReportOf(
            this.#call(
              'advance',
              ...numbers.map(([name, value]) => numberOf(value, name)),
              ap,
              fp,
              rows,
              visits,
            ),
          ),
        ),
      );
    }
    // f(visits) runs, with a visitor if there is one, and makes the report. What a visitor throws
    // cancels the run, and is thrown.
    #run(visitor, f) {
      if (visitor != null && typeof visitor !== 'function')
        throw new TypeError(`the visitor is ${visitor}; it must be a function`);
      let thrown = null;
      const visit = (iteration, energy) => {
        let isCalled = true;
        const points = (out) => {
          if (!isCalled || visitors.at(-1) !== visit)
            throw new ArapError('misuse', 'points are for the visitor that is called now');
          return this.#copyOf(module._arap_iterate_points(this.#this()) || fail(), out);
        };
        try {
          return actionOf(visitor(iteration, energy, points));
        } catch (error) {
          thrown = { error };
          return 2;
        } finally {
          isCalled = false;
        }
      };
      if (visitor) visitors.push(visit);
      ++this.#runs;
      let report;
      try {
        report = f(!!visitor);
      } finally {
        --this.#runs;
        if (visitor) visitors.pop();
      }
      if (thrown) throw thrown.error;
      return report;
    }

    reset() {
      this.#call('reset');
    }
    makeRestShape() {
      this.#call('make_rest_shape');
    }
    state() {
      return new State(module._arap_state(this.#this()) || fail());
    }
    restore(state) {
      if (!(state instanceof State) || !state.pointer)
        throw new TypeError(
          'only what state() has returned and is not disposed of can be restored',
        );
      this.#call('restore', state.pointer);
    }

    energy() {
      return this.#call('energy')[0];
    }
    velocities() {
      return this.#call('velocities');
    }
    setVelocities(vertices, velocities) {
      this.#callWithRows('set_velocities', 'vertices', vertices, ['velocities', velocities, 3]);
    }
    rotations() {
      return this.#call('rotations');
    }
    quality() {
      const q = this.#call('quality');
      return {
        edgeLengthError: q[0],
        areaChange: q[1],
        volumeChange: q[2],
        largestAngleChange: q[3],
        largestSpike: q[4],
        invertedSimplices: q[5],
      };
    }
    qualityAtVertices(measure) {
      return withText([measure], (pointer) => this.#call('quality_at_vertices', pointer));
    }
  }

  return {
    session: (points, simplices, options) => new Session(points, simplices, options),
    deform(points, simplices, handles, targets, options) {
      const session = new Session(points, simplices, options);
      try {
        session.insertHandles(handles);
        session.setTargets(handles, targets);
        const report = session.deform();
        return { points: session.points(), report };
      } finally {
        session.dispose();
      }
    },
    heapBytes: () => module.HEAPU8.buffer.byteLength,
  };
}
