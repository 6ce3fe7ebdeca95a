#include "engine/light/GlossyPrefilter.h"

#include "engine/light/LobeCells.h"
#include "engine/light/Vectorise.h"

#include <algorithm>
#include <cassert>

namespace shoal::light {

namespace {

constexpr int kTurns = LobeCells::kCoarsestWidth; // columns that share a rule
constexpr int kRun = kTurns * 3;                  // their floats

// Rows of a level and all narrower ones lie before a wider level's.
size_t wovenBegin(int width) {
    size_t before = 0;
    for (int w = kTurns; w < width; w *= 2) before += static_cast<size_t>(w) * (w / 2);
    return before * 6; // three channels, twice
}

template <class Entry>
inline void sumRule(const Entry* entries, uint32_t count, const float* __restrict woven,
                    float* __restrict out) {
    float sum[kRun] = {};
    for (uint32_t k = 0; k < count; ++k) {
        const float* from = woven + entries[k].at;
        const float weight = entries[k].weight;
        for (int i = 0; i < kRun; ++i) sum[i] += weight * from[i];
    }
    for (int i = 0; i < kRun; ++i) out[i] = sum[i];
}

// One row: `phases` rules, each giving every phases-th texel.
template <class Entry>
SHOAL_VECTORISE void sumRow(const Entry* entries, const uint32_t* begins, int phases, const float* woven,
                            float* row) {
    for (int p = 0; p < phases; ++p) {
        float sums[kRun];
        sumRule(entries + begins[p], begins[p + 1] - begins[p], woven, sums);
        for (int turn = 0; turn < kTurns; ++turn)
            for (int c = 0; c < 3; ++c) row[(turn * phases + p) * 3 + c] = sums[turn * 3 + c];
    }
}

SHOAL_VECTORISE
void weaveRow(const float* __restrict row, int strands, float* __restrict out) {
    for (int q = 0; q < strands; ++q)
        for (int turn = 0; turn < kTurns; ++turn)
            for (int c = 0; c < 3; ++c) {
                const float value = row[(turn * strands + q) * 3 + c];
                out[q * 2 * kRun + turn * 3 + c] = value;
                out[q * 2 * kRun + kRun + turn * 3 + c] = value;
            }
}

} // namespace

GlossyPrefilter::GlossyPrefilter(std::vector<GlossyPlan> plans, Rules rules)
    : plans_(std::move(plans)), rules_(plans_.size()) {
    for (const GlossyPlan& plan : plans_) wovenWidth_ = std::max(wovenWidth_, plan.finestWidth);
    assert(wovenWidth_ >= kTurns);
    woven_.resize(wovenBegin(wovenWidth_ * 2));
    if (rules == Rules::MakeEachTime) return;
    std::vector<LobeCell> cells;
    for (size_t k = 1; k < plans_.size(); ++k) {
        const GlossyPlan& plan = plans_[k];
        LobeCells lobe(plan.width, plan.roughness, plan.cells, plan.finestWidth);
        LevelRules& level = rules_[k];
        level.begins.push_back(0);
        for (int row = 0; row < plan.width / 2; ++row)
            for (int phase = 0; phase < plan.width / kTurns; ++phase) {
                lobe.choose(row, phase, cells);
                appendRule(cells, level.entries);
                level.begins.push_back(static_cast<uint32_t>(level.entries.size()));
            }
        level.entries.shrink_to_fit();
    }
}

size_t GlossyPrefilter::wovenAt(int width, int row, int column) const {
    const int strands = width / kTurns;
    const size_t strand = static_cast<size_t>(row) * strands + column % strands;
    return wovenBegin(width) + strand * 2 * kRun + static_cast<size_t>(column / strands) * 3;
}

void GlossyPrefilter::appendRule(const std::vector<LobeCell>& cells, std::vector<Entry>& out) const {
    for (const LobeCell& cell : cells)
        out.push_back({static_cast<uint32_t>(wovenAt(cell.width, cell.row, cell.column)), cell.weight});
}

void GlossyPrefilter::weave(const RadiancePyramid& pyramid) {
    for (const ImageRgbF& level : pyramid.levels) {
        if (level.width > wovenWidth_ || level.width < kTurns) continue;
        for (int row = 0; row < level.height; ++row)
            weaveRow(level.at(0, row), level.width / kTurns, woven_.data() + wovenAt(level.width, row, 0));
    }
}

void GlossyPrefilter::make(const RadiancePyramid& pyramid, std::vector<GlossyLevel>& out) {
    assert(pyramid.levels[0].width == plans_[0].width);
    weave(pyramid);
    out.resize(plans_.size());
    out[0].roughness = 0;
    out[0].radianceLin = ImageRgbF();
    std::vector<LobeCell> cells;
    LevelRules passing;
    for (size_t k = 1; k < plans_.size(); ++k) {
        const GlossyPlan& plan = plans_[k];
        const int phases = plan.width / kTurns;
        ImageRgbF& image = out[k].radianceLin;
        out[k].roughness = plan.roughness;
        if (image.width != plan.width || image.height != plan.width / 2)
            image = ImageRgbF(plan.width, plan.width / 2);
        const LevelRules& level = rules_[k];
        if (!level.begins.empty()) {
            for (int row = 0; row < image.height; ++row)
                sumRow(level.entries.data(), level.begins.data() + static_cast<size_t>(row) * phases, phases,
                       woven_.data(), image.at(0, row));
            continue;
        }
        LobeCells lobe(plan.width, plan.roughness, plan.cells, plan.finestWidth);
        for (int row = 0; row < image.height; ++row) {
            passing.begins.assign(1, 0);
            passing.entries.clear();
            for (int phase = 0; phase < phases; ++phase) {
                lobe.choose(row, phase, cells);
                appendRule(cells, passing.entries);
                passing.begins.push_back(static_cast<uint32_t>(passing.entries.size()));
            }
            sumRow(passing.entries.data(), passing.begins.data(), phases, woven_.data(), image.at(0, row));
        }
    }
}

} // namespace shoal::light
