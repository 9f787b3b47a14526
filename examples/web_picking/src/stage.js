// What three.js draws: the mesh, what the light has seen of it, some of the rays, and the picked triangle.

import {
  AdditiveBlending, BufferAttribute, BufferGeometry, Color, DoubleSide, DynamicDrawUsage, LineBasicMaterial, LineLoop,
  LineSegments, Mesh, MeshBasicMaterial, PerspectiveCamera, Raycaster, Scene, SphereGeometry, SRGBColorSpace, Vector2,
  Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { noTriangle } from 'surehit';
import { cornersOf } from './world.js';

const background = new Color(0x0b1017);
const dark = [0.085, 0.115, 0.165];
const lit = [1.0, 0.74, 0.42];
/** What is left of a triangle's light in the next frame that does not see it. */
const fading = 0.96;
/** The tangent of half of the angle of view, from top to bottom. */
const minSlope = 0.49;
const maxDrawnRays = 160;

const byte = (x) => Math.round(255 * Math.min(1, x));

export class Stage {
  #renderer;
  #scene = new Scene();
  #camera = new PerspectiveCamera();
  #controls;
  #shown = null;
  #lamp = new Mesh(new SphereGeometry(1, 24, 16), new MeshBasicMaterial({ color: 0xffe2b0 }));
  #rays = new LineSegments(new BufferGeometry(), new LineBasicMaterial({
    color: 0xffc06a, transparent: true, opacity: 0.16, blending: AdditiveBlending, depthWrite: false,
  }));
  #outline = new LineLoop(new BufferGeometry(), new LineBasicMaterial({ color: 0x4ff0d0, depthTest: false }));
  #picked = new Mesh(new BufferGeometry(), new MeshBasicMaterial({
    color: 0x4ff0d0, side: DoubleSide, transparent: true, opacity: 0.45, depthTest: false, depthWrite: false,
  }));
  #mark = new Mesh(new SphereGeometry(1, 16, 12), new MeshBasicMaterial({ color: 0xffffff, depthTest: false }));

  constructor(canvas) {
    this.#renderer = new WebGLRenderer({ canvas, antialias: true });
    this.#renderer.outputColorSpace = SRGBColorSpace;
    this.#scene.background = background;
    this.#camera.up.set(0, 0, 1);
    this.#controls = new OrbitControls(this.#camera, canvas);
    this.#controls.enableDamping = true;
    this.#rays.geometry.setAttribute('position',
      new BufferAttribute(new Float32Array(6 * maxDrawnRays), 3).setUsage(DynamicDrawUsage));
    for (const object of [this.#picked, this.#outline, this.#mark]) {
      object.visible = false;
      object.renderOrder = 1;
      object.frustumCulled = false;
    }
    this.#rays.frustumCulled = false;
    this.#scene.add(this.#lamp, this.#rays, this.#picked, this.#outline, this.#mark);
  }

  /** Shows another mesh from a place. `size` is how large what is looked at is. */
  show(mesh, { eye, target, size }) {
    if (this.#shown !== null) {
      this.#scene.remove(this.#shown.object);
      this.#shown.object.geometry.dispose();
      this.#shown.object.material.dispose();
    }
    const triangles = mesh.index.length / 3;
    const positions = new Float32Array(9 * triangles);
    for (let i = 0; i < mesh.index.length; ++i) {
      positions.set(mesh.positions.subarray(3 * mesh.index[i], 3 * mesh.index[i] + 3), 3 * i);
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(positions, 3));
    geometry.setAttribute('color',
      new BufferAttribute(new Uint8Array(9 * triangles), 3, true).setUsage(DynamicDrawUsage));
    const object = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true, side: DoubleSide }));
    this.#shown = { mesh, object, size, glow: new Float32Array(triangles), ...shapesOf(positions) };
    this.#scene.add(object);
    this.#lamp.scale.setScalar(0.016 * size);
    this.#mark.scale.setScalar(0.006 * size);
    this.#camera.position.set(...eye);
    this.#camera.near = 0.004 * size;
    this.#camera.far = 60 * size;
    this.#controls.target.set(...target);
    this.#controls.update();
    this.pick(null);
    this.resize();
  }

  resize() {
    const { clientWidth, clientHeight } = this.#renderer.domElement;
    this.#renderer.setPixelRatio(Math.min(globalThis.devicePixelRatio, 2));
    this.#renderer.setSize(clientWidth, clientHeight, false);
    this.#camera.aspect = clientWidth / Math.max(1, clientHeight);
    // What fits into a wide picture fits into a narrow one too.
    const slope = minSlope * Math.max(1, 1.15 / this.#camera.aspect);
    this.#camera.fov = (360 / Math.PI) * Math.atan(slope);
    this.#camera.updateProjectionMatrix();
  }

  /** The ray through a place of the canvas, as six numbers. */
  rayThrough(x, y) {
    const { clientWidth, clientHeight } = this.#renderer.domElement;
    this.#camera.updateMatrixWorld();
    const raycaster = new Raycaster();
    raycaster.setFromCamera(new Vector2((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight), this.#camera);
    const { origin, direction } = raycaster.ray;
    return [...origin.toArray(), ...direction.toArray()];
  }

  /** Shows a picked triangle and the point on it, or nothing. */
  pick(triangle, point = null) {
    for (const object of [this.#picked, this.#outline, this.#mark]) object.visible = triangle !== null;
    if (triangle === null) return;
    const corners = new Float32Array(cornersOf(this.#shown.mesh, triangle));
    for (const object of [this.#picked, this.#outline]) {
      object.geometry.setAttribute('position', new BufferAttribute(corners, 3));
    }
    this.#mark.position.set(...point);
  }

  /** Lights the triangles that rays from the light have met, as hits say. What was lit before fades. */
  light(place, rays, hits) {
    const { glow, normals, size } = this.#shown;
    const { triangle, t } = hits;
    for (let i = 0; i < glow.length; ++i) glow[i] *= fading;
    const reach = 0.75 * size;
    for (let i = 0; i < triangle.length; ++i) {
      const id = triangle[i];
      if (id === noTriangle) continue;
      const [at, normal] = [6 * i + 3, 3 * id];
      const slope = Math.abs(
        rays[at] * normals[normal] + rays[at + 1] * normals[normal + 1] + rays[at + 2] * normals[normal + 2]);
      const light = (0.16 + 0.84 * slope) / (1 + (t[i] / reach) ** 2);
      if (light > glow[id]) glow[id] = light;
    }
    this.#lamp.position.set(...place);
    this.#drawRays(rays, hits);
  }

  #drawRays(rays, { triangle, t }) {
    const { position } = this.#rays.geometry.attributes;
    const step = Math.max(1, Math.floor(triangle.length / maxDrawnRays));
    let drawn = 0;
    for (let i = 0; i < triangle.length && drawn < maxDrawnRays; i += step) {
      if (triangle[i] === noTriangle) continue;
      const [at, to] = [6 * i, 6 * drawn++];
      for (let axis = 0; axis < 3; ++axis) {
        position.array[to + axis] = rays[at + axis];
        position.array[to + 3 + axis] = rays[at + axis] + t[i] * rays[at + 3 + axis];
      }
    }
    this.#rays.geometry.setDrawRange(0, 2 * drawn);
    position.needsUpdate = true;
  }

  #colour() {
    const { glow, shades, object } = this.#shown;
    const { color } = object.geometry.attributes;
    for (let id = 0, at = 0; id < glow.length; ++id) {
      const light = glow[id];
      const red = byte(shades[id] * dark[0] + light * lit[0]);
      const green = byte(shades[id] * dark[1] + light * lit[1]);
      const blue = byte(shades[id] * dark[2] + light * lit[2]);
      for (let corner = 0; corner < 3; ++corner) {
        color.array[at++] = red;
        color.array[at++] = green;
        color.array[at++] = blue;
      }
    }
    color.needsUpdate = true;
  }

  draw() {
    this.#controls.update();
    this.#colour();
    this.#renderer.render(this.#scene, this.#camera);
  }
}

/** The unit normal of each triangle, and how bright it is without the light: what looks up is brighter. */
function shapesOf(positions) {
  const triangles = positions.length / 9;
  const normals = new Float32Array(3 * triangles);
  const shades = new Float32Array(triangles);
  const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
  for (let id = 0; id < triangles; ++id) {
    a.fromArray(positions, 9 * id);
    b.fromArray(positions, 9 * id + 3).sub(a);
    c.fromArray(positions, 9 * id + 6).sub(a);
    b.cross(c).normalize().toArray(normals, 3 * id);
    shades[id] = 0.75 + 0.3 * b.z + 0.14 * b.x + 0.1 * b.y;
  }
  return { normals, shades };
}
