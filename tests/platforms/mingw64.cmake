# Compiles for 64-bit Windows with Debian's MinGW-w64, and runs what was compiled in Wine.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
find_program(SUREHIT_WINE NAMES wine64 PATHS /usr/lib/wine)
mark_as_advanced(SUREHIT_WINE)
set(CMAKE_CROSSCOMPILING_EMULATOR "${SUREHIT_WINE}")
# The programs then need no libraries of the compiler beside them.
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
