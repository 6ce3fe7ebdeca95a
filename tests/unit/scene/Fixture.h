// Small glTF files made in a test, and the reference data.
#pragma once

#include "engine/scene/Model.h"
#include "tests/Test.h"

#include <nlohmann/json.hpp>

namespace shoal::scene {

using Json = nlohmann::json;

inline Path sharedData() { return tests::sharedDataFolder(); }

// A folder that is deleted at the end of the test.
class Folder : public tests::ScratchFolder {
  public:
    Path write(const std::string& name, const std::string& bytes) const {
        const Path file = path() / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << bytes;
        return file;
    }
};

inline std::string base64(const std::vector<uint8_t>& bytes) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t bits = static_cast<uint32_t>(bytes[i]) << 16;
        if (i + 1 < bytes.size()) bits |= static_cast<uint32_t>(bytes[i + 1]) << 8;
        if (i + 2 < bytes.size()) bits |= bytes[i + 2];
        for (int k = 0; k < 4; ++k)
            text += i + static_cast<size_t>(k) <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

// A glTF document under construction. Each add function appends one accessor.
struct Gltf {
    Json root = {{"asset", {{"version", "2.0"}}}};
    std::vector<uint8_t> bytes;

    static constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
                         kUnsignedInt = 5125, kFloat = 5126;

    template <class T> int addView(const std::vector<T>& values) {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        const size_t offset = bytes.size(), length = values.size() * sizeof(T);
        bytes.resize(offset + length);
        std::memcpy(bytes.data() + offset, values.data(), length);
        root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}});
        return static_cast<int>(root["bufferViews"].size()) - 1;
    }

    int addAccessor(int view, size_t count, const char* type, int componentType, bool normalized = false) {
        root["accessors"].push_back({{"bufferView", view},
                                     {"componentType", componentType},
                                     {"count", count},
                                     {"type", type},
                                     {"normalized", normalized}});
        return static_cast<int>(root["accessors"].size()) - 1;
    }
    template <class T>
    int add(const std::vector<T>& values, const char* type, int componentType, bool normalized = false) {
        const std::string name = type;
        const size_t components = name == "SCALAR" ? 1
                                  : name == "MAT4" ? 16
                                                   : static_cast<size_t>(name[3] - '0');
        return addAccessor(addView(values), values.size() / components, type, componentType, normalized);
    }
    int addFloats(const std::vector<float>& values, const char* type) { return add(values, type, kFloat); }

    // Adds a mesh of one primitive and a node that shows it. Returns the primitive, for changes.
    Json& addTriangles(int positions) {
        root["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}});
        root["nodes"].push_back({{"mesh", root["meshes"].size() - 1}});
        return root["meshes"].back()["primitives"][0];
    }

    std::string text() const {
        Json whole = root;
        if (!bytes.empty() && !whole.contains("buffers"))
            whole["buffers"] = {{{"byteLength", bytes.size()},
                                 {"uri", "data:application/octet-stream;base64," + base64(bytes)}}};
        return whole.dump();
    }

    Result<Model> load(const LoadLimits& limits = {}) const {
        const Folder folder;
        return loadModel(folder.write("model.gltf", text()), {}, limits);
    }
    Model model() const { return tests::valueOf(load()); }
};

// Loads one of the game's models.
inline Model shipped(const std::string& name, const std::string& variant = {}) {
    return tests::valueOf(loadModel(dataRoot() / "content/models" / (name + ".glb"), variant));
}

inline Pose restOf(const Model& model) {
    Pose pose;
    restPose(model, pose);
    return pose;
}

// A PNG of one white pixel.
constexpr const char* kWhite =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4"
    "nGP4//8/AAX+Av4N70a4AAAAAElFTkSuQmCC";

inline const std::vector<float> kTriangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};

// Returns the reason for which the document is refused; "" if it is accepted.
inline std::string refusal(const Result<Model>& model) { return model ? "" : model.error().reason; }

} // namespace shoal::scene
