// Shapes made in code, each with regions to start with: a status of each vertex as in selection
// files, 0 fixed, 1 free, k >= 2 the k-2nd handle.

const shape = (points, simplices, status, rest = {}) => {
  const p = Float64Array.from(points);
  const statuses = Int32Array.from({ length: p.length / 3 }, (_, v) =>
    status(p[3 * v], p[3 * v + 1], p[3 * v + 2]),
  );
  return {
    points: p,
    simplices: Int32Array.from(simplices),
    corners: 3,
    volume: false,
    status: statuses,
    ...rest,
  };
};

// the surface of a grid of cubes, whose cells are those where isInside holds
function voxelSurface(size, isInside) {
  const [nx, ny, nz] = size,
    ids = new Map(),
    corners = [],
    faces = [];
  const inside = (x, y, z) =>
    x >= 0 && y >= 0 && z >= 0 && x < nx && y < ny && z < nz && isInside(x, y, z);
  const id = (x, y, z) => {
    const key = (z * (ny + 1) + y) * (nx + 1) + x;
    if (!ids.has(key)) {
      ids.set(key, corners.length / 3);
      corners.push(x, y, z);
    }
    return ids.get(key);
  };
  for (let z = 0; z < nz; ++z)
    for (let y = 0; y < ny; ++y)
      for (let x = 0; x < nx; ++x) {
        if (!inside(x, y, z)) continue;
        const here = [x, y, z];
        for (let axis = 0; axis < 3; ++axis)
          for (const side of [0, 1]) {
            const next = [...here];
            next[axis] += side ? 1 : -1;
            if (inside(...next)) continue;
            const u = (axis + 1) % 3,
              v = (axis + 2) % 3;
            const corner = (du, dv) => {
              const c = [...here];
              c[axis] += side;
              c[u] += du;
              c[v] += dv;
              return id(...c);
            };
            const q = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            if (!side) q.reverse();
            faces.push(q[0], q[1], q[2], q[0], q[2], q[3]);
          }
      }
  return { corners, faces };
}

function smoothed(points, faces, rounds) {
  let p = Float64Array.from(points);
  const n = p.length / 3,
    neighbors = Array.from({ length: n }, () => new Set());
  for (let f = 0; f < faces.length; f += 3)
    for (let k = 0; k < 3; ++k) {
      neighbors[faces[f + k]].add(faces[f + ((k + 1) % 3)]);
      neighbors[faces[f + ((k + 1) % 3)]].add(faces[f + k]);
    }
  for (let round = 0; round < rounds; ++round) {
    const factor = round % 2 ? -0.53 : 0.5,
      q = p.slice(); // Taubin's: it does not shrink
    for (let v = 0; v < n; ++v)
      for (let c = 0; c < 3; ++c) {
        let sum = 0;
        neighbors[v].forEach((w) => {
          sum += p[3 * w + c];
        });
        q[3 * v + c] += factor * (sum / neighbors[v].size - p[3 * v + c]);
      }
    p = q;
  }
  return p;
}

function bar() {
  const n = 8,
    length = 40,
    { corners, faces } = voxelSurface([n, n, length], () => true);
  return shape(
    corners.map((x, i) => (i % 3 === 2 ? x / n : x / n - 0.5)),
    faces,
    (x, y, z) => (z < 0.3 ? 0 : z > length / n - 0.3 ? 2 : 1),
  );
}

// a stem with two arms
function cactus() {
  const size = [68, 16, 88],
    middle = [34, 8];
  const distance = (x, y, z, a, b) => {
    const d = b.map((c, i) => c - a[i]),
      l = d.reduce((s, c) => s + c * c, 0);
    const t = Math.max(0, Math.min(1, [x, y, z].reduce((s, c, i) => s + (c - a[i]) * d[i], 0) / l));
    return Math.hypot(...[x, y, z].map((c, i) => c - a[i] - t * d[i]));
  };
  const bones = [
    [[0, 0, 0], [0, 0, 76], 6.6],
    [[0, 0, 30], [22, 0, 36], 4.6],
    [[22, 0, 36], [24, 0, 62], 4.6],
    [[0, 0, 44], [-20, 0, 48], 4.2],
    [[-20, 0, 48], [-22, 0, 70], 4.2],
  ];
  const { corners, faces } = voxelSurface(size, (x, y, z) =>
    bones.some(
      ([a, b, r]) => distance(x + 0.5 - middle[0], y + 0.5 - middle[1], z + 0.5, a, b) < r,
    ),
  );
  const points = smoothed(corners, faces, 40).map((x, i) =>
    i % 3 === 2 ? x / 40 : (x - middle[i % 3]) / 40,
  );
  return shape(points, faces, (x, y, z) => (z < 0.12 ? 0 : Math.abs(x) < 0.3 && z > 1.7 ? 2 : 1));
}

function sheet() {
  const n = 70,
    points = [],
    faces = [];
  for (let i = 0; i <= n; ++i)
    for (let j = 0; j <= n; ++j) {
      points.push((2 * i) / n - 1, (2 * j) / n - 1, 0);
      if (i === n || j === n) continue;
      const a = i * (n + 1) + j,
        b = a + n + 1;
      if ((i + j) % 2) faces.push(a, b, b + 1, a, b + 1, a + 1);
      else faces.push(a, b, a + 1, b, b + 1, a + 1);
    }
  return shape(points, faces, (x, y) =>
    Math.max(Math.abs(x), Math.abs(y)) > 0.97 ? 0 : Math.hypot(x, y) < 0.12 ? 2 : 1,
  );
}

// an icosahedron whose faces are cut into f^2 triangles: 10 f^2 + 2 vertices
export function sphere(f = 32) {
  const t = (1 + Math.sqrt(5)) / 2;
  const V = [
    [-1, t, 0],
    [1, t, 0],
    [-1, -t, 0],
    [1, -t, 0],
    [0, -1, t],
    [0, 1, t],
    [0, -1, -t],
    [0, 1, -t],
    [t, 0, -1],
    [t, 0, 1],
    [-t, 0, -1],
    [-t, 0, 1],
  ];
  const T = [
    [0, 11, 5],
    [0, 5, 1],
    [0, 1, 7],
    [0, 7, 10],
    [0, 10, 11],
    [1, 5, 9],
    [5, 11, 4],
    [11, 10, 2],
    [10, 7, 6],
    [7, 1, 8],
    [3, 9, 4],
    [3, 4, 2],
    [3, 2, 6],
    [3, 6, 8],
    [3, 8, 9],
    [4, 9, 5],
    [2, 4, 11],
    [6, 2, 10],
    [8, 6, 7],
    [9, 8, 1],
  ];
  const ids = new Map(),
    points = [],
    faces = [];
  for (const [a, b, c] of T) {
    const vertex = (i, j) => {
      const shares = [
        [a, f - i - j],
        [b, i],
        [c, j],
      ]
        .filter((s) => s[1] > 0)
        .sort((p, q) => p[0] - q[0]);
      const key = shares.join(';');
      if (!ids.has(key)) {
        const p = [0, 1, 2].map((k) => shares.reduce((s, [v, w]) => s + V[v][k] * w, 0)),
          l = Math.hypot(...p);
        ids.set(key, points.length / 3);
        points.push(p[0] / l, p[1] / l, p[2] / l);
      }
      return ids.get(key);
    };
    for (let i = 0; i < f; ++i) {
      const low = Array.from({ length: f - i + 1 }, (_, j) => vertex(i, j));
      const high = Array.from({ length: f - i }, (_, j) => vertex(i + 1, j));
      for (let j = 0; j < f - i; ++j) {
        faces.push(low[j], high[j], low[j + 1]);
        if (j + 1 < f - i) faces.push(high[j], high[j + 1], low[j + 1]);
      }
    }
  }
  return shape(points, faces, (x, y, z) => (z < -0.9 ? 0 : z > 0.95 ? 2 : 1));
}

// cubes of five tetrahedra, alternately
function tetrahedralBar() {
  const [nx, ny, nz] = [6, 6, 28],
    points = [],
    tetrahedra = [];
  const id = (x, y, z) => (z * (ny + 1) + y) * (nx + 1) + x;
  for (let z = 0; z <= nz; ++z)
    for (let y = 0; y <= ny; ++y)
      for (let x = 0; x <= nx; ++x) points.push(x / nx - 0.5, y / ny - 0.5, z / nx);
  for (let z = 0; z < nz; ++z)
    for (let y = 0; y < ny; ++y)
      for (let x = 0; x < nx; ++x) {
        const c = (k) => id(x + (k & 1), y + ((k >> 1) & 1), z + (k >> 2));
        const fives =
          (x + y + z) % 2
            ? [
                [0, 1, 2, 4],
                [3, 2, 1, 7],
                [5, 4, 7, 1],
                [6, 7, 4, 2],
                [1, 2, 4, 7],
              ]
            : [
                [1, 3, 0, 5],
                [2, 0, 3, 6],
                [4, 5, 6, 0],
                [7, 6, 5, 3],
                [0, 3, 6, 5],
              ];
        fives.forEach((tetrahedron) => tetrahedra.push(...tetrahedron.map(c)));
      }
  return shape(points, tetrahedra, (x, y, z) => (z < 0.1 ? 0 : z > nz / nx - 0.1 ? 2 : 1), {
    corners: 4,
    volume: true,
  });
}

export const models = {
  cactus: ['Cactus', cactus],
  bar: ['Bar', bar],
  sheet: ['Sheet', sheet],
  sphere: ['Sphere', sphere],
  volume: ['Bar of tetrahedra', tetrahedralBar],
};
