#include "tests/bench/occlusion/EllipsoidParts.h"

#include <cmath>

namespace shoal::bench {

namespace {

constexpr size_t kHunterParts = 12, kBodyParts = 4; // as the game fits them

occlusion::Ellipsoid moved(const occlusion::Ellipsoid& at, const glm::mat4& to) {
    occlusion::Ellipsoid out = at;
    const float scale = std::cbrt(std::abs(glm::determinant(glm::mat3(to))));
    out.centre = glm::vec3(to * glm::vec4(at.centre, 1));
    out.worldFromAxes = glm::mat3(to) * at.worldFromAxes / scale;
    out.semiAxes = scale * at.semiAxes;
    return out;
}

} // namespace

std::vector<occlusion::BodyPart> partsOf(const Body& body) {
    if (!body.parts.empty()) return body.parts;
    const std::vector<uint16_t> joints(body.boneOf.begin(), body.boneOf.end());
    std::vector<uint32_t> indices;
    for (const glm::uvec3& t : body.rest.triangles) indices.insert(indices.end(), {t.x, t.y, t.z});
    return occlusion::fitEllipsoids({body.rest.positions, indices, joints}, occlusion::Parts::ByShape,
                                    body.name == "shark" ? kHunterParts : kBodyParts);
}

occlusion::Occluder posed(const occlusion::BodyPart& part, const Body& body) {
    return {moved(part.atRest, body.worldFromRest[part.joint]), 1, body.sentBack};
}

std::vector<std::vector<occlusion::Occluder>> castingOnOthers(const Scene& scene) {
    std::vector<std::vector<occlusion::Occluder>> casting(scene.bodies.size());
    for (size_t b = 0; b < scene.bodies.size(); ++b)
        for (const occlusion::BodyPart& part : partsOf(scene.bodies[b]))
            for (size_t other = 0; other < scene.bodies.size(); ++other)
                if (other != b) casting[other].push_back(posed(part, scene.bodies[b]));
    return casting;
}

} // namespace shoal::bench
