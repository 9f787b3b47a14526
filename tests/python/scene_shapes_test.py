"""Moving shapes in scenes give the answers of one placed triangle after the other, and those of a count by hand."""

import unittest
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import surehit

TILE = np.array([[0, 0, 0], [8, 0, 0], [0, 8, 0]], np.float32)


def drawn_shapes(make, random, dtype, count):
    """Shapes in whole numbers, so that many of them graze or touch two triangles at once."""
    starts, ends = (random.integers(-5, 6, (count, 3)).astype(dtype) for _ in range(2))
    halves, radii = random.integers(0, 3, (count, 3)).astype(dtype), random.integers(0, 3, count).astype(dtype)
    sizes = {surehit.SweptSpheres: (radii,), surehit.SweptBoxes: (halves,), surehit.SweptCapsules: (halves, radii)}
    return make(starts, ends, *sizes[make])


def seen_from(shape, motion):
    """Returns the shape as an instance with this motion sees it. All numbers are small, so nothing is rounded."""
    end = tuple(x - y for x, y in zip(shape.end, motion))
    sizes = [getattr(shape, name) for name in ("half_extents", "half_axis", "radius") if hasattr(shape, name)]
    return type(shape)(shape.start, end, *sizes)


class SceneShapesTest(unittest.TestCase):
    def check(self, dtype, mesh_dtype):
        random = np.random.default_rng(11)
        vertices = random.integers(-2, 3, (6, 3)).astype(mesh_dtype)
        mesh = surehit.Collider(vertices, random.integers(0, 6, (4, 3)))
        scene, placed = surehit.Scene(dtype), []
        for _ in range(4):
            pose = np.column_stack([random.integers(-1, 2, (3, 3)) + 2 * np.eye(3), random.integers(-3, 4, 3)])
            motion = random.integers(-2, 3, 3).astype(dtype)
            instance = scene.add(mesh, pose.astype(dtype))
            scene.set_motion(instance, motion)
            placed += [(instance, k, mesh.triangle(k) @ pose[:, :3].T + pose[:, 3], motion) for k in range(len(mesh))]
        scene.commit()
        found = touching = 0
        for make in (surehit.SweptSpheres, surehit.SweptBoxes, surehit.SweptCapsules):
            shapes = drawn_shapes(make, random, dtype, 25)
            hits, blocked = scene.first_hits(shapes), scene.any_hits(shapes)
            for i in range(len(shapes)):
                alone = [(surehit.intersect(seen_from(shapes[i], motion), corners.astype(dtype)), instance, k)
                         for instance, k, corners, motion in placed]
                met = [surehit.SceneShapeHit(*hit._replace(triangle=k), instance) for hit, instance, k in alone if hit]
                every = list(scene.all_hits(shapes[i]))
                with self.subTest(dtype=dtype, mesh=mesh_dtype, make=make, shape=i):
                    self.assertEqual(sorted(every, key=lambda hit: (hit.instance, hit.triangle)), met)
                    self.assertEqual([hit.t for hit in every], sorted(hit.t for hit in met))
                    self.assertEqual(hits[i], every[0] if every else None)
                    self.assertEqual(scene.first_hit(shapes[i]), hits[i])
                    self.assertEqual((bool(blocked[i]), scene.any_hit(shapes[i])), (bool(met), bool(met)))
                    self.assertEqual(scene.overlaps(shapes[i]), any(hit.started_touching for hit in met))
                    for hit in every[:2]:
                        corners, motion = next(part[2:] for part in placed if part[:2] == (hit.instance, hit.triangle))
                        at = np.array(hit[:3], float)
                        exact = corners[0] + at[1:] @ (corners[1:] - corners[0]) + at[0] * motion
                        np.testing.assert_allclose(scene.contact_point(hit), exact, atol=np.finfo(dtype).eps * 32)
                        np.testing.assert_allclose(
                            scene.contact_normal(shapes[i], hit),
                            surehit.contact_normal(seen_from(shapes[i], motion), corners.astype(dtype)),
                            atol=np.finfo(dtype).eps * 8)
                    if every:
                        t = scene.last_free_t(shapes[i], every[0])
                        before = np.nextafter(dtype(every[0].t), dtype(0))
                        self.assertIn(t, (0,) if every[0].started_touching else (before, every[0].t))
                found += bool(met)
                touching += any(hit.started_touching for hit in met)
        self.assertTrue(0 < touching < found < 75)

    def test_brute_force(self):
        self.check(np.float32, np.float32)
        self.check(np.float64, np.float64)
        self.check(np.float64, np.float32)

    def test_what_a_reader_can_check(self):
        tile = surehit.Collider(TILE, [[0, 1, 2]], masks=[1])
        scene = surehit.Scene(np.float32)
        floor = scene.add(tile, mask=1)
        lift = scene.add(tile, surehit.translation_pose((0, 0, -2), np.float32), mask=2)
        scene.commit()
        ball = surehit.SweptSphere((2, 1, 3), (2, 1, -5), 1)
        hit = scene.first_hit(ball)
        self.assertEqual(hit, (0.25, 0.25, 0.125, 0, surehit.Feature.FACE, False, floor))
        self.assertEqual(scene.last_free_t(ball, hit), np.nextafter(np.float32(0.25), np.float32(0)))
        rest = scene.last_free_point(ball, hit)
        self.assertEqual((rest[:2].tolist(), 1 < rest[2] < 1.00001), ([2, 1], True))
        self.assertFalse(scene.any_hit(surehit.SweptSphere(ball.start, rest, 1)))
        self.assertTrue(-1 < scene.last_free_point(ball, scene.first_hit(ball, ignored_instance=floor),
                                                   filter=lambda hit: hit.instance == lift)[2] < -0.9999)
        hits = scene.all_hits(ball)
        self.assertEqual((hits.instance["index"].tolist(), hits.t.tolist()), ([floor.index, lift.index], [0.25, 0.5]))
        self.assertEqual((hits.feature.tolist(), hits.started_touching.tolist()), ([0, 0], [False, False]))
        self.assertEqual(repr(hits), "<2 hits of 2 shapes>")
        self.assertEqual(surehit.contact_point(scene.triangle(lift, 0), hits[1]).tolist(), [2, 1, -2])
        for narrowed in ({"instance_mask": 2}, {"ignored_instance": floor}, {"max_t": 1, "ignored_instance": floor},
                         {"ignored_instance": floor, "ignored_triangle": 0},
                         {"filter": lambda hit: hit.instance == lift}):
            self.assertEqual(scene.first_hit(ball, **narrowed).instance, lift)
        for narrowed in ({"mask": 2}, {"max_t": 0.125}, {"culling": "front"}):
            self.assertIsNone(scene.first_hit(ball, **narrowed))
        resting = surehit.SweptSphere((2, 1, 1), (2, 1, 9), 1)
        self.assertEqual((scene.overlaps(resting), scene.overlaps(ball)), (True, False))
        self.assertFalse(scene.overlaps(resting, instance_mask=2))
        self.assertEqual([scene.overlaps(resting, filter=lambda hit: hit.instance == instance)
                          for instance in (floor, lift)], [True, False])
        self.assertFalse(scene.any_hit(resting, ignore_start_contact=True))
        scene.set_motion(lift, (0, 0, 8))  # it comes up while the ball comes down
        scene.commit()
        hit = scene.first_hit(ball, instance_mask=2)
        self.assertEqual((hit.t, scene.contact_point(hit).tolist()), (0.25, [2, 1, 0]))
        self.assertEqual(scene.contact_normal(ball, hit).tolist(), [0, 0, 1])
        self.assertEqual(scene.snapshot().contact_point(hit).dtype, np.float32)

    def test_batches_with_filters_and_threads(self):
        tile = surehit.Collider(TILE, [[0, 1, 2]])
        scene = surehit.Scene(np.float32)
        near = scene.add(tile)
        far = scene.add(tile, surehit.translation_pose((0, 0, -2), np.float32))
        scene.commit()
        boxes = surehit.SweptBoxes(np.tile((2, 1, 3), (2000, 1)), (2, 1, -5), (1, 1, 1))
        hits = scene.first_hits(boxes, ignored_instance=[near, far] * 1000)
        self.assertEqual(hits.instance["index"][:2].tolist(), [far.index, near.index])
        with ThreadPoolExecutor(2) as pool:
            statistics = surehit.Statistics()
            again = scene.first_hits(boxes, filter=lambda i, hit: hit.instance == (near, far)[i % 2], executor=pool,
                                     statistics=statistics, out=hits)
        self.assertIs(again, hits)
        self.assertEqual((hits.t.tolist(), statistics.paths), ([0.25, 0.5] * 1000, 2000))

    def test_what_is_wrong_is_named(self):
        tile = surehit.Collider(TILE, [[0, 1, 2]])
        scene = surehit.Scene(np.float32)
        instance = scene.add(tile)
        scene.commit()
        ball = surehit.SweptSphere((2, 1, 3), (2, 1, -5), 1)
        hit = scene.first_hit(ball)
        for make, kind, named in (
                (lambda: scene.last_free_t(ball, hit._replace(instance=(3, 0))), surehit.InvalidInstance,
                 "no instance with index 3"),
                (lambda: scene.last_free_t(ball, hit._replace(triangle=1)), surehit.OutOfRange, "no triangle 1"),
                (lambda: scene.overlaps((0, 0, 0)), TypeError, "must be a moving shape, and not tuple"),
                (lambda: scene.contact_point(hit._replace(instance=(3, 0))), surehit.InvalidInstance,
                 "no instance with index 3"),
                (lambda: scene.contact_normal(ball, hit._replace(triangle=1)), surehit.OutOfRange, "no triangle 1"),
                (lambda: scene.contact_normal((0, 0, 0), hit), TypeError, "must be a moving shape, and not tuple"),
                (lambda: scene.contact_point(tile.first_hit(ball)), AttributeError, "no attribute 'instance'"),
                (lambda: scene.last_free_point(surehit.Segment((2, 1, 3), (2, 1, -5)), tile.first_hit(
                    surehit.Segment((2, 1, 3), (2, 1, -5)))), AttributeError, "no attribute 'instance'"),
                (lambda: surehit.contact_normal(surehit.Segment((2, 1, 3), (2, 1, -5)), TILE), TypeError,
                 "must be a moving shape, and not Segment"),
                (lambda: scene.first_hit(ball, min_t=0), TypeError, "there is no option min_t"),
                (lambda: scene.first_hits([ball]), TypeError, "Lines or moving shapes, and not list"),
                (lambda: scene.first_hit(surehit.SweptSphere((0, 0, 0), (0, 0, 1), np.float64(0.1))), ValueError,
                 "radius is 0.1, which is no float32")):
            with self.subTest(named=named), self.assertRaisesRegex(kind, named):
                make()
        scene.remove(instance)
        with self.assertRaises(surehit.InvalidInstance) as caught:
            scene.last_free_t(ball, hit)
        self.assertEqual((caught.exception.status, caught.exception.element), (205, instance.index))


if __name__ == "__main__":
    unittest.main()
