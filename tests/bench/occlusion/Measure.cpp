#include "tests/bench/occlusion/Measure.h"
#include "engine/light/MakeLight.h"
#include "tests/bench/light/Environments.h"

namespace shoal::bench {

namespace {

constexpr float kEnclosed =
    0.005f; // free share of the hemisphere below which a receiver is never seen, as inside a mouth

SceneError errorOf(std::span<const glm::vec3> got, const OccludedLight& truth, size_t environment,
                   std::span<const glm::vec3> unshaded) {
    const auto& want = truth.diffuse[environment];
    double off[2] = {0, 0}, whole[2] = {0, 0};
    for (size_t i = 0; i < got.size(); ++i) {
        if (truth.open[i] < kEnclosed) continue;
        const glm::dvec3 miss = glm::dvec3(got[i]) - want[i];
        const auto sum = [](const glm::dvec3& c) { return c.x + c.y + c.z; };
        const bool shaded = sum(want[i]) < 0.9 * sum(glm::dvec3(unshaded[i]));
        for (int k = 0; k <= (shaded ? 1 : 0); ++k) {
            off[k] += glm::dot(miss, miss);
            whole[k] += glm::dot(want[i], want[i]);
        }
    }
    return {std::sqrt(off[0] / whole[0]), std::sqrt(off[1] / whole[1])};
}

// fine: gets the form of each that the truth reads.
std::vector<Lit> litEnvironments(bool quick, std::vector<Fine>& fine) {
    std::vector<Lit> all;
    light::LightMaker video({.baseWidth = 512, .minRoughness = 0.25f});
    light::LightMaker still(
        {.baseWidth = 1024, .minRoughness = 0.25f, .quality = light::LightQuality::Still});
    for (const EnvironmentSource& source : environmentSources(quick)) {
        const auto environment = source.load();
        if (!environment) {
            std::fprintf(stderr, "occlusion: left out, not at hand: %s\n", source.name.c_str());
            continue;
        }
        Lit& lit = all.emplace_back(source.name, hasPointSun(environment->radianceLin));
        if (environment->coded())
            video.make(environment->view(), lit.light);
        else
            still.makeFromHdr(environment->radianceLin, lit.light);
        lit.harmonics = math::shProject(lit.light.radiance.levels[1]);
        fine.push_back(fineOf(environment->radianceLin));
    }
    return all;
}

std::vector<OcclusionMethod> occlusionMethods(bool quick) {
    std::vector<OcclusionMethod> all = {ignored(), // first
                                        bakedOcclusion(true),
                                        bakedOcclusion(false),
                                        transfer(3, true),
                                        transfer(4, true),
                                        transfer(4, false),
                                        coherentShadowMaps(256, 64),
                                        coherentShadowMaps(512, 128),
                                        layeredDepth(64, 128),
                                        layeredDepth(256, 128),
                                        thesisLayers(64),
                                        curedLayers(64)};
    for (const int pixels : {kUsualPixels / 2, kUsualPixels})
        for (const int cells : {3, kUsualCells, 9})
            if (!quick || cells < 9 || pixels < kUsualPixels) {
                all.push_back(thesisLayers(256, cells, pixels));
                all.push_back(curedLayers(256, 6 * cells * cells, pixels));
            }
    for (const Casting casting : {Casting::Others, Casting::OthersAndFolds, Casting::All})
        all.push_back(ellipsoids(casting));
    for (const int directions : {16, 64, 256}) all.push_back(exactRays(directions));
    return all;
}

} // namespace

OcclusionChart measureOcclusion(std::span<const Scene> scenes, bool quick) {
    OcclusionChart chart;
    std::fprintf(stderr, "occlusion: light of the environments\n");
    std::vector<Fine> fine;
    const auto environments = litEnvironments(quick, fine);
    for (const Lit& each : environments) {
        chart.environments.push_back(each.name);
        chart.pointSun.push_back(each.pointSun);
    }
    const Cells cells = cellsOf(fine);
    auto methods = occlusionMethods(quick);
    for (const OcclusionMethod& each : methods)
        chart.methods.push_back({.label = each.label, .moves = each.moves});
    for (const Scene& scene : scenes) {
        std::fprintf(stderr, "occlusion: %s: truth by %zu cells", scene.name.c_str(), cells.cells.size());
        chart.scenes.push_back(scene.name);
        const Rays rays(scene.meshes());
        const auto receivers = spreadReceivers(scene, quick ? 60 : 240);
        const OccludedLight truth = occludedLight(scene, rays, receivers, cells);
        chart.noise.push_back(truth.noise);
        double open = 0;
        for (const float each : truth.open) open += each;
        chart.open.push_back(open / static_cast<double>(receivers.size()));
        std::vector<std::vector<glm::vec3>> unshaded;
        std::fprintf(stderr, ", methods\n");
        std::vector<glm::vec3> out(receivers.size());
        for (size_t m = 0; m < methods.size(); ++m) {
            const double begin = now_us();
            methods[m].build(scene, rays);
            chart.methods[m].body_us.push_back((now_us() - begin) / static_cast<double>(scene.bodies.size()));
            chart.methods[m].bytes.push_back(methods[m].bytes());
            chart.methods[m].errors.emplace_back();
            if (methods[m].foresee) methods[m].foresee(receivers);
            for (size_t s = 0; s < environments.size(); ++s) {
                methods[m].relight(environments[s]);
                methods[m].shade(receivers, out);
                if (m == 0) unshaded.push_back(out);
                chart.methods[m].errors.back().push_back(errorOf(out, truth, s, unshaded[s]));
            }
            if (methods[m].foresee) methods[m].foresee({});
            // Times few receivers at once, so that even a slow method's shortest run is short enough to be
            // undisturbed by other programs.
            constexpr size_t kTogether = 8;
            double shade_us = 0;
            for (size_t first = 0; first + kTogether <= receivers.size(); first += kTogether)
                shade_us += shortest_us(quick ? 0.1 : 1, [&] {
                    methods[m].shade(std::span(receivers).subspan(first, kTogether), out);
                });
            chart.methods[m].receiver_ns.push_back(1e3 * shade_us / static_cast<double>(receivers.size()));
        }
        std::fprintf(stderr, "occlusion: %s: glossy\n", scene.name.c_str());
        measureGlossy(chart.glossy, scene, rays, std::span(receivers).first(quick ? 50 : receivers.size()),
                      environments);
        if (scene.name == "shark above a shoal") measureGround(chart, scene, environments, cells, quick);
    }
    return chart;
}

} // namespace shoal::bench
