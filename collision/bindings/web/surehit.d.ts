/** A path: a segment from start to end, or a ray or a line through an origin along a direction, as six numbers. */
export type Path = { segment: ArrayLike<number> } | { ray: ArrayLike<number> } | { line: ArrayLike<number> };
/** Paths of one kind, six numbers each. Float colliders take a `Float32Array`, and double ones a `Float64Array`. */
export type Paths<Numbers> = { segments: Numbers } | { rays: Numbers } | { lines: Numbers };

/** What narrows a query. The defaults leave out only triangles whose mask is 0. */
export interface QueryOptions {
  /** The minimum t that counts. */
  minT?: number;
  /** The maximum t that counts. */
  maxT?: number;
  /** `back` keeps only hits from the front, and `front` only hits from the back. */
  culling?: 'none' | 'back' | 'front';
  /** Leaves out triangles whose mask shares no bit with this. */
  mask?: number;
  /** Leaves out this triangle. */
  ignoredTriangle?: number;
  /** Leaves out triangles that exactly contain the start of a segment or the origin of a ray. */
  ignoreStartContact?: boolean;
  /** Leaves out triangles that exactly contain the end of a segment. */
  ignoreEndContact?: boolean;
  /** Leaves out hits in a triangle's plane, and those of degenerate triangles. */
  ignoreEdgeOn?: boolean;
}

/** Where a path meets a triangle. t, u and v are the exact values, each rounded once. */
export interface Hit {
  t: number;
  u: number;
  v: number;
  triangle: number;
  side: 'edge_on' | 'front' | 'back';
}

/** The id that no triangle has. In the hits of a batch it means a miss, whose other numbers mean nothing. */
export const noTriangle: 0xffffffff;
/** The values in `Hits.side`. */
export const Side: Readonly<{ edgeOn: 0; front: 1; back: 2 }>;

/**
 * Hits in the module's memory, which nothing copies. They belong to their collider, and its next `firstHits` or
 * `allHits` replaces them.
 *
 * An array is valid until then, or until the module's memory grows, which detaches it. A getter returns the array in
 * the memory as it is now. So ask for `hits.t` again after other calls, and copy what must stay.
 */
export class Hits<Numbers = Float32Array | Float64Array> {
  private constructor();
  readonly length: number;
  readonly t: Numbers;
  readonly u: Numbers;
  readonly v: Numbers;
  readonly triangle: Uint32Array;
  readonly side: Uint8Array;
  /** Returns one hit, or null for a miss. */
  at(index: number): Hit | null;
}

/** Why a mesh or its masks cannot be used. `element` is the first vertex or triangle that is invalid, or a number. */
export class InvalidMesh extends Error {
  readonly reason:
    | 'too_many_triangles'
    | 'index_out_of_range'
    | 'non_finite_vertex'
    | 'masks_do_not_match'
    | 'vertices_do_not_match'
    | 'missing_array'
    | 'incomplete_vertex'
    | 'incomplete_triangle'
    | 'vertex_stride_too_small'
    | 'triangle_stride_too_small';
  readonly element: number;
}

/** A triangle mesh that answers exactly where paths meet it. It copies the mesh. */
export class Collider<Numbers extends Float32Array | Float64Array = Float32Array | Float64Array> {
  private constructor();
  readonly scalar: 'float' | 'double';
  readonly triangleCount: number;
  /** The memory of the mesh and its grid, in bytes. */
  readonly memoryBytes: number;
  /** Returns the hit with the lowest exact t, and the lowest id among equal ones. Numbers are rounded to the scalar. */
  firstHit(path: Path, options?: QueryOptions): Hit | null;
  /** Returns true if the path meets any triangle. */
  anyHit(path: Path, options?: QueryOptions): boolean;
  /** Returns a hit for each triangle that the path meets, in order. */
  allHits(path: Path, options?: QueryOptions): Hits<Numbers>;
  /** Returns the first hit of each path. `Surehit.numbers` makes paths that are not copied. */
  firstHits(paths: Paths<Numbers>, options?: QueryOptions): Hits<Numbers>;
  /**
   * Returns 1 for each path that has a hit, and 0 for others, in the module's memory. The array is valid until the next
   * `anyHits` of this collider, or until the memory grows.
   */
  anyHits(paths: Paths<Numbers>, options?: QueryOptions): Uint8Array;
  /** Returns the path's point at hit.t, each coordinate rounded once. */
  point(path: Path, hit: Pick<Hit, 't'>): [number, number, number];
  /** Returns the distance to the path's point at hit.t, within one ulp. */
  distance(path: Path, hit: Pick<Hit, 't'>): number;
  /** Returns the unit normal of a triangle, or zero for a degenerate one. */
  normal(triangle: number): [number, number, number];
  /** Moves the vertices. Throws `InvalidMesh`, and the collider is then as before. */
  move(vertices: Numbers): void;
  /** Sets the masks of all triangles. No masks mean that all have all bits. Throws `InvalidMesh`. */
  setMasks(masks: Uint32Array): void;
  /** Frees the memory. What is asked after it is refused. */
  free(): void;
}

/** Numbers in the module's memory. */
export class Numbers<Array = Float32Array | Float64Array> {
  private constructor();
  readonly length: number;
  /** The numbers. The array is valid until the memory grows, so ask for it again after other calls. */
  readonly array: Array;
  /** Frees the memory. What is asked after it is refused. */
  free(): void;
}

/**
 * A module that runs, with a memory of its own of up to 4 GiB. After a failure inside, as for want of memory, it
 * refuses all calls.
 */
export class Surehit {
  private constructor();
  /** Builds a collider in the scalar of the vertices. Throws `InvalidMesh`, or a TypeError for other arrays. */
  collider<Numbers extends Float32Array | Float64Array>(
    vertices: Numbers,
    triangles: Uint32Array | Int32Array | Uint16Array,
    options?: { masks?: Uint32Array | null },
  ): Collider<Numbers>;
  /** Returns where a path meets one triangle of nine doubles, or null. */
  intersect(path: Path, corners: ArrayLike<number>, options?: QueryOptions): Hit | null;
  /** Returns the path's point at hit.t in doubles, each coordinate rounded once. */
  point(path: Path, hit: Pick<Hit, 't'>): [number, number, number];
  /** Returns the distance to the path's point at hit.t in doubles, within one ulp. */
  distance(path: Path, hit: Pick<Hit, 't'>): number;
  /** Makes room for paths that no query copies. Throws a RangeError if there is too little memory. */
  numbers(scalar: 'float', count: number): Numbers<Float32Array>;
  numbers(scalar: 'double', count: number): Numbers<Float64Array>;
  /** The size of the module's memory. It never becomes less. */
  readonly memoryBytes: number;
}

/**
 * Compiles and starts a module. The default is the file `surehit.wasm` beside surehit.js. An address in text counts from
 * there too.
 */
export function load(
  source?: string | URL | BufferSource | WebAssembly.Module | Response | Promise<Response>,
): Promise<Surehit>;
