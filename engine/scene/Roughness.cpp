#include "engine/scene/Roughness.h"

#include <algorithm>
#include <array>

namespace shoal::scene {

float leastRoughness(const Model& model, const Material& material) {
    if (material.metallicRoughness.texture < 0) return material.roughness;
    const int image = model.textures[static_cast<size_t>(material.metallicRoughness.texture)].image;
    if (image < 0) return material.roughness;
    const ImageRgba8& texels = model.images[static_cast<size_t>(image)];
    std::array<size_t, 256> counts{};
    for (size_t i = 1; i < texels.pixels.size(); i += 4) ++counts[texels.pixels[i]]; // green: roughness
    size_t below = 0, value = 0;
    while (value < 255 && (below += counts[value]) * 100 <= texels.pixels.size() / 4) ++value;
    return material.roughness * static_cast<float>(value) / 255.0f;
}

MeanSurface meanSurface(const Model& model, const Material& material) {
    const int texture = material.metallicRoughness.texture;
    const int image = texture < 0 ? -1 : model.textures[static_cast<size_t>(texture)].image;
    if (image < 0) return {material.roughness, material.metallic};
    const ImageRgba8& texels = model.images[static_cast<size_t>(image)];
    double roughness = 0, metallic = 0;
    for (size_t i = 0; i < texels.pixels.size(); i += 4) {
        roughness += texels.pixels[i + 1];
        metallic += texels.pixels[i + 2];
    }
    const double share = 4.0 / (255.0 * static_cast<double>(std::max<size_t>(texels.pixels.size(), 4)));
    return {material.roughness * static_cast<float>(roughness * share),
            material.metallic * static_cast<float>(metallic * share)};
}

namespace {

// The least over all materials that some mesh uses.
template <class Of> float leastOver(const Model& model, Of&& roughnessOf) {
    float least = 1;
    for (const Mesh& mesh : model.meshes)
        for (const Primitive& primitive : mesh.primitives) {
            const bool named = primitive.material >= 0;
            least =
                std::min(least, named ? roughnessOf(model.materials[static_cast<size_t>(primitive.material)])
                                      : Material().roughness);
        }
    return least;
}

} // namespace

float leastRoughness(const Model& model) {
    return leastOver(model, [&](const Material& material) { return leastRoughness(model, material); });
}

float leastMeanRoughness(const Model& model) {
    return leastOver(model, [&](const Material& material) { return meanSurface(model, material).roughness; });
}

} // namespace shoal::scene
