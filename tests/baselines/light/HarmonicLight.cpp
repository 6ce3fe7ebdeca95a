#include "tests/baselines/light/Baselines.h"

#include "tests/baselines/light/Harmonics.h"

#include <cmath>
#include <map>
#include <memory>
#include <numbers>

namespace shoal::light::baselines {

namespace {

constexpr int kWidth = 128; // of the level projected: its texels are a twentieth of the eighth band's waves

struct State {
    Harmonics harmonics;
    HarmonicProjection projection;
    HarmonicRgb radiance{};

    explicit State(int bands) : harmonics(bands), projection(kWidth, bands) {}

    void update(const Input& input) { projection.project(input.pyramid->ofWidth(kWidth), radiance); }

    // The light after convolution with a lobe of these factors.
    void shade(const std::vector<double>& factors, std::span<const glm::vec3> dirs,
               std::span<glm::vec3> out) const {
        HarmonicRgb filtered{};
        const int bands = harmonics.bands();
        for (int l = 0; l < bands; ++l)
            for (int i = l * l; i < (l + 1) * (l + 1); ++i)
                filtered[i] = radiance[i] * static_cast<float>(factors[l]);
        std::array<float, kMaxHarmonics> values;
        for (size_t k = 0; k < dirs.size(); ++k) {
            harmonics.evaluate(dirs[k], values);
            glm::vec3 sum(0);
            for (size_t i = 0; i < static_cast<size_t>(bands * bands); ++i) sum += filtered[i] * values[i];
            out[k] = sum;
        }
    }
};

} // namespace

DiffuseMethod harmonicDiffuse(int bands, bool windowed) {
    auto state = std::make_shared<State>(bands);
    auto factors = zonalFactors(diffuseLobe(), bands);
    if (windowed)
        for (int l = 0; l < bands; ++l)
            factors[l] *= 0.5 * (1 + std::cos(std::numbers::pi * l / (2 * bands)));
    const std::string name = "harmonics, " + std::to_string(bands) + " bands";
    return {{windowed ? name + ", windowed" : name, "SH " + std::to_string(bands) + (windowed ? "w" : ""),
             windowed ? "spherical harmonics, windowed" : "spherical harmonics",
             windowed ? "Sloan 2008" : "Ramamoorthi and Hanrahan 2001"},
            [state](const Input& input) { state->update(input); },
            [state, factors](std::span<const glm::vec3> normals, std::span<glm::vec3> out) {
                state->shade(factors, normals, out);
            }};
}

GlossyMethod harmonicGlossy(int bands) {
    auto state = std::make_shared<State>(bands);
    // Factors by roughness; a renderer has a table.
    auto known = std::make_shared<std::map<float, std::vector<double>>>();
    return {
        {"harmonics, " + std::to_string(bands) + " bands", "SH " + std::to_string(bands),
         "spherical harmonics",
         "Ramamoorthi and Hanrahan 2002, \"Frequency Space Environment Map Rendering\""},
        [state](const Input& input) { state->update(input); },
        [state, known, bands](std::span<const glm::vec3> dirs, float roughness, std::span<glm::vec3> out) {
            auto& factors = (*known)[roughness];
            if (factors.empty()) factors = zonalFactors(glossyLobe(roughness), bands);
            state->shade(factors, dirs, out);
        }};
}

} // namespace shoal::light::baselines
