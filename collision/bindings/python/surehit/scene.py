"""Scenes: many placed and moving meshes that are asked as one."""

from __future__ import annotations

import weakref
from concurrent.futures import Executor
from ctypes import byref, c_size_t, c_uint8, c_uint32, c_uint64, c_void_p
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from ._layouts import ALL_BITS, InstanceIdStruct, Layouts, layouts_of
from ._library import check, function
from ._numbers import converted, triple
from ._options import Raised, executor_pointer
from ._queries import Queries
from .collider import Collider, _bits, _id
from .hits import InstanceId, SceneHit, SceneShapeHit
from .shapes import SweptShape


def rigid_pose(quaternion: ArrayLike, translation: ArrayLike = (0, 0, 0),
               dtype: DTypeLike = np.float64) -> NDArray[Any]:
    """Returns a pose that turns a mesh by a unit quaternion (x, y, z, w), and then moves it.

    Its entries are rounded a few times, and become 0 below 2^-64 in magnitude. The instance is the exact image under
    the rounded entries.
    """
    layouts = layouts_of(dtype)
    turn = converted(quaternion, layouts.dtype, "quaternion")
    if turn.shape != (4,):
        raise ValueError(f"quaternion must be four numbers, and not of the shape {turn.shape}")
    place = layouts.Vector3Struct(*triple(translation, layouts.dtype, "translation").tolist())
    struct = function(f"pose{layouts.suffix}_rigid")(*turn.tolist(), place)
    return np.array(struct.numbers, layouts.dtype).reshape(4, 3).T


def translation_pose(translation: ArrayLike, dtype: DTypeLike = np.float64) -> NDArray[Any]:
    """Returns a pose that moves a mesh without turning it."""
    return np.column_stack([np.eye(3, dtype=dtype), triple(translation, np.dtype(dtype), "translation")])


class _Instances(Queries[SceneHit, SceneShapeHit]):
    """What a scene and a snapshot of one tell about their instances."""

    def _own(self, layouts: Layouts, handle: c_void_p) -> None:
        """Takes a handle, which it destroys in the end."""
        self._handle = handle
        self._set_kind(layouts, "scene")
        self._finalizer = weakref.finalize(self, self._function("destroy"), handle)

    def snapshot(self) -> SceneSnapshot:
        """Returns what is committed, which stays the same. It is fast, and may not run during a commit."""
        handle = c_void_p()
        check(self._function("snapshot")(self._handle, byref(handle)))
        return SceneSnapshot(self._layouts, handle)

    def __len__(self) -> int:
        """Returns the number of instances."""
        count = c_size_t()
        check(self._function("instance_count")(self._handle, byref(count)))
        return count.value

    def __contains__(self, instance: InstanceId) -> bool:
        is_there = c_uint8()
        check(self._function("contains")(self._handle, _struct(instance), byref(is_there)))
        return is_there.value != 0

    def instances(self) -> list[InstanceId]:
        """Returns the ids of all instances, in order."""
        room = len(self)
        ids = (InstanceIdStruct * room)()
        count = c_size_t()
        check(self._function("instances")(self._handle, byref(ids), room, byref(count)))
        return [InstanceId(x.index, x.generation) for x in ids]

    def pose(self, instance: InstanceId) -> NDArray[Any]:
        """Returns the pose of an instance, of the shape (3, 4)."""
        columns = np.empty((4, 3), self.dtype)
        check(self._function("pose")(self._handle, _struct(instance), columns.ctypes.data))
        return columns.T

    def motion(self, instance: InstanceId) -> NDArray[Any]:
        """Returns the motion of an instance. It is zero if none was set."""
        motion = np.empty(3, self.dtype)
        check(self._function("motion")(self._handle, _struct(instance), motion.ctypes.data))
        return motion

    def mask(self, instance: InstanceId) -> int:
        """Returns the mask of an instance."""
        mask = c_uint32()
        check(self._function("mask")(self._handle, _struct(instance), byref(mask)))
        return mask.value

    def user_data(self, instance: InstanceId) -> int:
        """Returns the number that was given when the instance was added."""
        number = c_uint64()
        check(self._function("user_data")(self._handle, _struct(instance), byref(number)))
        return number.value

    def triangle_count(self, instance: InstanceId) -> int:
        """Returns the number of triangles of the instance's collider."""
        count = c_size_t()
        check(self._function("triangle_count")(self._handle, _struct(instance), byref(count)))
        return count.value

    def triangle(self, instance: InstanceId, triangle: int) -> NDArray[Any]:
        """Returns the corners of a placed triangle at t = 0, one a row. Each number is the exact one, rounded once."""
        corners = np.empty((3, 3), self.dtype)
        check(self._function("triangle")(self._handle, _struct(instance), _id(triangle), corners.ctypes.data))
        return corners

    def normal(self, instance: InstanceId, triangle: int) -> NDArray[Any]:
        """Returns the unit normal of a placed triangle. It is that of the exact image."""
        normal = np.empty(3, self.dtype)
        check(self._function("normal")(self._handle, _struct(instance), _id(triangle), normal.ctypes.data))
        return normal

    def contact_point(self, hit: SceneShapeHit) -> NDArray[Any]:
        """Returns the touched point of a hit of a moving shape, where the instance is at the hit's t.

        Each coordinate is the exact one for the t, u and v of the hit, rounded once. They are rounded too, so each adds
        at most half an ulp of 1: u and v times a placed edge, and t times the motion. Fails if the instance was removed
        since the last commit.
        """
        point = np.empty(3, self.dtype)
        check(self._function("shape_contact_point")(self._handle, byref(self._struct_of_touch(hit)),
                                                    point.ctypes.data))
        return point

    def contact_normal(self, shape: SweptShape, hit: SceneShapeHit) -> NDArray[Any]:
        """Returns the unit direction in which the triangle of one of a shape's hits pushes it where they first touch.

        It is that of the exact image, as its instance sees the shape if it moves. It is zero if none is told. The error
        is that of ``surehit.contact_normal``.
        """
        self._shapes_of(shape)
        normal = np.empty(3, self.dtype)
        check(self._function("shape_contact_normal")(self._handle, byref(shape.struct(self._layouts)),
                                                     byref(self._struct_of_touch(hit)), normal.ctypes.data))
        return normal


class Scene(_Instances):
    """Many meshes, placed and moving, that are asked as one. An instance is the exact image of its mesh under its pose.

    A pose is a matrix of the shape (3, 4), or (4, 4) with the last row 0 0 0 1. A corner v of the mesh is at M v + m in
    exact arithmetic, where m is the last column. M may rotate, scale, mirror and shear. Each of its entries must be 0,
    or between 2^-64 and 2^64 in magnitude. Its determinant must not be 0.

    Changes take effect with the next ``commit``. Until then, queries answer as before. ``len``, ``in``, ``instances``
    and what is told about one instance are of what was set last. A scene of float64 may have colliders of float32 too.
    Among hits with equal exact t, the lowest instance index comes first.

    Moving shapes have the sizes and axes of the scene, whatever the poses are. While a shape moves, instances with a
    motion move too.

    Raises ``InvalidInstance`` if a pose, a motion or an id cannot be used. The scene is then as before.
    """

    def __init__(self, dtype: DTypeLike = np.float64) -> None:
        layouts = layouts_of(dtype)
        handle = c_void_p()
        check(function(f"scene{layouts.suffix}_create")(byref(handle)))
        self._own(layouts, handle)

    def add(self, collider: Collider, pose: ArrayLike | None = None, *, mask: int = ALL_BITS,
            user_data: int = 0) -> InstanceId:
        """Adds an instance of a collider, and returns its id. Without a pose, the mesh stays where it is.

        ``mask`` is for the option ``instance_mask``, and ``user_data`` is any number of 64 bits. Instances share their
        collider. If it is rebuilt later, no query may run until the next commit.
        """
        name = self._for_type_of(collider, "add")
        if not 0 <= user_data < 2**64:
            raise ValueError(f"user_data is {user_data}, which has not 64 bits")
        numbers = self._pose_numbers(pose) if pose is not None else None
        id_ = InstanceIdStruct()
        check(self._function(name)(self._handle, collider._handle, None if numbers is None else numbers.ctypes.data,
                                   _bits(mask), user_data, byref(id_)))
        return InstanceId(id_.index, id_.generation)

    def _for_type_of(self, collider: Collider, name: str) -> str:
        """Returns the name of the function that takes this collider."""
        if not isinstance(collider, Collider):
            raise TypeError(f"an instance is one of a Collider, and not of a {type(collider).__name__}")
        if collider.dtype == self.dtype:
            return name
        if self.dtype == np.float32:
            raise TypeError("a scene of float32 cannot have a collider of float64")
        return {"add": "add_colliderf", "set_collider": "set_colliderf"}[name]

    def _pose_numbers(self, pose: ArrayLike) -> NDArray[Any]:
        """Returns the columns of a pose, one after the other."""
        matrix = converted(pose, self.dtype, "pose")
        if matrix.shape == (4, 4):
            if matrix[3].tolist() != [0, 0, 0, 1]:
                raise ValueError(f"the last row of the pose is {matrix[3]}, and must be 0 0 0 1")
            matrix = matrix[:3]
        if matrix.shape != (3, 4):
            raise ValueError(f"pose must have the shape (3, 4) or (4, 4), and not {matrix.shape}")
        return np.ascontiguousarray(matrix.T)

    def remove(self, instance: InstanceId) -> None:
        """Removes an instance."""
        check(self._function("remove")(self._handle, _struct(instance)))

    def set_collider(self, instance: InstanceId, collider: Collider) -> None:
        """Gives an instance another collider. Its id, pose, motion, mask and user data stay.

        Ask about the triangles of earlier hits before this, because they are those of the other mesh.
        """
        name = self._for_type_of(collider, "set_collider")
        check(self._function(name)(self._handle, _struct(instance), collider._handle))

    def set_pose(self, instance: InstanceId, pose: ArrayLike) -> None:
        """Sets the pose of an instance. It does not end its motion."""
        numbers = self._pose_numbers(pose)
        check(self._function("set_pose")(self._handle, _struct(instance), numbers.ctypes.data))

    def set_motion(self, instance: InstanceId, motion: ArrayLike) -> None:
        """Sets the motion of an instance. At t of a segment or of a shape, it is at its pose plus t times the motion.

        Rays and lines see it at its pose. The motion stays until it is set again. Zero ends it.
        """
        numbers = triple(motion, self.dtype, "motion")
        check(self._function("set_motion")(self._handle, _struct(instance), numbers.ctypes.data))

    def set_mask(self, instance: InstanceId, mask: int) -> None:
        """Sets the mask of an instance."""
        check(self._function("set_mask")(self._handle, _struct(instance), _bits(mask)))

    def commit(self, executor: Executor | None = None) -> None:
        """Lets all changes since the last commit take effect. No query may run at the same time.

        What ``executor`` raises comes afterwards: the rest of the work is done without it.
        """
        raised = Raised()
        raised.check(self._function("commit")(self._handle, executor_pointer(executor, raised)))

    @property
    def memory_bytes(self) -> int:
        """The memory that it has allocated."""
        count = c_size_t()
        check(self._function("memory_bytes")(self._handle, byref(count)))
        return count.value

    def __repr__(self) -> str:
        return f"<Scene of {len(self)} instances in {self.dtype}>"


class SceneSnapshot(_Instances):
    """What a scene had committed when ``Scene.snapshot`` was called. It answers all queries of a scene.

    It stays the same while the scene is changed and committed in another thread, so queries go on meanwhile. It shares
    the colliders with the scene. No query of it may run while one of them is rebuilt or gets other masks, and none at
    all after a rebuild.
    """

    def __init__(self, layouts: Layouts, handle: c_void_p) -> None:
        self._own(layouts, handle)

    def __repr__(self) -> str:
        return f"<SceneSnapshot of {len(self)} instances in {self.dtype}>"


def _struct(instance: InstanceId) -> InstanceIdStruct:
    index, generation = instance
    return InstanceIdStruct(int(index), int(generation))
