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
    const char* name;     // in playthrough files and the log
    const char* caption;  // empty: none, it would only distract
    Sound sound;          // where the event is; everywhere if it has no position
    float gain = 1;       // at rest
    float gainPerMps = 0; // and what each m/s of closing speed adds; together at most 1
    HapticPulse pulse = {};
};

template <class E> constexpr bool kHasEventRow = false;
template <class E>
constexpr EventRow kEventRow = [] {
    static_assert(kHasEventRow<E>, "an event without a row in this table");
    return EventRow{};
}();

// clang-format off
template <> inline constexpr EventRow kEventRow<events::Touch> =
    {"touch", "", Sound::Touch, 0.4f, 0.4f, {HapticPulse::Where::Part, 0.15f, 1, 140, 260, 0.08f}};
template <> inline constexpr EventRow kEventRow<events::Startle> =
    {"startle", "a fish flees", Sound::Startle};
template <> inline constexpr EventRow kEventRow<events::Grab> =
    {"grab", "", Sound::Touch};
template <> inline constexpr EventRow kEventRow<events::Catch> =
    {"catch", "caught", Sound::Catch, 1, 0, {HapticPulse::Where::Hand, 0, 0.8f, 0, 180, 0.18f}};
template <> inline constexpr EventRow kEventRow<events::Release> =
    {"release", "let go", Sound::Release};
template <> inline constexpr EventRow kEventRow<events::Escape> =
    {"escape", "it slips away", Sound::Escape};
template <> inline constexpr EventRow kEventRow<events::Miss> =
    {"miss", "", Sound::Miss};
template <> inline constexpr EventRow kEventRow<events::SharkNear> =
    {"shark_near", "the shark is near", Sound::SharkNear, 1, 0, {HapticPulse::Where::Body, 0, 0.3f, 0, 30, 0.6f}};
template <> inline constexpr EventRow kEventRow<events::SharkBump> =
    {"shark_bump", "the shark bumps you", Sound::SharkBump, 0.5f, 0.4f, {HapticPulse::Where::HandAndBody, 1, 1, 40, 40, 0.25f}};
template <> inline constexpr EventRow kEventRow<events::SharkSteal> =
    {"shark_steal", "the shark bites", Sound::SharkBite, 1, 0, {HapticPulse::Where::HandAndBody, 1, 1, 40, 40, 0.25f}};
template <> inline constexpr EventRow kEventRow<events::DiveStart> =
    {"dive_start", "the dive begins", Sound::DiveStart};
template <> inline constexpr EventRow kEventRow<events::DiveOver> =
    {"dive_over", "the dive is over", Sound::DiveOver};
// clang-format on

// Kind of an event: index of its row, and of its alternative in Event::what.
using EventKind = size_t;

template <class... E> constexpr auto eventRows(const std::variant<E...>*) {
    return std::array{kEventRow<E>...};
}
inline constexpr auto kEventRows = eventRows(static_cast<const decltype(Event::what)*>(nullptr));

inline EventKind kindOf(const Event& event) { return event.what.index(); }
template <class E> EventKind kindOf() { return decltype(Event::what)(E{}).index(); }
inline const EventRow& rowOf(const Event& event) { return kEventRows[kindOf(event)]; }

inline std::optional<EventKind> findEvent(std::string_view name) {
    for (EventKind kind = 0; kind < kEventRows.size(); ++kind)
        if (name == kEventRows[kind].name) return kind;
    return std::nullopt;
}

// Fields that only some events have.
inline std::optional<glm::vec3> positionOf(const Event& event) {
    return std::visit(
        [](const auto& e) -> std::optional<glm::vec3> {
            if constexpr (requires { e.position; }) return e.position;
            return std::nullopt;
        },
        event.what);
}
inline float closingSpeedOf(const Event& event) { // m/s, 0 for events that have none
    return std::visit(
        [](const auto& e) {
            if constexpr (requires { e.closing_mps; }) return e.closing_mps;
            return 0.0f;
        },
        event.what);
}
inline int handOf(const Event& event) { // -1 for events that have none
    return std::visit(
        [](const auto& e) {
            if constexpr (requires { e.hand; }) return e.hand;
            return -1;
        },
        event.what);
}
inline int partOf(const Event& event) { // -1 for events that have none
    return std::visit(
        [](const auto& e) {
            if constexpr (requires { e.part; }) return e.part;
            return -1;
        },
        event.what);
}

} // namespace shoal::game
