// The tables of sounds and of events: each event's name in playthroughs, sound, caption and haptic pulse. An
// event of EventKind that has no row here does not compile.
#pragma once

#include "engine/core/EnumNames.h"
#include "game/rules/Snapshot.h"
#include "game/texts/Texts.h"

#include <algorithm>
#include <array>
#include <optional>

namespace shoal::game {

// The game's sounds, in order of the audio's clips: name, file in content/sounds without .flac, and gain, 0
// to 1, on the clip as mastered. The two beds are the sea's background sounds, for open water and a tunnel.
// clang-format off
#define SHOAL_SOUNDS(ROW) \
    ROW(BedOpen, "bed_open", 0.45f) \
    ROW(BedTunnel, "bed_tunnel", 0.5f) \
    ROW(FishPassSmall, "fish_pass_small", 0.8f) \
    ROW(FishPassLarge, "fish_pass_large", 1) \
    ROW(Touch, "touch", 1) \
    ROW(Catch, "catch", 1) \
    ROW(Struggle, "struggle", 0.8f) \
    ROW(Release, "release", 0.9f) \
    ROW(Escape, "escape", 1) \
    ROW(Startle, "startle", 0.8f) \
    ROW(Miss, "miss", 0.9f) \
    ROW(MissTooFar, "miss_too_far", 0.9f) \
    ROW(MissTooFast, "miss_too_fast", 0.9f) \
    ROW(MissTooEarly, "miss_too_early", 0.9f) \
    ROW(MissBehind, "miss_behind", 0.9f) \
    ROW(SharkNear, "shark_near", 1) \
    ROW(SharkBite, "shark_bite", 1) \
    ROW(SharkBump, "shark_bump", 1) \
    ROW(Crack, "crack", 1) \
    ROW(Knock, "knock", 0.8f) \
    ROW(Throw, "throw", 0.8f) \
    ROW(Feed, "feed", 0.9f) \
    ROW(Collect, "collect", 1) \
    ROW(WhaleSong, "whale_song", 1) \
    ROW(Bubbles, "bubbles", 0.3f) \
    ROW(Countdown, "countdown", 0.8f) \
    ROW(DiveStart, "dive_start", 0.8f) \
    ROW(DiveOver, "dive_over", 1)
// clang-format on
#define SHOAL_SOUND(name, file, gain) name,
enum class Sound { SHOAL_SOUNDS(SHOAL_SOUND) };
#undef SHOAL_SOUND

struct SoundRow {
    const char* file;
    float gain;
};
#define SHOAL_SOUND(name, file, gain) SoundRow{file, gain},
constexpr std::array kSounds = {SHOAL_SOUNDS(SHOAL_SOUND)};
#undef SHOAL_SOUND
#undef SHOAL_SOUNDS

constexpr const SoundRow& rowOf(Sound sound) { return kSounds[static_cast<size_t>(sound)]; }

// A theme of music has a stereo loop of each, all of one length: content/sounds/music_THEME_LAYER.flac. Its
// clips come after the sounds.
inline constexpr std::array kMusicLayers = {"calm", "tension"};

// A haptic pulse that fades. For an event at one part of a hand, amplitude and frequency grow from the first
// value to the second at a closing speed of kFullSpeed_mps; for others the second counts.
struct HapticPulse {
    enum class Where { Nowhere, Part, Hand, Body, HandAndBody };
    Where where = Where::Nowhere;
    float amplitudeLow = 0, amplitude = 0; // 0 to 1
    float frequencyLow_Hz = 0, frequency_Hz = 0;
    float decay_s = 1; // time constant: falls to 1/e
};
constexpr float kFullSpeed_mps = 1.5f;

struct EventRow {
    EventKind kind;
    const char* name;            // name in playthrough files and the log
    std::optional<Text> caption; // empty: none, it would only distract
    Sound sound;                 // played at the event's place; everywhere if it has none
    float gain = 1;              // gain at rest
    float gainPerMps = 0;        // added gain for each m/s of closing speed; together at most 1
    HapticPulse pulse = {};
    float quiet_s = 0; // time without another sound or caption of this kind
};

// clang-format off
constexpr std::array kEventRows = std::to_array<EventRow>({
    {EventKind::Touch, "touch", {}, Sound::Touch, 0.4f, 0.4f, {HapticPulse::Where::Part, 0.15f, 1, 140, 260, 0.08f}, 0.12f}, // one touch has several bones
    {EventKind::Startle, "startle", Text("a fish flees"), Sound::Startle},
    {EventKind::Grab, "grab", {}, Sound::Touch},
    {EventKind::Catch, "catch", Text("caught"), Sound::Catch, 1, 0, {HapticPulse::Where::Hand, 0, 0.8f, 0, 180, 0.18f}},
    {EventKind::Release, "release", {}, Sound::Release},
    {EventKind::Escape, "escape", Text("it slips away"), Sound::Escape},
    {EventKind::Miss, "miss", {}, Sound::Miss},
    {EventKind::MissTooFar, "miss_too_far", Text("too far"), Sound::MissTooFar},
    {EventKind::MissTooFast, "miss_too_fast", Text("too fast"), Sound::MissTooFast},
    {EventKind::MissTooEarly, "miss_too_early", Text("closed too early"), Sound::MissTooEarly},
    {EventKind::MissBehind, "miss_behind", Text("behind the fish"), Sound::MissBehind},
    {EventKind::Sting, "sting", Text("it stings"), Sound::Startle, 1, 0, {HapticPulse::Where::Hand, 0, 0.9f, 0, 220, 0.3f}},
    {EventKind::Throw, "throw", {}, Sound::Throw},
    {EventKind::Knock, "knock", {}, Sound::Knock, 0.3f, 0.3f},
    {EventKind::Crack, "crack", Text("the mussel cracks"), Sound::Crack, 1, 0, {HapticPulse::Where::Hand, 0, 0.9f, 0, 200, 0.08f}},
    {EventKind::Feed, "feed", Text("fish come to feed"), Sound::Feed},
    {EventKind::NoGuest, "no_guest", Text("no fish is near enough to feed"), Sound::Miss},
    {EventKind::SharkTurns, "shark_turns", Text("the shark turns away"), Sound::FishPassLarge, 1, 0, {HapticPulse::Where::Body, 0, 0.3f, 0, 30, 0.4f}},
    {EventKind::Collect, "collect", Text("out of the sea"), Sound::Collect, 1, 0, {HapticPulse::Where::Hand, 0, 0.6f, 0, 160, 0.15f}},
    {EventKind::Goal, "goal", Text("goal reached"), Sound::Catch, 0.7f},
    {EventKind::Encounter, "encounter", Text("a whale sings"), Sound::WhaleSong, 1, 0, {HapticPulse::Where::Body, 0, 0.3f, 0, 24, 1.5f}},
    {EventKind::SharkNear, "shark_near", Text("the shark is near"), Sound::SharkNear, 1, 0, {HapticPulse::Where::Body, 0, 0.3f, 0, 30, 0.6f}},
    {EventKind::SharkAims, "shark_aims", Text("the shark is after your hand"), Sound::SharkNear, 1, 0, {HapticPulse::Where::Body, 0, 0.6f, 0, 45, 0.5f}},
    {EventKind::SharkBump, "shark_bump", Text("the shark bumps you"), Sound::SharkBump, 0.5f, 0.4f, {HapticPulse::Where::HandAndBody, 1, 1, 40, 40, 0.25f}},
    {EventKind::SharkSteal, "shark_steal", Text("the shark bites"), Sound::SharkBite, 1, 0, {HapticPulse::Where::HandAndBody, 1, 1, 40, 40, 0.25f}},
    {EventKind::DiveStart, "dive_start", Text("the dive begins"), Sound::DiveStart},
    {EventKind::DiveOver, "dive_over", Text("the dive is over"), Sound::DiveOver},
});
// clang-format on
// There is one row for each kind, in the order of the enumeration.
static_assert([] {
    for (size_t i = 0; i < kEventRows.size(); ++i)
        if (kEventRows[i].kind != static_cast<EventKind>(i)) return false;
    return kEventRows.size() == static_cast<size_t>(EventKind::DiveOver) + 1;
}());

constexpr const EventRow& rowOf(EventKind kind) { return kEventRows[static_cast<size_t>(kind)]; }

} // namespace shoal::game

template <>
inline constexpr auto shoal::kEnumNames<shoal::game::EventKind> = [] {
    std::array<const char*, shoal::game::kEventRows.size()> names{};
    std::ranges::transform(shoal::game::kEventRows, names.begin(), &shoal::game::EventRow::name);
    return names;
}();
