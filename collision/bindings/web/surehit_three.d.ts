import type { BufferGeometry, Intersection, Material, Mesh, Raycaster } from 'three';
import type { Surehit } from './surehit.js';

/**
 * Finds the intersections of a mesh of three.js, in doubles and exactly.
 *
 * `mesh.raycast = (raycaster, intersects) => collider.raycast(raycaster, intersects)` makes a `Raycaster` use it.
 */
export class MeshCollider {
  /** Copies the mesh's positions, indices and draw range. Throws `InvalidMesh`. */
  constructor(surehit: Surehit, mesh: Mesh<BufferGeometry, Material>);
  /**
   * Appends the mesh's intersections with the ray, in the order of exact t and then of `faceIndex`. With
   * `raycaster.firstHitOnly` it appends the first one alone.
   *
   * As in three.js, a ray in a triangle's plane does not meet the triangle, and the material's `side` says which sides
   * count. `near` and `far` are limits of t, both included. The direction should have the length 1, and t is then the
   * distance. The answer is exact for the ray in the mesh's own space. The mesh's matrix and its inverse are rounded,
   * except for a matrix such as the identity. `point` and `distance` are those of the ray as it was given.
   */
  raycast(raycaster: Raycaster & { firstHitOnly?: boolean }, intersects: Intersection[]): void;
  /** Takes over positions that have moved. There must be as many as before. */
  update(): void;
  /** Frees the memory. Nothing may be asked after it. */
  free(): void;
}
