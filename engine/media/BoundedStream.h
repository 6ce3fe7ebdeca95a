// Internal to this room: a seekable stream that gives bytes or nothing.
#pragma once

#include "engine/media/Bytes.h"

#include <array>
#include <istream>
#include <optional>
#include <string>

namespace shoal::media {

struct BoundedStream {
    std::istream& stream;
    uint64_t size;

    // Fills out from offset; false, and out unusable, if not all of it is there.
    bool read(uint64_t offset, std::span<uint8_t> out) const {
        if (offset > size || size - offset < out.size()) return false;
        stream.clear();
        stream.seekg(static_cast<std::streamoff>(offset));
        stream.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(out.size()));
        return static_cast<size_t>(stream.gcount()) == out.size();
    }

    template <size_t kCount> std::optional<std::array<uint8_t, kCount>> bytes(uint64_t offset) const {
        std::array<uint8_t, kCount> out;
        if (!read(offset, out)) return std::nullopt;
        return out;
    }
};

} // namespace shoal::media
