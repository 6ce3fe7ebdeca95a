#include "engine/core/Random.h"
#include "tests/baselines/occlusion/OllfbThesis.h"
#include "tests/baselines/occlusion/TracedOllfb.h"
#include "tests/baselines/occlusion/Visibility.h"
#include "tests/bench/occlusion/LayeredBodies.h"
#include "tests/bench/occlusion/Measure.h"

namespace shoal::bench {

namespace {

constexpr int kBounces[] = {1, 2, 8};

// Returns radiance with detail down to a tenth of a radian, so that a wrong direction shows.
double environmentAt(const glm::vec3& d) {
    return 1 + 0.5 * std::sin(9 * static_cast<double>(d.x) + 3 * static_cast<double>(d.y)) *
                   std::sin(8 * static_cast<double>(d.y) - 5 * static_cast<double>(d.z));
}

// A ray from a body's surface, in the direction of the mirrored eye or from an even set over the hemisphere.
struct Question {
    glm::vec3 origin{0}, direction{0};
    bool hits = false;
    double seen[3] = {0, 0, 0}; // by kBounces
};

struct Asked {
    std::vector<Question> questions;
    float nearest = 0;
};

Asked ask(const Scene& scene, const Rays& rays, int count) {
    Asked asked;
    asked.nearest = 0.01f * occlusion::boundingSphere(scene.bodies[0].posed.view()).radius;
    Random random(3);
    for (const Receiver& at : spreadReceivers(scene, count)) {
        if (glm::dot(at.mirrored, at.normal) <= 0) continue;
        // Skips points buried in another part, which nobody sees: every direction hits something near.
        int near = 0;
        for (const glm::vec3& axis : {at.normal, glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)})
            near += rays.occluded(at.position, axis, scene.nearest) &&
                    rays.occluded(at.position, -axis, scene.nearest);
        if (near == 4) continue;
        Question question{at.position, at.mirrored};
        question.hits = rays.occluded(question.origin, question.direction, asked.nearest);
        for (int k = 0; k < 3; ++k)
            question.seen[k] =
                environmentAt(occlusion::followMirrors(rays, question.origin, question.direction,
                                                       asked.nearest, kBounces[k])
                                  .direction);
        asked.questions.push_back(question);
    }
    return asked;
}

template <class Buffers>
LayerQuality measured(const Scene& scene, const Asked& asked, const char* name, int views,
                      const typename Buffers::Options& options) {
    LayerQuality out{.body = scene.name, .method = name, .views = views, .resolution = options.resolution};
    const double begin = now_us();
    const LayeredBodies<Buffers> bodies(scene, options);
    out.build_ms = 1e-3 * (now_us() - begin);
    out.bytes = bodies.bytes();
    double off[3] = {0, 0, 0}, whole = 0;
    for (const Question& each : asked.questions) {
        out.gaps += bodies.trace(each.origin, each.direction, asked.nearest).has_value() != each.hits;
        for (int k = 0; k < 3; ++k) {
            const double seen = environmentAt(
                occlusion::followMirrors(bodies, each.origin, each.direction, asked.nearest, kBounces[k])
                    .direction);
            off[k] += (seen - each.seen[k]) * (seen - each.seen[k]);
        }
        whole += each.seen[0] * each.seen[0];
    }
    const auto count = static_cast<double>(asked.questions.size());
    out.gaps /= count;
    for (int k = 0; k < 3; ++k) out.bounced[k] = std::sqrt(off[k] / whole);
    size_t hits = 0;
    out.ray_ns = 1e3 / count * shortest_us(5, [&] {
                     for (const Question& each : asked.questions)
                         hits += bodies.trace(each.origin, each.direction, asked.nearest).has_value();
                 });
    if (hits == ~size_t{0}) out.ray_ns = 0; // the sum is needed
    return out;
}

} // namespace

std::vector<LayerQuality> measureLayers(std::span<const Scene> scenes, bool quick) {
    std::vector<LayerQuality> all;
    for (const Scene& scene : scenes) {
        if (scene.bodies.size() > 1) continue;
        const Rays rays(scene.meshes());
        const Asked asked = ask(scene, rays, quick ? 1000 : 3000);
        for (const int resolution : {32, 64})
            for (const int cells : {3, 5, 9})
                all.push_back(measured<occlusion::OllfbThesis>(scene, asked, "thesis", 6 * cells * cells,
                                                               {.cells = cells, .resolution = resolution}));
        for (const int resolution : {32, 64})
            for (const int views : {54, 150, 486})
                all.push_back(measured<occlusion::TracedOllfb>(scene, asked, "cured", views,
                                                               {.views = views, .resolution = resolution}));
    }
    return all;
}

} // namespace shoal::bench
