#include "tests/unit/scene/Fixture.h"

namespace shoal::scene {
namespace {

// Few float operations on numbers near 1: a few units in the last place.
constexpr float kTol = 1e-6f;

Model withChannel(Channel channel) {
    Model model;
    model.nodes.emplace_back();
    model.order = {0};
    channel.node = 0;
    model.animations.push_back({"swim", channel.times_s.back(), {channel}});
    return model;
}

// Returns the pose of withChannel() at this time.
Pose poseAt(const Channel& channel, float time_s) {
    const Model model = withChannel(channel);
    Pose pose = restOf(model);
    animate(model, 0, time_s, pose);
    return pose;
}

glm::vec3 translationAt(Channel::Interpolation interpolation, std::vector<float> values, float time_s) {
    return poseAt({Channel::Target::Translation, interpolation, 0, {1, 3}, std::move(values)}, time_s)
        .local[0]
        .translation;
}

glm::quat about(const glm::vec3& axis, float angle) { return glm::angleAxis(angle, axis); }

std::vector<float> xyzw(std::initializer_list<glm::quat> quats) {
    std::vector<float> values;
    for (const glm::quat& q : quats) values.insert(values.end(), {q.x, q.y, q.z, q.w});
    return values;
}

glm::quat rotationAt(std::vector<float> values, float time_s) {
    return poseAt({Channel::Target::Rotation, Channel::Interpolation::Linear, 0, {0, 1}, std::move(values)},
                  time_s)
        .local[0]
        .rotation;
}

float distance(const glm::quat& a, const glm::quat& b) { // q and -q are one rotation
    return std::min(glm::length(a - b), glm::length(a + b));
}

using I = Channel::Interpolation;

TEST(Animate, StepHoldsEachKeyUntilTheNext) {
    const std::vector<float> values = {1, 2, 3, 4, 5, 6};
    EXPECT_EQ(translationAt(I::Step, values, 1), glm::vec3(1, 2, 3));
    EXPECT_EQ(translationAt(I::Step, values, 2.999f), glm::vec3(1, 2, 3));
    EXPECT_EQ(translationAt(I::Step, values, 3), glm::vec3(4, 5, 6));
}

TEST(Animate, LinearMixesAndIsClampedToItsKeys) {
    const std::vector<float> values = {0, 2, -4, 4, 2, 4};
    EXPECT_EQ(translationAt(I::Linear, values, 1.5f), glm::vec3(1, 2, -2)); // exact in binary
    EXPECT_EQ(translationAt(I::Linear, values, -7), glm::vec3(0, 2, -4));
    EXPECT_EQ(translationAt(I::Linear, values, 70), glm::vec3(4, 2, 4));
    EXPECT_EQ(translationAt(I::Linear, values, NAN).y, 2);
}

TEST(Animate, CubicSplineFollowsACubic) {
    // x(t) = t^3 between t = 1 and 3 is its own Hermite spline: values 1 and 27, slopes 3 and 27.
    const std::vector<float> values = {9, 9, 9, 1, 0, 0, 3, 0, 0, 27, 0, 0, 27, 0, 0, 9, 9, 9};
    for (const float t : {1.0f, 1.25f, 2.0f, 2.5f, 3.0f})
        EXPECT_NEAR(translationAt(I::CubicSpline, values, t).x, t * t * t, 27 * kTol) << t;
    EXPECT_EQ(translationAt(I::CubicSpline, values, 0), glm::vec3(1, 0, 0));
    EXPECT_EQ(translationAt(I::CubicSpline, values, 4), glm::vec3(27, 0, 0));
}

TEST(Animate, RotationsTurnEvenlyByTheShorterWay) {
    const float quarter = glm::half_pi<float>();
    const glm::quat a(1, 0, 0, 0), b = about({0, 1, 0}, quarter);
    EXPECT_LT(distance(rotationAt(xyzw({a, b}), 0.25f), about({0, 1, 0}, quarter / 4)), kTol);
    // -b is the same rotation by the longer way round: it must not be taken.
    EXPECT_LT(distance(rotationAt(xyzw({a, -b}), 0.25f), about({0, 1, 0}, quarter / 4)), kTol);
    EXPECT_LT(distance(rotationAt(xyzw({a, -b}), 1), b), kTol);
    EXPECT_LT(distance(rotationAt(xyzw({a, -a}), 0.5f), a), kTol);
}

TEST(Animate, CubicRotationsStayOfLengthOne) {
    const glm::quat a(1, 0, 0, 0), b = about({1, 0, 0}, 2), zero(0, 0, 0, 0);
    const Pose pose = poseAt(
        {Channel::Target::Rotation, I::CubicSpline, 0, {0, 1}, xyzw({zero, a, zero, zero, b, zero})}, 0.5f);
    EXPECT_NEAR(glm::length(pose.local[0].rotation), 1, kTol);
    EXPECT_LT(distance(pose.local[0].rotation, about({1, 0, 0}, 1)), kTol); // halfway by symmetry
}

TEST(Animate, WeightBlendsBetweenPoseAndAnimation) {
    const Model model = withChannel({Channel::Target::Scale, I::Linear, 0, {0, 1}, {3, 3, 3, 3, 3, 3}});
    Pose pose = restOf(model);
    animate(model, 0, 0.5f, pose, 0);
    EXPECT_EQ(pose.local[0].scale, glm::vec3(1));
    animate(model, 0, 0.5f, pose, 0.5f);
    EXPECT_EQ(pose.local[0].scale, glm::vec3(2));
    animate(model, 0, 0.5f, pose, 1);
    EXPECT_EQ(pose.local[0].scale, glm::vec3(3));
}

TEST(Animate, MorphWeightsMoveTogetherAndNothingAllocates) {
    Model model = withChannel({Channel::Target::Weights, I::Linear, 0, {0, 1}, {0, 1, 1, 0}});
    model.meshes.emplace_back().morphWeights = {0.25f, 0.5f};
    model.nodes[0].mesh = 0;
    Pose pose = restOf(model);
    EXPECT_EQ(pose.morphWeights[0], (std::vector<float>{0.25f, 0.5f}));
    const float* weights = pose.morphWeights[0].data();
    const Transform* local = pose.local.data();
    restPose(model, pose);
    animate(model, 0, 0.25f, pose);
    EXPECT_EQ(pose.morphWeights[0], (std::vector<float>{0.25f, 0.75f}));
    EXPECT_EQ(pose.morphWeights[0].data(), weights);
    EXPECT_EQ(pose.local.data(), local);
}

void expectNear(const glm::vec3& actual, const glm::vec3& expected, float tolerance) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], tolerance) << "component " << i;
}

// A bar from (0, 0, 0) to (0, 2, 0); joint 0 at its foot, joint 1, its child, in the middle. The upper vertex
// hangs on joint 1, the middle one on both.
Model bar() {
    Model model;
    model.nodes.resize(3);
    model.nodes[0].children = {2}; // the upper joint comes before its parent in the file's order
    model.nodes[2].parent = 0;
    model.nodes[0].parent = -1;
    model.nodes[2].parentFromNode.translation = {0, 1, 0};
    model.nodes[1].mesh = 0;
    model.nodes[1].skin = 0;
    model.nodes[1].parentFromNode.translation = {50, 50, 50}; // a skinned node's own place does not count
    model.order = {0, 1, 2};
    model.skins.push_back({{0, 2}, {glm::mat4(1), glm::translate(glm::mat4(1), {0, -1, 0})}});
    Primitive primitive;
    primitive.positions = {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
    primitive.normals.resize(3, {0, 0, 1});
    primitive.joints = {{0, 0, 0, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}};
    primitive.weights = {{1, 0, 0, 0}, {0.5f, 0.5f, 0, 0}, {1, 0, 0, 0}};
    primitive.indices = {0, 1, 2};
    model.meshes.push_back({{primitive}, {}});
    return model;
}

TEST(Skin, ABentJointCarriesItsVertices) {
    const Model model = bar();
    Pose pose = restOf(model);
    pose.local[2].rotation = glm::angleAxis(glm::half_pi<float>(), glm::vec3(0, 0, 1)); // up turns to -X
    updateGlobals(model, pose);
    std::vector<glm::mat4> matrices;
    skinMatrices(model, 0, pose, matrices);
    ASSERT_EQ(matrices.size(), 2u);
    EXPECT_EQ(matrices[0], glm::mat4(1));
    expectNear(matrices[1] * glm::vec4(0, 2, 0, 1), {-1, 1, 0}, kTol);
    const Bounds bounds = posedBounds(model, pose);
    expectNear(bounds.low, {-1, 0, 0}, kTol);
    expectNear(bounds.high, {0, 1, 0}, kTol);
    const glm::mat4* data = matrices.data();
    skinMatrices(model, 0, pose, matrices);
    EXPECT_EQ(matrices.data(), data);
}

TEST(Globals, AreTranslationAfterRotationAfterScaleDownTheTree) {
    Model model;
    model.nodes.resize(2);
    model.nodes[0].children = {1};
    model.nodes[1].parent = 0;
    model.nodes[0].parentFromNode = {
        {1, 0, 0}, glm::angleAxis(glm::half_pi<float>(), glm::vec3(0, 0, 1)), {2, 3, 4}};
    model.nodes[1].matrix = glm::translate(glm::mat4(1), {1, 1, 1});
    model.order = {0, 1};
    Pose pose = restOf(model);
    // (1,1,1) scaled to (2,3,4), turned to (-3,2,4), moved to (-2,2,4).
    expectNear(pose.modelFromNode[1] * glm::vec4(0, 0, 0, 1), {-2, 2, 4}, 4 * kTol);
}

TEST(Bounds, FollowMorphs) {
    Model model;
    model.nodes.resize(1);
    model.nodes[0].mesh = 0;
    model.order = {0};
    Primitive primitive;
    primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    primitive.normals.resize(3, {0, 0, 1});
    primitive.morphTargets.push_back({{{0, 0, 0}, {4, 0, 0}, {0, 0, -2}}, {}});
    model.meshes.push_back({{primitive}, {0.5f}});
    Pose pose = restOf(model);
    EXPECT_EQ(posedBounds(model, pose).high, glm::vec3(3, 1, 0));
    EXPECT_EQ(posedBounds(model, pose).low, glm::vec3(0, 0, -1));
}

// SimpleSkin, whose numbers its README gives: two joints; at 1 s the upper one is turned by 90 degrees.
TEST(SimpleSkin, BendsAsItsKeysSay) {
    const Path file = sharedData() / "gltf/SimpleSkin/SimpleSkin.gltf";
    if (!exists(file)) GTEST_SKIP() << "no " << file;
    const auto model = tests::valueOf(loadModel(file));
    ASSERT_EQ(model.skins.size(), 1u);
    ASSERT_EQ(model.skins[0].joints.size(), 2u);
    ASSERT_EQ(model.animations.size(), 1u);
    Pose pose = restOf(model);
    animate(model, 0, 1.0f, pose);
    const glm::quat turned = pose.local[model.skins[0].joints[1]].rotation;
    // The file holds 0.707 for the root of 1/2: an angle off by 1.5e-4 at most.
    EXPECT_NEAR(std::abs(glm::angle(turned)), glm::half_pi<float>(), 1e-3f);
    updateGlobals(model, pose);
    // The top, 1 above the joint at (0, 1, 0), lies beside it now.
    const Bounds bounds = posedBounds(model, pose);
    EXPECT_LT(bounds.high.y, 1.6f);
    EXPECT_GT(std::max(bounds.high.x, -bounds.low.x), 0.9f);
}

} // namespace
} // namespace shoal::scene
