#include "tests/bench/Names.h"
#include "tests/bench/light/Measure.h"

#include <fmt/format.h>

// Data that chart.gp draws: points, their names placed without overlap, and the Pareto front.
namespace shoal::bench {

using light::baselines::Role;

namespace {

// The size of one panel's plot in a picture 900 pixels wide; chart.gp places it so.
constexpr double kPanelWidth = 790, kPanelHeight = 430;

struct Point {
    const Measured* method = nullptr;
    double cost_us = 0, error_percent = 0;
};

// Number of a colour and a shape in chart.gp, the same in both panels.
int styleOf(const std::string& family) {
    const std::pair<const char*, int> styles[] = {{"Shoal", 1},
                                                  {"brute force", 2},
                                                  {"per pixel, Phong rings", 2},
                                                  {"spherical harmonics", 3},
                                                  {"spherical harmonics, windowed", 4},
                                                  {"prefiltered, few fitted taps", 4},
                                                  {"ZH3", 5},
                                                  {"per pixel, importance sampling", 5},
                                                  {"spherical Gaussians", 6},
                                                  {"prefiltered, importance sampling", 6}};
    for (const auto& [name, style] : styles)
        if (family == name) return style;
    return 7;
}

// Returns the points that no other beats in both cost and error, by cost.
std::vector<glm::dvec2> frontOf(std::vector<Point> points) {
    std::sort(points.begin(), points.end(), [](auto& a, auto& b) { return a.cost_us < b.cost_us; });
    std::vector<glm::dvec2> front;
    for (const Point& each : points)
        if (front.empty() || each.error_percent < front.back().y)
            front.emplace_back(each.cost_us, each.error_percent);
    return front;
}

// The file that chart.gp reads for a panel: variables and data blocks, one for each family.
std::string panel(const char* name, std::vector<Point> points, double margin) {
    std::vector<double> costs, errors;
    for (const Point& each : points) costs.push_back(each.cost_us), errors.push_back(each.error_percent);
    const Axis x = axisAround(costs, kPanelWidth, margin), y = axisAround(errors, kPanelHeight, margin);
    std::vector<Name> placed;
    for (const Point& each : points)
        placed.push_back(
            {each.method->label.brief, {x.toPixel(each.cost_us), y.toPixel(each.error_percent)}});
    auto front = frontOf(points);
    front.insert(front.begin(), {front[0].x, y.maximum});
    front.emplace_back(x.maximum, front.back().y);
    std::vector<Box> lines; // a step goes right first, then down
    for (size_t i = 1; i < front.size(); ++i) {
        const glm::dvec2 from(x.toPixel(front[i - 1].x), y.toPixel(front[i - 1].y));
        const glm::dvec2 to(x.toPixel(front[i].x), y.toPixel(front[i].y));
        lines.push_back({{(from.x + to.x) / 2, from.y}, {(to.x - from.x) / 2 + 1, 1.5}});
        lines.push_back({{to.x, (from.y + to.y) / 2}, {1.5, (from.y - to.y) / 2 + 1}});
    }
    placeNames(placed, lines, {kPanelWidth, kPanelHeight}, 6.6);

    std::vector<std::string> families;
    for (const Point& each : points)
        if (std::find(families.begin(), families.end(), each.method->label.family) == families.end())
            families.push_back(each.method->label.family);

    std::string out, names, styles;
    out += fmt::format("{}_left = {:g}; {}_right = {:g}; {}_low = {:g}; {}_high = {:g}\n", name, x.minimum,
                       name, x.maximum, name, y.minimum, name, y.maximum);
    const auto block = [&](const std::string& title, auto&& include) {
        out += fmt::format("${}_{} << END\n", name, title);
        for (size_t i = 0; i < points.size(); ++i)
            if (include(i))
                out += fmt::format("{:.8g} {:.8g} {:.8g} {:.8g} \"{}\"\n", points[i].cost_us,
                                   points[i].error_percent, x.fromPixel(placed[i].box.centre.x),
                                   y.fromPixel(placed[i].box.centre.y), placed[i].text);
        out += "END\n";
    };
    for (size_t i = 0; i < families.size(); ++i) {
        block("family" + std::to_string(i + 1),
              [&](size_t k) { return points[k].method->label.family == families[i]; });
        names += fmt::format("\"{}\" ", families[i]);
        styles += fmt::format("{} ", styleOf(families[i]));
    }
    out += fmt::format("{}_families = '{}'; {}_styles = '{}'\n", name, names, name, styles);
    block("all", [](size_t) { return true; });
    block("thesis", [&](size_t i) { return points[i].method->label.role == Role::Thesis; });
    out += fmt::format("{}_led_count = {}\n", name, std::ranges::count_if(placed, &Name::apart));
    block("led", [&](size_t i) { return placed[i].apart(); });
    out += fmt::format("${}_front << END\n", name);
    for (const glm::dvec2& each : front) out += fmt::format("{:.8g} {:.8g}\n", each.x, each.y);
    out += "END\n";
    return out;
}

// Returns for tonemaps.gp: milliseconds, medians of the diffuse error over HDRs and film in percent, name.
// Bounds have no time.
std::string toneMapPoints(const Chart& chart) {
    std::string out;
    for (const Measured& each : chart.toneMaps)
        out += fmt::format("{:.3f} {:.2f} {:.2f} \"{}\"\n", each.cost.update_us / 1e3,
                           100 * medianOfToneMap(chart, each, ToneMapped::Clipped, 0),
                           100 * medianOfToneMap(chart, each, ToneMapped::Film, 0), each.label.name);
    return out;
}

} // namespace

Status writePicture(const Chart& chart, const Path& folder) {
    std::vector<Point> diffuse, glossy, suns;
    for (const Measured& each : chart.diffuse) // all read the pyramid
        diffuse.push_back({&each, std::max(each.cost.update_us - chart.pyramid_us, 1.0),
                           100 * pooled(chart, each, Suns::With, 0, 1).rms()});
    for (const Measured& each : chart.glossy) {
        const auto error = [&](Suns which) {
            return 100 * pooled(chart, each, which, 0, kGlossyLobes).rms();
        };
        glossy.push_back({&each, each.cost.frame_us(kGlossyPixels), error(Suns::Without)});
        suns.push_back({&each, each.cost.frame_us(kGlossyPixels), error(Suns::Only)});
    }
    if (Status s = writeFileWhole(folder / "tonemaps.dat", toneMapPoints(chart)); !s) return s;
    return writeFileWhole(
        folder / "chart.data.gp",
        fmt::format("read_us = {:g}; pyramid_us = {:g}\n", chart.read_us, chart.pyramid_us) +
            panel("diffuse", diffuse, 1.25) + panel("glossy", glossy, 1.4) + panel("suns", suns, 1.4));
}

} // namespace shoal::bench
