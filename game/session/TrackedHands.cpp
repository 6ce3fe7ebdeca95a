#include "game/session/TrackedHands.h"

#include "engine/core/Files.h"
#include "engine/core/Log.h"
#include "engine/sim/FixedStep.h"
#include "input/hands/leap/LeapTracker.h"
#include "input/hands/webcam/WebcamTracker.h"

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
    : singleDevice_(source.kind != HandSourceKind::Auto) {
    const auto time = live ? hands::DeviceTime::Live : hands::DeviceTime::Stamps;
    const auto add = [&](std::unique_ptr<hands::HandTracker> tracker) {
        devices_.push_back(
            std::make_unique<Device>(Device{std::move(tracker), hands::DeviceHands(time), {}, 0}));
        order_.push_back(&devices_.back()->hands);
    };
    if (source.kind == HandSourceKind::Leap || source.kind == HandSourceKind::Auto)
        add(hands::makeLeapTracker({options.leapHost, options.leapPort, options.leapMount == LeapMount::Head},
                                   rig));
    // A camera looks at people: it is only ever opened when it is asked for, never by auto.
    if (source.kind == HandSourceKind::Webcam)
        add(hands::makeWebcamTracker(webcamFrom(source.argument, live), rig));
}

// Which of the devices is there, and what they want.
void TrackedHands::updateStates() {
    bool changed = false;
    for (const auto& device : devices_) {
        hands::HandStream& stream = device->tracker->stream();
        const uint64_t changes = stream.stateChanges();
        if (changes == device->stateChanges) continue;
        device->stateChanges = changes;
        device->state = stream.state();
        changed = true;
    }
    if (!changed) return;
    present_ = hands::HandSourceSelector::kMouse;
    instruction_.clear();
    for (size_t i = 0; i < devices_.size(); ++i) {
        if (instruction_.empty()) instruction_ = devices_[i]->state.instruction;
        if (present_ == hands::HandSourceSelector::kMouse && devices_[i]->state.present)
            present_ = static_cast<int>(i);
    }
}

void TrackedHands::announce() {
    announced_ = present_;
    announcedAt_s_ = played_s_;
    announcement_ = "Hands: mouse";
    if (present_ != hands::HandSourceSelector::kMouse) {
        const Device& device = *devices_[static_cast<size_t>(present_)];
        announcement_ = "Hands: " + std::string(device.tracker->name()) + ", " + device.state.description;
    } else if (singleDevice_) { // why not the one asked for
        for (const auto& device : devices_)
            announcement_ += "; " + std::string(device->tracker->name()) + ": " + device->state.description;
    }
    log::info("{}", announcement_);
}

void TrackedHands::frame(double elapsed_s) {
    for (const auto& device : devices_) device->hands.advance(device->tracker->stream(), elapsed_s);
    played_s_ += elapsed_s;
    updateStates();
    if (present_ != announced_ &&
        (present_ != hands::HandSourceSelector::kMouse || played_s_ > kFindDevices_s))
        announce();
    choice_.frame(order_);
}

void TrackedHands::tick(game::TickInput& input, int ticksLeft) {
    choice_.tick(input.hands, ticksLeft, static_cast<float>(sim::kTick_s));
}

std::string_view TrackedHands::caption() const {
    if (!instruction_.empty()) return instruction_;
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
