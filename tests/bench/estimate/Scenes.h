// Synthetic films of known depth: a ray caster draws textured spheres and a floor. Each scene has one thing
// that makes depth hard to estimate.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"

#include <span>
#include <string>

namespace shoal::bench {

// Properties that make depth hard to estimate; Sideways is the reference for all others.
enum class Hardship {
    Sideways,    // a camera that moves to the right
    Forward,     // along the line of sight, its own axis
    Rotation,    // it only turns
    Still,       // it stands
    Caustics,    // sideways, patterns of light run over everything
    Animal,      // sideways, a large animal swims by
    Featureless, // sideways, only a quarter of the objects has any texture
    Darkness,    // sideways, a twentieth of the light, with noise
    Exposure,    // sideways, the exposure changes with time and from row to row
    SeamPoles,   // sideways, texture only at the seam and at both poles
    Stereo,      // omnidirectional stereo, 64 mm, left eye above right; the camera stands
};

struct NamedScene {
    Hardship hardship;
    std::string name;
};
std::span<const NamedScene> scenes();

// Writes NAME.mp4 and the truth, NAME.truth.mkv, to the folder.
Status makeScene(const NamedScene& scene, const Path& folder);

} // namespace shoal::bench
