// Writes the measurements as tables and pictures.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"
#include "tests/bench/compose/Distance.h"

#include <glm/vec2.hpp>

#include <map>

namespace shoal::bench {

// Rows of `filmed` (the truth) and of `filmed again` (the same with other noise, coded anew: no way can be
// expected to come nearer) stand beside those of the ways.
inline constexpr const char* kFilmed = "filmed";
inline constexpr const char* kFilmedAgain = "filmed again";
inline constexpr const char* kBackgroundAlone = "background alone"; // times only

// Times of one frame.
struct Cost {
    double wall_ms = 0;
    double processor_ms = 0; // of all cores; on a graphics card, only what the driver takes
};

class Report {
  public:
    // look: where the picture is worth a closer look, in pixels.
    void add(int scene, const std::string& way, const ImageRgba8& shown, const Distance& distance,
             glm::ivec2 look);
    void addTime(const std::string& way, const Cost& cost);

    // Writes compose.tsv and compose.md, a line a way over all scenes, and sheet.png, a row a scene and a
    // column a way at 400 %.
    Status write(const Path& folder) const;

  private:
    struct Shown {
        int scene;
        std::string way;
        ImageRgba8 picture;
        Distance distance;
        glm::ivec2 look;
    };
    struct Row {
        std::string way;
        Cost cost, overPlain; // medians; more than plain in the same round
        Distance distance;    // root mean squares over the scenes; detail: the mean
        double beyond = 0;    // luma's, where what filming again differs by is taken away
    };
    std::vector<Row> rows() const;
    Status writeSheet(const Path& file) const;

    std::vector<Shown> shown_;
    std::map<std::string, std::vector<Cost>> costs_;
};

} // namespace shoal::bench
