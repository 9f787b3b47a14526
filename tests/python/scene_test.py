"""Scenes give the answers of fractions about the exact images of their meshes, to the bit."""

import unittest
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction

import numpy as np

import brute_force
import surehit

BOX = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], np.float32)
SIDES = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6],
                  [0, 6, 4], [1, 5, 7], [1, 7, 3]])


def placed(pose, point):
    rows = [[Fraction(float(x)) for x in row] for row in pose]
    return tuple(sum(rows[i][j] * point[j] for j in range(3)) + rows[i][3] for i in range(3))


class SceneTest(unittest.TestCase):
    def check(self, dtype, mesh_dtype, seed):
        random = np.random.default_rng(seed)
        box = surehit.Collider(BOX.astype(mesh_dtype), SIDES)
        scene = surehit.Scene(dtype)
        corners, motions, names = [], [], []
        for i in range(6):
            pose = np.column_stack([random.integers(-2, 3, (3, 3)) / 2 + 2 * np.eye(3), random.integers(-4, 5, 3)])
            pose = pose.astype(dtype) if i else surehit.rigid_pose((0.5, 0.5, 0.5, 0.5), (1, 2, 3), dtype)
            instance = scene.add(box, pose, user_data=7 * i)
            motion = random.integers(-2, 3, 3).astype(dtype)
            scene.set_motion(instance, motion)
            self.assertEqual(scene.pose(instance).tolist(), pose.tolist())
            self.assertEqual(scene.motion(instance).tolist(), motion.tolist())
            for index, triangle in enumerate(SIDES):
                corners.append(tuple(placed(pose, brute_force.exact(BOX[k])) for k in triangle))
                motions.append(brute_force.exact(motion))
                names.append((instance, index))
        scene.commit()
        starts, towards = random.integers(-6, 7, (2, 60, 3)).astype(dtype)
        for kind, make in enumerate((surehit.Segments, surehit.Rays)):
            paths = make(starts, towards)
            hits, blocked = scene.first_hits(paths), scene.any_hits(paths)
            for i in range(len(paths)):
                expected = brute_force.contacts(kind, starts[i], towards[i], corners, motions=motions)
                with self.subTest(kind=kind, path=i):
                    found = scene.all_hits(paths[i])
                    self.assertEqual([names[index] for index, _ in expected], [(x.instance, x.triangle) for x in found])
                    self.assertEqual([(brute_force.rounded(x.t, dtype), x.side) for _, x in expected],
                                     [(x.t, x.side) for x in found])
                    self.assertEqual(hits[i], found[0] if len(found) else None)
                    self.assertEqual(scene.first_hit(paths[i]), hits[i])
                    self.assertEqual((blocked[i], scene.any_hit(paths[i])), (bool(expected),) * 2)

    def test_float32(self):
        self.check(np.float32, np.float32, 1)

    def test_float64_with_meshes_of_both(self):
        self.check(np.float64, np.float64, 2)
        self.check(np.float64, np.float32, 3)

    def test_options_and_filters(self):
        box = surehit.Collider(BOX, SIDES)
        scene = surehit.Scene(np.float32)
        near = scene.add(box, mask=1)
        far = scene.add(box, surehit.translation_pose((4, 0, 0), np.float32), mask=2)
        self.assertIsNone(scene.first_hit(surehit.Ray((-1, 0.5, 0.5), (1, 0, 0))))
        with ThreadPoolExecutor(2) as pool:
            scene.commit(executor=pool)
        ray = surehit.Ray((-1, 0.5, 0.5), (1, 0, 0))
        self.assertEqual(scene.first_hit(ray).instance, near)
        self.assertEqual(scene.first_hit(ray, instance_mask=2).instance, far)
        self.assertEqual(scene.first_hit(ray, ignored_instance=near).instance, far)
        hit = scene.first_hit(ray)
        again = scene.first_hit(ray, ignored_instance=near, ignored_triangle=hit.triangle)
        self.assertEqual((again.instance, again.triangle == hit.triangle), (near, False))
        self.assertEqual(scene.first_hit(ray, filter=lambda hit: hit.instance == far).t, 5)
        rays = surehit.Rays([ray.start] * 3, ray.toward)
        hits = scene.first_hits(rays, ignored_instance=[near, far, (9, 9)])
        self.assertEqual(hits.instance["index"].tolist(), [far.index, near.index, near.index])
        hits = scene.first_hits(rays, filter=lambda path, hit: path != 1)
        self.assertEqual(hits.is_hit.tolist(), [True, False, True])
        step = surehit.Segment((-1, 0.5, 0.5), (1, 0.5, 0.5))
        self.assertLess(scene.last_free_point(step, scene.first_hit(step))[0], 0)
        step = surehit.Segment((-1, 0.5, 0.5), (9, 0.5, 0.5))
        hit = scene.first_hit(step, ignored_instance=near)
        self.assertTrue(3.9 < scene.last_free_point(step, hit, ignored_instance=near)[0] < 4)
        self.assertEqual((scene.user_data(far), scene.mask(far), scene.triangle_count(far)), (0, 2, 12))
        self.assertEqual(scene.triangle(far, 0).tolist(), [[4, 0, 0], [4, 0, 1], [4, 1, 1]])
        self.assertEqual(scene.normal(far, 0).tolist(), [-1, 0, 0])

    def test_instances_come_and_go(self):
        scene = surehit.Scene()
        box = surehit.Collider(BOX, SIDES)
        first, second = scene.add(box), scene.add(box, np.eye(4))
        del box  # the scene keeps its share
        self.assertEqual((len(scene), scene.instances()), (2, [first, second]))
        scene.remove(first)
        scene.commit()
        self.assertEqual((first in scene, second in scene), (False, True))
        with self.assertRaises(surehit.InvalidInstance) as caught:
            scene.set_pose(first, np.eye(4))
        self.assertEqual((caught.exception.status, caught.exception.element), (205, first.index))
        self.assertEqual(scene.first_hit(surehit.Ray((-1, 0.5, 0.5), (1, 0, 0))).instance, second)

    def test_instance_gets_another_collider(self):
        ray = surehit.Ray((-1, 0.5, 0.5), (1, 0, 0))
        scene, box = surehit.Scene(), surehit.Collider(BOX, SIDES)
        instance = scene.add(box, user_data=3)
        for dtype in (np.float32, np.float64):
            scene.set_collider(instance, surehit.Collider(BOX.astype(dtype) + 1, SIDES))
            scene.commit()
            self.assertIsNone(scene.first_hit(ray))
            scene.set_collider(instance, box)
            scene.commit()
            self.assertEqual((scene.first_hit(ray).t, scene.first_hit(ray).instance), (1, instance))
        self.assertEqual(scene.user_data(instance), 3)
        with self.assertRaises(TypeError):
            surehit.Scene(np.float32).set_collider(instance, surehit.Collider(BOX.astype(np.float64), SIDES))
        with self.assertRaises(TypeError):
            scene.set_collider(instance, BOX)
        scene.remove(instance)
        with self.assertRaises(surehit.InvalidInstance):
            scene.set_collider(instance, box)

    def test_snapshots_stay_the_same(self):
        scene, box = surehit.Scene(np.float32), surehit.Collider(BOX, SIDES)
        instance = scene.add(box, surehit.translation_pose((4, 0, 0), np.float32), user_data=3)
        self.assertEqual(len(scene.snapshot()), 0)  # it was not committed
        scene.commit()
        snapshot = scene.snapshot()
        ray = surehit.Ray((-1, 0.5, 0.5), (1, 0, 0))
        expected = scene.first_hit(ray)
        scene.set_pose(instance, surehit.translation_pose((9, 0, 0), np.float32))
        scene.add(box)
        scene.commit()
        self.assertEqual((scene.first_hit(ray).t, len(scene)), (1, 2))
        self.assertFalse(hasattr(snapshot, "memory_bytes"))  # it shares its memory with the scene
        self.assertGreater(scene.memory_bytes, 0)
        again = snapshot.snapshot()
        del scene, box, snapshot  # a snapshot keeps its share
        self.assertEqual((again.first_hit(ray), again.first_hits(surehit.Rays([ray.start], ray.toward))[0]),
                         (expected, expected))
        ball = surehit.SweptSphere((-1, 0.5, 0.5), (9, 0.5, 0.5), 0.25)
        self.assertEqual(again.first_hit(ball).instance, instance)
        self.assertEqual((again.instances(), again.user_data(instance), again.pose(instance)[0, 3]), ([instance], 3, 4))
        self.assertFalse(hasattr(again, "commit"))

    def test_poses_that_cannot_be_used(self):
        scene, box = surehit.Scene(), surehit.Collider(BOX, SIDES)
        singular = np.zeros((3, 4))
        infinite = np.eye(4)[:3]
        infinite[1, 3] = np.inf
        for pose, status in ((singular, 203), (infinite, 201), (np.eye(4)[:3] * 1e-30, 202)):
            with self.assertRaises(surehit.InvalidInstance) as caught:
                scene.add(box, pose)
            self.assertEqual(caught.exception.status, status)
        for pose in (np.eye(3), 2 * np.eye(4)):
            with self.assertRaises(ValueError):
                scene.add(box, pose)
        self.assertEqual(len(scene), 0)
        with self.assertRaisesRegex(ValueError, r"pose\[0\]\[3\] is 0.1, which is no float32"):
            surehit.Scene(np.float32).add(box, surehit.translation_pose((0.1, 0, 0)))


if __name__ == "__main__":
    unittest.main()
