#include "content/make/models/shade/HandShade.h"

#include "engine/render/FoldModel.h"
#include "engine/scene/LoadModel.h"
#include "engine/scene/Surface.h"

#include <glm/gtc/matrix_transform.hpp>

namespace shoal::make {

namespace {

constexpr int kRays = 96; // from each of three points in a triangle
constexpr size_t kParts = 20;
constexpr float kHalf = 0.45f; // curl: as most of what a hand's own parts count for is

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
    const scene::Surface surface = scene::posedSurface(hand.model, hand.rest);
    return occlusion::fitEllipsoids({surface.positions, surface.indices, surface.nodesOf},
                                    occlusion::Parts::ByJoint, kParts);
}

render::BakedShade foldHand(Hand hand, const std::vector<occlusion::BodyPart>& parts) {
    hands::HandShape half;
    half.curl.fill(kHalf);
    render::foldModel(hand.model, hand.rest, kRays);
    render::foldBesideOwn(hand.model, hand.closed(half),
                          render::makeBodyOccluders(hand.model, hand.rest, parts, true), kRays);
    return render::shadeOf(hand.model, parts);
}

} // namespace shoal::make
