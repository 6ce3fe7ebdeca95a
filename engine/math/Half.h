// Half floats, as graphics cards store radiance.
#pragma once

#include <bit>
#include <cstdint>

namespace shoal::math {

// value: 0 .. 65504. To the nearest, ties to even. No branches: loops over it vectorise.
inline uint16_t halfFromFloat(float value) {
    const uint32_t bits = std::bit_cast<uint32_t>(value);
    const uint32_t normal = (bits - (112u << 23) + 0xfffu + ((bits >> 13) & 1u)) >> 13;
    // Below 2^-14 halves are multiples of 2^-24, which is the last digit of a float just above 1/2.
    const uint32_t small = std::bit_cast<uint32_t>(value + 0.5f) - std::bit_cast<uint32_t>(0.5f);
    return static_cast<uint16_t>(bits < 0x38800000u ? small : normal);
}

} // namespace shoal::math
