"""Colliders: triangle meshes that answer where paths first meet them."""

from __future__ import annotations

import ctypes
import weakref
from concurrent.futures import Executor
from ctypes import byref, c_size_t, c_uint32, c_void_p
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from . import _layouts
from ._layouts import Layouts, layouts_of
from ._library import check, function
from ._numbers import indices, masks_of, rows, stride_of, wished_dtype
from ._options import Raised, executor_pointer
from ._queries import Queries
from .explanation import Explanation, explanation_of
from .hits import Hit, ShapeHit
from .paths import Path


class GridSummary(NamedTuple):
    """The size of a collider's grid. All numbers are 0 if the mesh has no triangles."""

    cells: int
    entries: int
    memory_bytes: int
    resolution: tuple[int, int, int]
    levels: int


class Collider(Queries[Hit, ShapeHit]):
    """A triangle mesh that answers where paths first meet it. It copies what it needs of the mesh.

    ``vertices`` has the shape (N, 3), and ``triangles`` has three indices a row. An array of float32 makes a collider
    of floats, and every other one makes one of doubles, unless ``dtype`` says which. Arrays of float32, float64,
    uint16, uint32 and int32 are read where they are. A triangle's id is its index. Degenerate and equal triangles,
    holes and unused vertices are allowed.

    ``masks`` has one mask for each triangle, for the option ``mask``. The other arguments are about the grid: they
    change no answer, and None or 0 leaves them to the library. ``executor`` spreads the build over threads.

    The answers are those of exact real arithmetic on the given numbers, for every finite input.

    Raises ``InvalidMesh`` if the mesh cannot be used. Its message and its ``element`` say what is at fault.
    """

    def __init__(self, vertices: ArrayLike, triangles: ArrayLike, *, masks: ArrayLike | None = None,
                 dtype: DTypeLike | None = None, executor: Executor | None = None, cells_per_triangle: float = 0.0,
                 resolution: tuple[int, int, int] = (0, 0, 0), crowded: int = 0) -> None:
        layouts = layouts_of(wished_dtype(vertices) if dtype is None else dtype)
        handle = c_void_p()
        try:
            self._build("create", layouts, vertices, triangles, masks, executor,
                        (cells_per_triangle, *resolution, crowded), None, handle)
        finally:
            if handle:  # also where the executor has raised an exception
                self._own(layouts, handle)

    def _own(self, layouts: Layouts, handle: c_void_p) -> None:
        self._handle = handle
        self._set_kind(layouts, "collider")
        self._finalizer = weakref.finalize(self, self._function("destroy"), handle)

    @staticmethod
    def _build(name: str, layouts: Layouts, vertices: ArrayLike, triangles: ArrayLike, masks: ArrayLike | None,
               executor: Executor | None, grid: tuple[Any, ...], before: Any, after: Any) -> None:
        points = rows(vertices if np.size(vertices) else np.empty((0, 3), layouts.dtype), layouts.dtype, "vertices")
        corners = indices(triangles, "triangles")
        bits = masks_of(masks) if masks is not None else np.empty(0, np.uint32)
        if masks is not None and len(bits) != len(corners):
            raise ValueError(f"there are {len(bits)} masks for {len(corners)} triangles")
        mesh = layouts.Mesh(points.ctypes.data, len(points), stride_of(points), corners.ctypes.data, len(corners),
                            stride_of(corners), corners.dtype.itemsize)
        raised = Raised()
        options = _layouts.BuildOptions(ctypes.sizeof(_layouts.BuildOptions), bits.ctypes.data, len(bits),
                                        executor_pointer(executor, raised), *grid)
        call = function(f"collider{layouts.suffix}_{name}")
        ends = (byref(mesh), byref(options))
        raised.check(call(*ends, byref(after)) if before is None else call(before, *ends))

    def copy(self) -> Collider:
        """Returns a copy, which can be rebuilt by itself."""
        result = object.__new__(Collider)
        handle = c_void_p()
        check(self._function("copy")(self._handle, byref(handle)))
        result._own(self._layouts, handle)
        return result

    def rebuild(self, vertices: ArrayLike, triangles: ArrayLike, *, masks: ArrayLike | None = None,
                executor: Executor | None = None, cells_per_triangle: float = 0.0,
                resolution: tuple[int, int, int] = (0, 0, 0), crowded: int = 0) -> None:
        """Replaces the mesh, the masks and the grid, in the same memory. No query may run at the same time.

        If the mesh or an option cannot be used, the collider is as before. What ``executor`` raises comes afterwards: the
        rest of the work is done without it.
        """
        self._build("rebuild", self._layouts, vertices, triangles, masks, executor,
                    (cells_per_triangle, *resolution, crowded), self._handle, None)

    def rebuild_vertices(self, vertices: ArrayLike, *, executor: Executor | None = None) -> None:
        """Moves the vertices. Triangles and masks stay. No query may run at the same time.

        If the vertices cannot be used, the collider is as before. What ``executor`` raises comes afterwards, as in
        ``rebuild``.
        """
        points = rows(vertices, self.dtype, "vertices")
        raised = Raised()
        raised.check(self._function("rebuild_vertices")(self._handle, points.ctypes.data, len(points),
                                                        stride_of(points), executor_pointer(executor, raised)))

    def mask(self, triangle: int) -> int:
        """Returns the mask of a triangle."""
        mask = c_uint32()
        check(self._function("mask")(self._handle, _id(triangle), byref(mask)))
        return mask.value

    def set_mask(self, triangle: int, mask: int) -> None:
        """Sets the mask of one triangle, such as a door that opens. No query may run at the same time."""
        check(self._function("set_mask")(self._handle, _id(triangle), _bits(mask)))

    def set_masks(self, masks: ArrayLike | None) -> None:
        """Sets the masks of all triangles. None means all bits for all triangles. No query may run at the same time."""
        bits = masks_of(masks) if masks is not None else np.empty(0, np.uint32)
        if masks is not None and len(bits) != len(self):
            raise ValueError(f"there are {len(bits)} masks for {len(self)} triangles")
        check(self._function("set_masks")(self._handle, bits.ctypes.data, len(bits)))

    def __len__(self) -> int:
        """Returns the number of triangles."""
        count = c_size_t()
        check(self._function("triangle_count")(self._handle, byref(count)))
        return count.value

    @property
    def memory_bytes(self) -> int:
        """The memory that it has allocated."""
        count = c_size_t()
        check(self._function("memory_bytes")(self._handle, byref(count)))
        return count.value

    def triangle(self, triangle: int) -> NDArray[Any]:
        """Returns the corners of a triangle, one a row, as they were given."""
        corners = np.empty((3, 3), self.dtype)
        check(self._function("triangle")(self._handle, _id(triangle), corners.ctypes.data))
        return corners

    def normal(self, triangle: int) -> NDArray[Any]:
        """Returns the unit vector along (b - a) × (c - a), or zero for a degenerate triangle."""
        normal = np.empty(3, self.dtype)
        check(self._function("normal")(self._handle, _id(triangle), normal.ctypes.data))
        return normal

    def max_t_keeping(self, path: Path, hit: Hit) -> float:
        """Returns the limit of t that keeps one of the path's hits: the smallest number not below its exact t."""
        limit = self._layouts.real()
        check(self._function("max_t_keeping")(self._handle, byref(path.struct(self._layouts)),
                                              byref(self._struct_of_hit(hit)), byref(limit)))
        return float(limit.value)

    def explain(self, path: Path, **options: Any) -> Explanation:
        """Returns how ``first_hit`` comes to its answer: cells, candidates, what each stage says of them, and hits.

        The answer is the same. The way to it may differ between machines and versions. It is slow, for people to read.
        """
        if not isinstance(path, Path):
            raise TypeError(f"the path must be a Segment, a Ray or a Line, and not {type(path).__name__}")
        asked = self._paths.options.single(options)
        return explanation_of(self._function("explain"), self._handle, byref(path.struct(self._layouts)),
                              None if asked is None else byref(asked), self._layouts)

    def grid_summary(self) -> GridSummary:
        """Returns the size of the grid."""
        summary = _layouts.GridSummaryStruct(ctypes.sizeof(_layouts.GridSummaryStruct))
        check(self._function("grid_summary")(self._handle, byref(summary)))
        resolution = (summary.resolution_x, summary.resolution_y, summary.resolution_z)
        return GridSummary(summary.cells, summary.entries, summary.memory_bytes, resolution, summary.levels)

    def __repr__(self) -> str:
        return f"<Collider of {len(self)} triangles in {self.dtype}>"


def _id(triangle: int) -> int:
    """Functions of C would see an id without its higher bits."""
    if not 0 <= triangle < 2**32:
        raise IndexError(f"there is no triangle {triangle}")
    return int(triangle)


def _bits(mask: int) -> int:
    if not 0 <= mask < 2**32:
        raise ValueError(f"the mask {mask} has not 32 bits")
    return int(mask)
