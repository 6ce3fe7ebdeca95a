#include "tests/bench/light/Measure.h"

#include "engine/light/Pyramid.h"
#include "engine/light/rivals/Levels.h"
#include "engine/math/Colour.h"
#include "tests/bench/light/Timing.h"

#include <cstdio>
#include <cstring>

namespace shoal::bench {

using namespace light::rivals;

namespace {

constexpr int kBaseWidth = 1024; // of the pyramid, as the game asks for

Input inputOf(const Surround& surround, const light::RadiancePyramid& pyramid) {
    Input input{&pyramid, {}, nullptr};
    if (surround.coded())
        input.coded = surround.view();
    else
        input.radianceLin = &surround.radianceLin;
    return input;
}

light::RadiancePyramid pyramidOf(const Surround& surround) {
    light::RadiancePyramid pyramid;
    light::PyramidMaker maker;
    if (surround.coded())
        maker.make(surround.view(), kBaseWidth, pyramid);
    else
        maker.make(surround.radianceLin, kBaseWidth, pyramid);
    return pyramid;
}

std::vector<glm::dvec3> column(const Truth& truth, size_t lobe) {
    std::vector<glm::dvec3> values;
    for (const auto& row : truth) values.push_back(row[lobe]);
    return values;
}

SurroundError errorOfLobe(const std::vector<glm::vec3>& got, const Truth& truth, size_t lobe) {
    return errorOf(std::vector<glm::dvec3>(got.begin(), got.end()), column(truth, lobe));
}

// As the pixels of a ball come, row by row; those who go by looking up find neighbours in the cache.
std::vector<glm::vec3> ballNormals() {
    constexpr int kSize = 80;
    std::vector<glm::vec3> normals;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const float nx = (static_cast<float>(x) + 0.5f) * 2 / kSize - 1;
            const float ny = 1 - (static_cast<float>(y) + 0.5f) * 2 / kSize;
            const float square = 1 - nx * nx - ny * ny;
            if (square > 0) normals.emplace_back(nx, ny, std::sqrt(square));
        }
    return normals;
}

double readBytes_us(const ImageRgb8& frame) {
    volatile uint64_t kept = 0; // so that the sum is needed
    return shortest_us(100, [&] {
        uint64_t sum = 0;
        for (size_t i = 0; i + 8 <= frame.pixels.size(); i += 8) {
            uint64_t word;
            std::memcpy(&word, frame.pixels.data() + i, 8);
            sum += word;
        }
        kept = sum;
        return 0.0;
    });
}

void timeAll(Chart& chart, std::vector<DiffuseMethod>& diffuse, std::vector<GlossyMethod>& glossy,
             std::vector<PyramidMethod>& pyramids, bool quick) {
    Surround timed{"timed", timedFrame(), {}};
    const double budget_ms = quick ? 30 : 300;
    chart.read_us = readBytes_us(timed.frame);
    light::PyramidMaker maker;
    light::RadiancePyramid pyramid;
    chart.pyramid_us = shortest_us(2 * budget_ms, [&] {
        maker.make(timed.view(), kBaseWidth, pyramid);
        return 0.0;
    });
    const Input input = inputOf(timed, pyramid);
    const auto normals = ballNormals();
    const double pixels = static_cast<double>(normals.size());
    std::vector<glm::vec3> out(normals.size());
    const auto update_us = [&](auto& method) {
        return shortest_us(budget_ms, [&] { return method.update(input); }) +
               (method.readsPyramid ? chart.pyramid_us : 0);
    };
    std::fprintf(stderr, "chart: timing ");
    for (size_t i = 0; i < diffuse.size(); ++i) {
        Cost& cost = chart.diffuse[i].cost;
        cost.update_us = update_us(diffuse[i]);
        cost.shade_ns = 1e3 / pixels * shortest_us(budget_ms / 3, [&] {
                            diffuse[i].shade(normals, out);
                            return 0.0;
                        });
        std::fprintf(stderr, ".");
    }
    for (size_t i = 0; i < glossy.size(); ++i) {
        Cost& cost = chart.glossy[i].cost;
        cost.update_us = update_us(glossy[i]);
        for (const float roughness : kRoughnesses)
            cost.shade_ns += 1e3 / pixels / std::size(kRoughnesses) * shortest_us(budget_ms / 10, [&] {
                                 glossy[i].shade(normals, roughness, out);
                                 return 0.0;
                             });
        std::fprintf(stderr, ".");
    }
    for (size_t i = 0; i < pyramids.size(); ++i) {
        light::RadiancePyramid made;
        chart.pyramids[i].cost.update_us =
            shortest_us(budget_ms, [&] { return pyramids[i].make(timed.view(), made), 0.0; });
        std::fprintf(stderr, ".");
    }
    std::fprintf(stderr, "\n");
}

// The diffuse light that a pyramid's level of 128 texels gives, all of it integrated.
SurroundError pyramidError(const PyramidMethod& method, const Surround& surround,
                           std::span<const glm::dvec3> dirs, const Truth& truth) {
    light::RadiancePyramid pyramid;
    method.make(surround.view(), pyramid);
    const light::Lobe lobe[] = {light::diffuseLobe()};
    return errorOf(column(integrals(levelOfWidth(pyramid, 128), dirs, lobe), 0), column(truth, 0));
}

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
SurroundError errorAfterScaling(std::vector<glm::dvec3> got, const std::vector<glm::dvec3>& want) {
    double both = 0, own = 0;
    for (size_t i = 0; i < got.size(); ++i)
        both += glm::dot(got[i], want[i]), own += glm::dot(got[i], got[i]);
    for (glm::dvec3& each : got) each *= both / own;
    return errorOf(got, want);
}

void measureToneMaps(Chart& chart, const Plan& plan, std::span<const glm::dvec3> dirs) {
    const auto methods = inverseToneMapMethods();
    for (const auto& each : methods) chart.toneMaps.push_back({each.label, {}, {}});
    const light::Lobe lobes[] = {light::diffuseLobe(), light::glossyLobe(0.5)};
    for (const SurroundSource& source : hdrSources(plan.shared)) {
        if (plan.quick && chart.toneMapSurrounds.size() == 2) break;
        const auto surround = source.load();
        if (!surround) continue;
        std::fprintf(stderr, "chart: inverse tone mapping, %s\n", source.name.c_str());
        chart.toneMapSurrounds.push_back(source.name);
        const Exposed exposed = expose(surround->radianceLin);
        const Truth truth = integrals(quartered(exposed.radianceLin), dirs, lobes);
        ImageRgbF expanded;
        for (size_t i = 0; i < methods.size(); ++i) {
            methods[i].expand(exposed.frame, expanded);
            const Truth got = integrals(quartered(expanded), dirs, lobes);
            auto& errors = chart.toneMaps[i].errors.emplace_back();
            for (size_t lobe = 0; lobe < std::size(lobes); ++lobe)
                errors.push_back(errorAfterScaling(column(got, lobe), column(truth, lobe)));
        }
    }
}

} // namespace

Chart measure(const Plan& plan) {
    Chart chart;
    auto diffuse = diffuseMethods();
    auto glossy = glossyMethods();
    auto pyramids = pyramidMethods();
    for (const auto& each : diffuse) chart.diffuse.push_back({each.label, {}, {}});
    for (const auto& each : glossy) chart.glossy.push_back({each.label, {}, {}});
    for (const auto& each : pyramids) chart.pyramids.push_back({each.label, {}, {}});
    timeAll(chart, diffuse, glossy, pyramids, plan.quick);

    const auto dirs = chartDirections(plan.spread);
    const std::vector<glm::vec3> floatDirs(dirs.begin(), dirs.end());
    std::vector<glm::vec3> out(dirs.size());
    for (const SurroundSource& source : surroundSources(plan.shared, plan.quick)) {
        const auto surround = source.load();
        if (!surround) {
            std::fprintf(stderr, "chart: left out, not at hand: %s\n", source.name.c_str());
            continue;
        }
        std::fprintf(stderr, "chart: %s, %dx%d: truth", source.name.c_str(), surround->radianceLin.width,
                     surround->radianceLin.height);
        chart.surrounds.push_back({source.name, surround->coded(), hasPointSun(surround->radianceLin)});
        const Truth truth = truthOf(surround->radianceLin, dirs, plan.cache);
        std::fprintf(stderr, ", methods");
        const auto pyramid = pyramidOf(*surround);
        const Input input = inputOf(*surround, pyramid);
        for (size_t i = 0; i < diffuse.size(); ++i) {
            diffuse[i].update(input);
            diffuse[i].shade(floatDirs, out);
            chart.diffuse[i].errors.push_back({errorOfLobe(out, truth, 0)});
        }
        for (size_t i = 0; i < glossy.size(); ++i) {
            glossy[i].update(input);
            chart.glossy[i].errors.emplace_back();
            for (size_t k = 0; k < std::size(kRoughnesses); ++k) {
                glossy[i].shade(floatDirs, kRoughnesses[k], out);
                chart.glossy[i].errors.back().push_back(errorOfLobe(out, truth, k + 1));
            }
        }
        for (size_t i = 0; i < pyramids.size(); ++i) {
            chart.pyramids[i].errors.emplace_back();
            if (surround->coded())
                chart.pyramids[i].errors.back().push_back(pyramidError(pyramids[i], *surround, dirs, truth));
        }
        std::fprintf(stderr, ".\n");
    }
    measureToneMaps(chart, plan, dirs);
    return chart;
}

} // namespace shoal::bench
