"""How a query comes to its answer, for people who doubt it, and for pictures."""

from __future__ import annotations

import ctypes
from ctypes import byref, c_uint32
from enum import IntEnum
from typing import Any, NamedTuple

from . import _layouts
from ._layouts import Layouts
from ._options import Raised
from .hits import Hit, hit_of


class Walk(IntEnum):
    """How a query comes to the triangles that its path may meet."""

    NOWHERE = 0
    """No cell is looked at. The path comes to no part of the grid that has triangles."""
    CELLS = 1
    """The path walks from cell to cell."""
    ONE_LIST = 2
    """The mesh is so small that all of its triangles are in one list."""
    ALL_TRIANGLES = 3
    """The path starts too far away for the grid. All triangles are asked."""


class CellFinding(IntEnum):
    """What a query finds in a cell."""

    EMPTY = 0
    """No triangle. The walk may leap over a whole cube of empty cells."""
    MISSES_BOX = 1
    """Triangles, but the path misses the box around them."""
    MISSES_SLAB = 2
    """Triangles, but the path misses the two planes around them."""
    LIST = 3
    """Triangles that the path may meet."""


class FilterVerdict(IntEnum):
    """What the filter says of a path and a triangle. It is right whenever it says miss or hit."""

    NOT_ASKED = 0
    """The filter was not asked, because the grid was not."""
    MISS = 1
    """They do not meet."""
    HIT = 2
    """They meet."""
    UNDECIDED = 3
    """The bounds are larger than the numbers."""


class DecidedBy(IntEnum):
    """Which stage decides a path and a triangle."""

    OPTIONS = 0
    """The mask or the ignored triangle leaves the triangle out. Nothing is computed."""
    FILTER = 1
    """The filter, in the type of the mesh."""
    COORDINATES = 2
    """Comparisons: the path misses the triangle's box, or ends at a corner."""
    DOUBLES = 3
    """The determinants in double, with a bound."""
    PLANE = 4
    """Two coordinates in double, in a plane that is perpendicular to an axis."""
    RUNNING_BOUNDS = 5
    """Doubles, with bounds that follow each operation."""
    INTEGERS = 6
    """Exact integers."""


class PairOutcome(IntEnum):
    """The result for a path and a triangle."""

    LEFT_OUT = 0
    """The mask or the ignored triangle leaves the triangle out."""
    MISS = 1
    """They do not meet within the limits of t."""
    CONTACT_LEFT_OUT = 2
    """They meet, but culling or an ignored end leaves the contact out."""
    HIT = 3
    """They meet, and the hit counts."""


class OrderedBy(IntEnum):
    """Why a hit comes after the one before it."""

    NOTHING = 0
    """It is the first one."""
    BOUNDS = 1
    """The bounds of both t do not overlap."""
    EXACT_T = 2
    """The bounds overlap, and the exact t is larger."""
    TRIANGLE = 3
    """The exact t are equal, and the id is larger."""


class ExplainedCell(NamedTuple):
    """A step of the walk. Its numbers are rounded. ``box`` has the low corner and the high one."""

    box: tuple[tuple[float, float, float], tuple[float, float, float]]
    enters: float
    leaves: float
    finding: CellFinding
    is_inner: bool
    first_candidate: int
    candidate_count: int


class FilterNumber(NamedTuple):
    """A number that the filter has computed. The exact one is at most the bound away."""

    value: float
    bound: float


class FilterNumbers(NamedTuple):
    """The determinants of Möller and Trumbore as the filter computes them. A hit has t = t_det / det, and so on."""

    det: FilterNumber
    t_det: FilterNumber
    u_det: FilterNumber
    v_det: FilterNumber
    w_det: FilterNumber


class ExplainedCandidate(NamedTuple):
    """A triangle that a query asks about. It has numbers if the filter was asked."""

    triangle: int
    numbers: FilterNumbers | None
    filter_verdict: FilterVerdict
    decided_by: DecidedBy
    outcome: PairOutcome


class ExplainedHit(NamedTuple):
    """A hit that the walk comes to. The exact t is between ``t_lower`` and ``t_upper``."""

    hit: Hit
    t_lower: float
    t_upper: float
    ordered_by: OrderedBy
    is_rounded_by_integers: bool


class Explanation(NamedTuple):
    """All that a query for the first hit of a path does. The first of the hits is that of the path."""

    walk: Walk
    cells: list[ExplainedCell]
    candidates: list[ExplainedCandidate]
    hits: list[ExplainedHit]


def explanation_of(call: Any, handle: Any, path: Any, options: Any, layouts: Layouts) -> Explanation:
    """Returns the explanation that the library's function tells of."""
    raised = Raised()
    cells: list[ExplainedCell] = []
    candidates: list[ExplainedCandidate] = []
    hits: list[ExplainedHit] = []

    def adds(to: list[Any], convert: Any) -> Any:
        def add(_user: Any, _index: int, told: Any) -> None:
            try:
                to.append(convert(told.contents))
            except BaseException as exception:  # the library must not see it
                raised.keep(exception)
        return add

    explainer = layouts.Explainer(
        ctypes.sizeof(layouts.Explainer), _layouts.TELL_CELL(adds(cells, _cell_of)),
        _layouts.TELL_CANDIDATE(adds(candidates, _candidate_of)), layouts.TellHit(adds(hits, _explained_hit_of)))
    walk = c_uint32()
    raised.check(call(handle, path, options, byref(explainer), byref(walk)))
    return Explanation(Walk(walk.value), cells, candidates, hits)


def _cell_of(told: Any) -> ExplainedCell:
    x, y, z, far_x, far_y, far_z = told.box.numbers
    return ExplainedCell(((x, y, z), (far_x, far_y, far_z)), told.enters, told.leaves, CellFinding(told.finding),
                         bool(told.is_inner), told.first_candidate, told.candidate_count)


def _candidate_of(told: Any) -> ExplainedCandidate:
    numbers = None
    if told.has_numbers:
        numbers = FilterNumbers(*(FilterNumber(getattr(told, name).value, getattr(told, name).bound)
                                  for name in FilterNumbers._fields))
    return ExplainedCandidate(told.triangle, numbers, FilterVerdict(told.filter_verdict), DecidedBy(told.decided_by),
                              PairOutcome(told.outcome))


def _explained_hit_of(told: Any) -> ExplainedHit:
    return ExplainedHit(hit_of(told.hit), told.t_lower, told.t_upper, OrderedBy(told.ordered_by),
                        bool(told.is_rounded_by_integers))
