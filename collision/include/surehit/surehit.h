#ifndef SUREHIT_SUREHIT_H
#define SUREHIT_SUREHIT_H

/// @file
/// The C interface, in C99. It has the queries of the C++ interface, and its answers have the same bits.
///
/// - A name that ends in f is for float, and the same name with d is for double. `surehit_colliderf_first_hit` asks a
///   collider of floats.
/// - Colliders, scenes and their snapshots are handles: pointers to what only the library sees. Everything else is a
///   plain struct. No struct has bit fields or enumerations. A truth value is a `uint8_t` of 0 or 1.
/// - Each function that can fail returns a `surehit_status`, and its results go to its last parameters. A failure
///   changes no result, except where a function says so. `surehit_last_error` says what is wrong, in one line.
/// - A pointer to options, a filter, statistics or an executor may be null, for none. Other pointers may not, except
///   where their comment says so. The library never keeps a pointer after a call.
/// - A struct with a member `size` may grow. Set it to the size of the struct. Each other member may be 0, which is its
///   default. So programs and libraries of different versions work together.
/// - No exception leaves a function. Queries may run in many threads at the same time. No query may run while its
///   collider changes or its scene commits.
/// - A null pointer where none may be is an error, and so is a handle that was destroyed, until 1,000 more were. Other
///   invalid pointers cannot be told.

#include "surehit/c/collider_d.h"            // IWYU pragma: export
#include "surehit/c/collider_f.h"            // IWYU pragma: export
#include "surehit/c/explain.h"               // IWYU pragma: export
#include "surehit/c/explain_d.h"             // IWYU pragma: export
#include "surehit/c/explain_f.h"             // IWYU pragma: export
#include "surehit/c/mixed_scene.h"           // IWYU pragma: export
#include "surehit/c/options.h"               // IWYU pragma: export
#include "surehit/c/pair_d.h"                // IWYU pragma: export
#include "surehit/c/pair_f.h"                // IWYU pragma: export
#include "surehit/c/scene_d.h"               // IWYU pragma: export
#include "surehit/c/scene_f.h"               // IWYU pragma: export
#include "surehit/c/scene_shape_values_d.h"  // IWYU pragma: export
#include "surehit/c/scene_shape_values_f.h"  // IWYU pragma: export
#include "surehit/c/scene_shapes_d.h"        // IWYU pragma: export
#include "surehit/c/scene_shapes_f.h"        // IWYU pragma: export
#include "surehit/c/scene_values_d.h"        // IWYU pragma: export
#include "surehit/c/scene_values_f.h"        // IWYU pragma: export
#include "surehit/c/shape_values_d.h"        // IWYU pragma: export
#include "surehit/c/shape_values_f.h"        // IWYU pragma: export
#include "surehit/c/shapes_d.h"              // IWYU pragma: export
#include "surehit/c/shapes_f.h"              // IWYU pragma: export
#include "surehit/c/status.h"                // IWYU pragma: export
#include "surehit/c/values_d.h"              // IWYU pragma: export
#include "surehit/c/values_f.h"              // IWYU pragma: export
#include "surehit/c/version.h"               // IWYU pragma: export

#endif
