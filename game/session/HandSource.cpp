#include "game/session/HandSource.h"

#include "engine/core/Log.h"
#include "engine/core/Number.h"
#include "engine/math/Trigonometry.h"
#include "game/rules/Intent.h"

#include <cmath>
#include <filesystem>

namespace shoal::app {

constexpr float kKeyTurn_radps = 1.6f;
constexpr float kSnapTurn_rad = 0.5236f;  // 30 degrees
constexpr float kStickReach_ps = 1.1f;    // speed of the pointer at full stick, half pictures a second
constexpr float kKeyNotches_ps = 12;      // speed while a key is down, wheel notches a second
constexpr float kTriggerDeadZone = 0.06f; // a trigger at rest may report more than 0
constexpr float kSinkDepth_m = 0.3f, kSink_s = 0.15f; // an idle hand's way out of view; its time constant
constexpr double kDeviceSearch_s = 1; // time to find a device before the mouse is announced as the source

// Returns the options for a camera's number, a clip's file or, without text, the first camera.
static hands::WebcamOptions webcamFrom(const std::string& which, bool live, float handSize) {
    const auto index = which.empty() ? std::optional(0) : parseNumber(which, 0, 99);
    return {.file = index ? "" : which, .index = index.value_or(0), .live = live, .handSize = handSize};
}

// Parses "KIND" or "KIND:ARGUMENT".
static Result<HandSourceChoice> parseHandSource(const std::string& text) {
    const size_t colon = text.find(':');
    const bool hasArgument = colon != std::string::npos;
    if (const auto kind = enumNamed<HandSourceKind>(text.substr(0, colon))) {
        const bool needsArgument = *kind == HandSourceKind::Script || *kind == HandSourceKind::Replay;
        if (hasArgument == needsArgument || *kind == HandSourceKind::Webcam)
            return HandSourceChoice{*kind, hasArgument ? text.substr(colon + 1) : ""};
    }
    return Error{"--hands " + text,
                 "is not auto, mouse, leap, webcam[:FILE or number], openxr, script:FILE or replay:FILE"};
}

// Returns the turn of the view in this frame: +x right, +y up, radians. snapped: MouseSource::snapped_.
static glm::vec2 turnBy(const Controls& c, const ControlOptions& options, float dt_s, bool& snapped) {
    const glm::vec2 keys(c.axis(Action::LookRight, Action::LookLeft),
                         c.axis(Action::LookUp, Action::LookDown));
    const float up = options.invertLook ? -1.0f : 1.0f;
    glm::vec2 turn = (keys + c.input.gamepad.leftStick * glm::vec2(1, up)) * (kKeyTurn_radps * dt_s);
    if (options.turning == Turning::Snap) {
        constexpr float kOn = 0.6f, kOff = 0.3f; // hysteresis of a snap turn; 1: full stick
        const float step = static_cast<float>(c.wasPressed(Action::LookRight)) -
                           static_cast<float>(c.wasPressed(Action::LookLeft));
        const float stick = c.input.gamepad.leftStick.x;
        const bool pushed = std::abs(stick) > kOn && !snapped;
        if (pushed) snapped = true;
        if (std::abs(stick) < kOff) snapped = false;
        turn.x = kSnapTurn_rad * (step + (pushed ? std::copysign(1.0f, stick) : 0.0f));
    }
    const glm::dvec2 dragged = c.dragged();
    turn += glm::vec2(dragged.x, -up * static_cast<float>(dragged.y)) * kDragTurn_rad;
    return turn * (options.turning == Turning::Snap ? 1.0f : options.sensitivity);
}

Result<HandSourceChoice> handSourceFor(const PlayOptions& options) {
    const std::string& text = options.hands.source;
    if (options.xr && (text.empty() || text == "auto")) return HandSourceChoice{HandSourceKind::OpenXr, {}};
    auto choice = parseHandSource(!text.empty() ? text : options.headless ? "mouse" : "auto");
    if (choice && choice->kind == HandSourceKind::OpenXr && !options.xr)
        return Error{"--hands openxr", "needs --xr: these hands are tracked by a headset"};
    std::error_code code;
    const bool isClip = choice && choice->kind == HandSourceKind::Webcam &&
                        !webcamFrom(choice->argument, false, 1).file.empty();
    if (isClip && !std::filesystem::is_regular_file(choice->argument, code))
        return Error{choice->argument, "there is no such clip"};
    return choice;
}

void MouseSource::frame(const Controls* controls, const ControlOptions& options, const game::Snapshot& shown,
                        float dt_s, float verticalFov, float aspect) {
    hands::MouseInput mouse{.aspect = aspect, .fovY = verticalFov};
    if (controls) {
        const Controls& c = *controls;
        const platform::WindowInput& input = c.input;
        const glm::vec2 turn = turnBy(c, options, dt_s, snapped_);
        look_.turnBy(turn);
        const float rate = dt_s > 0 ? glm::length(turn) / dt_s : 0;
        turning_radps_ += (rate - turning_radps_) * std::min(1.0f, 8 * dt_s);
        if (c.wasPressed(Action::Recentre)) recentre();
        // The mouse sets the pointer's position; the stick sets its velocity.
        if (input.cursorMoved != glm::dvec2(0) && !input.rightButton)
            pointer_ = {static_cast<float>(input.cursor.x) * 2 - 1,
                        1 - static_cast<float>(input.cursor.y) * 2};
        pointer_ = glm::clamp(pointer_ + input.gamepad.rightStick * (kStickReach_ps * dt_s), -1.0f, 1.0f);
        mouse.cursor = pointer_;
        mouse.wheel =
            static_cast<float>(input.wheel) + kKeyNotches_ps * dt_s * c.axis(Action::Farther, Action::Nearer);
        if (hand_ != options.hand) hands_.setActive(hand_ = options.hand);
        mouse.swapHands = c.wasPressed(Action::SwapHands);
        const float trigger = input.gamepad.rightTrigger;
        const bool holds = input.leftButton || c.isDown(Action::CloseHand);
        const bool pressed = holds || trigger > kTriggerDeadZone;
        awaitsOpen_ = awaitsOpen_ && pressed;
        const bool down = pressed && !awaitsOpen_;
        if (options.closing == Closing::Toggle) {
            toggled_ = toggled_ != (down && !wasDown_);
            mouse.close = toggled_ ? 1.0f : 0.0f;
        } else if (down) {
            mouse.close = holds ? 1.0f : trigger;
        }
        wasDown_ = down;
        mouse.reach_m =
            game::reachHelp(shown, species_, rayThroughCursor(mouse), hands_.distance_m(), reachTarget_);
        mouse.reachHelp = options.reachHelp;
    }
    poses_ = hands_.update(mouse, dt_s);
    for (size_t side = 0; side < 2; ++side) {
        const bool idle = side != static_cast<size_t>(hands_.active()) && shown.hands[side].holds < 0;
        sunk_[side] += ((idle ? 1.0f : 0.0f) - sunk_[side]) * math::followShare(dt_s, kSink_s);
    }
}

void MouseSource::show(game::Snapshot& shown) const {
    constexpr float kHidden = 0.95f;
    for (size_t side = 0; side < 2; ++side) {
        game::HandView& hand = shown.hands[side];
        hand.visible = hand.visible && sunk_[side] < kHidden;
        const glm::vec3 down = shown.worldFromView * glm::vec3(0, -kSinkDepth_m * sunk_[side], 0);
        for (hands::Joint& joint : hand.joints) joint.position += down;
        for (game::CreatureView& animal : shown.creatures)
            if (animal.catchableBy == static_cast<int>(side)) animal.catchable *= 1 - sunk_[side];
    }
}

TrackedHands::TrackedHands(const HandSourceChoice& source, const HandOptions& options,
                           const hands::HandRig& rig, bool live)
    : asked_(source.kind != HandSourceKind::Auto),
      tracker_(source.kind == HandSourceKind::Webcam
                   ? hands::makeWebcamTracker(webcamFrom(source.argument, live, options.size), rig)
                   : hands::makeLeapTracker(options.leap, rig)),
      hands_(live ? hands::DeviceTime::Live : hands::DeviceTime::Stamps) {}

void TrackedHands::announce() {
    const bool gone = announced_.value_or(false);
    announced_ = state_.present;
    announcedAt_s_ = played_s_;
    const std::string name(tracker_->name());
    announcement_.reset();
    if (state_.present) {
        announcement_ = game::Notice{"Hands: {}", name};
        log::info("Hands: {}, {}", name, state_.description);
    } else if (asked_ || gone) { // announces why the device is not used
        announcement_ = needs();
        using game::Text;
        if (!announcement_)
            announcement_ = game::Notice{gone ? Text("{} is gone: the mouse moves the hands")
                                              : Text("{} was not found: the mouse moves the hands"),
                                         name};
        log::info("Hands: mouse; {}: {}", name, state_.description);
    } else
        log::info("Hands: mouse");
}

void TrackedHands::frame(double elapsed_s) {
    hands::HandStream& stream = tracker_->stream();
    hands_.advance(stream, elapsed_s, hands::Clock::now());
    played_s_ += elapsed_s;
    constexpr float kElbowEase_s = 0.05f;
    const float share = math::followShare(static_cast<float>(elapsed_s), kElbowEase_s);
    for (int side = 0; side < 2; ++side) {
        glm::vec3& shown = towardsElbow_[side];
        shown += ((choice_.fromDevice() ? hands_.towardsElbow(side) : glm::vec3(0)) - shown) * share;
    }
    state_ = stream.state();
    if (announced_ != state_.present && (state_.present || played_s_ > kDeviceSearch_s)) announce();
}

std::optional<float> TrackedHands::openHand_m() const {
    std::optional<float> found;
    for (int side = 0; side < 2; ++side) {
        if (hands_.notSeen_s(side) > hands::kHandLost_s) continue;
        if (found || hands_.hand(side).gesture() != hands::Gesture::Open) return std::nullopt;
        found = hands_.rigDistance_m(side);
    }
    return found;
}

bool ReplaySource::next(game::TickInput& input) {
    if (atEnd()) return false;
    const auto tick = recording.next();
    if (!tick) {
        verdict = tick.error();
        return false;
    }
    input = game::fromBytes(tick->input.first<game::kTickInputBytes>());
    hash = tick->hash;
    return true;
}

void ReplaySource::compare(uint64_t stateHash) {
    verdict = sim::sameState(recording.position() - 1, hash, stateHash);
    if (verdict && recording.atEnd() && !recording.complete())
        verdict =
            Error{"", "the recording is cut short or damaged after " + std::to_string(recording.ticks()) +
                          " ticks; up to there the states are the same"};
}

} // namespace shoal::app
