#include "engine/scene/Roughness.h"

#include <algorithm>
#include <array>

namespace shoal::scene {

float minRoughness(const Model& model, const Material& material) {
    const ImageRgba8* texels = model.imageOf(material.metallicRoughness);
    if (!texels) return material.roughness;
    std::array<size_t, 256> counts{};
    for (size_t i = 1; i < texels->pixels.size(); i += 4) ++counts[texels->pixels[i]]; // green: roughness
    size_t below = 0, value = 0;
    while (value < 255 && (below += counts[value]) * 100 <= texels->pixels.size() / 4) ++value;
    return material.roughness * static_cast<float>(value) / 255.0f;
}

MeanSurface meanSurface(const Model& model, const Material& material) {
    const ImageRgba8* texels = model.imageOf(material.metallicRoughness);
    if (!texels) return {material.roughness, material.metallic};
    double roughness = 0, metallic = 0;
    for (size_t i = 0; i < texels->pixels.size(); i += 4) {
        roughness += texels->pixels[i + 1];
        metallic += texels->pixels[i + 2];
    }
    const double share = 4.0 / (255.0 * static_cast<double>(std::max<size_t>(texels->pixels.size(), 4)));
    return {material.roughness * static_cast<float>(roughness * share),
            material.metallic * static_cast<float>(metallic * share)};
}

namespace {

// The least over all materials that some mesh uses.
template <class Of> float minOver(const Model& model, Of&& roughnessOf) {
    float minimum = 1;
    for (const Mesh& mesh : model.meshes)
        for (const Primitive& primitive : mesh.primitives)
            minimum = std::min(minimum, roughnessOf(model.materialOf(primitive)));
    return minimum;
}

} // namespace

float minRoughness(const Model& model) {
    return minOver(model, [&](const Material& material) { return minRoughness(model, material); });
}

float minMeanRoughness(const Model& model) {
    return minOver(model, [&](const Material& material) { return meanSurface(model, material).roughness; });
}

} // namespace shoal::scene
