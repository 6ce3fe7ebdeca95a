// KHR_materials_variants: a model with several sets of materials.
#include "Fixture.h"

#include <gmock/gmock.h>

namespace shoal::scene {
namespace {

using testing::HasSubstr;

// Returns a file with two primitives; the second has the same material in every variant.
Gltf dressed() {
    Gltf file;
    file.root["extensionsUsed"] = {"KHR_materials_variants"};
    file.root["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "plain"}},
                                                                     {{"name", "gloved"}}};
    file.root["materials"] = {{{"name", "a"}}, {{"name", "b"}}, {{"name", "c"}}};
    const int positions = file.addFloats(kTriangle, "VEC3");
    Json& first = file.addTriangles(positions);
    first["material"] = 0;
    first["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 0}, {"variants", {0}}},
                                                                 {{"material", 2}, {"variants", {1.0}}}};
    file.root["meshes"][0]["primitives"].push_back(
        {{"attributes", {{"POSITION", positions}}}, {"material", 1}});
    return file;
}

TEST(Variants, DressThePrimitivesThatTheyName) {
    auto model = dressed().load();
    ASSERT_TRUE(model) << model.error().message();
    EXPECT_EQ(model->variants, (std::vector<std::string>{"plain", "gloved"}));
    ASSERT_TRUE(applyVariant(*model, "gloved"));
    EXPECT_EQ(model->meshes[0].primitives[0].material, 2);
    EXPECT_EQ(model->meshes[0].primitives[1].material, 1);
    ASSERT_TRUE(applyVariant(*model, "plain"));
    EXPECT_EQ(model->meshes[0].primitives[0].material, 0);
    EXPECT_FALSE(applyVariant(*model, "armoured"));
    EXPECT_EQ(model->meshes[0].primitives[0].material, 0);
}

TEST(Variants, AVariantThatNothingWearsNeedsNoTexture) {
    auto model = dressed().load();
    ASSERT_TRUE(model) << model.error().message();
    for (Material& material : model->materials) material.baseColour.texture = 0;
    ASSERT_TRUE(applyVariant(*model, "plain"));
    EXPECT_EQ(model->materials[0].baseColour.texture, 0);
    EXPECT_EQ(model->materials[1].baseColour.texture, 0);
    EXPECT_EQ(model->materials[2].baseColour.texture, -1);
}

TEST(Variants, ReferToWhatIsThere) {
    Gltf file = dressed();
    Json& mappings =
        file.root["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"];
    mappings[1]["material"] = 3;
    EXPECT_THAT(refusal(file.load()), HasSubstr("refers to material 3, but there are 3"));
    mappings[1]["material"] = 2;
    for (const Json& wrong : {Json(2), Json(-1), Json("one"), Json(1e300), Json()}) {
        mappings[1]["variants"] = {wrong};
        EXPECT_THAT(refusal(file.load()), HasSubstr("refers to variant " + wrong.dump())) << wrong;
    }
}

// Nothing of an extension is checked by glTF's schema: all of it may be of any type.
TEST(Variants, WrongTypesGiveNone) {
    for (const Json& wrong : {Json(7), Json("x"), Json::array({1, 2}), Json::object(), Json()}) {
        Gltf file = dressed();
        file.root["extensions"] = wrong;
        const auto model = file.load();
        ASSERT_TRUE(model) << model.error().message();
        EXPECT_TRUE(model->variants.empty());
    }
    for (const Json& wrong : {Json(7), Json("x"), Json::object(), Json()}) {
        Gltf file = dressed();
        file.root["meshes"][0]["primitives"][0]["extensions"] = wrong;
        auto model = file.load();
        ASSERT_TRUE(model) << model.error().message();
        EXPECT_TRUE(applyVariant(*model, "gloved"));
        EXPECT_EQ(model->meshes[0].primitives[0].material, 0);
    }
}

} // namespace
} // namespace shoal::scene
