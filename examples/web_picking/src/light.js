// A light that moves, and the rays that it casts in each frame.

/** xorshift32 (Marsaglia 2003): the same rays on every machine. */
class Random {
  constructor(seed) {
    this.state = seed | 1;
  }

  unit() {
    this.state ^= this.state << 13;
    this.state ^= this.state >>> 17;
    this.state ^= this.state << 5;
    return (this.state >>> 0) / 2 ** 32;
  }

  below(count) { return Math.floor(this.unit() * count); }
}

/** What rays can be aimed at. All end in `ray`, and the page shows `text`. */
export const aims = {
  corners: 'at corners',
  edges: 'at edges',
  anywhere: 'in all directions',
};

export class Light {
  #mesh;
  #path;
  #random = new Random(20261126);

  /** `path` gives a place for a time in seconds. */
  constructor(mesh, path) {
    this.#mesh = mesh;
    this.#path = path;
    this.move(0);
  }

  /** The place has floats for coordinates, as the mesh has, so that it can be in line with many of its edges. */
  move(seconds) {
    this.place = this.#path(seconds).map(Math.fround);
  }

  /** Writes `count` rays: six numbers each, with directions that have length 1 but for rounding, as three.js asks. */
  cast(rays, count, aim) {
    const [x, y, z] = this.place;
    const towards = this[`towards_${aim}`];
    const direction = [0, 0, 0];
    for (let i = 0; i < count; ++i) {
      towards.call(this, direction);
      const length = Math.sqrt(direction[0] ** 2 + direction[1] ** 2 + direction[2] ** 2) || 1;
      const at = 6 * i;
      rays[at] = x;
      rays[at + 1] = y;
      rays[at + 2] = z;
      rays[at + 3] = direction[0] / length;
      rays[at + 4] = direction[1] / length;
      rays[at + 5] = direction[2] / length;
    }
  }

  towards_anywhere(direction) {
    let squared;
    do {
      for (let axis = 0; axis < 3; ++axis) direction[axis] = 2 * this.#random.unit() - 1;
      squared = direction[0] ** 2 + direction[1] ** 2 + direction[2] ** 2;
    } while (squared > 1 || squared < 0.01);
  }

  towards_corners(direction) {
    const { positions, index } = this.#mesh;
    const at = 3 * index[this.#random.below(index.length)];
    for (let axis = 0; axis < 3; ++axis) direction[axis] = positions[at + axis] - this.place[axis];
  }

  towards_edges(direction) {
    const { positions, index } = this.#mesh;
    const corner = this.#random.below(index.length);
    const next = corner % 3 === 2 ? corner - 2 : corner + 1;
    const share = this.#random.unit();
    for (let axis = 0; axis < 3; ++axis) {
      const [p, q] = [positions[3 * index[corner] + axis], positions[3 * index[next] + axis]];
      direction[axis] = p + share * (q - p) - this.place[axis];
    }
  }
}
