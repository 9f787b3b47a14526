// Intersections of three.js, found by surehit. surehit_three.d.ts says what each function promises.

import { BackSide, DoubleSide, Matrix4, Vector2, Vector3 } from 'three';

const inverse = new Matrix4();

/** Numbers of an attribute, three or two to an element, as doubles. */
function numbersOf(attribute, size) {
  const numbers = new Float64Array(attribute.count * size);
  for (let i = 0; i < attribute.count; ++i) {
    for (let j = 0; j < size; ++j) numbers[size * i + j] = attribute.getComponent(i, j);
  }
  return numbers;
}

/** The ray in the mesh's own space. Its direction keeps its length there, so that t is the same in both spaces. */
function localRay({ origin, direction }, matrixWorld) {
  inverse.copy(matrixWorld).invert();
  const start = origin.clone().applyMatrix4(inverse);
  const { x, y, z } = direction;
  const e = inverse.elements;
  return [
    start.x, start.y, start.z,
    e[0] * x + e[4] * y + e[8] * z, e[1] * x + e[5] * y + e[9] * z, e[2] * x + e[6] * y + e[10] * z,
  ];
}

export class MeshCollider {
  #surehit;
  #mesh;
  #collider;
  #triangles;

  constructor(surehit, mesh) {
    const { index, attributes, drawRange } = mesh.geometry;
    const { position } = attributes;
    if (position === undefined) throw new TypeError('surehit: the geometry has no positions');
    const corners = index === null ? position.count : index.count;
    this.#triangles = new Uint32Array(corners - (corners % 3));
    for (let i = 0; i < this.#triangles.length; ++i) this.#triangles[i] = index === null ? i : index.getX(i);
    const end = drawRange.start + drawRange.count;
    const masks = Uint32Array.from({ length: this.#triangles.length / 3 }, (_, triangle) =>
      (3 * triangle >= drawRange.start && 3 * triangle < end ? 1 : 0));
    this.#surehit = surehit;
    this.#mesh = mesh;
    this.#collider = surehit.collider(numbersOf(position, 3), this.#triangles, { masks });
  }

  update() {
    this.#collider.move(numbersOf(this.#mesh.geometry.attributes.position, 3));
  }

  free() {
    this.#collider.free();
  }

  raycast(raycaster, intersects) {
    const { material, matrixWorld } = this.#mesh;
    if (material === undefined) return;
    if (Array.isArray(material)) throw new TypeError('surehit: a mesh has one material here, but not an array of them');
    const path = { ray: localRay(raycaster.ray, matrixWorld) };
    const options = {
      minT: raycaster.near,
      maxT: raycaster.far,
      culling: material.side === DoubleSide ? 'none' : material.side === BackSide ? 'front' : 'back',
      ignoreEdgeOn: true,
    };
    if (raycaster.firstHitOnly) {
      const hit = this.#collider.firstHit(path, options);
      if (hit !== null) intersects.push(this.#intersection(raycaster.ray, hit));
      return;
    }
    const hits = this.#collider.allHits(path, options);
    for (let i = 0; i < hits.length; ++i) intersects.push(this.#intersection(raycaster.ray, hits.at(i)));
  }

  #intersection({ origin, direction }, hit) {
    const path = { ray: [origin.x, origin.y, origin.z, direction.x, direction.y, direction.z] };
    const { uv, uv1 } = this.#mesh.geometry.attributes;
    const [a, b, c] = this.#triangles.subarray(3 * hit.triangle, 3 * hit.triangle + 3);
    const barycoord = new Vector3(1 - hit.u - hit.v, hit.u, hit.v);
    const intersection = {
      distance: this.#surehit.distance(path, hit),
      point: new Vector3(...this.#surehit.point(path, hit)),
      object: this.#mesh,
      faceIndex: hit.triangle,
      face: { a, b, c, normal: new Vector3(...this.#collider.normal(hit.triangle)), materialIndex: 0 },
      barycoord,
    };
    const interpolated = (attribute) => {
      const at = (read) =>
        barycoord.x * read(attribute, a) + barycoord.y * read(attribute, b) + barycoord.z * read(attribute, c);
      return new Vector2(at((from, i) => from.getX(i)), at((from, i) => from.getY(i)));
    };
    if (uv !== undefined) intersection.uv = interpolated(uv);
    if (uv1 !== undefined) intersection.uv1 = interpolated(uv1);
    return intersection;
  }
}
