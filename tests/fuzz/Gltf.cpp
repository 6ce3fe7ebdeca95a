// A model's file, to its first pose.
#include "engine/scene/Model.h"
#include "tests/fuzz/Target.h"

#include <glm/geometric.hpp>

using namespace shoal;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const fuzz::FileInput binary("input.glb"), text("input.gltf");
    const bool isBinary = size > 4 && data[0] == 'g';
    const auto model = scene::loadModel((isBinary ? binary : text)({data, size}), "",
                                        {.maxTotalBytes = 16u << 20,
                                         .maxVertices = 100'000,
                                         .maxIndices = 300'000,
                                         .maxImagePixels = 1'000'000,
                                         .maxKeyValues = 400'000});
    if (!model) return 0;
    scene::Pose pose;
    scene::restPose(*model, pose);
    for (size_t i = 0; i < model->animations.size() && i < 4; ++i)
        scene::animate(*model, static_cast<int>(i), 0.3f * model->animations[i].duration_s, pose);
    scene::updateGlobals(*model, pose);
    std::vector<glm::mat4> joints;
    for (size_t i = 0; i < model->skins.size() && i < 4; ++i)
        scene::skinMatrices(*model, static_cast<int>(i), pose, joints);
    scene::posedBounds(*model, pose);
    for (const scene::Mesh& mesh : model->meshes)
        for (const scene::Primitive& primitive : mesh.primitives) {
            fuzz::expect(primitive.indices.size() % 3 == 0);
            for (const uint32_t index : primitive.indices) fuzz::expect(index < primitive.positions.size());
            for (const glm::vec3& p : primitive.positions)
                fuzz::expect(std::isfinite(glm::dot(p, glm::vec3(1))));
        }
    return 0;
}
