#include "engine/light/Lookup.h"
#include "engine/math/Brdf.h"
#include "tests/baselines/occlusion/Baked.h"
#include "tests/baselines/occlusion/OccludeByEllipsoids.h"
#include "tests/baselines/occlusion/OllfbThesis.h"
#include "tests/baselines/occlusion/TracedOllfb.h"
#include "tests/bench/occlusion/LayeredBodies.h"
#include "tests/bench/occlusion/Measure.h"
#include "tests/bench/occlusion/Truth.h"

namespace shoal::bench {

namespace {

constexpr int kLobeRays = 36; // as the thesis has
constexpr int kTruthRays = 256;

struct LobeRay {
    glm::vec3 direction{0}; // around +Z, the mirror direction
    float weight = 0;
};

// Returns rays of the lobe of Lookup.h's glossy light: half vectors by GGX's distribution, weighted by the
// cosine. Karis 2013.
std::vector<LobeRay> lobeRays(int count, int turn) {
    const double alpha = math::alphaFromRoughness(kGlossyRoughness);
    std::vector<LobeRay> rays;
    for (int i = 0; i < count; ++i) {
        const double u = (i + 0.5) / count, phi = (i + 0.37 * turn) * std::numbers::pi * (3 - std::sqrt(5.0));
        const double cosine = std::sqrt((1 - u) / (1 + (alpha * alpha - 1) * u)),
                     sine = std::sqrt(1 - cosine * cosine);
        const glm::vec3 half(sine * std::cos(phi), sine * std::sin(phi), cosine);
        const glm::vec3 light = 2 * half.z * half - glm::vec3(0, 0, 1);
        if (light.z > 0) rays.push_back({light, light.z});
    }
    return rays;
}

// Returns the unoccluded share of the glossy light for each channel.
template <class Occluded>
glm::vec3 shareOf(std::span<const LobeRay> lobe, const glm::vec3& mirrored, const Lit& lit,
                  const Occluded& occluded) {
    const glm::mat3 frame = occlusion::frameAround(mirrored);
    glm::vec3 left(0), whole(1e-20f);
    for (const LobeRay& ray : lobe) {
        const glm::vec3 to = frame * ray.direction;
        const glm::vec3 light = ray.weight * light::lookUp(lit.light.radiance, to, 1.0f);
        whole += light;
        if (!occluded(to)) left += light;
    }
    return left / whole;
}

struct Method {
    const char* name;
    std::function<glm::vec3(size_t, const Lit&)> share; // of receiver
};

} // namespace

void measureGlossy(GlossyChart& chart, const Scene& scene, const Rays& rays, std::span<const Receiver> all,
                   std::span<const Lit> environments) {
    std::vector<Receiver> receivers; // those whose mirror direction leaves the surface
    for (const Receiver& each : all)
        if (glm::dot(each.mirrored, each.normal) > 0.05f) receivers.push_back(each);

    const LayeredBodies<occlusion::OllfbThesis> thesis(scene, {.cells = 5, .resolution = 64});
    const LayeredBodies<occlusion::TracedOllfb> cured(scene, {.views = 150, .resolution = 64});
    const auto casting = castingOnOthers(scene);
    std::vector<std::vector<float>> baked;
    for (const Body& body : scene.bodies) {
        const Rays own({&body.rest});
        baked.push_back(occlusion::baselines::bakeAmbientOcclusion(
            body.rest.view(),
            [&](const glm::vec3& o, const glm::vec3& d) { return own.occluded(o, d, scene.nearest); }, 32,
            scene.nearest));
    }
    const auto lobe = lobeRays(kLobeRays, 0);
    const auto traced = [&](const auto& occluded) {
        return [&, occluded](size_t i, const Lit& lit) {
            return shareOf(lobe, receivers[i].mirrored, lit,
                           [&](const glm::vec3& to) { return occluded(receivers[i], to); });
        };
    };
    // Lagarde and de Rousiers 2014, "Moving Frostbite to Physically Based Rendering", listing 26.
    const auto fromBaked = [&](size_t i) {
        const Receiver& at = receivers[i];
        const float ao = at.mix(baked[at.body]);
        const float nv = std::max(glm::dot(at.normal, at.mirrored), 0.0f);
        return std::clamp(std::pow(nv + ao, std::exp2(-16 * kGlossyRoughness - 1)) - 1 + ao, 0.0f, 1.0f);
    };
    const auto fromEllipsoids = [&](size_t i) {
        return occlusion::lobeVisibility(receivers[i].position, receivers[i].mirrored, kGlossyRoughness,
                                         casting[receivers[i].body]);
    };
    const std::vector<Method> methods = {
        {"off", [](size_t, const Lit&) { return glm::vec3(1); }},
        {"specular occlusion from baked", [&](size_t i, const Lit&) { return glm::vec3(fromBaked(i)); }},
        {"ellipsoids of other bodies", [&](size_t i, const Lit&) { return glm::vec3(fromEllipsoids(i)); }},
        {"both", [&](size_t i, const Lit&) { return glm::vec3(fromBaked(i) * fromEllipsoids(i)); }},
        {"36 rays, the thesis' layered fragment buffers",
         traced([&](const Receiver& at, const glm::vec3& to) {
             return thesis.occluded(at.position, to, at.body);
         })},
        {"36 rays, cured layered fragment buffers", traced([&](const Receiver& at, const glm::vec3& to) {
             return cured.occluded(at.position, to, at.body);
         })},
        {"36 rays, exact", traced([&](const Receiver& at, const glm::vec3& to) {
             return rays.occluded(at.position, to, scene.nearest);
         })},
    };
    if (chart.methods.empty())
        for (const Method& each : methods) chart.methods.push_back({each.name, {}, {}});

    const std::vector<LobeRay> halves[] = {lobeRays(kTruthRays, 1), lobeRays(kTruthRays, 2)};
    std::vector<double> squares(methods.size());
    double noise = 0;
    int count = 0;
    for (const Lit& lit : environments) {
        if (lit.pointSun) continue;
        std::vector<glm::vec3> open(receivers.size()), want(receivers.size()), half(receivers.size());
        onAllCores(receivers.size(), [&](size_t i) {
            open[i] = light::lookUpGlossy(lit.light, receivers[i].mirrored, kGlossyRoughness);
            glm::vec3 share[2];
            for (int k = 0; k < 2; ++k)
                share[k] = shareOf(halves[k], receivers[i].mirrored, lit, [&](const glm::vec3& to) {
                    return rays.occluded(receivers[i].position, to, scene.nearest);
                });
            want[i] = open[i] * (share[0] + share[1]) * 0.5f;
            half[i] = open[i] * (share[0] - share[1]) * 0.5f;
        });
        double whole = 0, apart = 0;
        for (size_t i = 0; i < want.size(); ++i) {
            whole += glm::dot(want[i], want[i]);
            apart += glm::dot(half[i], half[i]);
        }
        noise = std::max(noise, std::sqrt(apart / whole));
        for (size_t m = 0; m < methods.size(); ++m) {
            double off = 0;
            for (size_t i = 0; i < want.size(); ++i) {
                const glm::vec3 miss = open[i] * methods[m].share(i, lit) - want[i];
                off += glm::dot(miss, miss);
            }
            squares[m] += off / whole;
        }
        ++count;
    }
    chart.noise.push_back(noise);
    for (size_t m = 0; m < methods.size(); ++m) {
        chart.methods[m].errors.push_back(std::sqrt(squares[m] / count));
        std::vector<glm::vec3> out(receivers.size());
        chart.methods[m].receiver_ns.push_back(
            1e3 / static_cast<double>(receivers.size()) * shortest_us(10, [&] {
                for (size_t i = 0; i < receivers.size(); ++i)
                    out[i] =
                        light::lookUpGlossy(environments[0].light, receivers[i].mirrored, kGlossyRoughness) *
                        methods[m].share(i, environments[0]);
            }));
    }
}

} // namespace shoal::bench
