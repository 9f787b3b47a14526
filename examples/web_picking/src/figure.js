// A hare in the manner of a scan: its surface is cut out of a grid of distances, and its points are a little noisy.

const { abs, max, min, floor, sqrt } = Math;

const length = (x, y, z) => sqrt(x * x + y * y + z * z);

const ellipsoid = ([cx, cy, cz], [rx, ry, rz]) => (x, y, z) => {
  const [px, py, pz] = [x - cx, y - cy, z - cz];
  const near = length(px / rx, py / ry, pz / rz);
  const slope = length(px / rx / rx, py / ry / ry, pz / rz / rz);
  return slope === 0 ? -min(rx, ry, rz) : (near * (near - 1)) / slope;
};

/** A round limb that gets thinner from a to b. */
const limb = (a, b, radiusAtA, radiusAtB) => {
  const way = b.map((end, i) => end - a[i]);
  const squared = way[0] ** 2 + way[1] ** 2 + way[2] ** 2;
  return (x, y, z) => {
    const [px, py, pz] = [x - a[0], y - a[1], z - a[2]];
    const t = max(0, min(1, (px * way[0] + py * way[1] + pz * way[2]) / squared));
    return length(px - t * way[0], py - t * way[1], pz - t * way[2]) - radiusAtA - t * (radiusAtB - radiusAtA);
  };
};

/** The lesser of two distances, with a round seam of about this size. */
const joined = (p, q, seam) => {
  const h = max(seam - abs(p - q), 0) / seam;
  return min(p, q) - (h * h * seam) / 4;
};

// One half of what comes in pairs: the other half has -x. The hare sits on z = 0 and looks along -y.
const middle = [
  [ellipsoid([0, 0.06, 0.46], [0.35, 0.50, 0.42]), 0.05],
  [ellipsoid([0, -0.24, 0.58], [0.27, 0.28, 0.34]), 0.14],
  [ellipsoid([0, -0.42, 1.02], [0.205, 0.27, 0.215]), 0.10],
  [ellipsoid([0, -0.62, 0.95], [0.115, 0.13, 0.095]), 0.08],
  [ellipsoid([0, 0.57, 0.30], [0.13, 0.13, 0.15]), 0.04],
];
const paired = [
  [ellipsoid([0.26, 0.20, 0.31], [0.17, 0.34, 0.30]), 0.05],
  [ellipsoid([0.29, -0.16, 0.075], [0.10, 0.31, 0.08]), 0.05],
  [limb([0.15, -0.40, 0.50], [0.15, -0.50, 0.10], 0.11, 0.075), 0.07],
  [ellipsoid([0.15, -0.56, 0.06], [0.085, 0.14, 0.065]), 0.05],
  [ellipsoid([0.105, -0.60, 0.93], [0.085, 0.10, 0.08]), 0.05],
  [limb([0.09, -0.34, 1.17], [0.165, -0.13, 1.52], 0.055, 0.085), 0.05],
  [limb([0.165, -0.13, 1.52], [0.20, -0.03, 1.74], 0.085, 0.03), 0.04],
];
const eye = ellipsoid([0.172, -0.545, 1.07], [0.045, 0.045, 0.045]);
const earHollow = limb([0.125, -0.33, 1.30], [0.205, -0.14, 1.62], 0.03, 0.05);

function distance(x, y, z) {
  const side = abs(x);
  let d = Infinity;
  for (const [part, seam] of middle) d = d === Infinity ? part(x, y, z) : joined(d, part(x, y, z), seam);
  for (const [part, seam] of paired) d = joined(d, part(side, y, z), seam);
  d = -joined(-d, earHollow(side, y, z), 0.03);
  return min(d, eye(side, y, z));
}

/** A number in [-1, 1) for each cell, so that the noise is the same on every machine. */
function noise(i, salt) {
  let h = Math.imul(i ^ Math.imul(salt, 0x9e3779b9), 0x85ebca6b);
  h = Math.imul(h ^ (h >>> 13), 0xc2b2ae35);
  return ((h ^ (h >>> 16)) >>> 0) / 2 ** 31 - 1;
}

/** The field on a grid of points. Where it is far from 0, blocks of points have the value of their middle. */
function valuesOn(field, low, cell, count) {
  const block = 8;
  const far = 1.5 * block * cell;
  const values = new Float32Array(count[0] * count[1] * count[2]);
  const ends = (first) => first.map((start, axis) => min(start + block, count[axis]));
  const first = [0, 0, 0];
  for (first[2] = 0; first[2] < count[2]; first[2] += block) {
    for (first[1] = 0; first[1] < count[1]; first[1] += block) {
      for (first[0] = 0; first[0] < count[0]; first[0] += block) {
        const middle = field(...first.map((start, axis) => low[axis] + (start + block / 2) * cell));
        const isFar = abs(middle) > far;
        const end = ends(first);
        for (let k = first[2]; k < end[2]; ++k) {
          for (let j = first[1]; j < end[1]; ++j) {
            for (let i = first[0], at = i + count[0] * (j + count[1] * k); i < end[0]; ++i, ++at) {
              values[at] = isFar ? middle : field(low[0] + i * cell, low[1] + j * cell, low[2] + k * cell);
            }
          }
        }
      }
    }
  }
  return values;
}

/**
 * The surface where a distance is 0: a vertex in each cell that it crosses, and a quad for each edge of the grid that
 * it crosses (Gibson 1998, surface nets). Normals point out.
 */
export function surfaceNet(field, low, high, cell, shake = 0) {
  const count = low.map((x, axis) => floor((high[axis] - x) / cell) + 2);
  const stride = [1, count[0], count[0] * count[1]];
  const values = valuesOn(field, low, cell, count);
  const vertexOf = new Int32Array(values.length).fill(-1);
  const positions = [];
  const index = [];
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((c) => [c & 1, (c >> 1) & 1, c >> 2]);
  const offsets = corners.map(([i, j, k]) => i + j * stride[1] + k * stride[2]);
  const edges = [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]];
  for (let k = 0; k + 1 < count[2]; ++k) {
    for (let j = 0; j + 1 < count[1]; ++j) {
      for (let i = 0; i + 1 < count[0]; ++i) {
        const at = i + j * stride[1] + k * stride[2];
        const isInside = values[at] < 0;
        let isCrossed = false;
        for (let c = 1; c < 8 && !isCrossed; ++c) isCrossed = values[at + offsets[c]] < 0 !== isInside;
        if (!isCrossed) continue;
        const sum = [0, 0, 0];
        let crossings = 0;
        for (const [a, b] of edges) {
          const p = values[at + offsets[a]];
          const q = values[at + offsets[b]];
          if (p < 0 === q < 0) continue;
          ++crossings;
          const t = p / (p - q);
          for (let axis = 0; axis < 3; ++axis) {
            sum[axis] += corners[a][axis] + t * (corners[b][axis] - corners[a][axis]);
          }
        }
        vertexOf[at] = positions.length / 3;
        [i, j, k].forEach((start, axis) =>
          positions.push(low[axis] + cell * (start + sum[axis] / crossings + shake * noise(at, axis))));
      }
    }
  }
  const addQuad = (at, u, v, isOut) => {
    const [a, b, c, d] = [at - u - v, at - v, at, at - u].map((one) => vertexOf[one]);
    if (isOut) index.push(a, b, c, a, c, d);
    else index.push(a, c, b, a, d, c);
  };
  for (let k = 1; k + 1 < count[2]; ++k) {
    for (let j = 1; j + 1 < count[1]; ++j) {
      for (let i = 1; i + 1 < count[0]; ++i) {
        const at = i + j * stride[1] + k * stride[2];
        for (let axis = 0; axis < 3; ++axis) {
          const isInside = values[at] < 0;
          if (isInside === values[at + stride[axis]] < 0) continue;
          addQuad(at, stride[(axis + 1) % 3], stride[(axis + 2) % 3], isInside);
        }
      }
    }
  }
  return { positions: Float32Array.from(positions), index: Uint32Array.from(index) };
}

export function buildFigure(cell = 0.0125) {
  const net = surfaceNet(distance, [-0.6, -0.9, -0.08], [0.6, 0.85, 1.95], cell, 0.12);
  return { name: 'the hare', ...net };
}
