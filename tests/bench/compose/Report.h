// What was measured, as tables and pictures.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"
#include "tests/bench/compose/Distance.h"

#include <map>

namespace shoal::bench {

class Report {
  public:
    void add(int scene, const std::string& way, const ImageRgba8& shown, const Distance& distance);
    void addTime(const std::string& way, double frame_ms);

    // compose.tsv, a line a way: milliseconds above the backdrop alone relative to plain's, medians and
    // quartiles; distances over all scenes. compose.md. Pictures NUMBER_way.png, and sheet.png: the ways
    // beside each other at 400 %.
    Status write(const Path& folder) const;

  private:
    struct Shown {
        int scene;
        std::string way;
        ImageRgba8 picture;
        Distance distance;
    };
    std::vector<Shown> shown_;
    std::map<std::string, std::vector<double>> times_ms_;
};

} // namespace shoal::bench
