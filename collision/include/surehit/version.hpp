#pragma once

/// @file
/// The version of these headers: `SUREHIT_VERSION_MAJOR`, `SUREHIT_VERSION_MINOR` and `SUREHIT_VERSION_PATCH`.

#include "surehit/c/version.h"  // IWYU pragma: export
