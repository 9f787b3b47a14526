"""Arrays of numbers as the library reads them: where they are if their layout allows it, and never rounded unseen.

A NumPy array of another type is converted if that loses nothing, and refused otherwise. Plain Python numbers have no
width of their own, so they are rounded to the nearest number of the wanted type.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

_AXES = "xyz"


def has_own_type(values: Any) -> bool:
    """Returns whether the values say which type they have, as NumPy's do."""
    return hasattr(values, "dtype")


def wished_dtype(values: Any) -> np.dtype[Any]:
    """Returns float32 for arrays of at most this width, and float64 for all others."""
    narrow = has_own_type(values) and values.dtype in (np.dtype(np.float32), np.dtype(np.float16))
    return np.dtype(np.float32 if narrow else np.float64)


def _place(index: tuple[int, ...], shape: tuple[int, ...], has_axes: bool) -> str:
    if not index:
        return ""
    if has_axes and shape[-1] == 3:
        rows = "".join(f"[{i}]" for i in index[:-1])
        return f"{rows}.{_AXES[index[-1]]}"
    return "".join(f"[{i}]" for i in index)


def converted(values: Any, dtype: np.dtype[Any], name: str, is_plain: bool | None = None,
              has_axes: bool = True) -> NDArray[Any]:
    """Returns the values in the wanted type, without a copy if they have it. Plain ones may be rounded.

    Rows of three numbers are points, unless they have no axes.
    """
    if is_plain is None:
        is_plain = not has_own_type(values)
    given = np.asarray(values)
    if given.dtype == dtype:
        return given
    if given.dtype.kind not in "fiu":
        raise TypeError(f"{name} must be numbers, and not {given.dtype}")
    with np.errstate(over="ignore", invalid="ignore"):
        result = given.astype(dtype)
    if not is_plain:
        is_kept = (result == given) & _is_exact_integer(given, result) | (given != given)
    else:
        is_kept = np.isfinite(result) | ~np.isfinite(given)
    if not is_kept.all():
        index = tuple(int(i) for i in np.argwhere(~is_kept)[0])
        raise ValueError(f"{name}{_place(index, given.shape, has_axes)} is {given[index]}, which is no {dtype}. "
                         f"If it may be rounded, use astype(numpy.{dtype})")
    return result


def _is_exact_integer(given: NDArray[Any], result: NDArray[Any]) -> Any:
    """Comparisons of NumPy round large integers, so these are compared as integers."""
    if given.dtype.kind not in "iu" or given.dtype.itemsize < 4:
        return True
    limits = np.iinfo(given.dtype)
    is_inside = (result >= float(limits.min)) & (result < float(limits.max) + (1 if given.dtype.itemsize < 8 else 0))
    return is_inside & (np.where(is_inside, result, 0).astype(given.dtype) == given)


def rows(values: ArrayLike, dtype: np.dtype[Any], name: str, width: int = 3) -> NDArray[Any]:
    """Returns an array of rows that the library can read: aligned, and each row side by side. It copies if it must."""
    result = converted(values, dtype, name)
    if result.ndim != 2 or result.shape[1] != width:
        raise ValueError(f"{name} must have the shape (N, {width}), and not {result.shape}")
    return in_place(result)


def in_place(values: NDArray[Any]) -> NDArray[Any]:
    """Returns an array of rows that can be read by its address and a stride. It copies only other layouts."""
    if values.flags.c_contiguous and values.flags.aligned:
        return values
    size = values.dtype.itemsize
    is_row = values.shape[1] == 1 or values.strides[1] == size
    is_apart = values.shape[0] < 2 or values.strides[0] >= size * values.shape[1]
    is_aligned = values.flags.aligned and (values.shape[0] < 2 or values.strides[0] % size == 0)
    return values if is_row and is_apart and is_aligned else np.ascontiguousarray(values)


def stride_of(values: NDArray[Any]) -> int:
    """Returns the bytes from one row to the next. An array of one row or none may have any."""
    return values.strides[0] if values.shape[0] > 1 else values.dtype.itemsize * values.shape[1]


def triple(values: ArrayLike, dtype: np.dtype[Any], name: str) -> NDArray[Any]:
    """Returns three numbers side by side."""
    result = converted(values, dtype, name)
    if result.shape != (3,):
        raise ValueError(f"{name} must be three numbers, and not of the shape {result.shape}")
    return np.ascontiguousarray(result)


def indices(values: ArrayLike, name: str) -> NDArray[Any]:
    """Returns rows of three indices without sign, of two or four bytes."""
    given = np.asarray(values)
    if given.size == 0:
        given = given.reshape(-1, 3).astype(np.uint32)
    if given.dtype.kind not in "iu":
        raise TypeError(f"{name} must be whole numbers, and not {given.dtype}")
    if given.ndim != 2 or given.shape[1] != 3:
        raise ValueError(f"{name} must have the shape (M, 3), and not {given.shape}")
    if given.dtype not in (np.dtype(np.uint16), np.dtype(np.uint32)):
        given = _without_sign(given, name)
    return in_place(given)


def _without_sign(given: NDArray[Any], name: str) -> NDArray[Any]:
    is_index = given >= 0
    if given.dtype.itemsize == 8:
        is_index &= given < 2**32
    if not is_index.all():
        triangle, corner = (int(i) for i in np.argwhere(~is_index)[0])
        raise IndexError(f"{name}[{triangle}][{corner}] is {given[triangle, corner]}, which is no index of a vertex")
    return given.view(np.uint32) if given.dtype == np.dtype(np.int32) else given.astype(np.uint32)


def masks_of(values: ArrayLike, name: str = "masks") -> NDArray[Any]:
    """Returns masks of 32 bits, side by side."""
    given = np.asarray(values)
    if given.ndim != 1:
        raise ValueError(f"{name} must have the shape (M,), and not {given.shape}")
    if given.dtype == np.dtype(np.uint32) or given.size == 0:
        return np.ascontiguousarray(given, np.uint32)
    if given.dtype.kind not in "iu":
        raise TypeError(f"{name} must be whole numbers, and not {given.dtype}")
    is_mask = (given >= 0) & (given < 2**32)
    if not is_mask.all():
        index = int(np.argmin(is_mask))
        raise ValueError(f"{name}[{index}] is {given[index]}, which has not 32 bits")
    return given.astype(np.uint32)
