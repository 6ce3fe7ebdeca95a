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
        const Status polled = headset->poll();
        ASSERT_TRUE(polled) << polled.error().message();
        if (!headset->wantsFrames()) continue;
        tests::valueOf(headset->waitFrame());
        const Status begun = headset->begin();
        ASSERT_TRUE(begun) << begun.error().message();
        const Status ended = headset->end({});
        ASSERT_TRUE(ended) << ended.error().message();
    }
}

} // namespace
} // namespace shoal::xr
