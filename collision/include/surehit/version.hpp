#pragma once

/// The version of these headers. Within 0.x a minor version may change what users compile against.
#define SUREHIT_VERSION_MAJOR 0
#define SUREHIT_VERSION_MINOR 2
#define SUREHIT_VERSION_PATCH 0
