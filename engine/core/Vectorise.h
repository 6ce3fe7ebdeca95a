// Versions of functions for newer x86-64 processors. Contraction is off, so all give the same bits. The
// library ShoalLight is built with this file too.
#pragma once

// Inner loops that are worth compiling thrice: for every x86-64, for AVX2 and for AVX-512, chosen when the
// program starts.
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) &&             \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SHOAL_VERSIONS // there are functions of one name for several targets
#define SHOAL_VECTORISE __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define SHOAL_VECTORISE
#endif

// Functions of intrinsics, for callers that have asked the processor. The compilers that know these have
// operators of vectors too. Undefined elsewhere.
#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#define SHOAL_AVX2 __attribute__((target("avx2")))
#endif
