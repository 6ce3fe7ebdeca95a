// Marks the few inner loops which are worth compiling twice: once for every x86-64, once for AVX2, chosen
// when the program starts. Contraction is off, so both give the same bits.
#pragma once

#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) &&             \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SHOAL_VECTORISE __attribute__((target_clones("avx2", "default")))
#else
#define SHOAL_VECTORISE
#endif
