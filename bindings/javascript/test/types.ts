// The declarations, as a program uses them.
import { load, ArapError, type Report, type Status } from 'arap-deformation';

const arap = await load();
const session = arap.session(new Float64Array(9), [0, 1, 2], {
  weights: 'uniform',
  cells: 'spokes',
});
const length: number = session.option('bending_length');
const momentum: number[] = session.advance({ damping: 1 }).momentum;
session.setOptions({ cells: 'k_ring:2', bending_length: 0.1, verify_minimum: false });
session.setOption('coarse_metric', true);
session.setOption('threads', 1);
session.transform([0], [], { fromRest: true });
session.setTargetSurface(0, [], [], { corners: [3, 4] });
const simplices: (number | undefined)[] = session.locateAll([]).map((place) => place?.simplex);
const handles: Int32Array = session.insertPoints(session.locateAll([]));
type Attribute = Float32Array | Float64Array | Uint16Array | Uint8ClampedArray; // as three.js has it
arap.session(new Float32Array(9) as Attribute, new Uint16Array(3) as Attribute);
session.positions([{ simplex: 0, coordinates: new Float64Array(3) }]);
session.setWeight(handles, [1, 2]);
const weight: number = session.weight(0),
  weights: Float64Array = session.weight(handles);
const report: Report = session.deform({
  iterations: 3,
  tolerance: 0,
  visitor: (_, energy, points) =>
    energy > 1 || points(new Float32Array(9))[0] > points()[0] ? 'stop' : undefined,
});
const status: Status = report.status;
const end: 'unknown' | 'minimum' | 'flat' | 'undecided' = report.end;
const points: Float32Array = session.points(new Float32Array(9));
// @ts-expect-error there are no such cells
session.setOptions({ cells: 'rims' });
// @ts-expect-error there is no such option
session.setOption('itarations', 5);
// @ts-expect-error cells are named
session.setOption('cells', 5);
// @ts-expect-error a session is no state
session.restore(session);
// @ts-expect-error indices are numbers
session.insertHandles('all');
export { status, end, simplices, points, length, momentum, ArapError };
