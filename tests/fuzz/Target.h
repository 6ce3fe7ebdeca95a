// A fuzz target defines LLVMFuzzerTestOneInput(); libFuzzer calls it with one input after the other.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace shoal::fuzz {

// Asserts what holds for any input; libFuzzer keeps the input of a run that aborts.
inline void expect(bool holds) {
    if (!holds) std::abort();
}

} // namespace shoal::fuzz
