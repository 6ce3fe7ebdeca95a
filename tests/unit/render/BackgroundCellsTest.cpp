#include "engine/render/BackgroundCells.h"

#include "tests/unit/depth/MadeMap.h"

#include <gtest/gtest.h>

#include <vector>

namespace shoal::render {
namespace {

constexpr glm::ivec2 kSize(640, 480);

View ahead() {
    View view;
    view.verticalFov = 1.2f;
    view.aspect = static_cast<float>(kSize.x) / kSize.y;
    return view;
}

// Returns a map of a wall that is 1 m ahead to the left of the middle and 4 m ahead to the right of it.
depth::DepthMap step() {
    return depth::mapOf([](const glm::vec3& d) { return std::max(-d.z, 0.0f) / (d.x < 0 ? 1.0f : 4.0f); });
}

} // namespace

TEST(BackgroundCells, CoverEveryPixelOnceAlsoWhereTheyAreDivided) {
    const depth::DepthMap map = step();
    BackgroundCells whole, divided;
    whole.make(ahead(), glm::mat3(1), kSize);
    divided.make(ahead(), glm::mat3(1), kSize, {&map, {0.1f, 0, 0}});
    EXPECT_GT(divided.all().size(), whole.all().size());
    for (const BackgroundCells* cells : {&whole, &divided}) {
        std::vector<int> covered(static_cast<size_t>(kSize.x) * kSize.y, 0);
        for (const BackgroundCell& cell : cells->all())
            for (int y = cell.low.y; y < cell.high.y; ++y)
                for (int x = cell.low.x; x < cell.high.x; ++x)
                    ++covered[static_cast<size_t>(y) * kSize.x + x];
        EXPECT_EQ(std::ranges::count(covered, 1), static_cast<ptrdiff_t>(covered.size()));
        EXPECT_EQ(cells->rowBegin(cells->rows()), cells->all().size());
    }
}

// Away from the step, what a cell says of its pixels is where a ray from the eye meets the walls. Half a
// texel of a 2048 wide video for a cell that was not divided, as much for the search, and steps of codes.
TEST(BackgroundCells, ShowWhatAnEyeBesideTheCameraSees) {
    const depth::DepthMap map = step();
    const glm::vec3 eye(0.1f, 0.02f, 0);
    BackgroundCells cells;
    cells.make(ahead(), glm::mat3(1), kSize, {&map, eye});
    int compared = 0;
    for (const BackgroundCell& cell : cells.all()) {
        if (cell.polar) continue;
        const glm::vec2 pixel = 0.5f * glm::vec2(cell.low + cell.high);
        const glm::vec2 plane = (2.0f * pixel / glm::vec2(kSize) - 1.0f) * ahead().halfExtent();
        if (plane.x > -0.2f && plane.x < 0.1f) continue; // where the eye sees past the step
        const float away = plane.x < 0 ? 1.0f : 4.0f;
        const glm::vec2 right = latLongFromDirection(glm::normalize(eye + glm::vec3(plane, -1) * away));
        const glm::vec2 shown = cell.first + 0.5f * (cell.right + cell.up);
        EXPECT_LT(glm::length((shown - right) * glm::vec2(2048, 1024)), 1.3f);
        ++compared;
    }
    EXPECT_GT(compared, 200);
}

// A cell across the step would draw the film between its two sides out by 24 texels, and show it twice. A
// pixel is at most 1.1 texels wide here, and a wall that is seen from aside a little more.
TEST(BackgroundCells, DrawNothingOutOverAnEdge) {
    const depth::DepthMap map = step();
    for (const float aside_m : {-0.1f, 0.1f}) {
        BackgroundCells cells;
        cells.make(ahead(), glm::mat3(1), kSize, {&map, {aside_m, 0, 0}});
        for (const BackgroundCell& cell : cells.all()) {
            if (cell.polar) continue;
            const auto pixels = glm::vec2(cell.high - cell.low);
            constexpr glm::vec2 kTexels(2048, 1024);
            EXPECT_LT(glm::length(cell.right * kTexels), 1.3f * pixels.x + 3)
                << cell.low.x << ", " << cell.low.y;
            EXPECT_LT(glm::length(cell.up * kTexels), 1.3f * pixels.y + 3)
                << cell.low.x << ", " << cell.low.y;
        }
    }
}

} // namespace shoal::render
