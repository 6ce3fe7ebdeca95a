// The approximate body of a model: ellipsoids attached to its joints. Occlusion and shadows both use it.
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
        glm::vec3 atRest{0}; // centre at rest, relative to the first part's centre, in that part's axes
    };
    std::vector<Part> parts;
    glm::vec3 albedo{0};         // mean; linear
    bool occludesItself = false; // whether the parts occlude their own body when it bends
    float length = 0;            // greatest distance of two centres at rest
};

// parts: in the model's frame, at rest; BodyPart::joint: node that carries the part. The model's meshes and
// pictures must be loaded.
BodyOccluders makeBodyOccluders(const scene::Model& model, const scene::Pose& rest,
                                std::span<const occlusion::BodyPart> parts, bool occludesItself);

// Returns how strongly the body's parts occlude the body itself: from 0 at rest, where its baked occlusion
// is complete, to 1 when bent. parts: all parts of the body, world frame.
float ownStrength(const BodyOccluders& body, std::span<const occlusion::Ellipsoid> parts);

// Returns the part in the world. worldFromModel may scale uniformly.
occlusion::Ellipsoid placed(const BodyOccluders::Part& part, const scene::Pose& pose,
                            const glm::mat4& worldFromModel);

// Layout of shaders/occlusion/Bodies.glsl, std140.
struct PackedOccluder {
    glm::vec4 centreStrength{0};
    glm::vec4 diagonalVolume{0}; // diagonal of Q (surface: x^T Q x = 1); product of the semi-axes
    glm::vec4 mixed{0};          // yz, zx, xy of Q
    glm::vec4 albedo{0};
};
static_assert(sizeof(PackedOccluder) == 64);

// Finds the bodies that are near enough to another body to occlude it noticeably. Each frame calls clear(),
// add() for each body, then near() for each. Allocates nothing once the vectors have grown.
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
        size_t own = 0;        // number of the body's own parts, which come first
        float ownStrength = 0; // strength of the body's own parts, 0 to 1
    };
    // Returns the ellipsoids that occlude this body, in the light's frame: its own parts, if they occlude it,
    // and the parts of other bodies that cover most of its hemisphere, at most MAX_OTHERS. The strength of a
    // part is 0 at the share of the largest part left out, or at kMinShare, so that parts appear gradually.
    Near near(size_t body, const glm::mat3& lightFromWorld);

  private:
    struct Size {                  // extent of a part
        float reach = 0, size = 0; // longest semi-axis; radius of a disc with the area of the largest shadow
    };
    struct Body {
        Sphere bound;
        size_t first = 0, count = 0; // range of its parts in shapes_
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
