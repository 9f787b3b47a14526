// The interface in JavaScript: what goes in and out, what is refused, and memory that grows or is freed.

import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import test from 'node:test';
import { InvalidMesh, load, noTriangle, Side } from 'surehit';
import { Random } from './families.mjs';

const floor = [0, 0, 0, 10, 0, 0, 10, 10, 0, 0, 10, 0];
const halves = [0, 1, 2, 0, 2, 3];
const down = { segment: [5, 5, 1, 5, 5, -1] };
const surehit = await load();
const both = [['float', Float32Array], ['double', Float64Array]];
const built = (Numbers, options) => surehit.collider(new Numbers(floor), new Uint32Array(halves), options);

for (const [scalar, Numbers] of both) {
  test(`${scalar}: single queries`, () => {
    const collider = built(Numbers);
    assert.equal(collider.scalar, scalar);
    assert.equal(collider.triangleCount, 2);
    assert.ok(collider.memoryBytes > 0);
    assert.deepEqual(collider.firstHit(down), { t: 0.5, u: 0, v: 0.5, triangle: 0, side: 'front' });
    assert.equal(collider.firstHit({ segment: [5, 5, 2, 5, 5, 1] }), null);
    assert.equal(collider.firstHit({ ray: [5, 5, 2, 0, 0, -1] }).t, 2);
    assert.equal(collider.firstHit({ line: [5, 5, 2, 0, 0, 1] }).t, -2);
    assert.equal(collider.anyHit(down), true);
    assert.equal(collider.anyHit({ ray: [5, 5, 2, 0, 0, 1] }), false);
    const all = collider.allHits(down);
    assert.deepEqual([...all.triangle], [0, 1]);
    assert.deepEqual([...all.t], [0.5, 0.5]);
    assert.deepEqual([...all.side], [Side.front, Side.front]);
    assert.deepEqual(collider.point(down, { t: 0.25 }), [5, 5, 0.5]);
    assert.equal(collider.distance(down, { t: 0.25 }), 0.5);
    assert.deepEqual(collider.normal(1), [0, 0, 1]);
    collider.free();
  });

  test(`${scalar}: options`, () => {
    const collider = built(Numbers, { masks: new Uint32Array([1, 2]) });
    const triangleUnder = (options) => collider.firstHit(down, options)?.triangle ?? null;
    assert.equal(triangleUnder({ mask: 2 }), 1);
    assert.equal(triangleUnder({ mask: 4 }), null);
    assert.equal(triangleUnder({ ignoredTriangle: 0 }), 1);
    assert.equal(triangleUnder({ culling: 'back' }), 0);
    assert.equal(triangleUnder({ culling: 'front' }), null);
    assert.equal(triangleUnder({ minT: 0.5, maxT: 0.5 }), 0);
    assert.equal(triangleUnder({ minT: 0.75 }), null);
    assert.equal(triangleUnder({ maxT: 0.25 }), null);
    const within = { segment: [1, 2, 0, 9, 3, 0] };
    assert.equal(collider.firstHit(within).side, 'edge_on');
    for (const options of [{ ignoreEdgeOn: true }, { ignoreStartContact: true, mask: 2 }]) {
      assert.equal(collider.anyHit(within, options), false);
      assert.equal(collider.firstHit(within, options), null);
      assert.equal(collider.allHits(within, options).length, 0);
      const segments = new Numbers(within.segment);
      assert.deepEqual([...collider.anyHits({ segments }, options)], [0]);
      assert.equal(collider.firstHits({ segments }, options).at(0), null);
    }
    assert.equal(collider.anyHit({ segment: [5, 5, 1, 5, 5, 0] }, { ignoreEndContact: true }), false);
    collider.setMasks(new Uint32Array([0, 0]));
    assert.equal(triangleUnder({}), null);
    collider.move(new Numbers(floor.map((x, i) => (i % 3 === 2 ? -0.5 : x))));
    collider.setMasks(new Uint32Array());
    assert.equal(collider.firstHit(down).t, 0.75);
    collider.free();
  });

  test(`${scalar}: what is behind an ignored edge-on hit is found`, () => {
    const wall = [6, 0, -1, 6, 0, 1, 6, 9, 0];
    const collider = surehit.collider(new Numbers([...floor, ...wall]), new Uint32Array([...halves, 4, 5, 6]));
    const ray = [-1, 2, 0, 1, 0, 0];
    assert.equal(collider.firstHit({ ray }).side, 'edge_on');
    const [hit, many] = [{ ray }, { rays: new Numbers([...ray, ...ray]) }].map((path) =>
      (path.ray ? collider.firstHit(path, { ignoreEdgeOn: true }) : collider.firstHits(path, { ignoreEdgeOn: true })));
    assert.equal(hit.t, 7);
    assert.equal(hit.triangle, 2);
    assert.deepEqual([many.at(0), many.at(1)], [hit, hit]);
    collider.free();
  });

  test(`${scalar}: batches are single queries, at any size`, () => {
    const random = new Random(5);
    const numbers = new Numbers(900).map(() => random.symmetric());
    const collider = surehit.collider(numbers, new Uint16Array(300).map((_, i) => i));
    for (const count of [0, 1, 11, 100, 5000]) {
      const own = surehit.numbers(scalar, 6 * count);
      for (let i = 0; i < own.length; ++i) own.array[i] = 2 * random.symmetric();
      for (const kind of ['segment', 'ray', 'line']) {
        const hits = collider.firstHits({ [`${kind}s`]: own.array });
        const blocked = [...collider.anyHits({ [`${kind}s`]: own.array.slice() })];
        assert.equal(hits.length, count);
        assert.equal(blocked.length, count);
        for (let i = 0; i < count; ++i) {
          const single = collider.firstHit({ [kind]: own.array.subarray(6 * i, 6 * i + 6) });
          assert.deepEqual(hits.at(i), single);
          assert.equal(blocked[i] === 1, single !== null);
        }
        if (count === 5000) assert.ok(hits.triangle.includes(noTriangle) && blocked.includes(1));
      }
      own.free();
    }
    collider.free();
  });
}

test('hits and numbers outlive the growth of memory', async () => {
  const fresh = await load();
  const collider = fresh.collider(new Float64Array(floor), new Uint32Array(halves));
  const numbers = fresh.numbers('double', 6);
  numbers.array.set(down.segment);
  const hits = collider.firstHits({ segments: numbers.array });
  const before = hits.t;
  assert.equal(before.length, 1);
  const bytes = fresh.memoryBytes;
  const others = fresh.numbers('double', 1e6);
  assert.ok(fresh.memoryBytes > bytes);
  assert.equal(before.length, 0);
  assert.deepEqual([...hits.t], [0.5]);
  assert.deepEqual([...numbers.array], down.segment);
  others.free();
  const many = new Float64Array(6e5).map((_, i) => down.segment[i % 6]);
  assert.ok(collider.firstHits({ segments: many }).t.every((t) => t === 0.5));
  assert.ok(collider.anyHits({ segments: many }).every((blocked) => blocked === 1));
});

test('what is freed is used again, and a freed object is refused', async () => {
  const fresh = await load();
  const build = () => {
    const random = new Random(6);
    const vertices = new Float32Array(90000).map(() => random.unit());
    const collider = fresh.collider(vertices, new Uint32Array(30000).map((_, i) => i));
    const rays = new Float32Array(600000).fill(9);
    const hits = collider.firstHits({ rays });
    collider.anyHits({ rays });
    collider.free();
    collider.free();
    return [collider, hits];
  };
  build();
  const bytes = fresh.memoryBytes;
  for (let i = 0; i < 10; ++i) build();
  assert.equal(fresh.memoryBytes, bytes);
  const [collider, hits] = build();
  const freed = /this collider was freed/;
  const calls = {
    firstHit: [down], anyHit: [down], allHits: [down], firstHits: [{ segments: new Float32Array() }],
    anyHits: [{ segments: new Float32Array() }], point: [down, { t: 0 }], distance: [down, { t: 0 }], normal: [0],
    move: [new Float32Array()], setMasks: [new Uint32Array()],
  };
  for (const [name, given] of Object.entries(calls)) assert.throws(() => collider[name](...given), freed, name);
  assert.throws(() => collider.triangleCount, freed);
  assert.throws(() => collider.memoryBytes, freed);
  assert.throws(() => hits.t, /the collider of these hits was freed/);
  const numbers = surehit.numbers('float', 3);
  numbers.free();
  numbers.free();
  assert.throws(() => numbers.array, /these numbers were freed/);
});

test('an invalid mesh names its element', () => {
  const refused = (vertices, triangles, masks, reason, element, message) => {
    const bytes = surehit.memoryBytes;
    assert.throws(() => surehit.collider(new Float64Array(vertices), new Int32Array(triangles), { masks }), (error) => {
      assert.ok(error instanceof InvalidMesh);
      assert.equal(error.reason, reason);
      assert.equal(error.element, element);
      assert.match(error.message, message);
      return true;
    });
    assert.equal(surehit.memoryBytes, bytes);
  };
  refused(floor, [0, 1, 2, 0, 2, 4], null, 'index_out_of_range', 1, /triangle 1/);
  refused(floor, [0, 1, -2], null, 'index_out_of_range', 0, /triangle 0/);
  refused(floor.map((x, i) => (i === 7 ? NaN : x)), halves, null, 'non_finite_vertex', 2, /vertex 2/);
  refused(floor.slice(1), halves, null, 'incomplete_vertex', 3, /vertex 3/);
  refused(floor, halves.slice(1), null, 'incomplete_triangle', 1, /triangle 1/);
  refused(floor, halves, new Uint32Array(3), 'masks_do_not_match', 3, /3/);
  const collider = built(Float64Array);
  const isRefused = (reason, element) => (error) => error.reason === reason && error.element === element;
  assert.throws(() => collider.move(new Float64Array(3)), isRefused('vertices_do_not_match', 1));
  assert.throws(() => collider.setMasks(new Uint32Array(1)), isRefused('masks_do_not_match', 1));
  assert.equal(collider.firstHit(down).t, 0.5);
  collider.free();
});

test('arguments of other kinds are refused', () => {
  const collider = built(Float64Array);
  const refused = (call, message) => assert.throws(call, { name: 'TypeError', message });
  refused(() => surehit.collider(floor, new Uint32Array(halves)), /Float32Array or a Float64Array/);
  refused(() => surehit.collider(new Float64Array(floor), halves), /Uint32Array, an Int32Array or a Uint16Array/);
  refused(() => built(Float64Array, { masks: [1, 2] }), /masks are a Uint32Array/);
  refused(() => built(Float64Array, { mask: 1 }), /no option mask/);
  refused(() => collider.firstHit({ segment: [0, 0, 0] }), /a segment has 6 numbers, but 3/);
  refused(() => collider.firstHit({ ray: [0, 0, 0, 0, '1', 0] }), /element 4 of a ray/);
  refused(() => collider.firstHit({}), /segment, ray, line/);
  refused(() => collider.firstHit({ ray: [], line: [] }), /ray, line/);
  refused(() => collider.firstHit(down, { maxt: 1 }), /no option maxt/);
  refused(() => collider.firstHit(down, { culling: 'both' }), /both/);
  for (const mask of ['x', 0.5, 2 ** 32, -(2 ** 31) - 1]) {
    refused(() => collider.firstHit(down, { mask }), /mask is a whole number of 32 bits/);
  }
  assert.notEqual(collider.firstHit(down, { mask: ~0 }), null);
  refused(() => collider.firstHit(down, { ignoredTriangle: -1 }), /ignoredTriangle is a whole number of 32 bits/);
  refused(() => collider.firstHit(down, { ignoredTriangle: 2 ** 32 }), /ignoredTriangle is a whole number of 32 bits/);
  refused(() => collider.firstHit(down, { minT: '0' }), /minT is a number/);
  refused(() => collider.firstHit(down, { maxT: [1] }), /maxT is a number/);
  refused(() => collider.firstHits({ rays: new Float32Array(6) }), /rays of this collider are a Float64Array/);
  refused(() => collider.firstHits({ rays: new Float64Array(8) }), /path 1 has 2/);
  refused(() => collider.anyHits({ ray: new Float64Array(6) }), /segments, rays, lines/);
  refused(() => surehit.numbers('half', 6), /half/);
  assert.throws(() => collider.normal(2), /triangle 2 of 2/);
  assert.throws(() => collider.firstHits({ rays: new Float64Array(6) }).at(1), /hit 1 of 1/);
  assert.equal(collider.firstHit({ ray: [NaN, 0, 0, 0, 0, 1] }), null);
  collider.free();
});

test('a mesh may lie in memory that grows while it is built', async () => {
  const small = await load();
  const numbers = small.numbers('double', floor.length);
  numbers.array.set(floor);
  const many = new Uint32Array(3 * 2_000_000);  // more than there is room for
  many.set(halves);
  const before = small.memoryBytes;
  const collider = small.collider(numbers.array, many);
  assert(small.memoryBytes > before);
  assert.equal(collider.triangleCount, 2_000_000);
  assert.equal(collider.firstHit(down)?.triangle, built(Float64Array).firstHit(down)?.triangle);
});

test('a lack of memory is an error, after which all is refused', async () => {
  const small = await load();
  const collider = small.collider(new Float64Array(floor), new Uint32Array(halves));
  const gigabyte = 2 ** 27;
  assert.throws(() => {
    for (let i = 0; i < 8; ++i) small.numbers('double', gigabyte);
  }, /no memory for 1073741824 bytes/);
  assert.equal(collider.firstHit(down).t, 0.5);
  for (let count = gigabyte / 2; count >= 1; count /= 2) {
    try {
      for (let i = 0; i < 8; ++i) small.numbers('double', count);
    } catch (error) {
      assert.match(error.message, /no memory/);
    }
  }
  assert.equal(collider.firstHit(down).t, 0.5);
  assert.throws(() => {
    for (let i = 0; i < 10; ++i) collider.move(new Float64Array(floor));
  }, /no memory|most likely for want of memory/);
  assert.throws(() => small.collider(new Float64Array(floor), new Uint32Array(halves)), /no memory|failed/);
});

test('the example of the README gives what it says', async () => {
  const readme = await readFile(new URL('../README.md', import.meta.url), 'utf8');
  const [, example] = readme.match(/```js\n(.*?)```/s);
  const file = new URL('readme_example.mjs', import.meta.url);
  await writeFile(file, `${example}\nexport { hit, isBlocked };\nexport const { length } = hits;\n`);
  const { hit, isBlocked, length } = await import(file);
  assert.deepEqual(hit, { t: 0.5, u: 0, v: 0.5, triangle: 0, side: 'front' });
  assert.equal(isBlocked, true);
  assert.equal(length, 100);
});
