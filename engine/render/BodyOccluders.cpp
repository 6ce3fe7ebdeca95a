#include "engine/render/BodyOccluders.h"

#include "engine/scene/Surface.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::render {

namespace {

// Of the body's length that a part has moved against the first: an idle hand's fingers 0.12, one that holds a
// fish more than 0.3.
constexpr float kStill = 0.15f, kBent = 0.3f;

occlusion::Ellipsoid transformed(const occlusion::Ellipsoid& e, const glm::mat4& to) {
    const glm::mat3 m(to);
    const float scale = std::cbrt(std::abs(glm::determinant(m)));
    occlusion::Ellipsoid out = e;
    out.centre = glm::vec3(to * glm::vec4(e.centre, 1));
    out.worldFromAxes = m * e.worldFromAxes;
    for (int k = 0; k < 3; ++k) out.worldFromAxes[k] = glm::normalize(out.worldFromAxes[k]);
    out.semiAxes = e.semiAxes * scale;
    return out;
}

glm::vec3 seenFrom(const occlusion::Ellipsoid& part, const glm::vec3& place) {
    return (place - part.centre) * part.worldFromAxes; // the transpose's product
}

} // namespace

BodyOccluders makeBodyOccluders(const scene::Model& model, const scene::Pose& rest, occlusion::Parts parts,
                                size_t maximum) {
    const scene::Surface surface = scene::posedSurface(model, rest);
    return makeBodyOccluders(
        model, rest,
        occlusion::fitEllipsoids({surface.positions, surface.indices, surface.nodesOf}, parts, maximum),
        parts == occlusion::Parts::ByJoint);
}

BodyOccluders makeBodyOccluders(const scene::Model& model, const scene::Pose& rest,
                                std::span<const occlusion::BodyPart> parts, bool onItself) {
    BodyOccluders body;
    body.albedo = scene::meanBaseColour(model);
    body.onItself = onItself;
    for (const occlusion::BodyPart& part : parts) {
        const glm::mat4 nodeFromModel = glm::inverse(rest.modelFromNode[part.joint]);
        body.parts.push_back({transformed(part.atRest, nodeFromModel), part.joint});
    }
    std::vector<occlusion::Ellipsoid> atRest;
    for (BodyOccluders::Part& part : body.parts) {
        atRest.push_back(placed(part, rest, glm::mat4(1)));
        part.atRest = seenFrom(atRest[0], atRest.back().centre);
        for (const auto& other : atRest)
            body.length = std::max(body.length, glm::distance(other.centre, atRest.back().centre));
    }
    return body;
}

float ownStrength(const BodyOccluders& body, std::span<const occlusion::Ellipsoid> parts) {
    if (!body.onItself || parts.empty() || body.length <= 0) return 0;
    const float scale = parts[0].semiAxes.x / body.parts[0].inNode.semiAxes.x;
    float moved = 0;
    for (size_t k = 0; k < parts.size(); ++k)
        moved =
            std::max(moved, glm::distance(seenFrom(parts[0], parts[k].centre), scale * body.parts[k].atRest));
    return glm::smoothstep(kStill, kBent, moved / (scale * body.length));
}

occlusion::Ellipsoid placed(const BodyOccluders::Part& part, const scene::Pose& pose,
                            const glm::mat4& worldFromModel) {
    return transformed(part.inNode, worldFromModel * pose.modelFromNode[static_cast<size_t>(part.node)]);
}

} // namespace shoal::render
