#include "game/app/TrackedHands.h"

#include "engine/core/Files.h"
#include "engine/core/Log.h"
#include "engine/sim/FixedStep.h"

#include <cstdlib>
#include <filesystem>

namespace shoal::app {

namespace {

constexpr double kCaption_s = 4;
constexpr double kFindDevices_s = 1; // before the mouse is said to be all there is

hands::HandStream& streamOf(HandDevice& device) {
    return std::visit([](auto& d) -> hands::HandStream& { return d.stream(); }, device);
}

std::string nameOf(const HandDevice& device) {
    return std::visit([](const auto& d) -> std::string { return d.kName; }, device);
}

// What follows "webcam:": a clip, or the number of a camera; empty for the first camera.
std::optional<std::string> webcamIn(const std::string& source) {
    if (source == "webcam") return std::string();
    if (source.starts_with("webcam:")) return source.substr(7);
    return std::nullopt;
}

bool isIndex(const std::string& text) {
    return !text.empty() && text.size() <= 2 && text.find_first_not_of("0123456789") == std::string::npos;
}

hands::WebcamOptions webcamFrom(const std::string& which, bool live) {
    if (which.empty()) return {"", 0, live};
    if (isIndex(which)) return {"", std::atoi(which.c_str()), live};
    return {which, 0, live};
}

} // namespace

TrackedHands::TrackedHands(const HandOptions& options, const hands::HandRig& rig, bool live)
    : asked_(options.source != "auto") {
    const auto time = live ? hands::DeviceTime::Live : hands::DeviceTime::Stamps;
    const auto add = [&](HandDevice device) {
        seats_.push_back(std::make_unique<Seat>(Seat{std::move(device), hands::DeviceHands(time), {}, 0}));
        order_.push_back(&seats_.back()->hands);
    };
    if (options.source == "leap" || options.source == "auto")
        add(hands::LeapHands({options.leapHost, options.leapPort, options.leapMount == "head"}, rig));
    // A camera looks at people: it is only ever opened when it is asked for, never by auto.
    if (const auto which = webcamIn(options.source)) add(hands::WebcamHands(webcamFrom(*which, live), rig));
}

// Which of the devices is there, and what they want.
void TrackedHands::listen() {
    bool changed = false;
    for (const auto& seat : seats_) {
        hands::HandStream& stream = streamOf(seat->device);
        const uint64_t changes = stream.stateChanges();
        if (changes == seat->stateSeen) continue;
        seat->stateSeen = changes;
        seat->state = stream.state();
        changed = true;
    }
    if (!changed) return;
    present_ = hands::HandChoice::kMouse;
    asks_.clear();
    for (size_t i = 0; i < seats_.size(); ++i) {
        if (asks_.empty()) asks_ = seats_[i]->state.asks;
        if (present_ == hands::HandChoice::kMouse && seats_[i]->state.present) present_ = static_cast<int>(i);
    }
}

void TrackedHands::announce() {
    announced_ = present_;
    saidAt_s_ = played_s_;
    said_ = "Hands: mouse";
    if (present_ != hands::HandChoice::kMouse) {
        const Seat& seat = *seats_[static_cast<size_t>(present_)];
        said_ = "Hands: " + nameOf(seat.device) + ", " + seat.state.words;
    } else if (asked_) { // why not the one asked for
        for (const auto& seat : seats_) said_ += "; " + nameOf(seat->device) + ": " + seat->state.words;
    }
    log::info("{}", said_);
}

void TrackedHands::frame(double elapsed_s) {
    for (const auto& seat : seats_) seat->hands.advance(streamOf(seat->device), elapsed_s);
    played_s_ += elapsed_s;
    listen();
    if (present_ != announced_ && (present_ != hands::HandChoice::kMouse || played_s_ > kFindDevices_s))
        announce();
    choice_.frame(order_);
}

void TrackedHands::tick(game::TickInput& input, int ticksLeft) {
    choice_.tick(input.hands, ticksLeft, static_cast<float>(sim::kTick_s));
}

std::string_view TrackedHands::caption() const {
    if (!asks_.empty()) return asks_;
    return played_s_ - saidAt_s_ < kCaption_s ? std::string_view(said_) : std::string_view();
}

Status checkHandSource(const HandOptions& options) {
    for (const char* known : {"auto", "mouse", "leap"})
        if (options.source == known) return Done{};
    if (const auto which = webcamIn(options.source)) {
        std::error_code code;
        if (which->empty() || isIndex(*which) || std::filesystem::is_regular_file(*which, code))
            return Done{};
        return Error{*which, "there is no such clip"};
    }
    return Error{"--hands " + options.source,
                 "is not auto, mouse, leap, webcam[:FILE or number], openxr, script:FILE or replay:FILE"};
}

} // namespace shoal::app
