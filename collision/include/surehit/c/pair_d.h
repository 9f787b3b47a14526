#ifndef SUREHIT_C_PAIR_D_H
#define SUREHIT_C_PAIR_D_H

/// @file
/// What the C interface says about one path, one triangle or one mesh by itself, in double.

#include "surehit/c/values_d.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Sets `hit` to where a path first meets one triangle. Its triangle is 0, or `SUREHIT_NO_TRIANGLE` if they do not
/// meet. A triangle with a NaN or an infinity is missed. The mask and the ignored triangle of the options are not used.
SUREHIT_C_API surehit_status surehit_triangled_intersect(const surehit_triangled* triangle, const surehit_pathd* path,
                                                         const surehit_query_optionsd* options, surehit_hitd* hit);

/// Sets `max_t` to the smallest number that is not below the exact t of a hit. `hit` must be one of this path and this
/// triangle.
SUREHIT_C_API surehit_status surehit_triangled_max_t_keeping(const surehit_triangled* triangle,
                                                             const surehit_pathd* path, const surehit_hitd* hit,
                                                             double* max_t);

/// Sets `normal` to the unit vector along (b - a) × (c - a), or to zero for a degenerate triangle. Each component is
/// within 2 ulp(1). The length is not exactly 1 in general.
///
/// Fails with `SUREHIT_INVALID_VALUE` if a corner is not finite.
SUREHIT_C_API surehit_status surehit_triangled_normal(const surehit_triangled* triangle, surehit_vector3d* normal);

/// Sets `point` to the path's point at hit.t. Each coordinate is exact for the rounded t, and rounded once. It is not
/// promised that the point is on the triangle. If the path or hit.t is not finite, all coordinates are NaN.
SUREHIT_C_API surehit_status surehit_pathd_point(const surehit_pathd* path, const surehit_hitd* hit,
                                                 surehit_vector3d* point);

/// Sets `distance` to the distance between the path's start and its point at hit.t, within one ulp. It is infinite if
/// it is too large for a finite number, and NaN or infinite if t or the way is not finite.
SUREHIT_C_API surehit_status surehit_pathd_distance(const surehit_pathd* path, const surehit_hitd* hit,
                                                    double* distance);

/// Returns `SUREHIT_OK` if a build would take the mesh, and what is wrong with it otherwise. Takes linear time.
SUREHIT_C_API surehit_status surehit_meshd_check(const surehit_meshd* mesh);

/// Sets `box` to the smallest box around all triangles of a mesh. Fails as `surehit_meshd_check` does.
SUREHIT_C_API surehit_status surehit_meshd_box(const surehit_meshd* mesh, surehit_boxd* box);

#ifdef __cplusplus
}
#endif

#endif
