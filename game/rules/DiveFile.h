// One dive (a level): content/dives/NAME.toml.
#pragma once

#include "game/rules/Species.h"

#include <vector>

namespace shoal::game {

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

// What a dive marks in its video, by stretches in seconds from the video's start: how enclosed the place is,
// and where the ground is that shadows fall on.
struct VideoMark {
    float from_s = 0, to_s = 0;
    float value =
        1; // of enclosure, 0 open water to 1 a tunnel; or the ground's height against the viewer's eyes
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
    std::vector<VideoMark> enclosure; // of the video
    std::vector<VideoMark> ground;    // of the video; none: no shadow falls on it
    // Of the video, which starts with the dive and repeats. Not in the file: who opens the video tells; 0: no
    // video, or another.
    double videoLength_s = 0;
};

// A dive and the species that swim in it; constant while it is played.
struct DiveFiles {
    SpeciesTable species;
    DiveFile dive;
};

Result<DiveFile> loadDive(const Path& file, const SpeciesTable&);

// dive: a name, for dives/NAME.toml and species.toml below content (dataRoot()/content if empty); or the path
// of a dive file, NAME.toml, beside which lies its species.toml.
Result<DiveFiles> loadDiveFiles(const std::string& dive, const Path& content = {});

} // namespace shoal::game
