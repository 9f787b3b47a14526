"""Where straight paths and moving shapes first meet triangle meshes, exactly.

>>> import surehit
>>> floor = surehit.Collider([[0, 0, 0], [10, 0, 0], [10, 10, 0], [0, 10, 0]], [[0, 1, 2], [0, 2, 3]])
>>> floor.first_hit(surehit.Segment((5, 5, 1), (5, 5, -1)))
Hit(t=0.5, u=0.0, v=0.5, triangle=0, side=<Side.FRONT: 1>)

Hit or miss is what real arithmetic gives on the given numbers: there is no tolerance. The numbers of a hit are the
exact ones, rounded once.
"""

from ._layouts import ALL_BITS, NO_TRIANGLE, Statistics
from ._library import LIBRARY_VERSION as __version__
from ._options import Options, SceneOptions, SceneShapeOptions, ShapeOptions
from .collider import Collider, GridSummary
from .errors import Error, InvalidInstance, InvalidMesh, InvalidValue, OutOfMemory, OutOfRange
from .explanation import (CellFinding, DecidedBy, ExplainedCandidate, ExplainedCell, ExplainedHit, Explanation,
                          FilterNumber, FilterNumbers, FilterVerdict, OrderedBy, PairOutcome, Walk)
from .hits import Feature, Hit, Hits, InstanceId, SceneHit, SceneShapeHit, ShapeHit, Side
from .pair import contact_normal, contact_point, distance, intersect, point
from .paths import Line, Lines, Path, Paths, Ray, Rays, Segment, Segments
from .scene import Scene, SceneSnapshot, rigid_pose, translation_pose
from .shapes import (SweptBox, SweptBoxes, SweptCapsule, SweptCapsules, SweptShape, SweptShapes, SweptSphere,
                     SweptSpheres)

__all__ = [
    "ALL_BITS", "CellFinding", "Collider", "DecidedBy", "Error", "ExplainedCandidate", "ExplainedCell", "ExplainedHit",
    "Explanation", "Feature", "FilterNumber", "FilterNumbers", "FilterVerdict", "GridSummary", "Hit", "Hits",
    "InstanceId", "InvalidInstance", "InvalidMesh", "InvalidValue", "Line", "Lines", "NO_TRIANGLE", "Options",
    "OrderedBy", "OutOfMemory", "OutOfRange", "PairOutcome", "Path", "Paths", "Ray", "Rays", "Scene", "SceneHit",
    "SceneOptions", "SceneShapeHit", "SceneShapeOptions", "SceneSnapshot", "Segment", "Segments", "ShapeHit",
    "ShapeOptions", "Side", "Statistics", "SweptBox", "SweptBoxes", "SweptCapsule", "SweptCapsules", "SweptShape",
    "SweptShapes", "SweptSphere", "SweptSpheres", "Walk", "__version__", "contact_normal", "contact_point", "distance",
    "intersect", "point", "rigid_pose", "translation_pose"]
