#ifndef SUREHIT_C_MIXED_SCENE_H
#define SUREHIT_C_MIXED_SCENE_H

/// @file
/// Meshes of floats in scenes of doubles, for worlds that are too large for floats.

#include "surehit/c/collider_f.h"
#include "surehit/c/scene_d.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Adds an instance of a collider of floats to a scene of doubles, as `surehit_scened_add` adds one of doubles.
SUREHIT_C_API surehit_status surehit_scened_add_colliderf(surehit_scened* scene, const surehit_colliderf* collider,
                                                          const surehit_posed* pose, uint32_t mask, uint64_t user_data,
                                                          surehit_instance_id* id);

/// Gives an instance a collider of floats, as `surehit_scened_set_collider` gives it one of doubles.
SUREHIT_C_API surehit_status surehit_scened_set_colliderf(surehit_scened* scene, surehit_instance_id id,
                                                          const surehit_colliderf* collider);

#ifdef __cplusplus
}
#endif

#endif
