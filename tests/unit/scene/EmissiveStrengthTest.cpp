// KHR_materials_emissive_strength: surfaces that glow brighter than white.
#include "Fixture.h"

#include <gmock/gmock.h>

namespace shoal::scene {
namespace {

Gltf glowing(const Json& strength) {
    Gltf file;
    file.root["extensionsUsed"] = {"KHR_materials_emissive_strength"};
    file.root["materials"] = {{{"emissiveFactor", {0.5, 0.25, 1}}}, {{"emissiveFactor", {1, 1, 1}}}};
    file.root["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
    file.addTriangles(file.addFloats(kTriangle, "VEC3"))["material"] = 0;
    return file;
}

glm::vec3 glowOf(const Json& strength, size_t material = 0) {
    const auto model = glowing(strength).load();
    if (!model) throw std::runtime_error(model.error().message());
    return model->materials[material].emissiveLin;
}

TEST(EmissiveStrength, Multiplies) {
    EXPECT_EQ(glowOf(4), glm::vec3(2, 1, 4));
    EXPECT_EQ(glowOf(0), glm::vec3(0));
    EXPECT_EQ(glowOf(4, 1), glm::vec3(1)) << "of its own material alone";
}

TEST(EmissiveStrength, IsBounded) {
    EXPECT_EQ(glowOf(1e300), glm::vec3(5000, 2500, 10000));
    EXPECT_EQ(glowOf(-1), glm::vec3(0));
    EXPECT_EQ(glowOf("bright"), glm::vec3(0.5f, 0.25f, 1));
    EXPECT_EQ(glowOf(Json()), glm::vec3(0.5f, 0.25f, 1));
}

} // namespace
} // namespace shoal::scene
