// What kinds of creatures there are, content/species.toml, and one dive (a level), content/dives/NAME.toml.
#pragma once

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

// How much kin mean to a fish: nothing, one partner, or all of its school.
enum class Company { Alone, Pair, Shoal };
constexpr std::array<const char*, 3> kCompanyNames = {"alone", "pair", "shoal"};

struct Species {
    std::string name;           // "clownfish"
    std::string model;          // file below content/
    bool shark = false;         // hunts instead of being caught
    bool giant = false;         // passes in an encounter instead of being caught
    float length_m = 0.2f;      // nose to tail
    float bodyRadius_m = 0.03f; // of the capsule along the body's Z
    float bodyHalf_m = 0.05f;   // half its core segment
    float cruise_mps = 0.3f;
    float dart_mps = 1.6f; // at most kMaxSpeed_mps
    float turn_radps = 2;  // how fast the heading turns while cruising
    float shyness = 1;     // scales the distance at which a fast hand frightens it; 0 to 3
    int points = 10;       // a catch
    Company company = Company::Alone;
    float spacing = 1.2f;   // to the companions around it, body lengths, centre to centre
    float stride = 0.65f;   // body lengths it swims in one beat of the tail
    bool coasts = false;    // beats in bursts and glides between them
    bool stings = false;    // the hand that closes on it; nobody holds it
    float curiosity = 0.5f; // 0 to 1: how readily it comes to look at a hand that rests
};

inline bool isCatchable(const Species& kind) { return !kind.shark && !kind.giant && !kind.stings; }

constexpr float kMaxSpeed_mps = 3; // of any fish that is not in a hand, however it is pushed

using SpeciesTable = std::vector<Species>;

// Index of the name, -1 if there is none.
int findSpecies(const SpeciesTable&, std::string_view name);

// Errors name the file and, where they can, the line. Unknown keys are errors.
Result<SpeciesTable> loadSpecies(const Path& file);

struct School {
    int species = 0; // index into the species table; never the shark
    int count = 1;
    float radiusLow_m = 0.7f, radiusHigh_m = 3;     // from the vertical axis through the viewer
    float heightLow_m = -0.5f, heightHigh_m = 0.5f; // against the viewer's eyes
};

struct SharkPlan {
    int species = -1;      // -1: no shark in this dive
    float radius_m = 4.2f; // of its circles
    float height_m = -0.2f;
    std::vector<float> visits_s; // when it comes close, seconds since the dive began, rising
    float visitLength_s = 10;    // how long it prowls around the player then
    float prowlRadius_m = 1.7f;
};

// What passes once, straight from one place to another (metres against the viewer's eyes, as the world
// frame).
struct EncounterPlan {
    int species = -1; // -1: none in this dive
    float at_s = 45;  // when it sets out, seconds since the dive began
    glm::vec3 from{0}, to{0};
};

// How enclosed a stretch of a dive's video is, in seconds from the video's start.
struct VideoMark {
    float from_s = 0, to_s = 0;
    float amount = 1; // 0 open water to 1 a tunnel
};

// What a player may try for in a dive; a goal's text follows from kind, species and count.
enum class GoalKind {
    Catch,     // `count` of a species, or of any
    Different, // `count` different species
    Score,     // `count` points
    NoLoss,    // something is caught and no fish lost to the shark, until the dive is over
    Combo,     // of `count`
};
constexpr std::array<const char*, 5> kGoalNames = {"catch", "different", "score", "no_loss", "combo"};
constexpr size_t kMaxGoals = 3;
constexpr int kMaxCombo = 5;

struct Goal {
    GoalKind kind = GoalKind::Catch;
    int species = -1; // of Catch: index into the species table; -1: any
    int count = 1;
};

struct DiveFile {
    std::string name;  // stem of the file; its path if it lies outside content/
    std::string title; // as shown
    std::string video; // file below content/; may be missing (it is made by content/make)
    float duration_s = 90;
    float exposure_ev = 0;
    float floor_m = -1.1f; // fish stay above
    bool water = true;     // the video was filmed under water
    std::vector<School> schools;
    SharkPlan shark;
    EncounterPlan encounter;
    std::vector<Goal> goals;          // at most kMaxGoals
    std::vector<VideoMark> enclosure; // of the video
    // Of the video, which starts with the dive and repeats. Not in the file: who opens the video tells; 0: no
    // video, or another.
    double videoLength_s = 0;
    // How far away what the video shows is. Not in the file either; null: nobody knows, all is open water.
    std::shared_ptr<const FilmSpace> space;
};

// A dive and the species that swim in it; constant while it is played.
struct DiveFiles {
    SpeciesTable species;
    DiveFile dive;
};

// By index into the species table: whether the dive shows any of it.
std::vector<bool> speciesShown(const SpeciesTable&, const DiveFile&);

Result<DiveFile> loadDive(const Path& file, const SpeciesTable&);

// Names of the dives below content (dataRoot()/content if empty), in the alphabet's order.
std::vector<std::string> diveNames(const Path& content = {});

// dive: a name, for dives/NAME.toml and species.toml below content (dataRoot()/content if empty); or the path
// of a dive file, NAME.toml, beside which lies its species.toml.
Result<DiveFiles> loadDiveFiles(const std::string& dive, const Path& content = {});

} // namespace shoal::game
