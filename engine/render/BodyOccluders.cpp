#include "engine/render/BodyOccluders.h"

#include "engine/scene/Surface.h"

#include <algorithm>
#include <cmath>

namespace shoal::render {

namespace {

occlusion::Ellipsoid<float> transformed(const occlusion::Ellipsoid<float>& e, const glm::mat4& to) {
    const glm::mat3 m(to);
    const float scale = std::cbrt(std::abs(glm::determinant(m)));
    occlusion::Ellipsoid<float> out = e;
    out.centre = glm::vec3(to * glm::vec4(e.centre, 1));
    out.worldFromAxes = m * e.worldFromAxes;
    for (int k = 0; k < 3; ++k) out.worldFromAxes[k] = glm::normalize(out.worldFromAxes[k]);
    out.semiAxes = e.semiAxes * scale;
    return out;
}

} // namespace

BodyOccluders makeBodyOccluders(const scene::Model& model, const scene::Pose& rest, occlusion::Parts parts,
                                size_t most) {
    BodyOccluders body;
    body.albedo = scene::meanBaseColour(model);
    body.onItself = parts == occlusion::Parts::ByJoint;
    const scene::Surface surface = scene::posedSurface(model, rest);
    for (const occlusion::BodyPart& part :
         occlusion::fitEllipsoids({surface.positions, surface.indices, surface.nodesOf}, parts, most)) {
        const glm::mat4 nodeFromModel = glm::inverse(rest.modelFromNode[part.joint]);
        body.parts.push_back({transformed(part.atRest, nodeFromModel), part.joint});
    }
    return body;
}

occlusion::Ellipsoid<float> placed(const BodyOccluders::Part& part, const scene::Pose& pose,
                                   const glm::mat4& worldFromModel) {
    return transformed(part.inNode, worldFromModel * pose.modelFromNode[static_cast<size_t>(part.node)]);
}

} // namespace shoal::render
