// Depth of a film: the distance of what it shows, in every direction and at every time, read from a small
// second video beside it, whose layout content/README.md documents. One thread at a time.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Hidden.h"
#include "engine/core/Result.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace shoal::media {

// Inverse metres and confidence are stored in ten bits.
constexpr int kMaxDepthCode = 1023;
constexpr float kMaxInverse_perM = 4; // of the highest code: nothing is nearer than 0.25 m

// One frame, equirectangular as the film is, rows from the top. Distances are radial, from the film's camera.
struct DepthFrame {
    int width = 0, height = 0;
    std::vector<uint16_t> inverse;    // 0: beyond all measure
    std::vector<uint16_t> confidence; // 0 to kMaxDepthCode; half as wide and half as high

    float inverse_perM(int x, int y) const {
        return static_cast<float>(inverse[static_cast<size_t>(y * width + x)]) *
               (kMaxInverse_perM / kMaxDepthCode);
    }
};

struct DepthTrackInfo {
    int width = 0, height = 0;
    int frameCount = 0;
    double duration_s = 0; // of the film; frame i belongs to the time i / frameCount of it
};

// FILM.depth.mkv for FILM.mp4 and, as both show the same, for FILM.small.mp4.
Path depthTrackOf(const Path& film);

// What a track says of the film that it belongs to: FNV-1a of its first megabyte, sixteen hexadecimal digits.
Result<std::string> filmIdentity(const Path& film);

class DepthTrack {
  public:
    // Reads from the file as long as it lives. An error where that is cut, of another film, or no track of
    // this version. film: empty for a track by itself, of whatever film.
    static Result<DepthTrack> open(const Path& file, const Path& film = {});

    const DepthTrackInfo& info() const;

    // The number of the frame nearest to this time of the film, which repeats for ever.
    int frameAt(double time_s) const;

    // False: damaged there, by its checksums; `out` is as it was. Of ours, allocates only where `out` has
    // another size.
    bool read(int number, DepthFrame& out);

  private:
    struct Impl;
    explicit DepthTrack(Hidden<Impl> impl) : impl_(std::move(impl)) {}
    Hidden<Impl> impl_;
};

} // namespace shoal::media
