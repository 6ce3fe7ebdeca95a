// Measures the prediction of hands: how late they are, how far beyond a stop they go, how they tremble.
#include "input/hands/HandFilter.h"
#include "tests/Test.h"
#include "tests/TestRig.h"
#include "tests/unit/hands/SimulatedTracker.h"

namespace shoal::hands {
namespace {

using test::Moment;
using test::Motion;
using test::TrackerModel;
using tests::rig;

HandPose handAt(float x) { return rig().pose(Side::Right, {}, {{x, 0, -0.5f}, {1, 0, 0, 0}}); }

std::vector<Moment> played(const Motion& motion, double length_s, const TrackerModel& tracker) {
    return test::played(motion, length_s, handAt(0), tracker);
}

// Moves along x from 1 s on with the least jerk (Flash & Hogan 1985), as people reach.
Motion reach(double way_m, double length_s) {
    return [=](double t_s) {
        const double s = std::clamp((t_s - 1) / length_s, 0.0, 1.0);
        return glm::dvec3(way_m * s * s * s * (10 + s * (6 * s - 15)), 0, -0.5);
    };
}

// Moves evenly from 1 s to 1.5 s, and stops at once.
Motion dash(double speed_mps) {
    return [=](double t_s) { return glm::dvec3(speed_mps * std::clamp(t_s - 1, 0.0, 0.5), 0, -0.5); };
}

struct Delay {
    double mean_ms = 0, most_ms = 0;
};

// Returns the delay of a hand that moves steadily, over every phase between pictures and display.
Delay delayAt(double speed_mps, double rate_Hz) {
    Delay delay;
    int count = 0;
    for (int phase = 0; phase < 8; ++phase)
        for (const Moment& m : played([&](double t_s) { return glm::dvec3(speed_mps * t_s, 0, -0.5); }, 2,
                                      {.rate_Hz = rate_Hz, .phase = phase})) {
            if (m.t_s < 1) continue;
            const double ago_ms = 1e3 * (m.t_s - m.palm.x / speed_mps);
            delay.mean_ms += ago_ms;
            delay.most_ms = std::max(delay.most_ms, ago_ms);
            ++count;
        }
    delay.mean_ms /= count;
    return delay;
}

// Delays after the simulation are not counted: 8 ms of game::interpolate, then 17 ms of drawing and of the
// display's refresh. The sum is below 40 ms.
TEST(HandDelay, IsMadeGoodForAWebcamExceptWhereItSlowsDown) {
    for (const double speed_mps : {0.1, 0.3, 1.0}) {
        const Delay delay = delayAt(speed_mps, 30);
        EXPECT_LT(delay.mean_ms, 15);
        EXPECT_LT(delay.most_ms, 22);
        EXPECT_GT(delay.mean_ms, 0) << "a hand is not drawn ahead of itself";
    }
}

struct Beyond {
    double most_mm = 0, later_mm = 0; // later: a fifth of a second after the stop
};

Beyond beyond(const Motion& motion, double stop_s, TrackerModel tracker) {
    Beyond out;
    for (tracker.phase = 0; tracker.phase < 8; ++tracker.phase) {
        const auto moments = played(motion, stop_s + 0.7, tracker);
        const double end = motion(stop_s).x;
        double most = 0;
        for (const Moment& m : moments) {
            most = std::max(most, 1e3 * (m.palm.x - end));
            if (m.t_s > stop_s + 0.2) out.later_mm = std::max(out.later_mm, 1e3 * std::abs(m.palm.x - end));
        }
        out.most_mm += most / 8;
    }
    return out;
}

// Root mean squares at rest, mm.
struct Trembling {
    double shown_mm = 0, filtered_mm = 0;
};

Trembling trembling(const TrackerModel& tracker) {
    const glm::dvec3 at(0, 0, -0.5);
    Trembling sum;
    int count = 0;
    for (const Moment& m : played([&](double) { return at; }, 20, tracker)) {
        if (m.t_s < 1) continue;
        sum.shown_mm += glm::dot(m.palm - at, m.palm - at);
        sum.filtered_mm += glm::dot(m.filtered - at, m.filtered - at);
        ++count;
    }
    return {1e3 * std::sqrt(sum.shown_mm / count), 1e3 * std::sqrt(sum.filtered_mm / count)};
}

TEST(Prediction, AHandThatStopsIsNotSeenFarBeyondAndAStillOneHardlyTremblesMore) {
    for (const double rate_Hz : {30.0, 60.0, 120.0})
        for (const double noise_m : {0.0, 0.003}) {
            const TrackerModel tracker{.rate_Hz = rate_Hz, .noise_m = noise_m};
            const Beyond slow = beyond(reach(0.4, 0.5), 1.5, tracker),
                         fast = beyond(reach(0.3, 0.3), 1.3, tracker), sudden = beyond(dash(1), 1.5, tracker);
            const Trembling rest = trembling(tracker);
            EXPECT_LT(rest.shown_mm, 1.2 * rest.filtered_mm + 1e-3);
            if (noise_m > 0) continue;
            EXPECT_LT(slow.most_mm, 3);
            EXPECT_LT(fast.most_mm, 4);
            // No prediction knows that a hand will stop at once: what it has gone since the picture.
            EXPECT_LT(sudden.most_mm, rate_Hz < 60 ? 25 : 16);
            EXPECT_LT(std::max({slow.later_mm, fast.later_mm, sudden.later_mm}), 1);
        }
}

// A lost hand goes half as far as its velocity would take it in kStops_s, however long it is awaited.
TEST(Prediction, AHandNotSeenAnyMoreGoesOnAndStops) {
    HandFilter filter;
    HandPose hand = handAt(0);
    for (int i = 0; i < 60; ++i) {
        filter.step(hand, 1, i * 10'000);
        for (Joint& joint : hand.joints) joint.position.x += 0.005f; // 0.5 m/s
    }
    const float last = filter.palm(0).position.x;
    const float far = filter.palm(tuning::kStops_s).position.x;
    EXPECT_NEAR(far - last, 0.5f * tuning::kStops_s / 2, 0.005f);
    EXPECT_EQ(filter.palm(1e6f).position.x, far);
}

TEST(Prediction, NothingIsThrownFartherThanFarthest) {
    HandFilter filter;
    HandPose hand = handAt(-2);
    for (int i = 0; i < 20; ++i) {
        filter.step(hand, 1, i * 10'000);
        for (Joint& joint : hand.joints) joint.position.x += 0.2f; // 20 m/s
    }
    const glm::vec3 seen = filter.pose().joints[kPalmJoint].position;
    EXPECT_NEAR(glm::distance(filter.palm(1).position, seen), tuning::kPalmVelocity.farthest, 1e-4f);
}

// Turned as fast as a wrist turns, the hand is drawn turned on, about its palm, and keeps its bones.
TEST(Prediction, AHandThatTurnsIsTurnedOn) {
    constexpr float kSpin_radps = 3, kInterval_s = 0.01f;
    HandFilter filter;
    float angle = 0;
    const auto at = [](float radians) {
        return rig().pose(Side::Right, {}, {{0, 0, -0.5f}, glm::angleAxis(radians, glm::vec3(0, 0, 1))});
    };
    for (int i = 0; i < 60; ++i) filter.step(at(angle += kSpin_radps * kInterval_s), 1, i * 10'000);
    const JointPose now = filter.palm(0), ahead = filter.palm(0.03f);
    const auto between = [](const glm::quat& a, const glm::quat& b) {
        return glm::angle(glm::conjugate(a) * b);
    };
    EXPECT_NEAR(between(at(angle).joints[kPalmJoint].orientation, now.orientation), 0, 0.015f);
    EXPECT_NEAR(between(now.orientation, ahead.orientation), kSpin_radps * 0.03f, 0.02f);
    const Joint& seen = filter.pose().joints[kPalmJoint];
    const HandPose turned = carried(filter.pose(), {seen.position, seen.orientation}, ahead);
    for (int i = 2; i < kJointCount; ++i)
        EXPECT_NEAR(
            glm::distance(turned.joints[i].position, turned.joints[kJointParent[i]].position),
            glm::distance(filter.pose().joints[i].position, filter.pose().joints[kJointParent[i]].position),
            1e-5f);
}

constexpr float kStep_s = 1.0f / 120;

Clock::time_point clockAt(int64_t time_us) { return Clock::time_point(std::chrono::microseconds(time_us)); }

HandFrame frameAt(int64_t time_us, float x, int64_t identity = 1) {
    return {.time_us = time_us,
            .seenAt = clockAt(time_us),
            .hands = {HandPose{}, handAt(x)},
            .identity = {0, identity}};
}

float xOf(const HandPose& hand) { return hand.joints[1].position.x; }

// A device, a mouse whose hands are at x = -0.3, and a display of 60 frames a second.
struct Game {
    HandStream stream;
    DeviceHands device{DeviceTime::Live};
    HandSourceSelector choice;
    std::array<HandPose, 2> hands;
    std::vector<float> xs; // of the right hand, at each tick
    int64_t time_us = 0;

    void frame(std::optional<float> x) {
        time_us += 16667;
        if (x) stream.push(frameAt(time_us, *x));
        device.advance(stream, 1.0 / 60, clockAt(time_us));
        for (const float ago_s : {kStep_s, 0.0f}) {
            hands = {handAt(-0.4f), handAt(-0.3f)};
            choice.tick(device, hands, ago_s, kStep_s);
            xs.push_back(xOf(hands[1]));
        }
    }
};

TEST(HandSourceSelector, AHandSeenTakesOverByGlidingAndTheMouseComesBackWhenItIsGone) {
    Game game;
    for (int i = 0; i < 100; ++i) {
        game.frame(std::nullopt);
        EXPECT_EQ(xOf(game.hands[1]), xOf(handAt(-0.3f)));
        EXPECT_TRUE(game.hands[0].tracked && game.hands[0].solid);
    }
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
    float x = 0;
    for (int i = 0; i < 60; ++i) game.frame(x += 0.01f);
    for (size_t i = 180; i + 1 < game.xs.size(); ++i)
        EXPECT_NEAR(game.xs[i + 1] - game.xs[i], 0.005f, 2e-4f) << i;
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
