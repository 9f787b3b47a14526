"""Shapes that move in a straight line: single ones, and arrays of them."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._layouts import Layouts
from ._numbers import converted, has_own_type
from .paths import _check_kept, _points, _three_numbers, _vector


class SweptShape:
    """A shape that moves during one physics step, from its start at t = 0 to its end at t = 1. It does not turn.

    It touches a triangle if their distance is zero. Its sizes may be 0. A shape with a negative size, a NaN or an
    infinity touches nothing.
    """

    kind: ClassVar[int]
    _half_name: ClassVar[str | None]
    __slots__ = ("start", "end", "_half", "_radius", "_is_plain")

    def __init__(self, start: ArrayLike, end: ArrayLike, half: ArrayLike | None = None,
                 radius: float | None = None) -> None:
        if type(self) is SweptShape:
            raise TypeError("a moving shape is a SweptSphere, a SweptBox or a SweptCapsule")
        self.start = _three_numbers(start, "start")
        self.end = _three_numbers(end, "end")
        self._half = (0.0, 0.0, 0.0) if half is None else _three_numbers(half, self._half_name or "")
        self._radius = 0.0 if radius is None else _number(radius, "radius")
        self._is_plain = tuple(not has_own_type(given) for given in (start, end, half, radius))

    def struct(self, layouts: Layouts) -> Any:
        """Returns the shape as the library reads it."""
        struct = layouts.Shape(kind=self.kind, radius=self._radius)
        struct.start = _vector(self.start, self._is_plain[0], "start", layouts)
        struct.end = _vector(self.end, self._is_plain[1], "end", layouts)
        struct.half = _vector(self._half, self._is_plain[2], self._half_name or "", layouts)
        _check_kept(self._radius, struct.radius, self._is_plain[3], "radius", layouts)
        return struct


def _number(value: Any, name: str) -> float:
    if np.ndim(value) != 0 or np.asarray(value).dtype.kind not in "fiu":
        raise TypeError(f"{name} must be a number, and not {value!r}")
    number: float = np.asarray(value).item() if has_own_type(value) else value
    return number


class SweptSphere(SweptShape):
    """A ball whose centre moves from the start to the end: all points within the radius of it."""

    kind = 0
    _half_name = None
    __slots__ = ()

    def __init__(self, start: ArrayLike, end: ArrayLike, radius: float) -> None:
        super().__init__(start, end, None, radius)

    @property
    def radius(self) -> float:
        """The radius."""
        return self._radius

    def __repr__(self) -> str:
        return f"SweptSphere({self.start!r}, {self.end!r}, {self.radius!r})"


class SweptBox(SweptShape):
    """A box with edges along the axes, whose centre moves: all points at most the half extents away on each axis."""

    kind = 1
    _half_name = "half_extents"
    __slots__ = ()

    def __init__(self, start: ArrayLike, end: ArrayLike, half_extents: ArrayLike) -> None:
        super().__init__(start, end, half_extents, None)

    @property
    def half_extents(self) -> tuple[float, ...]:
        """Half the size on each axis."""
        return self._half

    def __repr__(self) -> str:
        return f"SweptBox({self.start!r}, {self.end!r}, {self.half_extents!r})"


class SweptCapsule(SweptShape):
    """A capsule whose centre moves: all points within the radius of the segment between centre ± half_axis."""

    kind = 2
    _half_name = "half_axis"
    __slots__ = ()

    def __init__(self, start: ArrayLike, end: ArrayLike, half_axis: ArrayLike, radius: float) -> None:
        super().__init__(start, end, half_axis, radius)

    @property
    def half_axis(self) -> tuple[float, ...]:
        """The way from the centre to an end of the segment."""
        return self._half

    @property
    def radius(self) -> float:
        """The radius."""
        return self._radius

    def __repr__(self) -> str:
        return f"SweptCapsule({self.start!r}, {self.end!r}, {self.half_axis!r}, {self.radius!r})"


class SweptShapes:
    """Moving shapes of one kind. Each part is an array with a row for each shape, or is the same for all of them.

    Each query reads the arrays anew, and copies them side by side.
    """

    kind: ClassVar[int]
    shape_type: ClassVar[type[SweptShape]]
    __slots__ = ("_parts", "_count")

    def __init__(self, **parts: ArrayLike) -> None:
        if type(self) is SweptShapes:
            raise TypeError("moving shapes are SweptSpheres, SweptBoxes or SweptCapsules")
        self._parts = {name: _Part(values, name) for name, values in parts.items()}
        counts = {name: len(part.values) for name, part in self._parts.items() if part.is_array}
        if len(set(counts.values())) > 1:
            raise ValueError("there are " + " but ".join(f"{count} {name}" for name, count in counts.items()))
        self._count = next(iter(counts.values()), 1)

    def __len__(self) -> int:
        return self._count

    def __getitem__(self, index: int) -> SweptShape:
        if not -self._count <= index < self._count:
            raise IndexError(f"there are {self._count} shapes, and none with the index {index}")
        return self.shape_type(*(part[index] for part in self._parts.values()))

    def struct(self, layouts: Layouts) -> Any:
        """Returns the shapes as the library reads them, and the array that must live as long."""
        numbers = np.empty((self._count, sum(part.width for part in self._parts.values())), layouts.dtype)
        column = 0
        for name, part in self._parts.items():
            given = converted(part.values, layouts.dtype, name, part.is_plain, has_axes=part.width == 3)
            numbers[:, column:column + part.width] = given if part.width == 3 else given.reshape(-1, 1)
            column += part.width
        return layouts.Shapes(numbers.ctypes.data, self._count, self.kind), numbers

    def __repr__(self) -> str:
        return f"<{len(self)} {type(self).__name__}>"


class _Part:
    """An array of points or, for radii, of numbers."""

    def __init__(self, values: ArrayLike, name: str) -> None:
        self.is_plain = not has_own_type(values)
        self.width = 1 if name == "radii" else 3
        if self.width == 3:
            self.values = _points(values, name)
        else:
            self.values = np.asarray(values, np.float64) if self.is_plain else np.asarray(values)
            if self.values.ndim > 1:
                raise ValueError(f"{name} must have the shape (N,), and not {self.values.shape}")
        self.is_array = self.values.ndim == (2 if self.width == 3 else 1)

    def __getitem__(self, index: int) -> Any:
        one: NDArray[Any] = self.values[index] if self.is_array else self.values
        if not self.is_plain:
            return one
        return tuple(one.tolist()) if self.width == 3 else one.item()


class SweptSpheres(SweptShapes):
    """Balls whose centres move from starts to ends, with a radius each or one for all."""

    kind = 0
    shape_type = SweptSphere
    __slots__ = ()

    def __init__(self, starts: ArrayLike, ends: ArrayLike, radii: ArrayLike) -> None:
        super().__init__(starts=starts, ends=ends, radii=radii)


class SweptBoxes(SweptShapes):
    """Boxes with edges along the axes, whose centres move from starts to ends."""

    kind = 1
    shape_type = SweptBox
    __slots__ = ()

    def __init__(self, starts: ArrayLike, ends: ArrayLike, half_extents: ArrayLike) -> None:
        super().__init__(starts=starts, ends=ends, half_extents=half_extents)


class SweptCapsules(SweptShapes):
    """Capsules whose centres move from starts to ends."""

    kind = 2
    shape_type = SweptCapsule
    __slots__ = ()

    def __init__(self, starts: ArrayLike, ends: ArrayLike, half_axes: ArrayLike, radii: ArrayLike) -> None:
        super().__init__(starts=starts, ends=ends, half_axes=half_axes, radii=radii)
