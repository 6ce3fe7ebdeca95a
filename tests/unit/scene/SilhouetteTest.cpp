// Widths of bodies whose widths are known.
#include "engine/scene/Silhouette.h"
#include "engine/math/LatLong.h"

#include <gtest/gtest.h>

#include <numbers>

namespace shoal::scene {
namespace {

// An ellipsoid with these half axes about the origin.
Model ellipsoid(const glm::vec3& axes) {
    Model model;
    Primitive primitive;
    constexpr int kAround = 96, kDown = 48;
    for (int y = 0; y <= kDown; ++y)
        for (int x = 0; x <= kAround; ++x)
            primitive.positions.push_back(axes *
                                          directionFromLatLong(glm::vec2(static_cast<float>(x) / kAround,
                                                                         static_cast<float>(y) / kDown)));
    for (int y = 0; y < kDown; ++y)
        for (int x = 0; x < kAround; ++x) {
            const auto a = static_cast<uint32_t>(y * (kAround + 1) + x);
            const uint32_t b = a + kAround + 1;
            primitive.indices.insert(primitive.indices.end(), {a, a + 1, b, a + 1, b + 1, b});
        }
    model.meshes.push_back({"body", {primitive}, {}});
    model.nodes.push_back({.name = "body", .mesh = 0});
    model.order = {0};
    return model;
}

TEST(Silhouette, ShowsAnEllipsoidsWidthsAndHeights) {
    const glm::vec3 axes(0.2f, 0.35f, 1.1f);
    const Model model = ellipsoid(axes);
    Pose pose;
    restPose(model, pose);
    const Silhouette silhouette = silhouetteOf(model, pose);
    EXPECT_NEAR(silhouette.back, -axes.z, 1e-3f);
    EXPECT_NEAR(silhouette.front, axes.z, 1e-3f);
    float area = 0;
    for (size_t i = 0; i < Silhouette::kSlices; ++i) {
        // The mean of sqrt(1 - z^2) over the slice.
        const auto integral = [](double z) { return 0.5 * (z * std::sqrt(1 - z * z) + std::asin(z)); };
        const double from = 2.0 * static_cast<double>(i) / Silhouette::kSlices - 1,
                     to = from + 2.0 / Silhouette::kSlices;
        const double mean = (integral(std::min(to, 1.0)) - integral(from)) / (to - from);
        // Triangles are given to the slice of their middle.
        EXPECT_NEAR(silhouette.half[i].x, 0.2 * mean, 0.02 * 0.2) << i;
        EXPECT_NEAR(silhouette.half[i].y, 0.35 * mean, 0.02 * 0.35) << i;
        area += 2 * silhouette.half[i].x * 2 * axes.z / Silhouette::kSlices;
    }
    EXPECT_NEAR(area, std::numbers::pi_v<float> * 0.2f * 1.1f, 0.003f);
}

TEST(Silhouette, OfNothingIsNothing) {
    Model model;
    Pose pose;
    restPose(model, pose);
    EXPECT_EQ(silhouetteOf(model, pose).half[0], glm::vec2(0));
}

} // namespace
} // namespace shoal::scene
