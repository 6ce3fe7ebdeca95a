// A hand that closes on a fish darkens it smoothly, though its occluders are chosen anew each tick.
#include "Truth.h"
#include "engine/render/BodyOccluders.h"

#include "tests/Test.h"
#include "tests/baselines/occlusion/OccludeByEllipsoids.h"

namespace shoal {
namespace {

constexpr size_t kTicks = 60; // half a second, from wide open to closed
constexpr float kPop = 0.02f; // share of the unoccluded light; a visible change where nothing moves that fast

float curlAt(size_t tick) { return 0.8f * static_cast<float>(tick) / kTicks; }

bool within(const occlusion::Ellipsoid& shape, const glm::vec3& p) {
    const glm::vec3 m = ((p - shape.centre) * shape.worldFromAxes) / shape.semiAxes;
    return glm::dot(m, m) < 1;
}

// Returns the occluders that NearBodies chooses for the first body, as it does for a picture.
std::vector<occlusion::Occluder> nearFirst(const OcclusionScene& scene) {
    render::NearBodies near;
    scene::Pose pose;
    pose.modelFromNode = {glm::mat4(1)};
    for (const SceneBody& body : scene.bodies) {
        render::BodyOccluders parts;
        parts.albedo = body.albedo;
        for (const occlusion::Occluder& part : body.parts) parts.parts.push_back({part.shape, 0});
        near.add(parts, pose, glm::mat4(1), {body.parts[0].shape.centre, 0.25f});
    }
    std::vector<occlusion::Occluder> found;
    for (const render::PackedOccluder& packed : near.near(0, glm::mat3(1)).occluders) {
        // Which of the parts it is, only its strength is new.
        for (const SceneBody& body : scene.bodies)
            for (occlusion::Occluder part : body.parts)
                if (part.shape.centre == glm::vec3(packed.centreStrength)) {
                    part.strength = packed.centreStrength.w;
                    found.push_back(part);
                }
    }
    return found;
}

// Returns the largest change of the light at a point in a tick from tick `first` to `last`, by traced rays.
float trueChange(const ClosingHand& closing, const SurfacePoint& at, const ImageRgbF& light, size_t first,
                 size_t last) {
    float maximum = 0, before = 0;
    for (size_t tick = first; tick <= last; ++tick) {
        const OcclusionScene scene = closing(curlAt(tick));
        const Truth truth(scene, light);
        constexpr int kBounces = 4, kRays = 1024;
        const double open = truth.unoccluded(at.normal).y;
        const auto left = static_cast<float>(1 - truth.lost(at, false, kBounces, kRays).y / open);
        if (tick > first) maximum = std::max(maximum, std::abs(left - before));
        before = left;
    }
    return maximum;
}

TEST(ClosingHand, DarkensAFishWithoutAPop) {
    const ImageRgbF light = reefLight(560);
    const occlusion::SmoothLight smooth = occlusion::smoothLight(light);
    std::vector<SurfacePoint> points;
    std::vector<glm::vec3> open;
    // Share of the unoccluded light that is left, by tick and point.
    std::vector<std::vector<float>> shades(kTicks + 1);
    std::vector<float> means;
    std::vector<bool> swallowed; // by the hand, where nobody sees it
    const ClosingHand closing = closingHand();
    for (size_t tick = 0; tick <= kTicks; ++tick) {
        const OcclusionScene scene = closing(curlAt(tick));
        if (tick == 0) {
            points = scatter(scene, 0, 150);
            const Truth truth(scene, light);
            for (const SurfacePoint& at : points) open.emplace_back(truth.unoccluded(at.normal));
        }
        const auto occluders = nearFirst(scene);
        float left = 0, all = 0;
        for (size_t k = 0; k < points.size(); ++k) {
            swallowed.resize(points.size());
            for (const occlusion::Occluder& part : occluders)
                if (within(part.shape, points[k].position)) swallowed[k] = true;
            const glm::vec3 taken =
                occlusion::occlude(points[k].position, points[k].normal, {}, {}, occluders, smooth).radiance;
            shades[tick].push_back(std::max(0.0f, open[k].y - taken.y) / open[k].y);
            left += std::max(0.0f, open[k].y - taken.y), all += open[k].y;
        }
        means.push_back(left / all);
    }
    float steepest = 0, jump = 0;
    for (size_t tick = 1; tick < means.size(); ++tick)
        steepest = std::max(steepest, std::abs(means[tick] - means[tick - 1]));
    // A pop is a change in one tick that neighbouring ticks do not share and movement does not explain: a
    // fingertip that sweeps by at half a metre a second changes the truth by up to a tenth.
    float worst = 0;
    int explained = 0;
    for (size_t tick = 2; tick + 1 < means.size(); ++tick) {
        const auto step = [&](size_t at) { return means[at] - means[at - 1]; };
        jump = std::max(jump, std::abs(step(tick) - (step(tick - 1) + step(tick + 1)) / 2));
        for (size_t k = 0; k < points.size(); ++k) {
            if (swallowed[k]) continue;
            const auto own = [&](size_t at) { return shades[at][k] - shades[at - 1][k]; };
            const float pop = std::abs(own(tick) - (own(tick - 1) + own(tick + 1)) / 2);
            worst = std::max(worst, pop);
            if (pop <= kPop) continue;
            ++explained;
            EXPECT_LT(pop, trueChange(closing, points[k], light, tick - 2, tick + 1)) << tick << ' ' << k;
        }
    }
    std::printf("[ BODIES ] closing hand: light on the fish from %.3f to %.3f; a tick changes it by %.4f at "
                "most, a pop by %.4f, at the worst point by %.3f; above %.2f %d times\n",
                means.front(), means.back(), steepest, jump, worst, kPop, explained);
    EXPECT_LT(means.back(), 0.9f * means.front());
    EXPECT_LT(steepest, kPop);
    EXPECT_LT(jump, 0.01f);
    EXPECT_LT(worst, 0.03f); // where a finger's ellipsoid slides off a point
    EXPECT_LE(explained, 3);
}

} // namespace
} // namespace shoal
