// Mesh files, and the selections and transforms of arap_deform: text or bytes to arrays and back.
// What is wrong with a file is an Error with a message.
import { STLLoader } from 'three/examples/jsm/loaders/STLLoader.js';
import { mergeVertices } from 'three/examples/jsm/utils/BufferGeometryUtils.js';
import { cornersOf, cut } from './faces.js';
import { diagonalOf, rigid } from './motion.js';

const fail = (sentence) => {
  throw new Error(sentence);
};

// the words of a text without comments
class Words {
  constructor(text) {
    this.words = text.replace(/#[^\n]*/g, '').match(/\S+/g) ?? [];
    this.next = 0;
  }
  get isAtEnd() {
    return this.next >= this.words.length;
  }
  word() {
    return this.isAtEnd ? fail('it ends too early') : this.words[this.next++];
  }
  number(what) {
    const word = this.word(),
      x = Number(word);
    return Number.isFinite(x) ? x : fail(`${what} is ${word}, which is no number`);
  }
  count(what) {
    const x = this.number(what);
    return Number.isInteger(x) && x >= 0 ? x : fail(`${what} is ${x}`);
  }
}

// memory and time grow with the square of the number of corners
const mostCorners = 64;

// The corners of polygons one after the other, and their numbers if they differ from 3. A file
// counts its vertices from `first`.
function surface(points, polygons, first = 0) {
  const n = points.length / 3;
  for (const polygon of polygons) {
    if (polygon.length < 3) fail(`a face has ${polygon.length} corners`);
    polygon.forEach((v, k) => {
      if (!(Number.isInteger(v) && v >= 0 && v < n))
        fail(`a face has the vertex ${v + first}, but there are ${n} vertices`);
      if (polygon.indexOf(v) < k) fail(`a face has the vertex ${v + first} twice`);
    });
  }
  const large = polygons.filter((polygon) => polygon.length > mostCorners).length,
    faces = large
      ? polygons.flatMap((p) => (p.length > mostCorners ? cut(p, points) : [p]))
      : polygons;
  return {
    points: Float64Array.from(points),
    simplices: Int32Array.from(faces.flat()),
    corners: faces.every((face) => face.length === 3)
      ? 3
      : Int32Array.from(faces, (face) => face.length),
    volume: false,
    note: large
      ? `Faces with more than ${mostCorners} corners were cut into triangles: ${large}.`
      : '',
  };
}

function readOff(text) {
  const words = new Words(text);
  if (!/^(ST|C|N)*OFF$/.test(words.words[0] ?? '')) fail('it does not begin with OFF');
  const kind = words.word();
  const n = words.count('the number of vertices'),
    m = words.count('the number of faces');
  words.count('the number of edges');
  const lines = text
    .replace(/#[^\n]*/g, '')
    .split('\n')
    .map((line) => line.trim())
    .filter(Boolean);
  let line = lines.findIndex((l) => /OFF/.test(l));
  line += /OFF\s+\d/.test(lines[line]) ? 1 : 2; // the counts may be on the first line
  const numbers = (what) =>
    lines[line] === undefined
      ? fail(`it ends before ${what}`)
      : lines[line++].split(/\s+/).map(Number);
  if (n + m > lines.length) fail(`it has fewer lines than its ${n} vertices and ${m} faces`);
  const points = new Float64Array(3 * n),
    polygons = [];
  for (let v = 0; v < n; ++v) {
    const p = numbers(`vertex ${v}`);
    if (p.length < 3 || !p.slice(0, 3).every(Number.isFinite))
      fail(`vertex ${v} has no three coordinates${kind === 'OFF' ? '' : ` (${kind})`}`);
    points.set(p.slice(0, 3), 3 * v);
  }
  for (let f = 0; f < m; ++f) {
    const [k, ...corners] = numbers(`face ${f}`);
    if (!(Number.isInteger(k) && k >= 0))
      fail(`face ${f} does not begin with the number of its corners`);
    if (corners.length < k) fail(`face ${f} has fewer corners than it says`);
    polygons.push(corners.slice(0, k));
  }
  return surface(points, polygons);
}

function readObj(text) {
  const points = [],
    polygons = [];
  text
    .replace(/#[^\n]*/g, '')
    .replace(
      /^(?:[^\n]*\\\r?\n)+[^\n]*/gm,
      // one line, and empty ones that keep the numbers of those that follow
      (lines) => lines.replace(/\\\r?\n/g, ' ') + '\n'.repeat(lines.split('\n').length - 1),
    )
    .split('\n')
    .forEach((line, number) => {
      const [key, ...words] = line.trim().split(/\s+/);
      if (key === 'v') {
        const p = words.slice(0, 3).map(Number);
        if (p.length < 3 || !p.every(Number.isFinite))
          fail(`line ${number + 1}: a vertex needs three coordinates`);
        points.push(...p);
      }
      if (key === 'f')
        polygons.push(
          words.map((word) => {
            const v = Number(word.split('/')[0]),
              n = points.length / 3;
            if (!Number.isInteger(v) || v < -n)
              fail(`line ${number + 1}: a face has the vertex ${word}`);
            return v < 0 ? n + v : v - 1;
          }),
        );
    });
  return surface(points, polygons, 1);
}

function readMedit(text) {
  const words = new Words(text),
    found = {};
  const sections = { vertices: 4, tetrahedra: 5, triangles: 4 };
  while (!words.isAtEnd) {
    const keyword = words.word().toLowerCase();
    if (keyword === 'end') break;
    if (!(keyword in sections) || found[keyword]) continue;
    const n = words.count(`the number of ${keyword}`),
      columns = sections[keyword];
    if (n * columns > words.words.length) fail(`it is too short for ${n} ${keyword}`);
    const numbers = new Float64Array((columns - 1) * n);
    for (let i = 0; i < n; ++i) {
      for (let c = 0; c + 1 < columns; ++c)
        numbers[(columns - 1) * i + c] = words.number(`row ${i + 1} of ${keyword}`);
      words.word(); // the reference
    }
    found[keyword] = numbers;
  }
  const { vertices, tetrahedra, triangles } = found;
  if (!vertices) fail('it has no Vertices');
  const n = vertices.length / 3,
    corners = tetrahedra?.length ? 4 : 3,
    simplices = corners === 4 ? tetrahedra : triangles;
  if (!simplices?.length) fail('it has neither tetrahedra nor triangles');
  simplices.forEach((v) => {
    if (!(Number.isInteger(v) && v >= 1 && v <= n))
      fail(`an element has the vertex ${v}, but there are ${n} vertices`);
  });
  for (let i = 0; i < simplices.length; i += corners) {
    const element = simplices.subarray(i, i + corners),
      twice = element.find((v, k) => element.indexOf(v) < k);
    if (twice) fail(`an element has the vertex ${twice} twice`);
  }
  return {
    points: vertices,
    simplices: Int32Array.from(simplices, (v) => v - 1),
    corners,
    volume: corners === 4,
  };
}

// what the types of PLY files are also called
const namesInPly = {
  char: 'int8',
  uchar: 'uint8',
  short: 'int16',
  ushort: 'uint16',
  int: 'int32',
  uint: 'uint32',
  float: 'float32',
  double: 'float64',
};

function readPly(bytes) {
  const text = new TextDecoder('latin1').decode(bytes),
    [header] =
      text.match(/^ply[^]*?[\r\n]end_header *(\r\n|\r|\n|$)/) ?? fail('it has no header'),
    words = /^format +ascii/m.test(header) && new Words(text.slice(header.length)),
    isLittle = /^format +binary_little/m.test(header),
    view = new DataView(bytes, header.length),
    elements = [],
    points = [],
    polygons = [];
  let at = 0;
  const readerOf = (type) => {
    if (words) return () => Number(words.word());
    const name = namesInPly[type] ?? type,
      get = view[`get${name[0].toUpperCase()}${name.slice(1)}`],
      size = parseInt(name.replace(/\D+/, ''), 10) / 8;
    if (!get) fail(`the type ${type} is not known`);
    return () => get.call(view, (at += size) - size, isLittle);
  };
  for (const line of header.split(/[\r\n]+/)) {
    const [key, ...rest] = line.trim().split(/\s+/);
    if (key === 'element') elements.push({ name: rest[0], count: Number(rest[1]), properties: [] });
    if (key === 'property')
      elements.at(-1)?.properties.push({
        name: rest.at(-1),
        isList: rest[0] === 'list',
        readers: rest.slice(rest[0] === 'list' ? 1 : 0, -1).map(readerOf),
      });
  }
  for (const { name, count, properties } of elements)
    for (let i = 0; i < count; ++i) {
      const row = {};
      for (const { name: key, isList, readers } of properties)
        row[key] = isList ? Array.from({ length: readers[0]() }, readers[1]) : readers[0]();
      if (name === 'vertex') points.push(row.x, row.y, row.z);
      if (name === 'face') polygons.push(row.vertex_indices ?? row.vertex_index ?? []);
    }
  return surface(points, polygons);
}

// STL has no vertices in common
function readStl(bytes) {
  let geometry = new STLLoader().parse(bytes);
  if (!geometry.attributes.position?.count) fail('it has no vertices');
  for (const name of Object.keys(geometry.attributes))
    if (name !== 'position') geometry.deleteAttribute(name);
  if (!geometry.attributes.position.array.every(Number.isFinite))
    fail('a coordinate is no finite number');
  geometry.computeBoundingSphere();
  const before = geometry.attributes.position.count;
  geometry = mergeVertices(geometry, 1e-7 * geometry.boundingSphere.radius);
  const index = geometry.index.array,
    polygons = [];
  for (let f = 0; f < index.length; f += 3) {
    const triangle = [index[f], index[f + 1], index[f + 2]];
    if (new Set(triangle).size === 3) polygons.push(triangle);
  }
  const note = `${before} corners were merged to ${geometry.attributes.position.count} vertices.`;
  return { ...surface(geometry.attributes.position.array, polygons), note };
}

export const endingOf = (name) => name.split('.').pop().toLowerCase();

// what `read` returns; else an Error that names the file
function reading(name, read) {
  try {
    return read();
  } catch (error) {
    return fail(
      error instanceof RangeError
        ? `${name} cannot be read: it ends too early.`
        : `${name} cannot be read: ${error.message}.`,
    );
  }
}

const textOf = (bytes) => new TextDecoder().decode(bytes);
const readers = {
  off: (bytes) => readOff(textOf(bytes)),
  obj: (bytes) => readObj(textOf(bytes)),
  ply: readPly,
  stl: readStl,
  mesh: (bytes) => readMedit(textOf(bytes)),
};
export const meshFormats = Object.keys(readers);

export function readMesh(name, bytes) {
  const mesh = reading(name, () => readers[endingOf(name)](bytes));
  if (!mesh.simplices.length) fail(`${name} has no faces.`);
  if (!mesh.points.every(Number.isFinite))
    fail(`${name} has a coordinate that is no finite number.`);
  const size = diagonalOf(mesh.points); // single precision has to hold its square
  if (!(size > 1e-15 && size < 1e15))
    fail(`${name} has a diagonal of ${size.toPrecision(3)}; 1e-15 to 1e15 can be drawn.`);
  return mesh;
}

// lines of rows, of which each has some columns
function rows(array, columns, line) {
  const lines = [];
  for (let i = 0; i < array.length; i += columns) lines.push(line(array.subarray(i, i + columns)));
  return lines.join('\n');
}

// indices that count from 1
const from1 = (row) => Array.from(row, (v) => v + 1).join(' ');

// The faces of a surface are as they were read, but .mesh has triangles.
export function writeMesh(ending, { points, simplices, starts, volume, faces }) {
  const n = points.length / 3;
  if (ending === 'mesh') {
    const [kind, corners, all] = volume ? ['Tetrahedra', 4, simplices] : ['Triangles', 3, faces];
    return (
      `MeshVersionFormatted 2\nDimension 3\nVertices\n${n}\n` +
      `${rows(points, 3, (p) => `${p.join(' ')} 0`)}\n` +
      `${kind}\n${all.length / corners}\n` +
      `${rows(all, corners, (s) => `${from1(s)} 0`)}\nEnd\n`
    );
  }
  const m = volume ? faces.length / 3 : starts.length - 1,
    face = (f) =>
      volume ? faces.subarray(3 * f, 3 * f + 3) : cornersOf({ simplices, starts }, f),
    lines = (line) => Array.from({ length: m }, (_, f) => line(face(f))).join('\n');
  if (ending === 'obj')
    return (
      `${rows(points, 3, (p) => `v ${p.join(' ')}`)}\n${lines((f) => `f ${from1(f)}`)}\n`
    );
  return (
    `OFF\n${n} ${m} 0\n${rows(points, 3, (p) => p.join(' '))}\n` +
    `${lines((f) => `${f.length} ${f.join(' ')}`)}\n`
  );
}

// a status for each of n vertices
export const readSelection = (name, bytes, n) =>
  reading(name, () => {
    const words = new Words(textOf(bytes)),
      count = words.words.length;
    if (count !== n) fail(`it has ${count} statuses, but the shape has ${n} vertices`);
    return Int32Array.from({ length: n }, (_, v) => {
      const status = words.count(`the status of vertex ${v}`);
      return status <= n + 1 ? status : fail(`the status of vertex ${v} is ${status}`);
    });
  });

export const writeSelection = (status, comment) =>
  `${comment.replace(/^/gm, '# ')}\n${status.join('\n')}\n`;

// Matrices of four rows for n handles, one for each or one for all; placed() makes them what the
// page wants.
export const readTransforms = (name, bytes, n, placed = (matrix) => matrix) =>
  reading(name, () => {
    const words = new Words(textOf(bytes)),
      numbers = Array.from(words.words, () => words.number('an entry')),
      count = numbers.length / 16;
    if (!n) fail('there is no handle with vertices');
    if (count !== 1 && count !== n)
      fail(`it has ${numbers.length} numbers; handles need 16 each, and there are ${n}`);
    return Array.from(
      { length: n },
      (_, k) =>
        rigid(placed(count === 1 ? numbers : numbers.slice(16 * k, 16 * k + 16))) ??
        fail('it has a matrix that is no rigid motion, as this page needs'),
    );
  });

// a matrix of four rows for each handle
export const writeTransforms = (matrices) =>
  matrices
    .map((m) => [0, 4, 8, 12].map((r) => Array.from(m.slice(r, r + 4)).join(' ')).join('\n'))
    .join('\n\n') + '\n';
