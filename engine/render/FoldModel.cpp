#include "engine/render/FoldModel.h"

#include "engine/occlusion/Folds.h"
#include "engine/scene/Surface.h"

#include <glm/gtc/matrix_inverse.hpp>

namespace shoal::render {

namespace {

bool isBlended(const scene::Model& model, const scene::Primitive& primitive) {
    return primitive.material >= 0 &&
           model.materials[static_cast<size_t>(primitive.material)].alphaMode == scene::AlphaMode::Blend;
}

// Triangles of the surface that let no light through.
std::vector<uint32_t> solidOf(const scene::Model& model, const scene::Surface& surface) {
    std::vector<uint32_t> solid;
    auto next = surface.indices.begin(); // in the surface's order
    for (const int index : model.order) {
        const scene::Node& node = model.nodes[static_cast<size_t>(index)];
        if (node.mesh < 0) continue;
        for (const scene::Primitive& primitive : model.meshes[static_cast<size_t>(node.mesh)].primitives) {
            const auto end = next + static_cast<std::ptrdiff_t>(primitive.indices.size());
            if (!isBlended(model, primitive)) solid.insert(solid.end(), next, end);
            next = end;
        }
    }
    return solid;
}

// Turned and not scaled.
glm::vec4 turned(const glm::mat3& by, const glm::vec4& fold) {
    const glm::vec3 to = by * glm::vec3(fold);
    const float length = glm::length(to);
    return {length > 0 ? to * (glm::length(glm::vec3(fold)) / length) : glm::vec3(0), fold.w};
}

void fold(scene::Model& model, const scene::Pose& pose, std::span<const occlusion::Occluder> own, int rays,
          std::vector<glm::vec4> scene::Primitive::*kept) {
    const scene::Surface surface = scene::posedSurface(model, pose);
    const std::vector<uint32_t> solid = solidOf(model, surface);
    const auto folds = occlusion::findFolds({surface.positions, surface.normals, solid}, own, rays);
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
            if (mapped || isBlended(model, primitive)) {
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
                (primitive.*kept)[v] = turned(glm::inverse(glm::mat3(modelFromMesh)), folds[next]);
            }
        }
    }
}

} // namespace

void foldModel(scene::Model& model, const scene::Pose& rest, int rays) {
    fold(model, rest, {}, rays, &scene::Primitive::folds);
}

void foldBesideOwn(scene::Model& model, const scene::Pose& bent, const BodyOccluders& body, int rays) {
    std::vector<occlusion::Occluder> own;
    for (const BodyOccluders::Part& part : body.parts)
        own.push_back({placed(part, bent, glm::mat4(1)), 1, {}});
    fold(model, bent, own, rays, &scene::Primitive::foldsBesideOwn);
}

} // namespace shoal::render
