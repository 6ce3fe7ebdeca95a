// Compares what a map of distances hides with the truth: animals at a distance are hidden where the film
// shows something nearer.
#pragma once

#include "content/make/depth/DepthTrackWriter.h"
#include "engine/depth/DepthMap.h"

#include <array>
#include <vector>

namespace shoal::bench {

constexpr std::array<float, 5> kAnimals_m = {1, 1.5f, 2.5f, 4, 6}; // distances that they are tried at

// For each of kAnimals_m what is hidden, by the texels of the truth: 1 where the film is nearer.
using HiddenTexels = std::array<Image<uint8_t, 1>, kAnimals_m.size()>;
void hiddenInTruth(const media::DepthFrame& truth, HiddenTexels& out);
// An empty map hides nothing. Linear between its texels, as shaders read it.
void hiddenInMap(const depth::DepthMap& map, int width, HiddenTexels& out);

// The best that a frame of that width can say: the median of the truth's texels in each of its own.
media::DepthFrame reduced(const media::DepthFrame& truth, int width, int stepsPerOctave);

// Sums over frames and distances. Areas are solid angles.
class HidingError {
  public:
    void add(const HiddenTexels& truth, const HiddenTexels& found);
    // Frames that follow each other.
    void addFlicker(const HiddenTexels& truthBefore, const HiddenTexels& truth,
                    const HiddenTexels& foundBefore, const HiddenTexels& found);

    // Percent of the area of fish that an edge crosses.
    double wronglyHidden() const { return 100 * fishHidden_ / fish_; }
    double wronglyShown() const { return 100 * fishShown_ / fish_; }
    // Percent of all directions.
    double wronglyHiddenAnywhere() const { return 100 * hidden_ / all_; }
    double wronglyShownAnywhere() const { return 100 * shown_ / all_; }
    // Mean width of what is wrong along the truth's edges, texels of the truth.
    double boundary() const { return (hidden_ + shown_) / length_ / texel_; }
    // Change from one frame to the next though the truth does not, along the edges, texels of the
    // truth; and what changes in the truth.
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
