#include "tests/bench/compose/Report.h"

#include "engine/media/Pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace shoal::bench {

namespace {

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[static_cast<size_t>(share * static_cast<double>(values.size() - 1))];
}

std::vector<std::string> waysOf(const auto& shown) {
    std::vector<std::string> ways;
    for (const auto& each : shown)
        if (std::ranges::find(ways, each.way) == ways.end()) ways.push_back(each.way);
    return ways;
}

} // namespace

void Report::add(int scene, const std::string& way, const ImageRgba8& shown, const Distance& distance) {
    shown_.push_back({scene, way, shown, distance});
}

void Report::addTime(const std::string& way, double frame_ms) { times_ms_[way].push_back(frame_ms); }

Status Report::write(const Path& folder) const {
    const auto median = [&](const std::string& way) {
        const auto found = times_ms_.find(way);
        return found == times_ms_.end() ? 0.0 : quantile(found->second, 0.5);
    };
    std::string tsv = "way\tframe_ms\trelative\trms\tedge_rms\tspectrum_db\tdetail_db\tnoise\n";
    std::string md =
        "| way | a frame, ms | of plain | distance to filmed, of 255 | at outlines | spectrum, dB | "
        "detail above the backdrop's, dB | noise, of 255 |\n|---|--:|--:|--:|--:|--:|--:|--:|\n";
    for (const std::string& way : waysOf(shown_)) {
        Distance mean;
        double count = 0, detail = 0;
        for (const Shown& each : shown_) {
            if (each.way != way) continue;
            mean.rms += each.distance.rms * each.distance.rms;
            mean.edgeRms += each.distance.edgeRms * each.distance.edgeRms;
            mean.spectrum_db += each.distance.spectrum_db * each.distance.spectrum_db;
            detail += each.distance.detail_db;
            mean.noise += each.distance.noise * each.distance.noise;
            ++count;
        }
        for (double* square : {&mean.rms, &mean.edgeRms, &mean.spectrum_db, &mean.noise})
            *square = std::sqrt(*square / count);
        detail /= count;
        const double ms = median(way);
        char line[256];
        std::snprintf(line, sizeof line, "%s\t%.3f\t%.4f\t%.3f\t%.3f\t%.3f\t%.3f\t%.3f\n", way.c_str(), ms,
                      ms / median("plain"), mean.rms, mean.edgeRms, mean.spectrum_db, detail, mean.noise);
        tsv += line;
        if (way == "filmed")
            std::snprintf(line, sizeof line, "| filmed | | | | | | %+.1f | %.2f |\n", detail, mean.noise);
        else
            std::snprintf(line, sizeof line, "| %s | %.2f | %.2f | %.2f | %.2f | %.2f | %+.1f | %.2f |\n",
                          way.c_str(), ms, ms / median("plain"), mean.rms, mean.edgeRms, mean.spectrum_db,
                          detail, mean.noise);
        md += line;
    }
    char line[128];
    std::snprintf(line, sizeof line, "| the backdrop alone | %.2f | %.2f | | | | | |\n",
                  median("backdrop alone"), median("backdrop alone") / median("plain"));
    md += line;
    std::string scenes = "scene\tway\trms\tedge_rms\tspectrum_db\tdetail_db\tnoise\n";
    for (const Shown& each : shown_) {
        const Distance& d = each.distance;
        char row[160];
        std::snprintf(row, sizeof row, "%d\t%s\t%.3f\t%.3f\t%.3f\t%.3f\t%.3f\n", each.scene, each.way.c_str(),
                      d.rms, d.edgeRms, d.spectrum_db, d.detail_db, d.noise);
        scenes += row;
        const std::string name = std::to_string(each.scene) + "_" + each.way + ".png";
        if (Status s = media::writePng(folder / name, each.picture); !s) return s;
    }
    if (Status s = writeFileWhole(folder / "scenes.tsv", scenes); !s) return s;
    if (Status s = writeFileWhole(folder / "compose.tsv", tsv); !s) return s;
    std::printf("%s", md.c_str());
    return writeFileWhole(folder / "compose.md", md);
}

} // namespace shoal::bench
