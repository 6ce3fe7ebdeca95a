// Spines: found in any chain of joints, bent to known curves, and in the shipped models as wide as asked.
#include "engine/scene/Spine.h"
#include "tests/unit/scene/Fixture.h"

namespace shoal::scene {
namespace {

// A body of length 2 along z from -1 to 1: joints at equal distances, each the next one's parent, from the
// snout to the tail, or the other way round; with a fin at the side. `turned`: their own axes lie otherwise.
Model chain(int joints, bool fromTail = false, glm::quat turned = {1, 0, 0, 0}) {
    Model model;
    Skin skin;
    const float step = 2.0f / static_cast<float>(joints) * (fromTail ? 1.0f : -1.0f);
    for (int i = 0; i < joints; ++i) {
        Node node;
        node.parent = i - 1;
        const glm::vec3 way(0, 0, i ? step : (fromTail ? -1.0f : 1.0f));
        node.parentFromNode.translation = i ? glm::conjugate(turned) * way : way;
        node.parentFromNode.rotation = i ? glm::quat(1, 0, 0, 0) : turned;
        if (i) model.nodes.back().children.push_back(i);
        model.nodes.push_back(node);
        model.order.push_back(i);
        skin.joints.push_back(i);
        skin.jointFromMesh.emplace_back(1);
    }
    const Node fin{.name = "fin",
                   .parentFromNode = {.translation = glm::conjugate(turned) * glm::vec3(0.3f, 0, 0)},
                   .parent = 1};
    model.nodes[1].children.insert(model.nodes[1].children.begin(), joints);
    model.nodes.push_back(fin);
    model.order.push_back(joints);
    skin.joints.push_back(joints);
    skin.jointFromMesh.emplace_back(1);
    model.skins.push_back(skin);
    return model;
}

glm::vec3 placeOf(const Pose& pose, size_t node) { return glm::vec3(pose.modelFromNode[node][3]); }

class Chains : public testing::TestWithParam<std::tuple<bool, glm::quat>> {};

// Even curvature lays the body on a circle: seen from its middle an arc s away, its points lie at
// r (1 - cos(s / r)) to the left and r sin(s / r) along, r = length / bend.
TEST_P(Chains, BendToAnArcAboutTheMiddle) {
    constexpr int kJoints = 40;
    const auto [fromTail, turned] = GetParam();
    const Model model = chain(kJoints, fromTail, turned);
    const Spine spine = findSpine(model, 2, -1);
    ASSERT_EQ(spine.joints.size(), static_cast<size_t>(kJoints));
    const Pose rest = restOf(model);
    for (const glm::vec2 by :
         {glm::vec2(1, 0), glm::vec2(-0.6f, 0), glm::vec2(0, 0.8f), glm::vec2(0.7f, -0.5f)}) {
        Pose pose = rest;
        const size_t middle = static_cast<size_t>(spine.joints[spine.middle].node);
        const glm::mat4 before = pose.modelFromNode[middle];
        bend(spine, by.x, by.y, pose);
        updateGlobals(model, pose);
        for (int c = 0; c < 4; ++c) // 40 products of rounded rotations, there and back
            EXPECT_LT(glm::length(pose.modelFromNode[middle][c] - before[c]), 2e-5f);
        const float angle = glm::length(by), radius = 2 / angle;
        const glm::vec2 side = by / angle;
        for (const Spine::Joint& joint : spine.joints) {
            const auto node = static_cast<size_t>(joint.node);
            const float s = placeOf(rest, node).z - placeOf(rest, middle).z;
            const float off = radius * (1 - std::cos(s / radius));
            const glm::vec3 arc(side.x * off, side.y * off,
                                placeOf(rest, middle).z + radius * std::sin(s / radius));
            // A polygon of segments of 0.05 leaves its circle by half a segment times half a joint's angle.
            EXPECT_LT(glm::distance(placeOf(pose, node), arc), 0.05f * angle) << s;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Spine, Chains,
    testing::Combine(testing::Bool(),
                     testing::Values(glm::quat(1, 0, 0, 0), glm::angleAxis(1.5707963f, glm::vec3(1, 0, 0)),
                                     glm::normalize(glm::quat(0.4f, 0.3f, -0.7f, 0.5f)))));

TEST(Spine, IsNotFoundWhereThereIsNone) {
    Model model = chain(2);
    EXPECT_TRUE(findSpine(model, 2, -1).joints.empty());
    model.skins.clear();
    const Spine none = findSpine(model, 2, -1);
    EXPECT_TRUE(none.joints.empty());
    const Pose same = restOf(model);
    Pose pose = same;
    bend(none, 1, 1, pose);
    scaleWave(none, 0, pose);
    for (size_t i = 0; i < pose.local.size(); ++i) {
        EXPECT_EQ(pose.local[i].rotation, same.local[i].rotation);
        EXPECT_EQ(pose.local[i].translation, same.local[i].translation);
    }
}

struct Animal {
    const char *name, *clip;
};

class ShippedSpines : public testing::TestWithParam<Animal> {
  protected:
    void SetUp() override {
        model_ = shipped(GetParam().name);
        restPose(model_, pose_);
        const Bounds bounds = posedBounds(model_, pose_);
        spine_ = findSpine(model_, bounds.high.z - bounds.low.z, bounds.low.z);
        clip_ = model_.findAnimation(GetParam().clip);
        ASSERT_GE(clip_, 0);
    }
    // Returns how far to the side a point of the chain is after so many loops, metres.
    float sideOf(size_t joint, const glm::vec3& at, float loops, float factor = 1) {
        const float duration_s = model_.animations[clip_].duration_s;
        restPose(model_, pose_);
        animate(model_, clip_, duration_s * (loops - std::floor(loops)), pose_);
        scaleWave(spine_, factor, pose_);
        updateGlobals(model_, pose_);
        const auto node = static_cast<size_t>(spine_.joints[joint].node);
        return (pose_.modelFromNode[node] * glm::vec4(at, 1)).x;
    }
    // Returns half the sweep of a point of the chain to the sides over a loop, metres.
    float sweep(size_t joint, const glm::vec3& at, float factor) {
        float low = 1e9f, high = -1e9f;
        for (int i = 0; i < 48; ++i) {
            const float x = sideOf(joint, at, static_cast<float>(i) / 48, factor);
            low = std::min(low, x);
            high = std::max(high, x);
        }
        return 0.5f * (high - low);
    }
    Model model_;
    Pose pose_;
    Spine spine_;
    int clip_ = -1;
};

TEST_P(ShippedSpines, HaveEightJointsOrMoreFromHeadToTail) {
    ASSERT_GE(spine_.joints.size(), 8u);
    for (const Spine::Joint& joint : spine_.joints)
        EXPECT_EQ(model_.nodes[joint.node].name.substr(0, 6), "spine_");
}

// Scaled to a tenth of the length at the tail's tip (Bainbridge 1958), growing from the body's middle to
// there (Videler & Hess 1984).
TEST_P(ShippedSpines, SwingAsWideAsAskedAndWiderTowardsTheTail) {
    const TailBeat beat = measureBeat(model_, spine_, clip_, pose_);
    EXPECT_GE(beat.perLoop, 1);
    ASSERT_GT(beat.amplitude, 0.02f);
    const float factor = 0.1f / beat.amplitude;
    const float tail = sweep(spine_.last, spine_.tipInLast, factor) / spine_.length_m;
    // Turns add up to more than a small angle's sine: 10 %.
    EXPECT_NEAR(tail, 0.1f, 0.01f);
    float before = 0;
    for (size_t j = spine_.joints.size() / 2; j < spine_.joints.size(); ++j) {
        const float here = sweep(j, glm::vec3(0), factor);
        EXPECT_GT(here, before) << j;
        before = here;
    }
    EXPECT_LT(sweep(0, glm::vec3(0), factor), 0.45f * tail * spine_.length_m) << "the head stays calm";
    EXPECT_NEAR(sweep(spine_.last, spine_.tipInLast, 0), 0, 1e-5f * spine_.length_m);
}

// At the phase that the beat names, the tail passes the middle to the left.
TEST_P(ShippedSpines, TellWhenTheTailPassesTheMiddle) {
    const TailBeat beat = measureBeat(model_, spine_, clip_, pose_);
    const auto tailAt = [&](float loops) {
        return sideOf(spine_.last, spine_.tipInLast, loops) / spine_.length_m;
    };
    EXPECT_NEAR(tailAt(beat.offset), 0, 0.2f * beat.amplitude);
    EXPECT_GT(tailAt(beat.offset + 0.25f / beat.perLoop), 0.8f * beat.amplitude);
    EXPECT_LT(tailAt(beat.offset - 0.25f / beat.perLoop), -0.8f * beat.amplitude);
}

INSTANTIATE_TEST_SUITE_P(Content, ShippedSpines,
                         testing::Values(Animal{"clownfish", "swim"}, Animal{"angelfish", "swim"},
                                         Animal{"snapper", "swim"}, Animal{"sardine", "swim"},
                                         Animal{"sardine", "dart"}, Animal{"shark", "cruise"}),
                         [](const auto& animal) {
                             return std::string(animal.param.name) + "_" + animal.param.clip;
                         });

} // namespace
} // namespace shoal::scene
