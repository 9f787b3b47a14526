#ifndef SUREHIT_C_VERSION_H
#define SUREHIT_C_VERSION_H

/// @file
/// The version of the headers, for C and C++.

/// The major version of these headers. While it is 0, a minor version may change what users compile against.
#define SUREHIT_VERSION_MAJOR 0
/// The minor version of these headers.
#define SUREHIT_VERSION_MINOR 2
/// The patch version of these headers.
#define SUREHIT_VERSION_PATCH 0

#endif
