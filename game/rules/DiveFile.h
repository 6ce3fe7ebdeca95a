// The table of species, content/species.toml; one dive (a level), content/dives/NAME.toml; and the player's
// choice of rules before a dive.
#pragma once

#include "engine/core/EnumNames.h"
#include "engine/core/Files.h"
#include "engine/core/Result.h"

#include <glm/vec3.hpp>

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace shoal::game {

class FilmSpace; // game/rules/FilmSpace.h

// Company that a species keeps: none, one partner, or its whole school.
enum class Company { Alone, Pair, Shoal };
constexpr std::array<const char*, 3> kCompanyNames = {"alone", "pair", "shoal"};

// A loose thing, which lies in the sea and is thrown; see game/rules/Things.h.
enum class Thing { None, Mussel, Stone, Bottle };
constexpr std::array<const char*, 4> kThingNames = {"none", "mussel", "stone", "bottle"};

// One text in English, German and French, in this order; empty: English stands for it.
using InLanguages = std::array<std::string, 3>;

struct Species {
    std::string name;           // "clownfish"
    InLanguages one, several;   // its name on the screen; empty: the name above
    InLanguages fact;           // told in the field guide
    std::string model;          // file below content/
    glm::vec3 colour{1};        // linear; multiplies the model's colours
    bool shark = false;         // hunts instead of being caught
    bool giant = false;         // passes in an encounter instead of being caught
    float length_m = 0.2f;      // nose to tail
    float varies = 0.2f;        // greatest difference of a fish's length from that, a share of it
    float bodyRadius_m = 0.03f; // radius of the collision capsule along the body's Z
    float bodyHalf_m = 0.05f;   // half the length of the capsule's core segment
    float cruise_mps = 0.3f;
    float dart_mps = 1.6f; // at most kMaxSpeed_mps
    float turn_radps = 2;  // how fast the heading turns while cruising
    float shyness = 1;     // scales the distance at which a fast hand frightens it; 0 to 3
    int points = 10;       // for a catch
    Company company = Company::Alone;
    float spacing = 1.2f;   // distance to companions, body lengths, centre to centre
    float stride = 0.65f;   // body lengths that it swims in one beat of the tail
    bool coasts = false;    // beats its tail in bursts and glides between them
    float hold_s = 1;       // how long it must be held to count
    bool stings = false;    // stings a hand that closes on it, and cannot be held
    float curiosity = 0.5f; // 0 to 1: how readily it comes to look at a hand that rests
    Thing thing = Thing::None;
    float density_kgpm3 = 1100; // of a loose thing
    float drag = 0.5f;          // coefficient, on its mean projected area
};

inline bool isCatchable(const Species& kind) { return !kind.shark && !kind.giant && !kind.stings; }

inline bool isFish(const Species& kind) { return isCatchable(kind) && kind.thing == Thing::None; }

constexpr float kMaxSpeed_mps = 3; // top speed of a fish outside a hand, pushes included

using SpeciesTable = std::vector<Species>;

// Returns the index of the species with that name, -1 if there is none.
int findSpecies(const SpeciesTable&, std::string_view name);

// Errors name the file and, where they can, the line. Unknown keys are errors.
Result<SpeciesTable> loadSpecies(const Path& file);

// Fish of a species, or loose things.
struct School {
    int species = 0; // index into the species table; never the shark
    int count = 1;
    float radiusLow_m = 0.7f, radiusHigh_m = 3;     // distance from the vertical axis through the viewer
    float heightLow_m = -0.5f, heightHigh_m = 0.5f; // relative to the viewer's eyes
    int stars = 0;                                  // it comes to players who have as many
};

struct SharkPlan {
    int species = -1;      // -1: no shark in this dive
    float radius_m = 4.2f; // radius of its circles
    float height_m = -0.2f;
    std::vector<float> visits_s; // starts of its visits, seconds since the dive began, rising
    float visitLength_s = 10;    // length of a visit
    float prowlRadius_m = 1.7f;
};

// A giant (a whale) that passes once, straight from one place to another: metres, world frame.
struct EncounterPlan {
    int species = -1; // -1: none in this dive
    float at_s = 45;  // start, seconds since the dive began
    glm::vec3 from{0}, to{0};
};

// A stretch of a dive's video, in seconds from the video's start, and how enclosed it is.
struct VideoMark {
    float from_s = 0, to_s = 0;
    float amount = 1; // 0 open water to 1 a tunnel
};

// Kinds of a dive's goals; a goal's text follows from all but its level.
enum class GoalKind {
    Catch,     // `count` fish of a species, or of any
    Different, // `count` different species
    Score,     // `count` points
    NoLoss,    // `count` fish are caught and none lost to the shark, until the dive is over
    Combo,     // a combo of `count`
    Quick,     // `count` fish within some seconds
    First,     // the first catch is of a species
    EachHand,  // `count` fish with each hand
    Guests,    // fish come to feed on `count` mussels
    TurnShark, // a stone turns the shark away `count` times
    Meet,      // `count` species are touched
    Calm,      // `count` fish one after the other, and none frightened in between
};
constexpr std::array<const char*, 12> kGoalNames = {"catch",  "different",  "score", "no_loss",
                                                    "combo",  "quick",      "first", "each_hand",
                                                    "guests", "turn_shark", "meet",  "calm"};
constexpr int kLevels = 3;         // of goals
constexpr size_t kGoals = kLevels; // of one dive
constexpr int kMaxCombo = 5, kMaxQuick = 8;

struct Goal {
    GoalKind kind = GoalKind::Catch;
    int species = -1; // index into the species table, for Catch and First; -1: any
    int count = 1;
    float within_s = 20; // for Quick
    int level = 0;       // 1 easy to kLevels hard; 0: none
};

constexpr int kDeepest_cm = 300; // greatest depth of a floor below the world's origin

struct DiveFile {
    std::string name;  // stem of the file; its path if it lies outside content/
    std::string title; // as the menu shows it
    std::string video; // file below content/; may be missing (it is made by content/make)
    std::string music; // theme: content/sounds/music_THEME_*.flac; empty: none
    float duration_s = 90;
    // Diver's lamp: radiance of a white matte surface that faces it from a metre; the film's white is 1.
    float lamp = 0;
    float floor_m = -1.1f; // height of the floor, at least -kDeepest_cm; fish stay above it
    bool water = true;     // the video was filmed under water
    std::vector<School> schools;
    SharkPlan shark;
    EncounterPlan encounter;
    // All goals of a dive if they are at most kGoals; else a dive draws one of each level by its seed.
    std::vector<Goal> goals;
    std::vector<VideoMark> enclosure; // how enclosed stretches of the video are
    // Length of the video, which starts with the dive and repeats; 0: no video, or not the dive's own. The
    // file does not hold it: the code that opens the video sets it.
    double videoLength_s = 0;
    // Distances to the surfaces in the video, not in the file either; null: unknown, all is open water.
    std::shared_ptr<const FilmSpace> space;
};

// A dive and the species that swim in it; constant while it is played.
struct DiveFiles {
    SpeciesTable species;
    DiveFile dive;
};

// Returns for each species, by index into the table, whether the dive shows it.
std::vector<bool> speciesShown(const SpeciesTable&, const DiveFile&);

Result<DiveFile> loadDive(const Path& file, const SpeciesTable&);

// Returns the names of the dives below content, sorted.
std::vector<std::string> diveNames(const Path& content = dataRoot() / "content");

// Loads a dive: by name, from dives/NAME.toml and species.toml below content; or by path, from NAME.toml and
// the species.toml beside it.
Result<DiveFiles> loadDiveFiles(const std::string& dive, const Path& content = dataRoot() / "content");

// Help for a hand that reaches for a fish (game/rules/Intent.h). None: it takes hold only of a fish that its
// fingers really close around.
enum class Assist { None, Normal, Strong };

// The player's choice of rules before a dive. A replay's header holds it: with the same rules, seed and
// inputs a dive goes the same way. The defaults are those of the settings.
struct DiveRules {
    Assist assist = Assist::Normal;
    bool freeSwim = false; // no clock, no shark, no goals
    // The player sits: no fish circles where only a step or bent knees would reach it.
    bool seated = false;
    int stars = 0; // that the player has; rarer animals come for them
    // The player sees their own room, whose floor is so far below the world's origin; it takes the place of
    // all that the film shows. 0: the film is seen, or the floor is not known.
    int roomFloor_cm = 0;

    bool operator==(const DiveRules&) const = default;
};

} // namespace shoal::game

template <> inline constexpr std::array shoal::kEnumNames<shoal::game::Assist> = {"none", "normal", "strong"};
