#include "tests/bench/depth/Hiding.h"

#include "engine/math/LatLong.h"
#include "engine/math/Quantile.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace shoal::bench {

namespace {

using Mask = Image<uint8_t, 1>;

constexpr double kPi = std::numbers::pi;

// Length of the border of what is hidden, radians: steps between texels, of which a slanted line has 4 / pi
// times its length on average over all directions.
double borderLength(const Mask& hidden) {
    double length = 0;
    for (int y = 0; y < hidden.height; ++y) {
        const double across = 2 * kPi / hidden.width * std::cos(kPi * (0.5 - (y + 1.0) / hidden.height)),
                     down = kPi / hidden.height;
        const uint8_t *row = hidden.at(0, y), *below = hidden.at(0, std::min(y + 1, hidden.height - 1));
        int steps = row[0] != row[hidden.width - 1], stepsDown = 0;
        for (int x = 0; x < hidden.width; ++x) {
            if (x > 0) steps += row[x] != row[x - 1];
            stepsDown += row[x] != below[x];
        }
        length += steps * down + stepsDown * across;
    }
    return length * kPi / 4;
}

// A fish seen from the side, 0.24 m long: a body and a tail; x ahead and y up, in half lengths.
bool isFish(float x, float y) {
    const float body = (x - 0.2f) / 0.8f;
    const bool tail = x < -0.5f && std::abs(y) < 0.5f * (-0.4f - x);
    return body * body + y * y / 0.16f < 1 || tail;
}

} // namespace

void hiddenInTruth(const media::DepthFrame& truth, HiddenTexels& out) {
    for (size_t i = 0; i < kAnimals_m.size(); ++i) {
        out[i].fit(truth.width, truth.height);
        const float code = media::kMaxDepthCode / (kAnimals_m[i] * media::kMaxInverse_perM);
        std::transform(truth.inverse.begin(), truth.inverse.end(), out[i].pixels.begin(),
                       [&](uint16_t of) { return static_cast<uint8_t>(static_cast<float>(of) > code); });
    }
}

void hiddenInMap(const depth::DepthMap& map, int width, HiddenTexels& out) {
    const int height = width / 2;
    for (Mask& mask : out) mask.fit(width, height);
    if (map.inverse.empty()) {
        for (Mask& mask : out) std::ranges::fill(mask.pixels, uint8_t{0});
        return;
    }
    const auto& codes = map.inverse;
    const float scale = static_cast<float>(codes.width) / static_cast<float>(width);
    const float perCode = depth::DepthMap::perM(1);
    for (int y = 0; y < height; ++y) {
        const float v = (static_cast<float>(y) + 0.5f) * scale - 0.5f, top = std::floor(v);
        const uint8_t* above = codes.at(0, std::clamp(static_cast<int>(top), 0, codes.height - 1));
        const uint8_t* below = codes.at(0, std::clamp(static_cast<int>(top) + 1, 0, codes.height - 1));
        for (int x = 0; x < width; ++x) {
            const float u = (static_cast<float>(x) + 0.5f) * scale - 0.5f, low = std::floor(u);
            const int left = (static_cast<int>(low) + codes.width) % codes.width,
                      right = (left + 1) % codes.width;
            const float a =
                std::lerp(static_cast<float>(above[left]), static_cast<float>(above[right]), u - low);
            const float b =
                std::lerp(static_cast<float>(below[left]), static_cast<float>(below[right]), u - low);
            const float inverse_perM = std::lerp(a, b, v - top) * perCode;
            for (size_t i = 0; i < kAnimals_m.size(); ++i)
                *out[i].at(x, y) = inverse_perM * kAnimals_m[i] > 1;
        }
    }
}

media::DepthFrame reduced(const media::DepthFrame& truth, int width, int stepsPerOctave) {
    const int block = truth.width / width, height = width / 2;
    media::DepthFrame out{
        width, height, std::vector<uint16_t>(static_cast<size_t>(width) * height),
        std::vector<uint16_t>(static_cast<size_t>(width / 2) * (height / 2), uint16_t{media::kMaxDepthCode})};
    std::vector<uint16_t> within;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            within.clear();
            for (int j = 0; j < block; ++j) {
                const auto row = truth.inverse.begin() + static_cast<ptrdiff_t>(y * block + j) * truth.width +
                                 ptrdiff_t{x} * block;
                within.insert(within.end(), row, row + block);
            }
            const float inverse_perM =
                static_cast<float>(math::median(within)) * (media::kMaxInverse_perM / media::kMaxDepthCode);
            out.inverse[static_cast<size_t>(y) * width + x] = media::depthCode(inverse_perM, stepsPerOctave);
        }
    return out;
}

void HidingError::add(const HiddenTexels& truth, const HiddenTexels& found) {
    texel_ = 2 * kPi / truth[0].width;
    for (size_t i = 0; i < kAnimals_m.size(); ++i) {
        const Mask &is = truth[i], &taken = found[i];
        for (int y = 0; y < is.height; ++y) {
            const double area = texelSolidAngle(y, is.width, is.height);
            int hidden = 0, shown = 0;
            for (int x = 0; x < is.width; ++x) {
                hidden += *taken.at(x, y) > *is.at(x, y);
                shown += *taken.at(x, y) < *is.at(x, y);
            }
            hidden_ += hidden * area, shown_ += shown * area, all_ += is.width * area;
        }
        length_ += borderLength(is);
        addFish(is, taken, kAnimals_m[i]);
    }
}

// Tests fish at this distance in random directions, the same for every map.
void HidingError::addFish(const Mask& truth, const Mask& found, float distance_m) {
    constexpr int kFish = 300, kAcross = 32, kDown = 16;
    constexpr float kHalfLength_m = 0.12f;
    std::mt19937 random(5);
    const auto share = [&] { return static_cast<float>(random()) * 0x1p-32f; };
    for (int n = 0; n < kFish; ++n) {
        const float y = 2 * share() - 1, turn = share() * 2 * static_cast<float>(kPi);
        const float ring = std::sqrt(1 - y * y);
        const glm::vec3 middle(ring * std::cos(turn), y, ring * std::sin(turn));
        const glm::vec3 level = glm::normalize(glm::cross(middle, glm::vec3(0.1f, 1, 0.2f)));
        const glm::vec3 up = glm::cross(level, middle);
        int area = 0, covered = 0, hidden = 0, shown = 0;
        for (int j = 0; j < kDown; ++j)
            for (int i = 0; i < kAcross; ++i) {
                const float ahead = (static_cast<float>(i) + 0.5f) / kAcross * 2 - 1,
                            above = (static_cast<float>(j) + 0.5f) / kDown - 0.5f;
                if (!isFish(ahead, above)) continue;
                const glm::vec3 dir =
                    glm::normalize(middle + kHalfLength_m / distance_m * (level * ahead + up * above));
                const glm::vec2 at =
                    latLongFromDirection(dir) * glm::vec2(truth.width, truth.height) - glm::vec2(0.001f);
                const int column = std::max(static_cast<int>(at.x), 0),
                          row = std::max(static_cast<int>(at.y), 0);
                const bool is = *truth.at(column, row) != 0, taken = *found.at(column, row) != 0;
                ++area;
                covered += is, hidden += taken && !is, shown += is && !taken;
            }
        // Counts only fish that an edge crosses.
        if (20 * covered < area || 20 * covered > 19 * area) continue;
        fish_ += area, fishHidden_ += hidden, fishShown_ += shown;
    }
}

void HidingError::addFlicker(const HiddenTexels& truthBefore, const HiddenTexels& truth,
                             const HiddenTexels& foundBefore, const HiddenTexels& found) {
    for (size_t i = 0; i < kAnimals_m.size(); ++i) {
        for (int y = 0; y < truth[i].height; ++y) {
            const double area = texelSolidAngle(y, truth[i].width, truth[i].height);
            int toggled = 0, truly = 0;
            for (int x = 0; x < truth[i].width; ++x) {
                const bool is = *truth[i].at(x, y) != *truthBefore[i].at(x, y);
                toggled += !is && *found[i].at(x, y) != *foundBefore[i].at(x, y);
                truly += is;
            }
            toggled_ += toggled * area, truthToggled_ += truly * area;
        }
        flickerLength_ += borderLength(truth[i]);
    }
}

} // namespace shoal::bench
