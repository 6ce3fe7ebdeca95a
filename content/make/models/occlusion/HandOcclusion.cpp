#include "content/make/models/occlusion/HandOcclusion.h"

#include "content/make/models/occlusion/FitToHidden.h"
#include "engine/render/BakedOcclusion.h"
#include "engine/scene/LoadModel.h"
#include "engine/scene/Surface.h"

#include <glm/gtc/matrix_transform.hpp>

namespace shoal::make {

namespace {

constexpr int kRays = 192; // from each of three points in a triangle
constexpr size_t kParts = 20;
constexpr int kPlaces = 4000; // around each pose
// As most of what a hand's own parts count for is; and nearly a fist.
const hands::HandShape kHalf{{0.45f, 0.45f, 0.45f, 0.45f, 0.45f}, 0},
    kClosed{{0.65f, 0.75f, 0.75f, 0.75f, 0.75f}, 0};

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
    fitToHidden(parts,
                {around(hand.rest, 1), around(hand.closed(kHalf), 2), around(hand.closed(kClosed), 3)});
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

render::BakedOcclusion selfOccludeHand(Hand hand, const std::vector<occlusion::BodyPart>& parts) {
    render::bakeSelfOcclusion(hand.model, hand.rest, kRays);
    render::bakeSelfOcclusionBesideOwn(hand.model, hand.closed(kHalf),
                                       render::makeBodyOccluders(hand.model, hand.rest, parts, true), kRays);
    return render::bakedOcclusionOf(hand.model, parts);
}

} // namespace shoal::make
