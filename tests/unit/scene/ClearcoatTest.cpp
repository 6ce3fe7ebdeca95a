// KHR_materials_clearcoat: a layer that reflects over all that lies below.
#include "Fixture.h"
#include "engine/scene/Surface.h"

#include <gtest/gtest.h>

namespace shoal::scene {
namespace {

Model coated(const Json& clearcoat) {
    Gltf file;
    file.root["extensionsRequired"] = {"KHR_materials_clearcoat"};
    file.root["materials"] = {{{"pbrMetallicRoughness", {{"roughnessFactor", 0.5}}}}};
    if (!clearcoat.is_null()) file.root["materials"][0]["extensions"]["KHR_materials_clearcoat"] = clearcoat;
    file.addTriangles(file.addFloats(kTriangle, "VEC3"))["material"] = 0;
    auto model = file.load();
    if (!model) throw std::runtime_error(model.error().message());
    return std::move(*model);
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
    EXPECT_EQ(minGloss(coated({{"clearcoatFactor", 1}, {"clearcoatRoughnessFactor", 0.1}})).minRoughness,
              0.1f);
    EXPECT_EQ(minGloss(coated({{"clearcoatFactor", 1}, {"clearcoatRoughnessFactor", 0.9}})).minRoughness,
              0.5f);
    EXPECT_EQ(minGloss(coated({{"clearcoatFactor", 0}, {"clearcoatRoughnessFactor", 0.1}})).minRoughness,
              0.5f);
}

} // namespace
} // namespace shoal::scene
