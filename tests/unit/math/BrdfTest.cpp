#include "engine/math/Brdf.h"
#include "engine/math/Colour.h"
#include "tests/baselines/light/Ggx.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace shoal::math {
namespace {

using std::numbers::pi;

TEST(Ggx, MirrorLobeIsDistributionTimesCosine) {
    for (const double angle : {0.0, 0.3, 1.0, 1.5})
        EXPECT_NEAR(ggxMirrorLobe(std::cos(angle), 0.2), ggxD(std::cos(angle / 2), 0.2) * std::cos(angle),
                    1e-12);
    EXPECT_EQ(ggxMirrorLobe(-0.1, 0.5), 0.0);
}

TEST(Ggx, RoughnessOneIsTheClampedCosine) {
    for (const double cosine : {0.1, 0.5, 1.0}) EXPECT_NEAR(ggxMirrorLobe(cosine, 1.0), cosine / pi, 1e-12);
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
        EXPECT_NEAR(srgbFromLinear(linearFromSrgb(coded)), coded,
                    1e-9); // the standard's constants meet to 3e-8
    }
    EXPECT_NEAR(linearFromSrgb(0.5), 0.21404114, 1e-8);
}

} // namespace
} // namespace shoal::math
