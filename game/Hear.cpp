#include "game/Hear.h"

#include <algorithm>
#include <cmath>

namespace shoal::game {

namespace {

constexpr float kPass_m = 1.1f;    // from the head: nearer fish are heard
constexpr float kPass_mps = 0.45f; // slower ones are not
constexpr float kPassQuiet_s = 4;  // between two passes of the same creature
constexpr float kLarge_m = 1;      // of body: what passes sounds large
constexpr float kCaptionStay_s = 2.2f;
constexpr size_t kCaptions = 3;
constexpr float kTouchQuiet_s = 0.12f; // one sound for all bones of a touch
constexpr int kCountdown_s = 5;
constexpr uint32_t kBedId = 1000000, kStruggleId = 1000001; // apart from creatures' ids

} // namespace

void Hear::play(Sound sound, const glm::vec3& position, float gain, bool everywhere) {
    const auto index = static_cast<size_t>(sound);
    shots_.push_back({static_cast<int>(index), position, gain, 1, everywhere});
    const std::string_view text = kSounds[index].caption;
    if (text.empty()) return;
    // The same caption again only becomes new.
    std::erase_if(captions_, [&](const Caption& caption) { return caption.text == text; });
    captions_.insert(captions_.begin(), {text, everywhere ? glm::vec3(0) : position, 0});
    if (captions_.size() > kCaptions) captions_.pop_back();
}

void Hear::listen(const Snapshot& shown, std::span<const Event> events, float dt_s) {
    shots_.clear();
    emitters_.clear();
    if (shown.paused) return;
    for (Caption& caption : captions_) caption.age_s += dt_s;
    std::erase_if(captions_, [](const Caption& caption) { return caption.age_s > kCaptionStay_s; });
    quiet_s_.resize(shown.creatures.size() + 1, 0);
    for (float& quiet : quiet_s_) quiet = std::max(0.0f, quiet - dt_s);
    float& touchQuiet = quiet_s_.back();

    emitters_.push_back({.id = kBedId, .clip = static_cast<int>(Sound::BedOpen), .everywhere = true});
    for (const CreatureView& creature : shown.creatures) {
        if (creature.heldBy >= 0)
            emitters_.push_back({.id = kStruggleId + creature.id,
                                 .clip = static_cast<int>(Sound::Struggle),
                                 .position = creature.position,
                                 .gain = 0.9f,
                                 .pitch = std::clamp(0.25f / creature.length, 0.7f, 1.4f)});
        float& quiet = quiet_s_[std::min<size_t>(creature.id, shown.creatures.size() - 1)];
        const bool large = creature.length > kLarge_m;
        const float distance_m = glm::length(creature.position);
        if (quiet > 0 || distance_m > kPass_m * (large ? 2.0f : 1.0f) || creature.heldBy >= 0 ||
            glm::length(creature.velocity) < kPass_mps)
            continue;
        quiet = kPassQuiet_s;
        play(large ? Sound::FishPassLarge : Sound::FishPassSmall, creature.position, large ? 1.0f : 0.6f);
    }
    for (const Event& event : events) {
        const float gain = std::clamp(0.4f + event.strength * 0.4f, 0.0f, 1.0f);
        switch (event.kind) {
        case Event::Kind::Touch:
            if (touchQuiet <= 0) play(Sound::Touch, event.position, gain);
            touchQuiet = kTouchQuiet_s;
            break;
        case Event::Kind::Startle:
            play(Sound::Startle, event.position, 0.7f);
            break;
        case Event::Kind::Grab:
            play(Sound::Touch, event.position, 1);
            break;
        case Event::Kind::Catch:
            play(Sound::Catch, event.position, 1);
            break;
        case Event::Kind::Release:
            play(Sound::Release, event.position, 0.8f);
            break;
        case Event::Kind::Escape:
            play(Sound::Escape, event.position, 0.9f);
            break;
        case Event::Kind::Miss:
            play(Sound::Miss, event.position, 0.8f);
            break;
        case Event::Kind::SharkNear:
            play(Sound::SharkNear, event.position, 1);
            break;
        case Event::Kind::SharkBump:
            play(Sound::SharkBump, event.position, gain);
            break;
        case Event::Kind::SharkSteal:
            play(Sound::SharkBite, event.position, 1);
            break;
        case Event::Kind::DiveStart:
            play(Sound::DiveStart, {}, 0.8f, true);
            break;
        case Event::Kind::DiveOver:
            play(Sound::DiveOver, {}, 1, true);
            break;
        }
    }
    const int left = static_cast<int>(std::ceil(shown.timeLeft_s));
    if (shown.phase == Phase::Diving && left >= 1 && left <= kCountdown_s && left != countedDown_)
        play(Sound::Countdown, {}, 0.7f, true);
    countedDown_ = left;
}

} // namespace shoal::game
