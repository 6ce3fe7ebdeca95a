#include "tests/baselines/light/Baselines.h"

#include "engine/light/InverseToneMap.h"
#include "tests/baselines/light/Harmonics.h"

#include <glm/geometric.hpp>

#include <memory>
#include <numbers>

namespace shoal::light::baselines {

using std::numbers::pi;

namespace {

constexpr int kWidth = 128, kBands = 3;

struct State {
    Harmonics harmonics{kBands};
    HarmonicProjection projection{kWidth, kBands};
    HarmonicRgb radiance{};

    // out(n) = constant + linear * n + zonal * (3 (n.axis)^2 - 1) / 2
    glm::vec3 constant{0}, axis{0, 1, 0}, zonal{0};
    glm::vec3 linearX{0}, linearY{0}, linearZ{0};

    void make(const ImageRgbF& level) {
        projection.project(level, radiance);
        // Y_1 is sqrt(3 / 4 pi) times x, y, -z; a matte surface keeps 2/3 of it and a quarter of band 2.
        const auto first = static_cast<float>(2.0 / 3 * std::sqrt(3 / (4 * pi)));
        constant = radiance[0] * static_cast<float>(std::sqrt(1 / (4 * pi)));
        linearX = radiance[1] * first, linearY = radiance[2] * first, linearZ = radiance[3] * -first;

        axis = {linearLuminance(linearX), linearLuminance(linearY), linearLuminance(linearZ)};
        const float length = glm::length(axis);
        axis = length > 1e-12f ? axis / length : glm::vec3(0, 1, 0);

        // A zonal function k Y_20 about the axis has the coefficients sqrt(4 pi / 5) k Y_2m(axis), whose
        // squares sum to k^2: projecting band 2 on it is a scalar product.
        std::array<float, kMaxHarmonics> values;
        harmonics.evaluate(axis, values);
        glm::vec3 k(0);
        for (size_t i = 4; i < 9; ++i) k += radiance[i] * values[i];
        k *= static_cast<float>(std::sqrt(4 * pi / 5));
        zonal = k * static_cast<float>(0.25 * std::sqrt(5 / (4 * pi)));
    }

    glm::vec3 shade(const glm::vec3& n) const {
        const float along = glm::dot(n, axis);
        return constant + linearX * n.x + linearY * n.y + linearZ * n.z +
               zonal * (1.5f * along * along - 0.5f);
    }
};

} // namespace

DiffuseMethod zonalHarmonicsDiffuse() {
    auto state = std::make_shared<State>();
    return {{"ZH3: two bands and a zonal third", "ZH3", "ZH3", "Roughton et al. 2024"},
            [state](const Input& input) { state->make(input.pyramid->ofWidth(kWidth)); },
            [state](std::span<const glm::vec3> normals, std::span<glm::vec3> out) {
                for (size_t i = 0; i < normals.size(); ++i) out[i] = state->shade(normals[i]);
            }};
}

} // namespace shoal::light::baselines
