// Made films of known depth: a ray caster of textured spheres and a floor, with what makes depth hard to
// estimate, one thing a scene.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"

#include <span>
#include <string>

namespace shoal::bench {

// Sideways is what all others are to be compared with.
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
