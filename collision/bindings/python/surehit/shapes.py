"""Shapes that move in a straight line: single ones, and arrays of them."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._layouts import Layouts
from ._numbers import converted, has_own_type
from .paths import _check_kept, _points, _three_numbers, _vector


class SweptShape:
    """A shape that moves during one physics step, from its start at t = 0 to its end at t = 1.

    It touches a triangle if their distance is zero. A shape with a NaN or an infinity touches nothing.
    """

    kind: ClassVar[int]
    __slots__ = ("start", "end", "_is_plain")

    def __init__(self, start: ArrayLike, end: ArrayLike) -> None:
        if type(self) is SweptShape:
            raise TypeError("a moving shape is a SweptSphere")
        self.start = _three_numbers(start, "start")
        self.end = _three_numbers(end, "end")
        self._is_plain = (not has_own_type(start), not has_own_type(end))

    def struct(self, layouts: Layouts) -> Any:
        """Returns the shape as the library reads it."""
        struct = layouts.Shape(kind=self.kind)
        struct.start = _vector(self.start, self._is_plain[0], "start", layouts)
        struct.end = _vector(self.end, self._is_plain[1], "end", layouts)
        return struct


class SweptSphere(SweptShape):
    """A ball whose centre moves from the start to the end: all points within the radius of it. The radius may be 0."""

    kind = 0
    __slots__ = ("radius", "_is_plain_radius")

    def __init__(self, start: ArrayLike, end: ArrayLike, radius: float) -> None:
        super().__init__(start, end)
        if np.ndim(radius) != 0 or np.asarray(radius).dtype.kind not in "fiu":
            raise TypeError(f"radius must be a number, and not {radius!r}")
        self.radius: float = np.asarray(radius).item() if has_own_type(radius) else radius
        self._is_plain_radius = not has_own_type(radius)

    def struct(self, layouts: Layouts) -> Any:
        """Returns the ball as the library reads it."""
        struct = super().struct(layouts)
        struct.radius = float(self.radius)
        _check_kept(self.radius, struct.radius, self._is_plain_radius, "radius", layouts)
        return struct

    def __repr__(self) -> str:
        return f"SweptSphere({self.start!r}, {self.end!r}, {self.radius!r})"


class SweptShapes:
    """Moving shapes of one kind. Each part is an array of one row a shape, or the same for all of them.

    Each query reads the arrays anew, and copies them side by side.
    """

    kind: ClassVar[int]
    shape_type: ClassVar[type[SweptShape]]
    __slots__ = ("_parts", "_count")

    def __init__(self, **parts: tuple[NDArray[Any], int, bool]) -> None:
        if type(self) is SweptShapes:
            raise TypeError("moving shapes are SweptSpheres")
        self._parts = parts
        counts = {name: len(values) for name, (values, width, _) in parts.items() if values.ndim == (2 if width else 1)}
        if len(set(counts.values())) > 1:
            raise ValueError("there are " + " but ".join(f"{count} {name}" for name, count in counts.items()))
        self._count = next(iter(counts.values()), 1)

    def __len__(self) -> int:
        return self._count

    def __getitem__(self, index: int) -> SweptShape:
        if not -self._count <= index < self._count:
            raise IndexError(f"there are {self._count} shapes, and none with the index {index}")
        parts = []
        for values, width, is_plain in self._parts.values():
            part = values[index] if values.ndim == (2 if width else 1) else values
            parts.append(part if not is_plain else tuple(part.tolist()) if width else part.item())
        return self.shape_type(*parts)

    def struct(self, layouts: Layouts) -> Any:
        """Returns the shapes as the library reads them, and the array that must live as long."""
        numbers = np.empty((self._count, sum(width or 1 for _, width, _ in self._parts.values())), layouts.dtype)
        column = 0
        for name, (values, width, is_plain) in self._parts.items():
            part = converted(values, layouts.dtype, name, is_plain, has_axes=width > 0)
            numbers[:, column:column + (width or 1)] = part if width else part.reshape(-1, 1)
            column += width or 1
        return layouts.Shapes(numbers.ctypes.data, self._count, self.kind), numbers

    def __repr__(self) -> str:
        return f"<{len(self)} {type(self).__name__}>"


class SweptSpheres(SweptShapes):
    """Balls whose centres move from starts to ends, with a radius each or one for all."""

    kind = 0
    shape_type = SweptSphere
    __slots__ = ()

    def __init__(self, starts: ArrayLike, ends: ArrayLike, radii: ArrayLike) -> None:
        given = np.asarray(radii) if has_own_type(radii) else np.asarray(radii, np.float64)
        if given.ndim > 1:
            raise ValueError(f"radii must have the shape (N,), and not {given.shape}")
        super().__init__(starts=(_points(starts, "starts"), 3, not has_own_type(starts)),
                         ends=(_points(ends, "ends"), 3, not has_own_type(ends)),
                         radii=(given, 0, not has_own_type(radii)))
