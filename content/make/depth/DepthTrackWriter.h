// Writer of depth tracks (engine/media/DepthTrack.h reads them), and rounding of distances for them.
#pragma once

#include "engine/media/DepthTrack.h"

#include <span>
#include <string>

namespace shoal::media {

// Number of a track's codes for each octave of inverse distance. More codes make the track larger, and nobody
// sees the difference (tests/bench/figures/depth.md).
constexpr int kDepthStepsPerOctave = 16;
constexpr int kExactDepthSteps = 1024; // uses all codes

// Returns the code of an inverse distance, rounded to that many steps (a power of two) an octave.
uint16_t depthCode(float inverse_perM, int stepsPerOctave = kDepthStepsPerOctave);

// Makes a track, frame by frame.
class DepthTrackWriter {
  public:
    // films: identities of the films that the track belongs to, see filmIdentity(). The width is a power of
    // two, the height half of it. All frames stay in memory until finish(). FFmpeg's encoder allocates 148
    // bytes a texel at once: a width above 1024 needs a higher av_max_alloc() than setUpDecoders() leaves.
    static Result<DepthTrackWriter> make(const DepthTrackInfo& info, std::span<const std::string> films);

    Status add(const DepthFrame& frame);
    Status finish(const Path& file); // once all frames are there

  private:
    struct Impl;
    explicit DepthTrackWriter(Hidden<Impl> impl) : impl_(std::move(impl)) {}
    Hidden<Impl> impl_;
};

} // namespace shoal::media
