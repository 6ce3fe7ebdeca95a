#include "engine/core/Random.h"
#include "engine/media/Decoder.h"
#include "engine/media/VideoPlayer.h"
#include "tests/unit/media/TestFiles.h"

#include <opencv2/core.hpp>

namespace shoal::media {
namespace {

// BT.601, BT.709 and BT.2020 alike, item 3, with the ranges of item 4 (8 bits).
std::array<double, 3> bgrOf(double luma, double cb, double cr, Luma k, bool full) {
    const double y = full ? luma : (luma - 16) * 255.0 / 219;
    const double range = full ? 1 : 255.0 / 224;
    const double r = y + (2 - 2 * k.red) * (cr - 128) * range, b = y + (2 - 2 * k.blue) * (cb - 128) * range;
    return {b, (y - k.red * r - k.blue * b) / (1 - k.red - k.blue), r};
}

// Rounding to a level takes 1/2; each of three products 1/64; luma's factor, in 2^13, half of that 239 times;
// two factors of differences, in 2^12, half of that 128 times.
constexpr double kTolerance = 0.5 + 3.0 / 64 + 239.0 / (1 << 14) + 2 * 128.0 / (1 << 13);

TEST(YuvToBgr, IsTheFormulaRounded) {
    std::vector<uint8_t> luma(512), cb(256), cr(256);
    ImageRgb8 image(512, 1);
    const std::vector<uint8_t>& bgr = image.pixels;
    for (size_t i = 0; i < 512; ++i) luma[i] = static_cast<uint8_t>(i / 2);
    for (const ColourMatrix matrix : {ColourMatrix::Bt601, ColourMatrix::Bt709, ColourMatrix::Bt2020})
        for (const bool full : {false, true})
            for (int differences = 0; differences < 256 * 256; differences += 61) {
                std::ranges::fill(cb, static_cast<uint8_t>(differences >> 8));
                std::ranges::fill(cr, static_cast<uint8_t>(differences));
                toBgr({luma.data(), cb.data(), cr.data()}, {}, 1, matrix, full, image);
                for (size_t i = 0; i < 512; ++i) {
                    const auto wanted = bgrOf(luma[i], cb[0], cr[0], lumaOf(matrix), full);
                    for (size_t c = 0; c < 3; ++c)
                        ASSERT_NEAR(bgr[3 * i + c], std::clamp(wanted[c], 0.0, 255.0), kTolerance)
                            << nameOf(matrix) << ' ' << full << ' ' << i << ' ' << differences << ' ' << c;
                }
            }
}

// Rows of every width, without alignment.
TEST(YuvToBgr, EveryWidthIsTheSameToTheLastPixel) {
    Random random(5);
    std::vector<uint8_t> luma(130), cb(65), cr(65);
    for (auto* plane : {&luma, &cb, &cr})
        for (uint8_t& value : *plane) value = static_cast<uint8_t>(random.below(256));
    const auto converted = [](const auto& y, const auto& b, const auto& r, int width) {
        ImageRgb8 bgr(width, 1);
        toBgr({y.data(), b.data(), r.data()}, {}, 1, ColourMatrix::Bt709, false, bgr);
        return bgr.pixels;
    };
    const std::vector<uint8_t> whole = converted(luma, cb, cr, 130);
    for (int width = 1; width <= 129; ++width) {
        // The planes end with the row, so that reading beyond shows where reads are watched.
        const std::vector<uint8_t> y(luma.begin(), luma.begin() + width);
        const std::vector<uint8_t> b(cb.begin(), cb.begin() + (width + 1) / 2);
        const std::vector<uint8_t> r(cr.begin(), cr.begin() + (width + 1) / 2);
        const std::vector<uint8_t> part = converted(y, b, r, width);
        EXPECT_TRUE(std::equal(part.begin(), part.end(), whole.begin())) << width;
    }
}

TEST(ColourMatrix, StatedWinsElseSizeTells) {
    EXPECT_EQ(matrixOf(AV_CODEC_ID_H264, AVCOL_SPC_BT709, 640, 320), ColourMatrix::Bt709);
    EXPECT_EQ(matrixOf(AV_CODEC_ID_H264, AVCOL_SPC_SMPTE170M, 4096, 2048), ColourMatrix::Bt601);
    EXPECT_EQ(matrixOf(AV_CODEC_ID_H264, AVCOL_SPC_BT2020_NCL, 4096, 2048), ColourMatrix::Bt2020);
    EXPECT_EQ(matrixOf(AV_CODEC_ID_H264, AVCOL_SPC_UNSPECIFIED, 2048, 1024), ColourMatrix::Bt709);
    EXPECT_EQ(matrixOf(AV_CODEC_ID_H264, AVCOL_SPC_RGB, 426, 214), ColourMatrix::Bt601);
}

// As FFmpeg's own converter takes them.
TEST(ColourRange, IsWholeForJpegAndForGreyUnlessStated) {
    const auto isFull = [](AVPixelFormat format, AVColorRange stated = AVCOL_RANGE_UNSPECIFIED) {
        return colourOf(AV_CODEC_ID_FFV1, {.range = stated, .format = format}, 64, 32).fullRange;
    };
    for (const AVPixelFormat format : {AV_PIX_FMT_GRAY8, AV_PIX_FMT_GRAY16, AV_PIX_FMT_YUVJ411P})
        EXPECT_TRUE(isFull(format)) << av_get_pix_fmt_name(format);
    EXPECT_FALSE(isFull(AV_PIX_FMT_GRAY8, AVCOL_RANGE_MPEG));
    EXPECT_FALSE(isFull(AV_PIX_FMT_YUV411P));
    EXPECT_TRUE(isFull(AV_PIX_FMT_YUV411P, AVCOL_RANGE_JPEG));
}

constexpr Luma k601{0.299, 0.114}, k709{0.2126, 0.0722};

// A colour coded by one matrix and decoded by another.
std::array<double, 3> recoded(std::array<double, 3> bgr, Luma coded, Luma decoded) {
    const auto [b, g, r] = bgr;
    const double y = coded.red * r + (1 - coded.red - coded.blue) * g + coded.blue * b;
    return bgrOf(y, 128 + (b - y) / (2 - 2 * coded.blue), 128 + (r - y) / (2 - 2 * coded.red), decoded, true);
}

// OpenCV codes a video by BT.601; at this size it is taken for BT.709.
TEST(ColourMatrix, FramesOfLargeVideosAreTakenForBt709) {
    const TempFolder folder;
    const Path file = folder / "colour.avi";
    const std::array<double, 3> bgr{220, 60, 60};
    cv::Mat picture(640, 1280, CV_8UC3, cv::Scalar(bgr[0], bgr[1], bgr[2]));
    picture(cv::Rect(0, 0, 640, 640)) = cv::Scalar::all(99);
    writeFilm(file, "I420", 3, [&](int) { return picture; }); // without loss
    auto player = tests::valueOf(VideoPlayer::open(file));
    EXPECT_EQ(player.info().matrix, ColourMatrix::Bt709);
    const auto wanted = recoded(bgr, k601, k709);
    const ImageRgb8& frame = player.waitFor(0)->pixelsBgr;
    for (size_t c = 0; c < 3; ++c) {
        // 8-bit YCbCr of limited range: half a level of Cb is 1.856 * 0.5 * 255 / 224 = 1.1 of blue, half one
        // of Y 0.6; OpenCV's coding truncates once more.
        EXPECT_NEAR(frame.at(1000, 300)[c], wanted[c], 2.6) << c;
        EXPECT_NEAR(frame.at(300, 300)[c], 99, 2.6) << "grey stays";
    }
}

// A video coded as red, green and blue has no matrix.
TEST(ColourMatrix, ColoursThatAreCodedAsSuchStayAsTheyAre) {
    const TempFolder folder;
    const Path file = folder / "colour.mkv";
    writeFilm(file, "FFV1", 3, [](int) { return cv::Mat(640, 1286, CV_8UC3, cv::Scalar(220, 60, 61)); });
    auto player = tests::valueOf(VideoPlayer::open(file));
    const ImageRgb8& frame = player.waitFor(0)->pixelsBgr;
    for (const auto& [x, y] : {std::array{0, 0}, {1285, 639}, {640, 320}}) {
        const uint8_t* pixel = frame.at(x, y);
        EXPECT_EQ((std::array{int{pixel[0]}, int{pixel[1]}, int{pixel[2]}}), (std::array{220, 60, 61}));
    }
}

} // namespace
} // namespace shoal::media
