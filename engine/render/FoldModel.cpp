#include "engine/render/FoldModel.h"

#include "engine/occlusion/Folds.h"
#include "engine/scene/Surface.h"

#include <glm/gtc/matrix_inverse.hpp>

namespace shoal::render {

void foldModel(scene::Model& model, const scene::Pose& rest, int rays) {
    const scene::Surface surface = scene::posedSurface(model, rest);
    const auto folds = occlusion::findFolds(surface.positions, surface.normals, surface.indices, rays);
    std::vector<glm::mat4> joints;
    size_t next = 0; // in the surface's order
    for (const int index : model.order) {
        const auto n = static_cast<size_t>(index);
        const scene::Node& node = model.nodes[n];
        if (node.mesh < 0) continue;
        if (node.skin >= 0) scene::skinMatrices(model, node.skin, rest, joints);
        for (scene::Primitive& primitive : model.meshes[static_cast<size_t>(node.mesh)].primitives) {
            if (primitive.material >= 0 &&
                model.materials[static_cast<size_t>(primitive.material)].occlusion.texture >= 0) {
                next += primitive.positions.size();
                continue;
            }
            primitive.folds.resize(primitive.positions.size());
            for (size_t v = 0; v < primitive.folds.size(); ++v, ++next) {
                glm::mat4 modelFromMesh = rest.modelFromNode[n];
                if (node.skin >= 0 && !primitive.joints.empty()) {
                    modelFromMesh = glm::mat4(0);
                    for (int k = 0; k < 4; ++k)
                        modelFromMesh += primitive.weights[v][k] * joints[primitive.joints[v][k]];
                }
                const glm::vec3 inModel(folds[next]),
                    inMesh = glm::inverse(glm::mat3(modelFromMesh)) * inModel;
                const float length = glm::length(inMesh);
                primitive.folds[v] = {length > 0 ? inMesh * (glm::length(inModel) / length) : glm::vec3(0),
                                      folds[next].w};
            }
        }
    }
}

} // namespace shoal::render
