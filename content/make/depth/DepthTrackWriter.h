// Writer of depth tracks (engine/media/DepthTrack.h reads them), and rounding of distances for them.
#pragma once

#include "engine/media/DepthTrack.h"

namespace shoal::media {

// Steps of the codes of a track from one power of two to the next. Finer ones make it larger, and nobody sees
// them (tests/bench/figures/depth.md).
constexpr int kDepthStepsPerOctave = 16;
constexpr int kExactDepthSteps = 1024; // uses all codes

// Returns the code of an inverse distance, rounded to that many steps (a power of two) an octave.
uint16_t depthCode(float inverse_perM, int stepsPerOctave = kDepthStepsPerOctave);

// Makes a track, frame by frame.
class DepthTrackWriter {
  public:
    // films: identities of the films that the track belongs to, see filmIdentity(). The width is a power of
    // two, the height half of it. All stays in memory until it is finished. FFmpeg's encoder takes 148 bytes
    // a texel at once: more than 1024 around needs a higher av_max_alloc() than setUpDecoders() leaves.
    static Result<DepthTrackWriter> make(const DepthTrackInfo& info, std::span<const std::string> films);

    Status add(const DepthFrame& frame);
    Status finish(const Path& file); // once all frames are there

  private:
    struct Impl;
    explicit DepthTrackWriter(Hidden<Impl> impl) : impl_(std::move(impl)) {}
    Hidden<Impl> impl_;
};

} // namespace shoal::media
