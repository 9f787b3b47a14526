"""The functions of ``trimesh.ray``, for those who come from there. Their answers are exact."""

from __future__ import annotations

from ctypes import byref
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._layouts import NO_TRIANGLE
from ._library import check, function
from .collider import Collider
from .hits import Hits
from .paths import Rays


class RayMeshIntersector:
    """Has the arguments and results of trimesh's class of this name. It is made of a mesh, or of vertices and faces.

    A ray in a triangle's plane meets the triangle, and so does one through an edge or a vertex. Of triangles that are
    met at the same exact t, the lowest index is reported first. Numbers are float64 unless the vertices are float32.

    trimesh has two such classes, whose options are in different orders, so options must be named here. Its class
    without Embree has tolerances. Where locations are wanted, that class keeps only one of a ray's hits at the same
    place. Here each triangle has its hit.
    """

    def __init__(self, geometry: Any = None, *, vertices: ArrayLike | None = None,
                 faces: ArrayLike | None = None) -> None:
        if geometry is not None:
            vertices, faces = np.asarray(geometry.vertices), np.asarray(geometry.faces)
        if vertices is None or faces is None:
            raise TypeError("give a mesh, or vertices and faces")
        self.collider = Collider(vertices, faces)

    def intersects_first(self, ray_origins: ArrayLike, ray_directions: ArrayLike) -> NDArray[np.int64]:
        """Returns the index of the first triangle that each ray hits, or -1."""
        triangle = self.collider.first_hits(self._rays(ray_origins, ray_directions)).triangle
        return np.where(triangle == NO_TRIANGLE, np.int64(-1), triangle)

    def intersects_any(self, ray_origins: ArrayLike, ray_directions: ArrayLike) -> NDArray[np.bool_]:
        """Returns whether each ray hits anything."""
        return self.collider.any_hits(self._rays(ray_origins, ray_directions))

    def intersects_id(self, ray_origins: ArrayLike, ray_directions: ArrayLike, *, multiple_hits: bool = True,
                      return_locations: bool = False) -> tuple[NDArray[Any], ...]:
        """Returns the indices of triangles and of the rays that hit them, and the locations if they are wanted.

        Hits are in the order of rays, and those of a ray in the order of exact t.
        """
        rays = self._rays(ray_origins, ray_directions)
        index_ray, hits = self._hits(rays, multiple_hits)
        index_tri = hits.triangle.astype(np.int64)
        if not return_locations:
            return index_tri, index_ray
        return index_tri, index_ray, self._locations(rays, index_ray, hits)

    def intersects_location(self, ray_origins: ArrayLike, ray_directions: ArrayLike, *,
                            multiple_hits: bool = True) -> tuple[NDArray[Any], NDArray[np.int64], NDArray[np.int64]]:
        """Returns the locations of hits, the indices of their rays and those of their triangles.

        Each coordinate of a location is the exact one for the rounded t, rounded once.
        """
        index_tri, index_ray, locations = self.intersects_id(
            ray_origins, ray_directions, multiple_hits=multiple_hits, return_locations=True)
        return locations, index_ray, index_tri

    def _rays(self, origins: ArrayLike, directions: ArrayLike) -> Rays:
        dtype = self.collider.dtype
        return Rays(np.asarray(origins, None if hasattr(origins, "dtype") else dtype),
                    np.asarray(directions, None if hasattr(directions, "dtype") else dtype))

    def _hits(self, rays: Rays, multiple_hits: bool) -> tuple[NDArray[np.int64], Hits[Any]]:
        first = self.collider.first_hits(rays)
        index_ray = np.flatnonzero(first.is_hit).astype(np.int64)
        if not multiple_hits:
            return index_ray, first[index_ray]
        found = [self.collider.all_hits(rays[int(i)]).records for i in index_ray]
        counts = [len(records) for records in found]
        records = np.concatenate(found) if found else first.records[:0]
        return np.repeat(index_ray, counts), Hits(records)

    def _locations(self, rays: Rays, index_ray: NDArray[np.int64], hits: Hits[Any]) -> NDArray[Any]:
        layouts = self.collider._layouts
        point_of = function(f"path{layouts.suffix}_point")
        locations = np.empty((len(hits), 3), layouts.dtype)
        records = np.ascontiguousarray(hits.records)
        before = -1
        for i, ray in enumerate(index_ray.tolist()):
            if ray != before:
                path = rays[ray].struct(layouts)
                before = ray
            check(point_of(byref(path), records.ctypes.data + i * records.itemsize,
                           locations.ctypes.data + i * locations.strides[0]))
        return locations
