// A model as what takes light from others: ellipsoids that ride on its joints.
#pragma once

#include "engine/occlusion/FitEllipsoids.h"
#include "engine/occlusion/Shade.h"
#include "engine/scene/Model.h"

#include <vector>

namespace shoal::render {

struct BodyOccluders {
    struct Part {
        occlusion::Ellipsoid<float> inNode; // in the frame of the node that carries it
        int node = 0;
    };
    std::vector<Part> parts;
    glm::vec3 albedo{0};   // mean; linear
    bool onItself = false; // they take the body's own light too: of what bends sharply
};

// The model's meshes and pictures must still be there.
BodyOccluders makeBodyOccluders(const scene::Model& model, const scene::Pose& rest, occlusion::Parts parts,
                                size_t most);

// The part in the world. worldFromModel may scale, alike in all directions.
occlusion::Ellipsoid<float> placed(const BodyOccluders::Part& part, const scene::Pose& pose,
                                   const glm::mat4& worldFromModel);

} // namespace shoal::render
