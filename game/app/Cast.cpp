#include "game/app/Cast.h"

#include "engine/render/BakedShade.h"
#include "engine/render/FoldModel.h"
#include "engine/scene/Roughness.h"
#include "input/hands/HandRig.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <future>

namespace shoal::app {

namespace {

constexpr std::array kPectorals = {"pectoral_left", "pectoral_right"}; // joints that models may have
constexpr float kLeastSwing = 0.01f; // of a clip's tail, body lengths: below, it has no wave to scale
constexpr size_t kBodyParts = 4, kHunterParts = 12, kHandParts = 20; // ellipsoids that take light from others
constexpr float kMostScale = 2.5f;                                   // more would fold it

// The clip's time for this phase: clips loop.
float clipTime(const scene::Animation& clip, float phase_s) {
    if (clip.duration_s <= 0) return 0;
    const float wrapped = std::fmod(phase_s, clip.duration_s);
    return wrapped < 0 ? wrapped + clip.duration_s : wrapped;
}

int biteOf(const scene::Model& model) {
    return model.findAnimation(game::kMotionNames[static_cast<size_t>(game::Motion::Bite)]);
}

size_t mostParts(const scene::Model& model, occlusion::Parts parts) {
    return parts == occlusion::Parts::ByJoint ? kHandParts : biteOf(model) < 0 ? kBodyParts : kHunterParts;
}

constexpr int kFoldRays = 6, kGripRays = 12; // more where folds are deep

// At rest, but what bites with its mouth open, which must not glow: closed, nobody looks into it.
void foldBody(scene::Model& model) {
    const int bite = biteOf(model);
    scene::Pose pose;
    scene::restPose(model, pose);
    if (bite >= 0)
        scene::animate(model, bite, 0.4f * model.animations[static_cast<size_t>(bite)].duration_s, pose);
    scene::updateGlobals(model, pose);
    render::foldModel(model, pose, kFoldRays);
}

void placeJoints(std::span<const hands::Joint> joints, std::span<const int> nodes, scene::Pose& pose) {
    for (size_t k = 0; k < joints.size(); ++k)
        pose.modelFromNode[static_cast<size_t>(nodes[k])] =
            glm::translate(glm::mat4(1), joints[k].position) * glm::mat4_cast(joints[k].orientation);
}

} // namespace

Status Cast::findShade(const Wish& wish, Actor& actor) {
    const auto parts = wish.side ? occlusion::Parts::ByJoint : occlusion::Parts::ByShape;
    actor.body = render::makeBodyOccluders(actor.model, actor.pose, parts, mostParts(actor.model, parts));
    foldBody(actor.model);
    if (!wish.side) return Done{};
    // Half closed, as most of what its own parts count for is.
    const auto rig = hands::HandRig::load(dataRoot() / "content/models/hand_skeleton.json");
    if (!rig) return rig.error();
    hands::HandShape half;
    half.curl.fill(0.45f);
    scene::Pose bent = actor.pose;
    placeJoints(rig->pose(*wish.side, half, {}).joints, actor.jointNodes, bent);
    render::foldBesideOwn(actor.model, bent, actor.body, kGripRays);
    return Done{};
}

Result<Cast::Actor> Cast::readActor(const Wish& wish, render::Reflectance reflectance) {
    auto model = scene::loadModel(wish.file);
    if (!model) return model.error();
    Actor actor;
    actor.model = std::move(*model);
    if (!wish.look.empty() && !scene::wear(actor.model, wish.look))
        return Error{wish.file.string(), "has no variant named " + wish.look};
    for (size_t joint = 0; joint < hands::kJointNames.size() && wish.side; ++joint) {
        const std::string name(hands::kJointNames[joint]);
        actor.jointNodes[joint] = actor.model.findNode(name);
        if (actor.jointNodes[joint] < 0) return Error{wish.file.string(), "has no joint named " + name};
    }
    scene::restPose(actor.model, actor.pose);
    scene::updateGlobals(actor.model, actor.pose);
    const auto shade = render::readShade(render::shadeBeside(wish.file));
    if (shade && render::wearShade(*shade, actor.model))
        actor.body = render::makeBodyOccluders(actor.model, actor.pose, shade->parts, wish.side.has_value());
    else if (const auto found = findShade(wish, actor); !found)
        return found.error();
    if (reflectance == render::Reflectance::Coded)
        actor.body.albedo = glm::pow(actor.body.albedo, glm::vec3(1 / 2.2f));
    const scene::Bounds bounds = scene::posedBounds(actor.model, actor.pose);
    actor.length_m = std::max(bounds.high.z - bounds.low.z, 1e-3f);
    actor.silhouette = scene::silhouetteOf(actor.model, actor.pose);
    actor.reach = scene::reachOf(actor.model, actor.pose);
    actor.spine = scene::findSpine(actor.model, actor.length_m, bounds.low.z);
    for (size_t motion = 0; motion < game::kMotionNames.size(); ++motion)
        actor.animations[motion] = actor.model.findAnimation(game::kMotionNames[motion]);
    for (size_t motion = 0; motion < game::kMotionNames.size(); ++motion)
        if (actor.animations[motion] >= 0)
            actor.beats[motion] =
                scene::measureBeat(actor.model, actor.spine, actor.animations[motion], actor.wave);
    for (size_t side = 0; side < 2; ++side) actor.pectorals[side] = actor.model.findNode(kPectorals[side]);
    return actor;
}

void Cast::upload(Actor& actor, render::Reflectance reflectance, render::Detail detail) {
    // Where detail is lean, materials are drawn at their means.
    leastRoughness_ =
        std::min(leastRoughness_, detail == render::Detail::Lean ? scene::leastMeanRoughness(actor.model)
                                                                 : scene::leastRoughness(actor.model));
    // Two hands wear one skin.
    const auto same = [](const ImageRgba8& a, const ImageRgba8& b) { return a.pixels == b.pixels; };
    const bool shared = std::ranges::equal(actor.model.images, lastImages_, same);
    actor.gpu = render::uploadModel(actor.model, reflectance, detail, shared ? lastTextures_ : nullptr);
    lastImages_ = std::move(actor.model.images); // on the graphics side from now on
    lastTextures_ = actor.gpu.textures;
    actor.model.images.clear();
    for (scene::Mesh& mesh : actor.model.meshes) mesh.primitives.clear();
}

Result<Cast> Cast::load(std::span<const Path> speciesModels, const Path& leftHand, const Path& rightHand,
                        const std::string& handLook, render::Reflectance reflectance, render::Detail detail) {
    std::vector<Wish> wishes;
    for (const Path& file : speciesModels) wishes.push_back({file, {}, {}});
    wishes.push_back({leftHand, handLook, hands::Side::Left});
    wishes.push_back({rightHand, handLook, hands::Side::Right});
    // Each is read while the one before it goes to the graphics side; not all at once, for the memory's sake.
    const auto read = [&](size_t i) {
        return std::async(std::launch::async, [&, i] { return readActor(wishes[i], reflectance); });
    };
    Cast cast;
    auto next = read(0);
    for (size_t i = 0; i < wishes.size(); ++i) {
        auto actor = next.get();
        if (!actor) return actor.error();
        if (i + 1 < wishes.size()) next = read(i + 1);
        cast.upload(*actor, reflectance, detail);
        if (i < speciesModels.size())
            cast.species_.push_back(std::move(*actor));
        else
            cast.hands_[i - speciesModels.size()] = std::move(*actor);
    }
    cast.lastImages_ = {};
    return cast;
}

// The clip moves fins and jaws in its own time. The spine's wave is the clip's too, but in the time of the
// tail's beat and as wide as the snapshot says; the bend is added.
void Cast::pose(const game::CreatureView& creature, Actor& actor) {
    const game::BodyShape& shape = creature.shape;
    scene::restPose(actor.model, actor.pose);
    if (!actor.spine.joints.empty()) scene::restPose(actor.model, actor.wave);
    const auto play = [&](game::Motion motion, float weight) {
        const int index = actor.animations[static_cast<size_t>(motion)];
        if (index < 0 || weight <= 0) return;
        const scene::Animation& clip = actor.model.animations[static_cast<size_t>(index)];
        scene::animate(actor.model, index, clipTime(clip, creature.phase_s), actor.pose, weight);
        if (actor.spine.joints.empty()) return;
        const scene::Beat& beat = actor.beats[static_cast<size_t>(motion)];
        const float loops = shape.beats / beat.perLoop + beat.offset;
        scene::animate(actor.model, index, clipTime(clip, loops * clip.duration_s), actor.wave, weight);
    };
    if (creature.blend < 1) play(creature.before, 1);
    play(creature.motion, creature.blend);
    for (const scene::Spine::Joint& joint : actor.spine.joints)
        actor.pose.local[static_cast<size_t>(joint.node)] = actor.wave.local[static_cast<size_t>(joint.node)];
    const auto swing = [&](game::Motion motion) {
        return actor.beats[static_cast<size_t>(motion)].amplitude;
    };
    const float clips = glm::mix(swing(creature.before), swing(creature.motion), creature.blend);
    if (clips > kLeastSwing)
        scene::scaleWave(actor.spine, std::min(shape.amplitude / clips, kMostScale), actor.pose);
    scene::bend(actor.spine, shape.bendLeft, shape.bendUp, actor.pose);
    for (size_t side = 0; side < 2; ++side) {
        if (actor.pectorals[side] < 0) continue;
        glm::quat& fin = actor.pose.local[static_cast<size_t>(actor.pectorals[side])].rotation;
        fin = glm::angleAxis(side == 0 ? -shape.finsDown : shape.finsDown, glm::vec3(0, 0, 1)) * fin;
    }
    scene::updateGlobals(actor.model, actor.pose);
}

std::vector<scene::Silhouette> Cast::silhouettes() const {
    std::vector<scene::Silhouette> all;
    for (const Actor& actor : species_) all.push_back(actor.silhouette);
    return all;
}

void Cast::show(const game::Snapshot& snapshot, render::ObjectPass& pass) {
    for (const game::CreatureView& creature : snapshot.creatures) {
        Actor& actor = species_[static_cast<size_t>(creature.species)];
        pose(creature, actor);
        const glm::mat4 worldFromModel = glm::scale(glm::translate(glm::mat4(1), creature.position) *
                                                        glm::mat4_cast(creature.worldFromBody),
                                                    glm::vec3(creature.length / actor.length_m));
        scene::placeBalls(actor.reach, actor.pose, worldFromModel, balls_);
        // No fin reaches further from the middle than this, however the body bends.
        pass.add(actor.model, actor.gpu, actor.pose, worldFromModel,
                 {creature.position, creature.length * 0.7f}, &actor.body, balls_);
    }
    for (size_t side = 0; side < snapshot.hands.size(); ++side) {
        const game::HandView& hand = snapshot.hands[side];
        if (!hand.visible) continue;
        Actor& actor = hands_[side];
        placeJoints(hand.joints, actor.jointNodes, actor.pose);
        const glm::mat4 worldFromModel(1); // the joints already stand in the world
        scene::placeBalls(actor.reach, actor.pose, worldFromModel, balls_);
        pass.add(actor.model, actor.gpu, actor.pose, worldFromModel, scene::ballAround(balls_), &actor.body,
                 balls_);
    }
}

} // namespace shoal::app
