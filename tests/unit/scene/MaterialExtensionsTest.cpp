// The extensions of materials: KHR_materials_*, KHR_texture_transform.
#include "Fixture.h"
#include "engine/scene/Surface.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace shoal::scene {
namespace {

using testing::HasSubstr;

// A triangle with this material, two textures of one white picture, and both sets of texture coordinates.
Gltf triangleOf(const Json& material) {
    Gltf file;
    file.root["images"] = {{{"uri", kWhitePixel}}};
    file.root["textures"] = {{{"source", 0}}, {{"source", 0}}};
    file.root["materials"] = {material};
    Json& primitive = file.addTriangles(file.addFloats(kTriangle, "VEC3"));
    primitive["material"] = 0;
    primitive["attributes"]["TEXCOORD_0"] = file.addFloats({1, 0, 0, 1, 0.5f, 0.25f}, "VEC2");
    primitive["attributes"]["TEXCOORD_1"] = file.addFloats({2, 2, 3, 3, 4, 4}, "VEC2");
    return file;
}

Model loaded(const Gltf& file) {
    auto model = file.load();
    if (!model) throw std::runtime_error(model.error().message());
    return std::move(*model);
}

Model modelWith(const Json& extensions) {
    return loaded(triangleOf({{"pbrMetallicRoughness", {{"roughnessFactor", 0.5}}},
                              {"emissiveFactor", {0.5, 0.25, 1}},
                              {"extensions", extensions}}));
}

Material materialWith(const Json& extensions) { return modelWith(extensions).materials[0]; }

TEST(Clearcoat, FactorsAreRead) {
    const auto expectCoat = [](const Json& clearcoat, float factor, float roughness) {
        const Material material = materialWith({{"KHR_materials_clearcoat", clearcoat}});
        EXPECT_EQ(material.clearcoat, factor) << clearcoat;
        EXPECT_EQ(material.clearcoatRoughness, roughness) << clearcoat;
    };
    expectCoat(Json::object(), 0, 0);
    expectCoat({{"clearcoatFactor", 0.25}, {"clearcoatRoughnessFactor", 0.125}}, 0.25f, 0.125f);
    expectCoat({{"clearcoatFactor", 9}, {"clearcoatRoughnessFactor", -9}}, 1, 0);
}

// Light is made for the smoothest surface that reflects it: a coat, where there is one.
TEST(Clearcoat, LightIsMadeForIt) {
    const auto minRoughness = [](float factor, float roughness) {
        return minGloss(modelWith({{"KHR_materials_clearcoat",
                                    {{"clearcoatFactor", factor}, {"clearcoatRoughnessFactor", roughness}}}}))
            .minRoughness;
    };
    EXPECT_EQ(minRoughness(1, 0.1f), 0.1f);
    EXPECT_EQ(minRoughness(1, 0.9f), 0.5f);
    EXPECT_EQ(minRoughness(0, 0.1f), 0.5f);
    Model model = modelWith({{"KHR_materials_clearcoat",
                              {{"clearcoatFactor", 1},
                               {"clearcoatRoughnessFactor", 0.5},
                               {"clearcoatRoughnessTexture", {{"index", 0}}}}}});
    model.images[0].pixels[1] = 51; // G
    EXPECT_FLOAT_EQ(minGloss(model).minRoughness, 0.1f);
}

TEST(LayerTextures, AreReadWithTheirPicturesAndCoordinates) {
    const Model model = modelWith(
        {{"KHR_materials_specular",
          {{"specularTexture", {{"index", 0}}}, {"specularColorTexture", {{"index", 1}, {"texCoord", 1}}}}},
         {"KHR_materials_clearcoat",
          {{"clearcoatTexture", {{"index", 1}, {"texCoord", 1}}},
           {"clearcoatRoughnessTexture", {{"index", 0}}}}}});
    const Material& material = model.materials[0];
    for (const TextureUse& use : {material.specular, material.coatRoughness}) {
        EXPECT_EQ(use.texture, 0);
        EXPECT_EQ(use.texCoord, 0);
    }
    for (const TextureUse& use : {material.specularColour, material.coat}) {
        EXPECT_EQ(use.texture, 1);
        EXPECT_EQ(use.texCoord, 1);
    }
    EXPECT_FALSE(model.images[0].empty());
}

TEST(LayerTextures, AreTransformed) {
    const Json moved = {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}}}};
    for (const auto& [extension, name] : {std::pair{"KHR_materials_specular", "specularTexture"},
                                          {"KHR_materials_specular", "specularColorTexture"},
                                          {"KHR_materials_clearcoat", "clearcoatTexture"},
                                          {"KHR_materials_clearcoat", "clearcoatRoughnessTexture"}})
        EXPECT_EQ(modelWith({{extension, {{name, moved}}}}).meshes[0].primitives[0].texCoords[0][0],
                  glm::vec2(1.5f, 0))
            << name;
}

TEST(LayerTextures, OfACoatsNormalsAreLeftOut) {
    const Model model = modelWith(
        {{"KHR_materials_clearcoat", {{"clearcoatFactor", 1}, {"clearcoatNormalTexture", {{"index", 0}}}}}});
    EXPECT_EQ(model.materials[0].clearcoat, 1);
    EXPECT_TRUE(model.images[0].empty());
}

void expectF0(const Json& ior, const Json& specular, const glm::vec3& f0, float f90) {
    const Material material =
        materialWith({{"KHR_materials_ior", ior}, {"KHR_materials_specular", specular}});
    for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(material.dielectricF0[c], f0[c]) << c;
    EXPECT_EQ(material.dielectricF90, f90);
}

const Json kNone = Json::object();

// The core specification's reflectance, to the last bit: such materials are drawn by the same program as all
// others.
TEST(Dielectric, OneAndAHalfIsTheUsualIndex) {
    for (const Json& extensions :
         {kNone, Json{{"KHR_materials_ior", {{"ior", 1.5}}}},
          Json{{"KHR_materials_ior", kNone}, {"KHR_materials_specular", kNone}},
          Json{{"KHR_materials_specular", {{"specularFactor", 1}, {"specularColorFactor", {1, 1, 1}}}}}}) {
        EXPECT_EQ(materialWith(extensions).dielectricF0, Material().dielectricF0);
        EXPECT_EQ(materialWith(extensions).dielectricF90, Material().dielectricF90);
    }
}

// F0 = ((n - 1) / (n + 1))^2; 0 stands for infinity, below 1 there is 1.
TEST(Dielectric, FromTheIndexOfRefraction) {
    for (const auto& [ior, f0] : {std::pair{1.0, 0.0f}, {3, 0.25f}, {0, 1}, {1e30, 1}, {0.5, 0}, {-3, 0}})
        expectF0({{"ior", ior}}, kNone, glm::vec3(f0), 1);
}

// The colour scales F0, which is clipped; the factor scales all that is reflected.
TEST(Dielectric, SpecularColourAndFactor) {
    expectF0(kNone, {{"specularFactor", 0.5}}, glm::vec3(0.02f), 0.5f);
    expectF0(kNone, {{"specularFactor", 0}}, glm::vec3(0), 0);
    expectF0({{"ior", 3}}, {{"specularFactor", 0.5}, {"specularColorFactor", {0.4, 0, 100}}},
             {0.05f, 0, 0.5f}, 0.5f);
    expectF0(kNone, {{"specularFactor", 7}, {"specularColorFactor", {-1, 1e30, 1}}}, {0, 1, 0.04f}, 1);
}

TEST(EmissiveStrength, MultipliesAndIsBounded) {
    const auto glow = [](double strength) {
        return materialWith({{"KHR_materials_emissive_strength", {{"emissiveStrength", strength}}}})
            .emissiveLin;
    };
    EXPECT_EQ(glow(4), glm::vec3(2, 1, 4));
    EXPECT_EQ(glow(-1), glm::vec3(0));
    EXPECT_EQ(glow(1e30), glm::vec3(5000, 2500, 10000));
    EXPECT_EQ(materialWith(kNone).emissiveLin, glm::vec3(0.5f, 0.25f, 1));
}

// Members that describe how the surface takes light serve readers without the extension.
TEST(Unlit, BaseColourAndAlphaStay) {
    const Json material = {
        {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 1, 0.75}}, {"roughnessFactor", 0.2}}},
        {"emissiveFactor", {1, 1, 1}},
        {"alphaMode", "MASK"},
        {"alphaCutoff", 0.7},
        {"doubleSided", true},
        {"extensions", {{"KHR_materials_unlit", kNone}}}};
    const Material unlit = loaded(triangleOf(material)).materials[0];
    EXPECT_TRUE(unlit.unlit);
    EXPECT_EQ(unlit.baseColourLin, glm::vec4(0.5f, 0.25f, 1, 0.75f));
    EXPECT_EQ(unlit.alphaMode, AlphaMode::Mask);
    EXPECT_EQ(unlit.alphaCutoff, 0.7f);
    EXPECT_TRUE(unlit.doubleSided);
    EXPECT_EQ(unlit.emissiveLin, glm::vec3(0));
    EXPECT_EQ(unlit.roughness, 1);
    EXPECT_FALSE(materialWith(kNone).unlit);
}

// A texture for the base colour, and one for light of its own from the second set of coordinates.
Model textured(const Json& baseColour, const Json& emissive = kNone) {
    const auto transformed = [](const Json& by, int texCoord) -> Json {
        return {{"index", 0}, {"texCoord", texCoord}, {"extensions", {{"KHR_texture_transform", by}}}};
    };
    return loaded(triangleOf({{"pbrMetallicRoughness", {{"baseColorTexture", transformed(baseColour, 0)}}},
                              {"emissiveTexture", transformed(emissive, 1)}}));
}

// Checks the coordinates at each corner where this use of a texture is looked up.
void expectUvs(const Model& model, const TextureUse& use, const std::vector<glm::vec2>& want) {
    const std::vector<glm::vec2>& got = model.meshes[0].primitives[0].texCoords[use.texCoord];
    ASSERT_EQ(got.size(), want.size());
    for (size_t i = 0; i < got.size(); ++i) EXPECT_LT(glm::distance(got[i], want[i]), 1e-6f) << i;
}

TEST(TextureTransform, ScalesThenTurnsThenMoves) {
    // A quarter turn against the clock as pictures are seen, v down: from the right upwards.
    const double quarter = std::numbers::pi / 2;
    for (const auto& [transform, uvs] : std::vector<std::pair<Json, std::vector<glm::vec2>>>{
             {kNone, {{1, 0}, {0, 1}, {0.5f, 0.25f}}},
             {{{"offset", {0.5, -1}}}, {{1.5f, -1}, {0.5f, 0}, {1, -0.75f}}},
             {{{"scale", {2, 4}}}, {{2, 0}, {0, 4}, {1, 1}}},
             {{{"rotation", quarter}}, {{0, -1}, {1, 0}, {0.25f, -0.5f}}},
             {{{"rotation", quarter}, {"scale", {2, 4}}, {"offset", {10, 20}}},
              {{10, 18}, {14, 20}, {11, 19}}}}) {
        const Model model = textured(transform);
        expectUvs(model, model.materials[0].baseColour, uvs);
    }
    const Model large = textured({{"scale", {1e30, -1e30}}, {"offset", {1e30, 0}}});
    for (const glm::vec2& uv : large.meshes[0].primitives[0].texCoords[0])
        EXPECT_TRUE(std::isfinite(uv.x) && std::isfinite(uv.y));
}

TEST(TextureTransform, EachUseHasItsOwn) {
    const Model model = textured({{"scale", {2, 2}}}, {{"scale", {3, 3}}});
    expectUvs(model, model.materials[0].baseColour, {{2, 0}, {0, 2}, {1, 0.5f}});
    expectUvs(model, model.materials[0].emissive, {{6, 6}, {9, 9}, {12, 12}});
    // Both from one set of the file's.
    const Model shared = textured({{"scale", {2, 2}}}, {{"texCoord", 0}, {"scale", {3, 3}}});
    expectUvs(shared, shared.materials[0].baseColour, {{2, 0}, {0, 2}, {1, 0.5f}});
    expectUvs(shared, shared.materials[0].emissive, {{3, 0}, {0, 3}, {1.5f, 0.75f}});
    EXPECT_EQ(textured({{"texCoord", 7}}).materials[0].baseColour.texture, -1);
}

TEST(MaterialExtensions, OfTheWrongTypesAreRefused) {
    for (const auto& [extension, value, reason] : std::vector<std::tuple<const char*, Json, std::string>>{
             {"KHR_materials_unlit", "yes", " is not an object"},
             {"KHR_materials_ior", {{"ior", "1.3"}}, ".ior is not a number"},
             {"KHR_materials_ior", {{"ior", 1e300}}, ".ior is not finite"},
             {"KHR_materials_specular", {{"specularColorFactor", {1, 2}}}, " has 2 numbers instead of 3"},
             {"KHR_materials_specular",
              {{"specularTexture", {{"index", 2}}}},
              ".index is 2, but there are 2"},
             {"KHR_materials_clearcoat", {{"clearcoatTexture", {{"index", -1}}}}, ".index is negative"},
             {"KHR_materials_clearcoat", {{"clearcoatTexture", kNone}}, ".index is missing"}})
        EXPECT_THAT(refusal(triangleOf({{"extensions", {{extension, value}}}}).load()),
                    testing::AllOf(HasSubstr("materials[0].extensions." + std::string(extension)),
                                   HasSubstr(reason)));
}

// Two primitives, of which the second looks the same in every variant.
Gltf dressed() {
    Gltf file;
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
    Model model = loaded(dressed());
    EXPECT_EQ(model.variants, (std::vector<std::string>{"plain", "gloved"}));
    ASSERT_TRUE(applyVariant(model, "gloved"));
    EXPECT_EQ(model.meshes[0].primitives[0].material, 2);
    EXPECT_EQ(model.meshes[0].primitives[1].material, 1);
    for (Material& material : model.materials) material.baseColour.texture = 0;
    ASSERT_TRUE(applyVariant(model, "plain"));
    EXPECT_FALSE(applyVariant(model, "armoured"));
    EXPECT_EQ(model.meshes[0].primitives[0].material, 0);
    EXPECT_EQ(model.materials[0].baseColour.texture, 0);
    EXPECT_EQ(model.materials[1].baseColour.texture, 0);
    EXPECT_EQ(model.materials[2].baseColour.texture, -1) << "nothing wears it";
}

TEST(Variants, ReferToWhatIsThere) {
    Gltf file = dressed();
    Json& mapping =
        file.root["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"][1];
    mapping["material"] = 3;
    EXPECT_THAT(refusal(file.load()), HasSubstr("material is 3, but there are 3"));
    mapping["material"] = 2;
    mapping["variants"] = {2};
    EXPECT_THAT(refusal(file.load()), HasSubstr("refers to variant 2, but there are 2"));
}

} // namespace
} // namespace shoal::scene
