// Scenes in which bodies stand in their own or each other's light.
#pragma once

#include "engine/core/Result.h"
#include "engine/occlusion/Ellipsoid.h"
#include "tests/bench/occlusion/Mesh.h"
#include "tests/bench/occlusion/Rays.h"

#include <string>
#include <vector>

namespace shoal::bench {

// World frame, metres. A body without a skin has one bone.
struct Body {
    std::string name;
    Mesh posed;                             // in the world
    Mesh rest;                              // as its file has it, at the size it has in the world
    std::vector<int> boneOf;                // per vertex: the bone that moves it most
    std::vector<glm::mat4> worldFromRest;   // per bone; may scale
    std::vector<glm::mat3> turned;          // per vertex: as the skin turns it from rest; may scale
    std::vector<occlusion::BodyPart> parts; // of what bends sharply, as the game keeps them: at rest, by bone
    std::vector<glm::vec4> selfOcclusionBesideOwn; // likewise, per vertex
    int group = 0;                                 // half of the receivers lie on each group's bodies
    glm::vec3 albedoLin{0.7f};                     // how pictures show it
    glm::vec3 sentBack{0}; // of the light that falls on it, what others get: 0, a black body
};

struct Camera {
    glm::vec3 eye{0}, target{0};
    float fovY = 0.6f; // radians
};

struct Scene {
    std::string name;
    std::vector<Body> bodies;
    Camera camera;
    float nearest = 1e-4f; // rays start so far from a surface
    bool mirror = false;   // how the pictures show it

    std::vector<const Mesh*> meshes() const {
        std::vector<const Mesh*> all;
        for (const Body& body : bodies) all.push_back(&body.posed);
        return all;
    }
};

// Six of black bodies, and the last two of them again with bodies of their colours. Fins let some light
// through: those of the fish that is alone count as solid, the others' not at all.
Result<std::vector<Scene>> makeScenes();

// A place on a surface whose light is asked for.
struct Receiver {
    glm::vec3 position{0}; // off the flat triangle, where the smooth surface would be
    glm::vec3 normal{0};   // smooth
    glm::vec3 mirrored{0}; // the camera's ray, reflected
    size_t body = 0;
    uint32_t triangle = 0;
    glm::vec3 weights{0}; // of its corners
};

Receiver receiverAt(const Scene& scene, size_t body, uint32_t triangle, const glm::vec3& weights);

// Receivers spread by area: half on each group's bodies.
std::vector<Receiver> spreadReceivers(const Scene& scene, int count);

} // namespace shoal::bench
