// KHR_texture_transform: textures scaled, turned and moved over a surface.
#include "Fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace shoal::scene {
namespace {

// A triangle with both sets of texture coordinates, and a texture for base colour and light of its own.
Gltf textured(const Json& baseColour, const Json& emissive = Json()) {
    Gltf file;
    file.root["extensionsUsed"] = {"KHR_texture_transform"};
    file.root["images"] = {{{"uri", kWhitePixel}}};
    file.root["textures"] = {{{"source", 0}}};
    Json material;
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    if (!baseColour.is_null())
        material["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] =
            baseColour;
    material["emissiveTexture"] = {{"index", 0}, {"texCoord", 1}};
    if (!emissive.is_null()) material["emissiveTexture"]["extensions"]["KHR_texture_transform"] = emissive;
    file.root["materials"] = {material};
    addTexturedTriangle(file);
    return file;
}

Model load(const Gltf& file) {
    auto model = file.load();
    if (!model) throw std::runtime_error(model.error().message());
    return std::move(*model);
}

// Returns the coordinates of the base colour's texture at each corner.
std::vector<glm::vec2> lookedUp(const Model& model) {
    return model.meshes[0].primitives[0].texCoords[model.materials[0].baseColour.texCoord];
}

void expectNear(const std::vector<glm::vec2>& got, const std::vector<glm::vec2>& want) {
    ASSERT_EQ(got.size(), want.size());
    for (size_t i = 0; i < got.size(); ++i) {
        EXPECT_NEAR(got[i].x, want[i].x, 1e-6f) << i;
        EXPECT_NEAR(got[i].y, want[i].y, 1e-6f) << i;
    }
}

TEST(TextureTransform, ScalesThenTurnsThenMoves) {
    expectNear(lookedUp(load(textured(Json()))), {{1, 0}, {0, 1}, {0.5f, 0.25f}});
    expectNear(lookedUp(load(textured({{"offset", {0.5, -1}}}))), {{1.5f, -1}, {0.5f, 0}, {1, -0.75f}});
    expectNear(lookedUp(load(textured({{"scale", {2, 4}}}))), {{2, 0}, {0, 4}, {1, 1}});
    // A quarter turn against the clock as pictures are seen, v down: from the right upwards.
    const double quarter = std::numbers::pi / 2;
    expectNear(lookedUp(load(textured({{"rotation", quarter}}))), {{0, -1}, {1, 0}, {0.25f, -0.5f}});
    expectNear(lookedUp(load(textured({{"rotation", quarter}, {"scale", {2, 4}}, {"offset", {10, 20}}}))),
               {{10, 18}, {14, 20}, {11, 19}});
}

TEST(TextureTransform, EachUseHasItsOwn) {
    const Model model = load(textured({{"scale", {2, 2}}}, {{"scale", {3, 3}}}));
    const Primitive& primitive = model.meshes[0].primitives[0];
    expectNear(primitive.texCoords[model.materials[0].baseColour.texCoord], {{2, 0}, {0, 2}, {1, 0.5f}});
    expectNear(primitive.texCoords[model.materials[0].emissive.texCoord], {{6, 6}, {9, 9}, {12, 12}});
    // Both from one set of the file's.
    const Model shared = load(textured({{"scale", {2, 2}}}, {{"texCoord", 0}, {"scale", {3, 3}}}));
    expectNear(lookedUp(shared), {{2, 0}, {0, 2}, {1, 0.5f}});
    expectNear(shared.meshes[0].primitives[0].texCoords[shared.materials[0].emissive.texCoord],
               {{3, 0}, {0, 3}, {1.5f, 0.75f}});
}

TEST(TextureTransform, NonsenseIsNone) {
    for (const Json& nonsense : {Json({{"offset", {1}}}), Json({{"scale", "big"}}),
                                 Json({{"rotation", {1, 2}}}), Json(3), Json({{"texCoord", "first"}})})
        expectNear(lookedUp(load(textured(nonsense))), {{1, 0}, {0, 1}, {0.5f, 0.25f}});
    for (const glm::vec2& uv : lookedUp(load(textured({{"scale", {1e300, -1e300}}, {"offset", {1e300, 0}}}))))
        EXPECT_TRUE(std::isfinite(uv.x) && std::isfinite(uv.y));
    EXPECT_EQ(load(textured({{"texCoord", 7}})).materials[0].baseColour.texture, -1);
}

} // namespace
} // namespace shoal::scene
