// The runtime that this machine has, where it has one and a display.
#include "engine/platform/Window.h"
#include "engine/xr/Headset.h"
#include "tests/Test.h"

namespace shoal::xr {
namespace {

// Returns whether a runtime is configured, looked for as by the loader.
bool runtimeIsNamed() {
    if (const char* json = std::getenv("XR_RUNTIME_JSON")) return *json != 0;
    const char* config = std::getenv("XDG_CONFIG_HOME");
    const char* home = std::getenv("HOME");
    const std::filesystem::path own = config && *config ? config : home ? std::string(home) + "/.config" : "";
    for (const std::filesystem::path& folder :
         {own, std::filesystem::path("/etc/xdg"), std::filesystem::path("/usr/local/etc"),
          std::filesystem::path("/etc"), std::filesystem::path("/usr/share")})
        if (std::filesystem::exists(folder / "openxr/1/active_runtime.json")) return true;
    return false;
}

TEST(RealRuntime, TakesEmptyFramesAndLetsGo) {
    if (!runtimeIsNamed())
        GTEST_SKIP() << "no OpenXR runtime: neither XR_RUNTIME_JSON nor an active_runtime.json names one";
    auto window = platform::Window::open({"Shoal's test", 320, 240, false, false});
    if (!window) GTEST_SKIP() << window.error().message();
    auto headset = Headset::open({96, 60});
    if (!headset) GTEST_SKIP() << headset.error().message(); // a runtime, and no headset plugged in
    for (int i = 0; i < 300; ++i) {
        const Status polled = headset->poll();
        ASSERT_TRUE(polled) << polled.error().message();
        if (!headset->wantsFrames()) continue;
        const auto frame = tests::valueOf(headset->waitFrame());
        const Status begun = headset->begin();
        ASSERT_TRUE(begun) << begun.error().message();
        const Status ended = headset->end({});
        ASSERT_TRUE(ended) << ended.error().message();
    }
}

} // namespace
} // namespace shoal::xr
