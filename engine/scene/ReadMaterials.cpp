#include "engine/scene/ReadMaterials.h"

#include "engine/scene/DecodeImage.h"
#include "engine/scene/Document.h"
#include "engine/scene/Loading.h"
#include "engine/scene/Resources.h"

#include <algorithm>
#include <limits>
#include <span>

namespace shoal::scene {

namespace {

Texture::Wrap wrapMode(int mode, const std::string& who) {
    switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
        return Texture::Wrap::Repeat;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
        return Texture::Wrap::Mirror;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
        return Texture::Wrap::Clamp;
    default:
        fault(who, " is ", mode, ", no wrap mode of glTF");
    }
}

Texture readTexture(const tinygltf::Model& gltf, const tinygltf::Texture& from) {
    Texture texture;
    texture.image = from.source;
    if (from.sampler < 0) return texture;
    const tinygltf::Sampler& sampler = gltf.samplers[static_cast<size_t>(from.sampler)];
    const std::string who = element("samplers", from.sampler);
    texture.wrapS = wrapMode(sampler.wrapS, who + ".wrapS");
    texture.wrapT = wrapMode(sampler.wrapT, who + ".wrapT");
    const int filter = sampler.magFilter;
    if (filter != -1 && filter != TINYGLTF_TEXTURE_FILTER_NEAREST && filter != TINYGLTF_TEXTURE_FILTER_LINEAR)
        fault(who, ".magFilter is ", filter, ", no filter of glTF");
    texture.nearest = filter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    return texture;
}

float within(Loading& loading, double value, float low, float high, const std::string& who) {
    const auto number = static_cast<float>(value);
    if (number >= low && number <= high) return number;
    const float nearest = std::clamp(number, low, high);
    loading.warn(who, " is ", number, "; ", nearest, " is taken");
    return nearest;
}

TextureUse textureUse(Loading& loading, const tinygltf::Model& gltf, int texture, int texCoord,
                      const std::string& who) {
    if (texture < 0 || gltf.textures[static_cast<size_t>(texture)].source < 0) return {};
    if (texCoord > 1) {
        loading.warn(who, ".texCoord is ", texCoord,
                     ", but only 0 and 1 are supported; the texture is left out");
        return {};
    }
    return {texture, texCoord};
}

AlphaMode alphaMode(const std::string& mode, const std::string& who) {
    if (mode == "OPAQUE") return AlphaMode::Opaque;
    if (mode == "MASK") return AlphaMode::Mask;
    if (mode == "BLEND") return AlphaMode::Blend;
    fault(who, ".alphaMode is ", quoted(mode), ", no mode of glTF");
}

constexpr float kNoLimit = std::numeric_limits<float>::max();

Material readMaterial(Loading& loading, const tinygltf::Model& gltf, const tinygltf::Material& from,
                      const std::string& who) {
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    Material material;
    material.name = from.name;
    for (int i = 0; i < 4; ++i)
        material.baseColourLin[i] = within(loading, pbr.baseColorFactor[static_cast<size_t>(i)], 0, 1,
                                           who + ".pbrMetallicRoughness.baseColorFactor");
    material.metallic =
        within(loading, pbr.metallicFactor, 0, 1, who + ".pbrMetallicRoughness.metallicFactor");
    material.roughness =
        within(loading, pbr.roughnessFactor, 0, 1, who + ".pbrMetallicRoughness.roughnessFactor");
    for (int i = 0; i < 3; ++i)
        material.emissiveLin[i] =
            within(loading, from.emissiveFactor[static_cast<size_t>(i)], 0, 1, who + ".emissiveFactor");
    material.normalScale = static_cast<float>(from.normalTexture.scale);
    material.occlusionStrength =
        within(loading, from.occlusionTexture.strength, 0, 1, who + ".occlusionTexture.strength");
    material.alphaMode = alphaMode(from.alphaMode, who);
    material.alphaCutoff = within(loading, from.alphaCutoff, 0, kNoLimit, who + ".alphaCutoff");
    material.doubleSided = from.doubleSided;

    const auto use = [&](const auto& info, const char* name) {
        return textureUse(loading, gltf, info.index, info.texCoord, who + name);
    };
    material.baseColour = use(pbr.baseColorTexture, ".pbrMetallicRoughness.baseColorTexture");
    material.metallicRoughness =
        use(pbr.metallicRoughnessTexture, ".pbrMetallicRoughness.metallicRoughnessTexture");
    material.normal = use(from.normalTexture, ".normalTexture");
    material.occlusion = use(from.occlusionTexture, ".occlusionTexture");
    material.emissive = use(from.emissiveTexture, ".emissiveTexture");
    return material;
}

ImageRgba8 readImage(Loading& loading, const Document& document, size_t index) {
    const ImageSource& source = document.imageSources[index];
    const std::string who = element("images", static_cast<int64_t>(index));
    if (!source.mimeType.empty() && source.mimeType != "image/png" && source.mimeType != "image/jpeg")
        fault(who, ".mimeType is ", quoted(source.mimeType), ", neither image/png nor image/jpeg");
    if (source.bufferView < 0) return decodeImage(loading, readUri(loading, source.uri, who), who);
    const tinygltf::BufferView& view = document.gltf.bufferViews[static_cast<size_t>(source.bufferView)];
    const auto& bytes = document.gltf.buffers[static_cast<size_t>(view.buffer)].data;
    return decodeImage(loading, std::span(bytes).subspan(view.byteOffset, view.byteLength), who);
}

} // namespace

void readMaterials(Loading& loading, const Document& document, Model& model) {
    const tinygltf::Model& gltf = document.gltf;
    for (const tinygltf::Texture& texture : gltf.textures)
        model.textures.push_back(readTexture(gltf, texture));
    for (const tinygltf::Material& material : gltf.materials)
        model.materials.push_back(readMaterial(
            loading, gltf, material, element("materials", static_cast<int64_t>(model.materials.size()))));

    // Images that nothing shows may be of any format: alternatives for extensions, or left over.
    std::vector<bool> shown(document.imageSources.size(), false);
    for (const Material& material : model.materials)
        for (const TextureUse& use : {material.baseColour, material.metallicRoughness, material.normal,
                                      material.occlusion, material.emissive})
            if (use.texture >= 0)
                shown[static_cast<size_t>(model.textures[static_cast<size_t>(use.texture)].image)] = true;
    model.images.resize(shown.size());
    for (size_t i = 0; i < shown.size(); ++i)
        if (shown[i]) model.images[i] = readImage(loading, document, i);
}

} // namespace shoal::scene
