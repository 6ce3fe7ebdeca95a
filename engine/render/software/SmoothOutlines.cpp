#include "engine/render/software/SmoothOutlines.h"

#include "engine/core/Vectorise.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace shoal::render {

namespace {

constexpr int kStep = 64;     // least step of alpha, of 255, at an outline
constexpr int kFurthest = 24; // pixels within which a step's end is looked for
constexpr int kBlock = 64;    // pixels of a row that are compared together: compilers vectorise this

bool differ(uint32_t a, uint32_t b) {
    return std::abs(static_cast<int>(a >> 24) - static_cast<int>(b >> 24)) >= kStep;
}

// Returns the share of a pixel that its neighbour across the step covers. along, across: offsets of the next
// pixel along the step and of that neighbour; before, after: numbers of pixels along the step.
float shareOf(const uint32_t* pixel, ptrdiff_t along, ptrdiff_t across, int before, int after) {
    struct End {
        int away = kFurthest;
        bool bendsIn = false; // whether the step bends to the pixel's side
    };
    const auto endOf = [&](ptrdiff_t ahead, int pixels) {
        for (int away = 0; away < std::min(pixels, kFurthest); ++away) {
            const uint32_t* next = pixel + (away + 1) * ahead;
            const bool own = differ(next[0], pixel[0]), other = differ(next[across], pixel[across]);
            if (own || other) return End{away, own && !other};
        }
        return End{};
    };
    const End first = endOf(-along, before), last = endOf(along, after);
    const auto length = static_cast<float>(first.away + 1 + last.away);
    float share = 0;
    for (const End& end : {first, last}) {
        // The line begins half a pixel within the pixel's side, and leaves it in the step's middle.
        const auto from = static_cast<float>(end.away), to = std::min(from + 1, 0.5f * length);
        if (end.bendsIn && to > from) share += (to - from) * (0.5f - 0.5f * (from + to) / length);
    }
    return share;
}

uint32_t mixed(uint32_t own, const std::array<uint32_t, 4>& others, const std::array<float, 4>& shares) {
    float kept = 1;
    for (const float share : shares) kept -= share;
    uint32_t result = 0;
    for (int shift = 0; shift < 32; shift += 8) {
        const auto channel = [&](uint32_t pixel) { return static_cast<float>(pixel >> shift & 255); };
        float sum = kept * channel(own) + 0.5f;
        for (size_t k = 0; k < others.size(); ++k) sum += shares[k] * channel(others[k]);
        result |= static_cast<uint32_t>(std::clamp(sum, 0.0f, 255.0f)) << shift;
    }
    return result;
}

// Sets, for each of `count` pixels, whether a step lies on any of its sides; returns whether any has one.
SHOAL_VECTORISE bool findSteps(const uint32_t* pixels, ptrdiff_t row, int count, uint8_t* steps) {
    uint8_t any = 0;
    for (int x = 0; x < count; ++x) {
        const uint32_t* pixel = pixels + x;
        steps[x] = static_cast<uint8_t>(differ(*pixel, pixel[-1]) | differ(*pixel, pixel[1]) |
                                        differ(*pixel, pixel[-row]) | differ(*pixel, pixel[row]));
        any |= steps[x];
    }
    return any != 0;
}

uint32_t smoothed(const uint32_t* pixel, const glm::ivec2& at, const glm::ivec2& size) {
    const ptrdiff_t row = size.x;
    const glm::ivec2 after = size - 1 - at;
    const std::array<uint32_t, 4> beside{pixel[-1], pixel[1], pixel[-row], pixel[row]};
    std::array<float, 4> shares{};
    if (differ(*pixel, beside[0])) shares[0] = shareOf(pixel, row, -1, at.y, after.y);
    if (differ(*pixel, beside[1])) shares[1] = shareOf(pixel, row, 1, at.y, after.y);
    if (differ(*pixel, beside[2])) shares[2] = shareOf(pixel, 1, -row, at.x, after.x);
    if (differ(*pixel, beside[3])) shares[3] = shareOf(pixel, 1, row, at.x, after.x);
    return shares == std::array<float, 4>{} ? *pixel : mixed(*pixel, beside, shares);
}

} // namespace

void smoothOutlines(std::span<uint32_t> pixels, const glm::ivec2& size, ChangedPixels& changed,
                    const HoldsAnything& holdsAnything) {
    constexpr int kRows = 8; // of a part of the picture, which is kBlock pixels wide
    changed.clear();
    std::array<uint8_t, kBlock> steps;
    for (int low = 1; low + 1 < size.y; low += kRows)
        for (int begin = 1; begin + 1 < size.x; begin += kBlock) {
            const int high = std::min(low + kRows, size.y - 1), end = std::min(begin + kBlock, size.x - 1);
            if (!holdsAnything({begin - 1, low - 1}, {end + 1, high + 1})) continue;
            for (int y = low; y < high; ++y) {
                uint32_t* const line = pixels.data() + ptrdiff_t{y} * size.x;
                if (!findSteps(line + begin, size.x, end - begin, steps.data())) continue;
                for (int x = begin; x < end; ++x) {
                    if (!steps[static_cast<size_t>(x - begin)]) continue;
                    const uint32_t now = smoothed(line + x, {x, y}, size);
                    if (now != line[x]) changed.emplace_back(line + x, now);
                }
            }
        }
    for (const auto& [pixel, value] : changed) *pixel = value;
}

} // namespace shoal::render
