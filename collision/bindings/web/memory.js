// The memory of a module, and its functions, which take addresses in it.

/** An address has 32 bits. */
const maxBytes = 0xffffffff;

/** What differs between float and double. */
export const scalars = {
  float: { end: 'f32', Numbers: Float32Array, get: 'getFloat32', set: 'setFloat32', bytes: 4 },
  double: { end: 'f64', Numbers: Float64Array, get: 'getFloat64', set: 'setFloat64', bytes: 8 },
};

/** The functions of a module. After one has failed inside, the module's memory is in no known state. */
export class Functions {
  constructor(exports) {
    this.memory = exports.memory;
    this.failure = null;
    for (const [name, call] of Object.entries(exports)) {
      if (typeof call === 'function') this[name] = (...given) => this.guarded(call, given);
    }
  }

  guarded(call, given) {
    if (this.failure !== null) throw new Error(`surehit: this module has failed before: ${this.failure.message}`);
    try {
      return call(...given);
    } catch (error) {
      this.failure = error;
      const cause = { cause: error };
      throw new Error('surehit: the module has failed, most likely for want of memory. Load a new one', cause);
    }
  }

  get view() {
    if (this.lastView?.buffer !== this.memory.buffer) this.lastView = new DataView(this.memory.buffer);
    return this.lastView;
  }

  text(address) {
    const bytes = new Uint8Array(this.memory.buffer, address);
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
  }

  room(bytes) {
    const address = this.allocate(bytes) >>> 0;
    if (address === 0) throw new RangeError(`surehit: no memory for ${bytes} bytes`);
    return address;
  }
}

/** Memory of the module that grows as needed, and that only its owner frees. */
export class Room {
  constructor(functions) {
    this.functions = functions;
    this.address = 0;
    this.bytes = 0;
  }

  grow(bytes) {
    if (bytes <= this.bytes) return;
    if (bytes > maxBytes) throw new RangeError(`surehit: no memory for ${bytes} bytes`);
    this.free();
    this.address = this.functions.room(bytes);
    this.bytes = bytes;
  }

  free() {
    if (this.address !== 0) this.functions.release(this.address);
    this.address = 0;
    this.bytes = 0;
  }

  /** The address of some numbers: their own if they lie in this memory, else that of a copy. */
  addressOf(numbers) {
    const { buffer } = this.functions.memory;
    if (numbers.buffer === buffer) return numbers.byteOffset;
    this.grow(numbers.byteLength);
    new numbers.constructor(this.functions.memory.buffer, this.address, numbers.length).set(numbers);
    return this.address;
  }
}

/** Numbers in the module's memory, which no query copies. */
export class Numbers {
  #functions;
  #scalar;
  #address;
  #array = null;

  constructor(functions, scalar, count) {
    const bytes = count * scalar.bytes;
    if (!(bytes <= maxBytes)) throw new RangeError(`surehit: no memory for ${bytes} bytes`);
    this.#functions = functions;
    this.#scalar = scalar;
    this.length = count;
    this.#address = functions.room(bytes);
  }

  get array() {
    if (this.#address === 0) throw new Error('surehit: these numbers were freed');
    const { buffer } = this.#functions.memory;
    if (this.#array?.buffer !== buffer) this.#array = new this.#scalar.Numbers(buffer, this.#address, this.length);
    return this.#array;
  }

  free() {
    if (this.#address === 0) return;
    this.#functions.release(this.#address);
    this.#address = 0;
  }
}
