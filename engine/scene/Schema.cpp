#include "engine/scene/Gltf.h"

#include <cmath>
#include <limits>

namespace shoal::scene {

namespace {

using Json = nlohmann::json;

// Schema of the members that are read: glTF 2.0 specification, appendix A "JSON Schema Reference". A name
// that ends in ! is required. "count": 0 .. 2^31-1. "@nodes": an index into the top-level list `nodes`. [x]:
// a list of x; [x, n]: a list of n numbers. {"*": x}: an object whose every member is x. Members that are
// named as an extension are made by tidy().
const char* const kShape = R"({
  "asset!": {"version!": "text", "minVersion": "text", "generator": "text", "copyright": "text"},
  "extensionsUsed": ["text"], "extensionsRequired": ["text"],
  "scene": "@scenes",
  "scenes": [{"name": "text", "nodes": ["@nodes"]}],
  "nodes": [{"name": "text", "mesh": "@meshes", "skin": "@skins", "camera": "@cameras", "children": ["@nodes"],
    "matrix": ["number", 16], "translation": ["number", 3], "rotation": ["number", 4], "scale": ["number", 3],
    "weights": ["number"]}],
  "cameras": [{"name": "text"}],
  "buffers": [{"name": "text", "uri": "text", "byteLength!": "count",
    "EXT_meshopt_compression": {"fallback": "flag"}}],
  "bufferViews": [{"name": "text", "buffer!": "@buffers", "byteOffset": "count", "byteLength!": "count",
    "byteStride": "count", "target": "count",
    "EXT_meshopt_compression": {"buffer!": "@buffers", "byteOffset": "count", "byteLength!": "count",
      "byteStride!": "count", "count!": "count", "mode!": "text", "filter": "text"}}],
  "accessors": [{"name": "text", "bufferView": "@bufferViews", "byteOffset": "count", "componentType!": "count",
    "normalized": "flag", "count!": "count", "type!": "text", "min": ["number"], "max": ["number"],
    "sparse": {"count!": "count",
      "indices!": {"bufferView!": "@bufferViews", "byteOffset": "count", "componentType!": "count"},
      "values!": {"bufferView!": "@bufferViews", "byteOffset": "count"}}}],
  "meshes": [{"name": "text", "weights": ["number"],
    "primitives!": [{"attributes!": {"*": "@accessors"}, "indices": "@accessors", "material": "@materials",
      "mode": "count", "targets": [{"*": "@accessors"}]}]}],
  "skins": [{"name": "text", "inverseBindMatrices": "@accessors", "skeleton": "@nodes", "joints!": ["@nodes"]}],
  "animations": [{"name": "text",
    "channels!": [{"sampler!": "count", "target!": {"node": "@nodes", "path!": "text"}}],
    "samplers!": [{"input!": "@accessors", "interpolation": "text", "output!": "@accessors"}]}],
  "materials": [{"name": "text",
    "pbrMetallicRoughness": {"baseColorFactor": ["number", 4],
      "metallicFactor": "number", "roughnessFactor": "number",
      "baseColorTexture": {"index!": "@textures", "texCoord": "count"},
      "metallicRoughnessTexture": {"index!": "@textures", "texCoord": "count"}},
    "normalTexture": {"index!": "@textures", "texCoord": "count", "scale": "number"},
    "occlusionTexture": {"index!": "@textures", "texCoord": "count", "strength": "number"},
    "emissiveTexture": {"index!": "@textures", "texCoord": "count"},
    "emissiveFactor": ["number", 3], "alphaMode": "text", "alphaCutoff": "number", "doubleSided": "flag"}],
  "textures": [{"name": "text", "sampler": "@samplers", "source": "@images"}],
  "samplers": [{"name": "text", "magFilter": "count", "minFilter": "count", "wrapS": "count", "wrapT": "count"}],
  "images": [{"name": "text", "uri": "text", "mimeType": "text", "bufferView": "@bufferViews"}]
})";

struct Checker {
    const Json& document;
    uint64_t maxElements;

    void check(const Json& value, const Json& shape, const std::string& where) const {
        if (shape.is_object())
            checkObject(value, shape, where);
        else if (shape.is_array())
            checkList(value, shape, where);
        else
            checkScalar(value, shape.get_ref<const std::string&>(), where);
    }

    void checkObject(const Json& value, const Json& shape, const std::string& where) const {
        if (!value.is_object()) fault(where.empty() ? "its JSON" : where, " is not an object");
        const auto path = [&](const std::string& name) { return where.empty() ? name : where + "." + name; };
        for (const auto& [member, inner] : shape.items()) {
            const bool required = member.ends_with('!');
            const std::string name = required ? member.substr(0, member.size() - 1) : member;
            if (name == "*")
                for (const auto& [each, of] : value.items()) check(of, inner, path(quoted(each)));
            else if (const auto found = value.find(name); found != value.end())
                check(*found, inner, path(name));
            else if (required)
                fault(path(name), " is missing");
        }
    }

    void checkList(const Json& value, const Json& shape, const std::string& where) const {
        if (!value.is_array()) fault(where, " is not a list");
        const uint64_t limit = maxElements * (where == "accessors" || where == "bufferViews" ? 4 : 1);
        if (shape[0].is_object() && value.size() > limit)
            fault(where, " has ", value.size(), " elements, more than the limit of ", limit);
        for (size_t i = 0; i < value.size(); ++i) check(value[i], shape[0], element(where, i));
        if (shape.size() > 1 && value.size() != shape[1])
            fault(where, " has ", value.size(), " numbers instead of ", shape[1]);
    }

    void checkScalar(const Json& value, const std::string& shape, const std::string& where) const {
        if (shape == "text") {
            if (!value.is_string()) fault(where, " is not a string");
        } else if (shape == "flag") {
            if (!value.is_boolean()) fault(where, " is neither true nor false");
        } else if (shape == "number") {
            if (!value.is_number()) fault(where, " is not a number");
            if (!std::isfinite(value.get<float>())) fault(where, " is not finite");
        } else {
            if (!value.is_number_integer()) fault(where, " is not a whole number");
            if (!value.is_number_unsigned() && value.get<int64_t>() < 0) fault(where, " is negative");
            const uint64_t number = value.get<uint64_t>();
            if (number > std::numeric_limits<int32_t>::max())
                fault(where, " is ", number, ", more than can be");
            if (shape == "count") return;
            const std::string into = shape.substr(1);
            const auto list = document.find(into);
            const size_t size = list != document.end() && list->is_array() ? list->size() : 0;
            if (number >= size) fault(where, " is ", number, ", but there are ", size, " ", into);
        }
    }
};

} // namespace

void checkSchema(const Json& document, uint32_t maxElements) {
    Checker{document, maxElements}.check(document, Json::parse(kShape), "");
}

} // namespace shoal::scene
