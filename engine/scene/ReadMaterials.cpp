#include "engine/scene/Gltf.h"

#include <algorithm>
#include <limits>

namespace shoal::scene {

namespace {

constexpr double kMaxEmissiveStrength = 1e4; // times white; fits into half floats
constexpr double kMaxSpecularColour = 1e4;   // its product with the reflectance is clipped to 1

using Json = nlohmann::json;

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

// Returns the coordinates of one use of a texture, with its KHR_texture_transform.
UvSource uvSourceOf(const Json& use) {
    constexpr double kMax = 1e4; // largest absolute value of its numbers
    const auto read = [&](const Json& value, float& number) {
        if (value.is_number()) number = static_cast<float>(std::clamp(value.get<double>(), -kMax, kMax));
    };
    const Json& transform = extension(use, "KHR_texture_transform");
    const double own = number(transform, "texCoord", -1);
    UvSource source{static_cast<int>(std::clamp(own > -1 ? own : number(use, "texCoord", 0), 0.0, kMax))};
    const Json &offset = list(transform, "offset"), &scale = list(transform, "scale");
    for (size_t i = 0; i < 2; ++i) {
        if (offset.size() == 2) read(offset[i], source.offset[static_cast<int>(i)]);
        if (scale.size() == 2) read(scale[i], source.scale[static_cast<int>(i)]);
    }
    read(member(transform, "rotation"), source.rotation);
    return source;
}

// A part of a material: an extension, or the core material. prefix: begins its members' names in messages.
struct Part {
    GltfFile& file;
    const Json& json;
    std::string prefix;

    // Clamps to 0 .. high, with a warning if that changes the value.
    float within(double value, double high, const char* name) const {
        const double nearest = std::clamp(value, 0.0, high);
        if (nearest != value) file.warn(prefix, name, " is ", value, "; ", nearest, " is taken");
        return static_cast<float>(nearest);
    }
    float factor(const char* name, double otherwise, double high = 1) const {
        return within(number(json, name, otherwise), high, name);
    }
    // size: 3 or 4 channels.
    glm::vec4 colour(const char* name, size_t size, double otherwise, double high = 1) const {
        const Json& given = list(json, name);
        glm::vec4 colour(0);
        for (size_t i = 0; i < size; ++i) {
            const bool stated = given.size() == size && given[i].is_number();
            colour[static_cast<int>(i)] = within(stated ? given[i].get<double>() : otherwise, high, name);
        }
        return colour;
    }
    TextureUse texture(const char* name) const {
        const Json& use = member(json, name);
        if (!use.is_object()) return {};
        const int texture =
            reference(member(use, "index"), "texture", file.gltf.textures.size(), prefix + name);
        if (file.gltf.textures[texture].source < 0) return {};
        const UvSource source = uvSourceOf(use);
        if (source.texCoord > 1) {
            file.warn(prefix, name, ".texCoord is ", source.texCoord,
                      ", but only 0 and 1 are supported; the texture is left out");
            return {};
        }
        if (const int set = setOf(file.uvSources.back(), source); set >= 0) return {texture, set};
        file.warn(prefix, name, " is the third with texture coordinates of its own; the texture is left out");
        return {};
    }
};

// KHR_materials_ior and KHR_materials_specular: F0 = min(((n - 1) / (n + 1))^2 colour, 1) factor, F90 =
// factor. An index of refraction of 0 stands for infinity: F0 before the colour is 1.
void readDielectric(const Part& core, const Part& specular, Material& material) {
    const double given = number(extension(core.json, "KHR_materials_ior"), "ior", 1.5);
    const double ior = given == 0 ? 0 : std::max(given, 1.0), root = (ior - 1) / (ior + 1);
    if (ior != given) core.file.warn(core.prefix, "ior is ", given, "; ", ior, " is taken");
    const glm::dvec4 colour(specular.colour("specularColorFactor", 3, 1, kMaxSpecularColour));
    material.dielectricF90 = specular.factor("specularFactor", 1);
    for (int i = 0; i < 3; ++i)
        material.dielectricF0[i] =
            material.dielectricF90 * static_cast<float>(std::min(root * root * colour[i], 1.0));
}

// Appends to file.uvSources, too. from: checked by checkSchema(), but for its extensions.
Material readMaterial(GltfFile& file, const Json& from, const std::string& who) {
    const auto part = [&](const Json& json, const char* path = ".") { return Part{file, json, who + path}; };
    const Part core = part(from), specular = part(extension(from, "KHR_materials_specular")),
               clearcoat = part(extension(from, "KHR_materials_clearcoat")),
               pbr = part(member(from, "pbrMetallicRoughness"), ".pbrMetallicRoughness.");
    file.uvSources.emplace_back();
    Material material;
    material.name = from.value("name", "");
    material.baseColourLin = pbr.colour("baseColorFactor", 4, 1);
    material.alphaMode = alphaMode(from.value("alphaMode", "OPAQUE"), who);
    material.alphaCutoff = core.factor("alphaCutoff", 0.5, std::numeric_limits<float>::max());
    material.doubleSided = from.value("doubleSided", false);
    material.baseColour = pbr.texture("baseColorTexture");
    material.unlit = extension(from, "KHR_materials_unlit").is_object();
    if (material.unlit) return material;
    material.metallic = pbr.factor("metallicFactor", 1);
    material.roughness = pbr.factor("roughnessFactor", 1);
    readDielectric(core, specular, material);
    material.clearcoat = clearcoat.factor("clearcoatFactor", 0);
    material.clearcoatRoughness = clearcoat.factor("clearcoatRoughnessFactor", 0);
    if (member(clearcoat.json, "clearcoatNormalTexture").is_object())
        file.warn(who, ".clearcoatNormalTexture is left out; the clearcoat is smooth");
    material.emissiveLin = part(extension(from, "KHR_materials_emissive_strength"))
                               .factor("emissiveStrength", 1, kMaxEmissiveStrength) *
                           glm::vec3(core.colour("emissiveFactor", 3, 0));
    material.normalScale = static_cast<float>(number(member(from, "normalTexture"), "scale", 1));
    material.occlusionStrength =
        part(member(from, "occlusionTexture"), ".occlusionTexture.").factor("strength", 1);
    material.metallicRoughness = pbr.texture("metallicRoughnessTexture");
    material.normal = core.texture("normalTexture");
    material.occlusion = core.texture("occlusionTexture");
    material.emissive = core.texture("emissiveTexture");
    material.specular = specular.texture("specularTexture");
    material.specularColour = specular.texture("specularColorTexture");
    material.coat = clearcoat.texture("clearcoatTexture");
    material.coatRoughness = clearcoat.texture("clearcoatRoughnessTexture");
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
    for (const Json& material : file.materials)
        model.materials.push_back(readMaterial(file, material, element("materials", model.materials.size())));
    model.images.resize(file.images.size());
    for (size_t i = 0; i < file.images.size(); ++i)
        if (file.images[i].contains("uri") == file.images[i].contains("bufferView"))
            fault(element("images", i), " has not exactly one of uri and bufferView");
}

void readImages(GltfFile& file, Model& model, bool ofPrimitives) {
    std::set<int> materials;
    for (const Mesh& mesh : model.meshes)
        for (const Primitive& primitive : mesh.primitives) materials.insert(primitive.material);
    for (size_t i = 0; i < model.materials.size(); ++i) {
        if (ofPrimitives && !materials.contains(static_cast<int>(i))) continue;
        for (const TextureUse& use : model.materials[i].textures()) {
            if (use.texture < 0) continue;
            const int image = model.textures[use.texture].image;
            if (model.images[image].empty())
                model.images[image] = readImage(file, file.images[image], element("images", image));
        }
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
    for (Mesh& mesh : model.meshes)
        for (Primitive& primitive : mesh.primitives) {
            const int material = primitive.variantMaterials.empty() ? -1 : primitive.variantMaterials[index];
            if (material >= 0) primitive.material = material;
        }
    return true;
}

} // namespace shoal::scene
