#include "content/make/models/occlusion/HandOcclusion.h"

#include "content/make/models/occlusion/FitToHidden.h"
#include "content/make/models/occlusion/Silhouettes.h"
#include "engine/render/BodyOccluders.h"
#include "engine/scene/Model.h"
#include "engine/scene/Surface.h"

#include <fmt/core.h>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::make {

namespace {

constexpr int kHandRays = 192; // from each of three points in a triangle
constexpr size_t kCreatureRays = 64, kMinRays = 2;
constexpr size_t kMaxRays = 3'000'000; // of a whole creature: a few seconds
constexpr size_t kParts = 20, kCreatureParts = 4, kHunterParts = 12,
                 kArmParts = 5; // maximum number of ellipsoids
constexpr int kPlaces = 4000;   // around each pose
// A half closed hand, for which its own parts count most, and one that is nearly a fist.
const hands::HandShape kHalf{{0.45f, 0.45f, 0.45f, 0.45f, 0.45f}, 0},
    kClosed{{0.65f, 0.75f, 0.75f, 0.75f, 0.75f}, 0};

using nlohmann::json;

json numbers(const float* values, int count) {
    constexpr double kDigits = 1e7;
    json list = json::array();
    for (int i = 0; i < count; ++i)
        list.push_back(std::round(static_cast<double>(values[i]) * kDigits) / kDigits);
    return list;
}

json steps(const std::vector<glm::vec4>& selfOcclusion) {
    json list = json::array();
    for (const glm::vec4& vertex : selfOcclusion)
        for (int i = 0; i < 4; ++i) {
            const auto step = std::lround(static_cast<double>(vertex[i]) * render::kSelfOcclusionSteps);
            list.push_back(std::clamp(static_cast<int>(step), -render::kMaxSelfOcclusionSteps,
                                      render::kMaxSelfOcclusionSteps));
        }
    return list;
}

// Traces the self-occlusion of the model in this pose, in its frame.
std::vector<glm::vec4> traced(const scene::Surface& surface, int rays) {
    return occlusion::traceSelfOcclusion({surface.positions, surface.normals, surface.opaque}, rays);
}

// Turns self-occlusion that was traced in this pose into the frames of the meshes, where it goes along with
// the joints. A surface that is blended, or whose material brings a map of its occlusion, gets none.
std::vector<glm::vec4> inMeshFrames(const scene::Model& model, const scene::Pose& pose,
                                    std::vector<glm::vec4> traced) {
    std::vector<glm::mat4> joints;
    auto next = traced.begin(); // in the surface's order
    for (const int index : model.order) {
        const auto n = static_cast<size_t>(index);
        const scene::Node& node = model.nodes[n];
        if (node.mesh < 0) continue;
        if (node.skin >= 0) scene::skinMatrices(model, node.skin, pose, joints);
        for (const scene::Primitive& primitive : model.meshes[static_cast<size_t>(node.mesh)].primitives) {
            const scene::Material& material = model.materialOf(primitive);
            const bool none =
                material.occlusion.texture >= 0 || material.alphaMode == scene::AlphaMode::Blend;
            const bool skinned = node.skin >= 0 && !primitive.joints.empty();
            for (size_t v = 0; v < primitive.positions.size(); ++v, ++next) {
                const glm::mat3 meshFromModel = glm::inverse(
                    glm::mat3(skinned ? scene::skinMatrix(primitive, v, joints) : pose.modelFromNode[n]));
                const glm::vec3 to = meshFromModel * glm::vec3(*next); // turned, and not scaled
                const float length = glm::length(to), kept = glm::length(glm::vec3(*next));
                *next = none ? glm::vec4(0)
                             : glm::vec4(length > 0 ? to * (kept / length) : glm::vec3(0), next->w);
            }
        }
    }
    return traced;
}

// Traces a creature in its rest pose, or with its mouth open if it bites, because the inside must not glow.
std::vector<glm::vec4> selfOccludeCreature(const scene::Model& model, scene::Pose pose) {
    if (const int bite = model.findAnimation("bite"); bite >= 0)
        scene::animate(model, bite, 0.4f * model.animations[static_cast<size_t>(bite)].duration_s, pose);
    scene::updateGlobals(model, pose);
    const scene::Surface surface = scene::posedSurface(model, pose);
    const size_t rays = std::min(kMaxRays / std::max<size_t>(surface.indices.size(), 1), kCreatureRays);
    return inMeshFrames(model, pose, traced(surface, rays < kMinRays ? 0 : static_cast<int>(rays)));
}

} // namespace

scene::Pose Hand::closed(const hands::HandShape& shape) const {
    scene::Pose pose = rest;
    const hands::HandPose joints = rig.pose(side, shape, {});
    for (size_t k = 0; k < hands::kJointNames.size(); ++k)
        pose.modelFromNode[static_cast<size_t>(model.findNode(std::string(hands::kJointNames[k])))] =
            glm::translate(glm::mat4(1), joints.joints[k].position) *
            glm::mat4_cast(joints.joints[k].orientation);
    return pose;
}

Result<Hand> loadHand(const Path& models, hands::Side side) {
    const Path file = models / (side == hands::Side::Left ? "hand_left.glb" : "hand_right.glb");
    auto model = scene::loadModel(file);
    if (!model) return model.error();
    auto rig = hands::HandRig::load(models / "hand_skeleton.json");
    if (!rig) return rig.error();
    for (const std::string_view joint : hands::kJointNames)
        if (model->findNode(std::string(joint)) < 0)
            return Error{file.string(), "has no joint named " + std::string(joint)};
    Hand hand{std::move(*model), {}, std::move(*rig), side};
    scene::restPose(hand.model, hand.rest);
    scene::updateGlobals(hand.model, hand.rest);
    return hand;
}

std::vector<occlusion::BodyPart> fitHand(const Hand& hand) {
    const scene::Surface atRest = scene::posedSurface(hand.model, hand.rest);
    std::vector<occlusion::BodyPart> parts = occlusion::fitEllipsoids(
        {atRest.positions, atRest.indices, atRest.nodesOf}, occlusion::Parts::ByJoint, kParts);
    const auto around = [&](const scene::Pose& pose, uint64_t seed) {
        std::vector<glm::mat4> posedFromRest;
        for (size_t node = 0; node < pose.modelFromNode.size(); ++node)
            posedFromRest.push_back(pose.modelFromNode[node] * glm::inverse(hand.rest.modelFromNode[node]));
        return lookAround(scene::posedSurface(hand.model, pose), std::move(posedFromRest), {}, kPlaces, seed);
    };
    // Any seeds would do. Of those tried, these give the fit that changes most smoothly while the hand closes
    // on a fish (tests/accuracy/occlusion/NoPopTest.cpp).
    fitToHidden(parts,
                {around(hand.rest, 10), around(hand.closed(kHalf), 11), around(hand.closed(kClosed), 12)});
    return parts;
}

std::vector<occlusion::BodyPart> mirrored(std::vector<occlusion::BodyPart> parts) {
    for (occlusion::BodyPart& part : parts) {
        occlusion::Ellipsoid& shape = part.atRest;
        shape.centre.x = -shape.centre.x;
        for (int axis = 0; axis < 3; ++axis) shape.worldFromAxes[axis].x = -shape.worldFromAxes[axis].x;
        shape.worldFromAxes[0] = -shape.worldFromAxes[0]; // right-handed again
    }
    return parts;
}

render::BakedOcclusion selfOccludeHand(const Hand& hand, const std::vector<occlusion::BodyPart>& parts) {
    const scene::Pose half = hand.closed(kHalf);
    std::vector<occlusion::Occluder> own;
    for (const auto& part : render::makeBodyOccluders(hand.model, hand.rest, parts, true).parts)
        own.push_back({placed(part, half, glm::mat4(1)), 1, {}});
    const scene::Surface atRest = scene::posedSurface(hand.model, hand.rest);
    const scene::Surface surface = scene::posedSurface(hand.model, half);
    std::vector<glm::vec4> besideOwn = traced(surface, kHandRays);
    occlusion::completeOwn({surface.positions, surface.normals, surface.opaque}, own, besideOwn);
    return {render::skinHash(hand.model), parts,
            inMeshFrames(hand.model, hand.rest, traced(atRest, kHandRays)),
            inMeshFrames(hand.model, half, std::move(besideOwn))};
}

Result<render::BakedOcclusion> fitCreature(const Path& file) {
    const auto model = scene::loadModel(file);
    if (!model) return model.error();
    scene::Pose rest;
    scene::restPose(*model, rest);
    scene::Surface surface = scene::posedSurface(*model, rest);
    const bool arm = model->findNode("forearm") >= 0, drifts = model->findNode("weed") >= 0;
    // Seaweed is thin and hides little, and would be near every hand.
    std::vector<uint32_t> solid;
    for (size_t i = 0; i < surface.indices.size(); i += 3)
        if (!model->nodes[surface.nodesOf[surface.indices[i]]].name.starts_with("weed"))
            solid.insert(solid.end(), &surface.indices[i], &surface.indices[i] + 3);
    surface.indices = std::move(solid);
    const size_t maximum = arm                                ? kArmParts
                           : drifts                           ? 1
                           : model->findAnimation("bite") < 0 ? kCreatureParts
                                                              : kHunterParts;
    return render::BakedOcclusion{
        render::skinHash(*model),
        occlusion::fitEllipsoids({surface.positions, surface.indices, surface.nodesOf},
                                 arm ? occlusion::Parts::ByJoint : occlusion::Parts::ByShape, maximum),
        selfOccludeCreature(*model, rest),
        {}};
}

std::string written(const render::BakedOcclusion& baked) {
    std::string text = fmt::format("{{\"skin\": \"{:016x}\",\n\"ellipsoids\": [", baked.skin);
    for (size_t k = 0; k < baked.parts.size(); ++k) {
        const occlusion::Ellipsoid& shape = baked.parts[k].atRest;
        const glm::quat turn = glm::normalize(glm::quat_cast(shape.worldFromAxes));
        const float xyzw[] = {turn.x, turn.y, turn.z, turn.w};
        const json part = {{"node", baked.parts[k].joint},
                           {"centre", numbers(&shape.centre.x, 3)},
                           {"turn", numbers(xyzw, 4)},
                           {"semiAxes", numbers(&shape.semiAxes.x, 3)}};
        text += (k ? ",\n" : "\n") + part.dump();
    }
    return text + "],\n\"selfOcclusion\": " + steps(baked.selfOcclusion).dump() +
           ",\n\"selfOcclusionBesideOwn\": " + steps(baked.besideOwn).dump() + "}\n";
}

} // namespace shoal::make
