"""The queries that colliders and scenes have alike."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from concurrent.futures import Executor
from ctypes import byref, c_size_t, c_uint8
from types import SimpleNamespace
from typing import Any, Generic

import numpy as np
from numpy.typing import NDArray

from ._layouts import NO_TRIANGLE, Layouts, Statistics
from ._library import check, function
from ._options import AskedOptions, Raised, executor_pointer, filter_struct
from .hits import AnyHit, Hit, Hits, hit_of, scene_hit_of
from .paths import Path, Paths, Segment

_FEW_HITS = 16


class Queries(Generic[AnyHit]):
    """What can be asked of a collider or of a scene. Many threads may ask at once, and the interpreter's lock is free.

    Options narrow a query: see ``surehit.Options``. A filter decides which hits count. A single query calls
    ``filter(hit)``, and a batch calls ``filter(path, hit)`` with the index of the path. It must depend on its arguments
    alone. An exception that leaves it ends the query, and leaves the query too.
    """

    _handle: Any

    def _set_kind(self, layouts: Layouts, word: str) -> None:
        self._layouts = layouts
        self._kind: SimpleNamespace = getattr(layouts, word)
        self._prefix = f"{word}{layouts.suffix}_"
        self._hit_of: Callable[[Any], Any] = hit_of if word == "collider" else scene_hit_of
        self._asked_options = AskedOptions(layouts, self._kind)
        self._calls = {name: self._function(name) for name in ("first_hit", "any_hit", "first_hits", "any_hits")}

    def _function(self, name: str) -> Any:
        return function(self._prefix + name)

    @property
    def dtype(self) -> np.dtype[Any]:
        """float32 or float64, which all numbers of queries and hits have."""
        return self._layouts.dtype

    def _single(self, call: Any, path: Path, options: dict[str, Any], accepts: Callable[[AnyHit], Any] | None,
                statistics: Statistics | None, *results: Any) -> None:
        if not isinstance(path, Path):
            raise TypeError(f"the path must be a Segment, a Ray or a Line, and not {type(path).__name__}")
        raised = chosen = None
        if accepts is not None:
            raised = Raised()
            chosen = byref(filter_struct(self._kind, accepts, self._hit_of, raised, False))
        asked = byref(self._asked_options.single(options)) if options else None
        status = call(self._handle, byref(path.struct(self._layouts)), asked, chosen,
                      None if statistics is None else byref(statistics), *results)
        if raised is not None:
            raised.check(status)
        elif status != 0:
            check(status)

    def first_hit(self, path: Path, *, filter: Callable[[AnyHit], Any] | None = None,
                  statistics: Statistics | None = None, **options: Any) -> AnyHit | None:
        """Returns the hit with the lowest exact t, and among equal ones that of the lowest ids. None is a miss."""
        hit = self._kind.Hit()
        self._single(self._calls["first_hit"], path, options, filter, statistics, byref(hit))
        return None if hit.triangle == NO_TRIANGLE else self._hit_of(hit)

    def any_hit(self, path: Path, *, filter: Callable[[AnyHit], Any] | None = None,
                statistics: Statistics | None = None, **options: Any) -> bool:
        """Returns whether the path hits anything. It is cheaper than ``first_hit``."""
        blocked = c_uint8()
        self._single(self._calls["any_hit"], path, options, filter, statistics, byref(blocked))
        return blocked.value != 0

    def all_hits(self, path: Path, *, filter: Callable[[AnyHit], Any] | None = None,
                 statistics: Statistics | None = None, **options: Any) -> Hits[AnyHit]:
        """Returns the hits of all triangles that the path meets, in the order of exact t, and then of ids."""
        room = _FEW_HITS
        count = c_size_t()
        while True:
            records = np.empty(room, self._kind.hit_dtype)
            self._single(self._function("all_hits"), path, options, filter, statistics if room == _FEW_HITS else None,
                         records.ctypes.data, room, byref(count))
            if count.value <= room:
                return Hits(records[:count.value])
            room = count.value

    def last_free_point(self, segment: Segment, hit: AnyHit, *, filter: Callable[[AnyHit], Any] | None = None,
                        **options: Any) -> NDArray[Any]:
        """Returns where a point that moves along a segment may stop, in front of its first hit under these options.

        The way from the start to it has no hit, so a step that ends there never tunnels.
        """
        struct = self._struct_of_hit(hit)
        point = np.empty(3, self.dtype)
        raised = Raised()
        asked = self._asked_options.single(options)
        chosen = filter_struct(self._kind, filter, self._hit_of, raised, False) if filter is not None else None
        raised.check(self._function("last_free_point")(
            self._handle, byref(segment.struct(self._layouts)), byref(struct), None if asked is None else byref(asked),
            None if chosen is None else byref(chosen), point.ctypes.data))
        return point

    def _struct_of_hit(self, hit: Any) -> Any:
        struct = self._kind.Hit(hit.t, hit.u, hit.v, hit.triangle, int(hit.side))
        if not isinstance(hit, Hit):
            struct.instance.index, struct.instance.generation = hit.instance
        return struct

    def _batch(self, name: str, paths: Paths, options: dict[str, Any], accepts: Callable[[int, AnyHit], Any] | None,
               executor: Executor | None, statistics: Statistics | None, answers: NDArray[Any]) -> None:
        raised = each = asked = None
        if options or accepts is not None or executor is not None or statistics is not None:
            raised = Raised()
            asked, each = self._batch_options(options, len(paths), accepts, executor, statistics, raised)
        struct, arrays = paths.struct(self._layouts)
        status = self._calls[name](self._handle, byref(struct), asked, answers.ctypes.data)
        if raised is not None:
            raised.check(status)
        elif status != 0:
            check(status)
        del arrays, each  # they had to live until here

    def _batch_options(self, options: dict[str, Any], count: int, accepts: Callable[[int, AnyHit], Any] | None,
                       executor: Executor | None, statistics: Statistics | None, raised: Raised) -> tuple[Any, Any]:
        """Returns a pointer to the options of a batch, and the array that must live as long."""
        asked = self._kind.BatchOptions(ctypes.sizeof(self._kind.BatchOptions))
        each = None
        if options:
            single, each = self._asked_options.batch(options, count)
            asked.options = None if single is None else ctypes.pointer(single)
            asked.path_options = None if each is None else each.ctypes.data
        if accepts is not None:
            asked.filter = ctypes.pointer(filter_struct(self._kind, accepts, self._hit_of, raised, True))
        if executor is not None:
            asked.executor = executor_pointer(executor, raised)
        if statistics is not None:
            asked.statistics = ctypes.pointer(statistics)
        return ctypes.pointer(asked), each

    def _room(self, paths: Paths, out: NDArray[Any] | None, dtype: Any) -> NDArray[Any]:
        if not isinstance(paths, Paths):
            raise TypeError(f"the paths must be Segments, Rays or Lines, and not {type(paths).__name__}")
        if out is None:
            return np.empty(len(paths), dtype)
        is_array = isinstance(out, np.ndarray) and out.shape == (len(paths),)
        if not is_array or (out.dtype is not dtype and out.dtype != dtype):
            raise ValueError(f"out must be an array of the shape ({len(paths)},) and of the type {dtype}")
        if not out.flags.carray:
            raise ValueError("out must be contiguous, aligned and writeable")
        return out

    def first_hits(self, paths: Paths, *, filter: Callable[[int, AnyHit], Any] | None = None,
                   executor: Executor | None = None, statistics: Statistics | None = None,
                   out: Hits[AnyHit] | None = None, **options: Any) -> Hits[AnyHit]:
        """Returns the first hit of each path, with the same bits as ``first_hit``. It is much faster than single calls.

        An executor, such as a ``ThreadPoolExecutor``, spreads the batch over its threads. The call may not run in one
        of these. ``out`` is filled in place of new memory. It has the hits of as many paths.
        """
        records = self._room(paths, None if out is None else out.records, self._kind.hit_dtype)
        self._batch("first_hits", paths, options, filter, executor, statistics, records)
        return Hits(records) if out is None else out

    def any_hits(self, paths: Paths, *, filter: Callable[[int, AnyHit], Any] | None = None,
                 executor: Executor | None = None, statistics: Statistics | None = None,
                 out: NDArray[np.bool_] | None = None, **options: Any) -> NDArray[np.bool_]:
        """Returns whether each path hits anything. All else is as in ``first_hits``."""
        blocked = self._room(paths, out, np.dtype(np.bool_))
        self._batch("any_hits", paths, options, filter, executor, statistics, blocked)
        return blocked

    def box(self) -> tuple[NDArray[Any], NDArray[Any]]:
        """Returns the low and the high corner of a box around everything. Without triangles, it is low above high."""
        corners = np.empty((2, 3), self.dtype)
        check(self._function("box")(self._handle, corners.ctypes.data))
        return corners[0], corners[1]

    @property
    def memory_bytes(self) -> int:
        """The memory that it has allocated."""
        count = c_size_t()
        check(self._function("memory_bytes")(self._handle, byref(count)))
        return count.value


