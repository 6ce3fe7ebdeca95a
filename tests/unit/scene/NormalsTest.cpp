// Normals of surfaces that nodes and joints scale unevenly: at right angles to what they become.
#include "ScaledSpheres.h"
#include "engine/math/LatLong.h"
#include "engine/scene/Surface.h"
#include "engine/scene/Vertices.h"
#include "tests/unit/scene/Fixture.h"

namespace shoal::scene {
namespace {

class Normals : public testing::TestWithParam<ScaledSphere> {};
INSTANTIATE_TEST_SUITE_P(Of, Normals, testing::ValuesIn(kScaledSpheres), tests::byName);

TEST_P(Normals, StandOnTheEllipsoid) {
    Primitive primitive;
    for (int y = 0; y <= 8; ++y)
        for (int x = 0; x < 16; ++x)
            primitive.positions.push_back(
                directionFromLatLong(glm::vec2(static_cast<float>(x) / 16, static_cast<float>(y) / 8)));
    primitive.normals = primitive.positions;
    Model model;
    model.meshes.push_back({{primitive}, {}});
    model.nodes.push_back({.mesh = 0});
    model.order = {0};
    GetParam().transform(model);
    const Surface surface = posedSurface(model, restOf(model));
    ASSERT_EQ(surface.positions.size(), primitive.positions.size());
    for (size_t i = 0; i < surface.positions.size(); ++i) {
        const glm::vec3 expected = ellipsoidNormal(GetParam().modelFromSphere, surface.positions[i]);
        for (int c = 0; c < 3; ++c) // some ten float operations on numbers near 1
            EXPECT_NEAR(surface.normals[i][c], expected[c], 1e-5f) << i;
    }
}

constexpr float kTangentTol = 1e-6f; // a few float operations on numbers near 1

void expectNear(const glm::vec4& actual, const glm::vec4& expected) {
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(actual[i], expected[i], kTangentTol) << "component " << i;
}

// glTF 2.0 specification 3.9.3: the normal map's red is +X along the tangent, green is +Y, up in the image,
// along cross(normal, tangent) * w. The texture is mirrored at x = 0, as on a symmetric fish: the vertices on
// the line are split.
TEST(Tangents, PointAlongUAndAreSplitWhereTheHandednessChanges) {
    Primitive p;
    p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
    p.normals.assign(4, {0, 0, 1});
    p.texCoords[0] = {{0, 1}, {1, 1}, {0, 0}, {1, 1}};
    p.indices = {0, 1, 2, 0, 2, 3};
    const TangentSplit split = makeTangents(p, 0);
    EXPECT_EQ(split.source.size(), 6u);
    for (size_t corner = 0; corner < 6; ++corner) {
        EXPECT_EQ(split.source[split.indices[corner]], p.indices[corner]);
        expectNear(split.tangents[split.indices[corner]],
                   corner < 3 ? glm::vec4(1, 0, 0, 1) : glm::vec4(-1, 0, 0, -1));
    }
}

// Corner 0 is shared by a triangle with an angle of 60 degrees there, u along +X, and one with 30 degrees, u
// along a direction 20 degrees from it; both lie in one plane. The tangent is their mean weighted by these
// angles.
TEST(Tangents, AreAveragedByTheCornersAngles) {
    const auto direction = [](double degrees) {
        return glm::dvec2(std::cos(glm::radians(degrees)), std::sin(glm::radians(degrees)));
    };
    const glm::dvec2 b = direction(60), c = direction(90), uvB(b.x, -b.y), alongU = direction(20);
    // In the second triangle, p = u alongU + v alongV, where b must keep its texture coordinate.
    const glm::dvec2 alongV = (b - uvB.x * alongU) / uvB.y;
    const glm::dvec2 uvC = glm::inverse(glm::dmat2(alongU, alongV)) * c;
    Primitive p;
    for (const glm::dvec2 corner : {glm::dvec2(0), direction(0), b, c}) p.positions.emplace_back(corner, 0);
    p.normals.assign(4, {0, 0, 1});
    p.texCoords[0] = {{0, 0}, {1, 0}, uvB, uvC};
    p.indices = {0, 1, 2, 0, 2, 3};
    const TangentSplit split = makeTangents(p, 0);
    ASSERT_EQ(split.source.size(), 4u);
    const auto mean = [&](double first, double second) {
        return glm::vec4(
            glm::vec3(glm::normalize(first * glm::dvec3(1, 0, 0) + second * glm::dvec3(alongU, 0))), 1);
    };
    expectNear(split.tangents[split.indices[0]], mean(60, 30));
    expectNear(split.tangents[split.indices[2]], mean(60, 75));
    expectNear(split.tangents[split.indices[1]], mean(1, 0));
    expectNear(split.tangents[split.indices[5]], mean(0, 1));
}

// Around a cylinder of eight smooth sides u runs with the angle: by symmetry every tangent does, also where
// the texture's seam doubles the vertices.
TEST(Tangents, RunAroundACylinder) {
    Primitive p;
    constexpr int kSides = 8;
    for (int i = 0; i <= kSides; ++i) {
        const double angle = glm::radians(45.0 * (i % kSides));
        const glm::vec3 outwards(std::sin(angle), 0, std::cos(angle));
        for (const float y : {0.0f, 1.0f}) {
            p.positions.push_back(outwards + glm::vec3(0, y, 0));
            p.normals.push_back(outwards);
            p.texCoords[0].emplace_back(static_cast<float>(i) / 8, 1 - y);
        }
    }
    for (uint32_t i = 0; i < 2 * kSides; i += 2)
        p.indices.insert(p.indices.end(), {i, i + 2, i + 1, i + 1, i + 2, i + 3});
    const TangentSplit split = makeTangents(p, 0);
    ASSERT_EQ(split.source.size(), p.positions.size());
    for (size_t v = 0; v < split.source.size(); ++v) {
        const glm::vec3& n = p.normals[split.source[v]];
        expectNear(split.tangents[v], {n.z, 0, -n.x, 1});
    }
}

TEST(Tangents, AreFiniteAndPerpendicularWhereThereIsNoDirection) {
    Primitive p;
    p.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    p.normals.assign(4, {0, 0, 1});
    p.texCoords[0].assign(4, {0.5f, 0.5f});
    p.indices = {0, 1, 2, 0, 2, 3, 0, 0, 1};
    for (const glm::vec4& t : makeTangents(p, 0).tangents) {
        EXPECT_NEAR(glm::length(glm::vec3(t)), 1, kTangentTol);
        EXPECT_EQ(glm::dot(glm::vec3(t), glm::vec3(0, 0, 1)), 0);
        EXPECT_EQ(std::abs(t.w), 1);
    }
}

TEST(Tangents, OfAFileAreKeptAtUnitLength) {
    Gltf file;
    file.root["images"] = {{{"uri", kWhite}}};
    file.root["textures"] = {{{"source", 0}}};
    file.root["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    Json& primitive = file.addTriangles(file.addFloats(kTriangle, "VEC3"));
    primitive["material"] = 0;
    primitive["attributes"]["NORMAL"] = file.addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    primitive["attributes"]["TEXCOORD_0"] = file.addFloats({0, 0, 1, 0, 0, 1}, "VEC2");
    primitive["attributes"]["TANGENT"] = file.addFloats({0, 2, 0, -1, 1, 0, 0, 1, -1, 0, 0, 1}, "VEC4");
    EXPECT_EQ(file.model().meshes[0].primitives[0].tangents,
              (std::vector<glm::vec4>{{0, 1, 0, -1}, {1, 0, 0, 1}, {-1, 0, 0, 1}}));
}

// The file has no tangents. Wherever the texture has area, they point along growing u.
TEST(Tangents, FollowTheTextureOfNormalTangentTest) {
    const Path file = sharedData() / "fidelity/khronos-NormalTangentTest/NormalTangentTest.gltf";
    if (!exists(file)) GTEST_SKIP() << "no " << file;
    const auto model = tests::valueOf(loadModel(file));
    const Primitive& p = model.meshes.at(0).primitives.at(0);
    ASSERT_EQ(p.tangents.size(), p.positions.size());
    size_t right = 0, corners = 0;
    for (size_t i = 0; i < p.indices.size(); i += 3) {
        const uint32_t a = p.indices[i], b = p.indices[i + 1], c = p.indices[i + 2];
        const glm::vec2 e1 = p.texCoords[0][b] - p.texCoords[0][a],
                        e2 = p.texCoords[0][c] - p.texCoords[0][a];
        const float area = e1.x * e2.y - e1.y * e2.x;
        if (std::abs(area) < 1e-9f) continue;
        const glm::vec3 d1 = p.positions[b] - p.positions[a], d2 = p.positions[c] - p.positions[a];
        const glm::vec3 alongU = (e2.y * d1 - e1.y * d2) / area, down = (e1.x * d2 - e2.x * d1) / area;
        for (const uint32_t v : {a, b, c}) {
            const glm::vec3 t(p.tangents[v]);
            const glm::vec3 up = glm::cross(p.normals[v], t) * p.tangents[v].w;
            ++corners;
            right += glm::dot(t, alongU) > 0 && glm::dot(up, down) < 0;
        }
    }
    EXPECT_GT(corners, 0u);
    EXPECT_EQ(right, corners);
}

} // namespace
} // namespace shoal::scene
