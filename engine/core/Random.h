// Seeded pseudo-random number generator (PCG32, O'Neill 2014, "PCG: A Family of Simple Fast Space-Efficient
// Statistically Good Algorithms for Random Number Generation"); the simulation's only source of randomness.
#pragma once

#include <cstdint>

namespace shoal {

class Random {
  public:
    explicit Random(uint64_t seed = 0, uint64_t stream = 0) : increment_((stream << 1) | 1) {
        next();
        state_ += seed;
        next();
    }

    // Returns any 32-bit value, uniformly.
    uint32_t next() {
        const uint64_t old = state_;
        state_ = old * 6364136223846793005ull + increment_;
        const auto xorShifted = static_cast<uint32_t>(((old >> 18) ^ old) >> 27);
        const auto rotation = static_cast<uint32_t>(old >> 59);
        return (xorShifted >> rotation) | (xorShifted << ((32 - rotation) & 31));
    }

    // Uniform in [0, 1); 24 bits, so every value is exact in a float.
    float unit() { return static_cast<float>(next() >> 8) * 0x1p-24f; }

    // Uniform in [low, high); rounding may return high too.
    float between(float low, float high) { return low + (high - low) * unit(); }

    // Uniform in 0 .. count - 1; count > 0. The bias is below count / 2^32.
    uint32_t below(uint32_t count) { return static_cast<uint32_t>((uint64_t{next()} * count) >> 32); }

    uint64_t state() const { return state_; }

  private:
    uint64_t state_ = 0;
    uint64_t increment_;
};

} // namespace shoal
