#include "engine/scene/Gltf.h"

#include <algorithm>
#include <limits>

namespace shoal::scene {

namespace {

constexpr double kMaxEmissiveStrength = 1e4; // times white; half floats hold it
constexpr double kMaxSpecularColour = 1e4;   // its product with the reflectance is clipped to 1
constexpr float kMaxTransform = 1e4f;        // numbers of a texture's transform, either way

Texture::Wrap wrapMode(int mode, const std::string& who) { // numbers of OpenGL
    switch (mode) {
    case 10497:
        return Texture::Wrap::Repeat;
    case 33648:
        return Texture::Wrap::Mirror;
    case 33071:
        return Texture::Wrap::Clamp;
    default:
        fault(who, " is ", mode, ", no wrap mode of glTF");
    }
}

Texture readTexture(const Json& root, const Json& from) {
    constexpr int kRepeat = 10497, kNearest = 9728, kLinear = 9729;
    Texture texture;
    texture.image = from.value("source", -1);
    if (!from.contains("sampler")) return texture;
    const size_t index = from["sampler"];
    const Json& sampler = root["samplers"][index];
    const std::string who = element("samplers", index);
    texture.wrapS = wrapMode(sampler.value("wrapS", kRepeat), who + ".wrapS");
    texture.wrapT = wrapMode(sampler.value("wrapT", kRepeat), who + ".wrapT");
    const int filter = sampler.value("magFilter", kLinear);
    if (filter != kNearest && filter != kLinear) fault(who, ".magFilter is ", filter, ", no filter of glTF");
    texture.nearest = filter == kNearest;
    return texture;
}

AlphaMode alphaMode(const std::string& mode, const std::string& who) {
    if (mode == "OPAQUE") return AlphaMode::Opaque;
    if (mode == "MASK") return AlphaMode::Mask;
    if (mode == "BLEND") return AlphaMode::Blend;
    fault(who, ".alphaMode is ", quoted(mode), ", no mode of glTF");
}

TextureTransform transformOf(const Json& texture) {
    const Json& given = extension(texture, "KHR_texture_transform");
    const auto bounded = [](float value) { return std::clamp(value, -kMaxTransform, kMaxTransform); };
    const auto offset = given.value("offset", std::vector<float>{0, 0}),
               scale = given.value("scale", std::vector<float>{1, 1});
    return {{bounded(offset[0]), bounded(offset[1])},
            {bounded(scale[0]), bounded(scale[1])},
            bounded(given.value("rotation", 0.0f))};
}

// Returns which of the two sets is this one; -1: both are other ones. Where possible it keeps the number that
// it has in the file.
int setOf(std::array<UvSource, 2>& sets, const UvSource& wanted) {
    for (const int k : {wanted.texCoord, 1 - wanted.texCoord}) {
        UvSource& set = sets[static_cast<size_t>(k)];
        if (set.texCoord < 0) set = wanted;
        if (set == wanted) return k;
    }
    return -1;
}

// Reads the members of one material, with its name for warnings.
class MaterialReader {
  public:
    MaterialReader(GltfFile& file, std::string who) : file_(file), who_(std::move(who)) {}

    Material read(const Json& from);

  private:
    // Returns the nearest number within 0 .. high, with a warning where that is another.
    float within(double value, double high, const char* name) {
        const double nearest = std::clamp(value, 0.0, high);
        if (nearest != value) file_.warn(who_, ".", name, " is ", value, "; ", nearest, " is taken");
        return static_cast<float>(nearest);
    }
    float factor(const Json& of, const char* name, double otherwise, double high = 1) {
        return within(of.value(name, otherwise), high, name);
    }
    template <int kCount>
    glm::vec<kCount, float> colour(const Json& of, const char* name, double otherwise, double high = 1) {
        glm::vec<kCount, float> read;
        const auto numbers = of.value(name, std::vector<double>(kCount, otherwise));
        for (int i = 0; i < kCount; ++i) read[i] = within(numbers[static_cast<size_t>(i)], high, name);
        return read;
    }
    TextureUse use(const Json& of, const char* name);
    void readDielectric(const Json& extended, Material& material);

    GltfFile& file_;
    std::string who_;
    std::array<UvSource, 2>& sets_ = file_.uvSources.emplace_back();
};

TextureUse MaterialReader::use(const Json& of, const char* name) {
    const Json& info = member(of, name);
    if (info.empty()) return {};
    const size_t texture = info["index"];
    if (!file_.root["textures"][texture].contains("source")) return {};
    const int texCoord =
        extension(info, "KHR_texture_transform").value("texCoord", info.value("texCoord", 0));
    if (texCoord > 1) {
        file_.warn(who_, ".", name, ".texCoord is ", texCoord,
                   ", but only 0 and 1 are supported; the texture is left out");
        return {};
    }
    if (const int set = setOf(sets_, {texCoord, transformOf(info)}); set >= 0)
        return {static_cast<int>(texture), set};
    file_.warn(who_, ".", name, " is the third with texture coordinates of its own; the texture is left out");
    return {};
}

// KHR_materials_ior and KHR_materials_specular: F0 = min(((n - 1) / (n + 1))^2 colour, 1) factor, F90 =
// factor. An index of refraction of 0 stands for infinity: F0 before the colour is 1.
void MaterialReader::readDielectric(const Json& extended, Material& material) {
    const Json& specular = member(extended, "KHR_materials_specular");
    const double given = member(extended, "KHR_materials_ior").value("ior", 1.5);
    const double ior = given == 0 ? 0 : std::max(given, 1.0), root = (ior - 1) / (ior + 1);
    if (ior != given) file_.warn(who_, ".ior is ", given, "; ", ior, " is taken");
    material.dielectricF90 = factor(specular, "specularFactor", 1);
    const glm::dvec3 tint(colour<3>(specular, "specularColorFactor", 1, kMaxSpecularColour));
    for (int i = 0; i < 3; ++i)
        material.dielectricF0[i] =
            material.dielectricF90 * static_cast<float>(std::min(root * root * tint[i], 1.0));
    material.specular = use(specular, "specularTexture");
    material.specularColour = use(specular, "specularColorTexture");
}

Material MaterialReader::read(const Json& from) {
    const Json &pbr = member(from, "pbrMetallicRoughness"), &extended = member(from, "extensions");
    Material material;
    material.name = from.value("name", "");
    material.baseColourLin = colour<4>(pbr, "baseColorFactor", 1);
    material.alphaMode = alphaMode(from.value("alphaMode", "OPAQUE"), who_);
    material.alphaCutoff = factor(from, "alphaCutoff", 0.5, std::numeric_limits<float>::max());
    material.doubleSided = from.value("doubleSided", false);
    material.baseColour = use(pbr, "baseColorTexture");
    material.unlit = extended.contains("KHR_materials_unlit");
    if (material.unlit) return material;
    material.metallic = factor(pbr, "metallicFactor", 1);
    material.roughness = factor(pbr, "roughnessFactor", 1);
    material.emissiveLin = factor(member(extended, "KHR_materials_emissive_strength"), "emissiveStrength", 1,
                                  kMaxEmissiveStrength) *
                           colour<3>(from, "emissiveFactor", 0);
    material.normalScale = member(from, "normalTexture").value("scale", 1.0f);
    material.occlusionStrength = factor(member(from, "occlusionTexture"), "strength", 1);
    material.metallicRoughness = use(pbr, "metallicRoughnessTexture");
    material.normal = use(from, "normalTexture");
    material.occlusion = use(from, "occlusionTexture");
    material.emissive = use(from, "emissiveTexture");
    readDielectric(extended, material);
    const Json& clearcoat = member(extended, "KHR_materials_clearcoat");
    material.clearcoat = factor(clearcoat, "clearcoatFactor", 0);
    material.clearcoatRoughness = factor(clearcoat, "clearcoatRoughnessFactor", 0);
    material.coat = use(clearcoat, "clearcoatTexture");
    material.coatRoughness = use(clearcoat, "clearcoatRoughnessTexture");
    if (clearcoat.contains("clearcoatNormalTexture"))
        file_.warn(who_, ".clearcoatNormalTexture is left out; the clearcoat is smooth");
    return material;
}

ImageRgba8 readImage(GltfFile& file, size_t index) {
    const Json& source = file.root["images"][index];
    const std::string who = element("images", index), type = source.value("mimeType", "");
    if (source.contains("uri") == source.contains("bufferView"))
        fault(who, " has not exactly one of uri and bufferView");
    if (!type.empty() && type != "image/png" && type != "image/jpeg")
        fault(who, ".mimeType is ", quoted(type), ", neither image/png nor image/jpeg");
    if (source.contains("uri")) return decodeImage(file, readUri(file, source["uri"], who), who);
    return decodeImage(file, file.bytesOf(file.bufferViews[source["bufferView"].get<size_t>()]), who);
}

} // namespace

void readMaterials(GltfFile& file, Model& model) {
    for (const Json& texture : member(file.root, "textures"))
        model.textures.push_back(readTexture(file.root, texture));
    for (const Json& material : member(file.root, "materials"))
        model.materials.push_back(
            MaterialReader(file, element("materials", model.materials.size())).read(material));

    // Images that nothing shows may be of any format: alternatives for extensions, or left over.
    model.images.resize(member(file.root, "images").size());
    for (const Material& material : model.materials)
        for (const TextureUse& use : material.textures()) {
            if (use.texture < 0) continue;
            const int image = model.textures[use.texture].image;
            if (model.images[image].empty()) model.images[image] = readImage(file, image);
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
