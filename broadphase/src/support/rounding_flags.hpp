#pragma once

// Error bounds hold for the operations as they are written. Our CMake passes the flags that keep them so.

#if defined(__FAST_MATH__) || defined(_M_FP_FAST)
#error "surehit's bounds do not hold under -ffast-math: compile the library without it"
#endif

#if !defined(SUREHIT_COMPILED_WITHOUT_FP_CONTRACTION)
#error "compile surehit with -ffp-contract=off, and define SUREHIT_COMPILED_WITHOUT_FP_CONTRACTION to say so"
#endif
