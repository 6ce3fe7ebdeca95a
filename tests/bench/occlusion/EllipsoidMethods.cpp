// The game's method: bodies as ellipsoids on their joints, which hide the ends of a few axes.
#include "content/make/models/occlusion/FitEllipsoids.h"
#include "content/make/models/occlusion/TraceSelfOcclusion.h"
#include "engine/light/Lookup.h"
#include "tests/baselines/occlusion/OccludeByEllipsoids.h"
#include "tests/bench/occlusion/Method.h"

namespace shoal::bench {

namespace {

constexpr int kRays = 6; // at each of three points in a triangle, as the game self-occlusion

constexpr size_t kHunterParts = 12, kBodyParts = 4; // as the game fits them

occlusion::Ellipsoid moved(const occlusion::Ellipsoid& at, const glm::mat4& to) {
    occlusion::Ellipsoid out = at;
    const float scale = std::cbrt(std::abs(glm::determinant(glm::mat3(to))));
    out.centre = glm::vec3(to * glm::vec4(at.centre, 1));
    out.worldFromAxes = glm::mat3(to) * at.worldFromAxes / scale;
    out.semiAxes = scale * at.semiAxes;
    return out;
}

// Returns the parts of a body, by bone.
std::vector<occlusion::BodyPart> partsOf(const Body& body) {
    if (!body.parts.empty()) return body.parts;
    const std::vector<uint16_t> joints(body.boneOf.begin(), body.boneOf.end());
    std::vector<uint32_t> indices;
    for (const glm::uvec3& t : body.rest.triangles) indices.insert(indices.end(), {t.x, t.y, t.z});
    return occlusion::fitEllipsoids({body.rest.positions, indices, joints}, occlusion::Parts::ByShape,
                                    body.name == "shark" ? kHunterParts : kBodyParts);
}

// Returns the ellipsoid posed in the world.
occlusion::Occluder posed(const occlusion::BodyPart& part, const Body& body) {
    return {moved(part.atRest, body.worldFromRest[part.joint]), 1, body.sentBack};
}

struct State {
    const Scene* scene = nullptr;
    const ImageRgbF* map = nullptr;
    occlusion::SmoothLight smooth;
    std::vector<std::vector<occlusion::Occluder>> others, own; // [body]: what takes its light
    std::vector<std::vector<glm::vec4>> selfOcclusion;         // [body][vertex]: world; empty without
    size_t parts = 0;
};

std::vector<glm::vec4> selfOcclusionOf(const Mesh& mesh) {
    std::vector<uint32_t> indices;
    for (const glm::uvec3& t : mesh.triangles) indices.insert(indices.end(), {t.x, t.y, t.z});
    return occlusion::traceSelfOcclusion({mesh.positions, mesh.normals, indices}, kRays);
}

// Rotates self-occlusion as the skin rotates the vertex, without its scale.
glm::vec4 turned(const glm::mat3& by, const glm::vec4& selfOcclusion) {
    const glm::vec3 to = by * glm::vec3(selfOcclusion);
    const float length = glm::length(to);
    return {length > 0 ? to * (glm::length(glm::vec3(selfOcclusion)) / length) : glm::vec3(0),
            selfOcclusion.w};
}

void build(State& state, const Scene& scene, Casting casting) {
    state = {.scene = &scene};
    state.others = castingOnOthers(scene);
    state.own.resize(scene.bodies.size());
    for (size_t b = 0; b < scene.bodies.size(); ++b) {
        const Body& body = scene.bodies[b];
        const bool onItself = casting == Casting::All && !body.parts.empty();
        for (const occlusion::BodyPart& part : partsOf(body)) {
            ++state.parts;
            if (onItself) state.own[b].push_back(posed(part, body));
        }
        if (casting == Casting::Others) continue;
        auto selfOcclusion = onItself ? body.selfOcclusionBesideOwn : selfOcclusionOf(body.rest);
        for (size_t v = 0; v < selfOcclusion.size(); ++v)
            selfOcclusion[v] = turned(body.turned[v], selfOcclusion[v]);
        state.selfOcclusion.push_back(std::move(selfOcclusion));
    }
}

const OcclusionLabel kLabels[] = {
    {"ellipsoids of other bodies", "ellipsoids", "ellipsoids on joints", "engine/occlusion"},
    {"ellipsoids of other bodies, folds at rest", "ellipsoids, folds", "ellipsoids on joints",
     "engine/occlusion"},
    {"ellipsoids of other bodies and of a hand's own, folds at rest", "ellipsoids, folds, own",
     "ellipsoids on joints", "engine/occlusion", Part::Game}};

} // namespace

std::vector<occlusion::Ellipsoid> ellipsoidsOf(const Body& body) {
    std::vector<occlusion::Ellipsoid> all;
    for (const occlusion::BodyPart& part : partsOf(body))
        all.push_back(moved(part.atRest, body.worldFromRest[part.joint]));
    return all;
}

std::vector<std::vector<occlusion::Occluder>> castingOnOthers(const Scene& scene) {
    std::vector<std::vector<occlusion::Occluder>> casting(scene.bodies.size());
    for (size_t b = 0; b < scene.bodies.size(); ++b)
        for (const occlusion::BodyPart& part : partsOf(scene.bodies[b]))
            for (size_t other = 0; other < scene.bodies.size(); ++other)
                if (other != b) casting[other].push_back(posed(part, scene.bodies[b]));
    return casting;
}

OcclusionMethod ellipsoids(Casting casting) {
    const auto state = std::make_shared<State>();
    return {kLabels[static_cast<size_t>(casting)],
            [=](const Scene& scene, const Rays&) { build(*state, scene, casting); },
            [=] {
                size_t bytes = state->parts * sizeof(occlusion::BodyPart);
                for (const auto& each : state->selfOcclusion) bytes += each.size() * sizeof(glm::vec4);
                return bytes;
            },
            [=](const Lit& lit) {
                state->map = &lit.light.diffuse;
                const auto small = std::ranges::find_if(
                    lit.light.radiance.levels, [](const ImageRgbF& level) { return level.width <= 32; });
                state->smooth = occlusion::smoothLight(*small);
            },
            [=](std::span<const Receiver> at, std::span<glm::vec3> out) {
                for (size_t i = 0; i < at.size(); ++i) {
                    const size_t body = at[i].body;
                    occlusion::SelfOcclusion selfOcclusion{glm::vec4(0), state->scene->bodies[body].sentBack};
                    if (!state->selfOcclusion.empty())
                        selfOcclusion.hidden = at[i].mix(state->selfOcclusion[body]);
                    const glm::vec3 open = light::lookUp(*state->map, at[i].normal);
                    const auto taken = occlusion::occlude(at[i].position, at[i].normal, state->own[body],
                                                          selfOcclusion, state->others[body], state->smooth);
                    out[i] = glm::max(open - taken.radiance, 0.0f);
                }
            },
            OcclusionMethod::Moves::Free};
}

} // namespace shoal::bench
