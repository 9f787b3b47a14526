// surehit in JavaScript. surehit.d.ts says what each function promises.

import { Functions, Numbers, Room, scalars } from './memory.js';

export { Numbers };

const kinds = ['segment', 'ray', 'line'];
const kindsOfMany = ['segments', 'rays', 'lines'];
const sides = ['edge_on', 'front', 'back'];
const cullings = ['none', 'back', 'front'];
const reasons = [
  'too_many_triangles', 'index_out_of_range', 'non_finite_vertex', 'masks_do_not_match', 'vertices_do_not_match',
  'missing_array', 'incomplete_vertex', 'incomplete_triangle', 'vertex_stride_too_small', 'triangle_stride_too_small',
];
const optionNames = [
  'minT', 'maxT', 'culling', 'mask', 'ignoredTriangle', 'ignoreStartContact', 'ignoreEndContact', 'ignoreEdgeOn',
];

export const noTriangle = 0xffffffff;
export const Side = Object.freeze({ edgeOn: 0, front: 1, back: 2 });

export class InvalidMesh extends Error {
  constructor(reason, element, message) {
    super(message);
    this.name = 'InvalidMesh';
    this.reason = reason;
    this.element = element;
  }
}

// A block of the module's memory for what goes in and out of one query: path, options, triangle and hit.
const pathAt = 0;
const optionsAt = 48;
const hitAt = 80;
const pointAt = 112;
const cornersAt = 136;
const blockBytes = 208;

/** Returns the name and the value of the one path, or of the one array of paths, that an object has. */
function onlyKind(paths, names) {
  const found = Object.keys(paths ?? {});
  const kind = names.indexOf(found[0]);
  if (found.length !== 1 || kind < 0) {
    const given = found.join(', ') || paths;
    throw new TypeError(`surehit: expected an object with one of ${names.join(', ')}, but got ${given}`);
  }
  return [kind, paths[found[0]]];
}

/** Returns an option that is a number. */
function numberIn(options, name, preset) {
  const value = options[name] ?? preset;
  if (typeof value !== 'number') throw new TypeError(`surehit: ${name} is a number, but not ${value}`);
  return value;
}

/** Returns an option of 32 bits. It may be negative where ~0 stands for all bits. */
function wordIn(options, name, preset, least) {
  const value = options[name] ?? preset;
  if (!Number.isInteger(value) || value < least || value > 0xffffffff) {
    throw new TypeError(`surehit: ${name} is a whole number of 32 bits, but not ${value}`);
  }
  return value;
}

/** The hits of a batch, or all hits of a path. Its arrays are made anew after the memory has grown. */
export class Hits {
  #room;
  #scalar;
  #capacity = 0;
  #arrays = null;

  constructor(room, scalar) {
    this.#room = room;
    this.#scalar = scalar;
    this.length = 0;
  }

  /** For surehit alone: makes room, and returns the address of the columns and how many hits each has room for. */
  prepare(length) {
    this.#arrays = null;
    if (length > this.#capacity) {
      this.length = 0;
      this.#capacity = 0;
      this.#room.grow(length * (3 * this.#scalar.bytes + 5));
      this.#capacity = length;
    }
    this.length = length;
    return [this.#room.address, this.#capacity];
  }

  /** For surehit alone: its collider was freed. */
  forget() {
    this.#room = null;
  }

  get #current() {
    if (this.#room === null) throw new Error('surehit: the collider of these hits was freed');
    const { buffer } = this.#room.functions.memory;
    if (this.#arrays?.t.buffer !== buffer) {
      const { Numbers, bytes } = this.#scalar;
      const column = this.#capacity * bytes;
      const { address } = this.#room;
      this.#arrays = {
        t: new Numbers(buffer, address, this.length),
        u: new Numbers(buffer, address + column, this.length),
        v: new Numbers(buffer, address + 2 * column, this.length),
        triangle: new Uint32Array(buffer, address + 3 * column, this.length),
        side: new Uint8Array(buffer, address + 3 * column + 4 * this.#capacity, this.length),
      };
    }
    return this.#arrays;
  }

  get t() { return this.#current.t; }
  get u() { return this.#current.u; }
  get v() { return this.#current.v; }
  get triangle() { return this.#current.triangle; }
  get side() { return this.#current.side; }

  at(index) {
    if (!Number.isInteger(index) || index < 0 || index >= this.length) {
      throw new RangeError(`surehit: hit ${index} of ${this.length}`);
    }
    const { t, u, v, triangle, side } = this.#current;
    if (triangle[index] === noTriangle) return null;
    return { t: t[index], u: u[index], v: v[index], triangle: triangle[index], side: sides[side[index]] };
  }
}

/** Asks about paths in one scalar, through a block of memory. */
class Asker {
  constructor(functions, scalar) {
    this.functions = functions;
    this.scalar = scalar;
    this.block = functions.room(blockBytes);
  }

  call(name, ...given) {
    return this.functions[`${name}_${this.scalar.end}`](...given);
  }

  number(at) {
    return this.functions.view[this.scalar.get](this.block + at, true);
  }

  setNumber(at, x) {
    this.functions.view[this.scalar.set](this.block + at, x, true);
  }

  setNumbers(at, numbers, count, what) {
    if (numbers?.length !== count) {
      throw new TypeError(`surehit: ${what} has ${count} numbers, but ${numbers?.length} were given`);
    }
    for (let i = 0; i < count; ++i) {
      if (typeof numbers[i] !== 'number') {
        throw new TypeError(`surehit: element ${i} of ${what} is no number: ${numbers[i]}`);
      }
      this.setNumber(at + i * this.scalar.bytes, numbers[i]);
    }
  }

  setPath(path) {
    const [kind, numbers] = onlyKind(path, kinds);
    this.setNumbers(pathAt, numbers, 6, `a ${kinds[kind]}`);
    return kind;
  }

  setOptions(options) {
    for (const name in options) {
      if (!optionNames.includes(name)) throw new TypeError(`surehit: there is no option ${name}`);
    }
    const culling = cullings.indexOf(options.culling ?? 'none');
    if (culling < 0) throw new TypeError(`surehit: culling is none, back or front, but not ${options.culling}`);
    const { bytes } = this.scalar;
    this.setNumber(optionsAt, numberIn(options, 'minT', -Infinity));
    this.setNumber(optionsAt + bytes, numberIn(options, 'maxT', Infinity));
    const words = this.block + optionsAt + 2 * bytes;
    const { view } = this.functions;
    view.setUint32(words, culling, true);
    view.setUint32(words + 4, wordIn(options, 'mask', 0xffffffff, -0x80000000), true);
    view.setUint32(words + 8, wordIn(options, 'ignoredTriangle', noTriangle, 0), true);
    const ignored =
      (options.ignoreStartContact ? 1 : 0) + (options.ignoreEndContact ? 2 : 0) + (options.ignoreEdgeOn ? 4 : 0);
    view.setUint32(words + 12, ignored, true);
  }

  setHit(hit) {
    this.setNumber(hitAt, hit.t);
  }

  hit() {
    const { bytes } = this.scalar;
    const words = this.block + hitAt + 3 * bytes;
    const { view } = this.functions;
    return {
      t: this.number(hitAt),
      u: this.number(hitAt + bytes),
      v: this.number(hitAt + 2 * bytes),
      triangle: view.getUint32(words, true),
      side: sides[view.getUint8(words + 4)],
    };
  }

  point(path, hit) {
    const kind = this.setPath(path);
    this.setHit(hit);
    this.call('point', kind, this.block + pathAt, this.block + hitAt, this.block + pointAt);
    return this.vector();
  }

  distance(path, hit) {
    const kind = this.setPath(path);
    this.setHit(hit);
    return this.call('distance', kind, this.block + pathAt, this.block + hitAt);
  }

  intersect(path, corners, options) {
    const kind = this.setPath(path);
    this.setNumbers(cornersAt, corners, 9, 'a triangle');
    this.setOptions(options);
    const { block } = this;
    const isHit = this.call('intersect', kind, block + pathAt, block + cornersAt, block + optionsAt, block + hitAt);
    return isHit ? this.hit() : null;
  }

  vector() {
    const { bytes } = this.scalar;
    return [this.number(pointAt), this.number(pointAt + bytes), this.number(pointAt + 2 * bytes)];
  }
}

export class Surehit {
  #functions;
  #askers;

  constructor(instance) {
    this.#functions = new Functions(instance.exports);
    this.#askers = {
      float: new Asker(this.#functions, scalars.float),
      double: new Asker(this.#functions, scalars.double),
    };
  }

  collider(vertices, triangles, options = {}) {
    return new Collider(this.#functions, this.#askers, vertices, triangles, options);
  }

  intersect(path, corners, options = {}) {
    return this.#askers.double.intersect(path, corners, options);
  }

  point(path, hit) {
    return this.#askers.double.point(path, hit);
  }

  distance(path, hit) {
    return this.#askers.double.distance(path, hit);
  }

  numbers(scalar, count) {
    if (!(scalar in scalars)) throw new TypeError(`surehit: a scalar is float or double, but not ${scalar}`);
    return new Numbers(this.#functions, scalars[scalar], count);
  }

  get memoryBytes() {
    return this.#functions.memory.buffer.byteLength;
  }
}

export class Collider {
  #functions;
  #scalar;
  #asker;
  #self = 0;
  #input;
  #blocked;
  #hits;
  #hitsRoom;

  constructor(functions, askers, vertices, triangles, { masks = null, ...others } = {}) {
    for (const name in others) throw new TypeError(`surehit: there is no option ${name}`);
    const name = vertices instanceof Float32Array ? 'float' : vertices instanceof Float64Array ? 'double' : null;
    if (name === null) throw new TypeError('surehit: vertices are a Float32Array or a Float64Array');
    const isWide = triangles instanceof Uint32Array || triangles instanceof Int32Array;
    if (!isWide && !(triangles instanceof Uint16Array)) {
      throw new TypeError('surehit: triangles are a Uint32Array, an Int32Array or a Uint16Array');
    }
    this.#functions = functions;
    this.#scalar = scalars[name];
    this.#asker = askers[name];
    this.#input = new Room(functions);
    this.#blocked = new Room(functions);
    this.#hitsRoom = new Room(functions);
    this.#hits = new Hits(this.#hitsRoom, this.#scalar);
    const arrays = [new Room(functions), new Room(functions), new Room(functions)];
    try {
      const inputs = [vertices, triangles, this.#checkedMasks(masks)];
      // Where the module's memory grows, arrays that lie in it lose their contents and their lengths.
      const [vertexLength, triangleLength, maskLength] = inputs.map((array) => array.length);
      const known = inputs.map((array) => (array.buffer === functions.memory.buffer ? array.byteOffset : null));
      this.#self = this.#asker.call('create');
      const addresses = inputs.map((array, i) => known[i] ?? arrays[i].addressOf(array));
      this.#check(this.#asker.call('build', this.#self, addresses[0], vertexLength, addresses[1], triangleLength,
        isWide ? 4 : 2, addresses[2], maskLength));
      for (const array of arrays) array.free();
    } catch (error) {
      if (functions.failure === null) {
        for (const array of arrays) array.free();
        this.free();
      }
      throw error;
    }
  }

  get scalar() { return this.#scalar === scalars.float ? 'float' : 'double'; }
  get triangleCount() { return this.#ask('triangle_count'); }
  get memoryBytes() { return this.#ask('memory_bytes'); }

  move(vertices) {
    this.#refuseOthers(vertices, 'vertices');
    this.#check(this.#ask('move', this.#input.addressOf(vertices), vertices.length));
  }

  setMasks(masks) {
    const array = this.#checkedMasks(masks);
    this.#check(this.#ask('set_masks', this.#input.addressOf(array), array.length));
  }

  normal(triangle) {
    if (!Number.isInteger(triangle) || triangle < 0 || triangle >= this.triangleCount) {
      throw new RangeError(`surehit: triangle ${triangle} of ${this.triangleCount}`);
    }
    this.#ask('normal', triangle, this.#asker.block + pointAt);
    return this.#asker.vector();
  }

  firstHit(path, options = {}) {
    const { block } = this.#asker;
    return this.#askAbout('first_hit', path, options, block + hitAt) ? this.#asker.hit() : null;
  }

  anyHit(path, options = {}) {
    return this.#askAbout('any_hit', path, options) !== 0;
  }

  allHits(path, options = {}) {
    const count = this.#askAbout('all_hits', path, options) >>> 0;
    this.#ask('store_all_hits', ...this.#hits.prepare(count));
    return this.#hits;
  }

  firstHits(paths, options = {}) {
    const [kind, address, count] = this.#pathsIn(paths, options);
    const columns = this.#hits.prepare(count);
    this.#ask('first_hits', kind, address, count, this.#asker.block + optionsAt, ...columns);
    return this.#hits;
  }

  anyHits(paths, options = {}) {
    const [kind, address, count] = this.#pathsIn(paths, options);
    this.#blocked.grow(count);
    this.#ask('any_hits', kind, address, count, this.#asker.block + optionsAt, this.#blocked.address);
    return new Uint8Array(this.#functions.memory.buffer, this.#blocked.address, count);
  }

  point(path, hit) {
    this.#refuseFreed();
    return this.#asker.point(path, hit);
  }

  distance(path, hit) {
    this.#refuseFreed();
    return this.#asker.distance(path, hit);
  }

  free() {
    if (this.#self === 0) return;
    this.#asker.call('destroy', this.#self);
    this.#self = 0;
    for (const room of [this.#input, this.#blocked, this.#hitsRoom]) room.free();
    this.#hits.forget();
  }

  #refuseFreed() {
    if (this.#self === 0) throw new Error('surehit: this collider was freed');
  }

  #ask(name, ...given) {
    this.#refuseFreed();
    return this.#asker.call(name, this.#self, ...given);
  }

  #askAbout(name, path, options, ...given) {
    this.#refuseFreed();
    const kind = this.#asker.setPath(path);
    this.#asker.setOptions(options);
    const { block } = this.#asker;
    return this.#ask(name, kind, block + pathAt, block + optionsAt, ...given);
  }

  #pathsIn(paths, options) {
    this.#refuseFreed();
    const [kind, numbers] = onlyKind(paths, kindsOfMany);
    this.#refuseOthers(numbers, kindsOfMany[kind]);
    if (numbers.length % 6 !== 0) {
      throw new TypeError(`surehit: ${kindsOfMany[kind]} have six numbers each, but path ` +
        `${Math.floor(numbers.length / 6)} has ${numbers.length % 6}`);
    }
    this.#asker.setOptions(options);
    return [kind, this.#input.addressOf(numbers), numbers.length / 6];
  }

  #refuseOthers(array, what) {
    const { Numbers: Expected } = this.#scalar;
    if (!(array instanceof Expected)) {
      throw new TypeError(`surehit: the ${what} of this collider are a ${Expected.name}`);
    }
  }

  #checkedMasks(masks) {
    if (masks === null) return new Uint32Array();
    if (!(masks instanceof Uint32Array)) throw new TypeError('surehit: masks are a Uint32Array');
    return masks;
  }

  #check(succeeded) {
    if (succeeded) return;
    const message = this.#functions.text(this.#functions.error_message());
    throw new InvalidMesh(reasons[this.#functions.error_reason()], this.#functions.error_element() >>> 0, message);
  }
}

// What the C++ library could print with. It never does.
const badFile = () => 8;
const imports = { wasi_snapshot_preview1: { fd_close: badFile, fd_seek: badFile, fd_write: badFile } };

/** Compiles and starts the module, from its address, its bytes, a response or a compiled module. */
export async function load(source = new URL('surehit.wasm', import.meta.url)) {
  let input = await source;
  if (typeof input === 'string' || input instanceof URL) {
    const url = new URL(input, import.meta.url);
    if (url.protocol === 'file:') {
      const { readFile } = await import('node:fs/promises');
      input = await readFile(url);
    } else {
      input = await fetch(url);
    }
  }
  if (typeof Response !== 'undefined' && input instanceof Response) {
    if (!input.ok) throw new Error(`surehit: ${input.url} answers ${input.status}`);
    input = await input.arrayBuffer();
  }
  const module = input instanceof WebAssembly.Module ? input : await WebAssembly.compile(input);
  const instance = await WebAssembly.instantiate(module, imports);
  instance.exports._initialize();
  return new Surehit(instance);
}
