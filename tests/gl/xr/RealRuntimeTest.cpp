// The runtime that this machine has, where it has one and a display.
#include "engine/platform/Window.h"
#include "engine/xr/Headset.h"
#include "tests/Test.h"

namespace shoal::xr {
namespace {

TEST(RealRuntime, TakesEmptyFramesAndLetsGo) {
    if (const auto runtime = activeRuntime(); !runtime) GTEST_SKIP() << runtime.error().message();
    auto window = platform::Window::open({"Shoal's test", 320, 240, false, false});
    if (!window) GTEST_SKIP() << window.error().message();
    auto headset = Headset::open({96, 60});
    if (!headset) GTEST_SKIP() << headset.error().message(); // a runtime, and no headset plugged in
    for (int i = 0; i < 300; ++i) {
        ASSERT_TRUE(tests::succeeded(headset->poll()));
        if (!headset->wantsFrames()) continue;
        tests::valueOf(headset->waitFrame());
        ASSERT_TRUE(tests::succeeded(headset->begin()));
        ASSERT_TRUE(tests::succeeded(headset->end({})));
    }
}

} // namespace
} // namespace shoal::xr
