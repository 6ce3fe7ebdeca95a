// A stream as a live encoder makes it: H.264 without pictures that wait for later ones.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace shoal::media::test {

struct MadeStream {
    std::string description;                      // SDP
    std::vector<std::vector<std::string>> pieces; // by picture: what goes over the line, piece by piece
};

// Grey pictures of these levels (0 to 255), 30 a second, every eighth a key picture. format: of FFmpeg, such
// as "mpegts" or "rtp", with its options as "name=value". Empty: FFmpeg has no encoder for it here.
std::optional<MadeStream> makeStream(const std::string& format, const std::string& options,
                                     const std::vector<int>& greys, int width = 64, int height = 32);

} // namespace shoal::media::test
