// FNV-1a, 64 bits: the state hash of the simulation and the content hash of caches. Not for untrusted keys.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace shoal {

class Hash {
  public:
    void bytes(const void* data, size_t size) {
        const auto* byte = static_cast<const unsigned char*>(data);
        for (size_t i = 0; i < size; ++i) value_ = (value_ ^ byte[i]) * 0x100000001b3ull;
    }

    // Takes only types without padding, so that equal values hash equally, but for 0 and -0.
    template <class T> void add(const T& value) {
        static_assert(std::is_floating_point_v<T> || std::has_unique_object_representations_v<T>);
        bytes(&value, sizeof value);
    }

    uint64_t value() const { return value_; }

  private:
    uint64_t value_ = 0xcbf29ce484222325ull;
};

} // namespace shoal
