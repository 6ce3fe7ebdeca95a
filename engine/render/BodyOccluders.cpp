#include "engine/render/BodyOccluders.h"

#include "engine/scene/Surface.h"
#include "shaders/render/Attributes.glsl"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::render {

namespace {

// Parts that cover less of the cosine-weighted hemisphere are left out; at twice this share their strength is
// 1. With 0.01, pictures of the dives differ by at most 0.9 of 255, root mean square over objects.
constexpr float kMinShare = 0.015f;

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

// Limits of a part's displacement from the first part, divided by the body's length: below kStill it counts
// as at rest, from kBent on as bent. An idle hand's fingers move 0.12, those that hold a fish more than 0.3.
constexpr float kStill = 0.15f, kBent = 0.3f;

occlusion::Ellipsoid transformed(const occlusion::Ellipsoid& e, const glm::mat4& to) {
    const glm::mat3 m(to);
    const float scale = std::cbrt(std::abs(glm::determinant(m)));
    occlusion::Ellipsoid out = e;
    out.centre = glm::vec3(to * glm::vec4(e.centre, 1));
    out.worldFromAxes = m * e.worldFromAxes;
    for (int k = 0; k < 3; ++k) out.worldFromAxes[k] = glm::normalize(out.worldFromAxes[k]);
    out.semiAxes = e.semiAxes * scale;
    return out;
}

glm::vec3 seenFrom(const occlusion::Ellipsoid& part, const glm::vec3& place) {
    return (place - part.centre) * part.worldFromAxes; // the product with the transposed matrix
}

} // namespace

void NearBodies::clear() {
    shapes_.clear();
    sizes_.clear();
    bodies_.clear();
}

size_t NearBodies::add(const BodyOccluders& body, const scene::Pose& pose, const glm::mat4& worldFromModel,
                       const Sphere& bound) {
    const size_t first = shapes_.size();
    for (const BodyOccluders::Part& part : body.parts) {
        const occlusion::Ellipsoid& shape = shapes_.emplace_back(placed(part, pose, worldFromModel));
        const glm::vec3& a = shape.semiAxes;
        const float minimum = std::min({a.x, a.y, a.z});
        sizes_.push_back({std::max({a.x, a.y, a.z}), std::sqrt(a.x * a.y * a.z / std::max(minimum, 1e-9f))});
    }
    bodies_.push_back(
        {bound, first, body.parts.size(), body.albedo, ownStrength(body, std::span(shapes_).subspan(first))});
    return bodies_.size() - 1;
}

NearBodies::Near NearBodies::near(size_t receiver, const glm::mat3& lightFromWorld) {
    found_.clear();
    packed_.clear();
    const Body& self = bodies_[receiver];
    const std::span own = ellipsoids(receiver);
    for (size_t b = 0; b < bodies_.size(); ++b) {
        const Body& body = bodies_[b];
        // At a greater distance than this, even the whole body covers less than kMinShare.
        const float apart = glm::distance(body.bound.centre, self.bound.centre) - self.bound.radius;
        if (b == receiver || apart * apart * kMinShare > body.bound.radius * body.bound.radius) continue;
        for (size_t p = body.first; p < body.first + body.count; ++p) {
            const Size& part = sizes_[p];
            float nearest = INFINITY;
            for (size_t mine = 0; mine < own.size(); ++mine)
                nearest = std::min(nearest, glm::distance(shapes_[p].centre, own[mine].centre) -
                                                sizes_[self.first + mine].reach);
            // Adds the part's size to the distance, so that the share still grows when the bodies overlap.
            const float away = std::max(nearest + part.size, 0.2f * part.size);
            const float share = part.size * part.size / (away * away);
            if (share > kMinShare) found_.push_back({share, p, b});
        }
    }
    constexpr size_t kMax = MAX_OTHERS;
    float minimum = kMinShare;
    if (found_.size() > kMax) {
        std::partial_sort(found_.begin(), found_.begin() + kMax + 1, found_.end(),
                          [](const Found& a, const Found& b) { return a.share > b.share; });
        minimum = found_[kMax].share;
        found_.resize(kMax);
    }
    if (self.ownStrength > 0)
        for (const auto& mine : own.first(std::min<size_t>(own.size(), MAX_OCCLUDERS - MAX_OTHERS)))
            packed_.push_back(pack(mine, lightFromWorld, self.ownStrength, self.albedo));
    const size_t ownCount = packed_.size();
    for (const Found& found : found_)
        packed_.push_back(pack(shapes_[found.part], lightFromWorld,
                               glm::smoothstep(minimum, std::max(2 * kMinShare, 1.3f * minimum), found.share),
                               bodies_[found.body].albedo));
    return {packed_, ownCount, self.ownStrength};
}

BodyOccluders makeBodyOccluders(const scene::Model& model, const scene::Pose& rest,
                                std::span<const occlusion::BodyPart> parts, bool occludesItself) {
    BodyOccluders body;
    body.albedo = scene::meanBaseColour(model);
    body.occludesItself = occludesItself;
    for (const occlusion::BodyPart& part : parts) {
        const glm::mat4 nodeFromModel = glm::inverse(rest.modelFromNode[part.joint]);
        body.parts.push_back({transformed(part.atRest, nodeFromModel), part.joint});
    }
    std::vector<occlusion::Ellipsoid> atRest;
    for (BodyOccluders::Part& part : body.parts) {
        atRest.push_back(placed(part, rest, glm::mat4(1)));
        part.atRest = seenFrom(atRest[0], atRest.back().centre);
        for (const auto& other : atRest)
            body.length = std::max(body.length, glm::distance(other.centre, atRest.back().centre));
    }
    return body;
}

float ownStrength(const BodyOccluders& body, std::span<const occlusion::Ellipsoid> parts) {
    if (!body.occludesItself || parts.empty() || body.length <= 0) return 0;
    const float scale = parts[0].semiAxes.x / body.parts[0].inNode.semiAxes.x;
    float moved = 0;
    for (size_t k = 0; k < parts.size(); ++k)
        moved =
            std::max(moved, glm::distance(seenFrom(parts[0], parts[k].centre), scale * body.parts[k].atRest));
    return glm::smoothstep(kStill, kBent, moved / (scale * body.length));
}

occlusion::Ellipsoid placed(const BodyOccluders::Part& part, const scene::Pose& pose,
                            const glm::mat4& worldFromModel) {
    return transformed(part.inNode, worldFromModel * pose.modelFromNode[static_cast<size_t>(part.node)]);
}

} // namespace shoal::render
