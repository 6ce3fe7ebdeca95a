#include "tests/bench/light/Measure.h"
#include "engine/light/Pyramid.h"

namespace shoal::bench {

using namespace light::baselines;

namespace {

light::RadiancePyramid pyramidOf(const Environment& environment) {
    light::RadiancePyramid pyramid;
    light::PyramidMaker maker;
    if (environment.coded())
        maker.make(environment.view(), environment.baseWidth(), pyramid);
    else
        maker.make(environment.radianceLin, environment.baseWidth(), pyramid);
    return pyramid;
}

EnvironmentError errorOfLobe(const std::vector<glm::vec3>& got, const Truth& truth, size_t lobe) {
    return errorOf(std::vector<glm::dvec3>(got.begin(), got.end()), column(truth, lobe));
}

// Returns directions spread evenly over the sphere (Fibonacci lattice), then the six axes: both poles, the
// seam, ahead, left and right.
std::vector<glm::dvec3> chartDirections(int spread) {
    std::vector<glm::dvec3> dirs;
    for (int i = 0; i < spread; ++i) {
        const double y = 1 - (2 * i + 1.0) / spread, turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
        const double ring = std::sqrt(1 - y * y);
        dirs.emplace_back(ring * std::cos(turn), y, ring * std::sin(turn));
    }
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0}) {
            glm::dvec3 dir(0);
            dir[axis] = sign;
            dirs.push_back(dir);
        }
    return dirs;
}

// Returns the error of the diffuse light that is integrated over a pyramid's level of 128 texels.
EnvironmentError pyramidError(const PyramidMethod& method, const Environment& environment,
                              std::span<const glm::dvec3> dirs, const Truth& truth) {
    light::RadiancePyramid pyramid;
    method.make(environment.view(), pyramid);
    const light::Lobe lobe[] = {light::diffuseLobe()};
    return errorOf(column(integrals(pyramid.ofWidth(128), dirs, lobe), 0), column(truth, 0));
}

} // namespace

Truth integrals(const ImageRgbF& radianceLin, std::span<const glm::dvec3> dirs,
                std::span<const light::Lobe> lobes) {
    Truth truth(dirs.size());
    onAllCores(dirs.size(),
               [&](size_t k) { truth[k] = light::referenceRadiance(radianceLin, dirs[k], lobes); });
    return truth;
}

Chart measure(bool quick) {
    Chart chart;
    auto diffuse = diffuseMethods();
    auto glossy = glossyMethods();
    auto pyramids = pyramidMethods();
    for (const auto& each : diffuse) chart.diffuse.push_back({each.label, {}, {}});
    for (const auto& each : glossy) chart.glossy.push_back({each.label, {}, {}});
    for (const auto& each : pyramids) chart.pyramids.push_back({each.label, {}, {}});
    timeMethods(chart, diffuse, glossy, pyramids, quick);

    const auto dirs = chartDirections(quick ? 16 : 64);
    const std::vector<glm::vec3> floatDirs(dirs.begin(), dirs.end());
    std::vector<glm::vec3> out(dirs.size());
    std::vector<light::Lobe> lobes = {light::diffuseLobe()};
    for (const float roughness : kRoughnesses) lobes.push_back(light::glossyLobe(roughness));
    for (const EnvironmentSource& source : environmentSources(quick)) {
        const auto environment = source.load();
        if (!environment) {
            std::fprintf(stderr, "chart: left out, not at hand: %s\n", source.name.c_str());
            continue;
        }
        std::fprintf(stderr, "chart: %s, %dx%d: truth", source.name.c_str(), environment->radianceLin.width,
                     environment->radianceLin.height);
        chart.environments.push_back(
            {source.name, environment->coded(), hasPointSun(environment->radianceLin)});
        const Truth truth = integrals(environment->radianceLin, dirs, lobes);
        std::fprintf(stderr, ", methods");
        const auto pyramid = pyramidOf(*environment);
        const Input input{&pyramid, environment->view(),
                          environment->coded() ? nullptr : &environment->radianceLin};
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
            if (environment->coded())
                chart.pyramids[i].errors.back().push_back(
                    pyramidError(pyramids[i], *environment, dirs, truth));
        }
        std::fprintf(stderr, ".\n");
    }
    measureToneMaps(chart, quick, dirs);
    return chart;
}

Pool pooled(const Chart& chart, const Measured& method, Suns suns, size_t firstLobe, size_t lobes) {
    Pool pool;
    for (size_t s = 0; s < chart.environments.size(); ++s) {
        const bool sun = chart.environments[s].pointSun;
        if ((suns == Suns::Without && sun) || (suns == Suns::Only && !sun)) continue;
        for (size_t k = firstLobe; k < firstLobe + lobes; ++k) pool.add(method.errors[s][k]);
    }
    return pool;
}

double medianOfToneMap(const Chart& chart, const Measured& method, ToneMapped which, size_t lobe) {
    const bool film = which == ToneMapped::Film;
    const size_t end = film                         ? method.errors.size()
                       : which == ToneMapped::Apart ? chart.toneMapsApart
                                                    : chart.toneMapsClipped;
    std::vector<double> errors;
    for (size_t i = film ? chart.toneMapsClipped : 0; i < end; ++i)
        errors.push_back(method.errors[i][lobe].rms);
    if (errors.empty()) return std::nan("");
    std::ranges::sort(errors);
    return (errors[(errors.size() - 1) / 2] + errors[errors.size() / 2]) / 2;
}

} // namespace shoal::bench
