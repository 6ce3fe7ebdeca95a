#include "engine/scene/Schema.h"

#include "engine/scene/Loading.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <vector>

namespace shoal::scene {

namespace {

using Json = nlohmann::json;

enum class Kind {
    Index,   // of an element in the top-level list `into`
    Indices, // a list of these
    Named,   // an object whose every member is an Index
    Count,   // 0 .. 2^31-1
    Number,
    Numbers, // `length` of them; 0: any number
    Text,
    Texts,
    Flag,
    Object,   // of `members`
    Objects,  // a list of these
    NamedList // a list of Named
};

struct Member {
    const char* name;
    Kind kind;
    const char* into = nullptr;
    size_t length = 0;
    bool required = false;
    std::vector<Member> members = {};
};

Member index(const char* name, const char* into) { return {name, Kind::Index, into}; }
Member indices(const char* name, const char* into) { return {name, Kind::Indices, into}; }
Member count(const char* name) { return {name, Kind::Count}; }
Member number(const char* name) { return {name, Kind::Number}; }
Member numbers(const char* name, size_t length = 0) { return {name, Kind::Numbers, nullptr, length}; }
Member string(const char* name) { return {name, Kind::Text}; }
Member flag(const char* name) { return {name, Kind::Flag}; }
Member object(const char* name, std::vector<Member> members) {
    return {name, Kind::Object, nullptr, 0, false, std::move(members)};
}
Member objects(const char* name, std::vector<Member> members) {
    return {name, Kind::Objects, nullptr, 0, false, std::move(members)};
}
Member required(Member member) {
    member.required = true;
    return member;
}

Member textureInfo(const char* name, const char* factor = nullptr) {
    Member info = object(name, {required(index("index", "textures")), count("texCoord")});
    if (factor) info.members.push_back(number(factor));
    return info;
}

// glTF 2.0 specification, appendix A "JSON Schema Reference"; the members that are read.
const std::vector<Member>& documentMembers() {
    static const std::vector<Member> members = {
        required(object("asset", {required(string("version")), string("minVersion"), string("generator"),
                                  string("copyright")})),
        {"extensionsUsed", Kind::Texts},
        {"extensionsRequired", Kind::Texts},
        index("scene", "scenes"),
        objects("scenes", {string("name"), indices("nodes", "nodes")}),
        objects("nodes",
                {string("name"), index("mesh", "meshes"), index("skin", "skins"), index("camera", "cameras"),
                 indices("children", "nodes"), numbers("matrix", 16), numbers("translation", 3),
                 numbers("rotation", 4), numbers("scale", 3), numbers("weights")}),
        objects("cameras", {string("name")}),
        objects("buffers", {string("name"), string("uri"), required(count("byteLength"))}),
        objects("bufferViews", {string("name"), required(index("buffer", "buffers")), count("byteOffset"),
                                required(count("byteLength")), count("byteStride"), count("target")}),
        objects("accessors",
                {string("name"), index("bufferView", "bufferViews"), count("byteOffset"),
                 required(count("componentType")), flag("normalized"), required(count("count")),
                 required(string("type")), numbers("min"), numbers("max"),
                 object("sparse",
                        {required(count("count")),
                         required(object("indices", {required(index("bufferView", "bufferViews")),
                                                     count("byteOffset"), required(count("componentType"))})),
                         required(object("values", {required(index("bufferView", "bufferViews")),
                                                    count("byteOffset")}))})}),
        objects("meshes", {string("name"), numbers("weights"),
                           required(objects("primitives", {required({"attributes", Kind::Named, "accessors"}),
                                                           index("indices", "accessors"),
                                                           index("material", "materials"),
                                                           count("mode"),
                                                           {"targets", Kind::NamedList, "accessors"}}))}),
        objects("skins", {string("name"), index("inverseBindMatrices", "accessors"),
                          index("skeleton", "nodes"), required(indices("joints", "nodes"))}),
        objects("animations",
                {string("name"),
                 required(objects("channels", {required(count("sampler")),
                                               required(object("target", {index("node", "nodes"),
                                                                          required(string("path"))}))})),
                 required(objects("samplers", {required(index("input", "accessors")), string("interpolation"),
                                               required(index("output", "accessors"))}))}),
        objects(
            "materials",
            {string("name"),
             object("pbrMetallicRoughness",
                    {numbers("baseColorFactor", 4), textureInfo("baseColorTexture"), number("metallicFactor"),
                     number("roughnessFactor"), textureInfo("metallicRoughnessTexture")}),
             textureInfo("normalTexture", "scale"), textureInfo("occlusionTexture", "strength"),
             textureInfo("emissiveTexture"), numbers("emissiveFactor", 3), string("alphaMode"),
             number("alphaCutoff"), flag("doubleSided")}),
        objects("textures", {string("name"), index("sampler", "samplers"), index("source", "images")}),
        objects("samplers",
                {string("name"), count("magFilter"), count("minFilter"), count("wrapS"), count("wrapT")}),
        objects("images",
                {string("name"), string("uri"), string("mimeType"), index("bufferView", "bufferViews")}),
    };
    return members;
}

class Checker {
  public:
    Checker(const Json& document, uint32_t maxElements) : document_(document), maxElements_(maxElements) {}

    void members(const Json& value, const std::vector<Member>& shape, const std::string& path) {
        if (!value.is_object()) fault(path.empty() ? "its JSON" : path, " is not an object");
        for (const Member& m : shape) {
            const auto found = value.find(m.name);
            const std::string where = path.empty() ? m.name : path + "." + m.name;
            if (found != value.end())
                member(*found, m, where);
            else if (m.required)
                fault(where, " is missing");
        }
    }

  private:
    void member(const Json& value, const Member& m, const std::string& where) {
        switch (m.kind) {
        case Kind::Index:
            return checkIndex(value, m.into, where);
        case Kind::Indices:
            return each(value, where, [&](const Json& v, const std::string& w) { checkIndex(v, m.into, w); });
        case Kind::Named:
            return checkNamed(value, m.into, where);
        case Kind::NamedList:
            return each(value, where, [&](const Json& v, const std::string& w) { checkNamed(v, m.into, w); });
        case Kind::Count:
            checkCount(value, where);
            return;
        case Kind::Number:
            return checkNumber(value, where);
        case Kind::Numbers:
            each(value, where, [&](const Json& v, const std::string& w) { checkNumber(v, w); });
            if (m.length != 0 && value.size() != m.length)
                fault(where, " has ", value.size(), " numbers instead of ", m.length);
            return;
        case Kind::Text:
            return checkText(value, where);
        case Kind::Texts:
            return each(value, where, [&](const Json& v, const std::string& w) { checkText(v, w); });
        case Kind::Flag:
            if (!value.is_boolean()) fault(where, " is neither true nor false");
            return;
        case Kind::Object:
            return members(value, m.members, where);
        case Kind::Objects:
            checkLength(value, m, where);
            return each(value, where, [&](const Json& v, const std::string& w) { members(v, m.members, w); });
        }
    }

    template <class Check> void each(const Json& list, const std::string& where, Check&& check) {
        if (!list.is_array()) fault(where, " is not a list");
        for (size_t i = 0; i < list.size(); ++i) check(list[i], text(where, "[", i, "]"));
    }

    void checkLength(const Json& list, const Member& m, const std::string& where) const {
        const std::string_view name = m.name;
        const uint64_t limit = maxElements_ * (name == "accessors" || name == "bufferViews" ? 4ull : 1ull);
        if (list.is_array() && list.size() > limit)
            fault(where, " has ", list.size(), " elements, more than the limit of ", limit);
    }

    uint64_t checkCount(const Json& value, const std::string& where) const {
        if (!value.is_number_integer()) fault(where, " is not a whole number");
        if (!value.is_number_unsigned() && value.get<int64_t>() < 0) fault(where, " is negative");
        const uint64_t number = value.get<uint64_t>();
        if (number > static_cast<uint64_t>(std::numeric_limits<int32_t>::max()))
            fault(where, " is ", number, ", more than can be");
        return number;
    }

    void checkIndex(const Json& value, const char* into, const std::string& where) const {
        const uint64_t number = checkCount(value, where);
        const auto list = document_.find(into);
        const size_t size = list != document_.end() && list->is_array() ? list->size() : 0;
        if (number >= size) fault(where, " is ", number, ", but there are ", size, " ", into);
    }

    void checkNamed(const Json& value, const char* into, const std::string& where) const {
        if (!value.is_object()) fault(where, " is not an object");
        for (const auto& [name, number] : value.items()) checkIndex(number, into, where + "." + quoted(name));
    }

    static void checkNumber(const Json& value, const std::string& where) {
        if (!value.is_number()) fault(where, " is not a number");
        if (!std::isfinite(value.get<float>())) fault(where, " is not finite");
    }

    static void checkText(const Json& value, const std::string& where) {
        if (!value.is_string()) fault(where, " is not a string");
    }

    const Json& document_;
    uint32_t maxElements_;
};

} // namespace

void checkSchema(const Json& document, uint32_t maxElements) {
    Checker(document, maxElements).members(document, documentMembers(), "");
}

} // namespace shoal::scene
