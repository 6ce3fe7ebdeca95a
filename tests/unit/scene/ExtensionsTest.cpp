// Extensions of materials. Nothing of an extension is checked by glTF's schema: all of it may be of any type.
#include "Fixture.h"
#include "engine/scene/Surface.h"

namespace shoal::scene {
namespace {

using testing::HasSubstr;

// Returns a file with a material and a triangle that wears it.
Gltf worn(const Json& material, const Json& extensions) {
    Gltf file;
    file.root["extensionsRequired"] = extensions;
    file.root["materials"] = {material};
    file.addTriangles(file.addFloats(kTriangle, "VEC3"))["material"] = 0;
    return file;
}

// KHR_materials_clearcoat: a layer that reflects over all that lies below.
Model coated(const Json& clearcoat) {
    Json material = {{"pbrMetallicRoughness", {{"roughnessFactor", 0.5}}}};
    if (!clearcoat.is_null()) material["extensions"]["KHR_materials_clearcoat"] = clearcoat;
    return worn(material, {"KHR_materials_clearcoat"}).model();
}

void expectCoat(const Json& clearcoat, float factor, float roughness) {
    const Material material = coated(clearcoat).materials[0];
    EXPECT_EQ(material.clearcoat, factor) << clearcoat;
    EXPECT_EQ(material.clearcoatRoughness, roughness) << clearcoat;
}

TEST(Clearcoat, FactorsAreRead) {
    expectCoat(Json(), 0, 0);
    expectCoat(Json::object(), 0, 0);
    expectCoat({{"clearcoatFactor", 0.25}, {"clearcoatRoughnessFactor", 0.125}}, 0.25f, 0.125f);
    expectCoat({{"clearcoatFactor", 9}, {"clearcoatRoughnessFactor", -9}}, 1, 0);
    expectCoat({{"clearcoatFactor", "thick"}, {"clearcoatRoughnessFactor", {1}}}, 0, 0);
    expectCoat("varnish", 0, 0);
}

// Light is made for the smoothest that reflects it: a coat, where there is one.
TEST(Clearcoat, LightIsMadeForIt) {
    const auto least = [](double factor, double roughness) {
        return minGloss(coated({{"clearcoatFactor", factor}, {"clearcoatRoughnessFactor", roughness}}))
            .minRoughness;
    };
    EXPECT_EQ(least(1, 0.1), 0.1f);
    EXPECT_EQ(least(1, 0.9), 0.5f);
    EXPECT_EQ(least(0, 0.1), 0.5f);
}

// KHR_materials_ior and KHR_materials_specular: how much of the light a dielectric reflects at its surface.
Material materialWith(const Json& ior, const Json& specular = Json()) {
    Json material = {{"name", "glass"}};
    if (!ior.is_null()) material["extensions"]["KHR_materials_ior"] = ior;
    if (!specular.is_null()) material["extensions"]["KHR_materials_specular"] = specular;
    return worn(material, {"KHR_materials_ior", "KHR_materials_specular"}).model().materials[0];
}

void expectF0(const Material& material, const glm::vec3& f0, float f90) {
    for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(material.dielectricF0[c], f0[c]) << c;
    EXPECT_EQ(material.dielectricF90, f90);
}

// The index 1.5 gives exactly the core specification's values, so that such materials are drawn by the same
// program as all others.
TEST(Dielectric, OneAndAHalfIsTheUsualIndex) {
    for (const Material& material :
         {materialWith(Json()), materialWith({{"ior", 1.5}}), materialWith(Json::object(), Json::object()),
          materialWith({{"ior", 1.5}}, {{"specularFactor", 1}, {"specularColorFactor", {1, 1, 1}}})}) {
        EXPECT_EQ(material.dielectricF0, Material().dielectricF0);
        EXPECT_EQ(material.dielectricF90, Material().dielectricF90);
    }
}

// F0 = ((n - 1) / (n + 1))^2; 0 stands for infinity.
TEST(Dielectric, FollowsFromTheIndexOfRefraction) {
    expectF0(materialWith({{"ior", 1}}), glm::vec3(0), 1);
    expectF0(materialWith({{"ior", 3}}), glm::vec3(0.25f), 1);
    expectF0(materialWith({{"ior", 0}}), glm::vec3(1), 1);
    expectF0(materialWith({{"ior", 1e300}}), glm::vec3(1), 1);
}

// The colour scales F0, which is clipped; the factor scales all that is reflected.
TEST(Dielectric, SpecularColourAndFactor) {
    expectF0(materialWith(Json(), {{"specularFactor", 0.5}}), glm::vec3(0.02f), 0.5f);
    expectF0(materialWith(Json(), {{"specularFactor", 0}}), glm::vec3(0), 0);
    expectF0(materialWith({{"ior", 3}}, {{"specularFactor", 0.5}, {"specularColorFactor", {0.4, 0, 100}}}),
             {0.05f, 0, 0.5f}, 0.5f);
}

TEST(Dielectric, NonsenseIsNone) {
    expectF0(materialWith({{"ior", 0.5}}), glm::vec3(0), 1); // 1 is taken
    expectF0(materialWith({{"ior", -3}}), glm::vec3(0), 1);
    expectF0(materialWith("glass", {1, 2}), glm::vec3(0.04f), 1);
    expectF0(materialWith({{"ior", "1.3"}}, {{"specularFactor", "1"}, {"specularColorFactor", {1, 2}}}),
             glm::vec3(0.04f), 1);
    expectF0(materialWith(Json(), {{"specularFactor", 7}, {"specularColorFactor", {-1, 1e300, "red"}}}),
             {0, 1, 0.04f}, 1);
}

// KHR_materials_emissive_strength: surfaces that glow brighter than white.
glm::vec3 glowOf(const Json& strength, size_t material = 0) {
    Gltf file = worn({{"emissiveFactor", {0.5, 0.25, 1}}}, {"KHR_materials_emissive_strength"});
    file.root["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
    file.root["materials"].push_back({{"emissiveFactor", {1, 1, 1}}});
    return file.model().materials[material].emissiveLin;
}

TEST(EmissiveStrength, MultipliesAndIsBounded) {
    EXPECT_EQ(glowOf(4), glm::vec3(2, 1, 4));
    EXPECT_EQ(glowOf(0), glm::vec3(0));
    EXPECT_EQ(glowOf(4, 1), glm::vec3(1)) << "of its own material alone";
    EXPECT_EQ(glowOf(1e300), glm::vec3(5000, 2500, 10000));
    EXPECT_EQ(glowOf(-1), glm::vec3(0));
    EXPECT_EQ(glowOf("bright"), glm::vec3(0.5f, 0.25f, 1));
    EXPECT_EQ(glowOf(Json()), glm::vec3(0.5f, 0.25f, 1));
}

// KHR_materials_unlit. Properties for lighting serve readers without it; base colour and alpha stay.
TEST(Unlit, BaseColourAndAlphaStay) {
    const Json material = {
        {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 1, 0.75}}, {"roughnessFactor", 0.2}}},
        {"emissiveFactor", {1, 1, 1}},
        {"alphaMode", "MASK"},
        {"alphaCutoff", 0.7},
        {"doubleSided", true}};
    Gltf file = worn(material, {"KHR_materials_unlit"});
    file.root["materials"] = {material, material, material};
    file.root["materials"][1]["extensions"]["KHR_materials_unlit"] = Json::object();
    file.root["materials"][2]["extensions"]["KHR_materials_unlit"] = "yes";
    const Model model = file.model();
    for (const size_t lit : {0u, 2u}) {
        EXPECT_FALSE(model.materials[lit].unlit);
        EXPECT_EQ(model.materials[lit].emissiveLin, glm::vec3(1));
    }
    const Material& unlit = model.materials[1];
    EXPECT_TRUE(unlit.unlit);
    EXPECT_EQ(unlit.baseColourLin, glm::vec4(0.5f, 0.25f, 1, 0.75f));
    EXPECT_EQ(unlit.alphaMode, AlphaMode::Mask);
    EXPECT_EQ(unlit.alphaCutoff, 0.7f);
    EXPECT_TRUE(unlit.doubleSided);
    EXPECT_EQ(unlit.emissiveLin, glm::vec3(0));
    EXPECT_EQ(unlit.roughness, 1);
}

// Returns worn() with two textures of one white pixel, and with both sets of texture coordinates.
Gltf textured(const Json& material) {
    Gltf file =
        worn(material, {"KHR_materials_specular", "KHR_materials_clearcoat", "KHR_texture_transform"});
    file.root["images"] = {{{"uri", kWhite}}};
    file.root["textures"] = {{{"source", 0}}, {{"source", 0}}};
    Json& attributes = file.root["meshes"][0]["primitives"][0]["attributes"];
    attributes["TEXCOORD_0"] = file.addFloats({1, 0, 0, 1, 0.5f, 0.25f}, "VEC2");
    attributes["TEXCOORD_1"] = file.addFloats({2, 2, 3, 3, 4, 4}, "VEC2");
    return file;
}

// The textures of KHR_materials_specular and KHR_materials_clearcoat.
Gltf layered(const Json& specular, const Json& clearcoat) {
    return textured(
        {{"extensions", {{"KHR_materials_specular", specular}, {"KHR_materials_clearcoat", clearcoat}}}});
}

TEST(LayerTextures, AreReadWithTheirPicturesAndCoordinates) {
    const Json first = {{"index", 0}}, second = {{"index", 1}, {"texCoord", 1}};
    const Model model =
        layered({{"specularTexture", first}, {"specularColorTexture", second}},
                {{"clearcoatFactor", 1}, {"clearcoatTexture", second}, {"clearcoatRoughnessTexture", first}})
            .model();
    const Material& material = model.materials[0];
    EXPECT_EQ(material.specular.texture, 0);
    EXPECT_EQ(material.specular.texCoord, 0);
    EXPECT_EQ(material.specularColour.texture, 1);
    EXPECT_EQ(material.specularColour.texCoord, 1);
    EXPECT_EQ(material.coat.texture, 1);
    EXPECT_EQ(material.coat.texCoord, 1);
    EXPECT_EQ(material.coatRoughness.texture, 0);
    EXPECT_FALSE(model.images[0].empty());
}

TEST(LayerTextures, AreTransformed) {
    const Json moved = {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}}}};
    for (const char* name :
         {"specularTexture", "specularColorTexture", "clearcoatTexture", "clearcoatRoughnessTexture"}) {
        Json layers[2] = {Json::object(), Json::object()};
        layers[std::string(name).starts_with("clearcoat")][name] = moved;
        const Model model = layered(layers[0], layers[1]).model();
        EXPECT_EQ(model.meshes[0].primitives[0].texCoords[0][0], glm::vec2(1.5f, 0)) << name;
    }
}

TEST(LayerTextures, MissingTexturesAreRefused) {
    for (const Json& wrong : {Json(2), Json(-1), Json("0"), Json(1e300), Json()})
        EXPECT_THAT(refusal(layered({{"specularTexture", {{"index", wrong}}}}, Json::object()).load()),
                    HasSubstr("specularTexture refers to texture"))
            << wrong;
}

TEST(LayerTextures, ACoatsNormalsAreLeftOut) {
    const Model model =
        layered(Json::object(), {{"clearcoatFactor", 1}, {"clearcoatNormalTexture", {{"index", 0}}}}).model();
    EXPECT_EQ(model.materials[0].clearcoat, 1);
    EXPECT_TRUE(model.images[0].empty());
}

// Light is made for the smoothest that reflects it.
TEST(LayerTextures, ACoatsRoughnessCounts) {
    Model model = layered(Json::object(), {{"clearcoatFactor", 1},
                                           {"clearcoatRoughnessFactor", 0.5},
                                           {"clearcoatRoughnessTexture", {{"index", 0}}}})
                      .model();
    EXPECT_FLOAT_EQ(minGloss(model).minRoughness, 0.5f);
    model.images[0].pixels[1] = 51; // G
    EXPECT_FLOAT_EQ(minGloss(model).minRoughness, 0.1f);
}

// KHR_texture_transform: textures scaled, turned and moved over a surface; here for base colour and light of
// its own.
Model transformed(const Json& baseColour, const Json& emissive = Json()) {
    Json material;
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    material["emissiveTexture"] = {{"index", 0}, {"texCoord", 1}};
    if (!baseColour.is_null())
        material["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] =
            baseColour;
    if (!emissive.is_null()) material["emissiveTexture"]["extensions"]["KHR_texture_transform"] = emissive;
    return textured(material).model();
}

// Compares the coordinates of a texture at each corner.
void expectLookUps(const Model& model, const TextureUse Material::*use, const std::vector<glm::vec2>& want) {
    const auto& got = model.meshes[0].primitives[0].texCoords[(model.materials[0].*use).texCoord];
    ASSERT_EQ(got.size(), want.size());
    for (size_t i = 0; i < got.size(); ++i) {
        EXPECT_NEAR(got[i].x, want[i].x, 1e-6f) << i;
        EXPECT_NEAR(got[i].y, want[i].y, 1e-6f) << i;
    }
}
void expectBaseColour(const Json& transform, const std::vector<glm::vec2>& want) {
    expectLookUps(transformed(transform), &Material::baseColour, want);
}

TEST(TextureTransform, ScalesThenTurnsThenMoves) {
    expectBaseColour(Json(), {{1, 0}, {0, 1}, {0.5f, 0.25f}});
    expectBaseColour({{"offset", {0.5, -1}}}, {{1.5f, -1}, {0.5f, 0}, {1, -0.75f}});
    expectBaseColour({{"scale", {2, 4}}}, {{2, 0}, {0, 4}, {1, 1}});
    // A quarter turn against the clock as pictures are seen, v down: from the right upwards.
    const double quarter = std::numbers::pi / 2;
    expectBaseColour({{"rotation", quarter}}, {{0, -1}, {1, 0}, {0.25f, -0.5f}});
    expectBaseColour({{"rotation", quarter}, {"scale", {2, 4}}, {"offset", {10, 20}}},
                     {{10, 18}, {14, 20}, {11, 19}});
}

TEST(TextureTransform, EachUseHasItsOwn) {
    const Model model = transformed({{"scale", {2, 2}}}, {{"scale", {3, 3}}});
    expectLookUps(model, &Material::baseColour, {{2, 0}, {0, 2}, {1, 0.5f}});
    expectLookUps(model, &Material::emissive, {{6, 6}, {9, 9}, {12, 12}});
    // Both from one set of the file's.
    const Model shared = transformed({{"scale", {2, 2}}}, {{"texCoord", 0}, {"scale", {3, 3}}});
    expectLookUps(shared, &Material::baseColour, {{2, 0}, {0, 2}, {1, 0.5f}});
    expectLookUps(shared, &Material::emissive, {{3, 0}, {0, 3}, {1.5f, 0.75f}});
}

TEST(TextureTransform, NonsenseIsNone) {
    for (const Json& nonsense : {Json({{"offset", {1}}}), Json({{"scale", "big"}}),
                                 Json({{"rotation", {1, 2}}}), Json(3), Json({{"texCoord", "first"}})})
        expectBaseColour(nonsense, {{1, 0}, {0, 1}, {0.5f, 0.25f}});
    const Model huge = transformed({{"scale", {1e300, -1e300}}, {"offset", {1e300, 0}}});
    for (const glm::vec2& uv : huge.meshes[0].primitives[0].texCoords[huge.materials[0].baseColour.texCoord])
        EXPECT_TRUE(std::isfinite(uv.x) && std::isfinite(uv.y));
    EXPECT_EQ(transformed({{"texCoord", 7}}).materials[0].baseColour.texture, -1);
}

// KHR_materials_variants: a model with several sets of materials. The second of its two primitives has the
// same material in every variant.
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
    Model model = dressed().model();
    EXPECT_EQ(model.variants, (std::vector<std::string>{"plain", "gloved"}));
    ASSERT_TRUE(applyVariant(model, "gloved"));
    EXPECT_EQ(model.meshes[0].primitives[0].material, 2);
    EXPECT_EQ(model.meshes[0].primitives[1].material, 1);
    ASSERT_TRUE(applyVariant(model, "plain"));
    EXPECT_EQ(model.meshes[0].primitives[0].material, 0);
    EXPECT_FALSE(applyVariant(model, "armoured"));
    EXPECT_EQ(model.meshes[0].primitives[0].material, 0);
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

TEST(Variants, WrongTypesGiveNone) {
    for (const Json& wrong : {Json(7), Json("x"), Json::array({1, 2}), Json::object(), Json()}) {
        Gltf file = dressed();
        file.root["extensions"] = wrong;
        EXPECT_TRUE(file.model().variants.empty());
    }
    for (const Json& wrong : {Json(7), Json("x"), Json::object(), Json()}) {
        Gltf file = dressed();
        file.root["meshes"][0]["primitives"][0]["extensions"] = wrong;
        Model model = file.model();
        EXPECT_TRUE(applyVariant(model, "gloved"));
        EXPECT_EQ(model.meshes[0].primitives[0].material, 0);
    }
}

} // namespace
} // namespace shoal::scene
