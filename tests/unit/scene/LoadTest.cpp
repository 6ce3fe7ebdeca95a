#include "tests/unit/scene/Fixture.h"

namespace shoal::scene {
namespace {

const Primitive& only(const Model& model) { return model.meshes.at(0).primitives.at(0); }

// Every model of the reference data that is meant to be drawn.
TEST(Load, ReferenceModels) {
    size_t count = 0;
    for (const char* folder : {"gltf", "hands", "fidelity"}) {
        std::error_code code;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(sharedData() / folder, code)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".gltf" && extension != ".glb") continue;
            ++count;
            const auto model = tests::valueOf(loadModel(entry.path()));
            const Bounds bounds = posedBounds(model, restOf(model));
            EXPECT_GT(glm::distance(bounds.low, bounds.high), 0) << entry.path();
            for (const Material& material : model.materials)
                if (material.baseColour.texture >= 0) {
                    const int image = model.textures[material.baseColour.texture].image;
                    EXPECT_FALSE(model.images[image].empty()) << entry.path();
                }
        }
    }
    if (count == 0) GTEST_SKIP() << "no models below " << sharedData();
}

TEST(Load, FlatNormalsWhereThereAreNone) {
    Gltf file;
    const int positions = file.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
    Json& primitive = file.addTriangles(positions);
    primitive["indices"] = file.add<uint8_t>({0, 1, 2, 0, 3, 1}, "SCALAR", Gltf::kUnsignedByte);
    const auto model = file.model();
    const Primitive& p = only(model);
    ASSERT_EQ(p.positions.size(), 6u); // shared corners are split
    EXPECT_EQ(p.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(p.normals[2], glm::vec3(0, 0, 1));
    EXPECT_EQ(p.normals[3], glm::vec3(0, 1, 0));
    EXPECT_EQ(p.positions[4], glm::vec3(0, 0, 1));
    EXPECT_TRUE(p.tangents.empty());
}

TEST(Load, FlatNormalsOfMorphTargets) {
    Gltf file;
    Json& primitive = file.addTriangles(file.addFloats(kTriangle, "VEC3"));
    // Lifts the third corner from (0, 1, 0) to (0, 0, 1): the normal goes from +Z to -Y.
    primitive["targets"] = {{{"POSITION", file.addFloats({0, 0, 0, 0, 0, 0, 0, -1, 1}, "VEC3")}}};
    file.root["meshes"][0]["weights"] = {0.5};
    const auto model = file.model();
    EXPECT_EQ(model.meshes[0].morphWeights, std::vector<float>{0.5f});
    ASSERT_EQ(only(model).morphTargets.size(), 1u);
    EXPECT_EQ(only(model).morphTargets[0].normals[1], glm::vec3(0, -1, -1));
}

TEST(Load, StripsAndFansBecomeLists) {
    const auto indicesOf = [](int mode) {
        Gltf file;
        Json& primitive =
            file.addTriangles(file.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3"));
        primitive["mode"] = mode;
        primitive["attributes"]["NORMAL"] =
            file.addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
        return only(file.model()).indices;
    };
    EXPECT_EQ(indicesOf(5), (std::vector<uint32_t>{0, 1, 2, 1, 3, 2, 2, 3, 4}));
    EXPECT_EQ(indicesOf(6), (std::vector<uint32_t>{1, 2, 0, 2, 3, 0, 3, 4, 0}));
}

TEST(Load, PointsAndLinesAreLeftOut) {
    for (int mode = 0; mode < 4; ++mode) {
        Gltf file;
        file.addTriangles(file.addFloats(kTriangle, "VEC3"))["mode"] = mode;
        EXPECT_TRUE(file.model().meshes[0].primitives.empty());
    }
}

TEST(Load, ColoursOfEveryComponentType) {
    const auto colourOf = [](Gltf& file, int accessor) {
        file.root["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = accessor;
        return only(file.model()).coloursLin.at(1);
    };
    Gltf file;
    file.addTriangles(file.addFloats(kTriangle, "VEC3"));
    const glm::vec4 opaque(1, 0, 0.2f, 1), clear(1, 0, 0.2f, 0.4f);
    EXPECT_EQ(colourOf(file, file.addFloats({0, 0, 0, 1, 0, 0.2f, 0, 0, 0}, "VEC3")), opaque);
    EXPECT_EQ(colourOf(file, file.addFloats({0, 0, 0, 0, 1, 0, 0.2f, 0.4f, 0, 0, 0, 0}, "VEC4")), clear);
    EXPECT_EQ(colourOf(file, file.add<uint16_t>({0, 0, 0, 0, 65535, 0, 13107, 26214, 0, 0, 0, 0}, "VEC4",
                                                Gltf::kUnsignedShort, true)),
              clear);
    const int bytes =
        file.add<uint8_t>({0, 0, 0, 0, 255, 0, 51, 102, 0, 0, 0, 0}, "VEC4", Gltf::kUnsignedByte, true);
    EXPECT_EQ(colourOf(file, bytes), clear);
    // Three bytes a colour, padded to a stride of four.
    file.root["accessors"][static_cast<size_t>(bytes)]["type"] = "VEC3";
    file.root["bufferViews"].back()["byteStride"] = 4;
    EXPECT_EQ(colourOf(file, bytes), opaque);
}

TEST(Load, SparseAccessorsReplaceElements) {
    Gltf file;
    const int positions = file.addFloats(kTriangle, "VEC3");
    const int indices = file.addView<uint16_t>({1});
    const int values = file.addView<float>({7, 8, 9});
    file.root["accessors"][static_cast<size_t>(positions)]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", indices}, {"componentType", Gltf::kUnsignedShort}}},
        {"values", {{"bufferView", values}}}};
    file.addTriangles(positions);
    auto model = file.model();
    EXPECT_EQ(only(model).positions[1], glm::vec3(7, 8, 9));
    EXPECT_EQ(only(model).positions[2], glm::vec3(0, 1, 0));
    file.root["accessors"][static_cast<size_t>(positions)].erase("bufferView"); // the others are zeros then
    model = file.model();
    EXPECT_EQ(only(model).positions[1], glm::vec3(7, 8, 9));
    EXPECT_EQ(only(model).positions[2], glm::vec3(0));
}

TEST(Load, WeightsSumToOneAndTheFourHeaviestStay) {
    Gltf file;
    Json& primitive = file.addTriangles(file.addFloats(kTriangle, "VEC3"));
    using Bytes = std::vector<uint8_t>;
    const auto joints = [&](const Bytes& v) { return file.add(v, "VEC4", Gltf::kUnsignedByte); };
    primitive["attributes"]["JOINTS_0"] = joints({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 99, 99});
    primitive["attributes"]["JOINTS_1"] = joints({2, 0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0});
    primitive["attributes"]["WEIGHTS_0"] = file.addFloats({1, 1, 0, 0, 0, 0, 0, 0, 3, 1, 0, 0}, "VEC4");
    primitive["attributes"]["WEIGHTS_1"] = file.addFloats({2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
    for (int i = 0; i < 3; ++i) file.root["nodes"].push_back(Json::object());
    file.root["nodes"][0]["skin"] = 0;
    file.root["skins"] = {{{"joints", {1, 2, 3}}}};
    const auto model = file.model();
    EXPECT_EQ(only(model).weights[0], glm::vec4(0.5f, 0.25f, 0.25f, 0));
    EXPECT_EQ(only(model).joints[0], glm::u16vec4(2, 0, 1, 0));
    EXPECT_EQ(only(model).weights[1], glm::vec4(1, 0, 0, 0));
    EXPECT_EQ(only(model).weights[2], glm::vec4(0.75f, 0.25f, 0, 0));
    for (const glm::u16vec4& joint : only(model).joints)
        for (int k = 0; k < 4; ++k) EXPECT_LT(joint[k], 3); // 99 has no weight
}

TEST(Load, MatricesAreSplitWhereTheyCanBe) {
    Gltf file;
    file.root["nodes"] = {{{"matrix", {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, -4, 0, 5, 6, 7, 1}}},
                          {{"matrix", {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}}; // sheared
    const auto model = file.model();
    ASSERT_FALSE(model.nodes[0].matrix);
    EXPECT_EQ(model.nodes[0].parentFromNode.translation, glm::vec3(5, 6, 7));
    EXPECT_EQ(glm::abs(model.nodes[0].parentFromNode.scale), glm::vec3(2, 3, 4));
    ASSERT_TRUE(model.nodes[1].matrix);
    const Pose pose = restOf(model);
    const glm::mat4 expected(0, 2, 0, 0, -3, 0, 0, 0, 0, 0, -4, 0, 5, 6, 7, 1);
    for (int i = 0; i < 16; ++i)
        EXPECT_NEAR(pose.modelFromNode[0][i / 4][i % 4], expected[i / 4][i % 4],
                    2e-6f); // float rounding of 4
    EXPECT_EQ(pose.modelFromNode[1][1][0], 1);
}

TEST(Load, NormalizedIntegerKeysBecomeRotations) {
    Gltf file;
    file.root["nodes"] = {Json::object()};
    const int times = file.addFloats({0, 1}, "SCALAR");
    const int turns = file.add<int16_t>({0, 0, 0, 32767, 0, 32767, 0, 0}, "VEC4", Gltf::kShort, true);
    file.root["animations"] = {
        {{"name", "turn"},
         {"samplers", {{{"input", times}, {"output", turns}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}}};
    const auto model = file.model();
    ASSERT_EQ(model.findAnimation("turn"), 0);
    EXPECT_EQ(model.animations[0].duration_s, 1);
    EXPECT_EQ(model.animations[0].channels[0].values, (std::vector<float>{0, 0, 0, 1, 0, 1, 0, 0}));
}

TEST(Load, Materials) {
    Gltf file;
    file.root["materials"] = {
        {{"name", "skin"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.25}, {"roughnessFactor", 7}}},
         {"emissiveFactor", {1, 0, 0.5}},
         {"alphaMode", "MASK"},
         {"alphaCutoff", 0.75},
         {"doubleSided", true}},
        Json::object()};
    const auto model = file.model();
    const Material& skin = model.materials[0];
    EXPECT_EQ(skin.baseColourLin, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(skin.metallic, 0.25f);
    EXPECT_EQ(skin.roughness, 1); // clamped
    EXPECT_EQ(skin.emissiveLin, glm::vec3(1, 0, 0.5f));
    EXPECT_EQ(skin.alphaMode, AlphaMode::Mask);
    EXPECT_EQ(skin.alphaCutoff, 0.75f);
    EXPECT_TRUE(skin.doubleSided);
    EXPECT_EQ(model.materials[1].alphaMode, AlphaMode::Opaque);
    EXPECT_EQ(model.materials[1].metallic, 1);
}

// TextureSettingsTest has samplers with each wrap mode; Fox names its joints.
TEST(Load, SamplersAndNamesOfReferenceModels) {
    const Path settings = sharedData() / "gltf/TextureSettingsTest.glb", fox = sharedData() / "gltf/Fox.glb";
    if (!exists(settings) || !exists(fox)) GTEST_SKIP() << "no " << settings;
    const auto model = tests::valueOf(loadModel(settings));
    std::array<bool, 3> seen{};
    for (const Texture& texture : model.textures) seen[static_cast<size_t>(texture.wrapS)] = true;
    EXPECT_TRUE(seen[0] && seen[1] && seen[2]);
    const auto animal = tests::valueOf(loadModel(fox));
    EXPECT_GE(animal.findAnimation("Run"), 0);
    EXPECT_EQ(animal.findAnimation("Fly"), -1);
    EXPECT_EQ(animal.skins.at(0).joints.size(), 24u);
}

} // namespace
} // namespace shoal::scene
