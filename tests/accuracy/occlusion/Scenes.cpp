#include "Scenes.h"

#include "content/make/models/occlusion/HandOcclusion.h"
#include "content/make/models/occlusion/TraceSelfOcclusion.h"
#include "engine/core/Files.h"
#include "engine/light/InverseToneMap.h"
#include "engine/media/VideoPlayer.h"
#include "engine/render/BakedOcclusion.h"
#include "engine/scene/Model.h"
#include "tests/Test.h"

namespace shoal {

namespace {

constexpr int kSelfOcclusionRays = 6;

Path content() { return tests::sourceFolder() / "content"; }

struct ModelInstance {
    scene::Model model;
    scene::Pose rest, pose;
    render::BodyOccluders body;
    std::vector<glm::vec4> selfOcclusion; // at rest; for a hand, the part that its own ellipsoids leave
};

// Returns the rotation from rest that a joint gives its vertices.
glm::mat3 turned(const ModelInstance& instance, size_t node) {
    return glm::mat3(instance.pose.modelFromNode[node] * glm::inverse(instance.rest.modelFromNode[node]));
}

// Reads the occlusion file of a model.
render::BakedOcclusion bakedOf(const std::string& name) {
    return tests::valueOf(render::readBakedOcclusion(content() / "models" / (name + ".occlusion.json")));
}

ModelInstance loadAnimal(const std::string& name) {
    ModelInstance instance{tests::valueOf(scene::loadModel(content() / "models" / (name + ".glb")))};
    scene::restPose(instance.model, instance.pose);
    scene::updateGlobals(instance.model, instance.pose);
    instance.rest = instance.pose;
    instance.body = render::makeBodyOccluders(instance.model, instance.pose, bakedOf(name).parts, false);
    const scene::Surface surface = scene::posedSurface(instance.model, instance.rest);
    instance.selfOcclusion = occlusion::traceSelfOcclusion(
        {surface.positions, surface.normals, surface.indices}, kSelfOcclusionRays);
    return instance;
}

SceneBody place(const ModelInstance& instance, const glm::mat4& worldFromModel) {
    SceneBody body;
    body.surface = scene::posedSurface(instance.model, instance.pose);
    for (glm::vec3& p : body.surface.positions) p = glm::vec3(worldFromModel * glm::vec4(p, 1));
    for (glm::vec3& n : body.surface.normals) n = glm::normalize(glm::mat3(worldFromModel) * n);
    body.albedo = instance.body.albedo;
    for (size_t v = 0; v < instance.selfOcclusion.size(); ++v) {
        const glm::mat3 carried = glm::mat3(worldFromModel) * turned(instance, body.surface.nodesOf[v]);
        body.selfOcclusion.emplace_back(carried * glm::vec3(instance.selfOcclusion[v]) /
                                            std::cbrt(glm::determinant(carried)),
                                        instance.selfOcclusion[v].w);
    }
    for (const auto& part : instance.body.parts)
        body.parts.push_back({render::placed(part, instance.pose, worldFromModel), 1, body.albedo});
    return body;
}

} // namespace

ClosingHand closingHand() {
    const make::Hand hand = tests::valueOf(make::loadHand(content() / "models", hands::Side::Right));
    const render::BakedOcclusion baked = bakedOf("hand_right");
    hands::HandShape shape;
    shape.curl.fill(0.45f);
    // The fish lies across the palm, where a hand that has closed on it holds it.
    const glm::vec3 fishAt = hands::graspCentre(hand.rig.pose(hand.side, shape, {}).joints);
    const SceneBody fish =
        place(loadAnimal("clownfish"),
              glm::rotate(glm::translate(glm::mat4(1), fishAt), glm::radians(80.0f), glm::vec3(0, 1, 0)));
    ModelInstance posed{hand.model, hand.rest, hand.rest,
                        render::makeBodyOccluders(hand.model, hand.rest, baked.parts, true), baked.besideOwn};
    return [hand, fish, posed, shape](float curl) mutable -> OcclusionScene {
        shape.curl.fill(curl);
        posed.pose = hand.closed(shape);
        return {{fish, place(posed, glm::mat4(1))}, {0, 1}};
    };
}

OcclusionScene handOnFish(float curl) { return closingHand()(curl); }

OcclusionScene handBySelf(float curl) {
    OcclusionScene scene = handOnFish(curl);
    scene.bodies.erase(scene.bodies.begin());
    scene.receivers = {0};
    return scene;
}

OcclusionScene sharkAboveShoal() {
    const ModelInstance shark = loadAnimal("shark");
    const ModelInstance fish = loadAnimal("sardine");
    OcclusionScene scene{{place(shark, glm::mat4(1))}, {}};
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

ImageRgbF reefLight(int number) {
    auto player = tests::valueOf(media::VideoPlayer::open(content() / "video" / "reef.mp4"));
    const ImageRgb8& frame = player.waitFor((number + 0.5) / player.info().fps)->pixelsBgr;
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
