// The fake runtime behind the real loader, on a display without a screen. Where Khronos' layer that checks an
// application's calls is installed (openxr-layer-corevalidation), it lies between.
#pragma once

#include "engine/core/Files.h"
#include "engine/platform/Window.h"
#include "tests/Test.h"
#include "tests/gl/xr/VirtualDisplay.h"
#include "tests/gl/xr/runtime/FakeRuntime.h"

#include <regex>

namespace shoal::test {

inline glm::vec3 vectorOf(const XrVector3f& v) { return {v.x, v.y, v.z}; }

class WithFakeRuntime : public testing::Test {
  protected:
    FakeRuntime& fake = shoalFakeRuntime();
    std::optional<platform::Window> window_; // where openWindow() has been called
    bool validated_ = false;
    const tests::ScratchFolder validationFolder_;
    const Path validation_ = validationFolder_ / "validation.txt";

    static bool layerIsInstalled() {
        std::error_code none;
        for (const auto& file :
             std::filesystem::directory_iterator("/usr/share/openxr/1/api_layers/explicit.d", none))
            if (file.path().filename().string().starts_with("XrApiLayer_core_validation")) return true;
        return false;
    }
    // Debian's layer (1.0.20) refuses structures of extensions that are younger.
    static void withoutValidation() { unsetenv("XR_ENABLE_API_LAYERS"); }
    // Returns the layer's complaints; without any it writes no file. Lines about its start and end, which
    // version 1.1 writes too, are left out.
    std::string validationReport() const {
        const auto text = readText(validation_);
        return std::regex_replace(text ? *text : "", std::regex("[^\n]*VALID_DEBUG[^\n]*\n"), "");
    }

    void SetUp() override {
        fake = FakeRuntime();
        setenv("XR_RUNTIME_JSON", FAKE_RUNTIME_JSON, 1);
        validated_ = layerIsInstalled();
        if (validated_) {
            setenv("XR_ENABLE_API_LAYERS", "XR_APILAYER_LUNARG_core_validation", 1);
            setenv("XR_CORE_VALIDATION_EXPORT_TYPE", "text", 1);
            setenv("XR_CORE_VALIDATION_FILE_NAME", validation_.c_str(), 1);
        }
        static const VirtualDisplay display; // of all cases
        if (!display) GTEST_SKIP() << "needs Xvfb";
    }
    void openWindow() { window_ = tests::valueOf(platform::Window::open({"test", 64, 64, false, false})); }
    // Puts the middle between the eyes there, in LOCAL.
    void placeHead(glm::vec3 at, glm::quat turn = {1, 0, 0, 0}) {
        for (size_t eye = 0; eye < 2; ++eye) {
            const glm::vec3 p = at + turn * glm::vec3(eye == 0 ? -0.032f : 0.032f, 0, 0);
            fake.views[eye].pose = {{turn.x, turn.y, turn.z, turn.w}, {p.x, p.y, p.z}};
        }
    }
    // Checks that all objects were destroyed and that no forbidden call was made.
    void TearDown() override {
        window_.reset();
        EXPECT_EQ(fake.complaints, std::vector<std::string>());
        EXPECT_EQ(validationReport(), "");
        EXPECT_THAT(
            (std::array{fake.instances, fake.sessions, fake.swapchains, fake.spaces, fake.handTrackers}),
            testing::Each(0));
    }
};

} // namespace shoal::test
