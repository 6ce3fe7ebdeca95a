// Encodes frames to a video file as the dive's own film was, by the program ffmpeg.
#pragma once

#include "tests/bench/Bench.h"

namespace shoal::bench {

// Frames: all of one size, red first. Uses the dive's encoder at its rate (3.9 Mbit/s at 24 frames a second).
inline Status encode(const Path& file, std::span<const ImageRgb8> frames, int fps) {
    const std::string size = std::to_string(frames[0].width) + "x" + std::to_string(frames[0].height);
    const std::string command =
        "ffmpeg -loglevel error -y -f rawvideo -pix_fmt rgb24 -s " + size + " -r " + std::to_string(fps) +
        " -i - -vf scale=out_color_matrix=bt709:out_range=tv,format=yuv420p -c:v libx264 -preset faster"
        " -b:v 3900k -maxrate 7M -bufsize 14M -g 240"
        " -x264-params ipratio=1.05:pbratio=1.1:mbtree=0:open-gop=0 -colorspace bt709 -color_primaries bt709"
        " -color_trc bt709 -color_range tv '" +
        file.string() + "'";
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "w"), pclose);
    if (!pipe) return Error{file.string(), "cannot be encoded: ffmpeg did not start"};
    for (const ImageRgb8& frame : frames)
        if (std::fwrite(frame.pixels.data(), 1, frame.pixels.size(), pipe.get()) != frame.pixels.size())
            return Error{file.string(), "cannot be encoded: ffmpeg stopped listening"};
    return Done{};
}

} // namespace shoal::bench
