// What is asked about: one mesh, joined from the level and the figure. Coordinates are floats, z is up.

/** Turns a mesh whose y axis is up. */
export function turnedUp({ name, positions, index }) {
  const turned = new Float32Array(positions.length);
  for (let i = 0; i < positions.length; i += 3) {
    turned[i] = positions[i];
    turned[i + 1] = -positions[i + 2];
    turned[i + 2] = positions[i + 1];
  }
  return { name, positions: turned, index };
}

export function boundsOf({ positions }) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; ++i) {
    low[i % 3] = Math.min(low[i % 3], positions[i]);
    high[i % 3] = Math.max(high[i % 3], positions[i]);
  }
  return { low, high };
}

/** Scales a mesh until its longest side has this size, and puts it on a place. */
export function placed({ name, positions, index }, place, size) {
  const { low, high } = boundsOf({ positions });
  const scale = size / Math.max(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  const foot = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]];
  return { name, positions: positions.map((x, i) => place[i % 3] + scale * (x - foot[i % 3])), index };
}

/** One mesh out of some, and which triangles are whose. */
export function joined(meshes) {
  const total = (array) => meshes.reduce((sum, mesh) => sum + mesh[array].length, 0);
  const positions = new Float32Array(total('positions'));
  const index = new Uint32Array(total('index'));
  const parts = [];
  let [vertex, corner] = [0, 0];
  for (const mesh of meshes) {
    parts.push({ name: mesh.name, firstTriangle: corner / 3 });
    positions.set(mesh.positions, 3 * vertex);
    for (let i = 0; i < mesh.index.length; ++i) index[corner + i] = vertex + mesh.index[i];
    vertex += mesh.positions.length / 3;
    corner += mesh.index.length;
  }
  return { positions, index, parts };
}

/** The nine numbers of a triangle's corners. */
export function cornersOf({ positions, index }, triangle) {
  const corners = [];
  for (let i = 3 * triangle; i < 3 * triangle + 3; ++i) {
    corners.push(...positions.subarray(3 * index[i], 3 * index[i] + 3));
  }
  return corners;
}

/** The part of a joined mesh that a triangle is of. */
export function partOf({ parts }, triangle) {
  return parts.findLast((part) => part.firstTriangle <= triangle);
}
