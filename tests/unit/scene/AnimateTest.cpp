#include "engine/scene/Model.h"

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace shoal::scene {
namespace {

// Few float operations on numbers near 1: a few units in the last place.
constexpr float kAnimateTol = 1e-6f;

Model withChannel(Channel channel) {
    Model model;
    model.nodes.emplace_back();
    model.order = {0};
    channel.node = 0;
    model.animations.push_back({"swim", channel.times_s.back(), {channel}});
    return model;
}

glm::vec3 translationAt(Channel::Interpolation interpolation, std::vector<float> values, float time_s) {
    const Model model =
        withChannel({Channel::Target::Translation, interpolation, 0, {1, 3}, std::move(values)});
    Pose pose;
    restPose(model, pose);
    animate(model, 0, time_s, pose);
    return pose.local[0].translation;
}

glm::quat about(const glm::vec3& axis, float angle) { return glm::angleAxis(angle, axis); }

std::vector<float> xyzw(std::initializer_list<glm::quat> quats) {
    std::vector<float> values;
    for (const glm::quat& q : quats) values.insert(values.end(), {q.x, q.y, q.z, q.w});
    return values;
}

glm::quat rotationAt(std::vector<float> values, float time_s) {
    const Model model = withChannel(
        {Channel::Target::Rotation, Channel::Interpolation::Linear, 0, {0, 1}, std::move(values)});
    Pose pose;
    restPose(model, pose);
    animate(model, 0, time_s, pose);
    return pose.local[0].rotation;
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
        EXPECT_NEAR(translationAt(I::CubicSpline, values, t).x, t * t * t, 27 * kAnimateTol) << t;
    EXPECT_EQ(translationAt(I::CubicSpline, values, 0), glm::vec3(1, 0, 0));
    EXPECT_EQ(translationAt(I::CubicSpline, values, 4), glm::vec3(27, 0, 0));
}

TEST(Animate, RotationsTurnEvenlyByTheShorterWay) {
    const float quarter = glm::half_pi<float>();
    const glm::quat a(1, 0, 0, 0), b = about({0, 1, 0}, quarter);
    EXPECT_LT(distance(rotationAt(xyzw({a, b}), 0.25f), about({0, 1, 0}, quarter / 4)), kAnimateTol);
    // -b is the same rotation by the longer way round: it must not be taken.
    EXPECT_LT(distance(rotationAt(xyzw({a, -b}), 0.25f), about({0, 1, 0}, quarter / 4)), kAnimateTol);
    EXPECT_LT(distance(rotationAt(xyzw({a, -b}), 1), b), kAnimateTol);
    EXPECT_LT(distance(rotationAt(xyzw({a, -a}), 0.5f), a), kAnimateTol);
}

TEST(Animate, CubicRotationsStayOfLengthOne) {
    const glm::quat a(1, 0, 0, 0), b = about({1, 0, 0}, 2), zero(0, 0, 0, 0);
    const Model model = withChannel(
        {Channel::Target::Rotation, I::CubicSpline, 0, {0, 1}, xyzw({zero, a, zero, zero, b, zero})});
    Pose pose;
    restPose(model, pose);
    animate(model, 0, 0.5f, pose);
    EXPECT_NEAR(glm::length(pose.local[0].rotation), 1, kAnimateTol);
    EXPECT_LT(distance(pose.local[0].rotation, about({1, 0, 0}, 1)), kAnimateTol); // halfway by symmetry
}

TEST(Animate, WeightBlendsBetweenPoseAndAnimation) {
    const Model model = withChannel({Channel::Target::Scale, I::Linear, 0, {0, 1}, {3, 3, 3, 3, 3, 3}});
    Pose pose;
    restPose(model, pose);
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
    Pose pose;
    restPose(model, pose);
    EXPECT_EQ(pose.morphWeights[0], (std::vector<float>{0.25f, 0.5f}));
    const float* weights = pose.morphWeights[0].data();
    const Transform* local = pose.local.data();
    restPose(model, pose);
    animate(model, 0, 0.25f, pose);
    EXPECT_EQ(pose.morphWeights[0], (std::vector<float>{0.25f, 0.75f}));
    EXPECT_EQ(pose.morphWeights[0].data(), weights);
    EXPECT_EQ(pose.local.data(), local);
}

} // namespace
} // namespace shoal::scene
