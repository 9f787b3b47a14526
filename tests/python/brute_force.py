"""Where a path first meets triangles, by fractions and by the definition alone. It shares no code with the library."""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

import numpy as np

import surehit

SEGMENT, RAY, LINE = range(3)


class Contact(NamedTuple):
    """The exact answer for one path and one triangle. u and v are None where the triangle has no area."""

    t: Fraction
    u: Fraction | None
    v: Fraction | None
    side: surehit.Side


def exact(point):
    """Returns the coordinates of a point as fractions."""
    return tuple(Fraction(float(x)) for x in point)


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def plus(a, b, factor=1):
    return tuple(x + factor * y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def is_zero(a):
    return not any(a)


def limits_of(kind, min_t=None, max_t=None):
    """Returns the lowest and the highest t that count. None is an infinity."""
    low, high = {SEGMENT: (0, 1), RAY: (0, None), LINE: (None, None)}[kind]
    if min_t is not None:
        low = min_t if low is None else max(low, min_t)
    if max_t is not None:
        high = max_t if high is None else min(high, max_t)
    return low, high


def weights(point, corners, normal):
    """Returns u and v of a point in the plane of a triangle with an area."""
    a, b, c = corners
    square = dot(normal, normal)
    way = minus(point, a)
    return (dot(cross(way, minus(c, a)), normal) / square, dot(cross(minus(b, a), way), normal) / square)


def meets(u, v):
    return u >= 0 and v >= 0 and u + v <= 1


def lowest_on_edge(start, way, limits, p, q):
    """Returns the lowest t at which the path meets the edge from p to q, or None."""
    low, high = limits
    edge = minus(q, p)
    across = cross(way, edge)
    to_p = minus(p, start)
    if not is_zero(across):
        square = dot(across, across)
        t = dot(cross(to_p, edge), across) / square
        s = dot(cross(to_p, way), across) / square
        is_there = plus(start, way, t) == plus(p, edge, s) and 0 <= s <= 1
        return t if is_there and (low is None or t >= low) and (high is None or t <= high) else None
    if is_zero(way):
        if not is_zero(cross(to_p, edge)) or (is_zero(edge) and not is_zero(to_p)):
            return None
        s = -dot(to_p, edge) / dot(edge, edge) if not is_zero(edge) else 0
        return low if 0 <= s <= 1 and (high is None or low <= high) else None
    if not is_zero(cross(to_p, way)):
        return None
    ends = [dot(minus(x, start), way) / dot(way, way) for x in (p, q)]
    t = min(ends) if low is None else max(low, min(ends))
    return t if t <= max(ends) and (high is None or t <= high) else None


def contact(start, way, limits, corners):
    """Returns the lowest exact contact of a path with a triangle, or None."""
    low, high = limits
    normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]))
    rise = dot(normal, way)
    if rise != 0:
        t = dot(normal, minus(corners[0], start)) / rise
        if (low is not None and t < low) or (high is not None and t > high):
            return None
        u, v = weights(plus(start, way, t), corners, normal)
        return Contact(t, u, v, surehit.Side.FRONT if rise < 0 else surehit.Side.BACK) if meets(u, v) else None
    has_area = not is_zero(normal)
    if has_area and dot(normal, minus(corners[0], start)) != 0:
        return None
    found = [lowest_on_edge(start, way, limits, corners[i], corners[(i + 1) % 3]) for i in range(3)]
    if has_area and low is not None and (high is None or low <= high):
        if meets(*weights(plus(start, way, low), corners, normal)):
            found.append(low)
    found = [Fraction(t) for t in found if t is not None]
    if not found:
        return None
    t = min(found)
    u, v = weights(plus(start, way, t), corners, normal) if has_area else (None, None)
    return Contact(t, u, v, surehit.Side.EDGE_ON)


def contacts(kind, start, toward, triangles, min_t=None, max_t=None, motions=None):
    """Returns the contacts with their triangles, in the order of exact t, and then of indices.

    ``triangles`` has exact corners. ``motions`` has the exact motion of each one. Only segments see it.
    """
    origin, end = exact(start), exact(toward)
    way = minus(end, origin) if kind == SEGMENT else end
    limits = limits_of(kind, min_t, max_t)
    found = []
    for index, corners in enumerate(triangles):
        relative = minus(way, motions[index]) if motions is not None and kind == SEGMENT else way
        here = contact(origin, relative, limits, corners)
        if here is not None:
            found.append((here.t, index, here))
    return [(index, here) for _, index, here in sorted(found, key=lambda x: x[:2])]


def rounded(number, dtype):
    """Returns a fraction rounded once to the nearest number of a type, and a tie to the even one."""
    near = np.dtype(dtype).type(float(number))
    around = [np.nextafter(near, near.dtype.type(-np.inf)), near, np.nextafter(near, near.dtype.type(np.inf))]
    bits = np.uint32 if near.dtype == np.float32 else np.uint64
    return float(min(around, key=lambda x: (abs(Fraction(float(x)) - number), int(x.view(bits)) & 1)))
