#include "engine/scene/Gltf.h"

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
int reference(const Json& value, const char* to, size_t count, const std::string& who) {
    const double number = value.is_number() ? value.get<double>() : -1;
    if (!(number >= 0 && number < static_cast<double>(count)))
        fault(who, ": ", kExtension, " refers to ", to, " ", quoted(value.dump()), ", but there are ", count);
    return static_cast<int>(number);
}

} // namespace

void readVariants(const Json& root, GltfFile& file) {
    for (const Json& variant : list(extension(root), "variants")) {
        const Json& name = member(variant, "name");
        file.variants.push_back(name.is_string() ? name.get<std::string>() : std::string());
    }
    const size_t variants = file.variants.size(), materials = list(root, "materials").size();
    if (variants > kMaxVariants) fault("has more than ", kMaxVariants, " material variants");
    if (variants == 0) return;
    for (const Json& mesh : list(root, "meshes")) {
        const std::string who = element("meshes", file.variantMaterials.size());
        auto& primitives = file.variantMaterials.emplace_back();
        for (const Json& primitive : list(mesh, "primitives")) {
            std::vector<int>& chosen = primitives.emplace_back(variants, -1);
            for (const Json& mapping : list(extension(primitive), "mappings")) {
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
    std::vector<bool> worn(model.materials.size(), false);
    for (Mesh& mesh : model.meshes)
        for (Primitive& primitive : mesh.primitives) {
            const int material = primitive.variantMaterials.empty() ? -1 : primitive.variantMaterials[index];
            if (material >= 0) primitive.material = material;
            if (primitive.material >= 0) worn[primitive.material] = true;
        }
    for (size_t m = 0; m < worn.size(); ++m)
        if (!worn[m]) model.materials[m] = Material{.name = model.materials[m].name};
    return true;
}

} // namespace shoal::scene
