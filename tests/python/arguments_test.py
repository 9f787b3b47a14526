"""Arrays are read where they are, nothing is rounded unseen, and errors name the element."""

import ctypes
import gc
import sys
import threading
import time
import unittest
from concurrent.futures import Executor, Future, ThreadPoolExecutor

import numpy as np

import surehit
from surehit import _layouts, _numbers
from surehit._library import function

FLOOR = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0]], np.float32)
TRIANGLE = np.array([[0, 1, 2]], np.uint32)


class ArgumentsTest(unittest.TestCase):
    def test_layouts_that_are_not_copied(self):
        numbers = np.zeros((5, 8), np.float32)
        for array in (numbers[:, :3], numbers[::2, 3:6], np.zeros((5, 3), np.float32)):
            self.assertTrue(np.shares_memory(_numbers.rows(array, array.dtype, "array"), array))
        for array in (numbers[::-1, :3], numbers[:, 6:3:-1], np.asfortranarray(numbers[:, :3]),
                      np.broadcast_to(numbers[0, :3], (5, 3))):
            copied = _numbers.rows(array, array.dtype, "array")
            self.assertFalse(np.shares_memory(copied, array))
            self.assertTrue(copied.flags.c_contiguous)
        for kind in (np.uint16, np.uint32, np.int32):
            array = np.zeros((5, 4), kind)[:, :3]
            self.assertTrue(np.shares_memory(_numbers.indices(array, "array"), array))

    def test_halves_of_six_numbers_are_read_side_by_side(self):
        numbers = np.zeros((5, 6), np.float32)
        struct, _ = surehit.Segments(numbers[:, :3], numbers[:, 3:]).struct(_layouts.FLOAT)
        self.assertEqual((struct.towards, struct.start_stride), (None, 0))

    def test_every_layout_has_the_same_answers(self):
        random = np.random.default_rng(1)
        level = surehit.Collider(FLOOR, TRIANGLE)
        numbers = random.uniform(-1, 5, (200, 6)).astype(np.float32)
        expected = level.first_hits(surehit.Segments(numbers[:, :3].copy(), numbers[:, 3:].copy()))
        self.assertTrue(0 < np.count_nonzero(expected.is_hit) < 200)
        wide = np.zeros((400, 9), np.float32)
        wide[::2, :6] = numbers
        for starts, ends in ((numbers[:, :3], numbers[:, 3:]), (wide[::2, :3], wide[::2, 3:6]),
                             (np.asfortranarray(numbers)[:, :3], numbers[::-1, 3:][::-1]),
                             (numbers[:, :3].astype(np.float64), numbers[:, 3:].astype(">f4")),
                             (numbers[:, :3].tolist(), numbers[:, 3:].tolist())):
            hits = level.first_hits(surehit.Segments(starts, ends))
            self.assertEqual(hits.triangle.tolist(), expected.triangle.tolist())
            self.assertEqual(hits.t[hits.is_hit].tolist(), expected.t[expected.is_hit].tolist())

    def test_changed_arrays_are_read_again(self):
        level = surehit.Collider(FLOOR, TRIANGLE)
        for dtype in (np.float32, np.float64):
            starts = np.array([[1, 1, 1]], dtype)
            paths = surehit.Segments(starts, np.array([[1, 1, -1]], dtype))
            self.assertTrue(level.any_hits(paths)[0])
            starts[0] = (9, 9, 1)
            self.assertFalse(level.any_hits(paths)[0])

    def test_the_type_of_numbers(self):
        for vertices, dtype in ((FLOOR, np.float32), (FLOOR.astype(np.float16), np.float32),
                                (FLOOR.tolist(), np.float64), (FLOOR.astype(np.int64), np.float64),
                                (FLOOR.astype(np.float64), np.float64)):
            self.assertEqual(surehit.Collider(vertices, TRIANGLE).dtype, dtype)
        self.assertEqual(surehit.Collider(FLOOR.tolist(), [[0, 1, 2]], dtype=np.float32).dtype, np.float32)
        with self.assertRaises(TypeError):
            surehit.Collider(FLOOR, TRIANGLE, dtype=np.int32)
        with self.assertRaises(TypeError):
            surehit.Collider(FLOOR.astype(complex), TRIANGLE)

    def test_nothing_is_rounded_unseen(self):
        level = surehit.Collider(FLOOR, TRIANGLE)
        starts = np.zeros((4, 3))
        starts[2, 1] = 0.1
        with self.assertRaisesRegex(ValueError, r"starts\[2\]\.y is 0\.1, which is no float32"):
            level.first_hits(surehit.Segments(starts, starts))
        with self.assertRaisesRegex(ValueError, r"start\.y is 0\.1, which is no float32"):
            level.first_hit(surehit.Segment(starts[2], starts[2]))
        with self.assertRaisesRegex(ValueError, r"max_t is 0\.1, which is no float32"):
            level.first_hit(surehit.Ray((0, 0, 0), (0, 0, 1)), max_t=np.float64(0.1))
        with self.assertRaisesRegex(ValueError, r"vertices\[1\]\.x is 9007199254740993, which is no float64"):
            surehit.Collider(np.array([[0, 0, 0], [2**53 + 1, 0, 0]]), [[0, 1, 1]])
        with self.assertRaisesRegex(ValueError, r"vertices\[0\]\.x is 18446744073709551615"):
            surehit.Collider(np.array([[2**64 - 1, 0, 0]], np.uint64), [[0, 0, 0]])
        with self.assertRaisesRegex(ValueError, r"vertices\[0\]\.z is 1e\+300"):
            surehit.Collider([[0, 0, 1e300]], [[0, 0, 0]], dtype=np.float32)
        with self.assertRaisesRegex(ValueError, r"start\.x is 1e\+300"):
            level.first_hit(surehit.Segment((1e300, 0, 0), (0, 0, 0)))
        # Plain numbers have no width of their own.
        self.assertAlmostEqual(level.first_hit(surehit.Ray((0.1, 0.1, 1), (0, 0, -1))).u, 0.025)

    def test_paths_that_are_not_finite_hit_nothing(self):
        level = surehit.Collider(FLOOR, TRIANGLE)
        for number in (np.nan, np.inf):
            self.assertIsNone(level.first_hit(surehit.Segment((1, 1, number), (1, 1, -1))))
            self.assertFalse(level.any_hits(surehit.Segments([[1, 1, number]], np.array([[1.0, 1, -1]])))[0])

    def test_meshes_that_cannot_be_used(self):
        bad = FLOOR.copy()
        bad[1, 2] = np.nan
        cases = ((bad, TRIANGLE, 102, 1), (FLOOR, np.array([[0, 1, 2], [0, 1, 3]], np.uint32), 101, 1),
                 (FLOOR, np.array([[0, 1, 2], [0, 1, 3]], np.uint16), 101, 1))
        collider = surehit.Collider(FLOOR, TRIANGLE)
        for vertices, triangles, status, element in cases:
            for build in (surehit.Collider, collider.rebuild):
                with self.assertRaises(surehit.InvalidMesh) as caught:
                    build(vertices, triangles)
                self.assertEqual((caught.exception.status, caught.exception.element), (status, element))
                self.assertNotIn("surehit_", str(caught.exception))
        with self.assertRaisesRegex(IndexError, r"triangles\[1\]\[2\] is -1"):
            surehit.Collider(FLOOR, [[0, 1, 2], [0, 1, -1]])
        with self.assertRaisesRegex(IndexError, r"triangles\[0\]\[0\] is 4294967296"):
            surehit.Collider(FLOOR, [[2**32, 1, 2]])
        with self.assertRaises(TypeError):
            surehit.Collider(FLOOR, [[0.0, 1.0, 2.0]])
        with self.assertRaisesRegex(ValueError, "2 masks for 1 triangles"):
            surehit.Collider(FLOOR, TRIANGLE, masks=[1, 2])
        for refuse in (lambda: surehit.Collider(FLOOR, TRIANGLE, masks=[]), lambda: collider.set_masks([])):
            with self.assertRaisesRegex(ValueError, "0 masks for 1 triangles"):
                refuse()
        with self.assertRaisesRegex(ValueError, r"masks\[0\] is -1"):
            surehit.Collider(FLOOR, TRIANGLE, masks=[-1])
        with self.assertRaises(surehit.InvalidMesh):
            collider.rebuild_vertices(FLOOR[:2])
        for vertices, triangles in ((FLOOR.ravel(), TRIANGLE), (FLOOR, TRIANGLE.ravel()), (FLOOR[:, :2], TRIANGLE)):
            with self.assertRaisesRegex(ValueError, "must have the shape"):
                surehit.Collider(vertices, triangles)
        self.assertEqual(collider.first_hit(surehit.Ray((1, 1, 1), (0, 0, -1))).t, 1)

    def test_arguments_that_cannot_be_used(self):
        level = surehit.Collider(FLOOR, TRIANGLE)
        ray, rays = surehit.Ray((1, 1, 1), (0, 0, -1)), surehit.Rays([[1, 1, 1]] * 3, (0, 0, -1))
        for error, call in (
                (TypeError, lambda: level.first_hit(((1, 1, 1), (0, 0, -1)))),
                (TypeError, lambda: level.first_hits(ray)),
                (TypeError, lambda: level.first_hit(ray, maxt=1)),
                (ValueError, lambda: level.first_hit(ray, culling="both")),
                (ValueError, lambda: level.first_hit(ray, mask=-1)),
                (TypeError, lambda: level.first_hit(ray, mask=1.5)),
                (ValueError, lambda: level.first_hits(rays, max_t=[1, 2])),
                (ValueError, lambda: level.first_hits(rays, max_t=[1])),
                (TypeError, lambda: level.first_hits(rays, instance_mask=1)),
                (ValueError, lambda: level.any_hits(rays, out=np.empty(2, np.bool_))),
                (ValueError, lambda: level.any_hits(rays, out=np.empty(6, np.bool_)[::2])),
                (surehit.OutOfRange, lambda: level.normal(1)), (IndexError, lambda: level.normal(2**32)),
                (IndexError, lambda: level.set_mask(-1, 0)), (ValueError, lambda: level.set_mask(0, 2**32)),
                (surehit.InvalidValue, lambda: level.last_free_point(ray, level.first_hit(ray))),
                (ValueError, lambda: surehit.Segments([[0, 0, 0]] * 2, [[0, 0, 0]] * 3)),
                (ValueError, lambda: surehit.Segments([[0, 0]], [[0, 0]])),
                (ValueError, lambda: surehit.Ray((0, 0), (1, 1, 1))),
                (IndexError, lambda: rays[3]), (TypeError, lambda: surehit.Path((0, 0, 0), (0, 0, 0))),
                (TypeError, lambda: surehit.Paths([[0, 0, 0]], [[0, 0, 0]]))):
            with self.assertRaises(error):
                call()

    def test_exceptions_of_filters_end_the_query(self):
        level = surehit.Collider(FLOOR, TRIANGLE)
        calls = []

        def fail(*arguments):
            calls.append(arguments)
            raise LookupError("no material")

        for ask in (lambda: level.first_hit(surehit.Ray((1, 1, 1), (0, 0, -1)), filter=fail),
                    lambda: level.first_hits(surehit.Rays([[1, 1, 1]] * 50, (0, 0, -1)), filter=fail)):
            calls.clear()
            with self.assertRaisesRegex(LookupError, "no material"):
                ask()
            self.assertEqual(len(calls), 1)

    def test_a_pool_that_takes_no_tasks(self):
        pool = ThreadPoolExecutor(1)
        pool.shutdown()
        rays = surehit.Rays(np.ones((20000, 3), np.float32), (0, 0, -1))
        with self.assertRaises(RuntimeError):
            surehit.Collider(FLOOR, TRIANGLE).first_hits(rays, executor=pool)

        level = surehit.Collider(FLOOR, TRIANGLE)
        with self.assertRaises(RuntimeError):
            level.rebuild(FLOOR, np.repeat(TRIANGLE, 20000, axis=0), executor=pool)
        self.assertEqual(len(level), 20000)

    def test_tasks_that_a_pool_keeps_for_later_are_not_done(self):
        kept = []

        class InterruptedPool(Executor):
            def submit(self, task, /, *arguments):
                kept.append((task, arguments))
                if len(kept) == 2:
                    raise KeyboardInterrupt
                return Future()

        rays = surehit.Rays(np.ones((20000, 3), np.float32), (0, 0, -1))
        level = surehit.Collider(FLOOR, TRIANGLE)
        hits = level.first_hits(rays)
        with self.assertRaises(KeyboardInterrupt):
            level.first_hits(rays, executor=InterruptedPool(), out=hits)
        self.assertTrue((hits.t == 1).all())
        hits.records[:] = np.zeros(1, hits.records.dtype)
        for task, arguments in kept:
            task(*arguments)
        self.assertEqual(len(kept), 2)
        self.assertFalse(hits.t.any())

    def test_results(self):
        level = surehit.Collider(FLOOR, TRIANGLE)
        rays = surehit.Rays([[1, 1, 1], [9, 9, 9], [1, 2, 3]], (0, 0, -1))
        hits = level.first_hits(rays)
        self.assertTrue(np.shares_memory(hits.t, hits.records))
        self.assertEqual((hits.is_hit.tolist(), hits[1], hits[2].t, len(hits), repr(hits)),
                         ([True, False, True], None, 3, 3, "<2 hits of 3 paths>"))
        self.assertEqual([hit.t for hit in hits[hits.is_hit]], [1, 3])
        with self.assertRaises(AttributeError):
            hits.instance
        again = level.first_hits(surehit.Rays([[9, 9, 9]] * 3, (0, 0, -1)), out=hits)
        self.assertTrue(again is hits and not hits.is_hit.any())
        blocked = np.ones(3, np.bool_)
        self.assertTrue(level.any_hits(rays, out=blocked) is blocked)
        self.assertEqual(blocked.tolist(), [True, False, True])
        self.assertEqual(len(level.first_hits(surehit.Rays(np.empty((0, 3)), np.empty((0, 3))))), 0)

    def test_memory_is_given_up(self):
        level = surehit.Collider(FLOOR, TRIANGLE)
        finalizer, handle = level._finalizer, level._handle
        del level
        gc.collect()
        self.assertFalse(finalizer.alive)
        self.assertEqual(function("colliderf_memory_bytes")(handle, ctypes.byref(ctypes.c_size_t())), 5)

    def test_the_lock_of_the_interpreter_is_free(self):
        random = np.random.default_rng(3)
        vertices = random.uniform(0, 1, (30000, 3)).astype(np.float32)
        level = surehit.Collider(vertices, np.arange(30000).reshape(-1, 3))
        paths = surehit.Rays(*random.uniform(-1, 1, (2, 100000, 3)).astype(np.float32))
        interval = sys.getswitchinterval()
        # So a thread has the lock until it gives it away.
        sys.setswitchinterval(60)
        try:
            self.assertTrue(any(self.runs_beside(lambda: level.any_hits(paths)) for _ in range(50)))
        finally:
            sys.setswitchinterval(interval)

    @staticmethod
    def runs_beside(call):
        """Returns whether this thread did anything while another one was inside the call."""
        times, ticks = [], []

        def ask():
            times.append(time.perf_counter())
            call()
            times.append(time.perf_counter())

        thread = threading.Thread(target=ask)
        thread.start()
        while thread.is_alive():
            ticks.append(time.perf_counter())
            time.sleep(0)  # gives the lock away
        return any(times[0] < tick < times[1] for tick in ticks)


if __name__ == "__main__":
    unittest.main()
