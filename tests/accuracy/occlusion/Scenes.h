// Scenes of the game's bodies near each other, and light of the game's own environment.
#pragma once

#include "content/make/models/occlusion/Silhouettes.h"
#include "engine/core/Image.h"
#include "engine/render/BodyOccluders.h"
#include "engine/scene/Surface.h"

#include <memory>
#include <string>
#include <vector>

namespace shoal {

struct SceneBody {
    scene::Surface surface; // in the world
    glm::vec3 albedo{0};
    std::vector<occlusion::Occluder> parts;
    bool onItself = false;                // bodies also occlude themselves
    std::vector<glm::vec4> selfOcclusion; // occlusion::traceSelfOcclusion(), by position, world
};

struct OcclusionScene {
    std::string name;
    std::vector<SceneBody> bodies;
    std::vector<size_t> receivers; // bodies whose light is measured
};

// The first body is a fish that lies still, the second a hand.
class ClosingHand {
  public:
    ClosingHand();
    OcclusionScene at(float curl) const; // 0 an open hand to 1 a fist

  private:
    struct ModelInstances;
    std::shared_ptr<ModelInstances> instances_;
};

OcclusionScene handOnFish(float curl);
OcclusionScene handBySelf(float curl); // its own light
OcclusionScene sharkAboveShoal();

// Returns the light that the game makes of a frame of the dive's video, 64 x 32 texels.
ImageRgbF reefLight(int64_t frame);

} // namespace shoal
