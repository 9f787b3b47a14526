// three.js and surehit on the same rays, judged by exact integers. Prints how often each is wrong.

import assert from 'node:assert/strict';
import test from 'node:test';
import {
  BackSide, DoubleSide, FrontSide, Mesh, MeshBasicMaterial, PlaneGeometry, Ray, Raycaster, SphereGeometry, Vector3,
} from 'three';
import { load } from 'surehit';
import { MeshCollider } from 'surehit/three';
import { families, Random } from './families.mjs';
import { contact, coordinate, nearest } from './oracle.mjs';

const pairCount = 200_000;
const surehit = await load();
const triple = (numbers, at) => new Vector3(numbers[at], numbers[at + 1], numbers[at + 2]);
const percent = Math.min(100, Number(process.env.SUREHIT_TEST_PERCENT ?? 100));

/** What a hit should be: t, u and v rounded once. */
const rounded = ({ t, u, v, det }) => ({ t: nearest(t, det), u: nearest(u, det), v: nearest(v, det) });

/** Counts false hits and false misses, and checks that ours are none. */
class Tally {
  pairs = 0;
  hits = 0;
  ours = [0, 0];
  theirs = [0, 0];

  add(expected, ours, theirs) {
    ++this.pairs;
    if (expected) ++this.hits;
    if (ours !== expected) ++this.ours[ours ? 0 : 1];
    if (theirs !== expected) ++this.theirs[theirs ? 0 : 1];
  }

  get row() {
    return {
      pairs: this.pairs,
      hits: this.hits,
      'three.js false hits': this.theirs[0],
      'three.js false misses': this.theirs[1],
      'surehit false hits': this.ours[0],
      'surehit false misses': this.ours[1],
    };
  }
}

test('Ray.intersectTriangle and intersect agree with exact integers as often as they are right', () => {
  const names = Object.keys(families);
  const tallies = Object.fromEntries(names.map((name) => [name, new Tally()]));
  let theirErrors = 0;
  const target = new Vector3();
  for (const name of names) {
    const random = new Random(20261126 + names.indexOf(name));
    const count = Math.ceil((pairCount * percent) / 100 / names.length);
    for (let i = 0; i < count; ++i) {
      const { ray, corners } = families[name](random);
      const isCulled = i % 2 === 1;
      const culling = isCulled ? 'back' : 'none';
      const exact = contact(ray, corners, culling);
      const hit = surehit.intersect({ ray }, corners, { culling, ignoreEdgeOn: true });
      const theirs = new Ray(triple(ray, 0), triple(ray, 3)).intersectTriangle(
        triple(corners, 0), triple(corners, 3), triple(corners, 6), isCulled, target);
      tallies[name].add(exact !== null, hit !== null, theirs !== null);
      if (exact === null || hit === null) continue;
      const { t, u, v } = hit;
      assert.deepEqual({ t, u, v }, rounded(exact), `${name} ${i}`);
      assert.equal(hit.side, exact.isFront ? 'front' : 'back');
      const point = [0, 1, 2].map((axis) => coordinate(ray, t, axis));
      assert.deepEqual(surehit.point({ ray }, hit).map((x) => x + 0), point.map((x) => x + 0), `${name} ${i}`);
      if (theirs !== null && theirs.toArray().some((x, axis) => x !== point[axis])) ++theirErrors;
    }
  }
  console.log('Ray.intersectTriangle and intersect');
  console.table(Object.fromEntries(names.map((name) => [name, tallies[name].row])));
  console.log(`of the hits of both, three.js has another point in ${theirErrors}`);
  for (const name of names) {
    assert.ok(tallies[name].pairs > 0);
    assert.deepEqual(tallies[name].ours, [0, 0], name);
  }
  assert.ok(names.reduce((sum, name) => sum + tallies[name].hits, 0) > (pairCount * percent) / 100 / 4);
});

/** A ray of a family, as three.js has it: of length 1, almost. */
function rayAt(positions, index, random, family) {
  const corner = (i) => new Vector3().fromBufferAttribute(positions, i);
  const origin = new Vector3(...random.point(3));
  const triangle = 3 * random.below(index.count / 3);
  const [a, b, c] = [0, 1, 2].map((i) => corner(index.getX(triangle + i)));
  const target =
    family === 'aimed at vertices' ? a
    : family === 'aimed at edges' ? a.lerp(b, random.below(4) / 4)
    : family === 'aimed at triangles' ? a.multiplyScalar(0.5).addScaledVector(b, 0.25).addScaledVector(c, 0.25)
    : new Vector3(...random.point());
  if (random.below(3) === 0) origin.z = target.z;
  return new Ray(origin, target.clone().sub(origin).normalize());
}

test('Raycaster and MeshCollider agree with exact integers as often as they are right', () => {
  const geometry = new SphereGeometry(1, 24, 16);
  const { index, attributes: { position, uv } } = geometry;
  const mesh = new Mesh(geometry, new MeshBasicMaterial());
  const collider = new MeshCollider(surehit, mesh);
  const triangles = index.count / 3;
  const corners = Array.from({ length: triangles }, (_, i) =>
    [0, 1, 2].flatMap((j) => new Vector3().fromBufferAttribute(position, index.getX(3 * i + j)).toArray()));
  const names = ['general', 'aimed at triangles', 'aimed at edges', 'aimed at vertices'];
  const sides = [FrontSide, BackSide, DoubleSide];
  const tallies = Object.fromEntries(names.map((name) => [name, new Tally()]));
  let wrongFirst = 0;
  const rays = Math.ceil((pairCount * percent) / 100 / triangles / names.length);
  for (const name of names) {
    const random = new Random(7 + names.indexOf(name));
    for (let i = 0; i < rays; ++i) {
      const { origin, direction } = rayAt(position, index, random, name);
      const raycaster = new Raycaster(origin, direction);
      if (i % 5 === 4) [raycaster.near, raycaster.far] = [1 + random.unit(), 2 + 2 * random.unit()];
      mesh.material.side = sides[i % 3];
      const culling = ['back', 'front', 'none'][i % 3];
      const ray = [...origin.toArray(), ...direction.toArray()];
      const expected = [];
      for (let id = 0; id < triangles; ++id) {
        const exact = contact(ray, corners[id], culling);
        if (exact === null) continue;
        const t = nearest(exact.t, exact.det);
        if (t >= raycaster.near && t <= raycaster.far) expected.push({ id, exact });
      }
      expected.sort((p, q) => {
        const difference = p.exact.t * q.exact.det - q.exact.t * p.exact.det;
        return difference < 0n ? -1 : difference > 0n ? 1 : p.id - q.id;
      });
      const theirs = raycaster.intersectObject(mesh);
      const ours = [];
      collider.raycast(raycaster, ours);
      const idsOf = (hits) => new Set(hits.map((hit) => hit.faceIndex));
      const [exactIds, ourIds, theirIds] = [new Set(expected.map(({ id }) => id)), idsOf(ours), idsOf(theirs)];
      for (let id = 0; id < triangles; ++id) tallies[name].add(exactIds.has(id), ourIds.has(id), theirIds.has(id));
      if (theirs.length > 0 && expected.length > 0 && theirs[0].faceIndex !== expected[0].id) ++wrongFirst;
      assert.deepEqual(ours.map((hit) => hit.faceIndex), expected.map(({ id }) => id), `${name} ${i}`);
      for (const [at, hit] of ours.entries()) {
        const { t, u, v } = rounded(expected[at].exact);
        assert.deepEqual(hit.barycoord.toArray(), [1 - u - v, u, v]);
        assert.deepEqual(hit.point.toArray(), [0, 1, 2].map((axis) => coordinate(ray, t, axis)));
        const other = theirs.find((one) => one.faceIndex === hit.faceIndex);
        if (other === undefined) continue;
        assert.ok(Math.abs(hit.distance - other.distance) < 1e-9);
        assert.ok(hit.uv.distanceTo(other.uv) < 1e-6);
        assert.ok(hit.face.normal.distanceTo(other.face.normal) < 1e-9);
        assert.deepEqual([hit.face.a, hit.face.b, hit.face.c], [other.face.a, other.face.b, other.face.c]);
        assert.equal(hit.object, mesh);
      }
      const first = [];
      collider.raycast(Object.assign(raycaster, { firstHitOnly: true }), first);
      assert.deepEqual(first, ours.slice(0, 1));
    }
  }
  console.log(`Raycaster and MeshCollider, on a sphere of ${triangles} triangles with uv (${uv.count} of them)`);
  console.table(Object.fromEntries(names.map((name) => [name, tallies[name].row])));
  console.log(`three.js has another first triangle for ${wrongFirst} of ${rays * names.length} rays`);
  for (const name of names) {
    assert.ok(tallies[name].hits > 0);
    assert.deepEqual(tallies[name].ours, [0, 0], name);
  }
  collider.free();
});

test('near and far are limits of t, and a ray in a plane meets nothing', () => {
  const mesh = new Mesh(new PlaneGeometry(2, 2), new MeshBasicMaterial({ side: DoubleSide }));
  const collider = new MeshCollider(surehit, mesh);
  const facesOf = (raycaster) => {
    const intersects = [];
    collider.raycast(raycaster, intersects);
    return intersects.map((hit) => hit.faceIndex);
  };
  const down = (near, far) => new Raycaster(new Vector3(-0.5, 0.25, 2), new Vector3(0, 0, -1), near, far);
  for (const [near, far, faces] of [[0, 2, [0]], [2, 2, [0]], [2.25, 9, []], [0, 1.75, []]]) {
    assert.deepEqual(facesOf(down(near, far)), faces);
    assert.deepEqual(down(near, far).intersectObject(mesh).map((hit) => hit.faceIndex), faces);
  }
  assert.deepEqual(facesOf(new Raycaster(new Vector3(-3, 0.25, 0), new Vector3(1, 0, 0))), []);
  collider.free();
});

test('A placed mesh and a draw range are those of three.js', () => {
  const geometry = new SphereGeometry(1, 12, 8);
  geometry.setDrawRange(0, geometry.index.count / 2);
  const mesh = new Mesh(geometry, new MeshBasicMaterial({ side: DoubleSide }));
  mesh.position.set(3, -2, 5);
  mesh.rotation.set(0.3, 0.7, -0.4);
  mesh.scale.set(2, 3, 1.5);
  mesh.updateMatrixWorld();
  const collider = new MeshCollider(surehit, mesh);
  const random = new Random(3);
  let hits = 0;
  for (let i = 0; i < 300; ++i) {
    const origin = new Vector3(...random.point(12));
    const aim = new Vector3(...random.point(2)).add(mesh.position);
    const raycaster = new Raycaster(origin, aim.sub(origin).normalize());
    const theirs = raycaster.intersectObject(mesh);
    const ours = [];
    collider.raycast(raycaster, ours);
    assert.deepEqual(ours.map((hit) => hit.faceIndex), theirs.map((hit) => hit.faceIndex));
    for (const [at, hit] of ours.entries()) {
      assert.ok(Math.abs(hit.distance - theirs[at].distance) < 1e-9);
      assert.ok(hit.point.distanceTo(theirs[at].point) < 1e-9);
    }
    hits += ours.length;
  }
  assert.ok(hits > 100);
  collider.free();
});
