#include "game/session/TrackedHands.h"

#include "engine/core/Files.h"
#include "engine/core/Log.h"
#include "engine/sim/FixedStep.h"

#include <cstdlib>
#include <filesystem>

namespace shoal::app {

namespace {

constexpr double kCaption_s = 4;
constexpr double kFindDevices_s = 1; // before the mouse is said to be all there is

bool isIndex(const std::string& text) {
    return !text.empty() && text.size() <= 2 && text.find_first_not_of("0123456789") == std::string::npos;
}

hands::WebcamOptions webcamFrom(const std::string& which, bool live) {
    if (which.empty()) return {"", 0, live};
    if (isIndex(which)) return {"", std::atoi(which.c_str()), live};
    return {which, 0, live};
}

} // namespace

TrackedHands::TrackedHands(const HandSourceChoice& source, const HandOptions& options,
                           const hands::HandRig& rig, bool live)
    : asked_(source.kind != HandSourceKind::Auto),
      tracker_(source.kind == HandSourceKind::Webcam
                   ? hands::makeWebcamTracker(webcamFrom(source.argument, live), rig)
                   : hands::makeLeapTracker(
                         {options.leapHost, options.leapPort, options.leapMount == LeapMount::Head}, rig)),
      hands_(live ? hands::DeviceTime::Live : hands::DeviceTime::Stamps) {}

void TrackedHands::announce() {
    announced_ = state_.present;
    announcedAt_s_ = played_s_;
    const std::string name(tracker_->name());
    announcement_ = "Hands: mouse";
    if (state_.present)
        announcement_ = "Hands: " + name + ", " + state_.description;
    else if (asked_) // why not this one
        announcement_ += "; " + name + ": " + state_.description;
    log::info("{}", announcement_);
}

void TrackedHands::frame(double elapsed_s) {
    hands::HandStream& stream = tracker_->stream();
    hands_.advance(stream, elapsed_s);
    played_s_ += elapsed_s;
    state_ = stream.state();
    if (announced_ != state_.present && (state_.present || played_s_ > kFindDevices_s)) announce();
}

void TrackedHands::tick(game::TickInput& input, int ticksLeft) {
    choice_.tick(hands_, input.hands, ticksLeft, static_cast<float>(sim::kTick_s));
}

std::string_view TrackedHands::caption() const {
    if (!state_.instruction.empty()) return state_.instruction;
    return played_s_ - announcedAt_s_ < kCaption_s ? std::string_view(announcement_) : std::string_view();
}

Status checkHandSource(const HandSourceChoice& source) {
    if (source.kind != HandSourceKind::Webcam || source.argument.empty() || isIndex(source.argument))
        return Done{};
    std::error_code code;
    if (std::filesystem::is_regular_file(source.argument, code)) return Done{};
    return Error{source.argument, "there is no such clip"};
}

} // namespace shoal::app
