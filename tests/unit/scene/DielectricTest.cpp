// KHR_materials_ior and KHR_materials_specular: how much of the light a dielectric reflects at its surface.
#include "Fixture.h"

#include <gtest/gtest.h>

namespace shoal::scene {
namespace {

Material materialWith(const Json& ior, const Json& specular = Json()) {
    Gltf file;
    file.root["extensionsRequired"] = {"KHR_materials_ior", "KHR_materials_specular"};
    file.root["materials"] = {{{"name", "glass"}}};
    Json& extensions = file.root["materials"][0]["extensions"];
    if (!ior.is_null()) extensions["KHR_materials_ior"] = ior;
    if (!specular.is_null()) extensions["KHR_materials_specular"] = specular;
    file.addTriangles(file.addFloats(kTriangle, "VEC3"))["material"] = 0;
    const auto model = file.load();
    if (!model) throw std::runtime_error(model.error().message());
    return model->materials[0];
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

} // namespace
} // namespace shoal::scene
