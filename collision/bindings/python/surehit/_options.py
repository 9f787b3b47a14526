"""What narrows and runs queries: options, filters, executors and statistics, as the library reads them."""

from __future__ import annotations

import ctypes
import threading
from collections.abc import Callable
from concurrent.futures import Executor as FuturesExecutor
from types import SimpleNamespace
from typing import Any, Literal, TypedDict

import numpy as np
from numpy.typing import ArrayLike

from . import _layouts
from ._layouts import Layouts
from ._library import check, function
from ._numbers import converted

_CULLING = {"none": 0, "back": 1, "front": 2}


class Options(TypedDict, total=False):
    """What narrows a query. Each has a default that leaves out nothing. In a batch, each may be an array of one a path.
    """

    min_t: float | ArrayLike
    """The minimum exact t that counts. A plain number is rounded to the collider's type."""
    max_t: float | ArrayLike
    """The maximum exact t that counts. A hit's rounded t may lose this hit: see ``max_t_keeping``."""
    culling: Literal["none", "back", "front"] | ArrayLike
    """Which hits are left out because of their side. "back" and "front" leave out edge-on ones too."""
    mask: int | ArrayLike
    """Leaves out triangles whose mask shares no bit with this."""
    ignored_triangle: int | ArrayLike
    """Leaves out this triangle. In a scene, that is the one of ``ignored_instance``."""
    ignore_start_contact: bool | ArrayLike
    """Leaves out triangles that exactly contain the start of a segment or a ray."""
    ignore_end_contact: bool | ArrayLike
    """Leaves out triangles that exactly contain the end of a segment."""


class SceneOptions(Options, total=False):
    """What narrows a query of a scene."""

    instance_mask: int | ArrayLike
    """Leaves out instances whose mask shares no bit with this."""
    ignored_instance: tuple[int, int] | ArrayLike
    """Leaves out this instance, or with ``ignored_triangle`` one triangle of it."""


class ShapeOptions(TypedDict, total=False):
    """What narrows a query of a moving shape. In a batch, each may be an array of one a shape."""

    max_t: float | ArrayLike
    """The maximum exact t that counts. With 0, only what the shape touches at its start is hit."""
    culling: Literal["none", "back", "front"] | ArrayLike
    """Leaves out triangles by the side from which the shape moves against them."""
    mask: int | ArrayLike
    """Leaves out triangles whose mask shares no bit with this."""
    ignored_triangle: int | ArrayLike
    """Leaves out this triangle."""
    ignore_start_contact: bool | ArrayLike
    """Leaves out triangles that the shape touches at its start."""


class SceneShapeOptions(ShapeOptions, total=False):
    """What narrows a query of a moving shape in a scene. An ``ignored_triangle`` is that of ``ignored_instance``."""

    instance_mask: int | ArrayLike
    """Leaves out instances whose mask shares no bit with this."""
    ignored_instance: tuple[int, int] | ArrayLike
    """Leaves out this instance, or with ``ignored_triangle`` one triangle of it."""


class AskedOptions:
    """The options of a collider or a scene, for one path or shape, or for a batch."""

    def __init__(self, layouts: Layouts, kind: SimpleNamespace) -> None:
        self._kind = kind
        self._dtype = layouts.dtype
        default = function(f"{kind.owner}query_options{layouts.suffix}_default")()
        self._default = np.frombuffer(bytes(default), kind.options_dtype)[0]

    def single(self, options: dict[str, Any]) -> Any:
        """Returns the struct of a query's options, or None for the defaults."""
        if not options:
            return None
        record = self._record(options, ())
        return self._kind.Options.from_buffer_copy(record.tobytes())

    def batch(self, options: dict[str, Any], count: int) -> tuple[Any, Any]:
        """Returns the struct of the options of all paths, or the array of those of each path. The other one is None."""
        shapes = {name: self._shape_of(name, value) for name, value in options.items()}
        if all(shape == () for shape in shapes.values()):
            return self.single(options), None
        for name, shape in shapes.items():
            if shape not in ((), (count,)):
                raise ValueError(f"{name} must be one value or have the shape ({count},), and not {shape}")
        return None, self._record(options, (count,))

    @staticmethod
    def _shape_of(name: str, value: Any) -> tuple[int, ...]:
        shape = np.shape(value)
        return shape[:-1] if name == "ignored_instance" and np.asarray(value).dtype.names is None else shape

    def _record(self, options: dict[str, Any], shape: tuple[int, ...]) -> Any:
        record = np.empty(shape, self._kind.options_dtype)
        record[...] = self._default
        for name, value in options.items():
            if name not in record.dtype.names:
                known = ", ".join(record.dtype.names)
                raise TypeError(f"there is no option {name}: there are {known}")
            self._assign(record, name, value)
        return record

    def _assign(self, record: Any, name: str, value: Any) -> None:
        if name == "ignored_instance":
            given = np.asarray(value)
            parts = (given["index"], given["generation"]) if given.dtype.names else (given[..., 0], given[..., 1])
            record[name]["index"], record[name]["generation"] = (_whole(x, name) for x in parts)
        elif name in ("min_t", "max_t"):
            # An infinity stands for a limit that is too large for the type.
            is_plain = not hasattr(value, "dtype")
            with np.errstate(over="ignore"):
                record[name] = (np.asarray(value, self._dtype) if is_plain
                                else converted(value, self._dtype, name, has_axes=False))
        elif name == "culling":
            given = np.asarray(value)
            is_known = np.isin(given, list(_CULLING))
            if not is_known.all():
                raise ValueError(f"culling is {given[~is_known].flat[0]!r}, and must be none, back or front")
            record[name] = sum(number * (given == word) for word, number in _CULLING.items())
        elif name.startswith("ignore_"):
            record[name] = np.asarray(value, np.bool_)
        else:
            record[name] = _whole(value, name)


def _whole(value: Any, name: str) -> Any:
    given = np.asarray(value)
    if given.dtype.kind not in "iu":
        raise TypeError(f"{name} must be whole numbers, and not {given.dtype}")
    is_inside = (given >= 0) & (given < 2**32)
    if not np.all(is_inside):
        raise ValueError(f"{name} is {given[~is_inside].flat[0]}, which has not 32 bits")
    return given


class Raised:
    """Keeps the first exception of what the library calls, which none may leave, and raises it after the call."""

    def __init__(self) -> None:
        self.exception: BaseException | None = None

    def keep(self, exception: BaseException) -> None:
        """Keeps an exception, unless there is one."""
        if self.exception is None:
            self.exception = exception

    def check(self, status: int) -> None:
        """Raises the kept exception, or else that of the status."""
        if self.exception is not None:
            raise self.exception
        check(status)


def filter_struct(kind: SimpleNamespace, accepts: Callable[..., Any], hit_of: Callable[[Any], Any], raised: Raised,
                  is_batch: bool) -> Any:
    """Returns the filter of a callable. A single query asks it about a hit, and a batch about a path and a hit."""

    def accept(_user: Any, path: int, hit: Any) -> int:
        try:
            found = hit_of(hit.contents)
            return _layouts.ACCEPT if (accepts(path, found) if is_batch else accepts(found)) else _layouts.REJECT
        except BaseException as exception:  # the library must not see it
            raised.keep(exception)
            return _layouts.STOP

    return kind.Filter(accept=kind.Accept(accept))


class _Tasks:
    """The tasks of one call. A pool may keep some for later, when the library no longer has them."""

    def __init__(self, task: Callable[[Any, int], None], work: Any) -> None:
        self._task = task
        self._work = work
        self._changed = threading.Condition()
        self._is_open = True
        self._threads: set[int] = set()

    def do(self, index: int) -> None:
        """Does one task, unless they are closed."""
        thread = threading.get_ident()
        try:
            with self._changed:
                if not self._is_open:
                    return
                self._threads.add(thread)
            self._task(self._work, index)
        finally:
            with self._changed:
                self._threads.discard(thread)
                self._changed.notify_all()

    def close(self) -> None:
        """Lets no task begin any more, and waits for those on other threads."""
        with self._changed:
            self._is_open = False
            while self._threads - {threading.get_ident()}:
                self._changed.wait()


def executor_struct(executor: FuturesExecutor, raised: Raised) -> Any:
    """Returns the executor of a pool of threads. Tasks that the pool does not take are done by the calling thread."""

    def run(_user: Any, count: int, task: Any, work: Any) -> None:
        tasks = _Tasks(task, work)
        try:
            futures = [executor.submit(tasks.do, index) for index in range(count)]
            for future in futures:
                if not future.cancelled():
                    future.result()
        except BaseException as exception:  # the library must not see it
            raised.keep(exception)
        # No task may run after this returns, however often it is interrupted.
        while True:
            try:
                return tasks.close()
            except BaseException as exception:
                raised.keep(exception)

    return _layouts.Executor(run=_layouts.RUN_TASKS(run))


def executor_pointer(executor: FuturesExecutor | None, raised: Raised) -> Any:
    """Returns a pointer to the executor of a pool of threads, or None for none."""
    return None if executor is None else ctypes.pointer(executor_struct(executor, raised))
