// The built-in level, made by the library's own example code in WebAssembly.

// What the C++ library could print with. It never does.
const badFile = () => 8;
const imports = { wasi_snapshot_preview1: { fd_close: badFile, fd_seek: badFile, fd_write: badFile } };

/** Where a person stands in the great hall, and a place before her for something to look at. Metres, z up. */
export const hall = { eye: [39.6, 18.9, 1.9], place: [36.5, 26.2, 0] };

export async function buildLevel(source = new URL('level.wasm', import.meta.url)) {
  const response = await fetch(source);
  if (!response.ok) throw new Error(`${response.url} answers ${response.status}`);
  const { instance } = await WebAssembly.instantiate(await response.arrayBuffer(), imports);
  const { memory, _initialize, build, vertices, vertex_count, triangles, triangle_count } = instance.exports;
  _initialize();
  build();
  return {
    name: 'the level',
    positions: new Float32Array(memory.buffer, vertices() >>> 0, 3 * vertex_count()).slice(),
    index: new Uint32Array(memory.buffer, triangles() >>> 0, 3 * triangle_count()).slice(),
  };
}
