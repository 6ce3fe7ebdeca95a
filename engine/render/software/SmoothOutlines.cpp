#include "engine/render/software/SmoothOutlines.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>

namespace shoal::render {

namespace {

constexpr int kStep = 64;     // least step of alpha, of 255, at an outline
constexpr int kFurthest = 24; // pixels within which a step's end is looked for

int alphaOf(uint32_t pixel) { return static_cast<int>(pixel >> 24); }
bool differ(uint32_t a, uint32_t b) { return std::abs(alphaOf(a) - alphaOf(b)) >= kStep; }

// An end of a step between two lines of pixels.
struct End {
    int away = 0;         // pixels from the one looked at to that end
    bool bendsIn = false; // whether it bends to that pixel's side
};

// ahead: to the next pixel along the step; across: to the neighbour on its other side.
std::optional<End> endOf(const uint32_t* pixel, ptrdiff_t ahead, ptrdiff_t across, int furthest) {
    const uint32_t here = pixel[0], there = pixel[across];
    for (int away = 0; away < furthest; ++away) {
        pixel += ahead;
        const bool own = differ(pixel[0], here), other = differ(pixel[across], there);
        if (own || other) return End{away, own && !other};
    }
    return {};
}

// Returns the share of a pixel beyond the line that begins half a pixel within it at one end of a step of
// `length` pixels and leaves it in the step's middle. before: pixels between that end and this one.
float shareBeyond(int before, int length) {
    const auto from = static_cast<float>(before), whole = static_cast<float>(length);
    const float to = std::min(from + 1, 0.5f * whole);
    return to > from ? (to - from) * (0.5f - 0.5f * (from + to) / whole) : 0;
}

// Returns how much of the pixel its neighbour across covers. back, on: pixels that there are along the step.
float shareOf(const uint32_t* pixel, ptrdiff_t along, ptrdiff_t across, int back, int on) {
    const auto first = endOf(pixel, -along, across, std::min(back, kFurthest)),
               last = endOf(pixel, along, across, std::min(on, kFurthest));
    if (!first && !last) return 0;
    const int length = (first ? first->away : kFurthest) + 1 + (last ? last->away : kFurthest);
    float share = 0;
    if (first && first->bendsIn) share += shareBeyond(first->away, length);
    if (last && last->bendsIn) share += shareBeyond(last->away, length);
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

constexpr int kBlock = Coverage::kBlock; // pixels of a row that are compared together

// Returns a nonzero highest byte where the alpha of a pixel differs from those beside it.
uint32_t differenceBeside(const uint32_t* pixel, ptrdiff_t row) {
    return (pixel[-1] ^ *pixel) | (pixel[1] ^ *pixel) | (pixel[-row] ^ *pixel) | (pixel[row] ^ *pixel);
}

// Returns whether a block of pixels and those beside them all have one alpha.
bool isEven(const uint32_t* block, ptrdiff_t row) {
    uint32_t difference = 0;
    for (int x = 0; x < kBlock; ++x) difference |= differenceBeside(block + x, row);
    return difference >> 24 == 0;
}

} // namespace

void OutlineSmoother::smoothBlock(std::span<const uint32_t> pixels, const glm::ivec2& size,
                                  const glm::ivec2& low, const glm::ivec2& high) {
    const ptrdiff_t row = size.x;
    for (int y = low.y; y < high.y; ++y) {
        if (high.x - low.x == kBlock && isEven(pixels.data() + y * row + low.x, row)) continue;
        for (int x = low.x; x < high.x; ++x) {
            const uint32_t* pixel = pixels.data() + y * row + x;
            if (differenceBeside(pixel, row) >> 24 == 0) continue;
            const std::array<uint32_t, 4> beside{pixel[-1], pixel[1], pixel[-row], pixel[row]};
            std::array<float, 4> shares{};
            const auto look = [&](size_t k, ptrdiff_t along, ptrdiff_t across, int back, int on) {
                if (differ(*pixel, beside[k])) shares[k] = shareOf(pixel, along, across, back, on);
            };
            look(0, row, -1, y, size.y - 1 - y);
            look(1, row, 1, y, size.y - 1 - y);
            look(2, 1, -row, x, size.x - 1 - x);
            look(3, 1, row, x, size.x - 1 - x);
            if (shares == std::array<float, 4>{}) continue;
            const uint32_t now = mixed(*pixel, beside, shares);
            if (now != *pixel) changed_.emplace_back(pixel - pixels.data(), now);
        }
    }
}

void OutlineSmoother::smooth(std::span<uint32_t> pixels, const glm::ivec2& size, const Coverage& coverage) {
    changed_.clear();
    for (int y = 0; y < coverage.blocks().y; ++y)
        for (int x = 0; x < coverage.blocks().x; ++x) {
            const glm::ivec2 begin = kBlock * glm::ivec2(x, y), end = begin + kBlock;
            if (coverage.any(begin - 1, end))
                smoothBlock(pixels, size, glm::max(begin, 1), glm::min(end, size - 1));
        }
    for (const auto& [index, value] : changed_) pixels[index] = value;
}

} // namespace shoal::render
