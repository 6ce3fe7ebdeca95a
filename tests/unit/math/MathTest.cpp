#include "engine/math/Brdf.h"
#include "engine/math/Colour.h"
#include "engine/math/LatLong.h"
#include "engine/math/Quantile.h"
#include "engine/math/Trigonometry.h"
#include "tests/Test.h"
#include "tests/baselines/HarmonicSums.h"
#include "tests/baselines/light/Ggx.h"
#include "tests/unit/light/Environments.h"

namespace shoal::math {
namespace {

using std::numbers::pi;

TEST(Ggx, MirrorLobeIsDistributionTimesCosine) {
    for (const double angle : {0.0, 0.3, 1.0, 1.5})
        EXPECT_NEAR(ggxMirrorLobe(std::cos(angle), 0.2), ggxD(std::cos(angle / 2), 0.2) * std::cos(angle),
                    1e-12);
    EXPECT_EQ(ggxMirrorLobe(-0.1, 0.5), 0.0);
}

TEST(Phong, RoughnessOneIsTheClampedCosine) { EXPECT_NEAR(phongExponentFromRoughness(1.0), 1.0, 1e-12); }

// The textbook integral: f_r nl over directions of light, on a fine grid; knows nothing of visible normals.
Dfg bruteForce(double nv, double roughness) {
    const double alpha = alphaFromRoughness(roughness);
    const double sinV = std::sqrt(1 - nv * nv);
    constexpr int kTheta = 1500, kPhi = 1500;
    Dfg sum;
    for (int i = 0; i < kTheta; ++i) {
        const double theta = pi / 2 * (i + 0.5) / kTheta;
        const double nl = std::cos(theta), sinL = std::sin(theta);
        for (int j = 0; j < kPhi; ++j) {
            const double phi = pi * (j + 0.5) / kPhi;
            const double vl = sinV * sinL * std::cos(phi) + nv * nl;
            const double vh = std::sqrt((1 + vl) / 2);
            if (vh <= 0) continue;
            const double nh = (nl + nv) / (2 * vh);
            const double part =
                ggxD(nh, alpha) * smithV(nl, nv, alpha) * nl * sinL * 2 * (pi / 2 / kTheta) * (pi / kPhi);
            const double fresnel = std::pow(1 - vh, 5);
            sum.scale += part * (1 - fresnel);
            sum.bias += part * fresnel;
        }
    }
    return sum;
}

// Measured: the worst of these is 0.0014, a third of a step of an 8-bit picture.
TEST(Dfg, AgreesWithTheIntegralOverLight) {
    for (const double roughness : {0.3, 0.5, 0.8, 1.0})
        for (const double nv : {0.1, 0.4, 0.9}) {
            const Dfg fast = dfg(nv, roughness), slow = bruteForce(nv, roughness);
            EXPECT_NEAR(fast.scale, slow.scale, 0.0016) << roughness << " " << nv;
            EXPECT_NEAR(fast.bias, slow.bias, 0.0016) << roughness << " " << nv;
        }
}

// A mirror: no masking, so scale + bias = 1 and bias is Schlick's term itself.
TEST(Dfg, MirrorReflectsAll) {
    for (const double nv : {0.05, 0.3, 1.0}) {
        const Dfg factor = dfg(nv, 0.0);
        EXPECT_NEAR(factor.scale + factor.bias, 1.0, 1e-4);
        EXPECT_NEAR(factor.bias, std::pow(1 - nv, 5), 1e-3);
    }
}

TEST(Dfg, TableHoldsTexelCentres) {
    const std::vector<float> table = makeDfgTable(16);
    ASSERT_EQ(table.size(), 16u * 16u * 2u);
    const Dfg factor = dfg(3.5 / 16, 10.5 / 16);
    EXPECT_FLOAT_EQ(table[(10 * 16 + 3) * 2], static_cast<float>(factor.scale));
    EXPECT_FLOAT_EQ(table[(10 * 16 + 3) * 2 + 1], static_cast<float>(factor.bias));
    for (const float value : table) {
        EXPECT_GE(value, 0.0f);
        EXPECT_LE(value, 1.0f);
    }
}

TEST(Colour, SrgbGoesThereAndBack) {
    for (int code = 0; code <= 255; ++code) {
        const double coded = code / 255.0;
        EXPECT_NEAR(srgbFromLinear(linearFromSrgb(coded)), coded, 1e-9); // the constants meet to 3e-8
    }
    EXPECT_NEAR(linearFromSrgb(0.5), 0.21404114, 1e-8);
}

TEST(Quantile, IsAValueThatTheShareOfAllAreLessThan) {
    std::vector<float> values = {5, 1, 4, 2, 3};
    EXPECT_EQ(quantile(values, 0), 1);
    EXPECT_EQ(quantile(values, 0.19), 1);
    EXPECT_EQ(quantile(values, 0.2), 2);
    EXPECT_EQ(median(values), 3);
    EXPECT_EQ(quantile(values, 1), 5);
}

TEST(Quantile, TakesTheUpperOfTwoAndNothingOfNone) {
    std::vector<double> values = {4, 1, 3, 2}, none, hundred;
    EXPECT_EQ(median(values), 3);
    EXPECT_EQ(median(none), 0);
    EXPECT_EQ(quantile(none, 0.99), 0);
    for (int i = 100; i >= 0; --i) hundred.push_back(i);
    for (const double value : {0, 50, 99, 100}) EXPECT_EQ(quantile(hundred, value / 100), value);
}

TEST(LatLong, DirectionsAndTexelsAgree) {
    EXPECT_NEAR(directionFromLatLong(glm::dvec2(0.5, 0.5)).z, -1.0, 1e-15);
    EXPECT_NEAR(directionFromLatLong(glm::dvec2(0.75, 0.5)).x, 1.0, 1e-15);
    EXPECT_NEAR(directionFromLatLong(glm::dvec2(0.3, 0.0)).y, 1.0, 1e-15);
    for (const double u : {0.01, 0.3, 0.99})
        for (const double v : {0.01, 0.4, 0.97}) {
            const glm::dvec2 back = latLongFromDirection(directionFromLatLong(glm::dvec2(u, v)));
            EXPECT_NEAR(back.x, u, 1e-12);
            EXPECT_NEAR(back.y, v, 1e-12);
        }
    double sum = 0;
    for (int y = 0; y < 107; ++y) sum += texelSolidAngle(y, 214, 107) * 214;
    EXPECT_NEAR(sum, 4 * pi, 1e-12);
}

// The bound of the polynomial, 1e-5 radians, is 3.2e-6 of the map's height and half as much of its width.
TEST(LatLong, RoughTexelsAreOffByLittle) {
    for (int row = 0; row <= 200; ++row)
        for (int column = 0; column < 400; ++column) {
            const glm::vec2 uv((static_cast<float>(column) + 0.5f) / 400, static_cast<float>(row) / 200);
            const glm::vec2 rough = latLongRoughly(directionFromLatLong(uv));
            EXPECT_NEAR(rough.y, uv.y, 4e-6f) << uv.x << ", " << uv.y;
            if (row == 0 || row == 200) continue; // at the poles there is no longitude
            EXPECT_NEAR(rough.x, uv.x, 4e-6f) << uv.x << ", " << uv.y;
        }
    for (const float y : {-1.0f, 1.0f}) EXPECT_EQ(latLongRoughly(glm::vec3(0, y, 0)).y, y < 0 ? 1 : 0);
}

// Midpoint rule in latitude: (pi / 128)^2 / 24 relative on each of up to 8 powers of sine and cosine.
TEST(SphericalHarmonics, AreOrthonormal) {
    std::array<std::array<double, kShCount>, kShCount> gram{};
    constexpr int kWidth = 256, kHeight = 128;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const auto basis = shBasis(texelDirection<double>(x, y, kWidth, kHeight));
            for (size_t i = 0; i < kShCount; ++i)
                for (size_t j = 0; j < kShCount; ++j)
                    gram[i][j] += basis[i] * basis[j] * texelSolidAngle(y, kWidth, kHeight);
        }
    for (size_t i = 0; i < kShCount; ++i)
        for (size_t j = 0; j < kShCount; ++j)
            EXPECT_NEAR(gram[i][j], i == j ? 1.0 : 0.0, 1e-3) << i << " " << j;
}

// Float pixels: 6e-8 relative; the rest as above.
TEST(SphericalHarmonics, ProjectionReturnsWhatIsInTheBands) {
    const auto radiance = [](const glm::dvec3& d) { return glm::dvec3(2 + d.y + 3 * d.x * d.z); };
    const ShRgb c = shProject(light::paint(256, 128, radiance));
    for (const glm::dvec2 uv : {glm::dvec2(0.1, 0.2), glm::dvec2(0.6, 0.5), glm::dvec2(0.9, 0.9)}) {
        const glm::dvec3 d = directionFromLatLong(uv);
        EXPECT_NEAR(shEvaluate(c, d).x, radiance(d).x, 3e-3);
    }
}

// Half a unit in the last place of a float just below 1, 2 and 4, and the series.
constexpr double kBelow1 = 3.0e-8 + 1e-9, kBelow4 = 1.2e-7 + 1e-9;

TEST(Trigonometry, SineAndCosineAgreeWithTheLibrarysToTheRoundingOfAFloat) {
    double worst = 0;
    for (int i = -400'000; i <= 400'000; ++i) {
        const float angle = static_cast<float>(i) * 1e-3f;
        const double exact = static_cast<double>(angle);
        worst = std::max({worst, std::fabs(static_cast<double>(sine(angle)) - std::sin(exact)),
                          std::fabs(static_cast<double>(cosine(angle)) - std::cos(exact))});
    }
    EXPECT_LE(worst, kBelow1);
    EXPECT_EQ(sine(0.0f), 0);
    EXPECT_EQ(cosine(0), 1);
    EXPECT_EQ(sine(-1.25f), -sine(1.25f));
}

TEST(Trigonometry, ArcTangentAgreesWithTheLibrarysInAllDirections) {
    double worst = 0;
    for (int i = -100'000; i <= 100'000; ++i) {
        const double angle = i * std::numbers::pi / 100'000;
        for (const double length : {1e-20, 1.0, 1e20}) {
            const float x = static_cast<float>(length * std::cos(angle));
            const float y = static_cast<float>(length * std::sin(angle));
            const double exact = std::atan2(static_cast<double>(y), static_cast<double>(x));
            worst = std::max(worst, std::fabs(static_cast<double>(arcTangent(y, x)) - exact));
        }
    }
    EXPECT_LE(worst, kBelow4);
    EXPECT_EQ(arcTangent(0, 0), 0);
    EXPECT_EQ(arcTangent(0, 1), 0);
    EXPECT_FLOAT_EQ(arcTangent(0, -1), std::numbers::pi_v<float>);
}

// Near the ends rounding of the cosine itself is as much as the square root of a float's: the same for both.
TEST(Trigonometry, ArcCosineAgreesWithTheLibrarys) {
    for (int i = -100'000; i <= 100'000; ++i) {
        const float cosine = static_cast<float>(i) * 1e-5f;
        EXPECT_NEAR(arcCosine(cosine), std::acos(static_cast<double>(cosine)), 3e-7) << cosine;
    }
    EXPECT_EQ(arcCosine(1), 0);
    EXPECT_EQ(arcCosine(7), 0);
    EXPECT_FLOAT_EQ(arcCosine(-1), std::numbers::pi_v<float>);
}

TEST(Trigonometry, RotationsAreThoseOfGlm) {
    const glm::vec3 axis = glm::normalize(glm::vec3(0.3f, -0.5f, 0.8f));
    for (const float angle : {-3.0f, -0.4f, 0.0f, 1e-3f, 1.5f, 3.1f}) {
        const glm::quat ours = rotationAbout(axis, angle), theirs = glm::angleAxis(angle, axis);
        EXPECT_NEAR(glm::length(glm::vec4(ours.x - theirs.x, ours.y - theirs.y, ours.z - theirs.z,
                                          ours.w - theirs.w)),
                    0, 2e-7);
    }
}

} // namespace
} // namespace shoal::math
