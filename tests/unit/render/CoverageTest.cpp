// In which blocks of a picture there is anything.
#include "engine/render/software/Coverage.h"

#include <gtest/gtest.h>

#include <vector>

namespace shoal::render {
namespace {

// A picture whose edges no block meets, with a single pixel in it: the blocks that hold it, and no others.
TEST(Coverage, IsOfTheBlockThatHoldsAPixel) {
    constexpr int kBlock = Coverage::kBlock;
    constexpr glm::ivec2 kPixels(3 * kBlock + 5, 2 * kBlock + 1);
    Coverage coverage;
    for (const glm::ivec2 lit : {glm::ivec2(0), glm::ivec2(kBlock - 1, kBlock),
                                 glm::ivec2(kBlock, kBlock - 1), glm::ivec2(kPixels.x - 1, kPixels.y - 1)}) {
        std::vector<uint32_t> pixels(static_cast<size_t>(kPixels.x * kPixels.y));
        pixels[static_cast<size_t>(lit.y * kPixels.x + lit.x)] = 1; // any byte counts
        coverage.find(pixels, kPixels);
        EXPECT_EQ(coverage.blocks(), glm::ivec2(4, 3));
        for (int y = 0; y < kPixels.y; ++y)
            for (int x = 0; x < kPixels.x; ++x)
                EXPECT_EQ(coverage.any({x, y}, {x, y}),
                          x / kBlock == lit.x / kBlock && y / kBlock == lit.y / kBlock)
                    << x << " " << y;
        EXPECT_TRUE(coverage.any(lit - 40, lit + 40));
        EXPECT_TRUE(coverage.any({-1000, -1000}, {1000, 1000}));
    }
}

TEST(Coverage, IsNowhereBeyondTheEdges) {
    const glm::ivec2 size(20, 20);
    Coverage coverage;
    coverage.find(std::vector<uint32_t>(400, 0xffffffff), size);
    EXPECT_TRUE(coverage.any({19, 19}, {25, 25}));
    EXPECT_FALSE(coverage.any({-9, 3}, {-1, 5}));
    EXPECT_FALSE(coverage.any({3, -9}, {5, -1}));
    EXPECT_FALSE(coverage.any({32, 3}, {40, 5})) << "the last block ends at 32";
    EXPECT_FALSE(coverage.any({3, 32}, {5, 40}));
    coverage.find({}, glm::ivec2(0));
    EXPECT_FALSE(coverage.any({-5, -5}, {5, 5}));
}

} // namespace
} // namespace shoal::render
