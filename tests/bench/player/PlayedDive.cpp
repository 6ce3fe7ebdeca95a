#include "tests/bench/player/PlayedDive.h"

#include "game/rules/Intent.h"
#include "input/hands/HandSourceSelector.h"
#include "input/hands/MouseHands.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace shoal::player {

namespace {

constexpr int kFrameRate_Hz = 60, kTicksPerFrame = 2;
constexpr float kFrame_s = 1.0f / kFrameRate_Hz;

// Hand of the mouse, driven as by game/session/HandSource.cpp.
class AtTheMouse {
  public:
    AtTheMouse(const hands::HandRig& rig, const game::SpeciesTable& species, float reachHelp)
        : hands_(rig), species_(species), reachHelp_(reachHelp) {}

    void frame(const Action& action, const game::Snapshot& shown) {
        hands::MouseInput mouse;
        mouse.aspect = kHalfScreen_px.x / kHalfScreen_px.y;
        mouse.fovY = 2 * std::atan(kTanHalfFov);
        mouse.cursor = action.cursor_px / kHalfScreen_px;
        mouse.close = action.close;
        const glm::vec3 ray = glm::normalize(glm::vec3(action.cursor_px / kFocal_px, -1));
        mouse.reach_m = game::reachHelp(shown, species_, ray, hands_.distance_m(), target_);
        mouse.reachHelp = reachHelp_;
        poses_ = hands_.update(mouse, kFrame_s);
    }
    void tick(game::TickInput& input, int) { input.hands = poses_; }

  private:
    hands::MouseHands hands_;
    const game::SpeciesTable& species_;
    float reachHelp_;
    int target_ = -1; // of the help with depth
    std::array<hands::HandPose, 2> poses_{};
};

// A right hand under a tracker that sees it late and with noise.
class UnderATracker {
  public:
    UnderATracker(const hands::HandRig& rig, uint64_t seed) : rig_(rig), random_(seed, 78) {}

    void frame(const Action& action, const game::Snapshot&) {
        constexpr float kClose_s = 0.2f, kNoise_m = 0.003f;
        constexpr int kDelay_frames = 2; // 33 ms
        now_ += std::chrono::microseconds(1'000'000 / kFrameRate_Hz);
        const float step = kFrame_s / kClose_s;
        closed_ += std::clamp((action.close ? 1.0f : 0.0f) - closed_, -step, step);
        hands::HandFrame seen;
        seen.hands[1] = hands::reachingHand(rig_, hands::Side::Right, action.grasp, closed_);
        const float grip = seen.hands[1].grip;
        for (hands::Joint& joint : seen.hands[1].joints)
            joint.position += kNoise_m * glm::vec3(gauss(random_), gauss(random_), gauss(random_));
        seen.hands[1].grip = std::clamp(grip + 0.02f * gauss(random_), 0.0f, 1.0f);
        late_.push_back(seen);
        if (static_cast<int>(late_.size()) > kDelay_frames) {
            time_us_ += static_cast<int64_t>(1e6f * kFrame_s);
            late_.front().time_us = time_us_;
            late_.front().seenAt = now_; // the tracker does not report its delay
            stream_.push(late_.front());
            late_.pop_front();
        }
        hands_.advance(stream_, kFrame_s, now_);
    }
    void tick(game::TickInput& input, int ticksLeft) {
        choice_.tick(hands_, input.hands, static_cast<float>(ticksLeft - 1) * sim::kTick_s, sim::kTick_s);
    }

  private:
    const hands::HandRig& rig_;
    Random random_;
    float closed_ = 0;
    std::deque<hands::HandFrame> late_;
    int64_t time_us_ = 0;
    hands::Clock::time_point now_{};
    hands::HandStream stream_;
    hands::DeviceHands hands_{hands::DeviceTime::Live};
    hands::HandSourceSelector choice_;
};

void count(const game::Events& events, const game::Snapshot& now, PlayedDive& played) {
    using game::EventKind;
    for (const game::Event& event : events) {
        if (event.kind == EventKind::Catch)
            played.firstCatch_s = std::min(played.firstCatch_s, static_cast<float>(now.time_s));
        played.escapes += event.kind == EventKind::Escape;
        played.startles += event.kind == EventKind::Startle;
        const bool missed = event.kind >= EventKind::Miss && event.kind <= EventKind::MissBehind;
        if (missed)
            ++played.misses[static_cast<size_t>(event.kind) - static_cast<size_t>(EventKind::Miss) + 1];
    }
}

template <class Source>
PlayedDive playWith(Source source, const game::DiveFiles& files, const PlayerSetup& setup,
                    const Watch& watch) {
    game::Dive dive(files.species, files.dive, setup.seed, setup.rules);
    Player player(setup.skill, setup.device, setup.arm_m, setup.seed + 1000, files.species,
                  setup.cracksMussels);
    PlayedDive played;
    game::Snapshot now;
    game::Events events;
    dive.snapshot(now);
    float yaw = 0;
    bool closed = false;
    double warned_s = 0;
    bool heeds = false;
    Random heed(setup.seed, 79);
    const int frames = static_cast<int>(files.dive.duration_s * kFrameRate_Hz);
    for (int frame = 0; frame < frames; ++frame) {
        Action action = player.frame(now, static_cast<double>(frame) / kFrameRate_Hz);
        if (heeds && dive.state().shark.aims() && now.time_s - warned_s > kHeeds_s) action.close = false;
        played.closings += action.close && !closed;
        played.spent_s[static_cast<size_t>(player.doing())] += kFrame_s;
        closed = action.close;
        yaw += action.turn_radps * kFrame_s;
        source.frame(action, now);
        for (int tick = 0; tick < kTicksPerFrame; ++tick) {
            game::TickInput input;
            source.tick(input, kTicksPerFrame - tick);
            input.worldFromView = glm::angleAxis(-yaw, glm::vec3(0, 1, 0));
            events.clear();
            dive.step(input, events);
            dive.snapshot(now);
            count(events, now, played);
            for (const game::Event& event : events)
                if (event.kind == game::EventKind::SharkAims) {
                    warned_s = now.time_s;
                    heeds = heed.unit() < setup.heedsShark;
                }
            if (watch) watch(dive.state(), events);
        }
    }
    played.caught = now.caught;
    played.lost = now.lost;
    played.points = now.score;
    return played;
}

} // namespace

PlayedDive play(const game::DiveFiles& files, const hands::HandRig& rig, const PlayerSetup& setup,
                const Watch& watch) {
    if (setup.device == Device::Mouse)
        return playWith(AtTheMouse(rig, files.species, setup.reachHelp), files, setup, watch);
    return playWith(UnderATracker(rig, setup.seed), files, setup, watch);
}

} // namespace shoal::player
