// Sixteen floats which are taken through the same sums side by side: a register of AVX-512, two of AVX2, four
// of any x86-64, as the function around them is compiled (Vectorise.h).
#pragma once

#include <cstring>

namespace shoal::light {

using Sixteen = float __attribute__((vector_size(64)));

// By reference: how a register is handed over depends on the processor.
inline void load(const float* from, Sixteen& to) { std::memcpy(&to, from, sizeof to); }
inline void store(const Sixteen& from, float* to) { std::memcpy(to, &from, sizeof from); }

} // namespace shoal::light
