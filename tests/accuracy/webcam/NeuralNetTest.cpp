// The reader of models, on a made network whose results are known.
#ifdef SHOAL_HAND_LANDMARKS
#include "input/hands/webcam/landmarks/NeuralNet.h"
#include "TinyModel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace shoal::hands {
namespace {

TEST(NeuralNet, EveryOperatorDoesWhatItsDefinitionSays) {
    auto net = NeuralNet::read(test::TinyModel().make(), "tiny");
    ASSERT_TRUE(net) << net.error().message();
    ASSERT_EQ(net->inputShape(), (std::vector<size_t>{1, 4, 4, 2}));
    ASSERT_EQ(net->outputs(), 2u);
    ASSERT_EQ(net->output(0).size(), 56u);
    ASSERT_EQ(net->output(1).size(), 3u);
    const float a = 0.5f, b = -0.75f;
    for (size_t i = 0; i < net->input().size(); ++i) net->input()[i] = i % 2 ? b : a;
    ASSERT_TRUE(net->run());
    const float x = 0.5f * (a + 2 * b + 0.25f), y = 0.25f * (b / 2 - a); // both negative before
    const std::span<const float> rows = net->output(0), sure = net->output(1);
    const float sums[] = {10, 7, 7, 5};
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(rows[2 * i], sums[i] * x, 1e-5f) << i;
        EXPECT_NEAR(rows[2 * i + 1], sums[i] * y, 1e-5f) << i;
    }
    const auto pixel = [&](size_t row, size_t column) { return rows.subspan(8 + 3 * (4 * row + column), 3); };
    EXPECT_NEAR(pixel(0, 0)[0], 10 * x, 1e-5f); // corners are beyond the outermost middles
    EXPECT_NEAR(pixel(3, 3)[1], 5 * y, 1e-5f);
    EXPECT_NEAR(pixel(0, 1)[0], (0.75f * 10 + 0.25f * 7) * x, 1e-5f);
    for (size_t i = 0; i < 16; ++i) EXPECT_EQ(rows[8 + 3 * i + 2], 0) << i;
    const auto sigmoid = [](float v) { return 1 / (1 + std::exp(-v)); };
    EXPECT_NEAR(sure[0], sigmoid(7.25f * x), 1e-5f);
    EXPECT_NEAR(sure[1], sigmoid(7.25f * y), 1e-5f);
    EXPECT_NEAR(sure[2], sigmoid(1), 1e-5f);
}

// A small file may ask for much: operators share weights, and pictures are resized.
TEST(NeuralNet, WhatNeedsTooMuchMemoryIsRefused) {
    EXPECT_TRUE(NeuralNet::read(test::TinyModel().makeLayers(2), "small"));
    EXPECT_TRUE(NeuralNet::read(test::TinyModel().makePictures(1), "small"));
    for (const auto& file : {test::TinyModel().makeLayers(9), test::TinyModel().makePictures(3)}) {
        const auto net = NeuralNet::read(file, "large");
        ASSERT_FALSE(net);
        EXPECT_EQ(net.error().reason, "is too large");
    }
}

TEST(NeuralNet, DamagedFilesAreRefusedOrRun) {
    const std::vector<uint8_t> whole = test::TinyModel().make();
    EXPECT_FALSE(NeuralNet::read({}, "empty"));
    EXPECT_FALSE(NeuralNet::read(std::vector<uint8_t>(1000, 0xff), "no model"));
    for (size_t size = 0; size < whole.size(); size += 7)
        EXPECT_FALSE(NeuralNet::read(
            std::vector<uint8_t>(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(size)), "cut"));
    for (size_t i = 0; i < whole.size(); ++i)
        for (const uint8_t value : {uint8_t{0}, uint8_t{7}, uint8_t{0xff}}) {
            std::vector<uint8_t> damaged = whole;
            damaged[i] = value;
            auto net = NeuralNet::read(damaged, "damaged");
            EXPECT_TRUE(!net || net->run()) << i;
        }
}

} // namespace
} // namespace shoal::hands
#endif
