// Distances and times of the shark's behaviour.
#pragma once

namespace shoal::game {

constexpr float kJaws_m = 0.28f;         // how near its mouth must come to take a fish
constexpr float kSharkEyeRoom_m = 0.55f; // no part of its axis comes nearer to the player's eyes
constexpr float kStrikeTime_s = 2.5f;    // then it gives up
constexpr float kCarryTo_m = 3.6f;       // where it loses what it took
constexpr float kTempted = 4;            // seconds of struggling that bring it early
constexpr float kStrikeFrom_m = 3.0f;    // farther away it does not try

// It never strikes unannounced: first it points at a hand, slowly, in full view, for at least so long.
constexpr float kAim_s = 1.1f;
constexpr float kAimed = 0.92f;       // cosine of the angle within which it points at it
constexpr float kThreat_s = 4.5f;     // then it breaks off
constexpr float kThreatRest_s = 2.5f; // before the next
constexpr float kThreatFrom_m = 2.6f; // from its mouth to the hand
constexpr float kThreatRoom_m = 0.7f; // nearer than that it turns away
constexpr float kWide_m = 2.6f;       // radius from which it begins the next approach

} // namespace shoal::game
