#ifndef SUREHIT_C_STATUS_H
#define SUREHIT_C_STATUS_H

/// @file
/// What functions of the C interface return, and which library a program has.

#include <stddef.h>
#include <stdint.h>

#include "surehit/c/version.h"  // IWYU pragma: export

/// The version of the layouts and functions of the C interface. It grows with each change that an old program could
/// notice.
#define SUREHIT_C_ABI 1

/// Marks a function that a shared library exports.
#if defined(SUREHIT_SHARED) && defined(__GNUC__) && !defined(_WIN32)
#define SUREHIT_C_API __attribute__((visibility("default")))
#else
#define SUREHIT_C_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// Whether a function did what it was asked. All values but `SUREHIT_OK` are failures. `element` below is what
/// `surehit_last_error_element` returns. It is 0 where nothing is said about it.
typedef enum surehit_status {
  SUREHIT_OK = 0,              ///< The function did what it was asked.
  SUREHIT_OUT_OF_MEMORY = 1,   ///< Memory ran out. Nothing has changed.
  SUREHIT_STOPPED = 2,         ///< A filter returned `SUREHIT_STOP`. The answers mean nothing.
  SUREHIT_NULL_POINTER = 3,    ///< A pointer is null.
  SUREHIT_MISALIGNED = 4,      ///< The address of a number is not a multiple of its size.
  SUREHIT_INVALID_HANDLE = 5,  ///< The handle was destroyed, or is of another kind.
  SUREHIT_INVALID_SIZE = 6,    ///< A member `size` is of no version that the library knows. `element` is this size.
  SUREHIT_INVALID_VALUE = 7,   ///< A value is none of those that are allowed. `element` is the path's index in a batch.
  SUREHIT_OUT_OF_RANGE = 8,    ///< There is no triangle with this id. `element` is the id.
  SUREHIT_TOO_LARGE = 9,       ///< An array would not fit into memory. `element` is its count.
  SUREHIT_WRONG_ABI = 10,      ///< The library is for programs of another ABI. `element` is the library's.
  SUREHIT_INTERNAL_ERROR = 11,  ///< The library has an error. Please report it.

  SUREHIT_TOO_MANY_TRIANGLES = 100,         ///< There are more than 2^32 - 2 triangles. `element` is their number.
  SUREHIT_INDEX_OUT_OF_RANGE = 101,         ///< An index is not below the vertex count. `element` is the triangle.
  SUREHIT_NON_FINITE_VERTEX = 102,          ///< A coordinate is NaN or infinite. `element` is the vertex.
  SUREHIT_MASKS_DO_NOT_MATCH = 103,         ///< There is not one mask a triangle. `element` is the number of masks.
  SUREHIT_VERTICES_DO_NOT_MATCH = 104,      ///< There are not as many vertices as before. `element` is their number.
  SUREHIT_MISSING_ARRAY = 105,              ///< The vertices or triangles are null. `element` is their number.
  SUREHIT_VERTEX_STRIDE_TOO_SMALL = 108,    ///< Vertices overlap. `element` is the stride in bytes.
  SUREHIT_TRIANGLE_STRIDE_TOO_SMALL = 109,  ///< Triangles overlap. `element` is the stride in bytes.

  SUREHIT_NON_FINITE_POSE = 201,     ///< A number is NaN or infinite. `element` is its index among 12.
  SUREHIT_POSE_OUT_OF_RANGE = 202,   ///< An entry is too small or too large. `element` is as above.
  SUREHIT_SINGULAR_POSE = 203,       ///< The exact determinant is 0.
  SUREHIT_NON_FINITE_MOTION = 204,   ///< A coordinate is NaN or infinite. `element` is its axis.
  SUREHIT_STALE_ID = 205,            ///< There is no instance with this id. `element` is the index.
  SUREHIT_TOO_MANY_INSTANCES = 206,  ///< All 2^31 - 1 indices are in use. `element` is the number of instances.
} surehit_status;

/// Returns what the last failure on this thread was, in one line of English in UTF-8. It is empty before the first
/// failure. It begins with the name of the function that failed.
///
/// The text is valid until the next failure on this thread, and a success does not change it. Copy it to keep it.
SUREHIT_C_API const char* surehit_last_error(void);

/// Returns the status of the last failure on this thread, or `SUREHIT_OK` before the first one.
SUREHIT_C_API surehit_status surehit_last_error_status(void);

/// Returns which element was at fault in the last failure on this thread. `surehit_status` says what it counts.
SUREHIT_C_API size_t surehit_last_error_element(void);

/// Returns the version of the library: 1,000,000 times the major one, 1,000 times the minor one, and the patch.
SUREHIT_C_API uint32_t surehit_version(void);

/// Returns whether the library works for a program of this ABI. Call it once with `SUREHIT_C_ABI`, where the library
/// is not that of the header for sure, such as after `dlopen`.
///
/// Fails with `SUREHIT_WRONG_ABI` if it does not work.
SUREHIT_C_API surehit_status surehit_check_abi(uint32_t abi);

#ifdef __cplusplus
}
#endif

#endif
