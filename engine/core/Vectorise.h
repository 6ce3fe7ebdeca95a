// Macros that compile functions in several versions for newer x86-64 processors. Contraction is off, so all
// versions give the same bits. The library ShoalLight uses this file too.
#pragma once

// SHOAL_VECTORISE compiles a function three times: for every x86-64, for AVX2 and for AVX-512; the version is
// chosen when the program starts.
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) &&             \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SHOAL_VERSIONS // one function may have versions for several targets
#define SHOAL_VECTORISE __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define SHOAL_VECTORISE
#endif

// SHOAL_AVX2 marks functions with AVX2 intrinsics; callers must have checked the processor. Where it is
// defined, __m256 and its like have operators too, such as +.
#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#define SHOAL_AVX2 __attribute__((target("avx2")))
#endif
