#include "tests/bench/light/Measure.h"

#include "engine/light/Pyramid.h"
#include "engine/math/Colour.h"

#include <cstdio>

namespace shoal::bench {

using namespace light::baselines;

namespace {

// As a camera would have kept it: a tenth of its pixels above 0.8, clipped at 1, sRGB, 8 bits.
struct Exposed {
    ImageRgb8 frame;
    ImageRgbF radianceLin; // before it was clipped, of the same scale
};

Exposed expose(const ImageRgbF& radianceLin) {
    std::vector<float> luminances;
    for (size_t i = 0; i < radianceLin.pixels.size(); i += 3) {
        const float* t = &radianceLin.pixels[i];
        luminances.push_back(0.2126f * t[0] + 0.7152f * t[1] + 0.0722f * t[2]);
    }
    const auto ninth = luminances.begin() + static_cast<ptrdiff_t>(luminances.size() * 9 / 10);
    std::nth_element(luminances.begin(), ninth, luminances.end());
    const float exposure = 0.8f / *ninth;

    Exposed exposed{ImageRgb8(radianceLin.width, radianceLin.height), radianceLin};
    for (size_t i = 0; i < radianceLin.pixels.size(); ++i) {
        exposed.radianceLin.pixels[i] *= exposure;
        const float clipped = std::clamp(exposed.radianceLin.pixels[i], 0.0f, 1.0f);
        exposed.frame.pixels[i] = static_cast<uint8_t>(std::lround(255 * math::srgbFromLinear(clipped)));
    }
    return exposed;
}

// Light of roughness 0.5 needs no more than 256 texels around.
ImageRgbF quartered(const ImageRgbF& image) {
    ImageRgbF half, quarter;
    light::halve(image, half);
    light::halve(half, quarter);
    return quarter;
}

// After the one factor that brings it nearest: how bright the frame was exposed is not the operator's to
// know.
EnvironmentError errorAfterScaling(std::vector<glm::dvec3> got, const std::vector<glm::dvec3>& want) {
    double both = 0, own = 0;
    for (size_t i = 0; i < got.size(); ++i)
        both += glm::dot(got[i], want[i]), own += glm::dot(got[i], got[i]);
    for (glm::dvec3& each : got) each *= both / own;
    return errorOf(got, want);
}

} // namespace

void measureToneMaps(Chart& chart, const SessionConfig& plan, std::span<const glm::dvec3> dirs) {
    const auto methods = inverseToneMapMethods();
    for (const auto& each : methods) chart.toneMaps.push_back({each.label, {}, {}});
    const light::Lobe lobes[] = {light::diffuseLobe(), light::glossyLobe(0.5)};
    // lit: the light that the frame was filmed in, of 256 or 512 texels around.
    const auto measure = [&](const std::string& name, const ImageRgb8& frame, const ImageRgbF& lit) {
        std::fprintf(stderr, "chart: inverse tone mapping, %s\n", name.c_str());
        chart.toneMapEnvironments.push_back(name);
        const Truth truth = integrals(lit, dirs, lobes);
        ImageRgbF expanded;
        for (size_t i = 0; i < methods.size(); ++i) {
            methods[i].expand(frame, expanded);
            const Truth got = integrals(quartered(expanded), dirs, lobes);
            auto& errors = chart.toneMaps[i].errors.emplace_back();
            for (size_t lobe = 0; lobe < std::size(lobes); ++lobe)
                errors.push_back(errorAfterScaling(column(got, lobe), column(truth, lobe)));
        }
    };
    for (const EnvironmentSource& source : hdrSources(plan.shared)) {
        if (plan.quick && chart.toneMapEnvironments.size() == 2) break;
        const auto environment = source.load();
        if (!environment) continue;
        const Exposed exposed = expose(environment->radianceLin);
        measure(source.name, exposed.frame, quartered(exposed.radianceLin));
    }
    chart.toneMapsClipped = chart.toneMapEnvironments.size();
    for (const EnvironmentSource& source : filmedSources())
        if (const auto filmed = source.load()) {
            measure(source.name, filmed->frame, filmed->radianceLin);
            if (plan.quick) break;
        }
}

} // namespace shoal::bench
