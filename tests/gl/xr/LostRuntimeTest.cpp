// The headset is unplugged, or the runtime stops or crashes, in the middle of a dive. The dive pauses, is
// shown in the window, and all of it is in its recording.
#include "game/app/Application.h"
#include "tests/gl/xr/WindowEvents.h"
#include "tests/gl/xr/XrProgram.h"

#include <GLFW/glfw3.h>

#include <atomic>
#include <future>

namespace shoal::app {
namespace {

class LostRuntime : public XrProgram {
  protected:
    void loseIt(const std::function<void(FakeRuntime&)>& how, const std::string& about) {
        fake.period_s = 1.0 / 30;
        fake.onWait = [how](FakeRuntime& f) {
            if (f.framesWaited == 30) how(f);
        };
        // A person before the window closes it after a look.
        fake.onGone = [](FakeRuntime&) { glfwSetWindowShouldClose(glfwGetCurrentContext(), GLFW_TRUE); };
        PlayOptions o = options();
        o.record = folder_ / "a.replay";
        testing::internal::CaptureStderr();
        log::setUp(false);
        {
            Application application(o);
            ASSERT_TRUE(tests::succeeded(application.open()));
            EXPECT_TRUE(tests::succeeded(application.run(true)));
            EXPECT_EQ(application.screens().top(), Screen::Paused);
            const MenuPage& page = application.screens().menu().page();
            EXPECT_NE(page.error.find(about), std::string::npos) << page.error;
            EXPECT_NE(std::ranges::find(page.items, "Headset", &MenuItem::label), page.items.end())
                << "to go on in it when it is back";
            EXPECT_TRUE(application.hasPicture());
        }
        const std::string said = testing::internal::GetCapturedStderr();
        EXPECT_NE(said.find(about), std::string::npos) << said;
        const auto recording = tests::valueOf(tests::readRecorded(o.record));
        EXPECT_GE(recording.ticks(), 29u * 120 / 30);
        expectReplays(recording);
    }
};
TEST_F(LostRuntime, AHeadsetPulledOut) {
    loseIt([](FakeRuntime& f) { f.say(XR_SESSION_STATE_LOSS_PENDING); }, "headset was lost");
}
TEST_F(LostRuntime, ARuntimeThatGoes) {
    loseIt([](FakeRuntime& f) { f.sayInstanceLoss(); }, "going away");
}
TEST_F(LostRuntime, ARuntimeThatHasCrashed) {
    loseIt([](FakeRuntime& f) { f.failing["xrEndFrame"] = XR_ERROR_INSTANCE_LOST; },
           "xrEndFrame says XR_ERROR_INSTANCE_LOST");
}
TEST_F(LostRuntime, ARuntimeThatCrashesWhileItsPictureIsDrawn) {
    loseIt([](FakeRuntime& f) { f.failing["xrReleaseSwapchainImage"] = XR_ERROR_INSTANCE_LOST; },
           "xrReleaseSwapchainImage says XR_ERROR_INSTANCE_LOST");
}

// The program looks for the runtime while the window goes on. The dive then continues where it was.
TEST_F(LostRuntime, ComesBackAndTheDiveGoesOnInIt) {
    std::promise<void> windowGoesOn;
    std::atomic<int> gone = 0, polls = 0, asked = 0;
    fake.onWait = [](FakeRuntime& f) {
        if (f.framesWaited != 90) return;
        f.present = false;
        f.say(XR_SESSION_STATE_LOSS_PENDING);
    };
    fake.onCreate = [&](FakeRuntime&) { // a runtime that is slow to say that it has none
        if (gone != 1) return;
        ++asked;
        EXPECT_EQ(windowGoesOn.get_future().wait_for(std::chrono::minutes(10)), std::future_status::ready);
    };
    fake.onGone = [&](FakeRuntime& f) {
        if (++gone == 2) f.present = true; // plugged in again
        if (gone != 1) return;
        test::onEachPoll([&] {
            if (asked == 1 && ++polls == 5) windowGoesOn.set_value();
            return polls < 5;
        });
    };
    PlayOptions o = options();
    o.record = folder_ / "a.replay";
    const Outcome outcome = run(o, 200);
    EXPECT_EQ(outcome.status, 0) << outcome.said;
    EXPECT_EQ(std::count(outcome.said.begin(), outcome.said.end(), '\n'), 1) << outcome.said; // of the loss
    EXPECT_EQ(gone, 4); // lost, asked in vain, asked with success, played to the end
    const auto recording = tests::valueOf(tests::readRecorded(o.record));
    const std::vector<int> lengths = pauses(recording);
    ASSERT_EQ(lengths.size(), 4u); // until it is worn, play, lost, play
    EXPECT_NEAR(lengths[0] + lengths[1], 90 * 4 / 3, 4);
    // 110 frames, of which some pass until it is focused and for 0.3 s steady.
    EXPECT_NEAR(lengths[3], (110 - 30) * 4 / 3, 8);
    expectReplays(recording);
}
TEST_F(LostRuntime, APlayerWithTheMouseIsLeftAlone) {
    int polls = 0;
    fake.onWait = [](FakeRuntime& f) {
        if (f.framesWaited == 90) f.say(XR_SESSION_STATE_LOSS_PENDING);
    };
    fake.onGone = [&](FakeRuntime&) {
        test::onEachPoll([&] {
            if (++polls == 5) test::strikeKey("Escape"); // leaves the pause menu
            if (polls == 30) glfwSetWindowShouldClose(glfwGetCurrentContext(), GLFW_TRUE);
            return polls < 30;
        });
    };
    PlayOptions o = options();
    o.record = folder_ / "a.replay";
    const Outcome outcome = run(o);
    EXPECT_EQ(outcome.status, 0) << outcome.said;
    EXPECT_EQ(polls, 30);
    const auto recording = tests::valueOf(tests::readRecorded(o.record));
    const std::vector<int> lengths = pauses(recording);
    ASSERT_EQ(lengths.size(), 4u); // until it is worn, play, lost, play
    EXPECT_GE(lengths[3], 1);      // how many ticks the window's last 25 frames take depends on the machine
    // The mouse has one hand, which the headset did not show.
    const game::TickInput last = inputAt(recording, recording.ticks() - 1);
    EXPECT_TRUE(last.hands[0].tracked || last.hands[1].tracked);
    expectReplays(recording);
}
TEST_F(XrProgram, AScriptEndsWithASentenceWhereTheHeadsetIsPulledOut) {
    fake.onWait = [](FakeRuntime& f) {
        if (f.framesWaited == 60) f.say(XR_SESSION_STATE_LOSS_PENDING);
    };
    PlayOptions o = options();
    o.hands.source = firstCatch_;
    expectOneMessage(run(o), "headset was lost");
}

} // namespace
} // namespace shoal::app
