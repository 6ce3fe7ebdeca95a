#include "engine/render/NearBodies.h"

#include "shaders/render/Attributes.glsl"

#include <algorithm>

namespace shoal::render {

namespace {

// Of the cosine-weighted hemisphere: less is not worth a look, and twice as much counts in full.
constexpr float kLeastShare = 0.01f;

float smoothstep(float from, float to, float x) {
    const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

PackedOccluder pack(const occlusion::Ellipsoid& shape, const glm::mat3& lightFromWorld, float strength,
                    const glm::vec3& albedo) {
    glm::mat3 scaled = lightFromWorld * shape.worldFromAxes;
    const glm::vec3& a = shape.semiAxes;
    for (int k = 0; k < 3; ++k) scaled[k] /= a[k];
    const glm::mat3 square = scaled * glm::transpose(scaled);
    return {.centreStrength = {lightFromWorld * shape.centre, strength},
            .diagonalVolume = {square[0][0], square[1][1], square[2][2], a.x * a.y * a.z},
            .mixed = {square[1][2], square[2][0], square[0][1], 0},
            .albedo = {albedo, 0}};
}

} // namespace

void NearBodies::clear() {
    parts_.clear();
    bodies_.clear();
}

size_t NearBodies::add(const BodyOccluders& body, const scene::Pose& pose, const glm::mat4& worldFromModel,
                       const Ball& bound) {
    placed_.clear();
    for (const BodyOccluders::Part& part : body.parts) placed_.push_back(placed(part, pose, worldFromModel));
    bodies_.push_back({bound, parts_.size(), body.parts.size(), body.albedo, ownStrength(body, placed_)});
    for (const auto& shape : placed_) {
        const glm::vec3& a = shape.semiAxes;
        const float least = std::min({a.x, a.y, a.z});
        parts_.push_back(
            {shape, std::max({a.x, a.y, a.z}), std::sqrt(a.x * a.y * a.z / std::max(least, 1e-9f))});
    }
    return bodies_.size() - 1;
}

NearBodies::Near NearBodies::near(size_t receiver, const glm::mat3& lightFromWorld) {
    found_.clear();
    packed_.clear();
    const Body& self = bodies_[receiver];
    const std::span own(parts_.data() + self.first, self.count);
    for (size_t b = 0; b < bodies_.size(); ++b) {
        const Body& body = bodies_[b];
        // Beyond this even all of it takes less than is worth a look.
        const float apart = glm::distance(body.bound.centre, self.bound.centre) - self.bound.radius;
        if (b == receiver || apart * apart * kLeastShare > body.bound.radius * body.bound.radius) continue;
        for (size_t p = body.first; p < body.first + body.count; ++p) {
            const Part& part = parts_[p];
            float nearest = INFINITY;
            for (const Part& mine : own)
                nearest = std::min(nearest, glm::distance(part.shape.centre, mine.shape.centre) - mine.reach);
            // Counted from its middle, so that it goes on growing once they touch.
            const float away = std::max(nearest + part.size, 0.2f * part.size);
            const float share = part.size * part.size / (away * away);
            if (share > kLeastShare) found_.push_back({share, p, b});
        }
    }
    constexpr size_t kMost = MAX_OTHERS;
    float least = kLeastShare;
    if (found_.size() > kMost) {
        std::partial_sort(found_.begin(), found_.begin() + kMost + 1, found_.end(),
                          [](const Found& a, const Found& b) { return a.share > b.share; });
        least = found_[kMost].share;
        found_.resize(kMost);
    }
    if (self.ownStrength > 0)
        for (const Part& mine : own.first(std::min<size_t>(own.size(), MAX_OCCLUDERS - MAX_OTHERS)))
            packed_.push_back(pack(mine.shape, lightFromWorld, self.ownStrength, self.albedo));
    const size_t ownCount = packed_.size();
    for (const Found& found : found_)
        packed_.push_back(pack(parts_[found.part].shape, lightFromWorld,
                               smoothstep(least, std::max(2 * kLeastShare, 1.3f * least), found.share),
                               bodies_[found.body].albedo));
    return {packed_, ownCount, self.ownStrength};
}

} // namespace shoal::render
