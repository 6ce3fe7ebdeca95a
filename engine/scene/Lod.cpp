#include "engine/scene/Lod.h"

#include <meshoptimizer.h>

#include <algorithm>

namespace shoal::scene {

namespace {

constexpr size_t kMinTriangles = 24;
constexpr float kLargestError = 0.1f;                              // of the primitive's extent
constexpr float kStated = MESHOPTIMIZER_VERSION < 200 ? 1 : 0.25f; // reported share: a quarter from 0.20 on

Lod compact(const std::vector<uint32_t>& indices, size_t vertexCount, float error) {
    std::vector<uint32_t> place(vertexCount); // new index; ~0 if not used
    const size_t used =
        meshopt_optimizeVertexFetchRemap(place.data(), indices.data(), indices.size(), vertexCount);
    Lod lod{std::vector<uint32_t>(used), std::vector<uint32_t>(indices.size()), error};
    for (uint32_t v = 0; v < vertexCount; ++v)
        if (place[v] != ~0u) lod.vertices[place[v]] = v;
    meshopt_remapIndexBuffer(lod.indices.data(), indices.data(), indices.size(), place.data());
    return lod;
}

} // namespace

std::vector<Lod> makeLods(const Primitive& primitive) {
    std::vector<Lod> lods;
    if (!primitive.morphTargets.empty() || primitive.positions.empty()) return lods;
    const size_t vertexCount = primitive.positions.size();
    const float* positions = &primitive.positions[0].x;
    const float extent = meshopt_simplifyScale(positions, vertexCount, sizeof(glm::vec3));
    std::vector<uint32_t> coarser(primitive.indices.size());
    const auto keep = [&](float relativeError) {
        meshopt_optimizeVertexCache(coarser.data(), coarser.data(), coarser.size(), vertexCount);
        lods.push_back(compact(coarser, vertexCount, relativeError * extent));
    };
    // Each level is made from the original mesh, so that errors do not add up.
    size_t triangles = primitive.indices.size() / 3;
    while (triangles >= 2 * kMinTriangles) {
        float error = 0;
        coarser.resize(primitive.indices.size());
        coarser.resize(meshopt_simplify(coarser.data(), primitive.indices.data(), primitive.indices.size(),
                                        positions, vertexCount, sizeof(glm::vec3), triangles / 2 * 3,
                                        kStated * kLargestError, 0, &error));
        if (coarser.empty() || coarser.size() / 3 * 4 > triangles * 3) break; // hardly fewer triangles
        triangles = coarser.size() / 3;
        keep(error / kStated);
    }
    // A mesh of many small parts cannot be reduced with its topology, which nobody sees from afar.
    if (triangles >= 3 * kMinTriangles) {
        float error = 0;
        coarser.resize(primitive.indices.size());
        coarser.resize(meshopt_simplifySloppy(coarser.data(), primitive.indices.data(),
                                              primitive.indices.size(), positions, vertexCount,
                                              sizeof(glm::vec3), triangles / 3 * 3, 1.0f, &error));
        const float before = lods.empty() ? 0 : lods.back().error / extent;
        if (!coarser.empty() && coarser.size() / 3 * 2 < triangles) keep(std::max(error, before * 1.01f));
    }
    return lods;
}

} // namespace shoal::scene
