// Tests of devices that come and go beside the mouse.
#include "input/hands/HandSourceSelector.h"
#include "input/hands/HandFilter.h"
#include "input/hands/HandRig.h"
#include "tests/TestRig.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace shoal::hands {
namespace {

using tests::rig;

constexpr float kStep_s = 1.0f / 120;

HandPose handAt(float x) { return rig().pose(Side::Right, {}, {{x, 0, -0.5f}, {1, 0, 0, 0}}); }

Clock::time_point clockAt(int64_t time_us) { return Clock::time_point(std::chrono::microseconds(time_us)); }

HandFrame frameAt(int64_t time_us, float x, int64_t identity = 1) {
    HandFrame frame;
    frame.time_us = time_us;
    frame.seenAt = clockAt(time_us);
    frame.hands[1] = handAt(x);
    frame.identity[1] = identity;
    return frame;
}

float xOf(const HandPose& hand) { return hand.joints[1].position.x; }

// A device, a mouse whose hands are at x = -0.3, and a display of 60 frames a second.
struct Game {
    HandStream stream;
    DeviceHands device{DeviceTime::Live};
    HandSourceSelector choice;
    std::array<HandPose, 2> hands;
    int64_t time_us = 0;

    void frame(std::optional<float> x) {
        time_us += 16667;
        if (x) stream.push(frameAt(time_us, *x));
        device.advance(stream, 1.0 / 60, clockAt(time_us));
        for (const float ago_s : {kStep_s, 0.0f}) {
            hands = {handAt(-0.4f), handAt(-0.3f)};
            choice.tick(device, hands, ago_s, kStep_s);
        }
    }
};

TEST(HandSourceSelector, TheMousePassesUntouchedUntilADeviceSeesAHand) {
    Game game;
    for (int i = 0; i < 100; ++i) {
        game.frame(std::nullopt);
        EXPECT_EQ(xOf(game.hands[1]), xOf(handAt(-0.3f)));
        EXPECT_TRUE(game.hands[0].tracked && game.hands[0].solid);
    }
}

TEST(HandSourceSelector, AHandSeenTakesOverByGlidingAndTheMouseComesBackWhenItIsGone) {
    Game game;
    for (int i = 0; i < 10; ++i) game.frame(std::nullopt);
    game.frame(0.3f);
    EXPECT_FALSE(game.hands[1].solid);
    EXPECT_LT(xOf(game.hands[1]), -0.2f) << "it glides from the mouse's place";
    for (int i = 0; i < 60; ++i) game.frame(0.3f);
    EXPECT_TRUE(game.choice.fromDevice());
    EXPECT_NEAR(xOf(game.hands[1]), 0.3f, 1e-5f);
    EXPECT_TRUE(game.hands[1].solid);
    EXPECT_FALSE(game.hands[0].tracked) << "the device sees no left hand, and the mouse is not mixed in";

    int framesWithoutHands = 0;
    float lost_s = 0;
    while (game.choice.fromDevice()) {
        game.frame(std::nullopt);
        lost_s += 1.0f / 60;
        framesWithoutHands += !game.hands[1].tracked;
        ASSERT_LT(lost_s, 3);
        if (lost_s < kHandLost_s - 0.02f) {
            EXPECT_TRUE(game.hands[1].tracked) << lost_s;
        }
    }
    EXPECT_NEAR(lost_s, tuning::kMouseReturns_s, 2.0f / 60);
    EXPECT_GT(framesWithoutHands, 0);
    for (int i = 0; i < 60; ++i) game.frame(std::nullopt);
    EXPECT_NEAR(xOf(game.hands[1]), -0.3f, 1e-5f);
    EXPECT_TRUE(game.hands[1].solid && game.hands[0].solid);
}

TEST(HandSourceSelector, MotionIsSpreadEvenlyOverTheTicksOfAFrame) {
    Game game;
    for (int i = 0; i < 60; ++i) game.frame(0.0f);
    // 0.6 m/s; after some frames each tick moves the same way, but for the slowing down that is assumed.
    std::vector<float> xs;
    float x = 0;
    for (int i = 0; i < 60; ++i) {
        game.time_us += 16667;
        game.stream.push(frameAt(game.time_us, x += 0.01f));
        game.device.advance(game.stream, 1.0 / 60, clockAt(game.time_us));
        for (const float ago_s : {kStep_s, 0.0f}) {
            game.choice.tick(game.device, game.hands, ago_s, kStep_s);
            xs.push_back(xOf(game.hands[1]));
        }
    }
    for (size_t i = 60; i + 1 < xs.size(); ++i) EXPECT_NEAR(xs[i + 1] - xs[i], 0.005f, 2e-4f) << i;
}

TEST(DeviceHands, TimeStampsMakeTheGameEqualHoweverFramesArrive) {
    const auto story = [](int burst) {
        HandStream stream;
        DeviceHands device(DeviceTime::Stamps);
        std::vector<float> xs;
        int pushed = 0;
        for (int tick = 0; tick < 60; ++tick) {
            // Frames come in bursts, but never later than needed.
            while (pushed < 100 && pushed * 9000 <= (tick + 1) * 16667 + burst * 9000) {
                stream.push(frameAt(5'000'000 + pushed * 9000, 0.001f * static_cast<float>(pushed)));
                if (++pushed == 100) stream.close(); // nothing more is waited for
            }
            device.advance(stream, 1.0 / 60, {});
            xs.push_back(xOf(device.hand(1).pose()));
        }
        return xs;
    };
    EXPECT_EQ(story(1), story(40));
}

TEST(DeviceHands, AClockThatStartsAnewStartsNow) {
    HandStream stream;
    DeviceHands device(DeviceTime::Stamps);
    for (int i = 0; i < 10; ++i) stream.push(frameAt(9'000'000'000 + i * 10000, 0.1f, 1));
    for (int i = 0; i < 10; ++i) stream.push(frameAt(i * 10000, 0.2f, 2)); // the service was started anew
    stream.close();                                                        // so that nothing is waited for
    for (int i = 0; i < 9; ++i) device.advance(stream, 0.01, {});
    EXPECT_NEAR(xOf(device.hand(1).pose()), 0.1f, 1e-4f);
    for (int i = 0; i < 11; ++i) device.advance(stream, 0.01, {});
    EXPECT_NEAR(xOf(device.hand(1).pose()), 0.2f, 1e-4f);
    EXPECT_EQ(device.hand(1).stretch(), 2);
}

TEST(HandStream, WhenFullTheOldestGoes) {
    HandStream stream(3);
    for (int i = 0; i < 5; ++i) stream.push(frameAt(i, 0));
    HandFrame frame;
    ASSERT_TRUE(stream.take(frame));
    EXPECT_EQ(frame.time_us, 2);
}

} // namespace
} // namespace shoal::hands
