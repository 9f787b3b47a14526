// Rays and triangles that are hard in different ways, the same on every machine.

const word = new DataView(new ArrayBuffer(8));

/** SplitMix64 (Steele, Lea and Flood 2014). */
export class Random {
  #state;

  constructor(seed) {
    this.#state = BigInt(seed);
  }

  bits() {
    this.#state = BigInt.asUintN(64, this.#state + 0x9e3779b97f4a7c15n);
    let z = this.#state;
    z = BigInt.asUintN(64, (z ^ (z >> 30n)) * 0xbf58476d1ce4e5b9n);
    z = BigInt.asUintN(64, (z ^ (z >> 27n)) * 0x94d049bb133111ebn);
    return z ^ (z >> 31n);
  }

  below(count) { return Number(this.bits() % BigInt(count)); }
  between(low, high) { return low + this.below(high - low + 1); }
  unit() { return Number(this.bits() >> 11n) * 2 ** -53; }
  symmetric() { return 2 * this.unit() - 1; }
  point(size = 1) { return [size * this.symmetric(), size * this.symmetric(), size * this.symmetric()]; }
}

const add = (p, q, factor = 1) => p.map((x, i) => x + factor * q[i]);
const minus = (p, q) => p.map((x, i) => x - q[i]);
const blend = (u, v, [a, b, c]) => a.map((x, i) => x + u * (b[i] - x) + v * (c[i] - x));

/** The next number but `count - 1`, upwards or downwards. */
function stepped(x, count) {
  word.setFloat64(0, x);
  word.setBigInt64(0, word.getBigInt64(0) + BigInt(count));
  return word.getFloat64(0);
}

const triangle = (random, size) => [random.point(size), random.point(size), random.point(size)];
const towards = (random, target, corners, size = 2) => {
  const origin = random.point(size);
  return { ray: [...origin, ...minus(target, origin)], corners: corners.flat() };
};
const inside = (random, corners) => {
  const [u, v] = [random.unit(), random.unit()];
  return u + v <= 1 ? blend(u, v, corners) : blend(1 - u, 1 - v, corners);
};

/** Each draws a ray and a triangle. */
export const families = {
  general: (random) => {
    const corners = triangle(random);
    return towards(random, blend(1.5 * random.unit() - 0.25, 1.5 * random.unit() - 0.25, corners), corners);
  },
  'aimed at edges': (random) => {
    const corners = triangle(random);
    return towards(random, blend(random.unit(), 0, corners), corners);
  },
  'aimed at vertices': (random) => {
    const corners = triangle(random);
    return towards(random, corners[random.below(3)], corners);
  },
  'small integers': (random) => {
    const numbers = (count) => Array.from({ length: count }, () => random.between(-4, 4));
    return { ray: numbers(6), corners: numbers(9) };
  },
  slivers: (random) => {
    const corners = triangle(random);
    corners[2] = add(blend(random.unit(), 0, corners), random.point(2 ** -40));
    return towards(random, inside(random, corners), corners);
  },
  'degenerate triangles': (random) => {
    const [a, b] = [random.point(), random.point()];
    const corners = [a, b, random.below(2) === 0 ? a : b];
    return towards(random, blend(random.unit(), 0, corners), corners);
  },
  'in the plane': (random) => {
    const corners = triangle(random).map(([x, y]) => [x, y, 0.5]);
    const ray = [...random.point(), ...random.point()];
    ray[2] = 0.5;
    ray[5] = 0;
    return { ray, corners: corners.flat() };
  },
  'near the plane': (random) => {
    const corners = triangle(random).map(([x, y]) => [x, y, stepped(0.5, random.between(-4, 4))]);
    const drawn = towards(random, inside(random, corners), corners);
    drawn.ray[2] = stepped(0.5, random.between(-8, 8));
    drawn.ray[5] = stepped(0.5, random.between(-8, 8)) - 0.5;
    return drawn;
  },
  'starts on the triangle': (random) => {
    const corners = triangle(random).map(([x, y]) => [x, y, 0.5]);
    const origin = inside(random, corners);
    origin[2] = stepped(0.5, random.between(-1, 1));
    return { ray: [...origin, ...random.point()], corners: corners.flat() };
  },
  'far from the origin': (random) => {
    const shift = random.point(2 ** 30);
    const corners = triangle(random, 8).map((corner) => add(corner, shift));
    const origin = add(random.point(16), shift);
    const target = random.below(2) === 0 ? corners[0] : blend(random.unit(), 0, corners);
    return { ray: [...origin, ...minus(target, origin)], corners: corners.flat() };
  },
  'mixed magnitudes': (random) => {
    const scaled = (point) => point.map((x) => x * 2 ** random.between(-40, 40));
    const corners = triangle(random).map(scaled);
    const origin = scaled(random.point());
    return { ray: [...origin, ...minus(inside(random, corners), origin)], corners: corners.flat() };
  },
};
