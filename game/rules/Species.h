// What kinds of creatures there are: content/species.toml.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace shoal::game {

// How much kin mean to a fish: nothing, one partner, or all of its school.
enum class Company { Alone, Pair, Shoal };
constexpr std::array<const char*, 3> kCompanyNames = {"alone", "pair", "shoal"};

struct Species {
    std::string name;           // "clownfish"
    std::string model;          // file below content/
    bool shark = false;         // hunts instead of being caught
    float length_m = 0.2f;      // nose to tail
    float bodyRadius_m = 0.03f; // of the capsule along the body's Z
    float bodyHalf_m = 0.05f;   // half its core segment
    float cruise_mps = 0.3f;
    float dart_mps = 1.6f; // at most kMaxSpeed_mps
    float turn_radps = 2;  // how fast the heading turns while cruising
    float shyness = 1;     // scales the distance at which a fast hand frightens it; 0 to 3
    int points = 10;       // a catch
    Company company = Company::Alone;
    float spacing = 1.2f; // to the companions around it, body lengths, centre to centre
    float stride = 0.65f; // body lengths it swims in one beat of the tail
    bool coasts = false;  // beats in bursts and glides between them
};

constexpr float kMaxSpeed_mps = 3; // of any fish that is not in a hand, however it is pushed

using SpeciesTable = std::vector<Species>;

// Index of the name, -1 if there is none.
int findSpecies(const SpeciesTable&, std::string_view name);

// Errors name the file and, where they can, the line. Unknown keys are errors.
Result<SpeciesTable> loadSpecies(const Path& file);

} // namespace shoal::game
