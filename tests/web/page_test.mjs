// The page of examples/web_picking in a browser without a screen. Exact integers judge what it shows.

import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import path from 'node:path';
import test from 'node:test';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';
import { contact, nearest } from './oracle.mjs';

const folder = fileURLToPath(new URL('../page/', import.meta.url));
const noTriangle = 0xffffffff;
const picture = fileURLToPath(new URL('../page.png', import.meta.url));
const kinds = { '.html': 'text/html', '.css': 'text/css', '.js': 'text/javascript', '.wasm': 'application/wasm' };

/** Any static server: this one answers with the files of a folder. */
const server = createServer(async (request, response) => {
  const name = path.basename(new URL(request.url, 'http://localhost').pathname) || 'index.html';
  try {
    const bytes = await readFile(path.join(folder, name));
    response.writeHead(200, { 'Content-Type': kinds[path.extname(name)] ?? 'application/octet-stream' }).end(bytes);
  } catch {
    response.writeHead(404).end();
  }
});
await new Promise((listens) => server.listen(0, '127.0.0.1', listens));
const address = `http://127.0.0.1:${server.address().port}/`;
const browser = await chromium.launch({
  executablePath: process.env.SUREHIT_CHROMIUM,
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});
test.after(async () => {
  await browser.close();
  server.close();
});

/** All that the page has complained about. */
const complaints = [];
const tab = await browser.newPage({ viewport: { width: 1280, height: 800 } });
tab.on('console', (message) => {
  if (['error', 'warning'].includes(message.type())) complaints.push(message.text());
});
tab.on('pageerror', (error) => complaints.push(String(error)));
tab.on('requestfailed', (request) => complaints.push(`no answer from ${request.url()}`));
test.afterEach(() => assert.deepEqual(complaints.splice(0), []));

const timeout = 120_000;

/** Waits for some more frames. */
async function frames(count) {
  const now = await tab.evaluate(() => Number(document.body.dataset.frames ?? 0));
  await tab.waitForFunction((last) => Number(document.body.dataset.frames ?? 0) >= last, now + count, { timeout });
}

async function open(query) {
  await tab.goto(address + query);
  await frames(1);
}

const textOf = (id) => tab.locator(`#${id}`).textContent();

/** What the panel says about a pixel, and the pixel's ray. */
async function picked(x, y) {
  await tab.mouse.move(x, y);
  await frames(2);
  const shown = {};
  for (const id of ['triangle', 't', 'u', 'v', 'side', 'part']) shown[id] = await textOf(id);
  return { shown, ray: await tab.evaluate(() => globalThis.page.picked.ray) };
}

const shownMesh = () => tab.evaluate(() => {
  const { positions, index } = globalThis.page.mesh;
  return { positions: Array.from(positions), index: Array.from(index) };
});
const cornersOf = ({ positions, index }, triangle) =>
  [0, 1, 2].flatMap((i) => positions.slice(3 * index[3 * triangle + i], 3 * index[3 * triangle + i] + 3));

/** True where one exact t is below another. */
const isBefore = (p, q) => p.t * q.det < q.t * p.det;

/** Whether a ray goes by a ball around the triangle, with much room for rounding. */
function goesBy(ray, corners) {
  const squared = (p) => p[0] ** 2 + p[1] ** 2 + p[2] ** 2;
  const middle = [0, 1, 2].map((i) => (corners[i] + corners[i + 3] + corners[i + 6]) / 3);
  const radius = Math.max(...[0, 3, 6].map((at) => squared(middle.map((x, i) => corners[at + i] - x))));
  const way = middle.map((x, i) => x - ray[i]);
  const along = way[0] * ray[3] + way[1] * ray[4] + way[2] * ray[5];
  return squared(way) - along ** 2 / squared(ray.slice(3)) > 1.01 * radius + 1e-9 * squared(way);
}

/** The first triangle that a ray meets, by trying all of them. */
function firstContact(mesh, ray) {
  let first = null;
  for (let triangle = 0; 3 * triangle < mesh.index.length; ++triangle) {
    const corners = cornersOf(mesh, triangle);
    if (goesBy(ray, corners)) continue;
    const exact = contact(ray, corners);
    if (exact !== null && (first === null || isBefore(exact, first.exact))) first = { triangle, exact };
  }
  return first;
}

let mesh;

test('the level has the bits of all platforms', async () => {
  await open('?still&rays=1000');
  mesh = await shownMesh();
  const hash = await tab.evaluate(async () => {
    const { positions, index, parts } = globalThis.page.mesh;
    const end = 3 * parts[1].firstTriangle;
    const vertices = 1 + index.subarray(0, end).reduce((last, i) => Math.max(last, i), 0);
    let sum = 0xcbf29ce484222325n;
    for (const words of [new Uint32Array(positions.buffer, 0, 3 * vertices), index.subarray(0, end)]) {
      for (const word of words) sum = BigInt.asUintN(64, (sum ^ BigInt(word)) * 0x100000001b3n);
    }
    return sum.toString(16);
  });
  assert.equal(hash, 'fe826125160626d2');
});

test('the pointer picks the exact triangle', async () => {
  const { shown, ray } = await picked(120, 640);
  const { triangle, exact: { t, u, v, det, isFront } } = firstContact(mesh, ray);
  assert.deepEqual(shown, {
    triangle: triangle.toLocaleString('en'),
    t: String(nearest(t, det)),
    u: String(nearest(u, det)),
    v: String(nearest(v, det)),
    side: isFront ? 'front' : 'back',
    part: 'the level',
  });
  assert.equal(shown.triangle, '41,419');
  assert.equal((await picked(480, 520)).shown.part, 'the hare');
  await tab.mouse.move(1100, 700);
});

test('exact integers agree with surehit where three-mesh-bvh is wrong', async () => {
  await tab.waitForFunction(() => globalThis.page.contestants[2].lastWrong !== null, null, { timeout });
  const results = await tab.evaluate(() => globalThis.page.contestants.map(
    ({ name, milliseconds, asked, wrong, lastWrong }) => ({ name, milliseconds, asked, wrong, lastWrong })));
  console.table(results.map(({ name, milliseconds, asked, wrong }) => ({ name, milliseconds, asked, wrong })));
  for (const { asked, milliseconds } of results) assert.ok(asked > 0 && milliseconds > 0);
  const { ray, triangle, found } = results[2].lastWrong;
  const first = firstContact(mesh, ray);
  assert.equal(first?.triangle ?? noTriangle, triangle);
  const theirs = found === noTriangle ? null : contact(ray, cornersOf(mesh, found));
  assert.ok(theirs === null || isBefore(first.exact, theirs));
  assert.deepEqual(results.slice(0, 2).map(({ wrong }) => wrong), [0, 0]);
});

test('the slider and the aim', async () => {
  assert.equal(await textOf('rays-text'), '1,000');
  await tab.locator('#rays').fill('100');
  assert.equal(await textOf('rays-text'), '100,000');
  await tab.locator('#rays').fill('50');
  await tab.locator('#aim').selectOption('anywhere');
  await frames(2);
  assert.ok(await tab.evaluate(() => globalThis.page.contestants[0].asked) >= 10_000);
  await writeFile(picture, await tab.screenshot());
  await tab.locator('#rays').fill('0');
});

const quad = 'ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n' +
  'element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n4 0 0\n4 4 0\n0 4 0\n4 0 1 2 3\n';
const facets = ['0 0 0 4 0 0 4 4 0', '0 0 0 4 4 0 0 4 0'].map((corners) => 'facet normal 0 0 1\nouter loop\n' +
  corners.match(/\d \d \d/g).map((corner) => `vertex ${corner}\n`).join('') + 'endloop\nendfacet\n');
const give = (name, text) =>
  tab.locator('#file').setInputFiles({ name, mimeType: 'text/plain', buffer: Buffer.from(text) });
const waitForText = (id, expected) => tab.waitForFunction(
  ([at, start]) => document.getElementById(at).textContent.startsWith(start), [id, expected], { timeout });

test('meshes of the user', async () => {
  for (const [name, text] of Object.entries({
    'square.obj': 'v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nf 1 2 3 4\n',
    'square.off': 'OFF\n4 1 0\n0 0 0\n4 0 0\n4 4 0\n0 4 0\n4 0 1 2 3\n',
    'square.ply': quad,
    'square.stl': `solid s\n${facets.join('')}endsolid s\n`,
  })) {
    await give(name, text);
    await waitForText('mesh', `${name}: 2 triangles`);
    const { positions, index } = await shownMesh();
    assert.deepEqual(positions, [-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]);
    assert.deepEqual(index, [0, 1, 2, 0, 2, 3]);
    assert.equal(await tab.locator('#message').isVisible(), false);
  }
});

test('meshes that cannot be used', async () => {
  for (const [name, text, error] of [
    ['bad.obj', 'v 0 0 0\nv 1 0 0\nv x 1 0\nf 1 2 3\n', 'bad.obj: a coordinate of triangle 0 is no number'],
    ['strange.off', 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n', 'strange.off: a coordinate of triangle 0 is no'],
    ['empty.ply', quad.replace('vertex 4', 'vertex 0').replace(/element face[^]*/, 'end_header\n'), 'empty.ply: '],
    ['picture.png', 'PNG', 'picture.png: expected a file .obj, .ply, .stl or .off'],
    ['short.off', 'OFF\n3 1 0\n0 0 0\n', 'short.off: a coordinate of vertex 1 is no number'],
  ]) {
    await give(name, text);
    await waitForText('message', error);
    assert.equal(await textOf('mesh'), 'square.stl: 2 triangles', 'it is still there');
  }
  await frames(1);
});

test('an address names a mesh', async () => {
  await writeFile(path.join(folder, 'triangle.obj'), 'v 0 0 0\nv 0 2 0\nv 0 0 2\nf 1 2 3\n');
  await open('?still&rays=1000&mesh=triangle.obj&up=y');
  assert.equal(await textOf('mesh'), 'triangle.obj: 1 triangle');
  assert.deepEqual((await shownMesh()).positions, [0, 1, 0, 0, 1, 2, 0, -1, 0]);
});
