// The one approximate body of a model: ellipsoids attached to its joints. Occlusion and shadows come from it.
#pragma once

#include "engine/occlusion/EllipsoidOcclusion.h"
#include "engine/occlusion/FitEllipsoids.h"
#include "engine/scene/Model.h"

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

// The model's meshes and pictures must still be there.
BodyOccluders makeBodyOccluders(const scene::Model& model, const scene::Pose& rest, occlusion::Parts parts,
                                size_t maximum);
// Of parts that are known: model frame, at rest; joint: the node that carries it.
BodyOccluders makeBodyOccluders(const scene::Model& model, const scene::Pose& rest,
                                std::span<const occlusion::BodyPart> parts, bool onItself);

// How much the body's own parts count, from 0 at rest, where the baked self-occlusion says all, to 1. parts:
// all of them, placed.
float ownStrength(const BodyOccluders& body, std::span<const occlusion::Ellipsoid> parts);

// The part in the world. worldFromModel may scale, alike in all directions.
occlusion::Ellipsoid placed(const BodyOccluders::Part& part, const scene::Pose& pose,
                            const glm::mat4& worldFromModel);

} // namespace shoal::render
