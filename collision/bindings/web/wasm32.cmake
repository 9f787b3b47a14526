# Compiles for WebAssembly with Debian's Clang 19, libc++ and wasi-libc.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CXX_COMPILER clang++-19)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_EXECUTABLE_SUFFIX .wasm)
# A whole program needs more than the check of a compiler gives it.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
