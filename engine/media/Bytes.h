// Integers and text in byte strings. Internal to this folder. The caller has checked that the bytes are
// there.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace shoal::media {

using ByteSpan = std::span<const uint8_t>;

inline uint32_t big16(ByteSpan b, size_t at) { return uint32_t{b[at]} << 8 | b[at + 1]; }
inline uint32_t big32(ByteSpan b, size_t at) { return big16(b, at) << 16 | big16(b, at + 2); }
inline uint64_t big64(ByteSpan b, size_t at) { return uint64_t{big32(b, at)} << 32 | big32(b, at + 4); }
inline uint32_t little16(ByteSpan b, size_t at) { return uint32_t{b[at + 1]} << 8 | b[at]; }
inline uint32_t little24(ByteSpan b, size_t at) { return uint32_t{b[at + 2]} << 16 | little16(b, at); }
inline uint32_t little32(ByteSpan b, size_t at) { return little16(b, at + 2) << 16 | little16(b, at); }

// False too if the bytes end before.
inline bool hasText(ByteSpan b, size_t at, std::string_view text) {
    return b.size() >= at && b.size() - at >= text.size() &&
           std::memcmp(b.data() + at, text.data(), text.size()) == 0;
}

inline std::string_view asText(ByteSpan b) { return {reinterpret_cast<const char*>(b.data()), b.size()}; }

} // namespace shoal::media
