#include "tests/bench/compose/Report.h"
#include "engine/math/Quantile.h"
#include "engine/media/Pictures.h"

#include <fmt/format.h>

namespace shoal::bench {

namespace {

// Returns medians over rounds. less: costs to subtract in each round; may be empty.
Cost medians(const std::vector<Cost>& costs, const std::vector<Cost>& less) {
    std::vector<double> wall, processor;
    for (size_t i = 0; i < costs.size(); ++i) {
        const Cost away = less.empty() ? Cost() : less[i];
        wall.push_back(costs[i].wall_ms - away.wall_ms);
        processor.push_back(costs[i].processor_ms - away.processor_ms);
    }
    return {math::median(wall), math::median(processor)};
}

struct Row {
    std::string way;
    Cost cost, overPlain; // medians; overPlain: excess over the plain way in the same round
    Distance distance;    // root mean squares over the scenes; detail: the mean
    double beyond = 0;    // luma error beyond that of filming again
};

std::vector<Row> rowsOf(const Report& report) {
    std::vector<Row> rows;
    for (const Shown& each : report.shown)
        if (std::ranges::find(rows, each.way, &Row::way) == rows.end()) rows.push_back({each.way});
    double floor = 0;
    for (Row& row : rows) {
        double count = 0;
        for (const Shown& each : report.shown) {
            if (each.way != row.way) continue;
            const Distance& d = each.distance;
            row.distance.luma += d.luma * d.luma;
            row.distance.colour += d.colour * d.colour;
            row.distance.spectrum_db += d.spectrum_db * d.spectrum_db;
            row.distance.noise += d.noise * d.noise;
            row.distance.detail_db += d.detail_db;
            ++count;
        }
        Distance& d = row.distance;
        for (double* square : {&d.luma, &d.colour, &d.spectrum_db, &d.noise})
            *square = std::sqrt(*square / count);
        d.detail_db /= count;
        if (row.way == kFilmedAgain) floor = d.luma;
        const auto costs = report.costs.find(row.way), plain = report.costs.find("plain");
        if (costs == report.costs.end() || plain == report.costs.end()) continue;
        row.cost = medians(costs->second, {});
        row.overPlain = medians(costs->second, plain->second);
    }
    for (Row& row : rows)
        row.beyond = std::sqrt(std::max(row.distance.luma * row.distance.luma - floor * floor, 0.0));
    return rows;
}

Status writeSheet(const Report& report, const Path& file) {
    constexpr int kTimes = 4;
    constexpr glm::ivec2 kCrop(78, 64);
    std::vector<std::string> ways;
    std::vector<int> scenes;
    for (const Shown& each : report.shown) {
        if (each.way != kFilmedAgain && std::ranges::find(ways, each.way) == ways.end())
            ways.push_back(each.way);
        if (std::ranges::find(scenes, each.scene) == scenes.end()) scenes.push_back(each.scene);
    }
    const glm::ivec2 cell = kCrop * kTimes + 4;
    ImageRgb8 sheet(cell.x * static_cast<int>(ways.size()), cell.y * static_cast<int>(scenes.size()));
    std::ranges::fill(sheet.pixels, uint8_t{255});
    for (const Shown& each : report.shown) {
        const auto way = std::ranges::find(ways, each.way);
        if (way == ways.end()) continue;
        const glm::ivec2 to(cell.x * static_cast<int>(way - ways.begin()),
                            cell.y *
                                static_cast<int>(std::ranges::find(scenes, each.scene) - scenes.begin()));
        const glm::ivec2 size(each.picture.width, each.picture.height);
        const glm::ivec2 from = glm::clamp(each.look - kCrop / 2, glm::ivec2(0), size - kCrop);
        for (int y = 0; y < kCrop.y * kTimes; ++y)
            for (int x = 0; x < kCrop.x * kTimes; ++x)
                std::copy_n(each.picture.at(from.x + x / kTimes, from.y + y / kTimes), 3,
                            sheet.at(to.x + x, to.y + y));
    }
    return media::writePng(file, sheet);
}

} // namespace

Status Report::write(const Path& folder) const {
    const std::vector<Row> all = rowsOf(*this);
    const Row& plain = *std::ranges::find(all, "plain", &Row::way);
    std::string tsv = "way\twall_ms\tprocessor_ms\tof_plain\tprocessor_of_plain\tluma\tcolour\tbeyond\t"
                      "spectrum_db\tdetail_db\tnoise\n";
    std::string md =
        "# Objects beside the same objects filmed\n\nMade by tests/bench/compose_chart; what each figure "
        "means stands in tests/bench/compose/Distance.h.\n\n| way | a frame, ms | more than plain, ms | "
        "processor ms | more than plain | distance of luma, of 255 | of colour | of luma, beyond filming "
        "again | of spectra, dB | finer than around, dB | noise, of 255 |\n"
        "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
    const Row* best = nullptr;
    for (const Row& row : all) {
        const Distance& d = row.distance;
        tsv += fmt::format(
            "{}\t{:.3f}\t{:.3f}\t{:.4f}\t{:.4f}\t{:.3f}\t{:.3f}\t{:.3f}\t{:.3f}\t{:.3f}\t{:.3f}\n", row.way,
            row.cost.wall_ms, row.cost.processor_ms, 1 + row.overPlain.wall_ms / plain.cost.wall_ms,
            1 + row.overPlain.processor_ms / plain.cost.processor_ms, d.luma, d.colour, row.beyond,
            d.spectrum_db, d.detail_db, d.noise);
        const bool way = row.cost.wall_ms > 0;
        md += "| " + row.way;
        md += way ? fmt::format(" | {:.2f} | {:+.2f} | {:.2f} | {:+.2f}", row.cost.wall_ms,
                                row.overPlain.wall_ms, row.cost.processor_ms, row.overPlain.processor_ms)
                  : " | | | | ";
        md += fmt::format(" | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:+.1f} | {:.2f} |\n", d.luma, d.colour,
                          row.beyond, d.spectrum_db, d.detail_db, d.noise);
        const bool halves = row.beyond <= plain.beyond / 2 && d.spectrum_db <= plain.distance.spectrum_db / 2;
        if (way && halves && (!best || row.overPlain.wall_ms < best->overPlain.wall_ms)) best = &row;
    }
    if (const auto alone = costs.find(kBackgroundAlone); alone != costs.end()) {
        const Cost cost = medians(alone->second, {});
        md += fmt::format("\nThe background alone: {:.2f} ms, of the processor {:.2f} ms.\n", cost.wall_ms,
                          cost.processor_ms);
    }
    md += best ? "\nThe cheapest that halves both distances (of luma beyond filming again, of spectra): " +
                     best->way + ".\n"
               : std::string("\nNo way halves both distances (of luma beyond filming again, of spectra).\n");
    if (Status s = writeSheet(*this, folder / "sheet.png"); !s) return s;
    if (Status s = writeFileWhole(folder / "compose.tsv", tsv); !s) return s;
    std::printf("%s", md.c_str());
    return writeFileWhole(folder / "compose.md", md);
}

} // namespace shoal::bench
