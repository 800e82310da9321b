/**
 * As-rigid-as-possible deformation of surfaces and tetrahedral volumes (Sorkine and Alexa 2007).
 */

/**
 * Numbers one after another: points and targets are x, y, z, x, y, z, ...; matrices are row by row
 * (those of three.js are column by column: pass `matrix.clone().transpose().elements`).
 */
export type Numbers =
  | Float64Array
  | Float32Array
  | Int32Array
  | Uint32Array
  | Int16Array
  | Uint16Array
  | Int8Array
  | Uint8Array
  | Uint8ClampedArray
  | readonly number[];
/** Indices of vertices, simplices or handles, from 0, in any of these arrays. Where a number is taken, too, it stands for a list of one. */
export type Indices = Numbers;

/**
 * `misuse` is a wrong index, name or shape of an array; `out_of_memory`: the engine has no memory
 * left; the others are those of the C++ library.
 */
export type Status =
  | 'success'
  | 'converged'
  | 'iteration_limit'
  | 'stopped'
  | 'cancelled'
  | 'invalid_option'
  | 'in_a_run'
  | 'foreign_state'
  | 'invalid_stiffness'
  | 'undeclared_map'
  | 'invalid_rotation'
  | 'not_a_control_vertex'
  | 'invalid_weight'
  | 'invalid_coordinates'
  | 'dependent_target'
  | 'too_many_control_points'
  | 'not_a_simplex'
  | 'too_many_corners'
  | 'no_tetrahedron'
  | 'no_simplex'
  | 'non_finite_point'
  | 'non_finite_weight'
  | 'no_fixed_vertex'
  | 'singular_matrix'
  | 'solver_failed'
  | 'non_finite_energy'
  | 'out_of_memory'
  | 'misuse';

/** A call that failed, with a message. Nothing was changed. Arrays of other types are a
 *  TypeError, and those of an impossible length a RangeError; a number of rows that does not match
 *  that of another array is 'misuse'. */
export class ArapError extends Error {
  constructor(status: Status | '', message: string);
  status: Status;
}

export interface Options {
  /** which edges share a rotation; the default is `spokes_and_rims` */
  cells?: 'spokes' | 'spokes_and_rims' | 'elements' | `k_ring:${number}`;
  minimizer?: 'automatic' | 'local_global' | 'quasi_newton';
  initial_guess?: 'automatic' | 'previous' | 'rotations' | 'laplacian';
  /** the length over which a sharp bend is spread, in the unit of the points */
  bending_length?: number;
  /** the length over which rotations are made smooth */
  smoothing_length?: number;
  /** a run has at most so many; default 1000 */
  iterations?: number;
  /**
   * a run stops where the estimated relative gap to the minimum is at most this; default 0.001; 0
   * runs all iterations, and an automatic minimizer is `local_global` then
   */
  tolerance?: number;
  /** whether a run that converges looks whether it is at a saddle point; default true */
  verify_minimum?: boolean;
  /** whether runs of large shapes have a coarse metric, for fewer iterations; default true */
  coarse_metric?: boolean;
  /** as in the C++ library, but here there is only one, whatever the number is */
  threads?: number;
}

export interface Shape {
  /** of each simplex: 3 or more on a surface (default 3), 4 in a volume; or the numbers of all */
  corners?: number | Indices;
  /** whether the simplices are tetrahedra; default false */
  volume?: boolean;
  weights?: 'safe_cotangent' | 'cotangent' | 'clamped_cotangent' | 'uniform';
}

export interface Run {
  /** instead of those of the options */
  iterations?: number;
  tolerance?: number;
  visitor?: Visitor;
}

/** Copies points, n x 3, into an array or a new one. */
export interface PointsCopy {
  (): Float64Array;
  <T extends Float64Array | Float32Array>(out: T): T;
}

/**
 * Called with the initial guess, as iteration 0, and after each iteration; may end the run, or
 * cancel it, which leaves all as it was. What it throws is thrown. `points` is for a preview: it has the
 * points of the iterate, until it returns, and while no other visitor is called.
 */
export type Visitor = (
  iteration: number,
  energy: number,
  points: PointsCopy,
) => 'proceed' | 'stop' | 'cancel' | null | void;

/** A time step of implicit Euler, in any consistent units. */
export interface Step {
  /** default 1 / 60 */
  timeStep?: number;
  /** mass per area, or per volume of tetrahedra; default 1 */
  density?: number;
  /** energy per area or volume; default 1 */
  modulus?: number;
  /** the rate at which velocities decay; default 0 */
  damping?: number;
  /** of all vertices, such as that of gravity */
  acceleration?: Numbers;
  /** n x 3 */
  forces?: Numbers;
  visitor?: Visitor;
}

export interface Report {
  status: Status;
  message: string;
  /** which was taken */
  initialGuess: 'previous' | 'rotations' | 'laplacian';
  iterations: number;
  /** of the initial guess, and after each iteration */
  energy: Float64Array;
  finalEnergy: number;
  energyScale: number;
  roundingLevel: number;
  estimatedRelativeGap: number;
  freeVertices: number;
  simplices: number;
  invertedSimplices: number;
  /** what the second derivative of the energy tells of where the run ended */
  end: 'unknown' | 'minimum' | 'flat' | 'undecided';
  /** how many saddle points, and plateaus, the run would have ended at, and has left */
  saddlesLeft: number;
  plateausLeft: number;
  /** how many iterations looked at the second derivative, or tried where it leads, and moved
   *  nothing */
  lookingIterations: number;
  /** the smallest vertex of each part that nothing holds; these stay where they are */
  unconstrainedComponents: Int32Array;
  /** what had to be done again since the last run, before the iterations */
  stages: { region: boolean; weights: boolean; order: boolean; factor: boolean; border: boolean };
  /** in seconds */
  seconds: {
    preprocess: number;
    transfer: number;
    initialGuess: number;
    localSteps: number;
    globalSteps: number;
    visitor: number;
    total: number;
  };
}

/**
 * The mass, momenta and energies are those of the free vertices. `energy`, which the step minimizes,
 * has a term of inertia; `elasticEnergy` has none: it is the modulus times `Session.energy()`.
 */
export interface StepReport extends Report {
  mass: number;
  centerOfMass: number[];
  momentum: number[];
  angularMomentum: number[];
  kineticEnergy: number;
  elasticEnergy: number;
}

export interface Place {
  simplex: number;
  /** barycentric */
  coordinates: number[];
  distance: number;
}

/** null, for a point that was not located, is refused */
export type Places = readonly ({ simplex: number; coordinates: Numbers } | null)[];

export interface Quality {
  edgeLengthError: number;
  areaChange: number;
  /** not a number for a surface that is not closed */
  volumeChange: number;
  /** in degrees */
  largestAngleChange: number;
  largestSpike: number;
  invertedSimplices: number;
}

declare const state: unique symbol;

/** A value for undo and redo, which only `state()` makes. */
export interface State {
  readonly [state]: true;
  dispose(): void;
}

/**
 * A deformation of n vertices. A handle is a number: that of a vertex, or from n on that of a
 * control point inside a simplex.
 * Its memory is outside of what JavaScript collects at once: call `dispose()` at the end.
 */
export interface Session {
  readonly numberOfVertices: number;
  readonly numberOfSimplices: number;
  readonly isVolume: boolean;
  dispose(): void;

  /** a copy of where the vertices are, n x 3, or into an array of that length, which is returned */
  points(): Float64Array;
  points<T extends Float64Array | Float32Array>(out: T): T;
  /** The next run starts from these positions, and fixed vertices that are no handles stay there.
   *  The rest shape and the targets do not change. */
  setPoints(points: Numbers): void;
  restPoints(): Float64Array;
  restPoints<T extends Float64Array | Float32Array>(out: T): T;

  setOption<Name extends keyof Options>(name: Name, value: NonNullable<Options[Name]>): void;
  /** Sets all of them, or none if they are not valid together. What is undefined stays as it is. */
  setOptions(options: Options): void;
  option<Name extends keyof Options>(name: Name): NonNullable<Options[Name]>;

  /** All vertices are in the region of interest at first. Handles at vertices outside of it are
   *  erased; points stay. */
  setRegion(vertices: Indices | number): void;
  region(): Int32Array;

  /** vertices that become handles, whose targets are where they are; they enter the region */
  insertHandles(vertices: Indices | number): void;
  /** makes control vertices free, which stay in the region, and erases control points */
  eraseHandles(handles: Indices | number): void;
  /** erases all of them: control vertices and control points */
  clearHandles(): void;
  /** erases the handles that are control points */
  clearPoints(): void;
  handles(): Int32Array;

  /** The place nearest to a point where the shape is now. For a point outside of all tetrahedra the
   *  coordinates are those of the point itself: some are negative. Each call builds a search tree:
   *  for more than one point use `locateAll()`. */
  locate(point: Numbers): Place | null;
  /** the place of each of k x 3 points */
  locateAll(points: Numbers): (Place | null)[];
  /** a new control point; returns its handle. Messages number control points from 1: number k is
   *  the handle n + k - 1. */
  insertPoint(simplex: number, coordinates: Numbers): number;
  /** new control points at places, as `locateAll()` returns them: all of them, or none */
  insertPoints(places: Places): Int32Array;
  /** Where places are now, k x 3. What was located in the rest shape follows the shape, as a fine
   *  surface does that is located in tetrahedra. */
  positions(places: Places): Float64Array;
  /** where control points are: 3 numbers for each */
  pointPosition(handles: Indices | number): Float64Array;

  setTargets(handles: Indices | number, targets: Numbers): void;
  /** Pulls handles, whose weights are finite, toward a plane, along which they can glide, or each
   *  toward its own: point and normal have three numbers for all, or for each. It is their target
   *  until they get another one, or are reset. */
  setTargetPlane(handles: Indices | number, point: Numbers, normal: Numbers): void;
  /** the same, toward a line */
  setTargetLine(handles: Indices | number, point: Numbers, direction: Numbers): void;
  /** the same, toward the nearest points of a surface, as a registration does; each energy takes a
   *  search for each handle */
  setTargetSurface(
    handles: Indices | number,
    points: Numbers,
    faces: Indices,
    options?: { corners?: number | Indices },
  ): void;
  /** 3 numbers for each; of a target set the point nearest to the handle */
  target(handles: Indices | number): Float64Array;
  /**
   * moves targets by a matrix of 3 x 4 or 4 x 4: by default the matrix is applied to the present
   * targets, so that repeated calls add up, and so do handles that are listed twice; with fromRest
   * the targets are where it takes the points of the rest shape, which stays as it is
   */
  transform(handles: Indices | number, matrix: Numbers, options?: { fromRest?: boolean }): void;
  weight(handle: number): number;
  weight(handles: Indices): Float64Array;
  /** one for all or one for each; Infinity: a hard target, which is met exactly */
  setWeight(handles: Indices | number, weight: number | Numbers): void;
  /** of the cells around vertices, 3 x 3 for all or for each, from the rest shape: it is given, and
   *  not fitted */
  setRotation(vertices: Indices | number, matrix: Numbers): void;
  /** the same, with the rotation of the rigid motion that takes these vertices to their targets */
  setRotationsOfMotion(vertices: Indices | number): void;
  /** lets them be fitted again */
  eraseRotations(vertices: Indices | number): void;

  /** A value for each vertex, or for each simplex if cells are elements; without an argument 1. The
   *  values belong to these cells: clear them before the option `cells` changes to elements, or
   *  from these to others. */
  setStiffness(values?: Numbers): void;
  /** lets cells with the same number from 0 on share a rotation; those with a negative number have
   *  their own. The part can still stretch: a rigid one has a large stiffness, too. */
  setGroups(groups?: Indices): void;

  /**
   * does what the next call of `deform()` needs, such as the factorization, before it is made;
   * returns a message, which also says what unconstrained components there are. Not for time
   * steps, which need another factorization.
   */
  preprocess(): string;
  deform(run?: Run): Report;
  advance(step?: Step): StepReport;

  /** n x 3: the velocities that the next step begins with; zero outside the region, and after
   *  `deform()` and `reset()` */
  velocities(): Float64Array;
  /** of vertices of the region */
  setVelocities(vertices: Indices | number, velocities: Numbers): void;

  /** back to the rest shape: keeps weights, erases prescribed rotations and velocities, and makes
   *  points of targets that are sets */
  reset(): void;
  /** of the present positions: keeps targets and weights, erases prescribed rotations */
  makeRestShape(): void;
  state(): State;
  restore(state: State): void;

  /** after the last run, without inertia; not a number where there is none */
  energy(): number;
  /** 3 x 3 for each cell; the identity outside the region, where no vertex of the cell is free, as
   *  inside a handle (unless rotations are smoothed, or shared), and until the first run after a
   *  change of the region or the cells, `reset()` or `makeRestShape()` */
  rotations(): Float64Array;
  quality(): Quality;
  qualityAtVertices(
    measure: 'edge_length_error' | 'size_change' | 'angle_change' | 'spike',
  ): Float64Array;
}

export interface Arap {
  session(points: Numbers, simplices: Indices, options?: Shape & Options): Session;
  /** one deformation, without a session; vertices that stay are handles, too, with their own
   *  positions as targets */
  deform(
    points: Numbers,
    simplices: Indices,
    handles: Indices | number,
    targets: Numbers,
    options?: Shape & Options,
  ): { points: Float64Array; report: Report };
  /** the memory of the engine, which never shrinks */
  heapBytes(): number;
}

/** Starts an engine. `wasmBinary` is for pages that bring the file arap.wasm themselves. */
export function load(options?: { wasmBinary?: ArrayBuffer | Uint8Array }): Promise<Arap>;
