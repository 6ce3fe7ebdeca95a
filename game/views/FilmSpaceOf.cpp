#include "game/views/FilmSpaceOf.h"

#include "engine/core/Log.h"
#include "engine/math/Trigonometry.h"
#include "engine/media/DepthTrack.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace shoal::app {

namespace {

using game::FilmSpace;

constexpr double kSteps_Hz = 4;
constexpr int kBelieved = media::kMaxDepthCode / 2; // confidence below which a distance is ignored

// Returns the cell of each texel of the track. Uses no C library trigonometry, because the grid is hashed.
std::vector<int> cellsOf(int width, int height, float yaw) {
    constexpr float kPi = std::numbers::pi_v<float>;
    std::vector<glm::vec2> ahead; // direction of each column: towards +X and -Z
    for (int x = 0; x < width; ++x) {
        const float right = kPi * (static_cast<float>(2 * x + 1) / static_cast<float>(width) - 1) + yaw;
        ahead.emplace_back(math::sine(right), math::cosine(right));
    }
    std::vector<int> cells;
    cells.reserve(static_cast<size_t>(width) * height);
    for (int y = 0; y < height; ++y) {
        const float up = kPi * 0.5f * (1 - static_cast<float>(2 * y + 1) / static_cast<float>(height));
        const float level = math::cosine(up), rise = math::sine(up);
        for (const glm::vec2 a : ahead) cells.push_back(FilmSpace::cellOf({a.x * level, rise, -a.y * level}));
    }
    return cells;
}

void addStep(const media::DepthFrame& frame, const std::vector<int>& cells, std::span<uint16_t> step_mm) {
    std::fill(step_mm.begin(), step_mm.end(), static_cast<uint16_t>(1000 * FilmSpace::kFar_m));
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x) {
            if (frame.confidence[static_cast<size_t>(y / 2) * (frame.width / 2) + x / 2] < kBelieved)
                continue;
            const float inverse = std::max(frame.inverse_perM(x, y), 1 / FilmSpace::kFar_m);
            uint16_t& nearest = step_mm[cells[static_cast<size_t>(y) * frame.width + x]];
            nearest = std::min(nearest, static_cast<uint16_t>(1000 / inverse));
        }
}

} // namespace

std::shared_ptr<const FilmSpace> filmSpaceOf(const Path& film, float yaw) {
    const Path file = media::depthTrackOf(film);
    std::error_code missing;
    if (!std::filesystem::exists(file, missing)) return nullptr;
    auto track = media::DepthTrack::open(file, film);
    if (!track) return nullptr; // the film's player says why
    const media::DepthTrackInfo& info = track->info();
    const int steps =
        std::clamp(static_cast<int>(std::ceil(info.duration_s * kSteps_Hz)), 1, FilmSpace::kMaxSteps);
    const std::vector<int> cells = cellsOf(info.width, info.height, yaw);
    std::vector<uint16_t> surface_mm(static_cast<size_t>(steps) * FilmSpace::kCells);
    media::DepthFrame frame;
    for (int step = 0; step < steps; ++step) {
        const int number = track->frameAt(step * info.duration_s / steps);
        const std::span step_mm =
            std::span(surface_mm).subspan(static_cast<size_t>(step) * FilmSpace::kCells, FilmSpace::kCells);
        if (!track->read(number, frame)) {
            log::warn("{}: damaged in frame {}; animals take the film for open water", file.string(), number);
            return nullptr;
        }
        addStep(frame, cells, step_mm);
    }
    return std::make_shared<const FilmSpace>(info.duration_s, std::move(surface_mm));
}

} // namespace shoal::app
