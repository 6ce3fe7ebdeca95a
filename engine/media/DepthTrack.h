// Depth of a film: its distances in every direction and at every time, read from a small second video beside
// it, whose layout content/README.md documents. One thread at a time.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Hidden.h"
#include "engine/core/Result.h"

extern "C" {
#include <libavutil/pixfmt.h>
}

#include <cstdint>
#include <string>
#include <vector>

namespace shoal::media {

// Highest code: inverse distances and confidences are stored in ten bits.
constexpr int kMaxDepthCode = 1023;
constexpr float kMaxInverse_perM = 4; // of the highest code: anything nearer than 0.25 m counts as 0.25 m

// One frame, equirectangular as the film is, rows from the top. Distances are radial, from the film's camera.
struct DepthFrame {
    int width = 0, height = 0;
    std::vector<uint16_t> inverse;    // 0: infinitely far
    std::vector<uint16_t> confidence; // 0 to kMaxDepthCode; half as wide and half as high

    float inverse_perM(int x, int y) const {
        return static_cast<float>(inverse[static_cast<size_t>(y * width + x)]) *
               (kMaxInverse_perM / kMaxDepthCode);
    }
};

struct DepthTrackInfo {
    int width = 0, height = 0;
    int frameCount = 0;
    double duration_s = 0; // length of the film; frame i belongs to the time i / frameCount of it
};

// --- The file, as its reader and its writer (content/make/depth) have it

// Plane Y is the inverse distance, Cb the confidence; Cr is 512 throughout.
constexpr AVPixelFormat kDepthPixels = AV_PIX_FMT_YUV420P10LE;

// Tags of the file, and the values of those that never change.
namespace depth_tags {
constexpr const char* kVersion = "SHOAL_DEPTH";
constexpr const char* kVersionValue = "1";
constexpr const char* kFrames = "SHOAL_FRAMES";
constexpr const char* kDuration = "SHOAL_DURATION"; // of the film, seconds
constexpr const char* kLayout = "SHOAL_LAYOUT";
constexpr const char* kLayoutValue = "equirectangular mono";
constexpr const char* kFilms = "SHOAL_FILMS"; // identities of films, with blanks between them
} // namespace depth_tags

// Returns whether a track can have this size, frame count and duration. Widths are powers of two, so that a
// texel fills a whole number of texels in maps of distances.
bool isDepthTrack(const DepthTrackInfo& info);

// Returns FILM.depth.mkv for FILM.mp4 and for FILM.small.mp4, which show the same.
Path depthTrackOf(const Path& film);

// Returns a film's identity, as tracks store it: FNV-1a of its first megabyte, 16 hexadecimal digits.
Result<std::string> filmIdentity(const Path& film);

class DepthTrack {
  public:
    // Opens a track, which reads from the file as long as it lives. Fails if the file is cut short, belongs
    // to another film or is no track of this version. film: the film's file; empty accepts any film's track.
    static Result<DepthTrack> open(const Path& file, const Path& film = {});

    const DepthTrackInfo& info() const;

    // Returns the number of the frame nearest to this time of the film, which repeats without end.
    int frameAt(double time_s) const;

    // Reads a frame; false, `out` unchanged, if checksums show damage. Our code allocates for new sizes only.
    bool read(int number, DepthFrame& out);

  private:
    struct Impl;
    explicit DepthTrack(Hidden<Impl> impl) : impl_(std::move(impl)) {}
    Hidden<Impl> impl_;
};

} // namespace shoal::media
