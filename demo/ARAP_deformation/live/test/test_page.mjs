// Drives the page in Chromium as a user does. Screenshots: build/live/screenshots.
// usage: node test_page.mjs [PATTERN]   runs only the steps whose names match
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import {
  existsSync,
  mkdirSync,
  readFileSync,
  readdirSync,
  rmSync,
  statSync,
  writeFileSync,
} from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { models, sphere } from '../models.js';
import { serve } from '../serve.mjs';

const root = join(dirname(fileURLToPath(import.meta.url)), '../../../..'),
  live = join(root, 'build/live');
const puppeteer = (
  await import(pathToFileURL(createRequire(join(live, 'x.js')).resolve('puppeteer-core')))
).default;
const shots = join(live, 'screenshots'),
  files = join(live, 'files');
for (const folder of [shots, files]) {
  if (!process.argv[2]) rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
}
const pattern = new RegExp(process.argv[2] ?? '.');
// a file of the page, with what it imports
async function bundled(name) {
  const out = join(live, `${name}.mjs`),
    file = fileURLToPath(new URL(`../${name}.js`, import.meta.url));
  execFileSync(
    join(live, 'node_modules/.bin/esbuild'),
    [file, '--bundle', '--format=esm', '--log-level=warning', `--outfile=${out}`],
    { env: { ...process.env, NODE_PATH: join(live, 'node_modules') } },
  );
  return import(pathToFileURL(out).href);
}
const { server, address } = await serve(join(live, 'page'));
const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  headless: true,
  protocolTimeout: 600000,
  args: [
    '--no-sandbox',
    '--disable-gpu',
    '--enable-unsafe-swiftshader',
    '--disable-quic',
    '--no-first-run',
    '--disable-sync',
    '--disable-background-networking',
    '--disable-component-update',
    '--enable-precise-memory-info',
  ],
});
const complaints = [],
  questions = []; // that the page has asked
let answer = true;

async function newPage(options = {}, url = address) {
  const page = await browser.newPage();
  await page.setViewport({ width: 1280, height: 800, ...options });
  page.on('pageerror', (error) => complaints.push(error.message));
  page.on('dialog', (dialog) => {
    if (dialog.type() !== 'confirm') return;
    questions.push(dialog.message());
    answer ? dialog.accept() : dialog.dismiss();
  });
  page.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
  const session = await page.createCDPSession();
  await session.send('Browser.setDownloadBehavior', {
    behavior: 'allow',
    downloadPath: files,
    eventsEnabled: false,
  });
  await page.goto(url);
  await page.evaluate(() => window.arap.ready);
  return Object.assign(page, { cdp: session });
}

const page = await newPage();
const state = (p = page) => p.evaluate(() => window.arap.state());
const rest = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));
const settled = async (p = page, timeout = 120000) => {
  await rest(50);
  await p.waitForFunction(() => window.arap.state()?.isSettled, { timeout, polling: 100 });
  return state(p);
};
const shot = (name, p = page) => p.screenshot({ path: join(shots, `${name}.png`) });
const positions = () => page.evaluate(() => [...window.arap.positions()]);
const largestDifference = (a, b) =>
  a.reduce((worst, x, i) => Math.max(worst, Math.abs(x - b[i])), 0);
const message = () => page.$eval('#message', (m) => (m.hidden ? '' : m.innerText));
const clickText = (text) =>
  page.evaluate(
    (t) => [...document.querySelectorAll('#panel button')].find((b) => b.textContent === t).click(),
    text,
  );

async function drag(from, to, steps = 12, p = page) {
  await p.mouse.move(...from);
  await p.mouse.down();
  for (let i = 1; i <= steps; ++i)
    await p.mouse.move(...from.map((x, k) => x + ((to[k] - x) * i) / steps));
}
async function dragHandle(dx, dy, number = 1) {
  const {
    screen: [x, y],
  } = (await state()).handles[number - 1];
  await drag([x, y], [x + dx, y + dy]);
}
// where the first handle can be taken beside the gizmo
async function besideGizmo() {
  const p = await positions(),
    members = await page.evaluate(() =>
      [...window.arap.status().entries()].filter(([, s]) => s === 2).map(([v]) => v),
    );
  for (const place of await onPage(members.map((v) => p.slice(3 * v, 3 * v + 3)))) {
    await page.mouse.move(...place);
    if (await page.evaluate(() => !window.arap.view.gizmo.axis)) return place;
  }
  return assert.fail('the gizmo is everywhere');
}
// where points in space are
const onPage = (points, p = page) =>
  p.evaluate((list) => {
    const { view } = window.arap,
      box = view.canvas.getBoundingClientRect();
    return list.map((point) => {
      const [x, y] = view.toScreen(...point);
      return [x + box.left, y + box.top];
    });
  }, points);
const vertexOnPage = async (v) =>
  (await onPage([(await positions()).slice(3 * v, 3 * v + 3)]))[0];
// where the middle of a bar is
const middle = async () => vertexOnPage(((await state()).vertices / 2) | 0);
// the names of what the page calls the engine for, while f is done
async function callsOf(f) {
  await page.evaluate(() => {
    const { engine } = window.arap,
      call = engine.call.bind(engine);
    window.calls = [];
    engine.call = (name, ...others) => {
      window.calls.push(name);
      return call(name, ...others);
    };
  });
  await f();
  await settled();
  return page.evaluate(() => {
    delete window.arap.engine.call;
    return window.calls;
  });
}
// the engine answers nothing until f is done
async function whileBusy(f) {
  await page.evaluate(() => {
    window.messages = [];
    window.arap.engine.worker.postMessage = (...message) => window.messages.push(message);
  });
  await f();
  await page.evaluate(() => {
    const { worker } = window.arap.engine;
    delete worker.postMessage;
    window.messages.forEach((message) => worker.postMessage(...message));
  });
  return settled();
}
async function pressCommand(key) {
  await page.keyboard.down('Control');
  await page.keyboard.press(key);
  await page.keyboard.up('Control');
}
async function paintMiddle() {
  const [x, y] = await middle();
  await drag([x - 30, y + 30], [x + 30, y - 30]);
  await page.mouse.up();
}
const enter = (selector, value) =>
  page.$eval(
    selector,
    (input, text) => {
      input.value = text;
      input.dispatchEvent(new Event('input'));
      input.dispatchEvent(new Event('change'));
    },
    value,
  );
async function bend(share) {
  await enter('#bending', share);
  return settled();
}
const openFile = async (...paths) => (await page.$('#file')).uploadFile(...paths);
async function openShape({ points, simplices, status }, name) {
  await page.evaluate(
    (p, s, k, as) =>
      window.arap.open(
        {
          points: Float64Array.from(p),
          simplices: Int32Array.from(s),
          corners: 3,
          volume: false,
          status: Int32Array.from(k),
        },
        as,
      ),
    [...points],
    [...simplices],
    [...status],
    name,
  );
  return settled();
}
async function downloaded(path) {
  let last = 0;
  for (let k = 0; k < 200; ++k) {
    const size = existsSync(path) ? statSync(path).size : 0;
    if (size > 0 && size === last) return;
    last = size;
    await rest(100);
  }
  assert.fail(`${path} has not come`);
}
async function saved(press, name) {
  const path = join(files, name);
  rmSync(path, { force: true });
  await clickText(press);
  await downloaded(path);
  return readFileSync(path);
}
const rows = (array, columns, line) =>
  Array.from({ length: array.length / columns }, (_, i) =>
    line([...array.slice(columns * i, columns * (i + 1))]),
  ).join('\n');
const off = ({ points, simplices }) =>
  `OFF\n${points.length / 3} ${simplices.length / 3} 0\n` +
  `${rows(points, 3, (p) => p.join(' '))}\n${rows(simplices, 3, (f) => `3 ${f.join(' ')}`)}\n`;
const pointsOf = (text) => {
  const [, n, , , ...numbers] = text.replace(/#.*/g, '').trim().split(/\s+/);
  return numbers.slice(0, 3 * n).map(Number);
};
// the points that the command of a selection file makes
function theCommands(selection) {
  const [, ...words] = readFileSync(join(files, selection), 'utf8')
    .split('\n')[0]
    .replace('# ', '')
    .split(' ');
  execFileSync(
    join(root, 'build/release/demo/ARAP_deformation/arap_deform'),
    [...words, '--iterations', '20000', '--tolerance', '1e-7', '--quiet'],
    { cwd: files },
  );
  return pointsOf(readFileSync(join(files, 'out.off'), 'utf8'));
}
const openModel = async (id) => {
  await page.evaluate((m) => window.arap.openModel(m), id);
  return settled();
};
const garbage = async () => {
  for (let k = 0; k < 3; ++k) await page.cdp.send('HeapProfiler.collectGarbage');
  return page.evaluate(async () => ({
    script: performance.memory.usedJSHeapSize,
    engine: await window.arap.heap(),
  }));
};

const heaps = (sizes) =>
  `script heap ${sizes.map((s) => (s.script / 1e6).toFixed(1)).join(' to ')} MB, ` +
  `engine ${sizes.map((s) => (s.engine / 1e6).toFixed(1)).join(' to ')} MB`;

const steps = {
  async 'without a browser'() {
    const { readMesh, readSelection, readTransforms, writeMesh } = await bundled('files'),
      { boundary, facesOfInverted, startsOf, trianglesOf } = await bundled('faces'),
      { fittedMotion } = await bundled('motion');
    const read = (name, text) => readMesh(name, new TextEncoder().encode(text).buffer);
    // comments are no corners, and end with their line
    const vertices = 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n';
    const { simplices, corners } = read(
      'a.obj',
      `${vertices}f 1 2 3 # 4\nf 1 2 3 # a triangle\n# to be continued \\\nf 1 3 4\nf 1 \\\n3 4\n`,
    );
    assert.deepEqual([...simplices, corners], [0, 1, 2, 0, 1, 2, 0, 2, 3, 0, 2, 3, 3]);
    // polygons that are not convex, whichever side is seen
    for (const [outline, area] of [
      [[0, 0, 2, 0, 0.5, 0.5, 0, 2], 1],
      [[0, 0, 2, 0, 2, 1, 1, 1, 1, 2, 0, 2], 3],
      [[0, 0, 1, 0, 2, 0, 3, 0], 0],
    ])
      for (const axis of [0, 1, 2])
        for (const turned of [false, true]) {
          const n = outline.length / 2,
            points = new Float64Array(3 * n),
            polygon = Int32Array.from({ length: n }, (_, k) => (turned ? n - 1 - k : k));
          outline.forEach((x, i) => {
            points[3 * (i >> 1) + ((axis + 1 + (i % 2)) % 3)] = x;
          });
          const starts = startsOf(polygon, [n]),
            { faces, simplexOf } = trianglesOf({ points, simplices: polygon, starts });
          const of = (a, b, c) => {
            const p = (v, i) => points[3 * v + ((axis + 1 + i) % 3)];
            return (
              (p(b, 0) - p(a, 0)) * (p(c, 1) - p(a, 1)) -
              (p(b, 1) - p(a, 1)) * (p(c, 0) - p(a, 0))
            );
          };
          const areas = Array.from(simplexOf, (_, k) => of(...faces.slice(3 * k, 3 * k + 3)) / 2);
          assert(Math.abs(areas.reduce((a, b) => a + b) - (turned ? -area : area)) < 1e-9);
          assert(areas.every((a) => (turned ? -a : a) >= 0));
          assert.equal(faces.length, 3 * (n - 2));
        }
    // small, and far from the origin: both triangles are at the reflex corner
    for (let k = 0; k < 9; ++k) {
      const points = Float64Array.of(0, 0, 0, 2, 0, 0, 0.5, 0.5, 0, 0, 2, 0).map(
          (x, i) => [4.5e5, 5.4e6, 300][i % 3] + 0.37 * k + 1e-3 * x,
        ),
        { faces } = trianglesOf({ points, simplices: Int32Array.of(1, 2, 3, 0), starts: [0, 4] });
      assert(faces.subarray(0, 3).includes(2) && faces.subarray(3).includes(2));
    }
    const crossing = Float64Array.of(0, 0, 0, 2, 2, 0, 2, 0, 0, 0, 1, 0),
      cut = { points: crossing, simplices: Int32Array.of(0, 1, 2, 3), starts: startsOf([0, 0, 0, 0], 4) };
    assert.equal(trianglesOf(cut).faces.length, 6, 'all of a face that crosses itself');
    // more corners than are good for the engine; and faces that are none
    const many = Array.from({ length: 65 }, (_, k) => `v ${Math.cos(k / 11)} ${Math.sin(k / 11)} 0\n`),
      face = (n) => `f ${Array.from({ length: n }, (_, k) => k + 1).join(' ')}\n`,
      large = read('a.obj', many.join('') + face(65) + face(64));
    assert.deepEqual([...large.corners], [...Array(63).fill(3), 64]);
    assert.match(large.note, /were cut into triangles: 1\./);
    // .obj counts from 1
    for (const [rest, why] of [
      ['f 1 2 1', / the vertex 1 twice/],
      ['f 1 2 9', / the vertex 9, but there are 4/],
      ['f 0 1 2', / the vertex 0, but there are 4/],
      ['f -5 1 2', /: line 5: .* the vertex -5\./],
      ['f 1 \\\n2 \\\r\n3\nf 1 2x 3', /: line 8: .* the vertex 2x\./],
      ['f 1 2.7 3', / the vertex 2\.7\./],
    ])
      assert.throws(() => read('a.obj', vertices + rest), why);
    for (const count of [-1, 2.5, 'x'])
      assert.throws(
        () => read('a.off', `OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n${count} 0 1 2 2\n`),
        /face 0 does not begin with the number/,
      );
    const triangle = new DataView(new ArrayBuffer(134));
    triangle.setUint32(80, 1, true);
    triangle.setFloat32(96, NaN, true);
    assert.throws(() => readMesh('a.stl', triangle.buffer), /a\.stl .* no finite number/);
    const element = (corners) =>
      `Vertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n${corners}`;
    assert.equal(read('a.mesh', element('Triangles 1\n1 2 3 0')).simplices.length, 3);
    for (const corners of ['Triangles 1\n1 2 2 0', 'Tetrahedra 2\n1 2 3 4 0\n1 2 3 2 0'])
      assert.throws(() => read('a.mesh', element(corners)), /a\.mesh .* the vertex 2 twice/);
    // selections and transforms
    const bytes = (text) => new TextEncoder().encode(text).buffer;
    assert.deepEqual([...readSelection('a.sel', bytes('# all\n0\n1\n2 # a handle\n'), 3)], [0, 1, 2]);
    assert.throws(() => readSelection('a.sel', bytes('0\n1\n'), 3), /a\.sel .* 2 statuses/);
    assert.throws(() => readSelection('a.sel', bytes('0 -1 2'), 3), /vertex 1 is -1/);
    assert.throws(() => readSelection('a.sel', bytes('0 1 5'), 3), /vertex 2 is 5/);
    const lines = '1 0 0 4\n0 1 0 5\n0 0 1 6\n',
      shift = [1, 0, 0, 4, 0, 1, 0, 5, 0, 0, 1, 6, 0, 0, 0, 1],
      transforms = (text, n) => readTransforms('a.def', bytes(text), n);
    assert.deepEqual(transforms(`${lines}0 0 0 1`, 1), [shift]);
    assert.deepEqual(transforms(`${lines}0 0 0 1`, 2), [shift, shift], 'one for all');
    const rounded = '0.6 -0.8 0 0\n0.7999 0.6001 0 0\n0 0 1 0\n0 0 0 1\n',
      [a, b] = transforms(`${lines}0 0 0 1\n${rounded}`, 2);
    assert.deepEqual(a, shift);
    assert(Math.abs(Math.hypot(b[0], b[4]) - 1) < 1e-12, 'a rotation');
    for (const [text, n, why] of [
      [`${lines}0 0 0 1`, 0, /a\.def .* no handle/],
      [`${lines}0 0 0 1\n${rounded}`, 3, /a\.def .* 32 numbers/],
      [`${lines}0 0 0 2`, 1, /no rigid motion/],
      ['2 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1', 1, /no rigid motion/], // stretches
      ['-1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1', 1, /no rigid motion/], // mirrors
      ['0 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1', 1, /no rigid motion/], // flattens
      [`${lines}0 0 0 x`, 1, /x, which is no number/],
    ])
      assert.throws(() => transforms(text, n), why);
    // polygons of PLY files
    const header = (format) =>
      `ply\nformat ${format} 1.0\ncomment end_header\nelement vertex 5\nproperty float x\n` +
      `property double y\nproperty float z\nelement face 2\nproperty uchar color\n` +
      `property list uint8 int vertex_index\nend_header\n`;
    const pentagon = [0, 0, 2, 0, 3, 1, 1, 2, 0, 1],
      faces = [
        [0, 1, 2, 3, 4],
        [0, 1, 2],
      ];
    const plys = [
      new TextEncoder().encode(
        `${header('ascii')}${rows(pentagon, 2, (p) => `${p.join(' ')} 0`)}\n` +
          `${faces.map((f) => `10 ${f.length} ${f.join(' ')}`).join('\n')}\n`,
      ).buffer,
    ];
    for (const little of [true, false]) {
      const data = new DataView(new ArrayBuffer(1000));
      let at = 0;
      const write = (size, kind, x) => data[`set${kind}`]((at += size) - size, x, little);
      for (const c of header(`binary_${little ? 'little' : 'big'}_endian`))
        write(1, 'Uint8', c.charCodeAt(0));
      for (let v = 0; v < 5; ++v) {
        write(4, 'Float32', pentagon[2 * v]);
        write(8, 'Float64', pentagon[2 * v + 1]);
        write(4, 'Float32', 0);
      }
      for (const f of faces) {
        write(1, 'Uint8', 10);
        write(1, 'Uint8', f.length);
        for (const v of f) write(4, 'Int32', v);
      }
      plys.push(data.buffer.slice(0, at));
      assert.throws(() => readMesh('a.ply', data.buffer.slice(0, at - 1)), /ends too early/);
    }
    for (const bytes of plys) {
      const mesh = readMesh('a.ply', bytes);
      assert.deepEqual(
        [...mesh.points],
        pentagon.flatMap((x, i) => (i % 2 ? [x, 0] : [x])),
      );
      assert.deepEqual([...mesh.simplices], faces.flat());
      assert.deepEqual([...mesh.corners], [5, 3]);
    }
    // tetrahedra of either orientation are seen from outside
    const solid = models.volume[1]();
    for (let t = 0; t < 2; ++t) {
      const off = writeMesh('off', {
          ...solid,
          starts: startsOf(solid.simplices, 4),
          faces: boundary(solid.simplices, solid.points),
        }),
        { points: p, simplices: s } = read('a.off', off);
      let volume = 0;
      for (let f = 0; f < s.length; f += 3) {
        const [a, b, c] = [0, 1, 2].map((k) => p.slice(3 * s[f + k], 3 * s[f + k] + 3));
        volume += a[0] * (b[1] * c[2] - b[2] * c[1]);
        volume += a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
      }
      assert(volume > 0, 'the boundary is not inside out');
      for (let i = 0; i < solid.simplices.length; i += 4)
        solid.simplices.subarray(i, i + 2).reverse();
    }
    // one tetrahedron that is inverted, and one that is flat, and moves
    const pair = {
        points: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.1, 0.2, 0.3, 0.3, 0.1, 0.2, 0.4, 0.3, 0.5 + 1e-10),
        simplices: Int32Array.of(0, 1, 2, 3, 0, 4, 5, 6),
      },
      shifted = Float32Array.from(pair.points, (x, i) => (i === 11 ? -1 : x) + 1 + (i % 3));
    assert.equal(facesOfInverted(pair, shifted).length, 36);
    for (let k = 0; k < 9; ++k) {
      const moved = Float32Array.from(pair.points, (x, i) => x + 0.37 * k * (1 + (i % 3)));
      assert.equal(facesOfInverted(pair, moved).length, 0);
    }
    // the motion of an elongated handle
    const strip = Array.from({ length: 105 }, (_, v) => [v % 21, ((v / 21) | 0) / 4, 0]).flat(),
      list = Array.from({ length: 105 }, (_, v) => v);
    for (const degrees of [0, 60, 180]) {
      const c = Math.cos((degrees * Math.PI) / 180),
        s = Math.sin((degrees * Math.PI) / 180),
        wanted = [1, 0, 0, 3, 0, c, -s, 2, 0, s, c, 1, 0, 0, 0, 1];
      const moved = list.flatMap((v) => {
        const [x, y] = strip.slice(3 * v);
        return [3 + x, 2 + c * y, 1 + s * y];
      });
      assert(largestDifference(fittedMotion(list, strip, moved), wanted) < 1e-9, `${degrees}`);
    }
    // the server goes on after a path that is none
    assert.equal((await fetch(`${address}%E0%A4%A`)).status, 404);
    assert.equal((await fetch(address)).status, 200);
  },

  async 'first visit'() {
    assert(await page.$eval('#help', (help) => !help.hidden));
    await settled();
    await shot('01_first_visit');
    await page.click('#begin');
    assert(await page.$eval('#help', (help) => help.hidden));
    assert.equal(await page.evaluate(() => document.activeElement.tagName), 'CANVAS');
    await page.reload();
    await page.evaluate(() => window.arap.ready);
    assert(await page.$eval('#help', (help) => help.hidden), 'the help comes once');
    // another resolution, as where the page is zoomed
    const ratio = () => page.evaluate(() => window.arap.view.renderer.getPixelRatio());
    assert.equal(await ratio(), 1);
    await page.setViewport({ width: 640, height: 400, deviceScaleFactor: 2 });
    await page.waitForFunction(() => window.arap.view.renderer.getPixelRatio() === 2);
    await page.setViewport({ width: 1280, height: 800 });
    await page.waitForFunction(() => window.arap.view.renderer.getPixelRatio() === 1);
  },

  // as where the graphics driver starts again
  async 'a lost context'() {
    await settled();
    const seen = () =>
      page.evaluate(() => {
        const { canvas } = window.arap.view,
          gl = canvas.getContext('webgl2'),
          pixel = new Uint8Array(4);
        gl.readPixels(canvas.width / 2, canvas.height / 2, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
        return [...pixel];
      });
    await rest(100);
    const before = await seen();
    assert(before[3] > 0);
    await page.evaluate(() => {
      const { canvas } = window.arap.view;
      window.context = canvas.getContext('webgl2').getExtension('WEBGL_lose_context');
      canvas.addEventListener('webglcontextlost', () => setTimeout(() => window.context.restoreContext()));
      window.isRestored = new Promise((done) => canvas.addEventListener('webglcontextrestored', done));
      window.context.loseContext();
    });
    await page.evaluate(() => window.isRestored);
    await rest(300);
    assert.deepEqual(await seen(), before);
  },

  async 'drag, undo, redo'() {
    await settled();
    const before = await positions();
    await dragHandle(150, 60);
    const during = await state();
    await shot('02_dragging');
    await page.mouse.up();
    const after = await settled();
    assert(during.steps > 0 && after.energy > 0);
    assert(
      (await page.evaluate(() => window.arap.distanceToTargets())) < 1e-6,
      'the handle is at its target',
    );
    const moved = await positions();
    assert(largestDifference(before, moved) > 0.1);
    await shot('03_dragged');
    await page.click('#undo');
    await settled();
    assert(largestDifference(before, await positions()) < 1e-5, 'undo');
    // a click on what turns and moves the handle is no step
    await page.mouse.move(...(await state()).handles[0].screen);
    await page.mouse.down();
    assert(await page.evaluate(() => window.arap.view.gizmo.dragging));
    await page.keyboard.press('b'); // is ignored meanwhile
    await page.mouse.up();
    await settled();
    assert(await page.evaluate(() => window.arap.view.orbit.enabled));
    await page.focus('#cells'); // a menu leaves commands to the page
    await page.keyboard.down('Control');
    await page.keyboard.press('y');
    await page.keyboard.up('Control');
    await settled();
    assert(largestDifference(moved, await positions()) < 1e-2, 'redo');
    await page.click('#reset');
    await settled();
    assert(largestDifference(before, await positions()) < 1e-5, 'reset');
  },

  async 'a file, painted'() {
    const bar = models.bar[1](),
      path = join(files, 'my_bar.off');
    writeFileSync(path, off(bar));
    // where there is nothing to undo, there is no work to be lost
    await openFile(path);
    await page.waitForFunction(() => window.arap.state()?.name === 'my_bar');
    await settled();
    await page.keyboard.down('Control');
    await page.keyboard.press('z');
    await page.keyboard.up('Control');
    const { length } = questions;
    await openModel('sheet');
    assert.equal(questions.length, length);
    await openFile(path);
    await page.waitForFunction(() => window.arap.state()?.name === 'my_bar');
    let now = await settled();
    assert.equal(now.vertices, bar.points.length / 3);
    assert.equal(now.tool, 'brush');
    assert.equal(now.fixed, 0);
    await rest(100);
    const ends = await onPage([
      [0, 0, 0.2],
      [0, 0, 4.8],
    ]);
    await clickText('Fixed');
    await drag([ends[0][0] - 40, ends[0][1]], [ends[0][0] + 40, ends[0][1]]);
    await shot('04_painting');
    await page.mouse.up();
    now = await settled();
    assert(now.fixed > 20, 'the brush paints');
    const seen = now.fixed;
    await clickText('Handle 1');
    await page.keyboard.press('x');
    await page.click('#through');
    await drag([ends[1][0] - 90, ends[1][1] - 35], [ends[1][0] + 90, ends[1][1] + 25]);
    await shot('05_box');
    await page.mouse.up();
    now = await settled();
    assert(now.handles[0].vertices > 50, 'the box paints through the shape');
    await page.click('#through');
    // a lasso around the foot, then what is left of it by undo
    await page.keyboard.press('1');
    await page.keyboard.press('l');
    const [x, y] = ends[0];
    await page.mouse.move(x - 90, y - 20);
    await page.mouse.down();
    for (const [a, b] of [
      [-90, 90],
      [0, 120],
      [90, 90],
      [90, -20],
    ])
      await page.mouse.move(x + a, y + b, { steps: 5 });
    await shot('06_lasso');
    await page.mouse.up();
    now = await settled();
    assert(now.fixed > seen, 'the lasso paints');
    await page.click('#undo');
    assert.equal((await settled()).fixed, seen, 'undo of paint');
    await page.click('#redo');
    await settled();
    // flood: all that is free becomes a handle, and undo
    await page.keyboard.press('f');
    await page.keyboard.press('3');
    await page.mouse.click((ends[0][0] + ends[1][0]) / 2, (ends[0][1] + ends[1][1]) / 2);
    now = await settled();
    assert(
      now.handles[1].vertices + now.handles[0].vertices + now.fixed > 0.99 * now.vertices,
      'the flood fills what is free',
    );
    await page.keyboard.down('Control');
    await page.keyboard.press('z');
    await page.keyboard.up('Control');
    assert.equal((await settled()).handles.length, 1);
    await page.keyboard.press('g');
    // work that is not saved is not lost without a question
    const asked = new Promise((done) => page.once('dialog', done));
    const leaving = page.goto('about:blank').catch(() => {});
    const question = await Promise.race([asked, leaving]);
    assert.equal(question?.type(), 'beforeunload');
    await question.dismiss();
    await leaving;
    assert.equal((await settled()).name, 'my_bar');
    answer = false;
    await page.select('#model', 'sheet');
    await page.waitForFunction(() => /not opened/.test(window.arap.state().message));
    answer = true;
    assert.match(questions.at(-1), /^my_bar .* sheet instead\?$/);
    assert.equal((await settled()).name, 'my_bar');
    // a drag that such a question ends is a step
    const { undo: before, handles: dragged } = await settled();
    const [px, py] = await besideGizmo();
    await drag([px, py], [px + 20, py]);
    answer = false;
    await page.evaluate(() => void window.arap.openModel('sheet'));
    await page.waitForFunction((n) => window.arap.state().undo > n, {}, before);
    await page.mouse.up();
    answer = true;
    assert.equal((await settled()).undo, before + 1);
    await page.click('#undo');
    assert.deepEqual((await settled()).handles[0].matrix, dragged[0].matrix);
    assert.equal(await page.$eval('#model', (m) => m.value), '');
    await page.click('#message button');
  },

  async 'saved files, and the command'() {
    await dragHandle(110, 50);
    await page.mouse.up();
    await page.click('#turns');
    for (let k = 0; k < 4; ++k) {
      await page.keyboard.down('Shift');
      await page.keyboard.press('ArrowRight');
      await page.keyboard.up('Shift');
    }
    await rest(600);
    await settled();
    await shot('07_turned');
    await page.click('#moves');
    const ours = pointsOf(String(await saved('Mesh .off', 'my_bar.off')));
    for (const [press, name] of [
      ['Rest shape', 'my_bar_rest.off'],
      ['Selection', 'my_bar.sel'],
      ['Transforms', 'my_bar.def'],
      ['.obj', 'my_bar.obj'],
      ['.mesh', 'my_bar.mesh'],
    ])
      assert((await saved(press, name)).length > 50, name);
    const theirs = theCommands('my_bar.sel');
    assert.equal(ours.length, theirs.length);
    const distance = largestDifference(ours, theirs) / 5.2;
    console.log(`  the command's mesh differs by ${distance.toExponential(1)} of the diagonal`);
    assert(distance < 1e-3);
    assert(String(await saved('Picture', 'my_bar.png')).length > 5000);
  },

  async options() {
    await openModel('bar');
    await dragHandle(120, 90);
    await page.mouse.up();
    await settled();
    const energies = {};
    for (const [id, value] of [
      ['cells', 'spokes'],
      ['cells', 'elements'],
      ['cells', 'k_ring:2'],
      ['cells', 'spokes_and_rims'],
      ['minimizer', 'local_global'],
      ['weights', 'uniform'],
      ['weights', 'safe_cotangent'],
    ]) {
      await page.select(`#${id}`, value);
      energies[value] = (await settled()).energy;
      assert.equal(await message(), '', value);
    }
    assert.equal(
      new Set(Object.values(energies).map((e) => e.toPrecision(3))).size >= 5,
      true,
      JSON.stringify(energies),
    );
    assert((await bend(5)).energy > energies.safe_cotangent, 'bending adds to the energy');
    await page.select('#measure', 'edge_length_error');
    await rest(800);
    await settled();
    await shot('08_edge_error');
    assert(await page.$eval('#legend', (legend) => !legend.hidden));
    assert.match(await page.$eval('#quality', (q) => q.textContent), /Edges/);
    await page.select('#measure', '');
    await bend(0);
    await page.click('#soft');
    await enter('#weight', -3);
    assert((await settled()).energy < energies.safe_cotangent, 'a soft handle gives way');
    await page.click('#soft');
    await settled();
    // stiffness
    await openModel('bar');
    await dragHandle(150, 120);
    await page.mouse.up();
    const soft = (await settled()).energy;
    await page.keyboard.press('s');
    await paintMiddle();
    assert((await settled()).energy > soft, 'stiff parts cost energy');
    await shot('09_stiffness');
    await page.click('#undo');
    assert(Math.abs((await settled()).energy / soft - 1) < 1e-2, 'undo of stiffness');
    await page.select('#minimizer', 'automatic'); // those that follow need not wait
    await settled();
  },

  async 'options, undone and done again'() {
    const isWell = async () => assert.equal((await state()).message, '');
    const twoSteps = async (press) => {
      await page.click(press);
      await settled();
      await isWell();
    };
    await openModel('volume'); // elements of a surface have many minima
    await dragHandle(80, 40);
    await page.mouse.up();
    await settled();
    // cells without bending, after bending
    const calls = await callsOf(() => bend(5));
    assert.deepEqual(
      calls.filter((name) => name === 'options' || name === 'stiffness'),
      ['options'],
    );
    await page.select('#cells', 'elements');
    const { energy } = await settled();
    await twoSteps('#undo');
    await twoSteps('#redo');
    assert(Math.abs((await state()).energy / energy - 1) < 1e-2, 'redo of elements');
    // stiffness of elements
    await page.keyboard.press('s');
    await paintMiddle();
    const stiff = (await settled()).energy;
    assert(stiff > energy);
    await twoSteps('#undo');
    await twoSteps('#redo');
    assert(Math.abs((await state()).energy / stiff - 1) < 1e-2, 'redo of stiffness');
    await page.select('#weights', 'uniform');
    assert.equal((await settled()).undo, 0, 'states of other weights are gone');
    await isWell();
    await page.select('#weights', 'safe_cotangent');
    assert(Math.abs((await settled()).energy / stiff - 1) < 1e-2, 'stiffness with other weights');
    // painting does not change what undo keeps
    await page.keyboard.press('s');
    await paintMiddle();
    await settled();
    await twoSteps('#undo');
    await enter('#stiffness', -1);
    await paintMiddle();
    await settled();
    await twoSteps('#undo');
    assert(Math.abs((await state()).energy / stiff - 1) < 1e-2, 'undo after undo');
    // a drag that is undone costs no factorization, which a stiffness does
    await page.keyboard.press('g');
    await dragHandle(30, 0);
    await page.mouse.up();
    await settled();
    assert(!(await callsOf(() => twoSteps('#undo'))).includes('stiffness'));
    assert(Math.abs((await state()).energy / stiff - 1) < 1e-2, 'undo of a drag');
    // weights that fail when their session is half made: the one before goes on, with its states
    const { energy: kept, undo } = await state();
    await page.evaluate(() => {
      const { engine } = window.arap,
        call = engine.call.bind(engine);
      engine.call = (name, content, ...others) =>
        call(name, name === 'weights' ? { ...content, stiffness: [1] } : content, ...others);
    });
    await page.select('#weights', 'uniform');
    const after = await settled();
    assert.match(await message(), /1 values for the/);
    assert.equal(await page.$eval('#weights', (w) => w.value), 'safe_cotangent');
    assert.equal(after.undo, undo);
    assert(Math.abs(after.energy / kept - 1) < 1e-2, 'the shape of before');
    await page.evaluate(() => {
      delete window.arap.engine.call;
    });
    await page.keyboard.press('Escape'); // closes the message
    await twoSteps('#undo');
    await twoSteps('#redo');
    // stiffness of vertices, which goes with their cells
    await page.select('#cells', 'spokes_and_rims');
    await settled();
    await page.keyboard.press('s');
    await paintMiddle();
    const ofVertices = (await settled()).energy;
    await page.select('#cells', 'elements');
    const ofElements = (await settled()).energy;
    await page.keyboard.press('Escape'); // closes the message
    await twoSteps('#undo');
    assert(Math.abs((await state()).energy / ofVertices - 1) < 1e-2, 'undo of other cells');
    await twoSteps('#redo');
    assert(Math.abs((await state()).energy / ofElements - 1) < 1e-2, 'redo of other cells');
    await page.select('#cells', 'spokes_and_rims');
    await settled();
    await page.select('#measure', '');
    await page.keyboard.press('g');
  },

  async 'undo while the shape is busy'() {
    await openModel('bar');
    await dragHandle(100, 60);
    await page.mouse.up();
    const first = (await settled()).undo;
    const before = await positions();
    await page.select('#cells', 'spokes');
    await settled();
    await page.select('#cells', 'k_ring:2');
    await settled();
    await page.evaluate(() => {
      for (let k = 0; k < 2; ++k) document.getElementById('undo').click();
    });
    await rest(300);
    await settled();
    assert.equal((await state()).undo, first);
    assert.equal(await page.$eval('#cells', (c) => c.value), 'spokes_and_rims');
    assert(largestDifference(before, await positions()) < 2e-2, 'the first of three states');
    // a move by keys is undone at once
    await page.keyboard.press('ArrowUp');
    await page.keyboard.down('Control');
    await page.keyboard.press('z');
    await page.keyboard.up('Control');
    await rest(600);
    await settled();
    assert.deepEqual([(await state()).undo, (await state()).redo], [first, 1]);
    assert.equal(await message(), '');
    // a redo that fails: the engine holds what the page does
    await page.keyboard.press('p');
    await page.mouse.click(...(await middle()));
    await settled();
    await page.click('#undo');
    await settled();
    await page.evaluate(() => {
      const { engine } = window.arap,
        call = engine.call.bind(engine);
      engine.call = (name, ...others) => {
        if (name !== 'restore') return call(name, ...others);
        delete engine.call;
        return Promise.reject(new Error('there is not enough memory'));
      };
    });
    await page.click('#redo');
    assert.equal((await settled()).handles.length, 2);
    assert.match(await message(), /not enough memory/);
    await page.keyboard.press('Escape');
    const held = await positions();
    await page.keyboard.press('ArrowLeft');
    await rest(600);
    await settled();
    assert.equal(await message(), '');
    assert(largestDifference(held, await positions()) > 0.01, 'the shape follows');
    await page.keyboard.press('g');
  },

  async 'digits and regions'() {
    await openModel('bar');
    const regions = (isOn) =>
      page.$$eval(
        '#regions button',
        (list, on) =>
          list
            .filter((b) => !on || b.getAttribute('aria-pressed') === 'true')
            .map((b) => b.textContent),
        isOn,
      );
    for (const [tool, digit, text] of [
      ['g', '0', 'Free'],
      ['s', '1', 'Fixed'],
      ['p', '2', 'Handle 1'],
      ['x', '3', 'New handle'],
    ]) {
      await page.keyboard.press(tool);
      await page.keyboard.press(digit);
      assert.deepEqual(await regions(true), [text]);
      assert.equal((await state()).tool, tool === 'x' ? 'box' : 'brush');
    }
    // a number that is skipped is no handle
    await page.keyboard.press('b');
    await page.keyboard.press('5');
    await paintMiddle();
    await settled();
    assert.deepEqual(await regions(false), ['Free', 'Fixed', 'Handle 1', 'Handle 4', 'New handle']);
    await page.keyboard.press('g');
  },

  async 'changes while a step is under way'() {
    const isWell = async () => assert.equal(await message(), '');
    // a step has nothing that the engine was told later
    await openModel('bar');
    await page.keyboard.press('b');
    await page.keyboard.press('3');
    const painted = await whileBusy(async () => {
      await page.keyboard.press('r');
      await paintMiddle();
    });
    assert.deepEqual([painted.handles.length, painted.undo], [2, 2]);
    await page.click('#undo');
    assert.equal((await settled()).handles.length, 1, 'undo of a stroke');
    await page.evaluate(() => window.arap.choose(0));
    await page.keyboard.press('g');
    const soft = await whileBusy(async () => {
      await page.keyboard.press('r');
      await page.click('#soft');
    });
    assert.notEqual(soft.handles[0].weight, null);
    await page.click('#undo');
    assert.equal((await settled()).handles[0].weight, null, 'undo of a soft handle');
    assert(!(await page.$eval('#soft', (s) => s.checked)));
    await isWell();
    await page.keyboard.press('s');
    await paintMiddle();
    await settled();
    await whileBusy(async () => {
      await paintMiddle();
      await page.select('#cells', 'elements');
    });
    assert.match(await message(), /stiffness was of other cells/);
    await page.keyboard.press('Escape');
    await page.click('#undo');
    await settled();
    assert.equal(await page.$eval('#cells', (c) => c.value), 'spokes_and_rims');
    await isWell();
    await page.select('#measure', '');
    await page.keyboard.press('g');
    // a move during an undo, and a key that ends it, make a step after it
    await openModel('bar');
    await page.select('#cells', 'spokes');
    await settled();
    const moved = await whileBusy(async () => {
      await pressCommand('z');
      await page.keyboard.press('ArrowUp');
      await page.keyboard.press('v');
    });
    assert.deepEqual([moved.undo, moved.redo], [1, 0]);
    const there = async () => [
      (await settled()).handles[0].matrix[7] !== 0,
      await page.$eval('#cells', (c) => c.value),
    ];
    assert.deepEqual(await there(), [true, 'spokes_and_rims']);
    await page.click('#undo');
    assert.deepEqual(await there(), [false, 'spokes_and_rims']);
    await page.click('#redo');
    assert.deepEqual(await there(), [true, 'spokes_and_rims']);
    // with a key frame it makes two
    await page.keyboard.press('ArrowUp');
    await page.keyboard.press('k');
    await rest(100);
    await settled();
    await page.click('#undo');
    const { keys, handles } = await settled();
    assert.equal(keys, 0);
    assert.notEqual(handles[0].matrix[7], moved.handles[0].matrix[7]);
    await isWell();
    // after an undo it is another object that has the number of the handle, or there is none
    await page.evaluate(() => {
      for (const id of ['undo', 'soft']) document.getElementById(id).click();
    });
    await rest(100);
    assert.notEqual((await settled()).handles[0].weight, null);
    await page.keyboard.press('3');
    await paintMiddle();
    const { undo } = await settled();
    await page.evaluate(() => {
      window.arap.choose(1);
      document.getElementById('undo').click();
      dispatchEvent(new KeyboardEvent('keydown', { key: 'Delete' }));
    });
    await rest(100);
    const gone = await settled();
    assert.deepEqual([gone.handles.length, gone.undo, gone.redo], [1, undo - 1, 1]);
    await isWell();
    // a handle that is removed leaves what was painted since
    await openModel('bar');
    let fixed;
    const removed = await whileBusy(async () => {
      for (const key of ['r', 'Delete', '1']) await page.keyboard.press(key);
      const [x, y] = (await state()).handles[0].screen;
      await drag([x - 40, y + 5], [x + 40, y + 5]);
      await page.mouse.up();
      fixed = await page.evaluate(() => window.arap.status().filter((s) => s === 0).length);
    });
    assert.deepEqual([removed.fixed, removed.handles.length], [fixed, 0]);
    // a motion of the rest shape of before ends with it, by the gizmo and without
    for (const byGizmo of [true, false]) {
      await openModel('bar');
      await page.keyboard.down('Shift');
      for (let k = 0; k < 6; ++k) await page.keyboard.press('ArrowLeft');
      await page.keyboard.up('Shift');
      await rest(600);
      await settled();
      const resting = whileBusy(async () => {
        await page.click('#rest');
        const [x, y] = byGizmo ? (await state()).handles[0].screen : await besideGizmo();
        await drag([x, y], [x + 5, y]);
        assert.equal(await page.evaluate(() => window.arap.view.gizmo.dragging), byGizmo);
      });
      await page.waitForFunction(() => /rest shape/.test(window.arap.state().message));
      await page.mouse.move(300, 300);
      await page.mouse.up();
      const { matrix } = (await resting).handles[0];
      assert.deepEqual(matrix, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
    }
    // a point and a stroke that wait for their turn have different numbers
    await openModel('bar');
    const both = await whileBusy(async () => {
      for (const key of ['r', 'p']) await page.keyboard.press(key);
      await page.mouse.click(...(await middle()));
      for (const key of ['b', '3']) await page.keyboard.press(key);
      await paintMiddle();
    });
    assert.deepEqual(
      both.handles.map(({ vertices, point }) => [vertices > 0, point]),
      [
        [true, false],
        [true, false],
        [false, true],
      ],
    );
    // what fails in a drag is undone, and the drag with it
    for (const byGizmo of [true, false]) {
      await openModel('bar');
      await page.evaluate(() => {
        const { engine } = window.arap;
        const call = engine.call.bind(engine);
        engine.call = (name, ...others) =>
          name === 'options' ? Promise.reject(new Error('no such luck')) : call(name, ...others);
      });
      const [x, y] = byGizmo ? (await state()).handles[0].screen : await besideGizmo();
      await drag([x, y], [x + 20, y]);
      await page.select('#cells', 'spokes');
      await page.waitForFunction(() => /No such luck/.test(window.arap.state().message));
      await page.evaluate(() => delete window.arap.engine.call);
      await page.mouse.move(300, 300);
      await page.mouse.up();
      const { handles, undo: steps } = await settled();
      assert.deepEqual(handles[0].matrix, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
      assert.equal(steps, 0);
      assert.equal(await page.$eval('#cells', (c) => c.value), 'spokes_and_rims');
      await page.click('#message button');
    }
    // a shape that the engine has, and the page has not, is not shown as if it were open
    await page.evaluate(() => {
      const { engine } = window.arap;
      const call = engine.call.bind(engine);
      engine.call = (name, ...others) =>
        name === 'hold' ? Promise.reject(new Error('no such luck')) : call(name, ...others);
    });
    await page.evaluate(() => window.arap.openModel('sheet'));
    assert.match(await message(), /^Sheet could not be opened \(no such luck\): open another shape/);
    const isInert = () => page.$eval('#tools', (tools) => tools.inert);
    assert(await isInert());
    await page.evaluate(() => delete window.arap.engine.call);
    await page.click('#message button');
    assert.equal((await openModel('bar')).name, 'bar');
    assert(!(await isInert()));
    // no point in a shape that was opened after the click
    await whileBusy(async () => {
      await page.keyboard.press('r');
      await page.evaluate(() => void window.arap.openModel('sheet'));
      await page.keyboard.press('p');
      await page.mouse.click(...(await middle()));
    });
    await page.waitForFunction(() => window.arap.state()?.name === 'sheet');
    await rest(100);
    const opened = await settled();
    assert.deepEqual([opened.handles.length, opened.undo], [1, 0]);
    await isWell();
  },

  async 'handles that are gone'() {
    // after a point is removed, no other handle is, and none is chosen
    await openModel('sheet');
    await page.keyboard.press('p');
    await page.mouse.click(...(await middle()));
    assert.equal((await settled()).handles.length, 2);
    for (let k = 0; k < 2; ++k) {
      await page.keyboard.press('Delete');
      assert.equal((await settled()).handles.length, 1);
      assert(await page.$eval('#handle', (h) => h.hidden));
    }
    await openModel('sheet');
    await page.keyboard.press('b');
    await page.keyboard.press('3');
    const [x, y] = await middle();
    await drag([x + 90, y], [x + 130, y]);
    await page.mouse.up();
    assert.deepEqual(
      (await settled()).handles.map(({ vertices }) => vertices > 0),
      [true, true],
    );
    await page.evaluate(() => window.arap.choose(0));
    await page.keyboard.press('Delete');
    const left = await settled();
    assert.deepEqual(
      left.handles.map(({ vertices }) => vertices > 0),
      [false, true],
    );
    assert(await page.$eval('#handle', (h) => h.hidden), 'no handle is chosen');
    // a gizmo that is dragged while its handle goes
    await page.click('#undo');
    await settled();
    await page.evaluate(() => {
      window.arap.choose(0);
      dispatchEvent(new KeyboardEvent('keydown', { key: 'Delete' }));
      Object.assign(window.arap.view.gizmo, { axis: 'X', dragging: true });
    });
    await settled();
    assert(
      await page.evaluate(() => {
        const { gizmo, orbit } = window.arap.view;
        return orbit.enabled && !gizmo.dragging;
      }),
      'the view can be turned',
    );
    assert.equal(await page.evaluate(() => window.arap.view.canvas.style.cursor), 'grab');
    // a button keeps the focus, and says that it is pressed
    await page.focus('#regions button:nth-child(2)');
    await page.keyboard.press('Enter');
    assert.deepEqual(
      await page.evaluate(() => {
        const b = document.activeElement;
        return [b.textContent, b.getAttribute('aria-pressed')];
      }),
      ['Fixed', 'true'],
    );
    await page.keyboard.press('g');
    // all paint is cleared in one step
    await page.click('#clear');
    const cleared = await settled();
    assert.deepEqual(
      [cleared.undo - left.undo, cleared.fixed, cleared.handles.length],
      [1, 0, 0],
    );
    await page.click('#undo');
    const again = await settled();
    assert.deepEqual([again.fixed, again.handles.length], [left.fixed, 2]);
    // Space switches what has the focus
    await page.evaluate(() => window.arap.choose(1));
    await page.focus('#soft');
    await page.keyboard.press('Space');
    await settled();
    assert(await page.$eval('#soft', (s) => s.checked));
    assert.equal(await message(), '');
    await page.evaluate(() => document.activeElement.blur());
    // a new handle is not what one with its number was
    await page.keyboard.press('b');
    await page.keyboard.press('2');
    await paintMiddle();
    await settled();
    await page.click('#soft');
    assert.notEqual((await settled()).handles[0].weight, null);
    await page.keyboard.press('Delete');
    await settled();
    await page.keyboard.press('b');
    await page.keyboard.press('2');
    await paintMiddle();
    const [{ vertices, weight }] = (await settled()).handles;
    assert(vertices > 0);
    assert.equal(weight, null);
  },

  async 'a stroke while a shape is opened'() {
    await openModel('bar');
    await page.keyboard.press('b');
    const [x, y] = await middle();
    const opened = page.evaluate(() => window.arap.openModel('sheet'));
    await drag([x - 30, y + 30], [x + 30, y - 30]);
    await page.mouse.up();
    await opened;
    const { fixed } = await settled();
    assert.equal(await message(), '');
    await page.keyboard.press('b');
    await page.keyboard.press('1');
    await paintMiddle();
    const { fixed: more } = await settled();
    assert(more > fixed, 'what is painted later is held');
    // a key that would choose another tool does nothing until the stroke has ended
    await drag([x + 60, y + 30], [x + 90, y]);
    await page.keyboard.press('s');
    await page.mouse.up();
    assert((await settled()).fixed > more, 'what was painted when a key was pressed is held');
    assert.equal(await message(), '');
    // nor does a button
    await page.keyboard.press('s');
    const calls = await callsOf(async () => {
      await drag([x + 60, y + 30], [x + 90, y]);
      await page.evaluate(() => document.querySelector('[data-tool=brush]').click());
      await page.mouse.up();
    });
    assert(calls.includes('stiffness'), 'the stiffness is told to the engine');
    assert.equal((await state()).tool, 'stiffness');
    // the view may change during a stroke
    await openModel('bar');
    await page.keyboard.press('b');
    await page.keyboard.press('1');
    const [a, b] = await middle(),
      painted = () =>
        page.evaluate(() =>
          [...window.arap.status().entries()].filter(([, s]) => s === 0).map(([v]) => v),
        );
    await page.mouse.move(a, b);
    await page.mouse.down();
    await page.mouse.wheel({ deltaY: -600 });
    await rest(200);
    const early = new Set(await painted());
    await page.mouse.move(a, b + 40);
    const added = (await painted()).filter((v) => !early.has(v)),
      p = await positions(),
      places = await onPage(added.map((v) => p.slice(3 * v, 3 * v + 3)));
    await page.mouse.up();
    await settled();
    const far = places.map(([c, d]) => Math.hypot(c - a, d - Math.max(b, Math.min(b + 40, d))));
    assert(far.length > 0 && Math.max(...far) < 27, `${far.length}, up to ${Math.max(...far)} px`);
    await page.keyboard.press('v');
    await page.keyboard.press('g');
  },

  async 'colors of what is gone'() {
    await openModel('bar');
    await dragHandle(100, 60);
    await page.mouse.up();
    await settled();
    await page.select('#measure', 'edge_length_error');
    const quality = () => page.$eval('#quality', (q) => q.textContent);
    await page.waitForFunction(() => /Edges/.test(document.getElementById('quality').textContent));
    assert.doesNotMatch(await quality(), /Edges 0\.00%/);
    await page.click('#clear');
    await settled();
    await page.waitForFunction(
      () => /Edges 0\.00%/.test(document.getElementById('quality').textContent),
      { timeout: 20000 },
    );
    // what is painted is seen, and what is painted next
    await page.select('#measure', 'edge_length_error');
    await page.waitForFunction(() => /Edges/.test(document.getElementById('quality').textContent));
    const colors = () =>
      page.evaluate(() => [
        ...new Set([...window.arap.view.mesh.geometry.attributes.color.array]),
      ]);
    const paintsWith = async (key) => {
      await page.keyboard.press(key);
      const [x, y] = await middle();
      await drag([x - 30, y + 30], [x + 30, y - 30]);
      const during = await colors();
      await page.mouse.up();
      await settled();
      assert.deepEqual(await colors(), during);
      return [during.length, await page.$eval('#measure', (m) => m.value)];
    };
    await page.keyboard.press('1');
    const [regions, none] = await paintsWith('b');
    assert(regions > 3 && none === '', `${regions} colors`);
    assert(await page.$eval('#legend', (legend) => legend.hidden));
    const [stiff, what] = await paintsWith('s');
    assert(stiff > 3 && what === 'stiffness');
    await page.select('#measure', 'edge_length_error');
    await page.waitForFunction(() => /Edges/.test(document.getElementById('quality').textContent));
    await page.select('#measure', 'stiffness');
    assert.equal(await quality(), '');
    await page.select('#measure', 'edge_length_error');
    await openModel('sheet');
    assert.equal(await quality(), '');
    assert(await page.$eval('#legend', (legend) => legend.hidden));
  },

  async 'no module knows one that imports it'() {
    const imported = (name) =>
      [
        ...readFileSync(new URL(`../${name}`, import.meta.url), 'utf8').matchAll(
          /(?:from|import) '\.\/([\w.]+)'/g,
        ),
      ].map((match) => match[1]);
    const done = new Set();
    const visit = (name, path) => {
      assert(!path.includes(name), [...path, name].join(' -> '));
      if (done.has(name)) return;
      imported(name).forEach((other) => visit(other, [...path, name]));
      done.add(name);
    };
    assert(imported('page.js').length > 5);
    visit('page.js', []);
  },

  async 'the command line'() {
    const bar = models.bar[1](),
      status = bar.status.map((s, v) => (s === 2 && v % 2 ? 3 : s));
    await openShape({ ...bar, status }, "it's a bar");
    const line = () => page.evaluate(() => window.arap.commandLine());
    const soften = async (k) => {
      await page.evaluate((handle) => window.arap.choose(handle), k);
      await page.click('#soft');
      await settled();
    };
    assert((await line()).includes(" --selection 'it'\\''s a bar.sel' "), await line());
    assert(!/soft|leaves out/.test(await line()));
    await openShape(bar, '-x');
    assert.match(await line(), /^arap_deform \.\/-x_rest\.off .* \.\/-x\.sel .* \.\/-x\.def /);
    await openShape({ ...bar, status }, "it's a bar");
    await soften(0);
    assert.doesNotMatch(await line(), / --soft/);
    assert.match(await line(), /\nThis line leaves out: weights/);
    await soften(1);
    assert.match(await line(), / --soft [\d.]+$/);
    await page.keyboard.press('s');
    await paintMiddle();
    await settled();
    assert.match(await line(), /\nThis line leaves out: painted stiffness\.$/);
    assert.match(String(await saved('Selection', "it's a bar.sel")), /^# arap.*\n# This.*\n\d/);
    await page.select('#measure', '');
    await page.keyboard.press('g');
  },

  async points() {
    await openModel('sheet');
    await page.keyboard.press('p');
    const [place] = await onPage([[0.503, 0.501, 0]]);
    await page.mouse.click(...place);
    let now = await settled();
    assert.equal(now.handles.length, 2);
    assert(now.handles[1].point);
    await dragHandle(0, -90, 2);
    await page.mouse.up();
    now = await settled();
    await shot('10_point_in_a_face');
    assert(now.energy > 0);
    await page.keyboard.press('Backspace');
    now = await settled();
    assert.equal(now.handles.length, 1);
    // beyond where the shape was before
    await dragHandle(0, -250);
    await page.mouse.up();
    now = await settled();
    await page.keyboard.press('p');
    await page.mouse.click(...now.handles[0].screen);
    now = await settled();
    assert.equal(now.handles.length, 2);
    await page.keyboard.press('Delete');
    await settled();
    await page.keyboard.press('r');
    await settled();
    // a handle of one vertex, which turns the cells around it
    await enter('#brush', 1);
    await page.keyboard.press('b');
    await page.keyboard.press('3');
    const [x, y] = await vertexOnPage(71 * 53 + 20);
    await page.mouse.click(x, y);
    now = await settled();
    assert.equal(now.handles[1].vertices, 1);
    const { energy } = now;
    await page.keyboard.press('g');
    await page.keyboard.down('Shift');
    for (let k = 0; k < 9; ++k) await page.keyboard.press('ArrowRight');
    await page.keyboard.up('Shift');
    await rest(600);
    assert((await settled()).energy > energy + 1e-3, 'one vertex turns its surroundings');
    await shot('10_one_vertex_turned');
    // painted over, it turns nothing any more
    await page.keyboard.press('b');
    await page.keyboard.press('1');
    await page.mouse.click(x, y);
    now = await settled();
    assert.equal(now.handles.length, 1);
    assert(now.energy < energy + 1e-4, `the energy is ${now.energy} instead of ${energy}`);
    await enter('#brush', 26);
    // what is painted when a point has been placed is another handle
    await page.keyboard.press('p');
    await page.mouse.click(...place);
    await settled();
    await page.keyboard.press('b');
    await page.keyboard.press('3');
    await page.mouse.click(place[0] - 100, place[1]);
    now = await settled();
    assert(now.handles[1].point);
    assert(now.handles[2]?.vertices > 0, 'a handle beside the point');
  },

  async 'far from the origin'() {
    const { points, simplices, status } = models.bar[1](),
      origin = [5e6, -4e6, 0],
      far = points.map((x, i) => x + origin[i % 3]),
      path = (ending) => join(files, `far.${ending}`);
    // an eighth of a turn, rounded, about the middle of the bar's first end
    const [px, py] = origin,
      c = 0.7071;
    writeFileSync(path('off'), off({ points: far, simplices }));
    writeFileSync(path('sel'), [...status].join('\n'));
    writeFileSync(
      path('def'),
      `${c} ${-c} 0 ${px - c * (px - py) + 0.5}\n` +
        `${c} ${c} 0 ${py - c * (px + py)}\n0 0 1 0.25\n0 0 0 1\n`,
    );
    await openFile(path('off'), path('sel'), path('def'));
    await page.waitForFunction(() => /Opened: far\.sel/.test(window.arap.state()?.message));
    await page.waitForFunction(() => window.arap.state().energy > 1e-3);
    await settled();
    assert((await page.evaluate(() => window.arap.distanceToTargets())) < 1e-6);
    await shot('23_far');
    const { matrix } = (await state()).handles[0];
    assert(Math.abs(matrix[3] - 0.5) < 1e-4 && Math.abs(matrix[7]) < 1e-4, 'about this place');
    const ours = pointsOf(String(await saved('Mesh .off', 'far.off')));
    assert(
      ours.every((x, i) => status[Math.floor(i / 3)] !== 0 || x === far[i]),
      'what is fixed stays, to the last digit',
    );
    const rest = String(await saved('Rest shape', 'far_rest.off'));
    assert.equal(rest, off({ points: far, simplices }));
    await saved('Selection', 'far.sel');
    await saved('Transforms', 'far.def');
    const distance = largestDifference(ours, theCommands('far.sel')) / 5.2;
    console.log(`  the command's mesh differs by ${distance.toExponential(1)} of the diagonal`);
    assert(distance < 1e-3);
  },

  async volume() {
    await openModel('volume');
    await page.keyboard.press('e');
    await shot('11_volume_rings');
    for (let k = 0; k < 3; ++k) await page.keyboard.press('ArrowRight');
    await page.keyboard.down('Shift');
    for (let k = 0; k < 12; ++k) await page.keyboard.press('ArrowUp');
    await page.keyboard.up('Shift');
    await rest(600);
    await settled();
    await shot('12_volume_turned');
    await page.keyboard.press('w');
    for (let k = 0; k < 140; ++k) await page.keyboard.press('ArrowDown');
    await rest(600);
    const now = await settled();
    await shot('13_inverted');
    console.log(`  ${now.inverted} inverted tetrahedra`);
    assert(now.volume && now.inverted > 0);
    assert((await page.evaluate(() => window.arap.distanceToTargets())) < 1e-6);
    await page.keyboard.press('r');
    assert.equal((await settled()).inverted, 0);
    const { length } = await saved('.mesh', 'bar_of_tetrahedra.mesh');
    await openFile(join(files, 'bar_of_tetrahedra.mesh'));
    await page.waitForFunction(() => window.arap.state()?.undo === 0 && window.arap.state()?.volume);
    assert(
      length > 1000 && (await settled()).simplices === models.volume[1]().simplices.length / 4,
      'it reads what it writes',
    );
  },

  async 'key frames and a film'() {
    await openModel('cactus');
    await page.evaluate(() => {
      const { canvas } = window.arap.view;
      window.streams = [];
      canvas.captureStream = (...rate) => {
        window.streams.push(HTMLCanvasElement.prototype.captureStream.apply(canvas, rate));
        return window.streams.at(-1);
      };
    });
    await page.click('#film');
    assert.match(await message(), /no key frame/);
    assert.equal(await page.evaluate(() => window.streams.length), 0);
    await dragHandle(100, 30);
    await page.mouse.up();
    for (let k = 0; k < 3; ++k) await page.keyboard.down('k'); // held, it adds one
    await page.keyboard.up('k');
    await page.evaluate(() => {
      const { canvas } = window.arap.view,
        { captureStream } = canvas;
      canvas.captureStream = () => {
        canvas.captureStream = captureStream;
        throw new Error('this is not recorded');
      };
    });
    await page.click('#film');
    assert.match(await message(), /^This is not recorded/);
    await dragHandle(-200, 0);
    await page.mouse.up();
    await page.keyboard.press('k');
    await settled();
    assert.equal((await state()).keys, 2);
    const path = join(files, 'cactus.webm');
    rmSync(path, { force: true });
    await page.click('#film');
    await rest(900);
    await shot('14_playing');
    await downloaded(path);
    console.log(`  a film of ${statSync(path).size} bytes`);
    assert(statSync(path).size > 5000);
    assert.deepEqual(
      await page.evaluate(() =>
        window.streams.flatMap((s) => s.getTracks()).map((track) => track.readyState),
      ),
      ['ended'],
    );
    await settled();
    await clickText('Key frames');
    const poses = [1, 2].map((k) => join(files, `cactus-${k}.def`));
    for (const pose of poses) await downloaded(pose);
    // several files of transforms are key frames
    await openModel('cactus');
    writeFileSync(join(files, 'cactus-10.def'), '1 0 0 0\n0 1 0 0\n0 0 1 0.25\n0 0 0 1\n');
    await openFile(join(files, 'cactus-10.def'), poses[1], poses[0]);
    await page.waitForFunction(() => window.arap.state().keys === 3);
    const ofHandle = async () => (await settled()).handles[0].matrix;
    assert.equal((await ofHandle())[11], 0.25);
    await page.click('#keys button:nth-child(2)');
    assert(
      largestDifference(
        await ofHandle(),
        readFileSync(poses[1], 'utf8').trim().split(/\s+/).map(Number),
      ) < 1e-12,
    );
    // a selection that is opened while they play
    const { status } = models.cactus[1]();
    writeFileSync(join(files, 'cactus.sel'), [...status].map((s, v) => (s === 2 ? 5 + 2 * (v % 2) : s)).join('\n'));
    await page.click('#play');
    await rest(300);
    await openFile(join(files, 'cactus.sel'));
    await page.waitForFunction(() => window.arap.state().handles.length === 2);
    const now = await settled();
    assert.deepEqual([now.keys, now.handles.length], [0, 2], 'numbered without gaps');
    assert.equal(await page.$eval('#play', (b) => b.textContent), 'Play');
    await page.click('#undo');
    const before = await settled();
    assert.deepEqual([before.keys, before.handles.length], [3, 1]);
    // in key frames from before, a later handle is at rest
    await page.keyboard.press('b');
    await page.keyboard.press('3');
    await paintMiddle();
    await settled();
    await page.keyboard.press('g');
    await page.keyboard.press('ArrowUp');
    await rest(600);
    assert((await settled()).handles[1].matrix[7] !== 0);
    await page.click('#keys button:nth-child(1)');
    assert.equal(await page.$eval('#message', (m) => m.className), '', 'no error');
    assert.deepEqual(
      (await settled()).handles.map(({ matrix }) => [matrix[3] !== 0, matrix[7] !== 0]),
      [[true, true], [false, false]],
    );
    await page.click('#play');
    await page.waitForFunction(() => window.arap.state().handles[0].matrix[11] === 0.25, { timeout: 20000 });
    assert.equal((await settled()).handles[1].matrix[7], 0);
    // nor has a new handle the motion of one that had its number
    await page.evaluate(() => window.arap.choose(1));
    await page.keyboard.press('ArrowUp');
    await rest(600);
    await page.keyboard.press('k');
    assert.equal((await settled()).keys, 4);
    await page.keyboard.press('Delete');
    assert.equal((await settled()).handles.length, 1);
    await page.keyboard.press('b');
    await page.keyboard.press('3');
    await paintMiddle();
    await settled();
    await page.click('#keys button:nth-child(4)');
    const last = (await settled()).handles;
    assert.deepEqual([last.length, last[1].matrix[7]], [2, 0]);
  },

  async 'key frames without handles, and while they play'() {
    await openModel('bar');
    await page.click('#clear');
    await settled();
    await page.keyboard.press('k');
    await settled();
    assert.match(await message(), /no handle/);
    assert.equal((await state()).keys, 0);
    await page.keyboard.press('p');
    await page.mouse.click(...(await middle()));
    await settled();
    await page.keyboard.press('k');
    await settled();
    assert.equal((await state()).keys, 1);
    for (const press of ['Transforms', 'Key frames']) {
      await page.keyboard.press('Escape');
      await clickText(press);
      assert.match(await message(), /no handle with vertices/, press);
    }
    await page.keyboard.press('Escape');
    // what moves a handle ends the film
    await openModel('bar');
    await page.keyboard.press('ArrowUp');
    await page.keyboard.press('k');
    await page.keyboard.press('k');
    await settled();
    const [{ matrix }] = (await state()).handles;
    const plays = () => page.$eval('#play', (b) => b.textContent === 'Stop');
    await page.click('#play');
    await rest(100);
    assert(await plays());
    await page.click('#keys button:nth-child(1)');
    assert(!(await plays()));
    assert.deepEqual((await settled()).handles[0].matrix, matrix);
    await page.click('#play');
    await rest(100);
    await page.keyboard.press('ArrowLeft');
    assert(!(await plays()));
    await rest(600);
    const before = await settled();
    // what was played until it is stopped is a step
    for (const stop of [() => page.click('#play'), () => page.keyboard.press('Escape')]) {
      await page.click('#play');
      await rest(300);
      await stop();
      await rest(100);
      assert(!(await plays()));
      assert.equal((await settled()).undo, before.undo + 1);
      await pressCommand('z');
      await rest(100);
      const undone = await settled();
      assert.equal(undone.undo, before.undo);
      assert.deepEqual(undone.handles[0].matrix, before.handles[0].matrix);
    }
  },

  async 'rest shape from now'() {
    await openModel('bar');
    await dragHandle(100, 30);
    await page.mouse.up();
    await bend(5);
    assert((await settled()).energy > 1e-4);
    const diagonal = () =>
      page.evaluate(() => {
        const ranges = [0, 1, 2].map((i) => window.arap.positions().filter((x, k) => k % 3 === i));
        return Math.hypot(...ranges.map((range) => Math.max(...range) - Math.min(...range)));
      });
    const bendingOf = async () =>
      Number((await page.evaluate(() => window.arap.commandLine())).match(/--bending (\S+)/)[1]);
    await page.click('#reset');
    await settled();
    const first = await diagonal();
    assert.equal(await bendingOf(), 0.05);
    await page.click('#undo');
    await settled();
    const before = await positions();
    await page.click('#rest');
    const now = await settled();
    assert(now.energy < 1e-12, `the energy of a rest shape is ${now.energy}`);
    assert(largestDifference(before, await positions()) < 1e-5);
    const share = (0.05 * first) / (await diagonal()); // the command takes that of this shape
    assert(Math.abs((await bendingOf()) / share - 1) < 1e-4, `${await bendingOf()}, not ${share}`);
    await page.click('#undo');
    assert((await settled()).energy > 1e-4, 'undo of a rest shape');
    await bend(0);
    // a soft point handle is at its point again, not where it was drawn to
    await openModel('sheet');
    await page.keyboard.press('p');
    await page.mouse.click(...(await middle()));
    await settled();
    await page.click('#soft');
    await enter('#weight', -3);
    await dragHandle(0, -150, 2);
    await page.mouse.up();
    await settled();
    await page.click('#rest');
    const { space } = (await settled()).handles[1],
      shape = await positions();
    let nearest = Infinity;
    for (let v = 0; v < shape.length; v += 3)
      nearest = Math.min(nearest, Math.hypot(...space.map((x, i) => x - shape[v + i])));
    assert(nearest < 0.02, `the marker is at a distance of ${nearest}`);
    await page.click('#soft');
    await page.keyboard.press('g');
  },

  async 'painted where it is deformed'() {
    await openModel('bar');
    await dragHandle(140, 100);
    await page.mouse.up();
    await settled();
    const before = await positions();
    await page.keyboard.press('b');
    await page.keyboard.press('3');
    await page.mouse.click(...(await middle()));
    const now = await settled();
    assert.equal(now.handles.length, 2);
    const moved = largestDifference(before, await positions());
    assert(
      moved < 0.02 * 5.2,
      `a new handle stays where it is, up to its own deformation: ${moved}`,
    );
    await shot('15_second_handle');
  },

  async formats() {
    const { points, simplices } = sphere(4),
      n = points.length / 3,
      at = (v) => [...points.slice(3 * v, 3 * v + 3)].join(' ');
    const facets = (f) =>
      `facet normal 0 0 0\nouter loop\n${f.map((v) => `vertex ${at(v)}`).join('\n')}\n` +
      `endloop\nendfacet`;
    const quads = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3];
    const cube = Array.from({ length: 8 }, (_, v) => `v ${v & 1} ${(v >> 1) & 1} ${v >> 2}`);
    const binary = new DataView(new ArrayBuffer(84 + (50 * simplices.length) / 3));
    binary.setUint32(80, simplices.length / 3, true);
    simplices.forEach((v, i) => {
      for (let c = 0; c < 3; ++c)
        binary.setFloat32(
          84 + 50 * Math.floor(i / 3) + 12 + 12 * (i % 3) + 4 * c,
          points[3 * v + c],
          true,
        );
    });
    const written = {
      'a.ply': [
        `ply\nformat ascii 1.0\nelement vertex ${n}\n` +
          `property float x\nproperty float y\nproperty float z\n` +
          `element face ${simplices.length / 3}\n` +
          `property list uchar int vertex_indices\nend_header\n` +
          `${rows(points, 3, (p) => p.join(' '))}\n` +
          `${rows(simplices, 3, (f) => `3 ${f.join(' ')}`)}\n`,
        n,
        simplices.length / 3,
      ],
      'b.stl': [`solid b\n${rows(simplices, 3, facets)}\nendsolid b\n`, n, simplices.length / 3],
      'e.stl': [binary, n, simplices.length / 3],
      'c.obj': [
        `${cube.join('\n')}\n` +
          `${rows(quads, 4, (f) => `f ${f.map((v) => `${v - 8}//1`).join(' ')}`)}\n`,
        8,
        6,
      ],
      'd.off': [`OFF 3 1 0 # a triangle\n0 0 0\n\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n`, 3, 1],
    };
    const length = (p) => Math.max(...p) - Math.min(...p);
    for (const [name, [content, vertices, faces]] of Object.entries(written)) {
      writeFileSync(join(files, name), content);
      await openFile(join(files, name));
      await page.waitForFunction((wanted) => window.arap.state()?.name === wanted, {}, name[0]);
      const now = await settled();
      assert.deepEqual([now.vertices, now.simplices], [vertices, faces], name);
      const wanted = vertices === n ? length(points) : 1;
      assert(Math.abs(length(await positions()) - wanted) < 1e-6, name);
    }
  },

  async 'polygons, with a selection and transforms'() {
    const bar = models.bar[1](),
      quads = Array.from({ length: bar.simplices.length / 6 }, (_, k) =>
        [0, 1, 2, 5].map((i) => bar.simplices[6 * k + i]),
      ),
      path = (ending) => join(files, `quads.${ending}`),
      turn = '1 0 0 0.2\n0 0.8 -0.6 2.5\n0 0.6 0.8 0.5\n0 0 0 1\n';
    const mesh =
      `OFF\n${bar.points.length / 3} ${quads.length} 0\n` +
      `${rows(bar.points, 3, (p) => p.join(' '))}\n${quads.map((q) => `4 ${q.join(' ')}`).join('\n')}\n`;
    writeFileSync(path('off'), mesh);
    writeFileSync(path('sel'), `# a bar\n${[...bar.status].join('\n')}\n`);
    writeFileSync(path('def'), turn);
    await openFile(path('def'), path('off'), path('sel'));
    await page.waitForFunction(() => window.arap.state()?.name === 'quads');
    await page.waitForFunction(() => /Opened: quads\.sel, quads\.def\./.test(window.arap.state().message));
    await page.waitForFunction(() => window.arap.state().energy > 1e-3);
    const now = await settled();
    assert.equal(now.simplices, quads.length);
    assert.match(await page.$eval('#name', (e) => e.textContent), /polygons$/);
    assert(
      largestDifference(now.handles[0].matrix, turn.trim().split(/\s+/).map(Number)) < 1e-12,
    );
    assert(
      await page.evaluate(() => dispatchEvent(new Event('beforeunload', { cancelable: true }))),
      'nothing is lost yet',
    );
    assert((await page.evaluate(() => window.arap.distanceToTargets())) < 1e-6);
    await shot('22_polygons');
    // what is saved has the polygons, and is what the command makes of these files
    const ours = pointsOf(String(await saved('Mesh .off', 'quads.off')));
    assert.equal(
      String(readFileSync(path('off'))).split('\n').filter((line) => /^4 /.test(line)).length,
      quads.length,
    );
    assert.equal(String(await saved('Rest shape', 'quads_rest.off')), mesh);
    assert.match(String(await saved('Selection', 'quads.sel')), /quads_rest\.off/);
    assert.deepEqual(
      readFileSync(path('sel'), 'utf8').replace(/#.*/g, '').trim().split(/\s+/).map(Number),
      [...bar.status],
    );
    await saved('.mesh', 'quads.mesh');
    assert.match((await state()).message, /quads\.mesh was saved, with its polygons cut/);
    const theirs = theCommands('quads.sel');
    const distance = largestDifference(ours, theirs) / 5.2;
    console.log(`  the command's mesh differs by ${distance.toExponential(1)} of the diagonal`);
    assert(distance < 1e-3);
    // a point in a polygon
    await page.keyboard.press('p');
    await page.mouse.click(...(await middle()));
    const { handles, energy } = await settled();
    assert(handles[1].point);
    assert(Math.abs(energy / now.energy - 1) < 1e-2, 'it stays where it is');
    await dragHandle(60, 0, 2);
    await page.mouse.up();
    assert((await settled()).energy > 1.01 * energy, 'it moves');
    // a selection of another shape changes nothing, nor do transforms that come with it
    const before = await state();
    writeFileSync(join(files, 'other.sel'), '0\n1\n');
    await openFile(join(files, 'other.sel'), path('def'));
    await page.waitForFunction(() => /other\.sel .* 2 statuses/.test(window.arap.state().message));
    const left = await settled();
    assert.deepEqual([left.undo, left.handles], [before.undo, before.handles]);
    await page.keyboard.press('Escape');
    // a selection while a handle is dragged: what was a point is gone
    await dragHandle(20, 20, 2);
    await openFile(path('sel'));
    await page.waitForFunction(() => window.arap.state().handles.length === 1);
    await page.mouse.move(300, 300);
    await page.mouse.up();
    const undone = (await settled()).undo;
    await page.click('#undo');
    const again = await settled();
    assert.deepEqual([again.undo, again.handles.length], [undone - 1, 2]);
  },

  async errors() {
    await openModel('bar');
    const before = await state();
    const wrong = {
      'empty.off': '',
      'words.off': 'OFF\n3 1 0\n0 0 x\n1 0 0\n0 1 0\n3 0 1 2\n',
      'index.off': 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n',
      'short.off': 'OFF\n30 1 0\n0 0 0\n',
      'faceless.obj': 'v 0 0 0\nv 1 0 0\n',
      'picture.jpg': 'x',
      'nothing.mesh': 'MeshVersionFormatted 2\nVertices\n1\n0 0 0 0\nEnd\n',
      'noise.ply': 'ply\nformat ascii 1.0\nend_header\n',
      'noise.stl': 'solid x\nendsolid x\n',
      'huge.off': 'OFF\n1e9 1 0\n',
      'nan.obj': 'v nan 0 0\nf 1 1 1\n',
      'vast.off': 'OFF\n3 1 0\n0 0 0\n1e20 0 0\n0 1e160 0\n3 0 1 2\n',
      'tiny.obj': 'v 0 0 0\nv 1e-20 0 0\nv 0 1e-20 0\nf 1 2 3\n',
    };
    for (const [name, text] of Object.entries(wrong)) {
      writeFileSync(join(files, name), text);
      await page.click('#message button').catch(() => {});
      await page.evaluate(() => {
        document.querySelector('#message').hidden = true;
      });
      await openFile(join(files, name));
      await page.waitForFunction(() => !document.querySelector('#message').hidden, {
        timeout: 20000,
      });
      const said = (await message()).replace(/\s*×\s*$/, '');
      console.log(`  ${said}`);
      assert(said.includes(name) && /\.$/.test(said));
    }
    await shot('16_error');
    const after = await state();
    assert.deepEqual(
      [after.name, after.vertices, after.energy],
      [before.name, before.vertices, before.energy],
      'nothing is lost',
    );
    // nor by a shape that the engine takes, but not its options
    const vast = { ...models.sheet[1](), points: models.sheet[1]().points.map((x) => 1e160 * x) };
    await page.keyboard.press('Escape');
    await assert.rejects(openShape(vast, 'vast'), /bending_length must be finite/);
    await page.select('#cells', 'spokes');
    const kept = await settled();
    assert.deepEqual([kept.name, kept.vertices, kept.undo], [before.name, before.vertices, 1]);
    await page.select('#cells', 'spokes_and_rims');
    await settled();
    assert.equal(await message(), '');
    // two parts, of which one is held by nothing
    const two = sphere(6),
      points = [...two.points, ...two.points.map((x, i) => x + (i % 3 === 0 ? 3 : 0))],
      n = two.points.length / 3;
    writeFileSync(
      join(files, 'two.off'),
      off({ points, simplices: [...two.simplices, ...two.simplices.map((v) => v + n)] }),
    );
    await openFile(join(files, 'two.off'));
    await page.waitForFunction(() => window.arap.state()?.name === 'two');
    await settled();
    const at = await onPage([
      [0, 0, -0.7],
      [0, 0, 0.9],
    ]);
    await page.keyboard.press('1');
    await page.mouse.click(...at[0]);
    await settled();
    await page.keyboard.press('2');
    await page.mouse.click(...at[1]);
    await settled();
    await page.keyboard.press('g');
    await dragHandle(20, -30);
    await page.mouse.up();
    await settled();
    assert.match(await message(), /held by nothing/);
  },

  async 'a phone'() {
    const phone = await newPage({
      width: 390,
      height: 844,
      hasTouch: true,
      isMobile: true,
      deviceScaleFactor: 2,
    });
    await settled(phone);
    await phone.evaluate(() => document.querySelector('#begin').click());
    await shot('17_phone', phone);
    const {
      screen: [x, y],
    } = (await state(phone)).handles[0];
    const finger = await phone.touchscreen.touchStart(x, y);
    for (let k = 1; k <= 10; ++k) await finger.move(x + 6 * k, y + 9 * k);
    await finger.end();
    const now = await settled(phone);
    assert(now.energy > 1e-4, 'a finger drags the handle');
    await shot('18_phone_dragged', phone);
    await phone.tap('#more');
    await rest(200);
    await shot('19_phone_panel', phone);
    assert(
      await phone.evaluate(() => document.documentElement.scrollWidth <= innerWidth),
      'nothing is wider than the screen',
    );
    // painting by touch
    await phone.tap('#more');
    await phone.tap('[data-tool=brush]');
    await phone.evaluate(() =>
      [...document.querySelectorAll('#regions button')]
        .find((b) => b.textContent === 'Fixed')
        .click(),
    );
    const { fixed } = await state(phone),
      [[a, b]] = await onPage([[0, 0, 0.4]], phone);
    const stroke = await phone.touchscreen.touchStart(a - 8, b);
    for (let k = 1; k <= 8; ++k) await stroke.move(a - 8 + 2 * k, b);
    await stroke.end();
    assert((await settled(phone)).fixed > fixed, 'a finger paints');
    // two fingers place no point, one does
    await phone.tap('[data-tool=point]');
    const before = (await state(phone)).handles.length,
      first = await phone.touchscreen.touchStart(a, b),
      second = await phone.touchscreen.touchStart(a + 40, b + 40);
    await second.move(a + 60, b + 60);
    await second.end();
    await first.end();
    assert.equal((await settled(phone)).handles.length, before);
    await phone.touchscreen.tap(...(await onPage([[0, 0, 0.4]], phone))[0]);
    assert.equal((await settled(phone)).handles.length, before + 1);
    // two fingers move the view, and turn it where one paints
    const lookTo = () =>
      phone.evaluate(() => {
        const { camera } = window.arap.view;
        return [camera.position.toArray(), camera.quaternion.toArray()];
      });
    const moveTwoFingers = async () => {
      const fingers = [await phone.touchscreen.touchStart(40, 600)];
      fingers.push(await phone.touchscreen.touchStart(80, 600));
      for (let k = 1; k <= 10; ++k)
        for (const [i, f] of fingers.entries()) await f.move(40 * (i + 1) + 5 * k, 600 + 5 * k);
      for (const f of fingers) await f.end();
      await rest(100);
      return lookTo();
    };
    await phone.tap('[data-tool=grab]');
    // a second finger takes a motion of the gizmo back
    await phone.evaluate(() => window.arap.choose(0));
    const { undo, handles } = await state(phone),
      [{ matrix, screen: place }] = handles,
      held = await phone.touchscreen.touchStart(...place);
    for (let k = 1; k <= 5; ++k) await held.move(place[0] + 6 * k, place[1]);
    assert.notDeepEqual((await state(phone)).handles[0].matrix, matrix);
    const other = await phone.touchscreen.touchStart(40, 600);
    await other.end();
    await held.end();
    await rest(100);
    const back = await settled(phone);
    assert.deepEqual([back.undo, back.handles[0].matrix], [undo, matrix]);
    const start = await lookTo(),
      moved = await moveTwoFingers();
    assert(largestDifference(moved[0], start[0]) > 0.01, 'two fingers move the view');
    assert(largestDifference(moved[1], start[1]) < 1e-6, 'and do not turn it');
    await phone.tap('[data-tool=brush]');
    const turned = await moveTwoFingers();
    assert(largestDifference(turned[1], moved[1]) > 0.01, 'two fingers turn it where one paints');
    await phone.close();
  },

  async 'an engine that cannot start'() {
    const broken = await browser.newPage();
    await broken.setRequestInterception(true);
    broken.on('request', (request) =>
      request.url().endsWith('.wasm') ? request.abort() : request.continue(),
    );
    await broken.goto(address);
    await broken.waitForFunction(() =>
      /could not be started/.test(document.querySelector('#message').innerText),
    );
    assert(await broken.$eval('#help', (help) => help.hidden));
    await broken.click('#message button');
    assert(await broken.$eval('#message', (m) => m.hidden), 'the message can be closed');
    await broken.close();
  },

  async 'one file without a server'() {
    const local = await newPage({}, pathToFileURL(join(live, 'arap_live.html')).href);
    await local.evaluate(() => document.querySelector('#begin').click());
    await settled(local);
    const {
      screen: [x, y],
    } = (await state(local)).handles[0];
    await drag([x, y], [x + 100, y + 40], 10, local);
    await local.mouse.up();
    assert((await settled(local)).energy > 1e-4);
    await local.close();
  },

  async '10,000 drag events'() {
    await page.setViewport({ width: 720, height: 400 }); // drawing is by software here
    await openModel('sphere');
    const round = (count) =>
      page.evaluate(async (events) => {
        const { view } = window.arap,
          {
            screen: [x, y],
          } = window.arap.state().handles[0];
        const fire = (type, a, b, target) =>
          target.dispatchEvent(
            new PointerEvent(type, {
              clientX: a,
              clientY: b,
              pointerId: 7,
              button: type === 'pointermove' ? -1 : 0,
              buttons: 1,
              bubbles: true,
              pointerType: 'mouse',
              isPrimary: true,
            }),
          );
        view.canvas.setPointerCapture = view.canvas.releasePointerCapture = () => {};
        fire('pointermove', x, y, view.canvas);
        fire('pointerdown', x, y, view.canvas);
        for (let k = 0; k < events; ++k) {
          fire('pointermove', x + 60 * Math.sin(k / 40), y - 40 * Math.sin(k / 90), view.canvas);
          if (k % 20 === 19) await new Promise(requestAnimationFrame);
        }
        fire('pointermove', x, y, view.canvas);
        fire('pointerup', x, y, view.canvas);
      }, count);
    for (let k = 0; k < 4; ++k) {
      // with what undo keeps
      await round(500);
      await settled();
    }
    const before = await garbage(),
      start = await state(),
      time = Date.now();
    await round(10000);
    const seconds = (Date.now() - time) / 1000,
      end = await state();
    await settled();
    const after = await garbage();
    console.log(
      `  ${end.steps - start.steps} steps and ${end.frames - start.frames} frames ` +
        `in ${seconds.toFixed(1)} s; ${heaps([before, after])}`,
    );
    assert(end.steps > start.steps + 30, 'it follows');
    assert(after.script < before.script + 3e6 && after.engine === before.engine, 'nothing grows');
  },

  async 'fifty models'() {
    const ids = Object.keys(models),
      sizes = [];
    for (let k = 0; k < 50; ++k) {
      await openModel(ids[k % ids.length]);
      if (k === 19 || k === 49) sizes.push(await garbage());
    }
    console.log(`  ${heaps(sizes)}`);
    assert(
      sizes[1].script < sizes[0].script + 3e6 && sizes[1].engine === sizes[0].engine,
      'nothing grows',
    );
  },

  async '400,000 vertices'() {
    await page.setViewport({ width: 1280, height: 800 });
    const path = join(files, 'large.off');
    writeFileSync(path, off(sphere(200)));
    let time = Date.now();
    await page.evaluate(() => {
      window.shown = new Set();
      const look = () => {
        const busy = document.getElementById('busy');
        if (!busy.hidden) window.shown.add(busy.textContent);
        if (window.shown) requestAnimationFrame(look);
      };
      look();
    });
    await openFile(path);
    await page.waitForFunction(() => window.arap.state()?.name === 'large', { timeout: 120000 });
    await settled();
    const opened = Date.now() - time;
    const shown = await page.evaluate(() => {
      const texts = [...window.shown];
      delete window.shown;
      return texts;
    });
    assert(shown.includes('Reading large.off…'), `it shows ${shown}`);
    const statuses = [...sphere(200).status];
    assert.equal((await state()).vertices, statuses.length);
    // painted by hand: boxes at both ends
    const at = await onPage([
      [0, 0, -1],
      [0, 0, 1],
    ]);
    await page.keyboard.press('x');
    await clickText('Fixed');
    await drag([at[0][0] - 120, at[0][1] + 60], [at[0][0] + 120, at[0][1] - 60], 3);
    await page.mouse.up();
    await settled();
    await clickText('Handle 1');
    await drag([at[1][0] - 90, at[1][1] - 60], [at[1][0] + 90, at[1][1] + 40], 3);
    time = Date.now();
    await page.mouse.up();
    await page.waitForFunction(() => window.arap.state().handles.length === 1, { timeout: 120000 });
    await settled(page, 300000);
    const prepared = Date.now() - time;
    await page.keyboard.press('g');
    await dragHandle(60, -40);
    await page.waitForFunction(() => window.arap.state().energy > 0, { timeout: 120000 });
    const during = await state();
    await shot('20_large');
    await page.mouse.up();
    console.log(
      `  opened in ${opened} ms, ready in ${prepared} ms, then ` +
        `${during.milliseconds.toFixed(0)} ms for ${during.iterations} iterations`,
    );
    await openModel('bar');
  },

  // for the README: convert -delay 8 -loop 0 build/live/screenshots/film/*.png -colors 64 -layers
  // optimize arap_live.gif
  async 'a picture that moves'() {
    const film = join(shots, 'film');
    mkdirSync(film, { recursive: true });
    const small = await newPage({ width: 760, height: 460 });
    await small.evaluate(() => {
      document.querySelector('#begin').click();
      document.querySelector('#more').click();
    });
    await rest(100);
    await small.evaluate(() => window.arap.view.fit());
    await settled(small);
    const {
      screen: [x, y],
    } = (await state(small)).handles[0];
    let count = 0;
    const take = () =>
      small.screenshot({ path: join(film, `${String(count++).padStart(2, '0')}.png`) });
    await take();
    await small.mouse.move(x, y);
    await small.mouse.down();
    for (let k = 1; k <= 26; ++k) {
      const t = (2 * Math.PI * k) / 26;
      await small.mouse.move(x + 130 * Math.sin(t), y + 60 * (1 - Math.cos(t)));
      await rest(150);
      await take();
    }
    await small.mouse.up();
    await small.close();
  },

  // three iterations a frame, in turns with the same drag natively, in one thread; drawing is not
  // in it
  async 'milliseconds in the worker'() {
    const median = (list) => [...list].sort((a, b) => a - b)[list.length >> 1];
    for (const [f, frames] of [
      [32, 150],
      [101, 40],
    ]) {
      const shape = sphere(f),
        name = join(files, `sphere_${f}`);
      writeFileSync(`${name}.off`, off(shape));
      writeFileSync(`${name}.sel`, `${shape.status.join('\n')}\n`);
      await openShape(shape, 'sphere');
      const native = [],
        worker = [];
      for (let round = 0; round < 5; ++round) {
        const output = execFileSync(join(live, 'frames'), [
          `${name}.off`,
          `${name}.sel`,
          String(frames),
        ])
          .toString()
          .trim()
          .split('\n')
          .map(Number);
        const ours = await page.evaluate(async (count) => {
          const times = [];
          let energy = 0;
          await window.arap.engine.call('reset');
          for (let k = 0; k < count; ++k) {
            const matrix = [1, 0, 0, 0.3 * Math.sin(k / 10), 0, 1, 0, 0, 0, 0, 1, 0.3, 0, 0, 0, 1];
            const step = await window.arap.engine.call('step', {
              handles: [{ matrix }],
              iterations: 3,
              tolerance: 0,
            });
            times.push(step.milliseconds);
            ({ energy } = step);
          }
          return { times, energy };
        }, frames);
        assert(Math.abs(output.pop() / ours.energy - 1) < 1e-9, 'the same energy');
        native.push(median(output.slice(frames / 3)));
        worker.push(median(ours.times.slice(frames / 3)));
      }
      const ratio = median(worker) / median(native);
      console.log(
        `  ${shape.points.length / 3} vertices: ${median(worker).toFixed(1)} ms in the worker, ` +
          `${median(native).toFixed(1)} ms natively, ratio ${ratio.toFixed(2)}`,
      );
      assert(ratio < 4);
    }
    await openModel('bar');
  },
};

let failures = 0;
for (const [name, step] of Object.entries(steps)) {
  if (!pattern.test(name)) continue;
  console.log(name);
  const start = Date.now();
  try {
    await step();
    assert.deepEqual(complaints.splice(0), [], 'errors in the console');
    console.log(`  well, ${((Date.now() - start) / 1000).toFixed(1)} s`);
  } catch (error) {
    ++failures;
    console.log(`  FAILED: ${error.stack}`);
    console.log(
      `  the page says: ${await message().catch(() => '')} ${complaints.splice(0).join('; ')}`,
    );
    await shot(`failed_${name.replace(/\W+/g, '_')}`).catch(() => {});
  }
}
await browser.close();
server.close();
console.log(
  failures
    ? `${failures} steps failed`
    : `The page: all is well; screenshots: ${readdirSync(shots).length} in build/live/screenshots`,
);
process.exit(failures ? 1 : 0);
