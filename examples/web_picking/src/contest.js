// The same rays for surehit, three-mesh-bvh and three.js: how long each takes, and how often it is wrong.

import { BufferAttribute, BufferGeometry, DoubleSide, Mesh, MeshBasicMaterial, Raycaster } from 'three';
import { MeshBVH } from 'three-mesh-bvh';
import { noTriangle } from 'surehit';
import { cornersOf } from './world.js';

/** A ray in a triangle's plane does not meet it in three.js, so surehit is asked in the same way. */
export const asThreeAsks = { minT: 0, ignoreEdgeOn: true };

/** How long three.js may take for its share of the rays in one comparison, as it tries all triangles for each ray. */
const sampleMilliseconds = 30;

function geometryOf({ positions, index }) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(index.slice(), 1));
  return geometry;
}

/** MeshBVH sorts the triangles of its geometry. Returns their former ids. */
function formerIds(before, after) {
  const key = (index, i) => `${index[i]},${index[i + 1]},${index[i + 2]}`;
  const ids = new Map();
  for (let i = 0; i < before.length; i += 3) ids.set(key(before, i), i / 3);
  return Uint32Array.from({ length: after.length / 3 }, (_, i) => ids.get(key(after, 3 * i)));
}

/** One who answers rays, with the sums of all comparisons. */
class Contestant {
  constructor(name, ask) {
    this.name = name;
    this.ask = ask;
    this.isSample = false;
    this.forget();
  }

  forget() {
    this.milliseconds = null;  // for all rays of a frame, as in the last comparison
    this.asked = 0;
    this.wrong = 0;
    this.farOff = 0;
    this.lastWrong = null;  // a ray, the triangle that it meets first, and the one that was found
  }
}

export class Contest {
  #mesh;
  #surehit;
  #single;
  #bvh;
  #plain;

  constructor(surehit, collider, mesh) {
    this.#mesh = mesh;
    this.#surehit = surehit;
    const sorted = geometryOf(mesh);
    const bvh = new MeshBVH(sorted);
    const ids = formerIds(mesh.index, sorted.index.array);
    const plain = new Mesh(geometryOf(mesh), new MeshBasicMaterial({ side: DoubleSide }));
    const raycaster = new Raycaster();
    const { ray } = raycaster;
    const set = (rays, at) => {
      ray.origin.set(rays[at], rays[at + 1], rays[at + 2]);
      ray.direction.set(rays[at + 3], rays[at + 4], rays[at + 5]);
    };
    this.batch = new Contestant('surehit, all at once', null);
    this.#single = new Contestant('surehit, one by one', (rays, at) =>
      collider.firstHit({ ray: rays.subarray(at, at + 6) }, asThreeAsks)?.triangle ?? noTriangle);
    this.#bvh = new Contestant('three-mesh-bvh', (rays, at) => {
      set(rays, at);
      const hit = bvh.raycastFirst(ray, DoubleSide);
      return hit === null ? noTriangle : ids[hit.faceIndex];
    });
    this.#plain = new Contestant('three.js', (rays, at) => {
      set(rays, at);
      return raycaster.intersectObject(plain)[0]?.faceIndex ?? noTriangle;
    });
  }

  get contestants() {
    return [this.batch, this.#single, this.#bvh, this.#plain];
  }

  forget() {
    for (const contestant of this.contestants) contestant.forget();
  }

  /** Compares the others with the answers that surehit gave to a batch of `count` rays. */
  compare(rays, count, exact) {
    const answers = { t: exact.t.slice(), triangle: exact.triangle.slice() };
    this.batch.asked += count;
    for (const contestant of [this.#single, this.#bvh]) {
      this.#time(contestant, rays, answers, Array.from({ length: count }, (_, i) => i));
    }
    this.#timeSample(this.#plain, rays, answers, count);
  }

  #time(contestant, rays, answers, which) {
    const found = new Uint32Array(which.length);
    const start = performance.now();
    for (let i = 0; i < which.length; ++i) found[i] = contestant.ask(rays, 6 * which[i]);
    contestant.milliseconds = performance.now() - start;
    this.#judge(contestant, rays, answers, which, found);
  }

  /** Rays that lie evenly among all, until the time is over. */
  #timeSample(contestant, rays, answers, count) {
    const step = 7919;  // a prime, so that no ray comes twice
    const [which, found] = [[], []];
    const start = performance.now();
    let now = start;
    for (let i = 0; which.length < count && now - start < sampleMilliseconds; i = (i + step) % count) {
      which.push(i);
      found.push(contestant.ask(rays, 6 * i));
      now = performance.now();
    }
    contestant.isSample = which.length < count;
    contestant.milliseconds = ((now - start) * count) / which.length;
    this.#judge(contestant, rays, answers, which, found);
  }

  #judge(contestant, rays, answers, which, found) {
    contestant.asked += which.length;
    for (let i = 0; i < which.length; ++i) {
      const at = which[i];
      const expected = answers.triangle[at];
      if (found[i] === expected) continue;
      const ray = rays.subarray(6 * at, 6 * at + 6);
      // If a ray meets several triangles at the same t, any of them will do.
      if (found[i] !== noTriangle) {
        const hit = this.#surehit.intersect({ ray }, this.#cornersOf(found[i]), asThreeAsks);
        if (hit !== null && hit.t === answers.t[at]) continue;
      }
      ++contestant.wrong;
      if (this.#isFarOff(ray, answers.t[at], expected, found[i])) ++contestant.farOff;
      contestant.lastWrong = { ray: [...ray], triangle: expected, found: found[i] };
    }
  }

  #cornersOf(triangle) {
    return cornersOf(this.#mesh, triangle);
  }

  /** Whether a ray has gone through a surface, or has met one that is not there. Neighbours are not far off. */
  #isFarOff(ray, t, expected, found) {
    if (expected === noTriangle || found === noTriangle) return true;
    const [ax, ay, az, bx, by, bz, cx, cy, cz] = this.#cornersOf(found);
    const normal = [
      (by - ay) * (cz - az) - (bz - az) * (cy - ay),
      (bz - az) * (cx - ax) - (bx - ax) * (cz - az),
      (bx - ax) * (cy - ay) - (by - ay) * (cx - ax),
    ];
    const [height, slope] = [0, 3].map((at) => normal[0] * ray[at] + normal[1] * ray[at + 1] + normal[2] * ray[at + 2]);
    const theirs = (normal[0] * ax + normal[1] * ay + normal[2] * az - height) / slope;
    return !(Math.abs(theirs - t) <= 1e-6 * t);
  }
}
