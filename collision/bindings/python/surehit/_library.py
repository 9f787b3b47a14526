"""Finds the shared library, and declares its functions."""

from __future__ import annotations

import ctypes
import os
import sys
from ctypes import c_size_t, c_uint32, c_uint64, c_void_p
from pathlib import Path
from typing import Any

from ._layouts import DOUBLE, FLOAT, InstanceIdStruct
from .errors import error_of

C_ABI = 1
VERSION = "0.2"

_P = c_void_p
_ID = InstanceIdStruct
# The arguments of the functions whose name has an f or a d behind its first word. Results go to the last ones.
_OF_COLLIDERS: dict[str, list[Any]] = {
    "create": [_P, _P, _P], "copy": [_P, _P], "destroy": [_P], "build": [_P, _P, _P], "rebuild": [_P, _P, _P],
    "rebuild_vertices": [_P, _P, c_size_t, c_size_t, _P], "set_mask": [_P, c_uint32, c_uint32],
    "set_masks": [_P, _P, c_size_t], "mask": [_P, c_uint32, _P], "first_hit": [_P] * 6, "any_hit": [_P] * 6,
    "all_hits": [_P] * 6 + [c_size_t, _P], "first_hits": [_P] * 4, "any_hits": [_P] * 4,
    "last_free_point": [_P] * 6, "max_t_keeping": [_P] * 4, "triangle_count": [_P, _P],
    "triangle": [_P, c_uint32, _P], "normal": [_P, c_uint32, _P], "box": [_P, _P], "grid_summary": [_P, _P],
    "memory_bytes": [_P, _P], "explain": [_P] * 5}
_OF_SCENES: dict[str, list[Any]] = {
    "create": [_P], "destroy": [_P], "add": [_P, _P, _P, c_uint32, c_uint64, _P], "remove": [_P, _ID],
    "set_collider": [_P, _ID, _P], "set_pose": [_P, _ID, _P], "set_motion": [_P, _ID, _P], "set_mask": [_P, _ID, c_uint32], "commit": [_P, _P],
    "snapshot": [_P, _P],
    "instance_count": [_P, _P], "contains": [_P, _ID, _P], "instances": [_P, _P, c_size_t, _P], "pose": [_P, _ID, _P],
    "motion": [_P, _ID, _P], "mask": [_P, _ID, _P], "user_data": [_P, _ID, _P], "triangle_count": [_P, _ID, _P],
    "triangle": [_P, _ID, c_uint32, _P], "normal": [_P, _ID, c_uint32, _P], "box": [_P, _P], "memory_bytes": [_P, _P],
    "first_hit": [_P] * 6, "any_hit": [_P] * 6, "all_hits": [_P] * 6 + [c_size_t, _P], "first_hits": [_P] * 4,
    "any_hits": [_P] * 4, "last_free_point": [_P] * 6, "shape_contact_point": [_P] * 3,
    "shape_contact_normal": [_P] * 4}
# Those that colliders and scenes have alike.
_ABOUT_SHAPES: dict[str, list[Any]] = {
    "shape_first_hit": [_P] * 6, "shape_any_hit": [_P] * 6, "shape_all_hits": [_P] * 6 + [c_size_t, _P],
    "shape_first_hits": [_P] * 4, "shape_any_hits": [_P] * 4, "shape_overlaps": [_P] * 6,
    "shape_last_free_t": [_P] * 4, "shape_last_free_point": [_P] * 6}
_OF_OTHERS: dict[str, list[Any]] = {
    "triangle{}_intersect": [_P] * 4, "triangle{}_max_t_keeping": [_P] * 4, "triangle{}_normal": [_P, _P],
    "triangle{}_shape_intersect": [_P] * 4,
    "triangle{}_shape_contact_point": [_P] * 3, "triangle{}_shape_contact_normal": [_P] * 3,
    "path{}_point": [_P] * 3, "path{}_distance": [_P] * 3}


def _path() -> str:
    """Returns where the library is: where the variable says, beside this file, or where the system has it."""
    named = os.environ.get("SUREHIT_LIBRARY")
    if named:
        return named
    others = {"darwin": f"libsurehit.{VERSION}.dylib", "win32": "surehit.dll"}
    name = others.get(sys.platform, f"libsurehit.so.{VERSION}")
    beside = Path(__file__).parent / name
    return str(beside) if beside.exists() else name


def _load() -> ctypes.CDLL:
    path = _path()
    try:
        library = ctypes.CDLL(path)
        check_abi = library.surehit_check_abi
    except (OSError, AttributeError) as error:
        raise ImportError(f"surehit's shared library cannot be loaded: {error}. Install the package with pip, which "
                          "builds it, or set SUREHIT_LIBRARY to its path") from error
    check_abi.argtypes = [c_uint32]
    if check_abi(C_ABI) != 0:
        raise ImportError(f"{path} is a surehit of another ABI than {C_ABI}")
    return library


def _declare(library: ctypes.CDLL) -> None:
    for layouts in (FLOAT, DOUBLE):
        suffix = layouts.suffix
        named = {f"collider{suffix}_{name}": arguments for name, arguments in (_OF_COLLIDERS | _ABOUT_SHAPES).items()}
        named |= {f"scene{suffix}_{name}": arguments for name, arguments in (_OF_SCENES | _ABOUT_SHAPES).items()}
        named |= {name.format(suffix): arguments for name, arguments in _OF_OTHERS.items()}
        for name, arguments in named.items():
            getattr(library, "surehit_" + name).argtypes = arguments
        for kind in (layouts.collider, layouts.scene, layouts.shape, layouts.scene_shape):
            getattr(library, f"surehit_{kind.owner}query_options{suffix}_default").restype = kind.Options
        rigid = getattr(library, f"surehit_pose{suffix}_rigid")
        rigid.argtypes, rigid.restype = [layouts.real] * 4 + [layouts.Vector3Struct], layouts.PoseStruct
    library.surehit_scened_add_colliderf.argtypes = _OF_SCENES["add"]
    library.surehit_scened_set_colliderf.argtypes = _OF_SCENES["set_collider"]
    library.surehit_last_error.restype = ctypes.c_char_p
    library.surehit_last_error_element.restype = c_size_t
    library.surehit_version.restype = c_uint32


LIBRARY = _load()


def _version() -> str:
    number = LIBRARY.surehit_version()
    return f"{number // 1000000}.{number // 1000 % 1000}.{number % 1000}"


_declare(LIBRARY)
LIBRARY_VERSION = _version()


def function(name: str) -> Any:
    """Returns a function of the library by its name without ``surehit_``."""
    return getattr(LIBRARY, "surehit_" + name)


def check(status: int) -> None:
    """Raises the exception of a status, unless it is SUREHIT_OK."""
    if status != 0:
        message = LIBRARY.surehit_last_error().decode()
        raise error_of(message, status, LIBRARY.surehit_last_error_element())

