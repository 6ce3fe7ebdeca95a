// KHR_materials_unlit: surfaces that show their own colours.
#include "Fixture.h"

#include <gtest/gtest.h>

namespace shoal::scene {
namespace {

// Properties for lighting serve readers without the extension; base colour and alpha stay.
TEST(Unlit, BaseColourAndAlphaStay) {
    Gltf file;
    file.root["extensionsRequired"] = {"KHR_materials_unlit"};
    Json material = {
        {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 1, 0.75}}, {"roughnessFactor", 0.2}}},
        {"emissiveFactor", {1, 1, 1}},
        {"alphaMode", "MASK"},
        {"alphaCutoff", 0.7},
        {"doubleSided", true}};
    file.root["materials"] = {material, material, material};
    file.root["materials"][1]["extensions"]["KHR_materials_unlit"] = Json::object();
    file.root["materials"][2]["extensions"]["KHR_materials_unlit"] = "yes";
    file.addTriangles(file.addFloats(kTriangle, "VEC3"))["material"] = 1;
    const auto model = file.load();
    ASSERT_TRUE(model) << model.error().message();
    for (const size_t lit : {0u, 2u}) {
        EXPECT_FALSE(model->materials[lit].unlit);
        EXPECT_EQ(model->materials[lit].emissiveLin, glm::vec3(1));
    }
    const Material& unlit = model->materials[1];
    EXPECT_TRUE(unlit.unlit);
    EXPECT_EQ(unlit.baseColourLin, glm::vec4(0.5f, 0.25f, 1, 0.75f));
    EXPECT_EQ(unlit.alphaMode, AlphaMode::Mask);
    EXPECT_EQ(unlit.alphaCutoff, 0.7f);
    EXPECT_TRUE(unlit.doubleSided);
    EXPECT_EQ(unlit.emissiveLin, glm::vec3(0));
    EXPECT_EQ(unlit.roughness, 1);
}

} // namespace
} // namespace shoal::scene
