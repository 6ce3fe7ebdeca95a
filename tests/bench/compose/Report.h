// Writes the measurements as tables and pictures.
#pragma once

#include "tests/bench/compose/Distance.h"

namespace shoal::bench {

// Rows beside those of the ways: `filmed` is the truth, and `filmed again` the same with other noise, encoded
// anew; no way can be expected to come nearer than that.
inline constexpr const char* kFilmed = "filmed";
inline constexpr const char* kFilmedAgain = "filmed again";
inline constexpr const char* kBackgroundAlone = "background alone"; // times only

// Times of one frame.
struct Cost {
    double wall_ms = 0;
    double processor_ms = 0; // of all cores; on a graphics card, only what the driver takes
};

struct Shown {
    int scene;
    std::string way;
    ImageRgba8 picture;
    Distance distance;
    glm::ivec2 look; // centre of the detail for the sheet, pixels
};

struct Report {
    std::vector<Shown> shown;
    std::map<std::string, std::vector<Cost>> costs; // of each round, by way

    // Writes compose.tsv and compose.md, with a line for each way over all scenes, and sheet.png, with a row
    // for each scene and a column for each way at 400 %.
    Status write(const Path& folder) const;
};

} // namespace shoal::bench
