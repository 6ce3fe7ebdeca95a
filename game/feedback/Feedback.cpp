#include "game/feedback/Feedback.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::game {

constexpr float kPass_m = 1; // distance from the head within which a pass is heard; twice it for large ones
constexpr float kPass_mps = 0.45f; // slower passes are silent
constexpr float kPassQuiet_s = 4;  // time between two passes of the same creature
constexpr float kLarge_m = 1;      // body length from which a pass sounds large
// Time from a clip's start to its loudest moment; the clip starts that long before the creature is nearest.
constexpr float kPassPeakSmall_s = 0.3f, kPassPeakLarge_s = 0.75f;
constexpr size_t kCaptions = 3;
constexpr Text kStruggleCaption = "it struggles", kPassCaption = "something large passes",
               kCountdownCaption = "the last seconds";
constexpr int kCountdown_s = 5;
constexpr float kBreathShortest_s = 6, kBreathLongest_s = 9;
constexpr float kCross_s = 2;                          // cross-fade between beds
constexpr uint32_t kBedId = 1u << 30;                  // distinct from the creatures' ids
constexpr float kMusicRise_s = 1.5f, kMusicFall_s = 4; // from silence to a layer's full level, and back
constexpr float kCalm = 0.75f, kLift = 0.25f;          // gain of the calm layer, and added after a catch
constexpr float kLiftStay_s = 2;
constexpr float kSharkFar_m = 2.5f, kSharkNear_m = 1.2f; // from the head: where tension begins, and is full
constexpr float kLastSeconds_s = 10;
constexpr size_t kEventsReserved = 64; // more sounds than a frame starts in ordinary play

// Actuation while a touch lasts; the pulses of events are in EventTable.h.
constexpr float kPress = 0.25f, kPressFull_m = 0.02f; // greatest amplitude of pressing, and its depth
constexpr float kPress_Hz = 45;
constexpr float kStroke = 0.5f, kStrokeFull_mps = 0.8f; // greatest amplitude of stroking, and its speed
constexpr float kScale_m = 0.004f; // spacing of a fish's scales; frequency = speed / spacing
constexpr float kStrokeLow_Hz = 40, kStrokeHigh_Hz = 240;
constexpr float kHeld = 0.15f, kStruggle = 0.6f; // amplitude of a held fish at rest; added at full struggle
constexpr float kHeld_Hz = 48, kStruggle_Hz = 30;

// Returns the actuation of a finger while it touches.
static haptics::Actuation underFinger(const TouchView& touch, bool held) {
    if (!touch.touches) return {};
    const float press = std::clamp(touch.depth_m / kPressFull_m, 0.0f, 1.0f);
    const float stroke = std::clamp(touch.slide_mps / kStrokeFull_mps, 0.0f, 1.0f);
    haptics::Actuation out = haptics::stronger(
        {kPress * press, kPress_Hz}, {kStroke * stroke * (0.5f + 0.5f * press),
                                      std::clamp(touch.slide_mps / kScale_m, kStrokeLow_Hz, kStrokeHigh_Hz)});
    if (held)
        out = haptics::stronger(
            out, {kHeld + kStruggle * touch.struggle, kHeld_Hz + kStruggle_Hz * touch.struggle});
    return out;
}

SoundCues::SoundCues() : breath_s_(kBreathShortest_s) {
    shots_.reserve(kEventsReserved);
    captions_.reserve(kCaptions + 1);
}

void SoundCues::caption(Text text, const glm::vec3& position) {
    const auto same = std::ranges::find(captions_, text, &Caption::text);
    const bool isShown = same != captions_.end() && same->age_s >= 0;
    // A repeated caption moves to the front. A new one waits until kCaptionGap_s after the last; it replaces
    // a caption that still waits.
    std::erase_if(captions_,
                  [&](const Caption& other) { return other.text == text || (!isShown && other.age_s < 0); });
    const bool waits = !isShown && !captions_.empty();
    const float age_s = waits ? std::min(captions_.front().age_s - kCaptionGap_s, 0.0f) : 0;
    captions_.insert(captions_.begin(), Caption{text, position, age_s});
    if (captions_.size() > kCaptions) captions_.pop_back();
}

void SoundCues::play(Sound sound, const glm::vec3& position, float gain, bool everywhere, float pitch,
                     const glm::vec3& velocity) {
    shots_.push_back({.clip = static_cast<int>(sound),
                      .position = position,
                      .gain = gain * gainOf(sound),
                      .pitch = pitch,
                      .everywhere = everywhere,
                      .velocity = velocity});
}

// Adds an emitter without a position, which loops the clip for as long as it is added in each frame.
void SoundCues::playLoop(size_t clip, float gain, bool inStep) {
    emitters_.push_back({.id = kBedId + static_cast<uint32_t>(clip),
                         .clip = static_cast<int>(clip),
                         .gain = gain,
                         .everywhere = true,
                         .inStep = inStep});
}

void SoundCues::playBeds(const Snapshot& shown, float dt_s) {
    const float wanted = std::clamp(shown.enclosure, 0.0f, 1.0f);
    enclosure_ += std::clamp(wanted - enclosure_, -dt_s / kCross_s, dt_s / kCross_s);
    const auto bed = [&](Sound sound, float share) {
        // The square root keeps the total power constant, because the two sounds are uncorrelated.
        if (share > 0) playLoop(static_cast<size_t>(sound), gainOf(sound) * std::sqrt(share), false);
    };
    bed(Sound::BedOpen, 1 - enclosure_);
    bed(Sound::BedTunnel, enclosure_);
}

float tensionOf(const Snapshot& shown) {
    if (shown.phase != Phase::Diving) return 0;
    float tension = 0;
    if (!shown.freeSwim && shown.timeLeft_s < kLastSeconds_s)
        tension = 0.8f - 0.4f * shown.timeLeft_s / kLastSeconds_s;
    for (const CreatureView& creature : shown.creatures) {
        const Motion motion = creature.gait.motion; // only sharks lunge, bite or cruise
        if (motion == Motion::Lunge || motion == Motion::Bite) return 1;
        if (motion != Motion::Cruise) continue;
        const float away_m = glm::distance(creature.position, shown.headWorld);
        const float near = std::clamp((kSharkFar_m - away_m) / (kSharkFar_m - kSharkNear_m), 0.0f, 1.0f);
        const float threat = std::min(creature.shape.finsDown / BodyShape::kThreatens, 1.0f);
        tension = std::max({tension, 0.6f * near * near, 0.9f * threat});
    }
    return tension;
}

void SoundCues::playMusic(const Snapshot& shown, std::span<const Event> events, float dt_s, float volume) {
    if (volume <= 0) return;
    liftLeft_s_ -= dt_s;
    if (std::ranges::find(events, EventKind::Catch, &Event::kind) != events.end()) liftLeft_s_ = kLiftStay_s;
    const auto follow = [&](float& level, float wanted) {
        level += std::clamp(wanted - level, -dt_s / kMusicFall_s, dt_s / kMusicRise_s);
    };
    follow(calm_, 1);
    follow(lift_, liftLeft_s_ > 0 ? 1.0f : 0.0f);
    follow(tension_, tensionOf(shown));
    const std::array gains = {calm_ * (kCalm + kLift * lift_), tension_}; // of kMusicLayers
    for (size_t layer = 0; layer < kMusicLayers.size(); ++layer)
        playLoop(kSounds.size() + layer, volume * gains[layer], true);
}

void SoundCues::playStruggle(const CreatureView& creature) {
    emitters_.push_back({.id = creature.id,
                         .clip = static_cast<int>(Sound::Struggle),
                         .position = creature.position,
                         .gain = gainOf(Sound::Struggle),
                         .pitch = std::clamp(0.25f / creature.length, 0.7f, 1.4f), // large ones beat slower
                         .velocity = creature.velocity});
    // A struggle lasts for many frames: its caption is prolonged and keeps its place among the others.
    for (Caption& shown : captions_)
        if (shown.text == kStruggleCaption) {
            shown = {shown.text, creature.position, 0};
            return;
        }
    caption(kStruggleCaption, creature.position);
}

void SoundCues::playPass(const CreatureView& creature, const glm::vec3& headWorld, float& quiet_s) {
    const bool large = creature.length > kLarge_m;
    const float speed2 = glm::dot(creature.velocity, creature.velocity);
    if (quiet_s > 0 || speed2 < kPass_mps * kPass_mps) return;
    const glm::vec3 fromHead = creature.position - headWorld;
    const float nearestIn_s = -glm::dot(fromHead, creature.velocity) / speed2;
    if (nearestIn_s < 0 || nearestIn_s > (large ? kPassPeakLarge_s : kPassPeakSmall_s)) return;
    const float nearest_m = glm::length(fromHead + creature.velocity * nearestIn_s);
    if (nearest_m > kPass_m * (large ? 2.0f : 1.0f)) return;
    quiet_s = kPassQuiet_s;
    const float pitch =
        large ? 1.0f
              : std::clamp(std::sqrt(0.2f / creature.length), 0.8f, 1.3f) * random_.between(0.95f, 1.05f);
    const float gain = std::min(1.0f, 0.4f + 0.4f * std::sqrt(speed2));
    play(large ? Sound::FishPassLarge : Sound::FishPassSmall, creature.position, gain, false, pitch,
         creature.velocity);
    if (large) caption(kPassCaption, creature.position);
}

void SoundCues::playEvent(const Event& event) {
    const EventRow& row = rowOf(event.kind);
    const float quiet_s = std::exchange(eventQuiet_s_[static_cast<size_t>(event.kind)], row.quiet_s);
    if (quiet_s > 0) return;
    const float gain = std::clamp(row.gain + row.gainPerMps * event.closing_mps, 0.0f, 1.0f);
    // Music keeps its pitch; all other sounds vary.
    const bool music = !event.position || row.sound == Sound::Catch;
    const float pitch = music ? 1.0f : random_.between(0.94f, 1.06f);
    const glm::vec3 position = event.position.value_or(glm::vec3(0));
    play(row.sound, position, gain, !event.position, pitch);
    if (event.kind == EventKind::DiveStart) captions_.clear(); // captions of the last dive
    if (row.caption) caption(*row.caption, position);
}

void SoundCues::playBreath(const Snapshot& shown, float dt_s) {
    if (shown.phase != Phase::Diving) return;
    breath_s_ -= dt_s;
    if (breath_s_ > 0) return;
    breath_s_ = random_.between(kBreathShortest_s, kBreathLongest_s);
    const glm::vec3 mouth = shown.headWorld + shown.worldFromView * glm::vec3(0, -0.1f, -0.12f);
    play(Sound::Bubbles, mouth, 1, false, random_.between(0.9f, 1.1f), {0, 0.35f, 0}); // bubbles rise
}

void SoundCues::playCountdown(const Snapshot& shown) {
    const int left = static_cast<int>(std::ceil(shown.timeLeft_s));
    if (shown.phase == Phase::Diving && left >= 1 && left <= kCountdown_s && left != countedDown_) {
        play(Sound::Countdown, {}, 1, true, left == 1 ? 1.335f : 1.0f); // the last one is a fourth higher
        caption(kCountdownCaption, glm::vec3(0));
    }
    countedDown_ = left;
}

void SoundCues::listen(const Snapshot& shown, std::span<const Event> events, float dt_s, float volume,
                       float music) {
    volume_ = volume;
    shots_.clear();
    emitters_.clear();
    playBeds(shown, dt_s);
    playMusic(shown, events, dt_s, music);
    if (shown.paused) return;
    for (Caption& caption : captions_) caption.age_s += dt_s;
    std::erase_if(captions_, [](const Caption& caption) { return caption.age_s > kCaptionStay_s; });
    for (float& quiet_s : eventQuiet_s_) quiet_s = std::max(0.0f, quiet_s - dt_s);
    quiet_s_.resize(shown.creatures.size(), 0);
    emitters_.reserve(shown.creatures.size() + 2 + kMusicLayers.size());
    for (size_t i = 0; i < shown.creatures.size(); ++i) {
        const CreatureView& creature = shown.creatures[i];
        quiet_s_[i] = std::max(0.0f, quiet_s_[i] - dt_s);
        if (creature.gait.motion >= Motion::Drift) continue; // a loose thing neither struggles nor passes
        if (creature.heldBy >= 0)
            playStruggle(creature);
        else
            playPass(creature, shown.headWorld, quiet_s_[i]);
    }
    for (const Event& event : events) playEvent(event);
    playBreath(shown, dt_s);
    playCountdown(shown);
}

void HapticFeedback::startPulse(const Event& event) {
    using Where = HapticPulse::Where;
    const HapticPulse& row = rowOf(event.kind).pulse;
    const float speed = std::clamp(event.closing_mps / kFullSpeed_mps, 0.0f, 1.0f);
    const float share = event.part >= 0 ? speed : 1;
    const Pulse pulse{{std::lerp(row.amplitudeLow, row.amplitude, share),
                       std::lerp(row.frequencyLow_Hz, row.frequency_Hz, share)},
                      row.decay_s};
    const auto strike = [&](Pulse& own) {
        if (pulse.amplitude >= own.amplitude) own = pulse;
    };
    if (row.where == Where::Body || row.where == Where::HandAndBody) strike(pulses_.back());
    if (row.where == Where::Nowhere || row.where == Where::Body || event.hand < 0) return;
    for (int part = 0; part < haptics::kActuatorsPerHand; ++part)
        if (row.where != Where::Part || part == event.part)
            strike(pulses_[event.hand * haptics::kActuatorsPerHand + part]);
}

haptics::HapticFrame HapticFeedback::frame(const Snapshot& shown, std::span<const Event> events, float dt_s,
                                           float strength) {
    if (shown.paused || shown.phase == Phase::Results) {
        pulses_ = {};
        return {};
    }
    for (Pulse& pulse : pulses_) pulse.amplitude *= std::exp(-dt_s / pulse.decay_s);
    for (const Event& event : events) startPulse(event);
    const auto felt = [&](haptics::Actuation out) {
        out.amplitude = std::clamp(out.amplitude * strength, 0.0f, 1.0f);
        return out;
    };
    haptics::HapticFrame frame;
    for (int i = 0; i < haptics::kActuatorCount; ++i) {
        const HandView& hand = shown.hands[i / haptics::kActuatorsPerHand];
        const TouchView& touch = hand.touching[i % haptics::kActuatorsPerHand];
        frame.actuators[i] = felt(haptics::stronger(pulses_[i], underFinger(touch, hand.holds >= 0)));
    }
    frame.body = felt(pulses_.back());
    return frame;
}

} // namespace shoal::game
