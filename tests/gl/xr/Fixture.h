// The fake runtime behind the real loader, on a display without a screen.
#pragma once

#include "tests/gl/xr/VirtualDisplay.h"
#include "tests/gl/xr/runtime/FakeRuntime.h"

#include <gtest/gtest.h>

namespace shoal::test {

class WithFakeRuntime : public testing::Test {
  protected:
    FakeRuntime& fake = shoalFakeRuntime();
    std::optional<VirtualDisplay> display_;

    void SetUp() override {
        fake = FakeRuntime();
        setenv("XR_RUNTIME_JSON", FAKE_RUNTIME_JSON, 1);
        display_ = VirtualDisplay::open();
        if (!display_) GTEST_SKIP() << "needs Xvfb";
    }
    // All that was made is gone, and nothing was called that must not be.
    void TearDown() override {
        EXPECT_EQ(fake.complaints, std::vector<std::string>());
        EXPECT_EQ(fake.instances, 0);
        EXPECT_EQ(fake.sessions, 0);
        EXPECT_EQ(fake.swapchains, 0);
        EXPECT_EQ(fake.spaces, 0);
        EXPECT_EQ(fake.handTrackers, 0);
    }
};

} // namespace shoal::test
