// Scenes in which bodies occlude themselves or each other.
#pragma once

#include "engine/occlusion/Ellipsoid.h"
#include "tests/bench/Bench.h"
#include "tests/bench/occlusion/Mesh.h"
#include "tests/bench/occlusion/Rays.h"

namespace shoal::bench {

// World frame, metres. A body without a skin has one bone.
struct Body {
    std::string name;
    Mesh posed;                             // in the world
    Mesh rest;                              // pose of its file, scaled to its size in the world
    std::vector<int> boneOf;                // per vertex: the bone that moves it most
    std::vector<glm::mat4> worldFromRest;   // per bone; may scale
    std::vector<glm::mat3> turned;          // per vertex: the skin's rotation from rest; may scale
    std::vector<occlusion::BodyPart> parts; // ellipsoids of a body that bends sharply, at rest, by bone
    std::vector<glm::vec4> selfOcclusionBesideOwn; // likewise, per vertex
    int group = 0;                                 // half of the receivers lie on each group's bodies
    glm::vec3 albedoLin{0.7f};                     // albedo in pictures
    glm::vec3 sentBack{0};                         // albedo for the light that others get; 0: a black body
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
    bool mirror = false;   // pictures show it as a mirror

    std::vector<const Mesh*> meshes() const {
        std::vector<const Mesh*> all;
        for (const Body& body : bodies) all.push_back(&body.posed);
        return all;
    }
};

// Makes six scenes of black bodies, and the last two again with coloured bodies. Fins let some light through:
// those of the single fish count as solid, all others are left out.
Result<std::vector<Scene>> makeScenes();

// A point of a surface at which the light is measured.
struct Receiver {
    glm::vec3 position{0}; // on the smooth surface, off the flat triangle
    glm::vec3 normal{0};   // smooth
    glm::vec3 mirrored{0}; // direction of the reflected camera ray
    size_t body = 0;
    glm::uvec3 corners{0}; // of the triangle: vertices of the body's meshes
    glm::vec3 weights{0};  // of the corners

    // Interpolates values of the body's vertices.
    template <class T> T mix(const std::vector<T>& values) const {
        return weights.x * values[corners.x] + weights.y * values[corners.y] + weights.z * values[corners.z];
    }
};

Receiver receiverAt(const Scene& scene, const Touch& touch);

// Receivers spread by area: half on each group's bodies.
std::vector<Receiver> spreadReceivers(const Scene& scene, int count);

} // namespace shoal::bench
