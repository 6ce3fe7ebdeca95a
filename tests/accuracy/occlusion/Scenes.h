// Scenes of the game's bodies near each other, and light of the game's own environment.
#pragma once

#include "content/make/models/occlusion/Silhouettes.h"
#include "engine/core/Image.h"
#include "engine/render/BodyOccluders.h"
#include "engine/scene/Surface.h"

#include <functional>
#include <vector>

namespace shoal {

struct SceneBody {
    scene::Surface surface; // in the world
    glm::vec3 albedo{0};
    std::vector<occlusion::Occluder> parts;
    std::vector<glm::vec4> selfOcclusion; // occlusion::traceSelfOcclusion(), by position, world
};

struct OcclusionScene {
    std::vector<SceneBody> bodies;
    std::vector<size_t> receivers; // bodies whose light is measured
};

// The first body is a fish that lies still, the second a hand: 0 open to 1 a fist.
using ClosingHand = std::function<OcclusionScene(float curl)>;
ClosingHand closingHand();

OcclusionScene handOnFish(float curl);
OcclusionScene handBySelf(float curl); // its own light
OcclusionScene sharkAboveShoal();

// Returns the light that the game makes of a frame of the dive's video, 64 x 32 texels.
ImageRgbF reefLight(int frame);

} // namespace shoal
