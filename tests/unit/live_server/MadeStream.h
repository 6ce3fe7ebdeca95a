// A stream as a live encoder makes it: H.264 without B-frames.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace shoal::media::test {

struct MadeStream {
    std::string description;                      // SDP
    std::vector<std::vector<std::string>> pieces; // [picture][piece]: bytes to send
};

// Encodes a grey picture of each level (0 to 255), 30 a second, every eighth a keyframe. format: FFmpeg's
// name, such as "mpegts" or "rtp". options: "name=value". Returns nothing if FFmpeg lacks the encoder.
std::optional<MadeStream> makeStream(const std::string& format, const std::string& options,
                                     const std::vector<int>& greys, int width = 64, int height = 32);

} // namespace shoal::media::test
