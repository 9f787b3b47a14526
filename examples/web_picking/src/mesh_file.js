// Meshes from OBJ, PLY, STL and OFF files, as positions and indices.

import { OBJLoader } from 'three/addons/loaders/OBJLoader.js';
import { PLYLoader } from 'three/addons/loaders/PLYLoader.js';
import { STLLoader } from 'three/addons/loaders/STLLoader.js';

const textOf = (bytes) => new TextDecoder().decode(bytes);

/** Positions, and indices or null, of an OFF file. Faces become fans. */
export function readOff(text) {
  const words = text.replace(/#.*/g, '').split(/\s+/).filter((word) => word !== '');
  if (words.shift() !== 'OFF') throw new Error('it does not begin with OFF');
  let at = 0;
  const next = (what) => {
    const number = at < words.length ? Number(words[at++]) : NaN;
    if (Number.isNaN(number)) throw new Error(`${what} is no number`);
    return number;
  };
  const [vertices, faces] = [next('the count of vertices'), next('the count of faces'), next('the count of edges')];
  const positions = new Float32Array(3 * vertices);
  for (let i = 0; i < positions.length; ++i) positions[i] = next(`a coordinate of vertex ${Math.floor(i / 3)}`);
  const index = [];
  for (let face = 0; face < faces; ++face) {
    const corners = Array.from({ length: next(`the count of corners of face ${face}`) }, () => next(`face ${face}`));
    for (let i = 2; i < corners.length; ++i) index.push(corners[0], corners[i - 1], corners[i]);
  }
  return [{ positions, index: Uint32Array.from(index) }];
}

const partOf = (geometry) => ({
  positions: Float32Array.from(geometry.attributes.position?.array ?? []),
  index: geometry.index === null ? null : Uint32Array.from(geometry.index.array),
});

const readers = {
  obj: (bytes) => {
    const parts = [];
    new OBJLoader().parse(textOf(bytes)).traverse((object) => {
      if (object.isMesh) parts.push(partOf(object.geometry));
    });
    return parts;
  },
  ply: (bytes) => {
    const part = partOf(new PLYLoader().parse(bytes));
    return part.index === null ? [] : [part];
  },
  stl: (bytes) => [partOf(new STLLoader().parse(bytes))],
  off: (bytes) => readOff(textOf(bytes)),
};

/** Gives equal points one vertex: the drawn formats repeat them, and a light aims at vertices. */
function joinedParts(parts) {
  const ids = new Map();
  const positions = [];
  const index = [];
  for (const part of parts) {
    const count = part.index?.length ?? part.positions.length / 3;
    for (let i = 0; i < count; ++i) {
      const at = 3 * (part.index?.[i] ?? i);
      const point = [part.positions[at], part.positions[at + 1], part.positions[at + 2]];
      if (!point.every(Number.isFinite)) {
        throw new Error(`a coordinate of triangle ${Math.floor(index.length / 3)} is no number`);
      }
      const key = point.join();
      let id = ids.get(key);
      if (id === undefined) {
        id = positions.length / 3;
        ids.set(key, id);
        positions.push(...point);
      }
      index.push(id);
    }
  }
  return { positions: Float32Array.from(positions), index: Uint32Array.from(index) };
}

/** Reads a mesh from the bytes of a file. Throws an Error that names the file. */
export function readMesh(name, bytes) {
  const ending = name.toLowerCase().split('.').pop();
  if (!(ending in readers)) throw new Error(`${name}: expected a file .obj, .ply, .stl or .off`);
  try {
    const { positions, index } = joinedParts(readers[ending](bytes));
    if (index.length === 0) throw new Error('the mesh has no triangles');
    return { name, positions, index };
  } catch (error) {
    throw new Error(`${name}: ${error.message}`);
  }
}
