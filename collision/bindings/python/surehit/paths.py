"""Segments, rays and lines: single ones, and arrays of them."""

from __future__ import annotations

from math import isinf
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._layouts import Layouts
from ._numbers import converted, has_own_type, in_place, stride_of


def _three_numbers(values: ArrayLike, name: str) -> tuple[float, ...]:
    if not isinstance(values, tuple):
        array = np.asarray(values)
        if array.dtype.kind not in "fiu" or array.dtype.itemsize > 8:
            raise TypeError(f"{name} must be numbers, and not {array.dtype}")
        if array.shape != (3,):
            raise ValueError(f"{name} must be three numbers, and not of the shape {array.shape}")
        return tuple(array.tolist())
    if len(values) != 3:
        raise ValueError(f"{name} must be three numbers, and not {len(values)}")
    return values


def _points(values: ArrayLike, name: str) -> NDArray[Any]:
    result = np.asarray(values) if has_own_type(values) else np.asarray(values, np.float64)
    if result.shape != (3,) and (result.ndim != 2 or result.shape[1] != 3):
        raise ValueError(f"{name} must have the shape (N, 3), and not {result.shape}")
    return result


def _vector(given: tuple[float, ...], is_plain: bool, name: str, layouts: Layouts) -> Any:
    """Returns three numbers as the library reads them. Only plain ones may be rounded."""
    result = layouts.Vector3(*map(float, given))
    for axis, x, y in zip("xyz", given, result):
        _check_kept(x, y, is_plain, f"{name}.{axis}", layouts)
    return result


def _check_kept(given: float, kept: float, is_plain: bool, name: str, layouts: Layouts) -> None:
    # Python compares whole numbers with floating-point ones exactly.
    if given != kept and given == given and (isinf(kept) or not is_plain):
        raise ValueError(f"{name} is {given}, which is no {layouts.dtype}. "
                         f"If it may be rounded, use astype(numpy.{layouts.dtype})")


class Path:
    """A segment, a ray or a line. A path with a NaN or an infinity hits nothing."""

    kind: ClassVar[int]
    _names: ClassVar[tuple[str, str]]
    __slots__ = ("start", "toward", "_is_plain", "_struct")

    def __init__(self, start: ArrayLike, toward: ArrayLike) -> None:
        if type(self) is Path:
            raise TypeError("a path is a Segment, a Ray or a Line")
        self.start = _three_numbers(start, self._names[0])
        self.toward = _three_numbers(toward, self._names[1])
        self._is_plain = (not has_own_type(start), not has_own_type(toward))
        self._struct: tuple[Layouts, Any] | None = None

    def struct(self, layouts: Layouts) -> Any:
        """Returns the path as the library reads it."""
        if self._struct is None or self._struct[0] is not layouts:
            struct = layouts.Path(kind=self.kind)
            struct.start = _vector(self.start, self._is_plain[0], self._names[0], layouts)
            struct.toward = _vector(self.toward, self._is_plain[1], self._names[1], layouts)
            self._struct = (layouts, struct)
        return self._struct[1]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.start!r}, {self.toward!r})"


class Segment(Path):
    """The points from the start to the end, both included. t is in [0, 1]."""

    kind = 0
    _names = ("start", "end")
    __slots__ = ()

    def __init__(self, start: ArrayLike, end: ArrayLike) -> None:
        super().__init__(start, end)


class Ray(Path):
    """The points from the origin in a direction. t is 0 or more, in units of the direction."""

    kind = 1
    _names = ("origin", "direction")
    __slots__ = ()

    def __init__(self, origin: ArrayLike, direction: ArrayLike) -> None:
        super().__init__(origin, direction)


class Line(Path):
    """The points through the origin along a direction, both ways."""

    kind = 2
    _names = ("origin", "direction")
    __slots__ = ()

    def __init__(self, origin: ArrayLike, direction: ArrayLike) -> None:
        super().__init__(origin, direction)


class Paths:
    """Paths of one kind, in two arrays of the shape (N, 3). One of them may be three numbers for all paths.

    Arrays of the collider's type are read where they are if each of their rows lies side by side. So two halves of an
    array of the shape (N, 6) are not copied. Those of other layouts and types are copied by each query.
    """

    kind: ClassVar[int]
    path_type: ClassVar[type[Path]]
    _names: ClassVar[tuple[str, str]]
    __slots__ = ("starts", "towards", "_count", "_is_plain", "_struct")

    def __init__(self, starts: ArrayLike, towards: ArrayLike) -> None:
        if type(self) is Paths:
            raise TypeError("paths are Segments, Rays or Lines")
        self.starts = _points(starts, self._names[0])
        self.towards = _points(towards, self._names[1])
        self._is_plain = (not has_own_type(starts), not has_own_type(towards))
        counts = [len(x) for x in (self.starts, self.towards) if x.ndim == 2]
        if len(set(counts)) == 2:
            raise ValueError(f"there are {counts[0]} {self._names[0]} but {counts[1]} {self._names[1]}")
        self._count = counts[0] if counts else 1
        self._struct: tuple[Layouts, Any, Any] | None = None

    def __len__(self) -> int:
        return self._count

    def __getitem__(self, index: int) -> Path:
        if not -self._count <= index < self._count:
            raise IndexError(f"there are {self._count} paths, and none with the index {index}")
        ends = []
        for values, is_plain in zip((self.starts, self.towards), self._is_plain):
            end = values[index] if values.ndim == 2 else values
            ends.append(tuple(end.tolist()) if is_plain else end)
        return self.path_type(*ends)

    def struct(self, layouts: Layouts) -> Any:
        """Returns the paths as the library reads them, and what must live as long."""
        if self._struct is not None and self._struct[0] is layouts:
            return self._struct[1:]
        given = (self.starts, self.towards)
        arrays = (self._rows(0, layouts), self._rows(1, layouts))
        struct = self._struct_of(layouts, *arrays)
        # A copy is made for each query, because the given arrays may have changed.
        if arrays[0] is given[0] and arrays[1] is given[1]:
            self._struct = (layouts, struct, arrays)
        return struct, arrays

    def _rows(self, end: int, layouts: Layouts) -> NDArray[Any]:
        values = (self.starts, self.towards)[end]
        result = converted(values, layouts.dtype, self._names[end], self._is_plain[end])
        if result.ndim == 1:
            result = np.broadcast_to(result, (self._count, 3))
        return in_place(result)

    def _struct_of(self, layouts: Layouts, starts: NDArray[Any], towards: NDArray[Any]) -> Any:
        first, other = starts.ctypes.data, towards.ctypes.data
        stride, other_stride = stride_of(starts), stride_of(towards)
        # Six numbers side by side are read fastest, so they are named as such.
        width = 3 * layouts.dtype.itemsize
        if other == first + width and other_stride == stride == 2 * width:
            return layouts.Paths(first, None, self._count, 0, 0, self.kind)
        return layouts.Paths(first, other, self._count, stride, other_stride, self.kind)

    def __repr__(self) -> str:
        return f"<{len(self)} {type(self).__name__}>"


class Segments(Paths):
    """Segments from starts to ends, both included."""

    kind = 0
    path_type = Segment
    _names = ("starts", "ends")
    __slots__ = ()

    def __init__(self, starts: ArrayLike, ends: ArrayLike) -> None:
        super().__init__(starts, ends)


class Rays(Paths):
    """Rays from origins in directions."""

    kind = 1
    path_type = Ray
    _names = ("origins", "directions")
    __slots__ = ()

    def __init__(self, origins: ArrayLike, directions: ArrayLike) -> None:
        super().__init__(origins, directions)


class Lines(Paths):
    """Lines through origins along directions, both ways."""

    kind = 2
    path_type = Line
    _names = ("origins", "directions")
    __slots__ = ()

    def __init__(self, origins: ArrayLike, directions: ArrayLike) -> None:
        super().__init__(origins, directions)
