#include "engine/light/LobeCells.h"

#include "engine/math/Brdf.h"
#include "engine/math/LatLong.h"

#include <algorithm>
#include <cassert>

namespace shoal::light {

namespace {

using std::numbers::pi;

double latitudeOf(double row, int height) { return pi * (0.5 - row / height); }

} // namespace

LobeCells::LobeCells(int outWidth, double roughness, int cells, int finestWidth)
    : outWidth_(outWidth), maxWidth_(std::max(outWidth, finestWidth)),
      alpha_(math::alphaFromRoughness(roughness)), cells_(static_cast<size_t>(cells)) {
    assert(roughness > 0 && cells >= 1 && finestWidth >= kCoarsestWidth);
    const auto at = [](double latitude) { return Latitude{std::sin(latitude), std::cos(latitude)}; };
    for (int width = kCoarsestWidth; width <= finestWidth; width *= 2) {
        const int height = width / 2;
        std::vector<Row> rows(static_cast<size_t>(height));
        for (int y = 0; y < height; ++y) {
            Row& row = rows[static_cast<size_t>(y)];
            row.centre = at(latitudeOf(y + 0.5, height));
            row.solidAngle = texelSolidAngle(y, width, height);
            for (int edge = y; edge <= y + 1; ++edge) {
                const Latitude corner = at(latitudeOf(edge, height));
                const double cosine =
                    row.centre.sine * corner.sine + row.centre.ring * corner.ring * std::cos(pi / width);
                row.radius = std::max(row.radius, std::acos(std::clamp(cosine, -1.0, 1.0)));
            }
            for (int s = 0; s < kFine; ++s) {
                row.fine[s] = at(latitudeOf(y + (s + 0.5) / kFine, height));
                row.fineSolidAngle[s] = texelSolidAngle(y * kFine + s, width * kFine, height * kFine);
            }
        }
        levels_.push_back(std::move(rows));
    }
    cosines_.resize(static_cast<size_t>(maxWidth_) * 2 * kFine);
    for (size_t i = 0; i < cosines_.size(); ++i)
        cosines_[i] = std::cos(2 * pi * static_cast<double>(i) / static_cast<double>(cosines_.size()));
}

double LobeCells::lobe(double cosine) const { return math::ggxMirrorLobe(cosine, alpha_); }

// A cell's error is at most its solid angle times the lobe's rise over it; the light's own rise, unknown
// here, goes with the cell's size.
void LobeCells::push(int level, int row, int column) {
    const Row& r = levels_[static_cast<size_t>(level)][static_cast<size_t>(row)];
    const int width = kCoarsestWidth << level;
    const int64_t turn = int64_t{kFine} * (maxWidth_ / width) * (2 * column + 1) - axisTurn_;
    const double cosine = axis_.sine * r.centre.sine + axis_.ring * r.centre.ring * cosineOfTurn(turn);
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
    const double peak = lobe(std::cos(std::max(0.0, angle - r.radius)));
    if (peak <= 0) return; // behind
    const double least = lobe(std::cos(std::min(pi, angle + r.radius)));
    nodes_.push_back({r.solidAngle * (peak - least) * r.radius, level, row, column});
}

double LobeCells::integral(const Node& node) const {
    const Row& r = levels_[static_cast<size_t>(node.level)][static_cast<size_t>(node.row)];
    const int width = kCoarsestWidth << node.level;
    double cosines[kFine];
    for (int s = 0; s < kFine; ++s)
        cosines[s] =
            cosineOfTurn(int64_t{maxWidth_ / width} * (2 * (node.column * kFine + s) + 1) - axisTurn_);
    double sum = 0;
    for (int t = 0; t < kFine; ++t)
        for (const double cosine : cosines)
            sum += r.fineSolidAngle[t] *
                   lobe(axis_.sine * r.fine[t].sine + axis_.ring * r.fine[t].ring * cosine);
    return sum;
}

void LobeCells::choose(int row, int column, std::vector<LobeCell>& out) {
    const double latitude = latitudeOf(row + 0.5, outWidth_ / 2);
    axis_ = {std::sin(latitude), std::cos(latitude)};
    axisTurn_ = int64_t{kFine} * (maxWidth_ / outWidth_) * (2 * column + 1);
    const auto smaller = [](const Node& a, const Node& b) { return a.error < b.error; };

    nodes_.clear();
    for (int y = 0; y < kCoarsestWidth / 2; ++y)
        for (int x = 0; x < kCoarsestWidth; ++x) push(0, y, x);
    std::make_heap(nodes_.begin(), nodes_.end(), smaller);
    while (nodes_.size() + 3 <= cells_ && nodes_.front().error > 0) {
        std::pop_heap(nodes_.begin(), nodes_.end(), smaller);
        Node worst = nodes_.back();
        nodes_.pop_back();
        if (worst.level + 1 == static_cast<int>(levels_.size())) {
            worst.error = 0; // as fine as it gets
            nodes_.push_back(worst);
            std::push_heap(nodes_.begin(), nodes_.end(), smaller);
            continue;
        }
        for (int child = 0; child < 4; ++child) {
            const size_t before = nodes_.size();
            push(worst.level + 1, worst.row * 2 + child / 2, worst.column * 2 + child % 2);
            if (nodes_.size() > before) std::push_heap(nodes_.begin(), nodes_.end(), smaller);
        }
    }

    double total = 0;
    for (Node& node : nodes_) {
        node.error = integral(node); // its place in the heap is no longer needed
        total += node.error;
    }
    const double negligible = total * 1e-6;
    double kept = 0;
    for (const Node& node : nodes_)
        if (node.error > negligible) kept += node.error;
    out.clear();
    for (const Node& node : nodes_)
        if (node.error > negligible)
            out.push_back(
                {kCoarsestWidth << node.level, node.row, node.column, static_cast<float>(node.error / kept)});
}

} // namespace shoal::light
