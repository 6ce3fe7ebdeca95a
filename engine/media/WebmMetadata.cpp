#include "engine/media/WebmMetadata.h"

#include <bit>
#include <cmath>

namespace shoal::media {

namespace {

// Element ids of RFC 9559.
enum : uint32_t {
    kSegment = 0x18538067,
    kCluster = 0x1F43B675,
    kTracks = 0x1654AE6B,
    kTrackEntry = 0xAE,
    kVideo = 0xE0,
    kPixelWidth = 0xB0,
    kPixelHeight = 0xBA,
    kStereoMode = 0x53B8,
    kProjection = 0x7670,
    kProjectionType = 0x7671,
    kPoseYaw = 0x7673,
    kPosePitch = 0x7674,
    kPoseRoll = 0x7675,
};

constexpr int kMaxElements = 4096;

struct Scan {
    const BoundedStream& file;
    SphericalMetadata found{};
    int elements = 0;

    struct Number {
        uint64_t value = 0;
        int length = 0; // 0: not a number
        bool allOnes = false;
    };

    // Variable-size integer, RFC 8794 section 4; an id keeps its length marker.
    Number variable(uint64_t at, uint64_t end, bool isId) const {
        uint8_t byte = 0;
        if (at >= end || !file.read(at, {&byte, 1}) || byte == 0) return {};
        const int length = std::countl_zero(byte) + 1;
        std::array<uint8_t, 8> bytes{};
        if (end - at < static_cast<uint64_t>(length) ||
            !file.read(at, std::span(bytes).first(static_cast<size_t>(length))))
            return {};
        Number number{isId ? byte : static_cast<uint8_t>(byte & (0xff >> length)), length, false};
        for (int i = 1; i < length; ++i) number.value = number.value << 8 | bytes[static_cast<size_t>(i)];
        number.allOnes = number.value == (uint64_t{1} << (7 * length)) - 1;
        return number;
    }

    uint64_t unsignedAt(uint64_t at, uint64_t size) const {
        std::array<uint8_t, 8> bytes{};
        if (size == 0 || size > 8 || !file.read(at, std::span(bytes).last(size))) return 0;
        return big64(bytes, 0);
    }

    float floatAt(uint64_t at, uint64_t size) const {
        const uint64_t bits = unsignedAt(at, size);
        const double value = size == 4   ? std::bit_cast<float>(static_cast<uint32_t>(bits))
                             : size == 8 ? std::bit_cast<double>(bits)
                                         : 0.0;
        return std::abs(value) <= 360 ? static_cast<float>(value) : 0.0f;
    }

    void leaf(uint32_t id, uint64_t at, uint64_t size) {
        if (id == kPixelWidth) found.frameWidth = static_cast<int>(unsignedAt(at, size) & 0xffffff);
        if (id == kPixelHeight) found.frameHeight = static_cast<int>(unsignedAt(at, size) & 0xffffff);
        if (id == kPoseYaw) found.yaw_deg = floatAt(at, size);
        if (id == kPosePitch) found.pitch_deg = floatAt(at, size);
        if (id == kPoseRoll) found.roll_deg = floatAt(at, size);
        if (id == kStereoMode) {
            const uint64_t mode = unsignedAt(at, size);
            found.layout = mode == 0                 ? Layout::Mono
                           : mode == 1 || mode == 11 ? Layout::LeftRight
                           : mode == 2 || mode == 3  ? Layout::TopBottom
                                                     : Layout::Auto;
        }
        if (id == kProjectionType) {
            const uint64_t type = unsignedAt(at, size);
            found.present = type >= 1 && type <= 3;
            if (found.present) found.projection = static_cast<Projection>(type);
        }
    }

    // Returns false when the search is over.
    bool walk(uint64_t at, uint64_t end, int depth) {
        while (at < end) {
            if (++elements > kMaxElements) return false;
            const Number id = variable(at, end, true);
            if (id.length == 0 || id.length > 4) return false;
            at += static_cast<uint64_t>(id.length);
            const Number stated = variable(at, end, false);
            if (stated.length == 0) return false;
            at += static_cast<uint64_t>(stated.length);
            const uint64_t size = stated.allOnes ? end - at : std::min(stated.value, end - at);
            const auto name = static_cast<uint32_t>(id.value);
            if (name == kCluster) return false; // the tracks come before the pictures
            const bool container = name == kSegment || name == kTracks || name == kTrackEntry ||
                                   name == kVideo || name == kProjection;
            if (container && depth < 6) {
                if (!walk(at, at + size, depth + 1)) return false;
                if (name == kVideo) return false; // the first video track decides
            } else if (!container) {
                leaf(name, at, size);
            }
            at += size;
        }
        return true;
    }
};

} // namespace

SphericalMetadata webmMetadataOf(const BoundedStream& file) {
    Scan scan{.file = file};
    scan.walk(0, file.size, 0);
    if (!scan.found.present) { // a flat video: a stated StereoMode says nothing of a panorama
        scan.found.layout = Layout::Auto;
        scan.found.yaw_deg = scan.found.pitch_deg = scan.found.roll_deg = 0;
    }
    return scan.found;
}

} // namespace shoal::media
