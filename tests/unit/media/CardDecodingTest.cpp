// Decoding by a graphics card, on machines without one: pictures in its forms, and films that go on without
// it.
#include "engine/core/Random.h"
#include "engine/media/Decoder.h"
#include "engine/media/VideoPlayer.h"
#include "engine/media/VideoSource.h"
#include "tests/unit/media/CodedFrames.h"
#include "tests/unit/media/TestFiles.h"

namespace shoal::media {
namespace {

ImageRgb8 converted(const AVFrame& frame) {
    ImageRgb8 bgr;
    const FrameColour colour = colourOf(AV_CODEC_ID_HEVC, {}, frame.width, frame.height);
    EXPECT_TRUE(FrameConverter().convert(frame, colour, bgr, nullptr));
    return bgr;
}

// Also of an odd size, and of another size from the same memory.
TEST(CardPictures, AreThoseOfSoftwareInPlanes) {
    Random random(3);
    CardPictures pictures;
    for (const auto& [semi, planar] :
         {std::pair{AV_PIX_FMT_NV12, AV_PIX_FMT_YUV420P}, {AV_PIX_FMT_P010, AV_PIX_FMT_YUV420P10}})
        for (const auto& [width, height] : {std::pair{64, 32}, {35, 21}, {64, 32}}) {
            const Frame stored = blankFrame(semi, width, height),
                        expected = blankFrame(planar, width, height);
            for (int c = 0; c < 3; ++c)
                for (int y = 0; y < (c ? (height + 1) / 2 : height); ++y) {
                    std::vector<uint16_t> codes(static_cast<size_t>(c ? (width + 1) / 2 : width));
                    for (uint16_t& code : codes)
                        code = static_cast<uint16_t>(random.below(semi == AV_PIX_FMT_NV12 ? 256 : 1024));
                    for (const Frame* frame : {&stored, &expected})
                        av_write_image_line2(
                            codes.data(), (*frame)->data, (*frame)->linesize,
                            av_pix_fmt_desc_get(static_cast<AVPixelFormat>((*frame)->format)), 0, y, c,
                            static_cast<int>(codes.size()), sizeof(uint16_t));
                }
            const Frame copy = makeFrame();
            ASSERT_TRUE(pictures.copyInPlanes(*stored, *copy));
            EXPECT_EQ(copy->format, planar);
            EXPECT_EQ(converted(*copy).pixels, converted(*expected).pixels);
            EXPECT_EQ(converted(*stored).pixels, converted(*expected).pixels) << "and without the copy";
        }
}

// Decoders in software take over pictures of any other form.
TEST(CardPictures, OfOtherFormsAreRefused) {
    const Frame other = blankFrame(AV_PIX_FMT_YUV444P, 32, 16),
                inMemory = blankFrame(AV_PIX_FMT_NV12, 32, 16), copy = makeFrame();
    EXPECT_FALSE(CardPictures().copyInPlanes(*other, *copy));
    EXPECT_FALSE(CardPictures().bringBack(*inMemory)) << "is not on a card";
}

// A film whose pictures refer to others, one key frame in 12.
class CardFilms : public testing::Test {
  protected:
    void SetUp() override {
        writeFilm(file, "mp4v", kFrames, [](int i) {
            cv::Mat picture(32, 64, CV_8UC3, cv::Scalar::all(30 + 4 * i));
            picture(cv::Rect(i, 4, 12, 12)) = cv::Scalar(200, 60, 20);
            return picture;
        });
        auto source = tests::valueOf(VideoSource::open(file, Layout::Mono));
        for (ImageRgb8 bgr; source.grab() && source.retrieve(bgr);) expected.push_back(bgr.pixels);
        ASSERT_EQ(expected.size(), size_t{kFrames});
    }
    static constexpr int kFrames = 40;
    const TempFolder folder;
    const Path file = folder / "film.mp4";
    std::vector<std::vector<uint8_t>> expected;
};

TEST_F(CardFilms, AreTheSameWithoutTheCard) {
    auto player =
        tests::valueOf(VideoPlayer::open(file, {.layout = Layout::Mono, .decoding = Decoding::Card}));
    for (int i = 0; i < 2 * kFrames; ++i)
        ASSERT_EQ(player.waitFor(i / 30.0)->pixelsBgr.pixels, expected[i % kFrames]) << i;
    EXPECT_EQ(player.status(), "");
}

TEST_F(CardFilms, GoOnWhenTheCardFailsInTheMiddle) {
    for (const int64_t at : {0, 1, 11, 12, 13, 27, kFrames - 1, kFrames}) {
        auto source = tests::valueOf(VideoSource::open(file, Layout::Mono, Decoding::Card));
        ImageRgb8 bgr;
        for (int64_t i = 0; i < kFrames; ++i) {
            if (i == at) source.leaveCard();
            ASSERT_EQ(source.position(), i);
            ASSERT_TRUE(source.grab() && source.retrieve(bgr)) << at;
            ASSERT_EQ(bgr.pixels, expected[i]) << at << ' ' << i;
        }
        if (at == kFrames) source.leaveCard();
        EXPECT_FALSE(source.grab()) << at;
        ASSERT_TRUE(source.seek(5) && source.grab());
    }
}

// Without its file, it ends.
TEST_F(CardFilms, EndWhenTheFileIsGoneToo) {
    auto source = tests::valueOf(VideoSource::open(file, Layout::Mono, Decoding::Card));
    ASSERT_TRUE(source.grab());
    std::filesystem::remove(file);
    source.leaveCard();
    EXPECT_FALSE(source.grab());
    EXPECT_EQ(source.keyFrameBefore(20), 0);
    EXPECT_FALSE(source.seek(20) && source.grab());
}

} // namespace
} // namespace shoal::media
