// Shadows on level ground that a film shows: the game's, in closed form, beside differential rendering
// (Debevec 1998), which renders the ground with the bodies and without them and takes the quotient.
#include "engine/light/FindLights.h"
#include "engine/light/InverseToneMap.h"
#include "engine/light/Lookup.h"
#include "engine/math/LatLong.h"
#include "engine/render/FilmShadows.h"
#include "tests/bench/occlusion/Measure.h"
#include "tests/unit/shadow/ShadowScene.h"

namespace shoal::bench {

namespace {

constexpr float kReach_m = 2; // of the ground that is compared, from below the bodies

// Returns the light that casts shadows in a film's first frame.
render::CastingLight castingLight(const light::RadiancePyramid& radiance) {
    light::FoundLights found;
    light::LightFinder().find(radiance, found);
    light::LightOverTime steady;
    return render::castingLight(steady.follow(found, 0), glm::mat3(1));
}

// A distant light: a direction, and what it brings to level ground, in one unit for all.
struct Distant {
    glm::vec3 towards{0, 1, 0}, power{0};
};

// Cuts what an environment brings to level ground into lights as bright as each other.
std::vector<Distant> lightsOf(const Cells& cells, size_t environment, int count) {
    const auto broughtBy = [&](size_t c) {
        return std::max(cells.cells[c].centre.y, 0.0f) * cells.of(c)[environment];
    };
    double whole = 0, before = 0;
    for (size_t c = 0; c < cells.cells.size(); ++c) whole += light::thesisLuminance(broughtBy(c));
    std::vector<Distant> lights;
    for (size_t c = 0; c < cells.cells.size(); ++c) {
        const float luminance = light::thesisLuminance(broughtBy(c));
        before += luminance;
        while (before * count > (static_cast<double>(lights.size()) + 0.5) * whole)
            lights.push_back({cells.cells[c].centre, broughtBy(c) / luminance});
    }
    return lights;
}

} // namespace

void measureGround(OcclusionChart& chart, const Scene& scene, std::span<const Lit> environments,
                   const Cells& cells, bool quick) {
    const depth::DepthMap map = tests::levelGround();
    const depth::DepthRange range = tests::rangeOf(map);
    const render::FilmSurface film{&map, &range, glm::mat3(1), {0, 0.3f, 1.8f}};
    std::vector<render::View> eyes;
    for (const float turn : {0.0f, 0.5f, 1.0f, 1.5f})
        eyes.push_back({.eyeWorld = film.cameraWorld,
                        .worldFromEye = glm::angleAxis(turn * glm::pi<float>(), glm::vec3(0, 1, 0)),
                        .verticalFov = 3.1f,
                        .aspect = 1});
    std::vector<Receiver> ground;
    std::vector<glm::ivec2> texels; // of the receivers
    const int width = map.inverse.width, height = map.inverse.height;
    int near = 0;
    for (int y = height / 2; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec3 to = texelDirection(x, y, width, height);
            const glm::vec3 place = film.cameraWorld + to * (tests::kGround_m / to.y);
            if (glm::length(glm::vec2(place.x, place.z)) > kReach_m || near++ % (quick ? 500 : 97)) continue;
            ground.push_back({.position = place, .normal = {0, 1, 0}});
            texels.emplace_back(x, y);
        }
    std::vector<std::vector<occlusion::Ellipsoid>> bodies;
    for (const Body& body : scene.bodies) bodies.push_back(ellipsoidsOf(body));
    const Rays rays(scene.meshes());
    const OccludedLight truth = occludedLight(scene, rays, ground, cells);

    chart.ground = {
        {"no shadows"}, {"film shadows of the strongest light alone"}, {"**film shadows** (the game)"}};
    constexpr int kLights[] = {16, 64, 256, 1024};
    for (const int count : kLights)
        chart.ground.push_back({"differential rendering, " + std::to_string(count) + " lights"});
    std::vector<glm::vec3> left(ground.size()); // of the ground's light
    render::FilmShadows shadows;
    for (size_t s = 0; s < environments.size(); ++s) {
        const Lit& lit = environments[s];
        const render::CastingLight light = castingLight(lit.light.radiance);
        if (light.presence == 0) continue;
        ++chart.groundEnvironments;
        const glm::vec3 whole = light::lookUp(lit.light.diffuse, {0, 1, 0});
        const auto compare = [&](GroundMeasured& with) {
            double off = 0, taken = 0;
            for (size_t i = 0; i < ground.size(); ++i) {
                const glm::dvec3 want = truth.diffuse[s][i] / glm::dvec3(whole),
                                 miss = glm::dvec3(left[i]) - want;
                off += glm::dot(miss, miss), taken += glm::dot(1.0 - want, 1.0 - want);
            }
            with.squares += off / taken;
            if (chart.environments[s] == kReef) with.reef = std::sqrt(off / taken);
        };
        std::ranges::fill(left, glm::vec3(1));
        compare(chart.ground[0]);
        const std::array all = {light, render::restBeside(light)};
        for (size_t count = 1; count <= all.size(); ++count) {
            GroundMeasured& with = chart.ground[count];
            const double shadows_us = shortest_us(quick ? 1 : 20, [&] {
                shadows.begin(film, render::FrameCoding::Srgb, {});
                for (const auto& body : bodies)
                    for (const render::CastingLight& each : std::span(all).first(count))
                        shadows.add(body, each, eyes);
            });
            const std::vector<uint8_t>& coded = shadows.remaining().pixels;
            for (size_t i = 0; i < coded.size(); i += 4)
                with.texels += coded[i] + coded[i + 1] + coded[i + 2] < 3 * 255;
            with.spent_ns += 1e3 * shadows_us;
            for (size_t i = 0; i < ground.size(); ++i) {
                const uint8_t* root =
                    shadows.remaining().at(texels[i].x, texels[i].y); // of the light, blue first
                left[i] = glm::vec3(root[2], root[1], root[0]) / 255.0f;
                left[i] *= left[i];
            }
            compare(with);
        }
        for (size_t m = 0; m < std::size(kLights); ++m) {
            const auto lights = lightsOf(cells, s, kLights[m]);
            const double render_us = shortest_us(1, [&] {
                for (size_t i = 0; i < ground.size(); ++i) {
                    glm::vec3 with(0), without(0);
                    for (const Distant& each : lights) {
                        without += each.power;
                        if (!rays.occluded(ground[i].position, each.towards, scene.nearest))
                            with += each.power;
                    }
                    left[i] = with / glm::max(without, 1e-12f);
                }
            });
            chart.ground[m + 3].spent_ns += 1e3 * render_us;
            chart.ground[m + 3].texels += static_cast<double>(ground.size());
            compare(chart.ground[m + 3]);
        }
    }
}

} // namespace shoal::bench
