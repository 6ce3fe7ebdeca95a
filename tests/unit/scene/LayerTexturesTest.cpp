// The textures of KHR_materials_specular and KHR_materials_clearcoat.
#include "Fixture.h"
#include "engine/scene/Surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace shoal::scene {
namespace {

using ::testing::HasSubstr;

// Returns a file with two textures of one white picture, which only these extensions use.
Gltf layered(const Json& specular, const Json& clearcoat) {
    Gltf file;
    file.root["extensionsUsed"] = {"KHR_materials_specular", "KHR_materials_clearcoat",
                                   "KHR_texture_transform"};
    file.root["images"] = {{{"uri", kWhitePixel}}};
    file.root["textures"] = {{{"source", 0}}, {{"source", 0}}};
    Json material;
    material["extensions"]["KHR_materials_specular"] = specular;
    material["extensions"]["KHR_materials_clearcoat"] = clearcoat;
    file.root["materials"] = {material};
    addTexturedTriangle(file);
    return file;
}

TEST(LayerTextures, AreReadWithTheirPicturesAndCoordinates) {
    const auto model = layered({{"specularTexture", {{"index", 0}}},
                                {"specularColorTexture", {{"index", 1}, {"texCoord", 1}}}},
                               {{"clearcoatFactor", 1},
                                {"clearcoatTexture", {{"index", 1}, {"texCoord", 1}}},
                                {"clearcoatRoughnessTexture", {{"index", 0}}}})
                           .load();
    ASSERT_TRUE(model) << model.error().message();
    const Material& material = model->materials[0];
    EXPECT_EQ(material.specular.texture, 0);
    EXPECT_EQ(material.specular.texCoord, 0);
    EXPECT_EQ(material.specularColour.texture, 1);
    EXPECT_EQ(material.specularColour.texCoord, 1);
    EXPECT_EQ(material.coat.texture, 1);
    EXPECT_EQ(material.coat.texCoord, 1);
    EXPECT_EQ(material.coatRoughness.texture, 0);
    EXPECT_FALSE(model->images[0].empty());
}

TEST(LayerTextures, AreTransformed) {
    const Json moved = {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}}}};
    for (const char* name : {"specularTexture", "specularColorTexture"}) {
        const auto model = layered({{name, moved}}, Json::object()).load();
        ASSERT_TRUE(model) << model.error().message();
        EXPECT_EQ(model->meshes[0].primitives[0].texCoords[0][0], glm::vec2(1.5f, 0)) << name;
    }
    for (const char* name : {"clearcoatTexture", "clearcoatRoughnessTexture"}) {
        const auto model = layered(Json::object(), {{name, moved}}).load();
        ASSERT_TRUE(model) << model.error().message();
        EXPECT_EQ(model->meshes[0].primitives[0].texCoords[0][0], glm::vec2(1.5f, 0)) << name;
    }
}

TEST(LayerTextures, MissingTexturesAreRefused) {
    for (const Json& wrong : {Json(2), Json(-1), Json("0"), Json(1e300), Json()})
        EXPECT_THAT(refusal(layered({{"specularTexture", {{"index", wrong}}}}, Json::object()).load()),
                    HasSubstr("specularTexture refers to texture"))
            << wrong;
}

TEST(LayerTextures, ACoatsNormalsAreLeftOut) {
    const auto model =
        layered(Json::object(), {{"clearcoatFactor", 1}, {"clearcoatNormalTexture", {{"index", 0}}}}).load();
    ASSERT_TRUE(model) << model.error().message();
    EXPECT_EQ(model->materials[0].clearcoat, 1);
    EXPECT_TRUE(model->images[0].empty());
}

// Light is made for the smoothest that reflects it.
TEST(LayerTextures, ACoatsRoughnessCounts) {
    auto model = layered(Json::object(), {{"clearcoatFactor", 1},
                                          {"clearcoatRoughnessFactor", 0.5},
                                          {"clearcoatRoughnessTexture", {{"index", 0}}}})
                     .load();
    ASSERT_TRUE(model) << model.error().message();
    EXPECT_FLOAT_EQ(minGloss(*model).minRoughness, 0.5f);
    model->images[0].pixels[1] = 51; // G
    EXPECT_FLOAT_EQ(minGloss(*model).minRoughness, 0.1f);
}

} // namespace
} // namespace shoal::scene
