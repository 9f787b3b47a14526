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


class Feature(IntEnum):
    """A part of a triangle."""

    FACE = 0
    """The inside of the triangle."""
    EDGE_AB = 1
    """The inside of the edge from a to b."""
    EDGE_BC = 2
    """The inside of the edge from b to c."""
    EDGE_CA = 3
    """The inside of the edge from c to a."""
    CORNER_A = 4
    """Corner a."""
    CORNER_B = 5
    """Corner b."""
    CORNER_C = 6
    """Corner c."""


_SIDES = tuple(Side)
_FEATURES = tuple(Feature)


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


class ShapeHit(NamedTuple):
    """Where a moving shape first touches a triangle. t, u and v are the exact values, each rounded once to nearest.

    The touched point is a + u (b - a) + v (c - a).
    """

    t: float
    u: float
    v: float
    triangle: int
    feature: Feature
    started_touching: bool


class SceneShapeHit(NamedTuple):
    """Where a moving shape first touches a triangle of a scene. All but the instance is as in ``ShapeHit``."""

    t: float
    u: float
    v: float
    triangle: int
    feature: Feature
    started_touching: bool
    instance: InstanceId


AnyHit = TypeVar("AnyHit", Hit, SceneHit, ShapeHit, SceneShapeHit)
PathHit = TypeVar("PathHit", Hit, SceneHit)
TouchHit = TypeVar("TouchHit", ShapeHit, SceneShapeHit)


def hit_of(record: Any) -> Hit:
    """Returns the hit of a struct or of a record."""
    return Hit(float(record.t), float(record.u), float(record.v), int(record.triangle), _SIDES[record.side])


def scene_hit_of(record: Any) -> SceneHit:
    """Returns the hit of a struct of a scene."""
    instance = InstanceId(int(record.instance.index), int(record.instance.generation))
    return SceneHit(float(record.t), float(record.u), float(record.v), int(record.triangle), _SIDES[record.side],
                    instance)


def shape_hit_of(record: Any) -> ShapeHit:
    """Returns the hit of a struct of a moving shape."""
    return ShapeHit(float(record.t), float(record.u), float(record.v), int(record.triangle),
                    _FEATURES[record.feature], bool(record.started_touching))


def scene_shape_hit_of(record: Any) -> SceneShapeHit:
    """Returns the hit of a struct of a moving shape in a scene."""
    instance = InstanceId(int(record.instance.index), int(record.instance.generation))
    return SceneShapeHit(*shape_hit_of(record), instance)


class Hits(Generic[AnyHit]):
    """An array of hits. Its parts are views of one array, ``records``, and nothing is copied.

    An index gives a ``Hit`` or its like, or None for a miss. A slice, a mask or an array of indices gives other
    ``Hits``.
    """

    __slots__ = ("records",)

    def __init__(self, records: NDArray[Any]) -> None:
        self.records = records

    @property
    def t(self) -> NDArray[Any]:
        """The lowest parameters at which the paths or shapes meet their triangles. Those of misses mean nothing."""
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
        """The sides at which the paths arrive, as numbers of ``Side``. Only hits of paths have them."""
        return self._part("side", "paths have sides")

    @property
    def feature(self) -> NDArray[np.uint8]:
        """The parts that have the touched points, as numbers of ``Feature``. Only hits of moving shapes have them."""
        return self._part("feature", "moving shapes have features")

    @property
    def started_touching(self) -> NDArray[np.bool_]:
        """Which shapes touch their triangles at t = 0 already. Only hits of moving shapes have it."""
        started: NDArray[np.bool_] = self._part("started_touching", "moving shapes have this").view(np.bool_)
        return started

    @property
    def instance(self) -> NDArray[Any]:
        """The instances that have the triangles, with ``index`` and ``generation``. Only hits of scenes have them."""
        return self._part("instance", "a scene have instances")

    def _part(self, name: str, owner: str) -> NDArray[Any]:
        if name not in (self.records.dtype.names or ()):
            raise AttributeError(f"only hits of {owner}")
        return self.records[name]

    @property
    def is_hit(self) -> NDArray[np.bool_]:
        """Which paths or shapes hit anything."""
        is_hit: NDArray[np.bool_] = self.records["triangle"] != NO_TRIANGLE
        return is_hit

    def __len__(self) -> int:
        return len(self.records)

    def __getitem__(self, index: Any) -> Any:
        found = self.records[index]
        if isinstance(found, np.ndarray) and found.ndim > 0:
            return Hits(found)
        t, u, v, triangle, part, *rest = found.item()
        if triangle == NO_TRIANGLE:
            return None
        if not rest:
            return Hit(t, u, v, triangle, _SIDES[part])
        if len(rest) == 2:
            return SceneShapeHit(t, u, v, triangle, _FEATURES[part], bool(rest[0]), InstanceId(*rest[1]))
        if "instance" in (self.records.dtype.names or ()):
            return SceneHit(t, u, v, triangle, _SIDES[part], InstanceId(*rest[0]))
        return ShapeHit(t, u, v, triangle, _FEATURES[part], bool(rest[0]))

    def __iter__(self) -> Iterator[AnyHit | None]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        askers = "shapes" if "feature" in (self.records.dtype.names or ()) else "paths"
        return f"<{int(np.count_nonzero(self.is_hit))} hits of {len(self)} {askers}>"
