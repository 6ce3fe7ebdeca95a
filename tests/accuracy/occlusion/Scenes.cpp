#include "Scenes.h"

#include "engine/core/Files.h"
#include "engine/light/InverseToneMap.h"
#include "engine/media/VideoSource.h"
#include "engine/occlusion/Folds.h"
#include "engine/render/BakedShade.h"
#include "engine/scene/LoadModel.h"
#include "input/hands/HandRig.h"

#include <glm/gtc/matrix_transform.hpp>

#include <stdexcept>

namespace shoal {

namespace {

constexpr size_t kFishParts = 4, kSharkParts = 12; // as the game has them
constexpr int kFoldRays = 6;

Path content() { return Path(SHOAL_SOURCE_DIR) / "content"; }

struct Actor {
    scene::Model model;
    scene::Pose rest, pose;
    render::BodyOccluders body;
    std::vector<glm::vec4> folds; // at rest; of a hand what its own parts leave
};

// From rest, as its joint has turned this vertex.
glm::mat3 turned(const Actor& actor, const scene::Pose& pose, size_t node) {
    return glm::mat3(pose.modelFromNode[node] * glm::inverse(actor.rest.modelFromNode[node]));
}

Actor load(const std::string& name) {
    auto model = scene::loadModel(content() / "models" / (name + ".glb"));
    if (!model) throw std::runtime_error(model.error().sentence());
    Actor actor{std::move(*model), {}, {}, {}, {}};
    scene::restPose(actor.model, actor.pose);
    scene::updateGlobals(actor.model, actor.pose);
    actor.rest = actor.pose;
    return actor;
}

Actor loadAnimal(const std::string& name, size_t parts) {
    Actor actor = load(name);
    actor.body = render::makeBodyOccluders(actor.model, actor.pose, occlusion::Parts::ByShape, parts);
    const scene::Surface surface = scene::posedSurface(actor.model, actor.rest);
    actor.folds = occlusion::findFolds({surface.positions, surface.normals, surface.indices}, {}, kFoldRays);
    return actor;
}

Actor loadHand(const std::string& name) {
    Actor actor = load(name);
    const auto shade = render::readShade(content() / "models" / (name + ".shade.json"));
    if (!shade) throw std::runtime_error(shade.error().sentence());
    actor.body = render::makeBodyOccluders(actor.model, actor.pose, shade->parts, true);
    actor.folds = shade->besideOwn;
    return actor;
}

void placeJoints(const hands::HandPose& pose, Actor& hand) {
    for (size_t joint = 0; joint < hands::kJointNames.size(); ++joint)
        hand.pose
            .modelFromNode[static_cast<size_t>(hand.model.findNode(std::string(hands::kJointNames[joint])))] =
            glm::translate(glm::mat4(1), pose.joints[joint].position) *
            glm::mat4_cast(pose.joints[joint].orientation);
}

SceneBody place(const Actor& actor, const glm::mat4& worldFromModel) {
    SceneBody body;
    body.surface = scene::posedSurface(actor.model, actor.pose);
    for (glm::vec3& p : body.surface.positions) p = glm::vec3(worldFromModel * glm::vec4(p, 1));
    for (glm::vec3& n : body.surface.normals) n = glm::normalize(glm::mat3(worldFromModel) * n);
    body.albedo = actor.body.albedo;
    body.onItself = actor.body.onItself;
    for (size_t v = 0; v < actor.folds.size(); ++v) {
        const glm::mat3 carried =
            glm::mat3(worldFromModel) * turned(actor, actor.pose, body.surface.nodesOf[v]);
        body.folds.emplace_back(carried * glm::vec3(actor.folds[v]) / std::cbrt(glm::determinant(carried)),
                                actor.folds[v].w);
    }
    for (const auto& part : actor.body.parts)
        body.parts.push_back({render::placed(part, actor.pose, worldFromModel), 1, body.albedo});
    return body;
}

} // namespace

struct ClosingHand::Actors {
    Actor hand = loadHand("hand_right");
    Actor fish = loadAnimal("clownfish", kFishParts);
    hands::HandRig rig;
};

ClosingHand::ClosingHand() : actors_(std::make_shared<Actors>()) {
    auto rig = hands::HandRig::load(content() / "models" / "hand_skeleton.json");
    if (!rig) throw std::runtime_error(rig.error().sentence());
    actors_->rig = std::move(*rig);
}

OcclusionScene ClosingHand::at(float curl) const {
    Actor hand = actors_->hand;
    hands::HandShape shape;
    shape.curl.fill(0.45f);
    // Where it lies when a hand has closed on it.
    const glm::vec3 fishAt = hands::graspCentre(actors_->rig.pose(hands::Side::Right, shape, {}).joints);
    shape.curl.fill(curl);
    const hands::HandPose pose = actors_->rig.pose(hands::Side::Right, shape, {});
    placeJoints(pose, hand);
    // Across the palm, where fingers close around it.
    const glm::mat4 held =
        glm::rotate(glm::translate(glm::mat4(1), fishAt), glm::radians(80.0f), glm::vec3(0, 1, 0));
    return {"hand on fish", {place(actors_->fish, held), place(hand, glm::mat4(1))}, {0, 1}};
}

OcclusionScene handOnFish(float curl) { return ClosingHand().at(curl); }

OcclusionScene handBySelf(float curl) {
    OcclusionScene scene = ClosingHand().at(curl);
    scene.bodies.erase(scene.bodies.begin());
    scene.receivers = {0};
    return scene;
}

OcclusionScene sharkAboveShoal() {
    const Actor shark = loadAnimal("shark", kSharkParts);
    const Actor fish = loadAnimal("sardine", kFishParts);
    OcclusionScene scene{"shark above a shoal", {place(shark, glm::mat4(1))}, {}};
    for (int i = 0; i < 8; ++i) {
        const auto k = static_cast<float>(i);
        const glm::vec3 at(0.10f * static_cast<float>(i % 3 - 1) + 0.03f * static_cast<float>(i % 2),
                           -0.32f - 0.06f * static_cast<float>(i % 4), -0.5f + 0.16f * k);
        scene.receivers.push_back(scene.bodies.size());
        scene.bodies.push_back(
            place(fish, glm::rotate(glm::translate(glm::mat4(1), at), 0.4f * k, glm::vec3(0.2f, 1, 0))));
    }
    return scene;
}

ImageRgbF reefLight(int64_t number) {
    auto video = media::VideoSource::open(content() / "video" / "reef.mp4");
    if (!video) throw std::runtime_error(video.error().sentence());
    video->seek(number);
    ImageRgb8 frame(video->info().width, video->info().height);
    while (video->position() <= number)
        if (!video->grab()) throw std::runtime_error("the dive's video is too short");
    if (!video->retrieve(frame)) throw std::runtime_error("the dive's video cannot be read");
    ImageRgbF small(64, 32);
    const int step = frame.width / small.width;
    for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x) {
            glm::vec3 sum(0);
            for (int v = 0; v < step; ++v)
                for (int u = 0; u < step; ++u) {
                    const uint8_t* bgr = frame.at(x * step + u, y * step + v);
                    sum += light::radianceFromDisplay(glm::vec3(bgr[2], bgr[1], bgr[0]) / 255.0f);
                }
            for (int c = 0; c < 3; ++c) small.at(x, y)[c] = sum[c] / static_cast<float>(step * step);
        }
    return small;
}

} // namespace shoal
