#include "engine/render/BakeSelfOcclusion.h"

#include "engine/occlusion/TraceSelfOcclusion.h"
#include "engine/scene/Surface.h"

#include <glm/gtc/matrix_inverse.hpp>

namespace shoal::render {

namespace {

// Turned and not scaled.
glm::vec4 turned(const glm::mat3& by, const glm::vec4& selfOcclusion) {
    const glm::vec3 to = by * glm::vec3(selfOcclusion);
    const float length = glm::length(to);
    return {length > 0 ? to * (glm::length(glm::vec3(selfOcclusion)) / length) : glm::vec3(0),
            selfOcclusion.w};
}

void selfOcclusion(scene::Model& model, const scene::Pose& pose, std::span<const occlusion::Occluder> own,
                   int rays, std::vector<glm::vec4> scene::Primitive::*kept) {
    const scene::Surface surface = scene::posedSurface(model, pose);
    const std::vector<uint32_t> solid = scene::opaqueTriangles(model, surface);
    const auto selfOcclusion =
        occlusion::traceSelfOcclusion({surface.positions, surface.normals, solid}, own, rays);
    std::vector<glm::mat4> joints;
    size_t next = 0; // in the surface's order
    for (const int index : model.order) {
        const auto n = static_cast<size_t>(index);
        const scene::Node& node = model.nodes[n];
        if (node.mesh < 0) continue;
        if (node.skin >= 0) scene::skinMatrices(model, node.skin, pose, joints);
        for (scene::Primitive& primitive : model.meshes[static_cast<size_t>(node.mesh)].primitives) {
            const bool mapped =
                primitive.material >= 0 &&
                model.materials[static_cast<size_t>(primitive.material)].occlusion.texture >= 0;
            if (mapped || scene::isBlended(model, primitive)) {
                next += primitive.positions.size();
                continue;
            }
            (primitive.*kept).resize(primitive.positions.size());
            for (size_t v = 0; v < primitive.positions.size(); ++v, ++next) {
                glm::mat4 modelFromMesh = pose.modelFromNode[n];
                if (node.skin >= 0 && !primitive.joints.empty()) {
                    modelFromMesh = glm::mat4(0);
                    for (int k = 0; k < 4; ++k)
                        modelFromMesh += primitive.weights[v][k] * joints[primitive.joints[v][k]];
                }
                (primitive.*kept)[v] = turned(glm::inverse(glm::mat3(modelFromMesh)), selfOcclusion[next]);
            }
        }
    }
}

} // namespace

void bakeSelfOcclusion(scene::Model& model, const scene::Pose& rest, int rays) {
    selfOcclusion(model, rest, {}, rays, &scene::Primitive::selfOcclusion);
}

void bakeSelfOcclusionBesideOwn(scene::Model& model, const scene::Pose& bent, const BodyOccluders& body,
                                int rays) {
    std::vector<occlusion::Occluder> own;
    for (const BodyOccluders::Part& part : body.parts)
        own.push_back({placed(part, bent, glm::mat4(1)), 1, {}});
    selfOcclusion(model, bent, own, rays, &scene::Primitive::selfOcclusionBesideOwn);
}

} // namespace shoal::render
