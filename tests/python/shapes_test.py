"""Moving shapes give the answers of one triangle after the other, and those that a reader can check by hand."""

import unittest
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import surehit

FLOOR = np.array([[0, 0, 0], [10, 0, 0], [10, 10, 0], [0, 10, 0]], np.float32)
HALVES = np.array([[0, 1, 2], [0, 2, 3]], np.uint32)


def drawn_shapes(make, random, dtype, count):
    """Shapes in whole numbers, so that many of them graze or touch two triangles at once."""
    starts, ends = (random.integers(-3, 4, (count, 3)).astype(dtype) for _ in range(2))
    halves, radii = random.integers(0, 3, (count, 3)).astype(dtype), random.integers(0, 3, count).astype(dtype)
    sizes = {surehit.SweptSpheres: (radii,), surehit.SweptBoxes: (halves,), surehit.SweptCapsules: (halves, radii)}
    return make(starts, ends, *sizes[make])


class ShapesTest(unittest.TestCase):
    def test_brute_force(self):
        for dtype in (np.float32, np.float64):
            for make in (surehit.SweptSpheres, surehit.SweptBoxes, surehit.SweptCapsules):
                self.check(make, dtype)

    def check(self, make, dtype):
        random = np.random.default_rng(3)
        vertices = random.integers(-2, 3, (12, 3)).astype(dtype)
        collider = surehit.Collider(vertices, random.integers(0, 12, (9, 3)))
        shapes = drawn_shapes(make, random, dtype, 60)
        hits, blocked = collider.first_hits(shapes), collider.any_hits(shapes)
        touching = 0
        for i in range(len(shapes)):
            alone = [surehit.intersect(shapes[i], collider.triangle(j)) for j in range(len(collider))]
            met = [hit._replace(triangle=j) for j, hit in enumerate(alone) if hit is not None]
            every = list(collider.all_hits(shapes[i]))
            touching += any(hit.started_touching for hit in met)
            with self.subTest(make=make, dtype=dtype, shape=i):
                self.assertEqual(met, sorted(every, key=lambda hit: hit.triangle))
                self.assertEqual([hit.t for hit in every], sorted(hit.t for hit in met))
                self.assertEqual(hits[i], every[0] if every else None)
                self.assertEqual(collider.first_hit(shapes[i]), hits[i])
                self.assertEqual((bool(blocked[i]), collider.any_hit(shapes[i])), (bool(met), bool(met)))
                self.assertEqual(collider.overlaps(shapes[i]), any(hit.started_touching for hit in met))
                self.assertEqual(collider.overlaps(shapes[i], filter=lambda hit: hit.triangle % 2),
                                 any(hit.started_touching and hit.triangle % 2 for hit in met))
                if every:
                    t = collider.last_free_t(shapes[i], every[0])
                    before = np.nextafter(dtype(every[0].t), dtype(0))
                    self.assertIn(t, (0,) if every[0].started_touching else (before, every[0].t))
        self.assertTrue(0 < np.count_nonzero(hits.is_hit) < 60)
        self.assertTrue(0 < touching < 60)

    def test_what_a_reader_can_check(self):
        floor = surehit.Collider(FLOOR, HALVES)
        ball = surehit.SweptSphere((5, 5, 3), (5, 5, -1), 1)
        hit = floor.first_hit(ball)
        self.assertEqual(hit, (0.5, 0.0, 0.5, 0, surehit.Feature.EDGE_CA, False))
        self.assertEqual(floor.last_free_t(ball, hit), np.nextafter(np.float32(0.5), np.float32(0)))
        self.assertEqual([other.triangle for other in floor.all_hits(ball)], [0, 1])
        rest = floor.last_free_point(ball, hit)
        self.assertEqual((rest[:2].tolist(), 1 < rest[2] < 1.00001), ([5, 5], True))
        self.assertFalse(floor.overlaps(surehit.SweptSphere(rest, rest, 1)))
        hits = floor.all_hits(ball)
        self.assertEqual((hits.feature.tolist(), hits.started_touching.tolist()),
                         ([surehit.Feature.EDGE_CA, surehit.Feature.EDGE_AB], [False, False]))
        self.assertEqual(repr(hits), "<2 hits of 2 shapes>")
        with self.assertRaisesRegex(AttributeError, "only hits of paths have sides"):
            hits.side
        with self.assertRaisesRegex(AttributeError, "only hits of moving shapes have features"):
            floor.all_hits(surehit.Segment((5, 5, 1), (5, 5, -1))).feature
        self.assertIsNone(floor.first_hit(surehit.SweptSphere((5, 5, 3), (5, 5, 1.5), 1)))
        self.assertTrue(floor.overlaps(surehit.SweptSphere((5, 5, 1), (5, 5, 9), 1)))
        self.assertFalse(floor.overlaps(ball))
        for shape in (surehit.SweptBox((6, 4, 3), (6, 4, -1), (1, 2, 1)),
                      surehit.SweptCapsule((6, 4, 4), (6, 4, 0), (0, 0, 1), 1)):
            self.assertEqual(floor.first_hit(shape), (0.5, np.float32(0.2), np.float32(0.4), 0,
                                                      surehit.Feature.FACE, False))
            touched = floor.triangle(0)
            self.assertEqual(surehit.contact_normal(shape, touched).tolist(), [0, 0, 1])
            np.testing.assert_allclose(surehit.contact_point(touched, floor.first_hit(shape)), [6, 4, 0], atol=1e-5)
        self.assertTrue(floor.overlaps(surehit.SweptBox((11, 5, 0.5), (11, 5, 9), (1, 0, 1))))
        self.assertEqual(repr(shape), "SweptCapsule((6, 4, 4), (6, 4, 0), (0, 0, 1), 1)")

    def test_options_filters_and_threads(self):
        floor = surehit.Collider(FLOOR, HALVES, masks=[1, 2])
        ball = surehit.SweptSphere((5, 5, 3), (5, 5, -1), 1)
        self.assertEqual(floor.first_hit(ball, mask=2).triangle, 1)
        self.assertIsNone(floor.first_hit(ball, max_t=0.25))
        self.assertEqual(floor.first_hit(ball, filter=lambda hit: hit.triangle == 1).triangle, 1)
        resting = surehit.SweptSphere((5, 5, 1), (5, 5, 9), 1)
        self.assertEqual([floor.any_hit(resting, ignore_start_contact=ignored) for ignored in (False, True)],
                         [True, False])
        balls = surehit.SweptSpheres(np.tile(ball.start, (2000, 1)), ball.end, ball.radius)
        hits = floor.first_hits(balls, ignored_triangle=np.arange(2000) % 3)
        self.assertEqual(hits.triangle[:3].tolist(), [1, 0, 0])
        with ThreadPoolExecutor(2) as pool:
            statistics = surehit.Statistics()
            hits = floor.first_hits(balls, filter=lambda index, hit: index % 2 == hit.triangle, executor=pool,
                                    statistics=statistics, out=hits)
        self.assertEqual((hits.triangle.tolist(), statistics.paths), ([0, 1] * 1000, 2000))

    def test_what_is_wrong_is_named(self):
        floor = surehit.Collider(FLOOR, HALVES)
        starts = np.zeros((3, 3), np.float32)
        for make, kind, named in (
                (lambda: surehit.SweptShape((0, 0, 0), (0, 0, 1)), TypeError, "is a SweptSphere, a SweptBox or"),
                (lambda: surehit.SweptShapes(), TypeError, "are SweptSpheres, SweptBoxes or"),
                (lambda: surehit.SweptSphere((0, 0), (0, 0, 1), 1), ValueError, "start must be three numbers"),
                (lambda: surehit.SweptSphere((0, 0, 0), (0, 0, 1), (1, 2)), TypeError, "radius must be a number"),
                (lambda: surehit.SweptBox((0, 0, 0), (0, 0, 1), 1), ValueError, "half_extents must be three numbers"),
                (lambda: surehit.SweptCapsules(starts, starts, [0, 0], 1), ValueError, "half_axes must have the shape"),
                (lambda: surehit.SweptSpheres(starts, starts[:2], 1), ValueError, "3 starts but 2 ends"),
                (lambda: surehit.SweptSpheres(starts, starts, [1, 2]), ValueError, "2 radii"),
                (lambda: surehit.SweptSpheres(starts, starts, [[1]]), ValueError, "radii must have the shape"),
                (lambda: floor.first_hit(surehit.SweptSphere((0, 0, 0), (0, 0, 1), np.float64(0.1))), ValueError,
                 "radius is 0.1, which is no float32"),
                (lambda: floor.first_hits(surehit.SweptSpheres(starts, starts, np.array([1, 0.1, 1]))), ValueError,
                 r"radii\[1\] is 0.1, which is no float32"),
                (lambda: floor.first_hits(surehit.SweptSpheres(starts, starts, 1), max_t=np.array([1, 1, 0.1])),
                 ValueError, r"max_t\[2\] is 0.1, which is no float32"),
                (lambda: floor.first_hit((0, 0, 0)), TypeError, "a Line or a moving shape, and not tuple"),
                (lambda: floor.any_hits(starts), TypeError, "Lines or moving shapes, and not ndarray"),
                (lambda: floor.overlaps(surehit.Segment((0, 0, 0), (0, 0, 1))), TypeError, "must be a moving shape"),
                (lambda: floor.first_hit(surehit.SweptSphere((0, 0, 0), (0, 0, 1), 1), min_t=0), TypeError,
                 "no option min_t")):
            with self.subTest(named=named), self.assertRaisesRegex(kind, named):
                make()

    def test_indices_and_changed_arrays(self):
        floor = surehit.Collider(FLOOR, HALVES)
        starts = np.array([[5, 5, 3], [50, 5, 3]], np.float32)
        balls = surehit.SweptSpheres(starts, [5, 5, -1], [1, 1])
        self.assertEqual((len(balls), repr(balls)), (2, "<2 SweptSpheres>"))
        self.assertEqual(repr(balls[-2]), "SweptSphere((5.0, 5.0, 3.0), (5.0, 5.0, -1.0), 1.0)")
        with self.assertRaisesRegex(IndexError, "there are 2 shapes"):
            balls[2]
        self.assertTrue(floor.first_hits(balls).is_hit.all())
        starts[0, 2] = 0.5
        self.assertEqual(floor.first_hits(balls).started_touching.tolist(), [True, False])


if __name__ == "__main__":
    unittest.main()
