"""Where paths meet triangles: single hits, and arrays of them."""

from __future__ import annotations

from collections.abc import Iterator
from enum import IntEnum
from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from ._layouts import NO_TRIANGLE


class Side(IntEnum):
    """The side of a triangle at which a path arrives. The normal of corners a, b and c is (b - a) × (c - a)."""

    EDGE_ON = 0
    """The path is in the triangle's plane, or has length zero, or the triangle is degenerate."""
    FRONT = 1
    """The path arrives from the side to which the normal points."""
    BACK = 2
    """The path arrives from the other side."""


_SIDES = tuple(Side)


class Hit(NamedTuple):
    """Where a path first meets a triangle. t, u and v are the exact values, each rounded once to nearest.

    The contact is start + t (end - start), or origin + t direction. It is also a + u (b - a) + v (c - a).
    """

    t: float
    u: float
    v: float
    triangle: int
    side: Side


class InstanceId(NamedTuple):
    """Names an instance of a scene. An id of a removed instance is never that of another one."""

    index: int  # type: ignore  # in place of the function of tuples
    generation: int


class SceneHit(NamedTuple):
    """Where a path first meets a triangle of a scene. All but the instance is as in ``Hit``, for the placed one."""

    t: float
    u: float
    v: float
    triangle: int
    side: Side
    instance: InstanceId


AnyHit = TypeVar("AnyHit", Hit, SceneHit)


def hit_of(record: Any) -> Hit:
    """Returns the hit of a struct or of a record."""
    return Hit(float(record.t), float(record.u), float(record.v), int(record.triangle), _SIDES[record.side])


def scene_hit_of(record: Any) -> SceneHit:
    """Returns the hit of a struct of a scene."""
    instance = InstanceId(int(record.instance.index), int(record.instance.generation))
    return SceneHit(float(record.t), float(record.u), float(record.v), int(record.triangle), _SIDES[record.side],
                    instance)


class Hits(Generic[AnyHit]):
    """An array of hits. Its parts are views of one array, ``records``, and nothing is copied.

    An index gives a ``Hit``, or None for a miss. A slice, a mask or an array of indices gives other ``Hits``.
    """

    __slots__ = ("records",)

    def __init__(self, records: NDArray[Any]) -> None:
        self.records = records

    @property
    def t(self) -> NDArray[Any]:
        """The lowest parameters at which the paths meet their triangles. Those of misses mean nothing."""
        return self.records["t"]

    @property
    def u(self) -> NDArray[Any]:
        """The weights of corners b, in [0, 1]. Those of misses mean nothing."""
        return self.records["u"]

    @property
    def v(self) -> NDArray[Any]:
        """The weights of corners c, in [0, 1]. Those of misses mean nothing."""
        return self.records["v"]

    @property
    def triangle(self) -> NDArray[np.uint32]:
        """The triangles' ids. A miss has ``NO_TRIANGLE``."""
        return self.records["triangle"]

    @property
    def side(self) -> NDArray[np.uint8]:
        """The sides at which the paths arrive, as numbers of ``Side``. Those of misses mean nothing."""
        return self.records["side"]

    @property
    def instance(self) -> NDArray[Any]:
        """The instances that have the triangles, with ``index`` and ``generation``. Only hits of scenes have them."""
        if "instance" not in (self.records.dtype.names or ()):
            raise AttributeError("only hits of a scene have instances")
        return self.records["instance"]

    @property
    def is_hit(self) -> NDArray[np.bool_]:
        """Which paths hit anything."""
        is_hit: NDArray[np.bool_] = self.records["triangle"] != NO_TRIANGLE
        return is_hit

    def __len__(self) -> int:
        return len(self.records)

    def __getitem__(self, index: Any) -> Any:
        found = self.records[index]
        if isinstance(found, np.ndarray) and found.ndim > 0:
            return Hits(found)
        t, u, v, triangle, side, *instance = found.item()
        if triangle == NO_TRIANGLE:
            return None
        if instance:
            return SceneHit(t, u, v, triangle, _SIDES[side], InstanceId(*instance[0]))
        return Hit(t, u, v, triangle, _SIDES[side])

    def __iter__(self) -> Iterator[AnyHit | None]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        return f"<{int(np.count_nonzero(self.is_hit))} hits of {len(self)} paths>"
