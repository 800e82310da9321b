// What an installed package does: energies as those of the command, to 1e-9, and errors with a
// sentence.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { load, ArapError } from 'arap-deformation';
import { models } from './models.js';

const arap = await load();
await assert.rejects(load({ wasmBinry: null }), /wasmBinry/);
const command = process.env.ARAP_DEFORM;

const numbers = (file) =>
  readFileSync(file, 'utf8').replace(/#.*/g, '').trim().split(/\s+/).map(Number);
function readOff(file) {
  const [n, m, , ...rest] = numbers(file).slice(1),
    faces = rest.slice(3 * n);
  return {
    points: rest.slice(0, 3 * n),
    simplices: faces.filter((_, i) => i % 4),
    corners: 3,
    volume: false,
    m,
  };
}
const lines = (array, columns, line) =>
  Array.from({ length: array.length / columns }, (_, i) =>
    line([...array.slice(columns * i, columns * (i + 1))]),
  ).join('\n');

function compare(name, file, shape, status, matrices, options) {
  // the quasi-Newton method makes more and more of the differences of rounding
  const iterations = options.minimizer === 'quasi_newton' ? 8 : 20;
  const report = `${name}.json`;
  const { weights = 'safe_cotangent', volume, corners } = shape;
  execFileSync(command, [
    file,
    '-o',
    `out.${volume ? 'mesh' : 'off'}`,
    '--selection',
    `${name}.sel`,
    '--transform',
    `${name}.def`,
    '--report',
    report,
    '--iterations',
    String(iterations),
    '--tolerance',
    '0',
    '--quiet',
    '--weights',
    weights,
    ...Object.entries(options).flatMap(([key, value]) => [`--${key}`, value]),
  ]);
  const native = JSON.parse(readFileSync(report)).energy;
  const session = arap.session(shape.points, shape.simplices, {
    corners,
    volume,
    weights,
    ...options,
  });
  const of = (k) => Int32Array.from([...status.keys()].filter((v) => status[v] === k));
  session.insertHandles(of(0));
  matrices.forEach((matrix, k) => {
    session.insertHandles(of(k + 2));
    session.transform(of(k + 2), matrix);
  });
  const { energy } = session.deform({ iterations, tolerance: 0 });
  assert.equal(energy.length, native.length, name);
  const worst = Math.max(...native.map((e, i) => Math.abs(energy[i] - e) / Math.abs(e)));
  assert(worst < 1e-9, `${name} ${JSON.stringify(options)}: ${worst}`);
  session.dispose();
  return worst;
}

const turn = (degrees, x, z) => {
  const c = Math.cos((degrees * Math.PI) / 180),
    s = Math.sin((degrees * Math.PI) / 180);
  return [c, -s, 0, x, s, c, 0, 0, 0, 0, 1, z, 0, 0, 0, 1];
};
for (const name of ['bar', 'cactus', 'volume']) {
  const shape = models[name][1](),
    { points, simplices, corners, volume, status } = shape,
    file = `${name}.${volume ? 'mesh' : 'off'}`;
  const n = points.length / 3,
    m = simplices.length / corners,
    matrices = [turn(70, 0.8, -0.3)];
  writeFileSync(
    file,
    volume
      ? `MeshVersionFormatted 2\nDimension 3\nVertices\n${n}\n` +
          `${lines(points, 3, (p) => `${p.join(' ')} 0`)}\nTetrahedra\n${m}\n` +
          `${lines(simplices, 4, (s) => `${s.map((v) => v + 1).join(' ')} 0`)}\nEnd\n`
      : `OFF\n${n} ${m} 0\n${lines(points, 3, (p) => p.join(' '))}\n` +
          `${lines(simplices, 3, (f) => `3 ${f.join(' ')}`)}\n`,
  );
  writeFileSync(`${name}.sel`, `${status.join('\n')}\n`);
  writeFileSync(
    `${name}.def`,
    `${matrices.map((a) => lines(a, 4, (row) => row.join(' '))).join('\n')}\n`,
  );
  for (const options of [
    { cells: 'spokes_and_rims' },
    { cells: 'elements' },
    { cells: 'spokes', minimizer: 'quasi_newton' },
  ])
    console.log(
      `${name}, ${Object.values(options).join(', ')}: energies differ by ` +
        compare(name, file, shape, [...status], matrices, options).toExponential(1),
    );
}
const folder = process.argv[2];
if (!folder) console.log('NOTICE: no folder with meshes was given');
for (const file of folder ? readdirSync(folder).filter((f) => f.endsWith('.off')) : []) {
  const name = file.slice(0, -4),
    status = numbers(`${folder}/${name}.sel`),
    entries = numbers(`${folder}/${name}.def`);
  for (const ending of ['sel', 'def'])
    writeFileSync(`${name}.${ending}`, readFileSync(`${folder}/${name}.${ending}`));
  const handles = Math.max(...status) - 1;
  const matrices = Array.from({ length: handles }, (_, k) =>
    entries.slice(entries.length === 16 ? 0 : 16 * k).slice(0, 16),
  );
  for (const cells of ['spokes', 'spokes_and_rims'])
    console.log(
      `${file}, ${cells}: energies differ by ` +
        compare(name, `${folder}/${file}`, readOff(`${folder}/${file}`), status, matrices, {
          cells,
        }).toExponential(1),
    );
}

// errors
const points = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0],
  faces = [0, 1, 2, 0, 2, 3];
const session = arap.session(points, faces);
const refuses = (f, kind, pattern, status) =>
  assert.throws(f, (error) => {
    assert(error instanceof kind, `${f}: ${error.name} ${error.message}`);
    assert.match(error.message, pattern);
    if (status) assert.equal(error.status, status);
    return true;
  });
for (const f of [() => session.preprocess(), () => session.deform()])
  refuses(f, ArapError, /vertex 0 is free/, 'no_fixed_vertex');
{
  const moved = Float64Array.from(points, (x, i) => x + (i === 8 ? 0.5 : 0));
  session.setPoints(moved);
  assert.deepEqual(session.points(), moved);
  assert.deepEqual(session.restPoints(), Float64Array.from(points));
  refuses(() => session.setPoints(points.slice(3)), ArapError, /4 vertices, but 3 points/, 'misuse');
  const broken = [...points.slice(0, 3), NaN, ...points.slice(4)];
  refuses(() => session.setPoints(broken), ArapError, /vertex 1 is not finite/, 'non_finite_point');
  assert.deepEqual(session.points(), moved);
  session.setPoints(points);
}
refuses(() => session.insertHandles([4]), ArapError, /no vertex 4/, 'misuse');
refuses(() => session.insertHandles([-1]), ArapError, /no vertex -1/, 'misuse');
refuses(() => session.insertHandles([0.5]), TypeError, /0\.5/);
refuses(() => session.insertHandles(new Float64Array([NaN])), TypeError, /NaN/);
refuses(() => session.insertHandles('0'), TypeError, /^vertices must be .*array/);
refuses(() => session.eraseHandles('0'), TypeError, /^handles must be/);
refuses(() => session.insertHandles([[0]]), TypeError, /flat/);
refuses(() => session.setTargets([0], [0, 0, 0]), ArapError, /neither/);
refuses(() => session.setOption('cells', 'rims'), ArapError, /rims/, 'invalid_option');
refuses(
  () => session.setOption('bending_length', -1),
  ArapError,
  /bending_length/,
  'invalid_option',
);
refuses(() => session.setStiffness([1]), ArapError, /1 values/);
refuses(() => session.transform([], [1, 2, 3]), RangeError, /rows of 4/);
refuses(() => session.restore({}), TypeError, /state\(\)/);
refuses(() => session.qualityAtVertices('beauty'), ArapError, /'beauty'.* one of edge/, 'misuse');
for (const iterations of [-1, NaN, 1.5, 2 ** 32])
  refuses(() => session.deform({ iterations }), ArapError, new RegExp(iterations));
refuses(() => session.deform({ iterations: '1' }), TypeError, /iterations/);
refuses(() => session.deform({ tolerance: '1' }), TypeError, /tolerance/);
for (const tolerance of [-1, NaN])
  for (const f of [
    () => session.deform({ tolerance }),
    () => session.setOption('tolerance', tolerance),
  ])
    refuses(f, ArapError, /tolerance/, 'invalid_option');
refuses(() => session.deform({ itarations: 1 }), TypeError, /itarations/);
refuses(() => session.advance({ dampin: 1 }), TypeError, /dampin/);
refuses(() => session.advance({ damping: '1' }), TypeError, /damping/);
refuses(() => session.advance({ damping: -1 }), ArapError, /damping/, 'invalid_option');
refuses(() => session.advance({ forces: [1, 2] }), RangeError, /rows of 3/);
refuses(() => session.advance({ forces: [1, 2, 3] }), ArapError, /forces/);
refuses(() => session.advance({ forces: [] }), ArapError, /forces/);
refuses(() => session.transform([], [], { fromrest: true }), TypeError, /fromrest/);
refuses(() => session.transform([], [], { fromRest: 'no' }), TypeError, /fromRest/);
for (const weight of [null, '', '1', undefined])
  refuses(() => session.setWeight([], weight), TypeError, /weight/);
for (const f of ['target', 'weight', 'pointPosition'])
  refuses(() => session[f]('0'), TypeError, /the handle must be a/);
refuses(() => session.insertPoint([], [1, 0, 0]), TypeError, /the simplex must be a number/);
for (const simplex of [-1, 2])
  refuses(() => session.insertPoint(simplex, [1, 0, 0]), ArapError, /no simplex (-1|2)/);
refuses(() => session.points(new Float64Array(11)), RangeError, /12 numbers/);
refuses(() => session.points([]), TypeError, /Float64Array/);
refuses(() => session.points(new Int32Array(12)), TypeError, /Float64Array/);
refuses(() => session.setOption('cells', undefined), TypeError, /no value/);
refuses(() => session.setOption('cells\0', 'spokes'), TypeError, /null character/);
refuses(() => session.option('colour'), ArapError, /colour/, 'invalid_option');
refuses(() => arap.session(points, faces, { volume: 'no' }), TypeError, /volume/);
refuses(() => arap.session(points, faces, { colour: 1 }), ArapError, /colour/, 'invalid_option');
refuses(() => session.locate([0, 0]), RangeError, /3 coordinates, not 2/);
refuses(() => session.locateAll([0, 0]), RangeError, /rows of 3/);
refuses(() => arap.session([1, 2], faces), RangeError, /rows of 3/);
refuses(() => arap.session(points, faces, { corners: [3, 2] }), RangeError, /5 corners of 2 faces/);
refuses(() => arap.session(points, faces, { corners: [3, 0] }), TypeError, /positive/);
refuses(() => arap.session(points, faces, { corners: '3' }), TypeError, /corners must be/);
refuses(() => arap.session(new BigInt64Array(3), faces), TypeError, /bigint/);
refuses(() => arap.session(points, faces, { corners: 2 }), ArapError, /three corners/);
arap.session(points, [], { volume: true, corners: [] }).dispose(); // is as without a list
for (const [list, corners] of [
  [[0, 1, 2, 3, 0, 1, 2], [4, 3]],
  [[0, 1, 2, 3, 0, 1, 2, -1], 4],
])
  refuses(
    () => arap.session(points, list, { volume: true, corners }),
    ArapError,
    /tetrahedron 1 has a negative corner/,
  );
refuses(() => arap.session(points, faces, { weights: 'none' }), ArapError, /weights 'none'/);
session.insertHandles([0, 1, 2]);
refuses(() => session.setTargets([0, 1], [0, 0, 0]), ArapError, /2 handles/);
session.setStiffness([1, 1, 1, -1]);
refuses(() => session.deform(), ArapError, /stiffness/, 'invalid_stiffness');
session.setStiffness();
session.setTargets([0], [NaN, 0, 0]);
refuses(() => session.deform(), ArapError, /vertex 0/, 'non_finite_point');
assert.deepEqual([...session.points()], points); // nothing was lost
session.setTargets([0], [0, 0, 0.5]);

// visitors
refuses(
  () =>
    session.deform({
      tolerance: 0,
      visitor() {
        throw new SyntaxError('mine');
      },
    }),
  SyntaxError,
  /mine/,
);
refuses(
  () =>
    session.deform({
      tolerance: 0,
      visitor() {
        session.dispose();
      },
    }),
  ArapError,
  /visit/,
  'in_a_run',
);
for (const change of [
  () => session.insertHandles([3]),
  () => session.eraseHandles([0]),
  () => session.clearHandles(),
  () => session.setRegion([0, 1]),
  () => session.reset(),
  () => session.makeRestShape(),
])
  refuses(() => session.deform({ tolerance: 0, visitor: change }), ArapError, /visit/, 'in_a_run');
assert.deepEqual([...session.handles()], [0, 1, 2]);
for (const visitor of [0, false, '', 'stop', {}])
  for (const run of ['deform', 'advance'])
    refuses(() => session[run]({ visitor }), TypeError, /the visitor is .* a function/);
for (const answer of ['Stop', true, 0, Promise.resolve('stop')])
  refuses(() => session.deform({ tolerance: 0, visitor: () => answer }), TypeError, /a visitor/);
for (const answer of [undefined, null, 'proceed'])
  assert.equal(
    session.deform({ iterations: 3, tolerance: 0, visitor: () => answer }).iterations,
    3,
  );
let firstIterate = NaN;
const stopped = session.deform({ tolerance: 0, visitor: (k) => ((firstIterate = k), 'stop') });
assert.deepEqual([stopped.status, firstIterate], ['stopped', 0]);
assert.equal(session.deform({ tolerance: 0, visitor: () => 'cancel' }).status, 'cancelled');
// the points of iterates, of a part of a shape, and in a run within a run
const sheet = models.sheet[1](),
  part = arap.session(sheet.points, sheet.simplices);
part.setRegion([...sheet.status.keys()].filter((v) => v % 71 < 60));
const lifted = [...sheet.status.keys()].filter((v) => sheet.status[v] === 2);
part.insertHandles(lifted);
part.transform(lifted, [1, 0, 0, 0.1, 0, 1, 0, 0, 0, 0, 1, 0.3]);
const iterates = [];
part.deform({
  iterations: 4,
  tolerance: 0,
  visitor(iteration, energy, ofOuter) {
    iterates.push([ofOuter(), ofOuter(new Float32Array(sheet.points.length)), ofOuter]);
    refuses(() => ofOuter([0]), TypeError, /Float64Array/);
    refuses(() => ofOuter(new Float64Array(4)), RangeError, /typed array of/);
    session.deform({
      iterations: 0,
      visitor(k, e, ofInner) {
        assert.deepEqual(ofInner(), session.points());
        refuses(ofOuter, ArapError, /points are for the visitor/);
      },
    });
    assert.deepEqual(ofOuter(), iterates.at(-1)[0]);
  },
});
assert.equal(iterates.length, 5);
assert.deepEqual(iterates.at(-1)[0], part.points());
assert.deepEqual(iterates.at(-1)[1], Float32Array.from(part.points()));
assert.notDeepEqual(iterates[1][0], part.points());
assert.deepEqual(iterates[1][0].slice(-3), sheet.points.slice(-3)); // outside the region
refuses(iterates[0][2], ArapError, /points are for the visitor/);
part.dispose();

// a run has the options of the session, unless it is given others
session.setOptions({ iterations: 2, tolerance: 0, verify_minimum: false, cells: undefined });
assert.equal(session.deform().iterations, 2);
assert.equal(session.deform({ iterations: 3 }).iterations, 3);
session.setOptions({ iterations: 1000, tolerance: 1e-3, verify_minimum: true });
session.setTargets([0], [0, 0, 0.55]);
const looked = session.deform();
assert.equal(looked.status, 'converged');
assert.equal(looked.end, 'minimum');
assert(['previous', 'rotations'].includes(looked.initialGuess));
for (const count of ['saddlesLeft', 'plateausLeft', 'lookingIterations'])
  assert(Number.isInteger(looked[count]), count);
assert.equal(session.deform({ iterations: 0 }).end, 'unknown');

// options are set together, whatever their order, or not at all
session.setOptions({ bending_length: 0, cells: 'elements' });
session.setOptions({ bending_length: 0.25, cells: 'spokes' });
assert.deepEqual(
  ['cells', 'bending_length', 'coarse_metric'].map((name) => session.option(name)),
  ['spokes', 0.25, true],
);
refuses(
  () => session.setOptions({ bending_length: 1, cells: 'rims' }),
  ArapError,
  /rims/,
  'invalid_option',
);
assert.equal(session.option('bending_length'), 0.25);
session.setOptions({ bending_length: 0, cells: 'spokes_and_rims' });

// motions of the targets add up, those of the rest shape do not
const up = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0.25];
session.setTargets([0], [0, 0, 0]);
for (const height of [0.25, 0.5]) {
  session.transform([0], up);
  assert.equal(session.target(0)[2], height);
}
session.transform([0], up, { fromRest: true });
assert.equal(session.target(0)[2], 0.25);

// what was prepared is reported once
session.setTargets([0], [0, 0, 0.6]);
session.setOption('cells', 'spokes');
session.preprocess();
assert.equal(session.deform().stages.factor, true);
assert.equal(session.deform().stages.factor, false);

// faces of different numbers of corners
{
  const kite = [...points, 0.5, 1.5, 0],
    mixed = arap.session(kite, [0, 1, 2, 3, 3, 2, 4], { corners: [4, 3] });
  assert.equal(mixed.numberOfSimplices, 2);
  const places = mixed.locateAll([0.5, 1.25, 2, 0.5, 0.25, -1, NaN, 0, 0]);
  assert.deepEqual(
    places.map(
      (place) => place && [place.simplex, place.coordinates.length, +place.distance.toFixed(12)],
    ),
    [[1, 3, 2], [0, 4, 1], null],
  );
  assert.deepEqual(mixed.locate([0.5, 0.25, -1]), places[1]);
  // soft handles that glide: on a plane, a line and a surface
  const all = [0, 1, 2, 3, 4];
  mixed.insertHandles(all);
  refuses(
    () => mixed.setTargetPlane(all, [0, 0, 1], [0, 0, 1]),
    ArapError,
    /handle 0 has a hard/,
    'invalid_weight',
  );
  mixed.setWeight(all, 1);
  const heights = () => [...mixed.points()].filter((_, i) => i % 3 === 2);
  const near = (a, b) => assert(Math.abs(a - b) < 1e-3, `${a} is not ${b}`);
  mixed.setTargetPlane(all, [5, 5, 1], [0, 0, -3]);
  mixed.deform({ tolerance: 1e-9 });
  heights().forEach((z) => near(z, 1));
  mixed.setTargetSurface(all, [-9, -9, 2, 9, -9, 2, 9, 9, 2, -9, 9, 2], [0, 1, 2, 3], {
    corners: 4,
  });
  mixed.deform({ tolerance: 1e-9 });
  heights().forEach((z) => near(z, 2));
  mixed.setTargetLine(0, [7, 3, 4], [2, 0, 0]);
  assert.deepEqual([...mixed.target(0)].slice(1), [3, 4]);
  for (const normal of [
    [0, 0, 0],
    [NaN, 0, 0],
  ])
    refuses(() => mixed.setTargetPlane(all, [0, 0, 0], normal), ArapError, /the normal must/);
  refuses(() => mixed.setTargetLine(all, [0, 0], [0, 0, 1]), RangeError, /the point: 2 numbers/);
  refuses(() => mixed.setTargetSurface(all, kite, [0, 1, 7]), ArapError, /vertex 7/);
  refuses(() => mixed.setTargetSurface(all, kite, [0, 1, 0]), ArapError, /no face with an area/);
  refuses(() => mixed.setTargetSurface(all, kite, [0, 1, 2], { c: 1 }), TypeError, /'c'/);
  const hole = [NaN, ...kite.slice(1)];
  refuses(() => mixed.setTargetSurface(all, hole, [0, 1, 2]), ArapError, /vertex 0, which is not f/);
  refuses(
    () => mixed.setTargetSurface(all, kite, [0, 1, 2, 3, 4], { corners: [3, 2] }),
    ArapError,
    /face 1 of the surface has fewer than three corners/,
  );
  // values for each handle; what fails changes nothing
  const inside = mixed.insertPoints(places.slice(0, 2));
  assert.deepEqual([...inside], [5, 6]);
  const found = places.slice(0, 2);
  const known = mixed.pointPosition(inside);
  assert(mixed.positions(found).every((x, i) => Math.abs(x - known[i]) < 1e-12));
  assert.equal(mixed.positions(found).length, 6);
  refuses(() => mixed.positions(places), TypeError, /place 2 is null/);
  for (const f of ['positions', 'insertPoints']) {
    refuses(() => mixed[f]([places[1], undefined]), TypeError, /place 1 is undefined/);
    refuses(() => mixed[f](places[1]), TypeError, /places must be an array/);
  }
  for (const f of ['positions', 'insertPoints'])
    refuses(
      () => mixed[f]([places[1], { simplex: 0, coordinates: [0, 0, 1] }]),
      ArapError,
      /place 1 has 3 coordinates, but simplex 0 has 4 corners/,
    );
  for (const f of ['positions', 'insertPoints'])
    for (const [coordinates, pattern] of [
      [[1, 1, 1], /place 1 needs barycentric coordinates that are finite and add up to one/],
      [[Infinity, 0, 1], /place 1 needs barycentric/],
      [[1, 0, 0, NaN], /place 1 has a coordinate that is NaN/],
    ])
      refuses(
        () => mixed[f]([places[1], { simplex: 1, coordinates }]),
        ArapError,
        pattern,
        'invalid_coordinates',
      );
  mixed.setWeight(inside, [2, 3]);
  assert.deepEqual([...mixed.weight(inside)], [2, 3]);
  assert.equal(mixed.weight(6), 3);
  mixed.setTargetPlane(inside, [0, 0, 4, 0, 0, 7], [0, 0, 1, 0, 0, 2]);
  assert.deepEqual(
    [...mixed.target(inside)].filter((_, i) => i % 3 === 2),
    [4, 7],
  );
  mixed.deform();
  const energy = mixed.energy();
  refuses(() => mixed.setWeight(inside, [5, Infinity]), ArapError, /finite/, 'invalid_weight');
  refuses(() => mixed.setWeight(all, [1, 2]), ArapError, /5 handles, but 2 weights/);
  assert.deepEqual([...mixed.handles()], [...all, ...inside]);
  assert.deepEqual([...mixed.weight(inside)], [2, 3]);
  assert.equal(mixed.energy(), energy);
  mixed.clearPoints();
  assert.deepEqual([...mixed.handles()], all);
  assert.equal(mixed.insertPoint(1, [0, 0, 1]), 7); // what failed used up no number
  mixed.dispose();
}

// undo
const before = session.points(),
  state = session.state();
session.setTargets([0], [0, 0, 1]);
session.deform();
session.restore(state);
assert.deepEqual(session.points(), before);
assert.deepEqual([...session.restPoints()], points);
state.dispose();
refuses(() => session.restore(state), TypeError, /disposed/);

// time steps: what falls freely keeps its shape, and the momentum is that of gravity
const falling = arap.session(points, faces);
let step;
for (let k = 0; k < 3; ++k)
  step = falling.advance({ timeStep: 0.1, density: 2, acceleration: [0, 0, -10] });
assert(step.status === 'converged' || step.status === 'success', step.message);
assert(Math.abs(step.mass - 2) < 1e-12, `mass ${step.mass}`);
step.momentum.forEach((p, k) => assert(Math.abs(p - [0, 0, -6][k]) < 1e-9, `momentum ${p}`));
assert(step.elasticEnergy < 1e-12 && Math.abs(step.kineticEnergy - 9) < 1e-9);
assert(Math.abs(step.centerOfMass[2] + 0.6) < 1e-9, `center ${step.centerOfMass}`);
assert.equal(step.energy.length, step.iterations + 1);
const every = Array.from({ length: falling.numberOfVertices }, (_, v) => v);
falling.reset();
assert(falling.velocities().every((x) => x === 0));
falling.setVelocities(every, every.flatMap(() => [1, 2, -3]));
const stays = falling.points();
falling.advance({ timeStep: 0.1 });
falling.points().forEach((x, k) => {
  assert(Math.abs(x - stays[k] - 0.1 * [1, 2, -3][k % 3]) < 1e-9);
  assert(Math.abs(falling.velocities()[k] - [1, 2, -3][k % 3]) < 1e-8);
});
refuses(() => falling.setVelocities([0, 1], [1, 2, 3]), ArapError, /2 vertices, but 1/);
falling.insertHandles(0);
assert.match(falling.preprocess(), /./);
let visits = 0;
falling.advance({ visitor: () => (++visits, 'stop') });
assert.equal(visits, 1);
falling.dispose();

// no memory is lost, although the heap may grow meanwhile
const big = models.bar[1](),
  sizes = [];
for (let k = 0; k < 40; ++k) {
  const s = arap.session(big.points, big.simplices);
  s.insertHandles([...big.status.keys()].filter((v) => big.status[v] !== 1));
  const kept = s.state();
  s.deform({ iterations: 1 });
  kept.dispose();
  s.dispose();
  sizes.push(arap.heapBytes());
}
assert.equal(sizes.at(-1), sizes[9], 'the heap grows');
session.dispose();
refuses(() => session.points(), ArapError, /disposed/);
session.dispose();
const { points: moved, report } = arap.deform(
  points,
  faces,
  [0, 1, 2],
  [0, 0, 0, 1, 0, 0, 1, 1, 0.2],
);
assert.equal(moved.length, 12);
assert.equal(report.freeVertices, 1);
const bent = [0, 0, 0.5, 1, 0, 0, 1, 1, 0.2],
  one = (options) => arap.deform(points, faces, [0, 1, 2], bent, options).report;
assert.equal(one({ iterations: 2, tolerance: 0 }).iterations, 2);
assert.equal(one({ verify_minimum: false, coarse_metric: false }).end, 'unknown');
refuses(() => one({ iterations: -1 }), ArapError, /iterations '-1'/, 'invalid_option');
console.log(`JavaScript: all is well; the heap is ${sizes.at(-1) / 2 ** 20} MB`);
