// Compares the occlusion of animals by a map of distances with the truth: the film hides animals where it
// shows something nearer.
#pragma once

#include "content/make/depth/DepthTrackWriter.h"
#include "engine/depth/DepthMap.h"

#include <array>

namespace shoal::bench {

constexpr std::array<float, 5> kAnimals_m = {1, 1.5f, 2.5f, 4, 6}; // distances that they are tried at

// Masks for each of kAnimals_m, in the texels of the truth: 1 where the film is nearer and hides an animal.
using HiddenTexels = std::array<Image<uint8_t, 1>, kAnimals_m.size()>;
void hiddenInTruth(const media::DepthFrame& truth, HiddenTexels& out);
// Reads the map linearly between its texels, as shaders do. An empty map hides nothing.
void hiddenInMap(const depth::DepthMap& map, int width, HiddenTexels& out);

// Returns the best frame of that width: each texel is the median of the truth's texels in it.
media::DepthFrame reduced(const media::DepthFrame& truth, int width, int stepsPerOctave);

// Sums over frames and distances. Areas are solid angles.
class HidingError {
  public:
    void add(const HiddenTexels& truth, const HiddenTexels& found);
    // Adds two consecutive frames.
    void addFlicker(const HiddenTexels& truthBefore, const HiddenTexels& truth,
                    const HiddenTexels& foundBefore, const HiddenTexels& found);

    // Errors in percent of the area of those fish that the film hides in part.
    double wronglyHidden() const { return 100 * fishHidden_ / fish_; }
    double wronglyShown() const { return 100 * fishShown_ / fish_; }
    // Errors in percent of all directions.
    double wronglyHiddenAnywhere() const { return 100 * hidden_ / all_; }
    double wronglyShownAnywhere() const { return 100 * shown_ / all_; }
    // Mean width of the wrong area along the truth's edges, texels of the truth.
    double boundary() const { return (hidden_ + shown_) / length_ / texel_; }
    // Mean width along the edges, in texels of the truth, of the area that changes from frame to frame where
    // the truth does not; and of the area that changes in the truth.
    double flicker() const { return toggled_ / flickerLength_ / texel_; }
    double trueChange() const { return truthToggled_ / flickerLength_ / texel_; }

  private:
    void addFish(const Image<uint8_t, 1>& truth, const Image<uint8_t, 1>& found, float distance_m);

    double hidden_ = 0, shown_ = 0, all_ = 0, length_ = 0; // lengths in radians
    double fishHidden_ = 0, fishShown_ = 0, fish_ = 0;     // samples
    double toggled_ = 0, truthToggled_ = 0, flickerLength_ = 0;
    double texel_ = 1; // radians
};

} // namespace shoal::bench
