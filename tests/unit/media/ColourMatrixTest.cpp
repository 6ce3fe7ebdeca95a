#include "engine/media/ColourMatrix.h"

#include "engine/media/VideoPlayer.h"
#include "tests/unit/media/TestFiles.h"

#include <opencv2/core.hpp>

#include <cmath>

namespace shoal::media {
namespace {

TEST(ColourMatrix, StatedWinsElseSizeTells) {
    EXPECT_EQ(colourMatrixOf(1, 640, 320), ColourMatrix::Bt709);
    EXPECT_EQ(colourMatrixOf(6, 4096, 2048), ColourMatrix::Bt601);
    EXPECT_EQ(colourMatrixOf(9, 4096, 2048), ColourMatrix::Bt2020);
    EXPECT_EQ(colourMatrixOf(2, 2048, 1024), ColourMatrix::Bt709);
    EXPECT_EQ(colourMatrixOf(0, 426, 214), ColourMatrix::Bt601);
}

struct Weights {
    double red, blue;
};
constexpr Weights k601{0.299, 0.114}, k709{0.2126, 0.0722}, k2020{0.2627, 0.0593};

// A colour coded by one matrix and decoded by another.
std::array<double, 3> recoded(std::array<double, 3> bgr, Weights coded, Weights decoded) {
    const auto [b, g, r] = bgr;
    const double y = coded.red * r + (1 - coded.red - coded.blue) * g + coded.blue * b;
    const double cb = (b - y) / (2 - 2 * coded.blue), cr = (r - y) / (2 - 2 * coded.red);
    const double r2 = y + (2 - 2 * decoded.red) * cr, b2 = y + (2 - 2 * decoded.blue) * cb;
    return {b2, (y - decoded.red * r2 - decoded.blue * b2) / (1 - decoded.red - decoded.blue), r2};
}

TEST(ColourMatrix, CorrectionUndoesTheWrongMatrix) {
    const struct {
        ColourMatrix matrix;
        Weights weights;
    } kCases[] = {{ColourMatrix::Bt601, k601}, {ColourMatrix::Bt709, k709}, {ColourMatrix::Bt2020, k2020}};
    // Each of two entries of a row is rounded by at most 1/2048 and the third takes both up: 4 times that, of
    // a colour up to 255 here.
    constexpr double kTolerance = 4.0 / 2048 * 255;
    for (const auto& [matrix, weights] : kCases) {
        const auto m = correctionBgr(matrix);
        for (const std::array<double, 3> actual :
             {std::array{120.0, 80.0, 20.0}, std::array{30.0, 140.0, 200.0}, std::array{90.0, 90.0, 90.0}}) {
            const auto wrong = recoded(actual, weights, k601);
            for (size_t row = 0; row < 3; ++row) {
                const double got =
                    m[3 * row] * wrong[0] + m[3 * row + 1] * wrong[1] + m[3 * row + 2] * wrong[2];
                EXPECT_NEAR(got, actual[row], kTolerance) << nameOf(matrix) << ' ' << row;
            }
            EXPECT_EQ(m[3] + m[4] + m[5], 1.0f);
        }
    }
}

// OpenCV codes a video by BT.601; at this size it is taken for BT.709.
TEST(ColourMatrix, FramesOfLargeVideosComeOutCorrected) {
    const TempFolder folder;
    const Path file = folder / "colour.mkv";
    const std::array<double, 3> bgr{220, 60, 60};
    {
        cv::VideoWriter writer(file.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('F', 'F', 'V', '1'), 30,
                               {1280, 640});
        ASSERT_TRUE(writer.isOpened());
        cv::Mat picture(640, 1280, CV_8UC3, cv::Scalar(bgr[0], bgr[1], bgr[2]));
        picture(cv::Rect(0, 0, 640, 640)) = cv::Scalar::all(99);
        for (int i = 0; i < 3; ++i) writer.write(picture);
    }
    auto player = VideoPlayer::open(file);
    ASSERT_TRUE(player) << player.error().sentence();
    EXPECT_EQ(player->info().matrix, ColourMatrix::Bt709);
    const auto wanted = recoded(bgr, k601, k709);
    const ImageRgb8& frame = player->waitFor(0)->pixelsBgr;
    for (size_t c = 0; c < 3; ++c) {
        // The codec loses nothing, but 8-bit YCbCr of limited range does: half a level of Cb is 1.772 * 0.5 *
        // 255 / 224 = 1.0 of blue, half one of Y 0.6; the decoder truncates one more.
        EXPECT_NEAR(frame.at(1000, 300)[c], wanted[c], 2.6) << c;
        EXPECT_NEAR(frame.at(300, 300)[c], 99, 2.6) << "grey stays";
    }
    // The correction is larger than that tolerance where it matters, so that this test can fail.
    EXPECT_GT(std::abs(wanted[0] - bgr[0]), 2 * 2.6);
}

} // namespace
} // namespace shoal::media
