// Baseline methods against known answers: spheres over planes, even environments, nothing in the way.
#include "tests/Test.h"
#include "tests/baselines/occlusion/Baked.h"
#include "tests/baselines/occlusion/DepthMaps.h"
#include "tests/unit/light/Environments.h"
#include "tests/unit/occlusion/Bodies.h"

namespace shoal::occlusion::baselines {
namespace {

using glm::vec3;

constexpr vec3 kUp{0, 1, 0};

bool meetsSphere(const vec3& origin, const vec3& direction, const vec3& centre, float radius) {
    const vec3 to = centre - origin;
    const float along = glm::dot(to, direction);
    return along > 0 && glm::dot(to, to) - along * along < radius * radius;
}

constexpr auto kOpen = [](const vec3&, const vec3&) { return false; };

// A patch of floor, three vertices, at the origin.
const std::vector<vec3> kFloor{{0, 0, 0}, {0, 0, 1e-3f}, {1e-3f, 0, 0}};
const std::vector<vec3> kFloorUp(3, kUp);
const std::vector<glm::uvec3> kFloorTriangle{{0, 1, 2}};
const BodyMesh kFloorMesh{kFloor, kFloorUp, kFloorTriangle};

const ImageRgbF kWhite = light::uniform(64, glm::dvec3(1));

TEST(AmbientOcclusion, UnderASphereLacksItsFormFactor) {
    const vec3 centre(0.7f, 1.6f, 0);
    const auto baked = bakeAmbientOcclusion(
        kFloorMesh, [&](const vec3& o, const vec3& d) { return meetsSphere(o, d, centre, 1); }, 4096, 0);
    // All of it stands above the horizon: the cosine times (radius / distance)^2.
    EXPECT_NEAR(baked[0], 1 - centre.y / std::pow(glm::length(centre), 3.0f), 0.003f);
}

// Half of the floor lies under a slab: its buried corners must not darken what can be seen of its triangles.
TEST(AmbientOcclusion, BuriedPartsDoNotCount) {
    const auto baked = bakeAmbientOcclusion(
        kFloorMesh, [](const vec3& o, const vec3&) { return o.x < 0.5e-3f; }, 64, 0);
    for (const float free : baked) EXPECT_EQ(free, 1);
}

// White furnace: radiance 1 from everywhere. Bands 1 to 4 of it vanish, so nothing is cut off.
TEST(Transfer, WhiteEnvironmentGivesWhatIsFree) {
    const math::ShRgb environment = math::shProject(kWhite);
    EXPECT_NEAR(bakeTransfer(kFloorMesh, kOpen, 4, 256, 0).radiance(0, environment).x, 1, 1e-3f);
    const vec3 centre(0, 2, 0);
    const auto shadowed = bakeTransfer(
        kFloorMesh, [&](const vec3& o, const vec3& d) { return meetsSphere(o, d, centre, 1); }, 4, 4096, 0);
    EXPECT_NEAR(shadowed.radiance(0, environment).x, 0.75f, 0.003f);
}

// The transfer in the open is the clamped cosine's: Ramamoorthi and Hanrahan 2001, eq. 8.
TEST(Transfer, OpenIsTheCosineLobe) {
    const Transfer open = bakeTransfer(kFloorMesh, kOpen, 3, 4096, 0);
    const math::ShBasis basis = math::shBasis(glm::dvec3(kUp));
    for (int l = 0; l < 3; ++l)
        for (int m = -l; m <= l; ++m) {
            const auto k = static_cast<size_t>(l * (l + 1) + m);
            EXPECT_NEAR(open.terms[k],
                        math::kShCosine[static_cast<size_t>(l)] * std::numbers::inv_pi * basis[k], 2e-3);
        }
}

TEST(DirectedLight, SharesOutAllOfTheLight) {
    const DirectedLight light = directedLight(kWhite, evenDirections(32));
    vec3 sum(0);
    for (const vec3& power : light.power) sum += power;
    EXPECT_NEAR(sum.x, 4 * std::numbers::pi_v<float>, 1e-4f);
    EXPECT_EQ(shareSeen(light, kUp, [](size_t) { return true; }), vec3(1));
    EXPECT_EQ(shareSeen(light, kUp, [](size_t) { return false; }), vec3(0));
}

// Rays from the top of a small sphere up to a large one: a pixel is 0.03, and the outline may be off by two.
const vec3 kTop{0.3f, -2.2f, 0.1f};
const Body kLarge = sphere(1, 48, 24), kSmall = [] {
    Body small = sphere(0.3f, 48, 24);
    for (vec3& position : small.positions) position += kTop - vec3(0, 0.3f, 0);
    return small;
}();
const std::vector<BodyMesh> kBoth{kLarge.mesh(), kSmall.mesh()};

template <class Blocked> void seesASphere(const Blocked& blocked) {
    const auto directions = spiralDirections(512);
    int wrong = 0, near = 0;
    for (size_t k = 0; k < directions.size(); ++k) {
        if (directions[k].y < 0.4f) continue;
        const bool inner = meetsSphere(kTop, directions[k], vec3(0), 0.92f);
        const bool outer = meetsSphere(kTop, directions[k], vec3(0), 1.08f);
        near += inner != outer;
        if (inner == outer) wrong += blocked(kTop, directions[k], k) != inner;
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_LT(near, 60);
}

TEST(LayeredDepth, MeetsASphereAndNothingBesideIt) {
    const LayeredDepth images(kBoth, 128);
    seesASphere([&](const vec3& from, const vec3& d, size_t) { return images.occluded(from, d, 0.1f); });
    EXPECT_GT(images.bytes(), 0u);
}

TEST(CoherentShadowMaps, MeetASphereAndAreSmallerThanThePlainMaps) {
    const auto directions = spiralDirections(512);
    const CoherentShadowMaps maps(kBoth, directions, 128);
    seesASphere([&](const vec3& from, const vec3&, size_t k) { return maps.occluded(from, k); });
    EXPECT_LT(maps.bytes(), maps.plainBytes() / 4);
}

} // namespace
} // namespace shoal::occlusion::baselines
