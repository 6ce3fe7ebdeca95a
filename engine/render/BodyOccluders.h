// The one approximate body of a model: ellipsoids attached to its joints. Occlusion and shadows come from it.
#pragma once

#include "engine/occlusion/Ellipsoid.h"
#include "engine/scene/Model.h"

#include <glm/vec4.hpp>

#include <span>
#include <vector>

namespace shoal::render {

struct BodyOccluders {
    struct Part {
        occlusion::Ellipsoid inNode; // in the frame of the node that carries it
        int node = 0;
        glm::vec3 atRest{0}; // its centre at rest, from the first part's centre and in its axes
    };
    std::vector<Part> parts;
    glm::vec3 albedo{0};   // mean; linear
    bool onItself = false; // whether the parts occlude their own body where it is bent
    float length = 0;      // greatest distance of two centres at rest
};

// parts: model frame, at rest; joint: the node that carries it. The model's meshes and pictures must still be
// there.
BodyOccluders makeBodyOccluders(const scene::Model& model, const scene::Pose& rest,
                                std::span<const occlusion::BodyPart> parts, bool onItself);

// Returns how strongly the body's parts occlude the body itself, from 0 at rest, where its baked
// self-occlusion is complete, to 1. parts: all of them, in the world.
float ownStrength(const BodyOccluders& body, std::span<const occlusion::Ellipsoid> parts);

// Returns the part in the world. worldFromModel may scale uniformly.
occlusion::Ellipsoid placed(const BodyOccluders::Part& part, const scene::Pose& pose,
                            const glm::mat4& worldFromModel);

using shoal::Sphere;

// Layout of shaders/occlusion/Bodies.glsl, std140.
struct PackedOccluder {
    glm::vec4 centreStrength{0};
    glm::vec4 diagonalVolume{0}; // diagonal of Q, where x Q x = 1 on the surface; product of the semi-axes
    glm::vec4 mixed{0};          // yz, zx, xy of Q
    glm::vec4 albedo{0};
};
static_assert(sizeof(PackedOccluder) == 64);

// Finds the bodies that stand so near another that they take light from it. Each frame calls clear(), add()
// for each body, then near() for each. Allocates nothing once the vectors have grown.
class NearBodies {
  public:
    void clear();
    size_t count() const { return bodies_.size(); }
    // Returns the body's index, from 0. bound: a sphere around it.
    size_t add(const BodyOccluders& body, const scene::Pose& pose, const glm::mat4& worldFromModel,
               const Sphere& bound);

    // Returns the body's ellipsoids, world frame.
    std::span<const occlusion::Ellipsoid> ellipsoids(size_t body) const {
        return std::span(shapes_).subspan(bodies_[body].first, bodies_[body].count);
    }

    struct Near {
        std::span<const PackedOccluder> occluders;
        size_t own = 0;        // how many at the front are the body's own,
        float ownStrength = 0; // and the factor for those
    };
    // Returns what occludes this body, in the light's frame: its own parts, if they do, and of other bodies
    // at most MAX_OTHERS parts, those that take most light. Strengths fade towards the least share that
    // counts, and towards the first part left out, so that nothing pops.
    Near near(size_t body, const glm::mat3& lightFromWorld);

  private:
    struct Size {                  // of a part
        float reach = 0, size = 0; // longest semi-axis; radius of a disc as large as its largest shadow
    };
    struct Body {
        Sphere bound;
        size_t first = 0, count = 0; // parts
        glm::vec3 albedo{0};
        float ownStrength = 0;
    };
    struct Found {
        float share;
        size_t part, body;
    };
    std::vector<occlusion::Ellipsoid> shapes_; // the parts of all bodies
    std::vector<Size> sizes_;                  // one for each ellipsoid
    std::vector<Body> bodies_;
    std::vector<Found> found_;
    std::vector<PackedOccluder> packed_;
};

} // namespace shoal::render
