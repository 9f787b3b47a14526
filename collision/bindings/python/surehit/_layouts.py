"""The structs of the C interface, once for float and once for double."""

from __future__ import annotations

import ctypes
from ctypes import POINTER, c_double, c_float, c_size_t, c_uint8, c_uint32, c_uint64, c_void_p
from types import SimpleNamespace
from typing import Any

import numpy as np

NO_TRIANGLE = 0xFFFFFFFF
NO_INSTANCE = 0xFFFFFFFF
ALL_BITS = 0xFFFFFFFF
STOP, REJECT, ACCEPT = -1, 0, 1

TASK = ctypes.CFUNCTYPE(None, c_void_p, c_size_t)
RUN_TASKS = ctypes.CFUNCTYPE(None, c_void_p, c_size_t, TASK, c_void_p)


class Executor(ctypes.Structure):
    _fields_ = [("run", RUN_TASKS), ("user", c_void_p)]


class InstanceIdStruct(ctypes.Structure):
    _fields_ = [("index", c_uint32), ("generation", c_uint32)]


class Statistics(ctypes.Structure):
    """The work of queries. A query adds to the statistics that it is given. The numbers are not promised.

    Queries that run at the same time need statistics of their own. The numbers are ``paths``, ``cells``,
    ``candidates``, ``undecided``, ``exact_decisions``, ``exact_orders``, ``exact_roundings``, ``instances`` and
    ``unclipped``.
    """

    _fields_ = [("size", c_size_t)] + [
        (name, c_uint64)
        for name in ("paths", "cells", "candidates", "undecided", "exact_decisions", "exact_orders", "exact_roundings",
                     "instances", "unclipped")]

    def __init__(self) -> None:
        super().__init__(size=ctypes.sizeof(Statistics))


class BuildOptions(ctypes.Structure):
    _fields_ = [("size", c_size_t), ("masks", c_void_p), ("mask_count", c_size_t), ("executor", POINTER(Executor)),
                ("cells_per_triangle", c_double), ("resolution_x", c_uint32), ("resolution_y", c_uint32),
                ("resolution_z", c_uint32), ("crowded", c_uint32)]


class GridSummaryStruct(ctypes.Structure):
    _fields_ = [("size", c_size_t), ("cells", c_size_t), ("entries", c_size_t), ("memory_bytes", c_size_t),
                ("resolution_x", c_uint32), ("resolution_y", c_uint32), ("resolution_z", c_uint32),
                ("levels", c_uint32)]


class BoxStruct(ctypes.Structure):
    _fields_ = [("numbers", c_double * 6)]


class ExplainedCellStruct(ctypes.Structure):
    _fields_ = [("box", BoxStruct), ("enters", c_double), ("leaves", c_double), ("first_candidate", c_size_t),
                ("candidate_count", c_size_t), ("finding", c_uint8), ("is_inner", c_uint8)]


class FilterNumberStruct(ctypes.Structure):
    _fields_ = [("value", c_double), ("bound", c_double)]


class ExplainedCandidateStruct(ctypes.Structure):
    _fields_ = [(name, FilterNumberStruct) for name in ("det", "t_det", "u_det", "v_det", "w_det")] + [
        ("triangle", c_uint32), ("has_numbers", c_uint8), ("filter_verdict", c_uint8), ("decided_by", c_uint8),
        ("outcome", c_uint8)]


TELL_CELL = ctypes.CFUNCTYPE(None, c_void_p, c_size_t, POINTER(ExplainedCellStruct))
TELL_CANDIDATE = ctypes.CFUNCTYPE(None, c_void_p, c_size_t, POINTER(ExplainedCandidateStruct))


def _struct(name: str, fields: list[tuple[str, Any]]) -> Any:
    return type(name, (ctypes.Structure,), {"_fields_": fields})


def _queries(hit: Any, options: Any, suffix: str, owner: str) -> SimpleNamespace:
    """What queries of colliders, of scenes and of moving shapes have of their own kind each."""
    accept = ctypes.CFUNCTYPE(ctypes.c_int32, c_void_p, c_size_t, POINTER(hit))
    filter_ = _struct("Filter" + suffix, [("accept", accept), ("user", c_void_p)])
    batch = _struct("BatchOptions" + suffix, [
        ("size", c_size_t), ("options", POINTER(options)), ("path_options", c_void_p), ("filter", POINTER(filter_)),
        ("executor", POINTER(Executor)), ("statistics", POINTER(Statistics))])
    return SimpleNamespace(owner=owner, Hit=hit, Options=options, Accept=accept, Filter=filter_, BatchOptions=batch,
                           hit_dtype=np.dtype(hit), options_dtype=np.dtype(options))


class Layouts:
    """The structs of one type of numbers. ``suffix`` is the last letter of their names in C."""

    def __init__(self, real: Any, suffix: str) -> None:
        self.real = real
        self.suffix = suffix
        self.dtype = np.dtype(real)
        self.Vector3 = vector3 = real * 3
        self.Box = real * 6
        self.Triangle = real * 9
        self.Pose = real * 12
        self.Vector3Struct = _struct("Vector3" + suffix, [("x", real), ("y", real), ("z", real)])
        self.PoseStruct = _struct("Pose" + suffix, [("numbers", self.Pose)])
        self.Path = _struct("Path" + suffix, [("start", vector3), ("toward", vector3), ("kind", c_uint32)])
        self.Paths = _struct("Paths" + suffix, [
            ("starts", c_void_p), ("towards", c_void_p), ("count", c_size_t), ("start_stride", c_size_t),
            ("toward_stride", c_size_t), ("kind", c_uint32)])
        self.Mesh = _struct("Mesh" + suffix, [
            ("vertices", c_void_p), ("vertex_count", c_size_t), ("vertex_stride", c_size_t), ("triangles", c_void_p),
            ("triangle_count", c_size_t), ("triangle_stride", c_size_t), ("index_size", c_uint32)])

        where = [("t", real), ("u", real), ("v", real), ("triangle", c_uint32), ("side", c_uint8)]
        limits = [("min_t", real), ("max_t", real), ("culling", c_uint8), ("mask", c_uint32)]
        contacts = [("ignored_triangle", c_uint32), ("ignore_start_contact", c_uint8), ("ignore_end_contact", c_uint8)]
        of_instances = [("instance_mask", c_uint32), ("ignored_instance", InstanceIdStruct)]
        self.collider = _queries(_struct("Hit" + suffix, where),
                                 _struct("QueryOptions" + suffix, limits + contacts), suffix, "")
        self.ExplainedHit = _struct("ExplainedHit" + suffix, [
            ("hit", self.collider.Hit), ("t_lower", c_double), ("t_upper", c_double), ("ordered_by", c_uint8),
            ("is_rounded_by_integers", c_uint8)])
        self.TellHit = ctypes.CFUNCTYPE(None, c_void_p, c_size_t, POINTER(self.ExplainedHit))
        self.Explainer = _struct("Explainer" + suffix, [
            ("size", c_size_t), ("cell", TELL_CELL), ("candidate", TELL_CANDIDATE), ("hit", self.TellHit),
            ("user", c_void_p)])
        self.Shape = _struct("SweptShape" + suffix, [
            ("start", vector3), ("end", vector3), ("half", vector3), ("radius", real), ("kind", c_uint32)])
        self.Shapes = _struct("SweptShapes" + suffix, [
            ("numbers", c_void_p), ("count", c_size_t), ("kind", c_uint32)])
        touch = [("t", real), ("u", real), ("v", real), ("triangle", c_uint32), ("feature", c_uint8),
                 ("started_touching", c_uint8)]
        narrowed = [("max_t", real), ("culling", c_uint8), ("mask", c_uint32), ("ignored_triangle", c_uint32),
                    ("ignore_start_contact", c_uint8)]
        self.shape = _queries(_struct("ShapeHit" + suffix, touch), _struct("ShapeQueryOptions" + suffix, narrowed),
                              suffix, "shape_")
        self.scene_shape = _queries(
            _struct("SceneShapeHit" + suffix, touch + [("instance", InstanceIdStruct)]),
            _struct("SceneShapeQueryOptions" + suffix, narrowed[:3] + of_instances + narrowed[3:]), suffix,
            "scene_shape_")
        self.scene = _queries(_struct("SceneHit" + suffix, where + [("instance", InstanceIdStruct)]),
                              _struct("SceneQueryOptions" + suffix, limits + of_instances + contacts), suffix,
                              "scene_")


FLOAT = Layouts(c_float, "f")
DOUBLE = Layouts(c_double, "d")


def layouts_of(dtype: Any) -> Layouts:
    """Returns the structs for float32 or float64."""
    for layouts in (FLOAT, DOUBLE):
        if np.dtype(dtype) == layouts.dtype:
            return layouts
    raise TypeError(f"dtype must be float32 or float64, not {np.dtype(dtype)}")
