"""The queries that colliders and scenes have alike, about paths and about moving shapes."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from concurrent.futures import Executor
from ctypes import byref, c_size_t, c_uint8
from types import SimpleNamespace
from typing import Any, Generic, overload

import numpy as np
from numpy.typing import NDArray

from ._layouts import NO_TRIANGLE, Layouts, Statistics
from ._library import check, function
from ._options import AskedOptions, Raised, executor_pointer, filter_struct
from .hits import (Hit, Hits, PathHit, ShapeHit, TouchHit, hit_of, scene_hit_of, scene_shape_hit_of,
                   shape_hit_of)
from .paths import Path, Paths, Segment
from .shapes import SweptShape, SweptShapes

_FEW_HITS = 16
_CALLS = ("first_hit", "any_hit", "all_hits", "first_hits", "any_hits")


class Subject:
    """What is asked about: the paths or the shapes that come to colliders or scenes. It has their types and functions.
    """

    def __init__(self, layouts: Layouts, kind: SimpleNamespace, prefix: str, hit_of: Callable[[Any], Any],
                 calls: tuple[str, ...] = _CALLS) -> None:
        self.kind = kind
        self.hit_of = hit_of
        self.options = AskedOptions(layouts, kind)
        self.calls = {name: function(prefix + name) for name in calls}


class Queries(Generic[PathHit, TouchHit]):
    """What can be asked of a collider or of a scene. Many threads may ask at once, and the interpreter's lock is free.

    Options narrow a query: see ``surehit.Options``. A filter decides which hits count. A single query calls
    ``filter(hit)``, and a batch calls ``filter(path, hit)`` with the index of the path. It must depend on its arguments
    alone. An exception that leaves it ends the query, and leaves the query too.
    """

    _handle: Any

    def _set_kind(self, layouts: Layouts, word: str) -> None:
        self._layouts = layouts
        self._prefix = f"{word}{layouts.suffix}_"
        shape_prefix = self._prefix + "shape_"
        shape_calls = (*_CALLS, "overlaps")
        if word == "collider":
            self._paths = Subject(layouts, layouts.collider, self._prefix, hit_of)
            self._shapes = Subject(layouts, layouts.shape, shape_prefix, shape_hit_of, shape_calls)
        else:
            self._paths = Subject(layouts, layouts.scene, self._prefix, scene_hit_of)
            self._shapes = Subject(layouts, layouts.scene_shape, shape_prefix, scene_shape_hit_of, shape_calls)

    def _function(self, name: str) -> Any:
        return function(self._prefix + name)

    @property
    def dtype(self) -> np.dtype[Any]:
        """float32 or float64, which all numbers of queries and hits have."""
        return self._layouts.dtype

    def _subject_of(self, path: Any) -> Subject:
        if isinstance(path, Path):
            return self._paths
        if not isinstance(path, SweptShape):
            raise TypeError("the path must be a Segment, a Ray, a Line or a moving shape, and not "
                            f"{type(path).__name__}")
        return self._shapes

    def _subject_of_batch(self, paths: Any) -> Subject:
        if isinstance(paths, Paths):
            return self._paths
        if not isinstance(paths, SweptShapes):
            raise TypeError("the paths must be Segments, Rays, Lines or moving shapes, and not "
                            f"{type(paths).__name__}")
        return self._shapes

    def _single(self, subject: Subject, name: str, path: Path | SweptShape, options: dict[str, Any],
                accepts: Callable[[Any], Any] | None, statistics: Statistics | None, *results: Any) -> None:
        raised = chosen = None
        if accepts is not None:
            raised = Raised()
            chosen = byref(filter_struct(subject.kind, accepts, subject.hit_of, raised, False))
        asked = byref(subject.options.single(options)) if options else None
        status = subject.calls[name](self._handle, byref(path.struct(self._layouts)), asked, chosen,
                                     None if statistics is None else byref(statistics), *results)
        if raised is not None:
            raised.check(status)
        elif status != 0:
            check(status)

    @overload
    def first_hit(self, path: Path, *, filter: Callable[[PathHit], Any] | None = None,
                  statistics: Statistics | None = None, **options: Any) -> PathHit | None: ...

    @overload
    def first_hit(self, path: SweptShape, *, filter: Callable[[TouchHit], Any] | None = None,
                  statistics: Statistics | None = None, **options: Any) -> TouchHit | None: ...

    def first_hit(self, path: Path | SweptShape, *, filter: Callable[[Any], Any] | None = None,
                  statistics: Statistics | None = None, **options: Any) -> Any:
        """Returns the hit with the lowest exact t, and among equal ones that of the lowest ids. None is a miss."""
        subject = self._subject_of(path)
        hit = subject.kind.Hit()
        self._single(subject, "first_hit", path, options, filter, statistics, byref(hit))
        return None if hit.triangle == NO_TRIANGLE else subject.hit_of(hit)

    def any_hit(self, path: Path | SweptShape, *, filter: Callable[[Any], Any] | None = None,
                statistics: Statistics | None = None, **options: Any) -> bool:
        """Returns whether the path hits anything. It is cheaper than ``first_hit``."""
        blocked = c_uint8()
        self._single(self._subject_of(path), "any_hit", path, options, filter, statistics, byref(blocked))
        return blocked.value != 0

    @overload
    def all_hits(self, path: Path, *, filter: Callable[[PathHit], Any] | None = None,
                 statistics: Statistics | None = None, **options: Any) -> Hits[PathHit]: ...

    @overload
    def all_hits(self, path: SweptShape, *, filter: Callable[[TouchHit], Any] | None = None,
                 statistics: Statistics | None = None, **options: Any) -> Hits[TouchHit]: ...

    def all_hits(self, path: Path | SweptShape, *, filter: Callable[[Any], Any] | None = None,
                 statistics: Statistics | None = None, **options: Any) -> Any:
        """Returns the hits of all triangles that the path meets, in the order of exact t, and then of ids."""
        subject = self._subject_of(path)
        room = _FEW_HITS
        count = c_size_t()
        while True:
            records = np.empty(room, subject.kind.hit_dtype)
            self._single(subject, "all_hits", path, options, filter, statistics if room == _FEW_HITS else None,
                         records.ctypes.data, room, byref(count))
            if count.value <= room:
                return Hits(records[:count.value])
            room = count.value

    @overload
    def last_free_point(self, segment: Segment, hit: PathHit, *, filter: Callable[[PathHit], Any] | None = None,
                        **options: Any) -> NDArray[Any]: ...

    @overload
    def last_free_point(self, segment: SweptShape, hit: TouchHit, *, filter: Callable[[TouchHit], Any] | None = None,
                        **options: Any) -> NDArray[Any]: ...

    def last_free_point(self, segment: Segment | SweptShape, hit: Any, *,
                        filter: Callable[[Any], Any] | None = None, **options: Any) -> NDArray[Any]:
        """Returns where a point that moves along a segment may stop, in front of its first hit under these options.

        The way from the start to it has no hit, so a step that ends there never tunnels. For a moving shape, it is
        where its centre may stop.
        """
        is_shape = isinstance(segment, SweptShape)
        subject = self._subject_of(segment)
        struct = self._struct_of_touch(hit) if is_shape else self._struct_of_hit(hit)
        point = np.empty(3, self.dtype)
        raised = Raised()
        asked = subject.options.single(options)
        chosen = None
        if filter is not None:
            chosen = filter_struct(subject.kind, filter, subject.hit_of, raised, False)
        raised.check(self._function("shape_last_free_point" if is_shape else "last_free_point")(
            self._handle, byref(segment.struct(self._layouts)), byref(struct), None if asked is None else byref(asked),
            None if chosen is None else byref(chosen), point.ctypes.data))
        return point

    def overlaps(self, shape: SweptShape, *, filter: Callable[[TouchHit], Any] | None = None,
                 statistics: Statistics | None = None, **options: Any) -> bool:
        """Returns whether a shape touches anything at its start. Its end plays no part, and neither do ``max_t``,
        ``culling`` and ``ignore_start_contact``.

        A filter is given the hits of the shape at rest.
        """
        touches = c_uint8()
        self._single(self._shapes_of(shape), "overlaps", shape, options, filter, statistics, byref(touches))
        return touches.value != 0

    def last_free_t(self, shape: SweptShape, hit: TouchHit) -> float:
        """Returns the maximum t at which a shape has not touched the triangle of one of its hits yet.

        For the first hit, it has touched nothing until then. It is 0 if they touch at the start.
        """
        self._shapes_of(shape)
        t = self._layouts.real()
        check(self._function("shape_last_free_t")(self._handle, byref(shape.struct(self._layouts)),
                                                  byref(self._struct_of_touch(hit)), byref(t)))
        return float(t.value)

    def _shapes_of(self, shape: SweptShape) -> Subject:
        if not isinstance(shape, SweptShape):
            raise TypeError(f"the shape must be a moving shape, and not {type(shape).__name__}")
        return self._shapes

    def _struct_of_touch(self, hit: Any) -> Any:
        struct = self._shapes.kind.Hit(hit.t, hit.u, hit.v, hit.triangle, int(hit.feature), hit.started_touching)
        if hasattr(struct, "instance") or not isinstance(hit, ShapeHit):
            struct.instance.index, struct.instance.generation = hit.instance
        return struct

    def _struct_of_hit(self, hit: Any) -> Any:
        struct = self._paths.kind.Hit(hit.t, hit.u, hit.v, hit.triangle, int(hit.side))
        if hasattr(struct, "instance") or not isinstance(hit, Hit):
            struct.instance.index, struct.instance.generation = hit.instance
        return struct

    def _batch(self, subject: Subject, name: str, paths: Paths | SweptShapes, options: dict[str, Any],
               accepts: Callable[[int, Any], Any] | None, executor: Executor | None, statistics: Statistics | None,
               answers: NDArray[Any]) -> None:
        raised = each = asked = None
        if options or accepts is not None or executor is not None or statistics is not None:
            raised = Raised()
            asked, each = self._batch_options(subject, options, len(paths), accepts, executor, statistics, raised)
        struct, arrays = paths.struct(self._layouts)
        status = subject.calls[name](self._handle, byref(struct), asked, answers.ctypes.data)
        if raised is not None:
            raised.check(status)
        elif status != 0:
            check(status)
        del arrays, each  # they had to live until here

    @staticmethod
    def _batch_options(subject: Subject, options: dict[str, Any], count: int,
                       accepts: Callable[[int, Any], Any] | None, executor: Executor | None,
                       statistics: Statistics | None, raised: Raised) -> tuple[Any, Any]:
        """Returns a pointer to the options of a batch, and the array that must live as long."""
        asked = subject.kind.BatchOptions(ctypes.sizeof(subject.kind.BatchOptions))
        each = None
        if options:
            single, each = subject.options.batch(options, count)
            asked.options = None if single is None else ctypes.pointer(single)
            asked.path_options = None if each is None else each.ctypes.data
        if accepts is not None:
            asked.filter = ctypes.pointer(filter_struct(subject.kind, accepts, subject.hit_of, raised, True))
        if executor is not None:
            asked.executor = executor_pointer(executor, raised)
        if statistics is not None:
            asked.statistics = ctypes.pointer(statistics)
        return ctypes.pointer(asked), each

    @staticmethod
    def _room(count: int, out: NDArray[Any] | None, dtype: Any) -> NDArray[Any]:
        if out is None:
            return np.empty(count, dtype)
        is_array = isinstance(out, np.ndarray) and out.shape == (count,)
        if not is_array or (out.dtype is not dtype and out.dtype != dtype):
            raise ValueError(f"out must be an array of the shape ({count},) and of the type {dtype}")
        if not out.flags.carray:
            raise ValueError("out must be contiguous, aligned and writeable")
        return out

    @overload
    def first_hits(self, paths: Paths, *, filter: Callable[[int, PathHit], Any] | None = None,
                   executor: Executor | None = None, statistics: Statistics | None = None,
                   out: Hits[PathHit] | None = None, **options: Any) -> Hits[PathHit]: ...

    @overload
    def first_hits(self, paths: SweptShapes, *, filter: Callable[[int, TouchHit], Any] | None = None,
                   executor: Executor | None = None, statistics: Statistics | None = None,
                   out: Hits[TouchHit] | None = None, **options: Any) -> Hits[TouchHit]: ...

    def first_hits(self, paths: Paths | SweptShapes, *, filter: Callable[[int, Any], Any] | None = None,
                   executor: Executor | None = None, statistics: Statistics | None = None,
                   out: Any = None, **options: Any) -> Any:
        """Returns the first hit of each path, with the same bits as ``first_hit``. It is much faster than single calls.

        An executor, such as a ``ThreadPoolExecutor``, spreads the batch over its threads. The call may not run in one
        of these. ``out`` is filled in place of new memory. It has the hits of as many paths.
        """
        subject = self._subject_of_batch(paths)
        records = self._room(len(paths), None if out is None else out.records, subject.kind.hit_dtype)
        self._batch(subject, "first_hits", paths, options, filter, executor, statistics, records)
        return Hits(records) if out is None else out

    def any_hits(self, paths: Paths | SweptShapes, *, filter: Callable[[int, Any], Any] | None = None,
                 executor: Executor | None = None, statistics: Statistics | None = None,
                 out: NDArray[np.bool_] | None = None, **options: Any) -> NDArray[np.bool_]:
        """Returns whether each path hits anything. All else is as in ``first_hits``."""
        subject = self._subject_of_batch(paths)
        blocked = self._room(len(paths), out, np.dtype(np.bool_))
        self._batch(subject, "any_hits", paths, options, filter, executor, statistics, blocked)
        return blocked

    def box(self) -> tuple[NDArray[Any], NDArray[Any]]:
        """Returns the low and the high corner of a box around everything. Without triangles, it is low above high."""
        corners = np.empty((2, 3), self.dtype)
        check(self._function("box")(self._handle, corners.ctypes.data))
        return corners[0], corners[1]
