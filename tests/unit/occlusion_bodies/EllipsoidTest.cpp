// Closed forms of what an ellipsoid hides, against sums over directions in double precision.
#include "engine/occlusion/Ellipsoid.h"

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <numbers>

namespace shoal::occlusion {
namespace {

using Vec = glm::dvec3;
using std::numbers::pi;

bool meets(const Ellipsoid<double>& e, const Vec& p, const Vec& direction) {
    const Vec m = ((p - e.centre) * e.worldFromAxes) / e.semiAxes,
              d = (direction * e.worldFromAxes) / e.semiAxes;
    const double b = glm::dot(m, d), c = glm::dot(m, m) - 1;
    return b < 0 && b * b >= glm::dot(d, d) * c;
}

// Sum over directions on a spiral, each with an equal part of the sphere.
template <class Of> auto overSphere(Of&& of) {
    constexpr int kCount = 400000;
    decltype(of(Vec())) sum{};
    for (int i = 0; i < kCount; ++i) {
        const double z = 1 - (2 * i + 1.0) / kCount, angle = i * pi * (3 - std::sqrt(5.0)),
                     r = std::sqrt(1 - z * z);
        sum += of(Vec(r * std::cos(angle), r * std::sin(angle), z)) * (4 * pi / kCount);
    }
    return sum;
}

Ellipsoid<double> turned(const Vec& centre, const Vec& semiAxes) {
    return {centre, glm::mat3_cast(glm::normalize(glm::dquat(0.6, 0.3, -0.5, 0.2))), semiAxes};
}

struct Shape {
    const char* name;
    Vec semiAxes, point;
};

const Shape kShapes[] = {
    {"ball", {0.5, 0.5, 0.5}, {0.3, -0.4, 1.2}},  {"finger", {0.1, 0.1, 0.6}, {0.5, 0.5, 0.3}},
    {"disc", {0.6, 0.5, 0.05}, {0.1, 0.7, 0.6}},  {"fish", {0.15, 0.4, 0.9}, {1.0, 0.3, 0.5}},
    {"near", {0.15, 0.4, 0.9}, {0.3, 0.25, 0.2}}, {"beside", {0.6, 0.5, 0.05}, {0.7, 0.5, 0.0}},
};

// The vector form factor of the cone of directions that meet it: the sum's own error is about 1e-4.
TEST(Ellipsoid, TakesAsMuchOfAFacingSurfaceAsItsDirections) {
    for (const Shape& shape : kShapes) {
        const Ellipsoid<double> e = turned({0.1, 0.2, -0.1}, shape.semiAxes);
        const Vec summed =
            overSphere([&](const Vec& d) { return meets(e, shape.point, d) ? d : Vec(0); }) / pi;
        const Cap<double> cap = capOf(e, shape.point);
        EXPECT_NEAR(cap.share, glm::length(summed), 1e-3) << shape.name;
        EXPECT_NEAR(glm::dot(cap.towards, glm::normalize(summed)), 1, 1e-5) << shape.name;
        const Cap<float> single =
            capOf(Ellipsoid<float>{glm::vec3(e.centre), glm::mat3(e.worldFromAxes), glm::vec3(e.semiAxes)},
                  glm::vec3(shape.point));
        EXPECT_NEAR(static_cast<double>(single.share), cap.share, 2e-5) << shape.name;
    }
}

TEST(Ellipsoid, IsAHalfSpaceFromItsSkinAndWithin) {
    const Ellipsoid<double> e{{}, glm::dmat3(1), {0.2, 0.3, 0.5}};
    for (const double k : {0.5, 0.999, 1.0, 1.0000001}) {
        const Cap<double> cap = capOf(e, Vec(k * 0.2, 0, 0));
        EXPECT_NEAR(cap.share, 1, 1e-3);
        EXPECT_NEAR(cap.towards.x, -1, 1e-3);
    }
    // Without a jump: it comes near as the root of the distance.
    EXPECT_NEAR(capOf(e, Vec(0.2 * 1.0001, 0, 0)).share, 1, 0.03);
    EXPECT_TRUE(std::isfinite(capOf(e, Vec(0)).share));
}

TEST(Ellipsoid, OfNoSizeOrFarAwayTakesNothing) {
    EXPECT_LT(capOf(Ellipsoid<float>{{}, glm::mat3(1), glm::vec3(1e-4f)}, glm::vec3(0, 0, 1)).share, 1e-6f);
    EXPECT_LT(capOf(Ellipsoid<float>{{}, glm::mat3(1), glm::vec3(0.1f)}, glm::vec3(300, 0, 0)).share, 1e-6f);
}

// The fit of clippedShare() and meanDirection() over all caps and slopes.
TEST(Cap, SunkBelowTheHorizonTakesWhatItsUpperPartTakes) {
    const Vec n(0, 0, 1);
    for (const double sine : {0.1, 0.4, 0.7, 0.95})
        for (double angle = 0; angle < 2.8; angle += 0.2) {
            const Cap<double> cap{{std::sin(angle), 0, std::cos(angle)}, sine * sine};
            const double cosCap = std::sqrt(1 - cap.share);
            const auto within = [&](const Vec& d) { return d.z > 0 && glm::dot(d, cap.towards) >= cosCap; };
            const double share = overSphere([&](const Vec& d) { return within(d) ? d.z : 0.0; }) / pi;
            EXPECT_NEAR(clippedShare(cap.share, cap.towards.z), share, 0.016 * cap.share + 2e-4)
                << sine << ' ' << angle;
            if (share < 1e-3) continue;
            const Vec first =
                overSphere([&](const Vec& d) { return within(d) ? d.z * d : Vec(0); }) / (pi * share);
            const Vec mean = meanDirection(cap, n, cap.towards.z);
            // Sunk caps are wrong about where, the more so the less they take.
            const bool above = cap.towards.z >= sine;
            EXPECT_LT(share * glm::length(mean - first), (above ? 0.01 : 0.2) * cap.share)
                << sine << ' ' << angle;
        }
}

TEST(Coverage, OfALampRunsFromNoneToAllAcrossTheEdge) {
    const Ellipsoid<double> e = turned({}, {0.2, 0.3, 0.5});
    const Vec p(0.3, -0.4, 2);
    const double sine = 0.05;
    const Cap<double> cap = capOf(e, p);
    const Vec side = glm::normalize(glm::cross(cap.towards, Vec(0.2, 1, 0)));
    double before = 1;
    for (double tangent = 0; tangent < 0.6; tangent += 0.002) {
        const Vec lamp = glm::normalize(cap.towards + tangent * side);
        const double hidden = coverage(e, p, lamp, sine, cap.share);
        EXPECT_LE(hidden, before + 1e-9);
        before = hidden;
        const double truth = [&] {
            const Vec x = glm::normalize(glm::cross(lamp, Vec(0, 1, 0))), y = glm::cross(lamp, x);
            int hits = 0, all = 0;
            for (int i = -20; i <= 20; ++i)
                for (int j = -20; j <= 20; ++j)
                    if (i * i + j * j <= 400)
                        ++all, hits +=
                               meets(e, p, glm::normalize(lamp + sine / 20 * (1.0 * i * x + 1.0 * j * y)));
            return static_cast<double>(hits) / all;
        }();
        EXPECT_NEAR(hidden, truth, 0.09) << tangent; // the edge bends
    }
    EXPECT_EQ(coverage(e, p, -cap.towards, sine, cap.share), 0);
}

// A body's skin is now outside, now within its own ellipsoids.
TEST(Coverage, LeavesWhatLooksOutOfItFree) {
    const Ellipsoid<double> e{{}, glm::dmat3(1), {0.2, 0.3, 0.5}};
    for (const double depth : {-0.02, 0.0, 0.02})
        for (const Vec& towards :
             {Vec(1, 0, 0), glm::normalize(Vec(1, 0.6, 0)), glm::normalize(Vec(1, 0, -0.6))})
            EXPECT_EQ(coverage(e, Vec(0.2 - depth, 0, 0), towards, 0.2, 1.0), 0) << depth << ' ' << towards.y;
    EXPECT_EQ(coverage(e, Vec(0.18, 0, 0), glm::normalize(Vec(-1, 0.1, 0)), 0.2, 1.0), 1);
}

} // namespace
} // namespace shoal::occlusion
