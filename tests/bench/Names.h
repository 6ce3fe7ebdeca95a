// Places the names of a chart's points so that they do not overlap; the charts' gnuplot files draw them
// there.
#pragma once

#include "tests/bench/Bench.h"

namespace shoal::bench {

// A logarithmic axis.
struct Axis {
    double minimum = 0, maximum = 0, pixels = 0;

    double toPixel(double value) const {
        return pixels * std::log(value / minimum) / std::log(maximum / minimum);
    }
    double fromPixel(double pixel) const { return minimum * std::pow(maximum / minimum, pixel / pixels); }
};

inline Axis axisAround(const std::vector<double>& values, double pixels, double margin) {
    const auto [minimum, maximum] = std::minmax_element(values.begin(), values.end());
    return {*minimum / margin, *maximum * margin, pixels};
}

struct Box {
    glm::dvec2 centre{0}, half{0};

    double overlap(const Box& other) const {
        const glm::dvec2 both = half + other.half - glm::abs(centre - other.centre);
        return both.x > 0 && both.y > 0 ? both.x * both.y : 0;
    }
    double distance(const glm::dvec2& point) const {
        return glm::length(glm::max(glm::abs(point - centre) - half, glm::dvec2(0)));
    }
};

struct Name {
    std::string text;
    glm::dvec2 at{0}; // its point: pixels within the panel, from its lower left
    Box box{};        // where the text is, when it was placed

    // A name that stands apart from its point gets a line.
    bool apart() const { return box.distance(at) > 16; }
};

// Places each name where it covers least, as near to its point as possible; the first has the choice.
inline void placeNames(std::vector<Name>& names, const std::vector<Box>& lines, const glm::dvec2& panel,
                       double letter) {
    constexpr double kLine = 13, kMark = 6; // pixels
    for (Name& name : names)
        name.box = {{-1e6, 0}, {letter / 2 * static_cast<double>(name.text.size()), kLine / 2}};
    for (int round = 0; round < 4; ++round)
        for (Name& name : names) {
            double minimum = 1e30;
            Box best = name.box;
            for (const double reach : {5.0, 14.0, 24.0, 36.0, 50.0, 70.0, 95.0})
                for (int step = 0; step < 32; ++step) {
                    const double turn = step * glm::radians(11.25);
                    const glm::dvec2 to(std::cos(turn), std::sin(turn));
                    const Box box{name.at + to * (reach + kMark) + to * name.box.half, name.box.half};
                    double cost = reach * 2;
                    for (const Name& other : names) {
                        if (&other != &name) cost += 10 * box.overlap(other.box);
                        cost += 10 * box.overlap({other.at, glm::dvec2(kMark)});
                        // A name nearer to another point would be taken for that point's name.
                        if (box.distance(other.at) < box.distance(name.at)) cost += 40;
                    }
                    for (const Box& line : lines) cost += 0.2 * box.overlap(line);
                    const glm::dvec2 low = box.centre - box.half, high = box.centre + box.half;
                    if (low.x < 2 || low.y < 2 || high.x > panel.x - 2 || high.y > panel.y - 2) cost += 1e6;
                    if (cost < minimum) minimum = cost, best = box;
                }
            name.box = best;
        }
}

} // namespace shoal::bench
