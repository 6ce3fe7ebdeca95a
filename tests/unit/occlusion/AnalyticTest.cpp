// Hits that are known in closed form.
#include "Bodies.h"
#include "engine/occlusion/Directions.h"
#include "tests/Test.h"
#include "tests/baselines/occlusion/OllfbThesis.h"
#include "tests/baselines/occlusion/TracedOllfb.h"

namespace shoal::occlusion {
namespace {

// Distance along the ray to a sphere around the origin, or to where it leaves it.
std::optional<double> sphereHit(const Ray& ray, double radius) {
    const glm::dvec3 o(ray.origin), d(ray.direction);
    const double b = glm::dot(o, d), c = glm::dot(o, o) - radius * radius;
    if (b * b < c) return {};
    return -b - std::sqrt(b * b - c);
}

// Rays that meet the surface steeper than this: 0.4 of the normal, 66 degrees.
constexpr float kSteepEnough = 0.4f;

TEST(Analytic, SphereIsHitWhereItIs) {
    constexpr int kColumns = 192, kRows = 96;
    const Body body = sphere(1, kColumns, kRows);
    const TracedOllfb cured = TracedOllfb::make(body.mesh(), {.views = 54}).value();
    const OllfbThesis thesis = OllfbThesis::make(body.mesh(), {.cells = 3}).value();
    Random random(1);
    // Facets lie inside by 1 - cos of half their angle across, 2 (pi / 192)^2 / 2 at most, over the cosine.
    const double facet = std::pow(M_PI / kColumns, 2) / static_cast<double>(kSteepEnough);
    const double pixel = 2.0 / 63;
    int near = 0, all = 0;
    for (int i = 0; i < 3000; ++i) {
        const Ray ray = chord(random, {{0, 0, 0}, 1});
        const auto expected = sphereHit(ray, 1);
        if (!expected) continue;
        const glm::vec3 normal = ray.origin + static_cast<float>(*expected) * ray.direction;
        if (glm::dot(normal, ray.direction) > -kSteepEnough) continue;
        const auto hit = tests::valueOf(cured.trace(ray.origin, ray.direction, 0));
        // Blended, what is left is of third order in a pixel over the radius, and the normals' 2 x 8 bits:
        // 0.0083 rad over half a pixel. A fifth of a pixel holds both with a steep slope's factor of 1 / 0.4.
        EXPECT_NEAR(static_cast<double>(hit.distance), *expected, facet + pixel / 5) << i;
        // 0.0167 rad of rounding; between two cells the layer's own normal, half a pixel away and steep.
        EXPECT_GT(glm::dot(hit.normal, normal), std::cos(0.06f)) << i;
        // The thesis' step may be a pixel's diagonal aside, where the slope towards the view is up to 3; or
        // it has a gap there and the ray goes on to the far side.
        const auto step = thesis.trace(ray.origin, ray.direction, 0);
        ++all;
        near += step && std::abs(static_cast<double>(step->distance) - *expected) < facet + 3 * 1.5 * pixel;
    }
    EXPECT_GT(near, all * 9 / 10);
    EXPECT_LT(near, all); // else it would need no cure
}

TEST(Analytic, NearestDirectionsAreNearest) {
    Random random(3);
    for (const int n : {3, 5, 9}) {
        const auto directions = cubeDirections(n);
        ASSERT_EQ(std::ssize(directions), 6 * n * n);
        for (int i = 0; i < 1000; ++i) {
            const glm::vec3 d = anyDirection(random);
            // Cells are up to 90 / n degrees wide, half the diagonal from the middle.
            EXPECT_GT(glm::dot(directions[static_cast<size_t>(nearestCubeDirection(d, n))], d),
                      std::cos(kPi / 4 / static_cast<float>(n) * 1.5f));
        }
        for (int k = 0; k < 6 * n * n; ++k)
            EXPECT_EQ(nearestCubeDirection(directions[static_cast<size_t>(k)], n), k);
    }
    const Axes axes(150);
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 d = anyDirection(random);
        float best = 0;
        for (const glm::vec3& axis : axes.axes) best = std::max(best, std::abs(glm::dot(axis, d)));
        const float chosen = std::abs(glm::dot(axes.axes[static_cast<size_t>(nearestAxis(axes, d))], d));
        EXPECT_LT(std::acos(chosen), std::acos(best) + 0.1f); // there and back half a cell's diagonal
    }
}

TEST(Analytic, NormalsKeepTheirPromisedPrecision) {
    Random random(4);
    for (int i = 0; i < 20000; ++i) {
        const glm::vec3 d = anyDirection(random);
        EXPECT_LT(glm::distance(unpackDirection(packDirection(d, 8), 8), d), 0.0168f);
        EXPECT_LT(glm::distance(unpackDirection(packDirection(d, 16), 16), d), 6.6e-5f);
    }
}

// Exactly one layer towards and one away at each sample of something convex, shared edges or not.
TEST(Analytic, LayersOfAConvexBodyPairUp) {
    const Body body = sphere(1, 24, 12);
    const OllfbThesis thesis = OllfbThesis::make(body.mesh(), {.cells = 3, .resolution = 64}).value();
    for (size_t i = 0; i + 1 < thesis.starts.size(); ++i) {
        const uint32_t count = thesis.starts[i + 1] - thesis.starts[i];
        EXPECT_TRUE(count == 0 || count == 2) << i << ": " << count;
    }
}

} // namespace
} // namespace shoal::occlusion
