#include "engine/scene/Variants.h"

#include "engine/scene/Loading.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace shoal::scene {

namespace {

using Json = nlohmann::json;

constexpr const char* kExtension = "KHR_materials_variants";
constexpr size_t kMaxVariants = 256;

// What may be anything at all is taken for empty where it is not what it should be: the schema says the rest.
const Json& member(const Json& value, const char* key) {
    static const Json kNothing;
    if (!value.is_object()) return kNothing;
    const auto found = value.find(key);
    return found == value.end() ? kNothing : *found;
}

const Json& list(const Json& value, const char* key) {
    static const Json kEmpty = Json::array();
    const Json& found = member(value, key);
    return found.is_array() ? found : kEmpty;
}

const Json& extension(const Json& value) { return member(member(value, "extensions"), kExtension); }

// Whole numbers may be written as 1.0; they become integers only later.
int wholeBelow(const Json& value, size_t end, const std::string& who) {
    const double number = value.is_number() ? value.get<double>() : -1;
    if (!(number >= 0 && number < static_cast<double>(end)))
        fault(who, ": ", kExtension, " refers to what is not there");
    return static_cast<int>(number);
}

std::vector<int> readPrimitive(const Json& primitive, size_t variants, const std::string& who) {
    std::vector<int> materials(variants, -1);
    for (const Json& mapping : list(extension(primitive), "mappings")) {
        const int material = wholeBelow(member(mapping, "material"), 1u << 30, who);
        for (const Json& variant : list(mapping, "variants"))
            materials[static_cast<size_t>(wholeBelow(variant, variants, who))] = material;
    }
    return materials;
}

} // namespace

Variants readVariants(const Json& root) {
    Variants variants;
    for (const Json& variant : list(extension(root), "variants")) {
        const Json& name = member(variant, "name");
        variants.names.push_back(name.is_string() ? name.get<std::string>() : std::string());
    }
    if (variants.names.size() > kMaxVariants) fault("has more than ", kMaxVariants, " material variants");
    if (variants.names.empty()) return variants;
    for (const Json& mesh : list(root, "meshes")) {
        auto& primitives = variants.materials.emplace_back();
        for (const Json& primitive : list(mesh, "primitives"))
            primitives.push_back(
                readPrimitive(primitive, variants.names.size(),
                              text(element("meshes", static_cast<int64_t>(variants.materials.size()) - 1),
                                   ".", element("primitives", static_cast<int64_t>(primitives.size())))));
    }
    return variants;
}

std::vector<int> variantMaterials(const Variants& variants, size_t mesh, size_t primitive, size_t materials) {
    if (variants.names.empty()) return {};
    const std::vector<int>& chosen = variants.materials[mesh][primitive];
    for (const int material : chosen)
        if (material >= static_cast<int>(materials))
            fault(element("meshes", static_cast<int64_t>(mesh)), ": ", kExtension, " refers to material ",
                  material, ", but there are ", materials);
    return chosen;
}

bool applyVariant(Model& model, const std::string& variant) {
    const auto found = std::find(model.variants.begin(), model.variants.end(), variant);
    if (found == model.variants.end()) return false;
    const auto index = static_cast<size_t>(found - model.variants.begin());
    std::vector<bool> worn(model.materials.size(), false);
    for (Mesh& mesh : model.meshes)
        for (Primitive& primitive : mesh.primitives) {
            const int material = primitive.variantMaterials.empty() ? -1 : primitive.variantMaterials[index];
            if (material >= 0) primitive.material = material;
            if (primitive.material >= 0) worn[static_cast<size_t>(primitive.material)] = true;
        }
    for (size_t m = 0; m < worn.size(); ++m)
        if (!worn[m]) model.materials[m] = Material{.name = model.materials[m].name};
    return true;
}

} // namespace shoal::scene
