// Puts the page together: meshes, the collider, the light, the contest, and a frame at a time.

import { load } from 'surehit';
import { asThreeAsks, Contest } from './contest.js';
import { buildFigure } from './figure.js';
import { buildLevel, hall } from './level.js';
import { aims, Light } from './light.js';
import { readMesh } from './mesh_file.js';
import { Panel } from './panel.js';
import { Stage } from './stage.js';
import { joined, partOf, placed, turnedUp } from './world.js';

const maxRays = 100_000;
/** Milliseconds between two comparisons, and how many times as long as one they are apart. */
const minPause = 400;
const pauseFactor = 3;

/** ?rays=5000&aim=edges&view=figure&mesh=bunny.obj&up=y&still */
const given = new URLSearchParams(location.search);

const { sin, cos } = Math;
const views = {
  level: {
    meshes: (level, figure) => [level, placed(figure, hall.place, 2.3)],
    camera: { eye: hall.eye, target: [36.3, 27.2, 1.35], size: 9 },
    path: (s) => [36.5 + 2.6 * sin(0.43 * s + 0.9), 27.1 + 2.1 * cos(0.31 * s + 2), 2.65 + 0.45 * sin(0.6 * s)],
  },
  figure: {
    meshes: (level, figure) => [placed(figure, [0, 0, 0], 2)],
    camera: { eye: [1.7, -2.9, 1.75], target: [0, 0, 0.92], size: 2.4 },
    path: (s) => [1.7 * cos(0.7 * s - 1.9), 1.7 * sin(0.7 * s - 1.9), 1.5 + 0.6 * sin(0.5 * s)],
  },
};

class Page {
  #surehit;
  #level;
  #figure;
  #up = 'z';
  #stage;
  #panel;
  #rays;
  #collider = null;
  #mesh = null;
  #light = null;
  #contest = null;
  #pointer = null;
  #seconds = 0;
  #lastFrame = null;
  #isMoving = true;
  #nextComparison = 0;
  /** What was picked last: the ray and the hit. */
  picked = null;

  static async start() {
    const page = new Page();
    page.#surehit = await load();
    page.#level = await buildLevel();
    page.#figure = buildFigure();
    page.#rays = page.#surehit.numbers('double', 6 * maxRays);
    page.#stage = new Stage(document.getElementById('canvas'));
    page.#panel = new Panel({
      aims,
      onRays: () => page.#compareAnew(),
      onAim: () => page.#compareAnew(),
      onMotion: (isMoving) => { page.#isMoving = isMoving; },
      onView: () => page.#show(),
      onUp: (axis) => {
        page.#up = axis;
        page.#show();
      },
      onFile: (file) => page.#take(file.name, file.arrayBuffer()),
    });
    page.#readAddress();
    page.#show();
    const meshAddress = given.get('mesh');
    if (meshAddress !== null) await page.#take(meshAddress.split('/').pop(), bytesAt(meshAddress));
    page.#listen();
    if (!document.getElementById('message').classList.contains('error')) page.#panel.say('');
    requestAnimationFrame((now) => page.#frame(now));
    return page;
  }

  #readAddress() {
    const panel = this.#panel;
    if (given.has('rays')) panel.rays = Math.min(maxRays, Math.max(1000, Number(given.get('rays')) || 0));
    if (given.get('aim') in aims) panel.aim = given.get('aim');
    if (given.get('view') in views) panel.view = given.get('view');
    if (given.has('still')) panel.moves = this.#isMoving = false;
    if (given.get('up') === 'y') panel.up = this.#up = 'y';
  }

  #listen() {
    const canvas = document.getElementById('canvas');
    canvas.addEventListener('pointermove', (event) => { this.#pointer = [event.offsetX, event.offsetY]; });
    canvas.addEventListener('pointerleave', () => { this.#pointer = null; });
    new ResizeObserver(() => this.#stage.resize()).observe(canvas);
  }

  /** Takes a mesh that the user gives in the place of the hare. What was shown stays if it cannot be read. */
  async #take(name, bytes) {
    const before = this.#figure;
    const viewBefore = this.#panel.view;
    try {
      this.#panel.say(`Reading ${name} …`);
      this.#figure = readMesh(name, await bytes);
      this.#panel.view = given.get('view') in views ? viewBefore : 'figure';
      this.#show();
      this.#panel.say('');
    } catch (error) {
      this.#figure = before;
      this.#panel.view = viewBefore;
      this.#panel.say(error.message.includes(name) ? error.message : `${name}: ${error.message}`, true);
    }
  }

  #show() {
    const view = views[this.#panel.view];
    const isTurned = this.#up === 'y' && this.#figure.name !== 'the hare';
    const mesh = joined(view.meshes(this.#level, isTurned ? turnedUp(this.#figure) : this.#figure));
    // Doubles, as JavaScript has, so that all contestants are asked about the same rays.
    const collider = this.#surehit.collider(Float64Array.from(mesh.positions), mesh.index);
    this.#collider?.free();
    this.#collider = collider;
    this.#mesh = mesh;
    this.#light = new Light(mesh, view.path);
    this.#contest = new Contest(this.#surehit, collider, mesh);
    this.#stage.show(mesh, view.camera);
    this.#panel.showMesh(mesh);
    this.#compareAnew();
  }

  #compareAnew() {
    this.#contest.forget();
    this.#nextComparison = 0;
  }

  #frame(now) {
    requestAnimationFrame((next) => this.#frame(next));
    if (this.#isMoving) this.#seconds += Math.min(0.1, (now - (this.#lastFrame ?? now)) / 1000);
    this.#lastFrame = now;
    this.#castRays();
    this.#pick();
    this.#stage.draw();
    document.body.dataset.frames = Number(document.body.dataset.frames ?? 0) + 1;
  }

  #castRays() {
    const count = this.#panel.rays;
    this.#light.move(this.#seconds);
    this.#light.cast(this.#rays.array, count, this.#panel.aim);
    const start = performance.now();
    const hits = this.#collider.firstHits({ rays: this.#rays.array.subarray(0, 6 * count) }, asThreeAsks);
    const milliseconds = performance.now() - start;
    const { batch } = this.#contest;
    batch.milliseconds = batch.milliseconds === null ? milliseconds : 0.9 * batch.milliseconds + 0.1 * milliseconds;
    const rays = this.#rays.array;
    this.#stage.light(this.#light.place, rays, hits);
    if (performance.now() < this.#nextComparison) return;
    const before = performance.now();
    this.#contest.compare(rays, count, hits);
    const after = performance.now();
    this.#nextComparison = after + Math.max(minPause, pauseFactor * (after - before));
    this.#panel.showContest(this.#contest.contestants);
  }

  #pick() {
    if (this.#pointer === null) return;
    const ray = this.#stage.rayThrough(...this.#pointer);
    const hit = this.#collider.firstHit({ ray });
    const point = hit === null ? null : this.#collider.point({ ray }, hit);
    this.picked = { ray, hit };
    this.#stage.pick(hit === null ? null : hit.triangle, point);
    this.#panel.showPick(hit, hit === null ? null : partOf(this.#mesh, hit.triangle), point);
  }

  /** For the console, and for the test. */
  get mesh() { return this.#mesh; }
  get contestants() { return this.#contest.contestants; }
}

async function bytesAt(address) {
  const response = await fetch(address);
  if (!response.ok) throw new Error(`${response.url} answers ${response.status}`);
  return response.arrayBuffer();
}

try {
  globalThis.page = await Page.start();
} catch (error) {
  const message = document.getElementById('message');
  message.textContent = error.message;
  message.classList.add('error');
  message.hidden = false;
  throw error;
}
