// The player's files. Kept between games are settings, in $XDG_CONFIG_HOME/shoal/settings.json, which the
// command line overrides, scores, in scores.json of $XDG_DATA_HOME/shoal, and the field guide, in guide.json
// there. A file that cannot be used is left alone.
#pragma once

#include "engine/core/Files.h"
#include "game/settings/Setting.h"

#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace shoal::app {

// Sets the table's kept settings from the file. Values of the wrong type or out of range, and unknown names,
// are left in the file and named in one warning.
void loadSettings(const SettingsTable& table);

// Writes one setting; all else in the file stays. The file is replaced as a whole or not at all.
Status saveSetting(const Setting& setting);

struct DiveScores {
    static constexpr size_t kKept = 5;
    std::vector<int> top; // the best first, at most kKept
    int last = 0;         // score of the dive before; 0: none
    int stars = 0;        // most of one dive
    int allStars = 0;     // of all dives together
};

// Returns the scores by the dive's name; empty if there are none yet or, with a warning, no usable file.
std::map<std::string, DiveScores> readScores();

// Returns the stars of all dives together.
int starsIn(const std::map<std::string, DiveScores>& scores);

// Adds a score; the file is replaced as a whole or not at all, and keeps the other dives' scores.
Status addScore(const std::string& dive, int score, int stars);

// The field guide: the species that the player has touched, in the order in which they were met.
struct MetAnimal {
    std::string species; // its name in the table of species
    int caught = 0;      // in all dives
    float largest_m = 0; // length of the largest that was caught; 0: unknown
    std::string dive{};  // title of the dive in which it was met; empty: unknown, as the date
    std::string date{};  // year-month-day
    bool operator==(const MetAnimal&) const = default;
};
std::vector<MetAnimal> readGuide();
Status saveGuide(const std::vector<MetAnimal>& met);

// The player's own films and photos for the list on the screen, the newest first: the files in the folders
// for videos, pictures and downloads, without subfolders, that can be shown by their content
// (media::mediaKind()). A thread reads their beginnings, because one may take longer than a picture.
class FilmList {
  public:
    struct Found {
        std::vector<Path> files; // at most 60
        bool complete = false;   // all files have been looked at
    };
    void look(); // searches again; the last list stays until the new one is longer, or complete
    Found found() const;
    const std::vector<Path>& folders() const { return folders_; } // that look() looks in

  private:
    void read(const std::stop_token& ending);

    std::vector<Path> folders_; // does not change while the thread runs
    mutable std::mutex mutex_;  // guards found_
    Found found_;
    std::jthread thread_; // last: it uses all of the above
};

} // namespace shoal::app
