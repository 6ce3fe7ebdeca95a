#include "engine/scene/Gltf.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>

namespace shoal::scene {

namespace {

constexpr double kMaxEmissiveStrength = 1e4; // times white; fits into half floats
constexpr double kMaxSpecularColour = 1e4;   // its product with the reflectance is clipped to 1

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
    const tinygltf::Sampler& sampler = gltf.samplers[from.sampler];
    const std::string who = element("samplers", from.sampler);
    texture.wrapS = wrapMode(sampler.wrapS, who + ".wrapS");
    texture.wrapT = wrapMode(sampler.wrapT, who + ".wrapT");
    const int filter = sampler.magFilter;
    if (filter != -1 && filter != TINYGLTF_TEXTURE_FILTER_NEAREST && filter != TINYGLTF_TEXTURE_FILTER_LINEAR)
        fault(who, ".magFilter is ", filter, ", no filter of glTF");
    texture.nearest = filter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    return texture;
}

AlphaMode alphaMode(const std::string& mode, const std::string& who) {
    if (mode == "OPAQUE") return AlphaMode::Opaque;
    if (mode == "MASK") return AlphaMode::Mask;
    if (mode == "BLEND") return AlphaMode::Blend;
    fault(who, ".alphaMode is ", quoted(mode), ", no mode of glTF");
}

// Returns the index of the wanted set among the two, and adds it if there is room; -1 if both are different.
// It keeps its number from the file if possible.
int setOf(std::array<UvSource, 2>& sets, const UvSource& wanted) {
    for (const int k : {wanted.texCoord, 1 - wanted.texCoord}) {
        UvSource& set = sets[static_cast<size_t>(k)];
        if (set.texCoord < 0) set = wanted;
        if (set == wanted) return k;
    }
    return -1;
}

// Clamps to 0 .. high, with a warning if that changes the value.
float within(GltfFile& file, double value, double high, const std::string& who) {
    const double nearest = std::clamp(value, 0.0, high);
    if (nearest != value) file.warn(who, " is ", value, "; ", nearest, " is taken");
    return static_cast<float>(nearest);
}

// KHR_materials_ior and KHR_materials_specular: F0 = min(((n - 1) / (n + 1))^2 colour, 1) factor, F90 =
// factor. An index of refraction of 0 stands for infinity: F0 before the colour is 1.
void readDielectric(GltfFile& file, const MaterialExtensions& from, const std::string& who,
                    Material& material) {
    const double ior = from.ior == 0 ? 0 : std::max(from.ior, 1.0);
    if (ior != from.ior) file.warn(who, ".ior is ", from.ior, "; ", ior, " is taken");
    const double root = (ior - 1) / (ior + 1);
    material.dielectricF90 = within(file, from.specularFactor, 1, who + ".specularFactor");
    for (int i = 0; i < 3; ++i) {
        const double colour = static_cast<double>(within(file, from.specularColour[static_cast<size_t>(i)],
                                                         kMaxSpecularColour, who + ".specularColorFactor"));
        material.dielectricF0[i] =
            material.dielectricF90 * static_cast<float>(std::min(root * root * colour, 1.0));
    }
}

void readClearcoat(GltfFile& file, const MaterialExtensions& from, const std::string& who,
                   Material& material) {
    material.clearcoat = within(file, from.clearcoatFactor, 1, who + ".clearcoatFactor");
    material.clearcoatRoughness = within(file, from.clearcoatRoughness, 1, who + ".clearcoatRoughnessFactor");
    if (from.clearcoatNormals) file.warn(who, ".clearcoatNormalTexture is left out; the clearcoat is smooth");
}

Material readMaterial(GltfFile& file, const tinygltf::Material& from, size_t index, const std::string& who) {
    const auto factor = [&](double value, double high, const char* name) {
        return within(file, value, high, who + name);
    };
    const MaterialExtensions& extensions = file.materialExtensions[index];
    std::array<UvSource, 2>& sets = file.uvSources.emplace_back();
    size_t slot = 0; // index into textureTransforms; use() is called in its order
    const auto use = [&](const auto& info, const char* name) -> TextureUse {
        TextureTransform transform = file.textureTransforms[index][slot++];
        if (info.index < 0 || file.gltf.textures[info.index].source < 0) return {};
        const int texCoord = transform.texCoord >= 0 ? transform.texCoord : info.texCoord;
        transform.texCoord = -1;
        if (texCoord > 1) {
            file.warn(who, name, ".texCoord is ", texCoord,
                      ", but only 0 and 1 are supported; the texture is left out");
            return {};
        }
        if (const int set = setOf(sets, {texCoord, transform}); set >= 0) return {info.index, set};
        file.warn(who, name, " is the third with texture coordinates of its own; the texture is left out");
        return {};
    };
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    Material material;
    material.name = from.name;
    for (int i = 0; i < 4; ++i)
        material.baseColourLin[i] =
            factor(pbr.baseColorFactor[i], 1, ".pbrMetallicRoughness.baseColorFactor");
    material.alphaMode = alphaMode(from.alphaMode, who);
    material.alphaCutoff = factor(from.alphaCutoff, std::numeric_limits<float>::max(), ".alphaCutoff");
    material.doubleSided = from.doubleSided;
    material.baseColour = use(pbr.baseColorTexture, ".pbrMetallicRoughness.baseColorTexture");
    material.unlit = extensions.unlit;
    if (material.unlit) return material;
    material.metallic = factor(pbr.metallicFactor, 1, ".pbrMetallicRoughness.metallicFactor");
    material.roughness = factor(pbr.roughnessFactor, 1, ".pbrMetallicRoughness.roughnessFactor");
    readDielectric(file, extensions, who, material);
    readClearcoat(file, extensions, who, material);
    const float emissiveStrength =
        factor(extensions.emissiveStrength, kMaxEmissiveStrength, ".emissiveStrength");
    for (int i = 0; i < 3; ++i)
        material.emissiveLin[i] = emissiveStrength * factor(from.emissiveFactor[i], 1, ".emissiveFactor");
    material.normalScale = static_cast<float>(from.normalTexture.scale);
    material.occlusionStrength = factor(from.occlusionTexture.strength, 1, ".occlusionTexture.strength");
    material.metallicRoughness =
        use(pbr.metallicRoughnessTexture, ".pbrMetallicRoughness.metallicRoughnessTexture");
    material.normal = use(from.normalTexture, ".normalTexture");
    material.occlusion = use(from.occlusionTexture, ".occlusionTexture");
    material.emissive = use(from.emissiveTexture, ".emissiveTexture");
    material.specular = use(extensions.specular, ".specularTexture");
    material.specularColour = use(extensions.specularColourMap, ".specularColorTexture");
    material.coat = use(extensions.coat, ".clearcoatTexture");
    material.coatRoughness = use(extensions.coatRoughness, ".clearcoatRoughnessTexture");
    return material;
}

ImageRgba8 readImage(GltfFile& file, int index) {
    const ImageSource& source = file.imageSources[index];
    const std::string who = element("images", index);
    if (!source.mimeType.empty() && source.mimeType != "image/png" && source.mimeType != "image/jpeg")
        fault(who, ".mimeType is ", quoted(source.mimeType), ", neither image/png nor image/jpeg");
    if (source.bufferView < 0) return decodeImage(file, readUri(file, source.uri, who), who);
    const tinygltf::BufferView& view = file.gltf.bufferViews[source.bufferView];
    const auto& bytes = file.gltf.buffers[view.buffer].data;
    return decodeImage(file, std::span(bytes).subspan(view.byteOffset, view.byteLength), who);
}

using Json = nlohmann::json;

constexpr const char* kEmissiveStrength = "KHR_materials_emissive_strength";
constexpr const char* kTextureTransform = "KHR_texture_transform";
constexpr double kMaxTransform = 1e4; // largest absolute value of its numbers
constexpr const char* kUnlit = "KHR_materials_unlit";
constexpr const char* kIor = "KHR_materials_ior";
constexpr const char* kSpecular = "KHR_materials_specular";
constexpr const char* kClearcoat = "KHR_materials_clearcoat";
constexpr const char* kVariants = "KHR_materials_variants";
constexpr size_t kMaxVariants = 256;

// The functions below treat members that are missing or of the wrong type as empty.
const Json& member(const Json& value, const char* key) {
    static const Json kNothing;
    const auto found = value.find(key);
    return found == value.end() ? kNothing : *found;
}

const Json& list(const Json& value, const char* key) {
    static const Json kEmpty = Json::array();
    const Json& found = member(value, key);
    return found.is_array() ? found : kEmpty;
}

const Json& extension(const Json& value, const char* name) {
    return member(member(value, "extensions"), name);
}

double number(const Json& value, const char* key, double otherwise) {
    const Json& found = member(value, key);
    return found.is_number() ? found.get<double>() : otherwise;
}

// Returns an index below count, or throws. It may be written as 1.0: tidy() makes integers only later.
int reference(const Json& value, const char* to, size_t count, const std::string& who) {
    const double number = value.is_number() ? value.get<double>() : -1;
    if (!(number >= 0 && number < static_cast<double>(count)))
        fault(who, " refers to ", to, " ", quoted(value.dump()), ", but there are ", count);
    return static_cast<int>(number);
}

TextureReference textureReference(const Json& value, const char* key, size_t textures,
                                  const std::string& who) {
    const Json& found = member(value, key);
    if (!found.is_object()) return {};
    return {reference(member(found, "index"), "texture", textures, who + "." + key),
            static_cast<int>(std::clamp(number(found, "texCoord", 0), 0.0, 1e4))};
}

} // namespace

void readMaterials(GltfFile& file, Model& model) {
    for (const tinygltf::Texture& texture : file.gltf.textures)
        model.textures.push_back(readTexture(file.gltf, texture));
    for (const tinygltf::Material& material : file.gltf.materials)
        model.materials.push_back(readMaterial(file, material, model.materials.size(),
                                               element("materials", model.materials.size())));

    // Images that no material uses may be of any format, such as alternatives for extensions.
    model.images.resize(file.imageSources.size());
    for (const Material& material : model.materials)
        for (const TextureUse& use : material.textures()) {
            if (use.texture < 0) continue;
            const int image = model.textures[use.texture].image;
            if (model.images[image].empty()) model.images[image] = readImage(file, image);
        }
}

void readMaterialExtensions(const Json& root, GltfFile& file) {
    const size_t textures = list(root, "textures").size();
    for (const Json& material : list(root, "materials")) {
        const std::string who = element("materials", file.materialExtensions.size());
        MaterialExtensions& read = file.materialExtensions.emplace_back();
        read.emissiveStrength = number(extension(material, kEmissiveStrength), "emissiveStrength", 1);
        read.unlit = extension(material, kUnlit).is_object();
        read.ior = number(extension(material, kIor), "ior", 1.5);
        const Json& specular = extension(material, kSpecular);
        read.specularFactor = number(specular, "specularFactor", 1);
        if (const Json& colour = list(specular, "specularColorFactor"); colour.size() == 3)
            for (size_t i = 0; i < 3; ++i)
                if (colour[i].is_number()) read.specularColour[i] = colour[i].get<double>();
        read.specular = textureReference(specular, "specularTexture", textures, who);
        read.specularColourMap = textureReference(specular, "specularColorTexture", textures, who);
        const Json& clearcoat = extension(material, kClearcoat);
        read.clearcoatFactor = number(clearcoat, "clearcoatFactor", 0);
        read.clearcoatRoughness = number(clearcoat, "clearcoatRoughnessFactor", 0);
        read.coat = textureReference(clearcoat, "clearcoatTexture", textures, who);
        read.coatRoughness = textureReference(clearcoat, "clearcoatRoughnessTexture", textures, who);
        read.clearcoatNormals = member(clearcoat, "clearcoatNormalTexture").is_object();
    }
}

void readTextureTransforms(const Json& root, GltfFile& file) {
    const auto number = [](const Json& value, double otherwise) {
        return static_cast<float>(
            std::clamp(value.is_number() ? value.get<double>() : otherwise, -kMaxTransform, kMaxTransform));
    };
    const auto transformOf = [&](const Json& texture) {
        const Json& given = extension(texture, kTextureTransform);
        TextureTransform transform;
        const Json &offset = list(given, "offset"), &scale = list(given, "scale");
        for (int i = 0; i < 2; ++i) {
            if (offset.size() == 2) transform.offset[i] = number(offset[static_cast<size_t>(i)], 0);
            if (scale.size() == 2) transform.scale[i] = number(scale[static_cast<size_t>(i)], 1);
        }
        transform.rotation = number(member(given, "rotation"), 0);
        transform.texCoord = static_cast<int>(number(member(given, "texCoord"), -1));
        return transform;
    };
    for (const Json& material : list(root, "materials")) {
        const Json &pbr = member(material, "pbrMetallicRoughness"),
                   &specular = extension(material, kSpecular), &clearcoat = extension(material, kClearcoat);
        file.textureTransforms.push_back({transformOf(member(pbr, "baseColorTexture")),
                                          transformOf(member(pbr, "metallicRoughnessTexture")),
                                          transformOf(member(material, "normalTexture")),
                                          transformOf(member(material, "occlusionTexture")),
                                          transformOf(member(material, "emissiveTexture")),
                                          transformOf(member(specular, "specularTexture")),
                                          transformOf(member(specular, "specularColorTexture")),
                                          transformOf(member(clearcoat, "clearcoatTexture")),
                                          transformOf(member(clearcoat, "clearcoatRoughnessTexture"))});
    }
}

void readVariants(const Json& root, GltfFile& file) {
    for (const Json& variant : list(extension(root, kVariants), "variants")) {
        const Json& name = member(variant, "name");
        file.variants.push_back(name.is_string() ? name.get<std::string>() : std::string());
    }
    const size_t variants = file.variants.size(), materials = list(root, "materials").size();
    if (variants > kMaxVariants) fault("has more than ", kMaxVariants, " material variants");
    if (variants == 0) return;
    for (const Json& mesh : list(root, "meshes")) {
        const std::string who = element("meshes", file.variantMaterials.size()) + ": " + kVariants;
        auto& primitives = file.variantMaterials.emplace_back();
        for (const Json& primitive : list(mesh, "primitives")) {
            std::vector<int>& chosen = primitives.emplace_back(variants, -1);
            for (const Json& mapping : list(extension(primitive, kVariants), "mappings")) {
                const int material = reference(member(mapping, "material"), "material", materials, who);
                for (const Json& variant : list(mapping, "variants"))
                    chosen[reference(variant, "variant", variants, who)] = material;
            }
        }
    }
}

bool applyVariant(Model& model, const std::string& variant) {
    const auto found = std::find(model.variants.begin(), model.variants.end(), variant);
    if (found == model.variants.end()) return false;
    const auto index = found - model.variants.begin();
    std::vector<bool> isUsed(model.materials.size(), false);
    for (Mesh& mesh : model.meshes)
        for (Primitive& primitive : mesh.primitives) {
            const int material = primitive.variantMaterials.empty() ? -1 : primitive.variantMaterials[index];
            if (material >= 0) primitive.material = material;
            if (primitive.material >= 0) isUsed[primitive.material] = true;
        }
    for (size_t m = 0; m < isUsed.size(); ++m)
        if (!isUsed[m]) model.materials[m] = Material{.name = model.materials[m].name};
    return true;
}

} // namespace shoal::scene
