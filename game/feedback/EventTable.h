// The one table of events: what each is called in playthroughs, and how it is heard, captioned and felt. An
// event of game/rules/Events.h that has no row here does not compile.
#pragma once

#include "game/feedback/Sounds.h"
#include "game/rules/Events.h"

#include <array>
#include <optional>
#include <string_view>

namespace shoal::game {

// A pulse that fades. With an event that has a closing speed, amplitude and frequency grow from the first
// value to the second at kFullSpeed_mps; with others the second counts.
struct HapticPulse {
    enum class Where { Nowhere, Part, Hand, Body, HandAndBody };
    Where where = Where::Nowhere;
    float amplitudeLow = 0, amplitude = 0; // 0 to 1
    float frequencyLow_Hz = 0, frequency_Hz = 0;
    float decay_s = 1; // to 1/e
};
constexpr float kFullSpeed_mps = 1.5f;

struct EventRow {
    EventKind kind;
    const char* name;     // in playthrough files and the log
    const char* caption;  // empty: none, it would only distract
    Sound sound;          // where the event is; everywhere if it has no position
    float gain = 1;       // at rest
    float gainPerMps = 0; // and what each m/s of closing speed adds; together at most 1
    HapticPulse pulse = {};
};

// clang-format off
constexpr std::array kEventRows = std::to_array<EventRow>({
    {EventKind::Touch, "touch", "", Sound::Touch, 0.4f, 0.4f, {HapticPulse::Where::Part, 0.15f, 1, 140, 260, 0.08f}},
    {EventKind::Startle, "startle", "a fish flees", Sound::Startle},
    {EventKind::Grab, "grab", "", Sound::Touch},
    {EventKind::Catch, "catch", "caught", Sound::Catch, 1, 0, {HapticPulse::Where::Hand, 0, 0.8f, 0, 180, 0.18f}},
    {EventKind::Release, "release", "let go", Sound::Release},
    {EventKind::Escape, "escape", "it slips away", Sound::Escape},
    {EventKind::Miss, "miss", "", Sound::Miss},
    {EventKind::SharkNear, "shark_near", "the shark is near", Sound::SharkNear, 1, 0, {HapticPulse::Where::Body, 0, 0.3f, 0, 30, 0.6f}},
    {EventKind::SharkBump, "shark_bump", "the shark bumps you", Sound::SharkBump, 0.5f, 0.4f, {HapticPulse::Where::HandAndBody, 1, 1, 40, 40, 0.25f}},
    {EventKind::SharkSteal, "shark_steal", "the shark bites", Sound::SharkBite, 1, 0, {HapticPulse::Where::HandAndBody, 1, 1, 40, 40, 0.25f}},
    {EventKind::DiveStart, "dive_start", "the dive begins", Sound::DiveStart},
    {EventKind::DiveOver, "dive_over", "the dive is over", Sound::DiveOver},
});
// clang-format on
static_assert(oneRowEach(kEventRows, &EventRow::kind, EventKind::DiveOver));

constexpr const EventRow& rowOf(EventKind kind) { return kEventRows[static_cast<size_t>(kind)]; }

inline std::optional<EventKind> findEvent(std::string_view name) {
    for (const EventRow& row : kEventRows)
        if (name == row.name) return row.kind;
    return std::nullopt;
}

} // namespace shoal::game
