"""The functions of trimesh.ray answer in its shapes, and exactly."""

import unittest
from types import SimpleNamespace

import numpy as np

from surehit.ray import RayMeshIntersector

SQUARE = ((0, 0), (4, 0), (4, 4), (0, 4))
FLOORS = SimpleNamespace(vertices=np.array([[x, y, z] for z in (0.0, 1.0) for x, y in SQUARE]),
                         faces=np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]))
ORIGINS = [[2, 2, 3], [9, 9, 3], [1, 3, 3]]
DOWN = [[0, 0, -1]] * 3


class RayTest(unittest.TestCase):
    def test_first_and_any(self):
        rays = RayMeshIntersector(FLOORS)
        self.assertEqual(rays.intersects_first(ORIGINS, DOWN).tolist(), [2, -1, 3])
        self.assertEqual(rays.intersects_any(np.array(ORIGINS), np.array(DOWN)).tolist(), [True, False, True])

    def test_locations(self):
        rays = RayMeshIntersector(vertices=FLOORS.vertices, faces=FLOORS.faces)
        locations, index_ray, index_tri = rays.intersects_location(ORIGINS, DOWN)
        self.assertEqual(index_ray.tolist(), [0, 0, 0, 0, 2, 2])
        self.assertEqual(index_tri.tolist(), [2, 3, 0, 1, 3, 1])
        self.assertEqual(locations.tolist(), [[2, 2, 1], [2, 2, 1], [2, 2, 0], [2, 2, 0], [1, 3, 1], [1, 3, 0]])
        locations, index_ray, index_tri = rays.intersects_location(ORIGINS, DOWN, multiple_hits=False)
        self.assertEqual((locations.tolist(), index_ray.tolist(), index_tri.tolist()),
                         ([[2, 2, 1], [1, 3, 1]], [0, 2], [2, 3]))
        index_tri, index_ray = rays.intersects_id([[9, 9, 9]], [[0, 0, 1]])
        self.assertEqual((len(index_tri), len(index_ray)), (0, 0))

    def test_nothing_is_left_to_the_edge(self):
        random = np.random.default_rng(2)
        share = random.uniform(0, 1, 1000)
        on_diagonal = np.column_stack([4 * share, 4 * share, np.full(1000, 2.0)])
        down = np.tile((0.0, 0.0, -1.0), (1000, 1))
        self.assertTrue(RayMeshIntersector(FLOORS).intersects_any(on_diagonal, down).all())
        with self.assertRaises(TypeError):
            RayMeshIntersector(vertices=FLOORS.vertices)


if __name__ == "__main__":
    unittest.main()
