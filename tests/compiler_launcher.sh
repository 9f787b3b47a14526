#!/bin/sh
# Starts a compiler for CMake. Clang is faster with jemalloc. GCC has memory of its own, and gains nothing.
case $1 in
  *clang*) export LD_PRELOAD=libjemalloc.so.2 ;;
esac
exec "$@"
