// Tests the dynamic quality control on a simulated machine, whose frame time is the sum of a fixed part, a
// part for each pixel and a part for the light.
#include "game/views/DynamicQuality.h"

#include <gtest/gtest.h>

#include <vector>

namespace shoal::app {
namespace {

constexpr double kBudget_ms = 1000.0 / 60;

struct Machine {
    double fixed_ms = 2, pixels_ms = 6, light_ms = 1;
    double frame_ms(const Quality& q) const {
        return fixed_ms + pixels_ms * static_cast<double>(q.scale * q.scale) + light_ms / q.lightEvery;
    }
};

struct Ride {
    Quality end;
    int changes = 0, ups = 0;
    double last_ms = 0;
    float largestStep = 0; // largest change of the scale between two frames
};

Ride ride(DynamicQuality& dynamicQuality, const Machine& machine, int frames) {
    Ride result;
    Quality before = dynamicQuality.quality();
    for (int i = 0; i < frames; ++i) {
        result.last_ms = machine.frame_ms(dynamicQuality.quality());
        dynamicQuality.frame(result.last_ms);
        const Quality now = dynamicQuality.quality();
        const bool changed = now.scale != before.scale || now.lightEvery != before.lightEvery;
        result.changes += changed;
        result.ups += now.scale > before.scale || now.lightEvery < before.lightEvery;
        result.largestStep = std::max(result.largestStep, std::abs(now.scale - before.scale));
        before = now;
    }
    result.end = before;
    return result;
}

TEST(DynamicQuality, LeavesAFastMachineAlone) {
    DynamicQuality dynamicQuality(kBudget_ms);
    const Ride result = ride(dynamicQuality, {}, 6000);
    EXPECT_EQ(result.changes, 0);
    EXPECT_EQ(result.end.scale, 1.0f);
    EXPECT_EQ(result.end.lightEvery, 1);
}

// Frames take 1.5 times the budget: pixels must become fewer within two seconds, and then stay steady.
TEST(DynamicQuality, DrawsFewerPixelsUntilFramesFit) {
    DynamicQuality dynamicQuality(kBudget_ms);
    const Machine slow{4, 20, 1};
    ride(dynamicQuality, slow, 120);
    const Ride settled = ride(dynamicQuality, slow, 3600);
    EXPECT_LT(settled.last_ms, kBudget_ms);
    EXPECT_GT(settled.end.scale, 0.6f); // not lower than needed: 0.72 would just fit
    EXPECT_EQ(settled.end.lightEvery, 1);
    EXPECT_LE(settled.changes, 6);
}

TEST(DynamicQuality, StepsAreSmallWhereTheLoadIs) {
    DynamicQuality dynamicQuality(kBudget_ms);
    EXPECT_LT(ride(dynamicQuality, {4, 13, 1}, 600).largestStep, 0.065f);
}

// Half of the width is not enough: then the light is made less often, too, down to the limits of both.
TEST(DynamicQuality, ThenMakesLightLessOften) {
    DynamicQuality some(kBudget_ms), most(kBudget_ms);
    const Ride result = ride(some, {12, 12, 4}, 1200), end = ride(most, {500, 500, 50}, 3000);
    EXPECT_NEAR(result.end.scale, 0.506f, 0.01f);
    EXPECT_GT(result.end.lightEvery, 1);
    EXPECT_LT(result.last_ms, kBudget_ms);
    EXPECT_GE(end.end.scale, DynamicQuality::kMinScale);
    EXPECT_EQ(end.end.lightEvery, DynamicQuality::kMaxLightEvery);
}

// An artificial load comes and goes: full quality must be back 40 s after its end.
TEST(DynamicQuality, TakesItBackWhenTheLoadIsGone) {
    DynamicQuality dynamicQuality(kBudget_ms);
    ride(dynamicQuality, {}, 600);
    const Ride loaded = ride(dynamicQuality, {4, 30, 1}, 1200);
    EXPECT_LT(loaded.end.scale, 0.7f);
    const Ride after = ride(dynamicQuality, {}, 60 * 40);
    EXPECT_EQ(after.end.scale, 1.0f);
    EXPECT_EQ(after.end.lightEvery, 1);
}

// The load lies between two steps: the control tries the upper one ever less often, at last every 15 s.
TEST(DynamicQuality, DoesNotSwingAtTheEdge) {
    for (double pixels_ms = 10; pixels_ms < 30; pixels_ms += 0.37) {
        DynamicQuality dynamicQuality(kBudget_ms);
        ride(dynamicQuality, {3, pixels_ms, 1}, 3600);
        EXPECT_LE(ride(dynamicQuality, {3, pixels_ms, 1}, 3600).changes, 8) << pixels_ms;
    }
}

TEST(DynamicQuality, OneSlowFrameChangesNothing) {
    DynamicQuality dynamicQuality(kBudget_ms);
    for (int i = 0; i < 600; ++i) {
        dynamicQuality.frame(i % 100 == 50 ? 60 : 8);
        EXPECT_EQ(dynamicQuality.quality().scale, 1.0f);
    }
}

} // namespace
} // namespace shoal::app
