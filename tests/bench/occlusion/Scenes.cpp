#include "tests/bench/occlusion/Scene.h"

#include "engine/physics/Grip.h"
#include "engine/render/BakedOcclusion.h"
#include "engine/scene/Model.h"
#include "input/hands/HandRig.h"

#include <glm/gtc/matrix_transform.hpp>

namespace shoal::bench {

namespace {

using glm::mat4;
using glm::vec3;

Path models() { return dataRoot() / "content" / "models"; }

// A model in a pose; length_m: extent of its rest pose along z, with fins.
struct ModelInstance {
    scene::Model model;
    scene::Pose pose;
    float length_m = 1;
};

Result<ModelInstance> loadInstance(const std::string& name) {
    auto model = scene::loadModel(models() / (name + ".glb"));
    if (!model) return model.error();
    ModelInstance instance{std::move(*model), {}, 1};
    scene::restPose(instance.model, instance.pose);
    const scene::Bounds bounds = scene::posedBounds(instance.model, instance.pose);
    instance.length_m = bounds.high.z - bounds.low.z;
    return instance;
}

// Reads the occlusion that the game keeps beside the model.
Result<render::BakedOcclusion> shadeFor(ModelInstance& instance, const std::string& name) {
    const Path file = render::bakedOcclusionBeside(models() / (name + ".glb"));
    auto shade = render::readBakedOcclusion(file);
    if (shade && !render::applyBakedOcclusion(*shade, instance.model))
        return Error{file.string(), "is another model's; content/make/models/make_occlusion bakes it anew"};
    return shade;
}

// Returns the body by linear blend skinning. fins: whether thin fins that let some light through count as
// solid, or are left out.
Body bodyOf(const std::string& name, const ModelInstance& instance, const mat4& worldFromModel, bool fins) {
    Body body{.name = name};
    const float size = glm::length(vec3(worldFromModel[0]));
    for (const int index : instance.model.order) {
        const scene::Node& node = instance.model.nodes[index];
        if (node.mesh < 0 || node.skin < 0) continue;
        std::vector<mat4> bones;
        scene::skinMatrices(instance.model, node.skin, instance.pose, bones);
        for (mat4& bone : bones) bone = worldFromModel * bone;
        for (const scene::Primitive& part : instance.model.meshes[node.mesh].primitives) {
            const auto blended = part.material >= 0 && instance.model.materials[part.material].alphaMode !=
                                                           scene::AlphaMode::Opaque;
            if (blended && !fins) continue;
            const auto base = static_cast<uint32_t>(body.posed.positions.size());
            for (size_t i = 0; i < part.positions.size(); ++i) {
                mat4 moved(0);
                int maximum = 0;
                for (int k = 0; k < 4; ++k) {
                    moved += part.weights[i][k] * bones[part.joints[i][k]];
                    if (part.weights[i][k] > part.weights[i][maximum]) maximum = k;
                }
                body.posed.positions.emplace_back(moved * glm::vec4(part.positions[i], 1));
                body.posed.normals.push_back(glm::normalize(glm::mat3(moved) * part.normals[i]));
                body.rest.positions.push_back(size * part.positions[i]);
                body.rest.normals.push_back(part.normals[i]);
                body.boneOf.push_back(part.joints[i][maximum]);
                body.turned.push_back(glm::mat3(moved));
            }
            body.selfOcclusionBesideOwn.insert(body.selfOcclusionBesideOwn.end(),
                                               part.selfOcclusionBesideOwn.begin(),
                                               part.selfOcclusionBesideOwn.end());
            for (size_t i = 0; i < part.indices.size(); i += 3)
                body.posed.triangles.emplace_back(base + part.indices[i], base + part.indices[i + 1],
                                                  base + part.indices[i + 2]);
        }
        for (const mat4& bone : bones)
            body.worldFromRest.push_back(bone * glm::scale(mat4(1), vec3(1 / size)));
    }
    body.rest.triangles = body.posed.triangles;
    return body;
}

Body rigid(const std::string& name, Mesh mesh) {
    Body body{.name = name};
    body.rest = body.posed = std::move(mesh);
    body.boneOf.assign(body.posed.positions.size(), 0);
    body.turned.assign(body.posed.positions.size(), glm::mat3(1));
    body.worldFromRest = {mat4(1)};
    return body;
}

mat4 placed(const vec3& at, float yaw, float pitch, float size) {
    const mat4 turned = glm::rotate(glm::translate(mat4(1), at), yaw, vec3(0, 1, 0));
    return glm::scale(glm::rotate(turned, pitch, vec3(1, 0, 0)), vec3(size));
}

Scene single(const std::string& name, Body body, const vec3& eye, float fovY, bool mirror) {
    Scene scene{.name = name, .camera = {eye, {0, 0, 0}, fovY}, .mirror = mirror};
    scene.bodies.push_back(std::move(body));
    return scene;
}

Result<Scene> fishScene() {
    auto fish = loadInstance("snapper");
    if (!fish) return fish.error();
    scene::animate(fish->model, fish->model.findAnimation("dart"), 0.2f, fish->pose);
    scene::updateGlobals(fish->model, fish->pose);
    Scene scene =
        single("fish", bodyOf("snapper", *fish, placed({0, 0, 0}, 0.9f, 0, 0.30f / fish->length_m), true),
               {0, 0.06f, 0.50f}, 0.46f, false);
    scene.bodies[0].albedoLin = {0.75f, 0.45f, 0.40f};
    return scene;
}

void placeJoints(const hands::HandPose& pose, ModelInstance& hand) {
    for (size_t j = 0; j < hands::kJointNames.size(); ++j) {
        const int node = hand.model.findNode(std::string(hands::kJointNames[j]));
        hand.pose.modelFromNode[node] =
            glm::translate(mat4(1), pose.joints[j].position) * glm::mat4_cast(pose.joints[j].orientation);
    }
}

// A fist around a clownfish that lies across the palm, as the game closes it: bone by bone until they touch.
Result<Scene> handScene() {
    auto fish = loadInstance("clownfish"), hand = loadInstance("hand_right");
    if (!fish) return fish.error();
    if (!hand) return hand.error();
    const auto rig = hands::HandRig::load(models() / "hand_skeleton.json");
    if (!rig) return rig.error();
    const glm::quat roll = glm::angleAxis(-0.9f, vec3(0, 0, 1));
    hands::HandPose held = rig->pose(hands::Side::Right, {{0.75f, 0.85f, 0.85f, 0.85f, 0.85f}, 0},
                                     {roll * vec3(0, 0, 0.09f), roll});
    constexpr float kRadius = 0.022f, kHalf = 0.030f; // of the fish's capsule
    const hands::Joint& palm = held.joints[0];
    const vec3 hollow = palm.position + palm.orientation * vec3(0, -0.008f - kRadius, -0.030f);
    const vec3 along = palm.orientation * glm::normalize(vec3(-1, 0, -0.25f));
    for (int finger = 0; finger < hands::kFingerCount; ++finger) {
        const int first = hands::kFingerJoints[finger].metacarpal;
        physics::Finger given;
        given.count = hands::kFingerJoints[finger].count();
        for (int i = 0; i < given.count; ++i) {
            given.joints[i] = held.joints[first + i].position;
            given.radii[i] = i ? held.joints[first + i].radius : 0;
        }
        const physics::Finger rests =
            physics::wrapped(given, {hollow - along * kHalf, hollow + along * kHalf, kRadius});
        for (int i = 1; i < given.count; ++i) {
            hands::Joint& joint = held.joints[first + i];
            joint.position = rests.joints[i];
            joint.orientation = rests.turned[std::min(i + 1, given.count - 1)] * joint.orientation;
        }
    }
    const auto shade = shadeFor(*hand, "hand_right");
    if (!shade) return shade.error();
    placeJoints(held, *hand);
    const vec3 back = palm.orientation * vec3(0, 1, 0), right = glm::cross(back, along);
    const mat4 turned(glm::vec4(right, 0), glm::vec4(back, 0), glm::vec4(along, 0), glm::vec4(hollow, 1));
    Scene scene{.name = "hand closing on a fish",
                .camera = {{-0.26f, 0.10f, -0.30f}, {0, -0.01f, -0.02f}, 0.38f}};
    scene.bodies.push_back(
        bodyOf("clownfish", *fish, glm::scale(turned, vec3(0.13f / fish->length_m)), false));
    scene.bodies.push_back(bodyOf("hand", *hand, mat4(1), false));
    scene.bodies[0].albedoLin = {0.85f, 0.40f, 0.12f};
    scene.bodies[1].albedoLin = {0.70f, 0.50f, 0.40f};
    scene.bodies[1].group = 1;
    for (occlusion::BodyPart part : shade->parts) {
        const std::vector<int>& bones = hand->model.skins.at(0).joints;
        part.joint = static_cast<uint16_t>(std::ranges::find(bones, part.joint) - bones.begin());
        scene.bodies[1].parts.push_back(part);
    }
    return scene;
}

Result<Scene> sharkScene() {
    auto shark = loadInstance("shark"), fish = loadInstance("sardine");
    if (!shark) return shark.error();
    if (!fish) return fish.error();
    scene::animate(shark->model, shark->model.findAnimation("cruise"), 0.3f, shark->pose);
    scene::updateGlobals(shark->model, shark->pose);
    Scene scene{.name = "shark above a shoal",
                .camera = {{-1.05f, -0.42f, 1.0f}, {0, -0.04f, 0.1f}, 0.62f},
                .nearest = 3e-4f};
    scene.bodies.push_back(
        bodyOf("shark", *shark, placed({0, 0.22f, 0}, 0.3f, 0, 2.2f / shark->length_m), false));
    scene.bodies[0].albedoLin = {0.45f, 0.50f, 0.55f};
    for (int i = 0; i < 10; ++i) {
        const auto k = static_cast<float>(i);
        const vec3 at(-0.20f + 0.13f * static_cast<float>(i % 4), -0.16f - 0.07f * static_cast<float>(i % 3),
                      -0.35f + 0.09f * k);
        scene::animate(fish->model, fish->model.findAnimation("swim"), 0.07f * k, fish->pose);
        scene::updateGlobals(fish->model, fish->pose);
        scene.bodies.push_back(bodyOf(
            "sardine", *fish, placed(at, 0.4f + 0.05f * k, 0.04f * k - 0.2f, 0.14f / fish->length_m), false));
        scene.bodies.back().group = 1;
        scene.bodies.back().albedoLin = {0.60f, 0.65f, 0.70f};
    }
    return scene;
}

} // namespace

Result<std::vector<Scene>> makeScenes() {
    std::vector<Scene> scenes;
    scenes.push_back(single("teapot-like", rigid("teapot", teapot()), {0.10f, 0.20f, 0.42f}, 0.44f, true));
    scenes.push_back(single("bunny-like", rigid("bunny", bunny()), {0.30f, 0.14f, 0.42f}, 0.60f, false));
    scenes.push_back(single("torus", rigid("torus", torus()), {0.05f, 0.24f, 0.30f}, 0.46f, true));
    for (auto* make : {fishScene, handScene, sharkScene}) {
        auto scene = make();
        if (!scene) return scene.error();
        scenes.push_back(std::move(*scene));
    }
    for (const size_t black : {4, 5}) {
        Scene scene = scenes[black];
        scene.name = "colours: " + scene.name;
        for (Body& body : scene.bodies) body.sentBack = body.albedoLin;
        scenes.push_back(std::move(scene));
    }
    return scenes;
}

} // namespace shoal::bench
