// The exact answer for a ray and a triangle, in integers of any size. It shares nothing with surehit or three.js.

const word = new DataView(new ArrayBuffer(8));

/** The number as integer * 2^exponent. */
function parts(x) {
  word.setFloat64(0, x);
  const bits = word.getBigUint64(0);
  const biased = Number((bits >> 52n) & 0x7ffn);
  const fraction = bits & 0xfffffffffffffn;
  const size = biased === 0 ? fraction : fraction | 0x10000000000000n;
  return [x < 0 ? -size : size, Math.max(biased, 1) - 1075];
}

/** The numbers as integers that have one unit, 2^exponent. */
export function integersOf(numbers) {
  const all = Array.from(numbers, parts);
  const exponent = Math.min(...all.map(([, e]) => e));
  return { integers: all.map(([size, e]) => size << BigInt(e - exponent)), exponent };
}

const minus = (p, q) => [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
const cross = (p, q) => [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
const bitLength = (n) => n.toString(2).length;

/** The double that is nearest to a quotient, ties to even. */
export function nearest(numerator, denominator) {
  if (denominator < 0n) return nearest(-numerator, -denominator);
  if (numerator < 0n) return -nearest(-numerator, denominator);
  if (numerator === 0n) return 0;
  for (let exponent = Math.max(bitLength(numerator) - bitLength(denominator) - 53, -1074); ; ++exponent) {
    const [p, q] =
      exponent < 0 ? [numerator << BigInt(-exponent), denominator] : [numerator, denominator << BigInt(exponent)];
    const twice = 2n * (p % q);
    let size = p / q;
    if (twice > q || (twice === q && (size & 1n) === 1n)) ++size;
    if (size <= 1n << 53n) return Number(size) * 2 ** exponent;
  }
}

/**
 * Where a ray of six numbers meets a triangle of nine, or null. The ray has only one point in common with the
 * triangle's plane, which is in front of its origin and on the triangle. `culling` is as in surehit.
 */
export function contact(ray, corners, culling = 'none') {
  const { integers } = integersOf([...ray, ...corners]);
  const point = (at) => integers.slice(at, at + 3);
  const [origin, direction, a, b, c] = [0, 3, 6, 9, 12].map(point);
  const [ab, ac, s] = [minus(b, a), minus(c, a), minus(origin, a)];
  const normal = cross(ab, ac);
  let det = -dot(direction, normal);
  if (det === 0n) return null;
  const isFront = det > 0n;
  if (culling === (isFront ? 'front' : 'back')) return null;
  const moment = cross(s, direction);
  let [t, u, v] = [dot(s, normal), dot(ac, moment), -dot(ab, moment)];
  if (!isFront) [det, t, u, v] = [-det, -t, -u, -v];
  return t >= 0n && u >= 0n && v >= 0n && u + v <= det ? { t, u, v, det, isFront } : null;
}

/** Coordinate `axis` of the ray's point at t, rounded once. */
export function coordinate(ray, t, axis) {
  const { integers, exponent } = integersOf([ray[axis], ray[axis + 3]]);
  const [size, own] = parts(t);
  let [numerator, denominator] = [0n, 1n];
  if (own >= 0) numerator = integers[0] + ((integers[1] * size) << BigInt(own));
  else [numerator, denominator] = [(integers[0] << BigInt(-own)) + integers[1] * size, 1n << BigInt(-own)];
  return exponent < 0 ? nearest(numerator, denominator << BigInt(-exponent))
    : nearest(numerator << BigInt(exponent), denominator);
}
