// The triangles that are drawn: of triangles and polygons, or of the boundary of tetrahedra; and
// what is computed from tetrahedra. A shape has the corners of its simplices one after the other,
// those of simplex s from starts[s] to starts[s + 1].
import { ShapeUtils, Vector2 } from 'three';

// of a tetrahedron, seen from outside
const facesOfTetrahedron = [
  [1, 2, 3],
  [0, 3, 2],
  [0, 1, 3],
  [0, 2, 1],
];

// where the simplices begin; corners is the number that all have, or a list of their numbers
export function startsOf(simplices, corners) {
  const isList = typeof corners !== 'number',
    starts = new Uint32Array((isList ? corners.length : simplices.length / corners) + 1);
  for (let s = 1; s < starts.length; ++s)
    starts[s] = starts[s - 1] + (isList ? corners[s - 1] : corners);
  return starts;
}

export const cornersOf = ({ simplices, starts }, s) =>
  simplices.subarray(starts[s], starts[s + 1]);

// the triangles of a polygon, cut in the plane of the coordinates in which it is largest
export function cut(polygon, points) {
  const at = (v, i) => points[3 * v + i] - points[3 * polygon[0] + i],
    normal = [0, 0, 0];
  polygon.forEach((v, k) => {
    const w = polygon[(k + 1) % polygon.length];
    for (let i = 0; i < 3; ++i) {
      const [a, b] = [(i + 1) % 3, (i + 2) % 3];
      normal[i] += at(v, a) * at(w, b) - at(v, b) * at(w, a);
    }
  });
  const sizes = normal.map(Math.abs),
    i = sizes.indexOf(Math.max(...sizes)),
    [a, b] = normal[i] < 0 ? [(i + 2) % 3, (i + 1) % 3] : [(i + 1) % 3, (i + 2) % 3],
    outline = Array.from(polygon, (v) => new Vector2(at(v, a), at(v, b))),
    triangles = ShapeUtils.triangulateShape(outline, []);
  if (triangles.length === polygon.length - 2)
    return triangles.map((t) => t.map((k) => polygon[k]));
  return Array.from({ length: polygon.length - 2 }, (_, k) => [
    polygon[0],
    polygon[k + 1],
    polygon[k + 2],
  ]); // its outline crosses itself, or it has no area
}

// { faces, simplexOf }: the corners of the triangles of polygons, and the polygon of each; the
// triangles themselves if there are no others
export function trianglesOf({ points, simplices, starts }) {
  if (simplices.length === 3 * (starts.length - 1)) return { faces: simplices };
  const faces = [],
    simplexOf = [];
  for (let s = 0; s + 1 < starts.length; ++s) {
    const polygon = cornersOf({ simplices, starts }, s);
    for (const triangle of polygon.length === 3 ? [polygon] : cut(polygon, points)) {
      faces.push(...triangle);
      simplexOf.push(s);
    }
  }
  return { faces: Int32Array.from(faces), simplexOf: Int32Array.from(simplexOf) };
}

// the faces of tetrahedra that belong to one of them only, seen from outside
export function boundary(tetrahedra, points) {
  const faces = new Map();
  for (let t = 0; t < tetrahedra.length; t += 4)
    for (const [i, j, k] of facesOfTetrahedron) {
      const face = [tetrahedra[t + i], tetrahedra[t + j], tetrahedra[t + k]];
      const key = [...face].sort((a, b) => a - b).join();
      if (!faces.delete(key)) faces.set(key, { face, t });
    }
  const result = [];
  for (const { face, t } of faces.values()) {
    const flipped = relativeVolume(points, tetrahedra, t) < 0;
    result.push(...(flipped ? face.reverse() : face));
  }
  return Int32Array.from(result);
}

// six times the volume of the tetrahedron whose corners begin at t, relative to three of its edges
function relativeVolume(p, tetrahedra, t) {
  const a = 3 * tetrahedra[t],
    b = 3 * tetrahedra[t + 1],
    c = 3 * tetrahedra[t + 2],
    d = 3 * tetrahedra[t + 3];
  const ux = p[b] - p[a],
    uy = p[b + 1] - p[a + 1],
    uz = p[b + 2] - p[a + 2];
  const vx = p[c] - p[a],
    vy = p[c + 1] - p[a + 1],
    vz = p[c + 2] - p[a + 2];
  const wx = p[d] - p[a],
    wy = p[d + 1] - p[a + 1],
    wz = p[d + 2] - p[a + 2];
  const volume =
    ux * (vy * wz - vz * wy) + uy * (vz * wx - vx * wz) + uz * (vx * wy - vy * wx);
  return volume / (Math.hypot(ux, uy, uz) * Math.hypot(vx, vy, vz) * Math.hypot(wx, wy, wz));
}

const flat = 1e-5; // what single precision leaves of a volume that is zero

// the corners of all faces of the tetrahedra that are inverted at these positions, and not flat
export function facesOfInverted({ points, simplices }, positions) {
  const corners = [];
  for (let t = 0; t < simplices.length; t += 4) {
    const now = relativeVolume(positions, simplices, t),
      rest = relativeVolume(points, simplices, t);
    if (now * rest < 0 && Math.min(Math.abs(now), Math.abs(rest)) > flat)
      for (const [i, j, k] of facesOfTetrahedron)
        for (const c of [i, j, k])
          for (let x = 0; x < 3; ++x) corners.push(positions[3 * simplices[t + c] + x]);
  }
  return corners;
}
