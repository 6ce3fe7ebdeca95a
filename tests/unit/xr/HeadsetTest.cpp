// Conversion of a headset's poses and angles for the renderer.
#include "engine/xr/Headset.h"
#include "engine/xr/Tracked.h"
#include "tests/Test.h"

namespace shoal::xr {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// A point at the angle of an edge is drawn at that edge, whatever the eye's pose.
TEST(ViewOf, EdgesLieAtTheAnglesGiven) {
    for (const Fov fov : {Fov{-0.85f, 0.75f, 0.8f, -0.9f}, Fov{-0.5f, 0.5f, 0.5f, -0.5f},
                          Fov{-0.2f, 1.1f, 0.3f, 0.1f}, Fov{0.1f, 0.7f, -0.2f, -0.8f}}) {
        const Eye eye{{{0.03f, 1.2f, -0.4f}, glm::normalize(glm::quat(0.9f, 0.1f, -0.3f, 0.2f))}, fov};
        const render::View view = viewOf(eye);
        EXPECT_EQ(view.eyeWorld, eye.worldFromEye.position);
        const auto at = [&](float x, float y) {
            const glm::vec3 inEye = 3.0f * glm::vec3(std::tan(x), std::tan(y), -1);
            const glm::vec4 clip =
                view.clipFromWorld() *
                glm::vec4(eye.worldFromEye.position + eye.worldFromEye.orientation * inEye, 1);
            return glm::vec2(clip) / clip.w;
        };
        // Floats through a dozen products near 1; tangents up to 2.
        constexpr float kTol = 1e-5f;
        EXPECT_NEAR(at(fov.left, fov.up).x, -1, kTol);
        EXPECT_NEAR(at(fov.left, fov.up).y, 1, kTol);
        EXPECT_NEAR(at(fov.right, fov.down).x, 1, kTol);
        EXPECT_NEAR(at(fov.right, fov.down).y, -1, kTol);
    }
}

TEST(Pose, BetweenTheEyesIsTheHead) {
    // Displays turned outwards by 5 degrees each, and one quaternion of the other sign.
    const glm::quat outwards = glm::angleAxis(0.087f, glm::vec3(0, 1, 0));
    const Pose head = between({{-0.03f, 0, 0}, outwards}, {{0.03f, 0, 0}, -glm::conjugate(outwards)}, 0.5f);
    EXPECT_LT(glm::length(head.position), 1e-7f);
    EXPECT_NEAR(std::abs(head.orientation.w), 1, 1e-6f);
}

TEST(Pose, AnImpossiblePoseIsNotBelieved) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(believable(Pose{}));
    EXPECT_FALSE(believable(Pose{{nan, 0, 0}}));
    EXPECT_FALSE(believable(Pose{{0, 1e9f, 0}}));
    EXPECT_FALSE(believable(Pose{{0, 0, 0}, {0, 0, 0, 0}}));
    EXPECT_FALSE(believable(Pose{{0, 0, 0}, {nan, 0, 0, 0}}));
    EXPECT_TRUE(believable(Fov{-0.8f, 0.8f, 0.8f, -0.8f}));
    EXPECT_FALSE(believable(Fov{0.8f, -0.8f, 0.8f, -0.8f}));
    EXPECT_FALSE(believable(Fov{-0.8f, 1.6f, 0.8f, -0.8f}));
    EXPECT_FALSE(believable(Fov{nan, 0.8f, 0.8f, -0.8f}));
    EXPECT_FALSE(believable(Fov{}));
}

// The dive begins level, ahead where the player looks, at the height of the eyes.
TEST(OriginAt, IsUprightBelowEveryHead) {
    for (const float yaw : {0.0f, 0.7f, -2.9f, kPi})
        for (const float pitch : {0.0f, 0.6f, -1.2f, kPi / 2, -kPi / 2}) {
            const glm::quat turn =
                glm::angleAxis(yaw, glm::vec3(0, 1, 0)) * glm::angleAxis(pitch, glm::vec3(1, 0, 0));
            const Pose origin = originAt({{1, 1.7f, -2}, turn * glm::angleAxis(0.2f, glm::vec3(0, 0, -1))});
            EXPECT_EQ(origin.position, glm::vec3(1, 1.7f, -2));
            EXPECT_NEAR((origin.orientation * glm::vec3(0, 1, 0)).y, 1, 1e-6f);
            const glm::vec3 ahead = origin.orientation * glm::vec3(0, 0, -1);
            // A head that is tilted sideways and looks steeply has its top a little aside: 0.2 at most.
            EXPECT_GT(glm::dot(ahead, glm::vec3(-std::sin(yaw), 0, -std::cos(yaw))), std::cos(0.21f))
                << yaw << " " << pitch;
        }
}

// Tests of the search for a headset's runtime, which follows the OpenXR loader's.

TEST(HeadsetRuntime, IsFoundInThePlayersFolderOrByItsVariable) {
    const bool elsewhere = std::filesystem::exists("/etc/xdg/openxr/1/active_runtime.json") ||
                           std::filesystem::exists("/etc/openxr/1/active_runtime.json");
    const tests::ScratchFolder folder;
    ::unsetenv("XR_RUNTIME_JSON");
    ::setenv("XDG_CONFIG_HOME", folder.path().c_str(), 1);
    EXPECT_EQ(Headset::hasRuntime(), elsewhere);
    std::filesystem::create_directories(folder.path() / "openxr/1");
    std::ofstream(folder.path() / "openxr/1/active_runtime.json") << "{}";
    EXPECT_TRUE(Headset::hasRuntime());
    ::setenv("XDG_CONFIG_HOME", (folder.path() / "empty").c_str(), 1);
    EXPECT_EQ(Headset::hasRuntime(), elsewhere);
    ::setenv("XR_RUNTIME_JSON", "/a/runtime.json", 1);
    EXPECT_TRUE(Headset::hasRuntime());
    ::unsetenv("XR_RUNTIME_JSON");
    ::unsetenv("XDG_CONFIG_HOME");
}

} // namespace
} // namespace shoal::xr
