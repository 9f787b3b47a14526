"""The functions of trimesh.ray have the arguments of trimesh, and its answers where its tolerances play no part."""

import unittest

import numpy as np

from surehit.ray import RayMeshIntersector

try:
    import trimesh
    from trimesh.ray.ray_triangle import RayMeshIntersector as TheirIntersector
    TheirIntersector(trimesh.creation.box()).intersects_any([[0, 0, 9]], [[0, 0, -1]])  # needs rtree
except ImportError:
    trimesh = None


@unittest.skipIf(trimesh is None, "trimesh, or the rtree that it needs, is not installed")
class TrimeshTest(unittest.TestCase):
    def setUp(self):
        self.mesh = trimesh.creation.icosphere(subdivisions=2)
        self.theirs, self.ours = TheirIntersector(self.mesh), RayMeshIntersector(self.mesh)
        random = np.random.default_rng(5)
        self.origins = random.uniform(-2, 2, (300, 3))
        self.directions = random.uniform(-1, 1, (300, 3)) - self.origins

    def test_rays_in_general_position(self):
        given = (self.origins, self.directions)
        np.testing.assert_array_equal(self.ours.intersects_any(*given), self.theirs.intersects_any(*given))
        np.testing.assert_array_equal(self.ours.intersects_first(*given), self.theirs.intersects_first(*given))
        for multiple_hits in (True, False):
            found = []
            for intersector in (self.ours, self.theirs):
                locations, ray, triangle = intersector.intersects_location(*given, multiple_hits=multiple_hits)
                order = np.lexsort((triangle, ray))
                found.append((ray[order], triangle[order], locations[order]))
            np.testing.assert_array_equal(found[0][0], found[1][0])
            np.testing.assert_array_equal(found[0][1], found[1][1])
            np.testing.assert_allclose(found[0][2], found[1][2], rtol=0, atol=1e-9)
            pairs = [sorted(zip(*(x.tolist() for x in intersector.intersects_id(*given, multiple_hits=multiple_hits))))
                     for intersector in (self.ours, self.theirs)]
            self.assertEqual(*pairs)

    def test_rays_through_vertices_have_a_hit_for_each_triangle(self):
        box = trimesh.creation.box()
        given = (3 * box.vertices, -2 * box.vertices)
        self.assertEqual(len(RayMeshIntersector(box).intersects_location(*given)[0]), 2 * 3 * 12)
        # Where locations are wanted, trimesh keeps one of the hits at a vertex.
        self.assertLess(len(TheirIntersector(box).intersects_location(*given)[0]), 2 * 3 * 12)


if __name__ == "__main__":
    unittest.main()
