#include "engine/scene/Gltf.h"

#include <algorithm>
#include <limits>

namespace shoal::scene {

namespace {

constexpr double kMaxEmissiveStrength = 1e4; // times white; fits into half floats
constexpr double kMaxSpecularColour = 1e4;   // its product with the reflectance is clipped to 1

using Json = nlohmann::json;

constexpr const char *kSpecular = "KHR_materials_specular", *kClearcoat = "KHR_materials_clearcoat",
                     *kVariants = "KHR_materials_variants";
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

Texture::Wrap wrapMode(int mode, const std::string& who) {
    if (mode == TINYGLTF_TEXTURE_WRAP_REPEAT) return Texture::Wrap::Repeat;
    if (mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Texture::Wrap::Mirror;
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Texture::Wrap::Clamp;
    fault(who, " is ", mode, ", no wrap mode of glTF");
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
        UvSource& set = sets[k];
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
void readDielectric(GltfFile& file, const Json& from, const std::string& who, Material& material) {
    const double given = number(extension(from, "KHR_materials_ior"), "ior", 1.5);
    const double ior = given == 0 ? 0 : std::max(given, 1.0), root = (ior - 1) / (ior + 1);
    if (ior != given) file.warn(who, ".ior is ", given, "; ", ior, " is taken");
    const Json &specular = extension(from, kSpecular), &colours = list(specular, "specularColorFactor");
    material.dielectricF90 = within(file, number(specular, "specularFactor", 1), 1, who + ".specularFactor");
    for (size_t i = 0; i < 3; ++i) {
        const bool stated = colours.size() == 3 && colours[i].is_number();
        const double colour = static_cast<double>(within(file, stated ? colours[i].get<double>() : 1,
                                                         kMaxSpecularColour, who + ".specularColorFactor"));
        material.dielectricF0[static_cast<int>(i)] =
            material.dielectricF90 * static_cast<float>(std::min(root * root * colour, 1.0));
    }
}

void readClearcoat(GltfFile& file, const Json& from, const std::string& who, Material& material) {
    const auto factor = [&](const char* name) {
        return within(file, number(from, name, 0), 1, who + "." + name);
    };
    material.clearcoat = factor("clearcoatFactor");
    material.clearcoatRoughness = factor("clearcoatRoughnessFactor");
    if (member(from, "clearcoatNormalTexture").is_object())
        file.warn(who, ".clearcoatNormalTexture is left out; the clearcoat is smooth");
}

// KHR_texture_transform of one use of a texture.
TextureTransform textureTransform(const Json& from) {
    constexpr double kMax = 1e4; // largest absolute value of its numbers
    const auto read = [&](const Json& value, float& number) {
        if (value.is_number()) number = static_cast<float>(std::clamp(value.get<double>(), -kMax, kMax));
    };
    TextureTransform transform;
    const Json &offset = list(from, "offset"), &scale = list(from, "scale");
    for (size_t i = 0; i < 2; ++i) {
        if (offset.size() == 2) read(offset[i], transform.offset[static_cast<int>(i)]);
        if (scale.size() == 2) read(scale[i], transform.scale[static_cast<int>(i)]);
    }
    read(member(from, "rotation"), transform.rotation);
    return transform;
}

// json: the same material as in the file.
Material readMaterial(GltfFile& file, const tinygltf::Material& from, const Json& json,
                      const std::string& who) {
    const auto factor = [&](double value, double high, const char* name) {
        return within(file, value, high, who + name);
    };
    std::array<UvSource, 2>& sets = file.uvSources.emplace_back();
    // Reads the member `name` of this part of the material.
    const auto use = [&](const Json& part, const char* name, const char* path = ".") -> TextureUse {
        const Json& info = member(part, name);
        if (!info.is_object()) return {};
        const std::string full = who + path + name;
        const int texture = reference(member(info, "index"), "texture", file.gltf.textures.size(), full);
        if (file.gltf.textures[texture].source < 0) return {};
        const Json& transform = extension(info, "KHR_texture_transform");
        const double own = number(transform, "texCoord", -1);
        const int texCoord =
            static_cast<int>(std::clamp(own > -1 ? own : number(info, "texCoord", 0), 0.0, 1e4));
        if (texCoord > 1) {
            file.warn(full, ".texCoord is ", texCoord,
                      ", but only 0 and 1 are supported; the texture is left out");
            return {};
        }
        if (const int set = setOf(sets, {texCoord, textureTransform(transform)}); set >= 0)
            return {texture, set};
        file.warn(full, " is the third with texture coordinates of its own; the texture is left out");
        return {};
    };
    constexpr const char* kPbr = ".pbrMetallicRoughness.";
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    const Json &pbrPart = member(json, "pbrMetallicRoughness"), &specular = extension(json, kSpecular),
               &clearcoat = extension(json, kClearcoat);
    Material material;
    material.name = from.name;
    for (int i = 0; i < 4; ++i)
        material.baseColourLin[i] =
            factor(pbr.baseColorFactor[i], 1, ".pbrMetallicRoughness.baseColorFactor");
    material.alphaMode = alphaMode(from.alphaMode, who);
    material.alphaCutoff = factor(from.alphaCutoff, std::numeric_limits<float>::max(), ".alphaCutoff");
    material.doubleSided = from.doubleSided;
    material.baseColour = use(pbrPart, "baseColorTexture", kPbr);
    material.unlit = extension(json, "KHR_materials_unlit").is_object();
    if (material.unlit) return material;
    material.metallic = factor(pbr.metallicFactor, 1, ".pbrMetallicRoughness.metallicFactor");
    material.roughness = factor(pbr.roughnessFactor, 1, ".pbrMetallicRoughness.roughnessFactor");
    readDielectric(file, json, who, material);
    readClearcoat(file, clearcoat, who, material);
    const float emissiveStrength =
        factor(number(extension(json, "KHR_materials_emissive_strength"), "emissiveStrength", 1),
               kMaxEmissiveStrength, ".emissiveStrength");
    for (int i = 0; i < 3; ++i)
        material.emissiveLin[i] = emissiveStrength * factor(from.emissiveFactor[i], 1, ".emissiveFactor");
    material.normalScale = static_cast<float>(from.normalTexture.scale);
    material.occlusionStrength = factor(from.occlusionTexture.strength, 1, ".occlusionTexture.strength");
    material.metallicRoughness = use(pbrPart, "metallicRoughnessTexture", kPbr);
    material.normal = use(json, "normalTexture");
    material.occlusion = use(json, "occlusionTexture");
    material.emissive = use(json, "emissiveTexture");
    material.specular = use(specular, "specularTexture");
    material.specularColour = use(specular, "specularColorTexture");
    material.coat = use(clearcoat, "clearcoatTexture");
    material.coatRoughness = use(clearcoat, "clearcoatRoughnessTexture");
    return material;
}

ImageRgba8 readImage(GltfFile& file, const Json& from, const std::string& who) {
    const std::string mimeType = from.value("mimeType", "");
    if (!mimeType.empty() && mimeType != "image/png" && mimeType != "image/jpeg")
        fault(who, ".mimeType is ", quoted(mimeType), ", neither image/png nor image/jpeg");
    if (from.contains("uri")) return decodeImage(file, readUri(file, from["uri"], who), who);
    const tinygltf::BufferView& view = file.gltf.bufferViews[from["bufferView"].get<size_t>()];
    const auto& bytes = file.gltf.buffers[view.buffer].data;
    return decodeImage(file, std::span(bytes).subspan(view.byteOffset, view.byteLength), who);
}

} // namespace

void readMaterials(GltfFile& file, Model& model) {
    for (const tinygltf::Texture& texture : file.gltf.textures)
        model.textures.push_back(readTexture(file.gltf, texture));
    for (size_t i = 0; i < file.gltf.materials.size(); ++i)
        model.materials.push_back(
            readMaterial(file, file.gltf.materials[i], file.materials[i], element("materials", i)));

    model.images.resize(file.images.size());
    for (size_t i = 0; i < file.images.size(); ++i)
        if (file.images[i].contains("uri") == file.images[i].contains("bufferView"))
            fault(element("images", i), " has not exactly one of uri and bufferView");
    // Images that no material uses may be of any format, such as alternatives for extensions.
    for (const Material& material : model.materials)
        for (const TextureUse& use : material.textures()) {
            if (use.texture < 0) continue;
            const int image = model.textures[use.texture].image;
            if (model.images[image].empty())
                model.images[image] = readImage(file, file.images[image], element("images", image));
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
