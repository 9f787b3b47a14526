"""One path or moving shape and one triangle, and points of paths."""

from __future__ import annotations

from ctypes import byref
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from ._layouts import NO_TRIANGLE, Layouts, layouts_of
from ._library import check, function
from ._numbers import converted, wished_dtype
from ._options import AskedOptions
from .hits import Hit, SceneHit, SceneShapeHit, ShapeHit, hit_of, shape_hit_of
from .paths import Path
from .shapes import SweptShape


@overload
def intersect(path: Path, triangle: ArrayLike, *, dtype: DTypeLike | None = None, **options: Any) -> Hit | None: ...


@overload
def intersect(path: SweptShape, triangle: ArrayLike, *, dtype: DTypeLike | None = None,
              **options: Any) -> ShapeHit | None: ...


def intersect(path: Path | SweptShape, triangle: ArrayLike, *, dtype: DTypeLike | None = None,
              **options: Any) -> Any:
    """Returns where a path or a moving shape first meets one triangle of three rows, or None. The hit's triangle is 0.

    A triangle of float32 asks in float, and every other one in double, unless ``dtype`` says which.
    """
    layouts = layouts_of(wished_dtype(triangle) if dtype is None else dtype)
    corners = _corners(triangle, layouts)
    is_shape = isinstance(path, SweptShape)
    kind = layouts.shape if is_shape else layouts.collider
    asked = AskedOptions(layouts, kind).single(options)
    hit = kind.Hit()
    check(function(f"triangle{layouts.suffix}_{kind.owner}intersect")(
        corners.ctypes.data, byref(path.struct(layouts)), None if asked is None else byref(asked), byref(hit)))
    return None if hit.triangle == NO_TRIANGLE else (shape_hit_of if is_shape else hit_of)(hit)


def contact_point(triangle: ArrayLike, hit: ShapeHit | SceneShapeHit,
                  dtype: DTypeLike | None = None) -> NDArray[Any]:
    """Returns the touched point of a triangle, a + u (b - a) + v (c - a).

    u and v are rounded once, and each of them adds at most half an ulp of 1 times its edge. The sum adds at most 4 ulp
    of the triangle's largest coordinate. In a scene, ask ``Scene.contact_point``.
    """
    layouts = layouts_of(wished_dtype(triangle) if dtype is None else dtype)
    struct = layouts.shape.Hit(hit.t, hit.u, hit.v, hit.triangle, int(hit.feature), hit.started_touching)
    result = np.empty(3, layouts.dtype)
    check(function(f"triangle{layouts.suffix}_shape_contact_point")(
        _corners(triangle, layouts).ctypes.data, byref(struct), result.ctypes.data))
    return result


def contact_normal(shape: SweptShape, triangle: ArrayLike, dtype: DTypeLike | None = None) -> NDArray[Any]:
    """Returns the unit direction in which a triangle pushes a shape where they first touch. It is zero if none is told.

    Each component is within 8 ulp(1) of the true one in double, and within 1 in float. In a scene, ask
    ``Scene.contact_normal``.
    """
    if not isinstance(shape, SweptShape):
        raise TypeError(f"the shape must be a moving shape, and not {type(shape).__name__}")
    layouts = layouts_of(wished_dtype(triangle) if dtype is None else dtype)
    result = np.empty(3, layouts.dtype)
    check(function(f"triangle{layouts.suffix}_shape_contact_normal")(
        _corners(triangle, layouts).ctypes.data, byref(shape.struct(layouts)), result.ctypes.data))
    return result


def _corners(triangle: ArrayLike, layouts: Layouts) -> NDArray[Any]:
    corners = np.ascontiguousarray(converted(triangle, layouts.dtype, "triangle"))
    if corners.shape != (3, 3):
        raise ValueError(f"triangle must have the shape (3, 3), and not {corners.shape}")
    return corners


def point(path: Path, hit: Hit | SceneHit, dtype: DTypeLike = np.float64) -> NDArray[Any]:
    """Returns the path's point at hit.t. Each coordinate is exact for the rounded t, and rounded once.

    It is not promised that the point is on the triangle.
    """
    layouts = layouts_of(dtype)
    result = np.empty(3, layouts.dtype)
    check(function(f"path{layouts.suffix}_point")(byref(path.struct(layouts)), byref(_hit_at(hit.t, layouts)),
                                                  result.ctypes.data))
    return result


def distance(path: Path, hit: Hit | SceneHit, dtype: DTypeLike = np.float64) -> float:
    """Returns the distance between the path's start and its point at hit.t, within one ulp."""
    layouts = layouts_of(dtype)
    result = layouts.real()
    check(function(f"path{layouts.suffix}_distance")(byref(path.struct(layouts)), byref(_hit_at(hit.t, layouts)),
                                                     byref(result)))
    return float(result.value)


def _hit_at(t: float, layouts: Layouts) -> Any:
    struct = layouts.collider.Hit(t=t, triangle=0)
    if struct.t != t and t == t:
        raise ValueError(f"hit.t is {t}, which is no {layouts.dtype}")
    return struct
