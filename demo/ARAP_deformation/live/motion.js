// Rigid motions as matrices of four rows, row by row, as in transform files.
import * as THREE from 'three';

export const identity = () => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

export const rigidParts = (handle) => {
  const m = new THREE.Matrix4().set(...handle.matrix),
    p = new THREE.Vector3(),
    q = new THREE.Quaternion();
  m.decompose(p, q, new THREE.Vector3());
  return { q, place: new THREE.Vector3(...handle.pivot).applyMatrix4(m) };
};

// the motion that turns by q and brings the pivot to a place
export function matrixOf(pivot, q, place) {
  const m = new THREE.Matrix4().makeRotationFromQuaternion(q);
  const moved = new THREE.Vector3(...pivot).applyMatrix4(m);
  m.setPosition(place.clone().sub(moved));
  return m.transpose().toArray(); // row by row
}

// a matrix without its rounding errors; null if it is no rigid motion
export function rigid(matrix) {
  const pivot = [0, 0, 0],
    { q, place } = rigidParts({ matrix, pivot }),
    motion = matrixOf(pivot, q.normalize(), place);
  return motion.every((x, i) => Math.abs(x - matrix[i]) < 1e-3) ? motion : null;
}

const boxOf = (points) => new THREE.Box3().setFromArray(points);

// of the box around points
export const diagonalOf = (points) => boxOf(points).getSize(new THREE.Vector3()).length();

// What is subtracted from coordinates that are far from zero, as they are drawn in single
// precision. To subtract it, and to add it to the result again, is exact.
export function originOf(points) {
  const size = diagonalOf(points);
  return boxOf(points)
    .getCenter(new THREE.Vector3())
    .toArray()
    .map((x) => (Math.abs(x) > 10 * size ? x : 0));
}

// points that are moved by a multiple of a vector
export const shifted = (points, by, factor) =>
  by.some((x) => x) ? points.map((x, i) => x + factor * by[i % 3]) : points;

// a motion of points as one of the same points that are moved by a multiple of a vector
export const shiftedMotion = (m, by, factor) =>
  m.map((x, i) =>
    i % 4 === 3 && i < 12
      ? x + factor * (by[(i - 3) / 4] - [0, 1, 2].reduce((sum, k) => sum + m[i - 3 + k] * by[k], 0))
      : x,
  );

export function center(points, list) {
  const c = [0, 0, 0];
  for (const v of list) for (let i = 0; i < 3; ++i) c[i] += points[3 * v + i] / list.length;
  return c;
}

// The rigid motion that takes vertices from their rest shape to where they are, by Horn's
// quaternion: what is painted in a deformed shape stays where it is.
export function fittedMotion(list, p, q) {
  const a = center(p, list),
    b = center(q, list),
    s = Array(9).fill(0);
  let size = 0;
  for (const v of list)
    for (let i = 0; i < 3; ++i)
      for (let j = 0; j < 3; ++j) {
        const product = (p[3 * v + i] - a[i]) * (q[3 * v + j] - b[j]);
        s[3 * i + j] += product;
        size += Math.abs(product);
      }
  const [xx, xy, xz, yx, yy, yz, zx, zy, zz] = s,
    shift = 2 * size || 1; // no eigenvalue is negative
  let n = [
    [shift + xx + yy + zz, yz - zy, zx - xz, xy - yx],
    [yz - zy, shift + xx - yy - zz, xy + yx, zx + xz],
    [zx - xz, xy + yx, shift + yy - xx - zz, yz + zy],
    [xy - yx, zx + xz, yz + zy, shift + zz - xx - yy],
  ];
  const dot = (u, v) => u.reduce((sum, x, i) => sum + x * v[i], 0);
  for (let k = 0; k < 30; ++k) {
    // squared: half as many steps are left
    const l = Math.hypot(...n.flat());
    n = n.map((row) => n.map((column) => dot(row, column) / l / l));
  }
  const f = n.map((row) => dot(row, [1, 0.01, 0.017, 0.029])),
    e = f.map((x) => x / Math.hypot(...f));
  const turn =
    list.length > 2 ? new THREE.Quaternion(e[1], e[2], e[3], e[0]) : new THREE.Quaternion();
  return matrixOf(a, turn, new THREE.Vector3(...b));
}
