"""Colliders give the answers of fractions, to the bit."""

import unittest
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction

import numpy as np

import brute_force
import surehit

PATHS = (surehit.Segments, surehit.Rays, surehit.Lines)


def small_mesh(random, dtype):
    """Whole numbers, whose triangles share corners, edges and planes, and may have no area."""
    vertices = random.integers(-2, 3, (20, 3)).astype(dtype)
    return vertices, random.integers(0, len(vertices), (30, 3)).astype(np.uint32)


def uneven_mesh(random, dtype):
    """Numbers of many magnitudes."""
    vertices = (random.standard_normal((20, 3)) * 2.0 ** random.integers(-6, 3, (20, 1))).astype(dtype)
    return vertices, random.integers(0, len(vertices), (30, 3)).astype(np.uint32)


def aimed_paths(random, vertices, triangles, count):
    """Starts and ends that are corners, points of edges, points near them, and random points."""
    def points():
        corners = vertices[triangles[random.integers(0, len(triangles), count)]]
        share = random.integers(0, 5, (count, 1)) / 4
        aimed = corners[:, 0] + share * (corners[:, 1] - corners[:, 0])
        away = random.integers(-3, 4, (count, 3)) * random.integers(0, 2, (count, 1))
        return (aimed + away).astype(vertices.dtype)
    return points(), points()


class ColliderTest(unittest.TestCase):
    def check(self, make_mesh, dtype, seed):
        random = np.random.default_rng(seed)
        vertices, triangles = make_mesh(random, dtype)
        collider = surehit.Collider(vertices, triangles)
        self.assertEqual(collider.dtype, dtype)
        corners = [tuple(brute_force.exact(vertices[i]) for i in triangle) for triangle in triangles]
        starts, towards = aimed_paths(random, vertices, triangles, 40)
        for kind, make in enumerate(PATHS):
            if kind == brute_force.LINE:
                towards = np.where((towards == 0).all(axis=1)[:, None], dtype(1), towards)
            paths = make(starts, towards)
            hits, blocked = collider.first_hits(paths), collider.any_hits(paths)
            for i in range(len(paths)):
                with self.subTest(kind=kind, path=i):
                    expected = brute_force.contacts(kind, starts[i], towards[i], corners)
                    self.compare(expected, collider.all_hits(paths[i]), dtype)
                    self.compare(expected[:1], [x for x in [hits[i]] if x], dtype)
                    self.compare(expected[:1], [x for x in [collider.first_hit(paths[i])] if x], dtype)
                    self.assertEqual(blocked[i], bool(expected))
                    self.assertEqual(collider.any_hit(paths[i]), bool(expected))

    def compare(self, expected, hits, dtype):
        self.assertEqual([index for index, _ in expected], [hit.triangle for hit in hits])
        for (_, contact), hit in zip(expected, hits):
            self.assertEqual(brute_force.rounded(contact.t, dtype), hit.t)
            self.assertEqual(contact.side, hit.side)
            if contact.u is not None:
                self.assertEqual((brute_force.rounded(contact.u, dtype), brute_force.rounded(contact.v, dtype)),
                                 (hit.u, hit.v))

    def test_whole_numbers(self):
        for seed in range(3):
            self.check(small_mesh, np.float32, seed)
            self.check(small_mesh, np.float64, seed)

    def test_uneven_numbers(self):
        for seed in range(3):
            self.check(uneven_mesh, np.float32, seed)
            self.check(uneven_mesh, np.float64, seed)

    def test_options_of_each_path(self):
        random = np.random.default_rng(9)
        vertices, triangles = small_mesh(random, np.float32)
        masks = random.integers(0, 4, len(triangles)).astype(np.uint32)
        collider = surehit.Collider(vertices, triangles, masks=masks)
        corners = [tuple(brute_force.exact(vertices[i]) for i in triangle) for triangle in triangles]
        starts, ends = aimed_paths(random, vertices, triangles, 60)
        paths = surehit.Segments(starts, ends)
        options = {"min_t": random.integers(0, 3, 60) / np.float32(4),
                   "max_t": random.integers(1, 5, 60) / np.float32(4),
                   "mask": random.integers(1, 4, 60), "ignored_triangle": random.integers(0, len(triangles), 60),
                   "culling": random.choice(["none", "back", "front"], 60)}
        hits = collider.first_hits(paths, **options)
        for i in range(60):
            one = {name: values[i] for name, values in options.items()}
            limits = (Fraction(float(one[name])) for name in ("min_t", "max_t"))
            found = brute_force.contacts(brute_force.SEGMENT, starts[i], ends[i], corners, *limits)
            kept = {"none": tuple(surehit.Side), "back": (surehit.Side.FRONT,), "front": (surehit.Side.BACK,)}
            found = [(index, x) for index, x in found if masks[index] & one["mask"] and index != one["ignored_triangle"]
                     and x.side in kept[one["culling"]]]
            with self.subTest(path=i):
                self.compare(found[:1], [x for x in [hits[i]] if x], np.float32)
                self.compare(found, collider.all_hits(paths[i], **one), np.float32)

    def test_contacts_with_ends_can_be_left_out(self):
        floor = surehit.Collider([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        down = surehit.Segment((1, 1, 0), (1, 1, -1))
        self.assertTrue(floor.any_hit(down))
        self.assertFalse(floor.any_hit(down, ignore_start_contact=True))
        self.assertTrue(floor.any_hit(down, ignore_end_contact=True))
        up = surehit.Segments([(1, 1, -1)], [(1, 1, 0)])
        self.assertEqual(floor.any_hits(up, ignore_end_contact=True).tolist(), [False])

    def test_filters(self):
        stack = surehit.Collider([[0, 0, z] if i == 0 else [4, 0, z] if i == 1 else [0, 4, z]
                                  for z in range(20) for i in range(3)], np.arange(60).reshape(20, 3))
        up = surehit.Ray((1, 1, -1), (0, 0, 1))
        self.assertEqual(stack.first_hit(up, filter=lambda hit: hit.triangle >= 5).triangle, 5)
        self.assertEqual([hit.triangle for hit in stack.all_hits(up, filter=lambda hit: hit.triangle % 2)],
                         list(range(1, 20, 2)))
        self.assertEqual(len(stack.all_hits(up)), 20)
        self.assertFalse(stack.any_hit(up, filter=lambda hit: False))
        rays = surehit.Rays(np.tile((1.0, 1.0, -1.0), (5, 1)), (0, 0, 1))
        hits = stack.first_hits(rays, filter=lambda path, hit: hit.triangle == 3 * path)
        self.assertEqual(hits.triangle.tolist(), [0, 3, 6, 9, 12])
        point = stack.last_free_point(surehit.Segment((1, 1, -1), (1, 1, 4)), stack.first_hit(
            surehit.Segment((1, 1, -1), (1, 1, 4)), filter=lambda hit: hit.triangle >= 2),
            filter=lambda hit: hit.triangle >= 2)
        self.assertTrue(1 < point[2] < 2)

    def test_threads_give_the_same_bits(self):
        random = np.random.default_rng(4)
        vertices, triangles = uneven_mesh(random, np.float32)
        with ThreadPoolExecutor(3) as pool:
            collider = surehit.Collider(vertices, triangles, executor=pool)
            paths = surehit.Segments(*aimed_paths(random, vertices, triangles, 30000))
            alone, together = collider.first_hits(paths), collider.first_hits(paths, executor=pool)
            self.assertTrue((collider.any_hits(paths, executor=pool) == alone.is_hit).all())
        self.assertEqual(alone.triangle.tolist(), together.triangle.tolist())
        hit = alone.is_hit
        for name in ("t", "u", "v", "side"):
            self.assertEqual(alone.records[name][hit].tobytes(), together.records[name][hit].tobytes())

    def test_changes(self):
        vertices = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0]], np.float32)
        collider = surehit.Collider(vertices, [[0, 1, 2]])
        before = collider.copy()
        down = surehit.Segment((1, 1, 1), (1, 1, -1))
        collider.rebuild_vertices(vertices + np.float32([0, 0, 0.5]))
        self.assertEqual(collider.first_hit(down).t, 0.25)
        self.assertEqual(before.first_hit(down).t, 0.5)
        collider.set_mask(0, 4)
        self.assertEqual(collider.mask(0), 4)
        self.assertEqual([collider.any_hit(down, mask=mask) for mask in (3, 4)], [False, True])
        collider.set_masks([8])
        self.assertEqual(collider.mask(0), 8)
        collider.set_masks(None)
        self.assertEqual(collider.mask(0), surehit.ALL_BITS)
        collider.rebuild(np.empty((0, 3), np.float32), [])
        self.assertEqual((len(collider), collider.first_hit(down)), (0, None))

    def test_explanations(self):
        random = np.random.default_rng(8)
        vertices = random.integers(-8, 9, (60, 3)).astype(np.float32)
        collider = surehit.Collider(vertices, random.integers(0, 60, (200, 3)))
        decided = set()
        cells = 0
        for i in range(40):
            path = surehit.Segment(*(random.integers(-9, 10, 3).astype(np.float32) for _ in range(2)))
            ignored = int(random.integers(0, 200))
            told = collider.explain(path, ignored_triangle=ignored)
            first = collider.first_hit(path, ignored_triangle=ignored)
            self.assertEqual(told.hits[0].hit if told.hits else None, first)
            met = {one.triangle for one in told.candidates if one.outcome == surehit.PairOutcome.HIT}
            self.assertEqual({one.hit.triangle for one in told.hits}, met)
            self.assertNotIn(ignored, met)
            for one in told.hits:
                self.assertTrue(one.t_lower <= one.t_upper)
            for one in told.candidates:
                decided.add(one.decided_by)
                self.assertEqual(one.numbers is None, one.filter_verdict == surehit.FilterVerdict.NOT_ASKED)
            for cell in told.cells:
                self.assertTrue(all(low <= high for low, high in zip(*cell.box)))
                self.assertLessEqual(cell.first_candidate + cell.candidate_count, len(told.candidates))
            cells += len(told.cells) if told.walk == surehit.Walk.CELLS else 0
        self.assertGreater(cells, 40)
        self.assertIn(surehit.DecidedBy.FILTER, decided)
        with self.assertRaisesRegex(TypeError, "no option side"):
            collider.explain(path, side=1)
        with self.assertRaisesRegex(TypeError, "a Ray or a Line, and not tuple"):
            collider.explain((0, 0, 0))

    def test_what_it_tells(self):
        collider = surehit.Collider([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        ray = surehit.Ray((1, 1, 3), (0, 0, -1))
        hit = collider.first_hit(ray)
        self.assertEqual((collider.max_t_keeping(ray, hit), surehit.distance(ray, hit)), (3, 3))
        self.assertEqual(surehit.point(ray, hit).tolist(), [1, 1, 0])
        self.assertEqual(collider.normal(0).tolist(), [0, 0, 1])
        self.assertEqual(collider.triangle(0).tolist(), [[0, 0, 0], [4, 0, 0], [0, 4, 0]])
        self.assertEqual([corner.tolist() for corner in collider.box()], [[0, 0, 0], [4, 4, 0]])
        self.assertGreater(collider.memory_bytes, 0)
        self.assertEqual(collider.grid_summary().resolution[2], 1)
        self.assertEqual(surehit.intersect(ray, collider.triangle(0)), hit)
        statistics = surehit.Statistics()
        collider.first_hit(ray, statistics=statistics)
        collider.any_hits(surehit.Rays([ray.start] * 4, ray.toward), statistics=statistics)
        self.assertEqual(statistics.paths, 5)


if __name__ == "__main__":
    unittest.main()
