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
        glm::vec3 atRest{0}; // its centre in the first part's axes, of their centre, at rest
    };
    std::vector<Part> parts;
    glm::vec3 albedo{0};   // mean; linear
    bool onItself = false; // they take the body's own light too, once bent: of what bends sharply
    float length = 0;      // of all of it at rest, from centre to centre
};

// parts: model frame, at rest; joint: the node that carries it. The model's meshes and pictures must still be
// there.
BodyOccluders makeBodyOccluders(const scene::Model& model, const scene::Pose& rest,
                                std::span<const occlusion::BodyPart> parts, bool onItself);

// How much the body's own parts count, from 0 at rest, where the baked self-occlusion says all, to 1. parts:
// all of them, placed.
float ownStrength(const BodyOccluders& body, std::span<const occlusion::Ellipsoid> parts);

// The part in the world. worldFromModel may scale, alike in all directions.
occlusion::Ellipsoid placed(const BodyOccluders::Part& part, const scene::Pose& pose,
                            const glm::mat4& worldFromModel);

// Which bodies stand so near another that they take light from it.

using shoal::Sphere;

// As shaders/occlusion/Bodies.glsl has it, std140.
struct PackedOccluder {
    glm::vec4 centreStrength{0};
    glm::vec4 diagonalVolume{0}; // of the matrix that makes it a sphere, squared; product of its semi-axes
    glm::vec4 mixed{0};          // yz, zx, xy of that matrix
    glm::vec4 albedo{0};
};
static_assert(sizeof(PackedOccluder) == 64);

// A frame: clear(), add() for each body, then near() for each. Nothing allocates once the vectors have grown.
class NearBodies {
  public:
    void clear();
    size_t count() const { return bodies_.size(); }
    // Returns the body's number, from 0. bound: holds it.
    size_t add(const BodyOccluders& body, const scene::Pose& pose, const glm::mat4& worldFromModel,
               const Sphere& bound);

    // The body's ellipsoids, world frame.
    std::span<const occlusion::Ellipsoid> ellipsoids(size_t body) const {
        return std::span(shapes_).subspan(bodies_[body].first, bodies_[body].count);
    }

    struct Near {
        std::span<const PackedOccluder> occluders;
        size_t own = 0;        // the first of them are the body's own,
        float ownStrength = 0; // which count that much
    };
    // What takes light from this body: its own parts, where they do, and no more than MAX_OTHERS of others,
    // those that take most. Their strengths fade towards the least share worth taking, and towards the first
    // that is left out, so that nothing pops. In the light's frame.
    Near near(size_t body, const glm::mat3& lightFromWorld);

  private:
    struct Size {                  // of a part
        float reach = 0, size = 0; // longest semi-axis; that of a disc as large as its largest shadow
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
    std::vector<occlusion::Ellipsoid> shapes_; // of all bodies
    std::vector<Size> sizes_;                  // of each
    std::vector<Body> bodies_;
    std::vector<Found> found_;
    std::vector<PackedOccluder> packed_;
};

} // namespace shoal::render
