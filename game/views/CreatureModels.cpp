#include "game/views/CreatureModels.h"

#include "engine/core/Log.h"
#include "engine/core/RunProgram.h"
#include "engine/math/SphericalHarmonics.h"
#include "engine/math/Trigonometry.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <future>

namespace shoal::app {

constexpr std::array kPectorals = {"pectoral_left", "pectoral_right"}; // joints that models may have
constexpr std::array kHandModels = {"models/hand_left.glb", "models/hand_right.glb"};
constexpr std::array kArmModels = {"models/arm_left.glb", "models/arm_right.glb"};
constexpr float kHoldingOpacity = 0.4f;
// Distances from the eyes to a hand's nearest joint: below kFades_m the hand fades, and at kGone_m it is
// gone, before the near plane cuts it into torn polygons that fill the view.
constexpr float kFades_m = 0.16f, kGone_m = 0.06f;
constexpr float kArmMargin = 1.3f; // factor on an arm's bounding spheres: a bend moves its flesh
// Swing of the tail in a clip, body lengths, below which there is no wave to scale.
constexpr float kMinSwing = 0.01f;
constexpr float kMaxScale = 2.5f; // largest scale of that wave: more would fold the body

// Returns the clip's time at this phase: clips loop.
static float clipTime(const scene::Animation& clip, float phase_s) {
    if (clip.duration_s <= 0) return 0;
    const float wrapped = std::fmod(phase_s, clip.duration_s);
    return wrapped < 0 ? wrapped + clip.duration_s : wrapped;
}

static void placeJoints(std::span<const hands::Joint> joints, std::span<const int> nodes, scene::Pose& pose) {
    for (size_t k = 0; k < joints.size(); ++k)
        pose.modelFromNode[nodes[k]] =
            glm::translate(glm::mat4(1), joints[k].position) * glm::mat4_cast(joints[k].orientation);
}

static void placeArm(const ArmPose& arm, std::span<const int> nodes, scene::Pose& pose) {
    for (size_t k = 0; k < arm.size(); ++k) pose.modelFromNode[nodes[k]] = arm[k];
}

// Returns the opacity of a hand and its arm by how near the hand is to the eyes: 0 gone to 1.
static float opacityNear(const glm::vec3& eyes, std::span<const hands::Joint> joints) {
    float nearest_m = kFades_m;
    for (const hands::Joint& joint : joints)
        nearest_m = std::min(nearest_m, glm::distance(joint.position, eyes) - joint.radius);
    return glm::smoothstep(kGone_m, kFades_m, nearest_m);
}

// Reads and applies the model's baked occlusion; empty if the file is missing or is another model's.
static std::optional<render::BakedOcclusion> stored(const Path& file, scene::Model& model) {
    const auto baked = render::readBakedOcclusion(file);
    return baked && render::applyBakedOcclusion(*baked, model) ? std::optional(*baked) : std::nullopt;
}

constexpr float kLookUp_s = 0.03f;                          // a film's light changes no more often
constexpr size_t kEachTime = 6;                             // animals whose light is looked up each time
constexpr float kFollow_s = 0.25f;                          // time constant of that light
constexpr float kLampAbove_m = 0.15f, kLampRadius_m = 0.3f; // a wide lamp dazzles less from near
constexpr float kGrazing = 0.5f; // height at which light counts as grazing: the sun under water is higher
constexpr float kJump_m = 0.5f;  // movement between two pictures from which it counts as another animal

// Returns the harmonics of light from one direction; irradiance: on a plane that faces it.
static depth::LightHarmonics harmonicsOf(const glm::vec3& towardsEnv, const glm::vec3& irradiance) {
    const math::ShBasis basis = math::shBasis(towardsEnv);
    depth::LightHarmonics light;
    for (size_t k = 0; k < light.size(); ++k) light[k] = static_cast<float>(basis[k]) * irradiance;
    return light;
}

// Returns by how much more light than in its mean falls on an animal from the direction of the waves' light.
static depth::LightHarmonics ofWaves(const FocusedLight& focused, const glm::vec3& placeEnv, float length_m) {
    if (!focused.caustics || focused.from->presence == 0) return {};
    const glm::vec3 towards = focused.from->light.direction;
    const float change = focused.caustics->changeAt(placeEnv, towards, length_m, *focused.map);
    return harmonicsOf(towards, focused.from->groundIrradiance *
                                    (change * focused.from->presence / std::max(towards.y, kGrazing)));
}

void AnimalLight::follow(const game::Snapshot& snapshot, const depth::LightDifference* light,
                         const glm::mat3& envFromWorld, const DiverLamp& lamp, const FocusedLight& focused) {
    lamp_ = lamp;
    lampWorld_ = snapshot.headWorld + glm::vec3(0, kLampAbove_m, 0);
    envFromWorld_ = envFromWorld;
    const auto passed_s = static_cast<float>(snapshot.time_s - time_s_);
    time_s_ = snapshot.time_s;
    const float share = passed_s < 0 || passed_s > 1 ? 1 : math::followShare(passed_s, kFollow_s);
    sinceLookUp_s_ += passed_s;
    const bool isDue = share == 1 || sinceLookUp_s_ >= kLookUp_s;
    if (isDue) sinceLookUp_s_ = 0;
    const size_t known = animals_.size(), count = snapshot.creatures.size();
    animals_.resize(count);
    const size_t turns = isDue ? std::min(kEachTime, count) : 0;
    for (size_t i = 0; i < count; ++i) {
        Animal& animal = animals_[i];
        const glm::vec3 position = snapshot.creatures[i].position;
        const bool jumped = i >= known || share == 1 || glm::distance(position, animal.position) > kJump_m;
        animal.position = position;
        if (jumped || (i + count - next_ % count) % count < turns)
            animal.found = light ? light->at(envFromWorld * position) : depth::LightHarmonics{};
        if (jumped || isDue)
            animal.waves = ofWaves(focused, envFromWorld * position, snapshot.creatures[i].length);
        animal.lit = ofLamp(position);
        for (size_t k = 0; k < animal.now.size(); ++k) {
            animal.now[k] += (jumped ? 1 : share) * (animal.found[k] - animal.now[k]);
            animal.lit[k] += animal.now[k] + animal.waves[k];
        }
    }
    next_ = count > 0 ? (next_ + turns) % count : 0;
}

depth::LightHarmonics AnimalLight::ofLamp(const glm::vec3& place) const {
    const glm::vec3 towards = lampWorld_ - place;
    const float distance_m = glm::length(towards);
    constexpr float kSquare = kLampRadius_m * kLampRadius_m;
    const float atPlace = lamp_.radiance * (1 + kSquare) / (distance_m * distance_m + kSquare);
    const glm::vec3 irradiance = glm::pi<float>() * atPlace * glm::exp(-lamp_.attenuation_perM * distance_m);
    return harmonicsOf(envFromWorld_ * towards / std::max(distance_m, 1e-3f), irradiance);
}

std::optional<render::BakedOcclusion> occlusionOf(const Path& file, scene::Model& model) {
    if (auto beside = stored(render::bakedOcclusionBeside(file), model)) return beside;
    const Path kept = cacheFolder() / "occlusion" / fmt::format("{:016x}.json", render::skinHash(model));
    if (auto before = stored(kept, model)) return before;
    const Path maker = programFolder() / "shoal-occlusion";
    const auto status = [&] {
        const log::QuietStandardError quiet; // the warning below says it in one sentence
        return runProgram({maker.string(), file.string(), kept.string()});
    }();
    if (status == 0)
        if (auto made = stored(kept, model)) return made;
    log::warn("{}: is shown without its shadows: {} could not make them", file.string(), maker.string());
    return std::nullopt;
}

Result<CreatureModels::ModelInstance> CreatureModels::readInstance(const ModelRequest& request,
                                                                   render::Reflectance reflectance) {
    ModelInstance instance;
    if (Status s = scene::loadModel(request.file, request.variant).moveTo(instance.model); !s)
        return s.error();
    for (const std::string_view joint : request.joints) {
        instance.jointNodes.push_back(instance.model.findNode(std::string(joint)));
        if (instance.jointNodes.back() < 0)
            return Error{request.file.string(), "has no joint named " + std::string(joint)};
    }
    for (scene::Material& material : instance.model.materials)
        material.baseColourLin *= glm::vec4(request.colour, 1);
    scene::restPose(instance.model, instance.pose);
    const scene::Bounds bounds = scene::posedBounds(instance.model, instance.pose);
    const auto baked = occlusionOf(request.file, instance.model);
    instance.body = render::makeBodyOccluders(instance.model, instance.pose,
                                              baked ? baked->parts : std::vector<occlusion::BodyPart>(),
                                              request.occludesItself);
    if (reflectance == render::Reflectance::Coded)
        instance.body.albedo = glm::pow(instance.body.albedo, glm::vec3(1 / 2.2f));
    instance.length_m = std::max(bounds.high.z - bounds.low.z, 1e-3f);
    const glm::vec3 size = bounds.high - bounds.low;
    instance.extent = std::max({size.x, size.y, size.z}) / instance.length_m;
    instance.boundingSpheres = scene::boundingSpheresOf(instance.model, instance.pose);
    instance.spine = scene::findSpine(instance.model, instance.length_m, bounds.low.z);
    for (size_t motion = 0; motion < game::kMotionNames.size(); ++motion) {
        const int clip = instance.model.findAnimation(game::kMotionNames[motion]);
        instance.animations[motion] = clip;
        if (clip >= 0)
            instance.beats[motion] = scene::measureBeat(instance.model, instance.spine, clip, instance.wave);
    }
    for (size_t side = 0; side < 2; ++side)
        instance.pectorals[side] = instance.model.findNode(kPectorals[side]);
    return instance;
}

void CreatureModels::upload(ModelInstance& instance, render::Reflectance reflectance, render::Detail detail,
                            bool isArm) {
    // Lean detail draws each material with the mean of its textures.
    const scene::Gloss gloss = scene::minGloss(instance.model);
    minRoughness_ =
        std::min(minRoughness_, detail == render::Detail::Lean ? gloss.meanRoughness : gloss.minRoughness);
    // Both hands have the same textures, and both arms.
    const auto same = [](const ImageRgba8& a, const ImageRgba8& b) { return a.pixels == b.pixels; };
    const bool shared = std::ranges::equal(instance.model.images, lastImages_, same);
    // A straight arm, as at rest, hardly needs its rings; from a bent one without them the hand sticks out.
    std::vector<glm::vec3> bent;
    if (isArm) {
        const glm::quat bend = glm::angleAxis(1.0f, glm::vec3(1, 0, 0));
        const hands::Joint wrist{.position = {0.1f, -0.3f, -0.45f}, .orientation = bend};
        placeArm(poseArm(hands::Side::Right, wrist, {}), instance.jointNodes, instance.pose);
        bent = scene::posedSurface(instance.model, instance.pose).positions;
    }
    instance.gpu =
        render::uploadModel(instance.model, reflectance, detail, shared ? lastTextures_ : nullptr, bent);
    lastImages_ = std::move(instance.model.images); // OpenGL has a copy
    lastTextures_ = instance.gpu.textures;
    instance.model.images.clear();
    for (scene::Mesh& mesh : instance.model.meshes) mesh.primitives.clear();
}

Result<CreatureModels> CreatureModels::load(const game::SpeciesTable& species, const std::vector<bool>& shown,
                                            const std::string& handVariant, render::Reflectance reflectance,
                                            render::Detail detail,
                                            const std::function<bool(float)>& progress) {
    const Path content = dataRoot() / "content";
    CreatureModels models;
    models.species_.resize(species.size());
    std::vector<ModelRequest> requests;
    for (size_t i = 0; i < species.size(); ++i)
        if (shown[i])
            requests.push_back(
                {content / species[i].model, &models.species_[i], {}, {}, false, species[i].colour});
    // Both hands follow each other, and both arms: upload() compares a model's textures with the last one's.
    for (size_t side = 0; side < 2; ++side)
        requests.push_back(
            {content / kHandModels[side], &models.hands_[side], handVariant, hands::kJointNames, true});
    for (size_t side = 0; side < 2; ++side)
        requests.push_back({.file = content / kArmModels[side],
                            .into = &models.arms_[side],
                            .joints = kArmJointNames,
                            .isArm = true});
    // Each model is read while the one before it is uploaded; not all at once, to save memory.
    const auto read = [&](size_t i) {
        return std::async(std::launch::async, [&, i] { return readInstance(requests[i], reflectance); });
    };
    auto next = read(0);
    for (size_t i = 0; i < requests.size(); ++i) {
        auto instance = next.get();
        if (!instance) return instance.error();
        if (i + 1 < requests.size()) next = read(i + 1);
        models.upload(*instance, reflectance, detail, requests[i].isArm);
        *requests[i].into = std::move(*instance);
        const auto done = static_cast<float>(i + 1) / static_cast<float>(requests.size());
        if (progress && !progress(done)) return Error{"", "loading was stopped"};
    }
    models.lastImages_ = {};
    return models;
}

Result<float> CreatureModels::add(const game::SpeciesTable& species, size_t which,
                                  render::Reflectance reflectance, render::Detail detail) {
    ModelInstance& into = species_[which];
    if (!into.model.nodes.empty()) return into.extent;
    auto instance = readInstance(
        {dataRoot() / "content" / species[which].model, &into, {}, {}, false, species[which].colour},
        reflectance);
    if (!instance) return instance.error();
    const float minRoughness = minRoughness_;
    upload(*instance, reflectance, detail);
    minRoughness_ = minRoughness;
    lastImages_ = {};
    into = std::move(*instance);
    return into.extent;
}

// Poses a creature. The clip moves fins and jaws at its own time. The spine follows the clip at the time of
// the tail's beat, with its wave scaled to the snapshot's amplitude; then the bend is added.
void CreatureModels::pose(const game::CreatureView& creature, ModelInstance& instance) {
    const game::BodyShape& shape = creature.shape;
    scene::restPose(instance.model, instance.pose);
    if (!instance.spine.joints.empty()) scene::restPose(instance.model, instance.wave);
    const auto play = [&](game::Motion motion, float weight) {
        const int index = instance.animations[static_cast<size_t>(motion)];
        if (index < 0 || weight <= 0) return;
        const scene::Animation& clip = instance.model.animations[index];
        scene::animate(instance.model, index, clipTime(clip, creature.gait.phase_s), instance.pose, weight);
        if (instance.spine.joints.empty()) return;
        const scene::TailBeat& beat = instance.beats[static_cast<size_t>(motion)];
        const float loops = shape.beats / beat.perLoop + beat.offset;
        scene::animate(instance.model, index, clipTime(clip, loops * clip.duration_s), instance.wave, weight);
    };
    if (creature.gait.blend < 1) play(creature.gait.before, 1);
    play(creature.gait.motion, creature.gait.blend);
    for (const scene::Spine::Joint& joint : instance.spine.joints)
        instance.pose.local[joint.node] = instance.wave.local[joint.node];
    const auto swing = [&](game::Motion motion) {
        return instance.beats[static_cast<size_t>(motion)].amplitude;
    };
    const float clips =
        glm::mix(swing(creature.gait.before), swing(creature.gait.motion), creature.gait.blend);
    if (clips > kMinSwing)
        scene::scaleWave(instance.spine, std::min(shape.amplitude / clips, kMaxScale), instance.pose);
    scene::bend(instance.spine, shape.bendLeft, shape.bendUp, instance.pose);
    for (size_t side = 0; side < 2; ++side) {
        if (instance.pectorals[side] < 0) continue;
        glm::quat& fin = instance.pose.local[instance.pectorals[side]].rotation;
        fin = glm::angleAxis(side == 0 ? -shape.finsDown : shape.finsDown, glm::vec3(0, 0, 1)) * fin;
    }
    scene::updateGlobals(instance.model, instance.pose);
}

void CreatureModels::show(const game::Snapshot& snapshot, const Head& player, const AnimalLight& light,
                          render::ObjectPass& pass) {
    for (size_t i = 0; i < snapshot.creatures.size(); ++i) {
        const game::CreatureView& creature = snapshot.creatures[i];
        ModelInstance& instance = species_[creature.species];
        pose(creature, instance);
        const glm::mat4 worldFromModel = glm::scale(glm::translate(glm::mat4(1), creature.position) *
                                                        glm::mat4_cast(creature.worldFromBody),
                                                    glm::vec3(creature.length / instance.length_m));
        scene::placeSpheres(instance.boundingSpheres, instance.pose, worldFromModel, spheres_);
        // The bounding sphere, of 0.7 body lengths, holds all fins however the body bends, and another of 2.2
        // the seaweed on which a thing drifts.
        const float bound = creature.length * (creature.gait.motion == game::Motion::Drift ? 2.2f : 0.7f);
        pass.add({.model = instance.model,
                  .gpu = instance.gpu,
                  .pose = instance.pose,
                  .worldFromModel = worldFromModel,
                  .bound = {creature.position, bound},
                  .parts = spheres_,
                  .body = &instance.body,
                  .highlight = creature.catchable,
                  .lightDifference = &light.of(i)});
    }
    for (size_t side = 0; side < snapshot.hands.size(); ++side) {
        const game::HandView& hand = snapshot.hands[side];
        const float opacity = hand.visible ? opacityNear(snapshot.headWorld, hand.joints) : 0.0f;
        if (opacity == 0) continue;
        placeJoints(hand.joints, hands_[side].jointNodes, hands_[side].pose);
        // A hand gives way to the fish that it holds, as quickly as the fish begins to struggle.
        const float held =
            hand.holds < 0 ? 0 : snapshot.creatures[static_cast<size_t>(hand.holds)].gait.blend;
        const auto lamp = light.ofLamp(hand.joints[hands::kWristJoint].position);
        showPosed(hands_[side], 1, lamp, pass, opacity * (1 - (1 - kHoldingOpacity) * held), hand.ready);
        const ArmPose arm = poseArm(static_cast<hands::Side>(side), hand.joints[hands::kWristJoint], player,
                                    hand.towardsElbow);
        placeArm(arm, arms_[side].jointNodes, arms_[side].pose);
        showPosed(arms_[side], kArmMargin * std::max(stretchOf(arm), 1.0f), lamp, pass, opacity);
    }
}

void CreatureModels::showPosed(ModelInstance& instance, float margin, const depth::LightHarmonics& light,
                               render::ObjectPass& pass, float opacity, float highlight) {
    scene::placeSpheres(instance.boundingSpheres, instance.pose, glm::mat4(1), spheres_);
    for (scene::Sphere& sphere : spheres_) sphere.radius *= margin;
    pass.add({.model = instance.model,
              .gpu = instance.gpu,
              .pose = instance.pose,
              .bound = scene::boundingSphereOf(spheres_),
              .parts = spheres_,
              .body = &instance.body,
              .opacity = opacity,
              .highlight = highlight,
              .isInRoom = true,
              .lightDifference = &light});
}

} // namespace shoal::app
