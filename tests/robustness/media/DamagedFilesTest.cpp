// Readers return a value or an Error for files that are cut short or have flipped bytes. The test fails by a
// crash, a hang (the test's time limit) or a report of the sanitizers.
#include "engine/core/Random.h"
#include "engine/media/Check.h"
#include "engine/media/Pictures.h"
#include "engine/media/VideoPlayer.h"
#include "tests/unit/media/TestFiles.h"

#include <opencv2/imgcodecs.hpp>

namespace shoal::media {
namespace {

constexpr int kCuts = 40;
constexpr int kFlips = 120;
constexpr PictureLimits kLimits{2048, 2048}; // keeps lying headers from costing gigabytes, as in play

// Calls visit with damaged copies of a file: cut at kCuts places, then kFlips copies with 1 to 8 random
// bytes, in half of the copies within the first 256 bytes, where the headers are.
void damage(const std::string& good, const Path& file,
            const std::function<void(const std::string& how)>& visit) {
    for (int i = 0; i < kCuts; ++i) {
        const size_t length =
            i < 16 ? static_cast<size_t>(i) * 4 : good.size() * static_cast<size_t>(i) / kCuts;
        writeBytes(file, good.substr(0, std::min(length, good.size())));
        visit("cut at " + std::to_string(length));
    }
    for (uint32_t seed = 0; seed < kFlips; ++seed) {
        Random random(seed);
        std::string bad = good;
        const size_t range = seed % 2 ? good.size() : std::min<size_t>(256, good.size());
        for (uint32_t left = 1 + random.below(8); left > 0; --left)
            bad[random.below(static_cast<uint32_t>(range))] = static_cast<char>(random.below(256));
        writeBytes(file, bad);
        visit("seed " + std::to_string(seed));
    }
}

class DamagedPicture : public testing::TestWithParam<const char*> {};

TEST_P(DamagedPicture, GivesAValueOrAReason) {
    const TempFolder folder;
    const std::string extension = GetParam();
    const Path file = folder / ("a" + extension);
    const bool hdr = extension == ".hdr" || extension == ".exr" || extension == ".pfm";
    Random random(7);
    if (hdr) {
        ImageRgbF image(48, 24);
        for (size_t i = 0; i < image.pixels.size();
             ++i) // runs and noise, so that every way of coding is used
            image.pixels[i] = i < image.pixels.size() / 2 ? 0.25f : random.between(0, 100);
        ASSERT_TRUE(writeHdr(file, image));
    } else {
        cv::Mat picture(24, 48, CV_8UC3, cv::Scalar(10, 20, 30));
        for (int i = 0; i < 24 * 24 * 3; ++i) picture.data[i] = static_cast<uint8_t>(random.below(256));
        ASSERT_TRUE(cv::imwrite(file.string(), picture));
    }
    const std::string good = readBytes(file);
    damage(good, file, [&](const std::string& how) {
        SCOPED_TRACE(how);
        if (hdr) {
            const auto read = readHdr(file, kLimits);
            if (!read) {
                EXPECT_FALSE(read.error().reason.empty());
            } else {
                for (const float value : read->radianceLin.pixels)
                    ASSERT_TRUE(value >= 0 && value <= kMaxRadiance);
            }
        } else {
            const auto read = readPicture(file, kLimits);
            if (!read) {
                EXPECT_FALSE(read.error().reason.empty());
            } else {
                EXPECT_EQ(read->pixels.size(), size_t{3} * static_cast<size_t>(read->width * read->height));
            }
        }
    });
}

INSTANTIATE_TEST_SUITE_P(Kinds, DamagedPicture,
                         testing::Values(".png", ".jpg", ".bmp", ".webp", ".tif", ".ppm", ".hdr", ".exr",
                                         ".pfm"));

// Found by tests/fuzz: OpenEXR allocated gigabytes for a size in a field that we had not checked.
TEST(DamagedExr, SizesAreCheckedBeforeTheLibraryBelievesThem) {
    for (const char* name : {"exr_attribute_size", "exr_list_shorter_than_stated", "exr_list_without_end",
                             "exr_unknown_attribute_size"}) {
        EXPECT_THAT(
            tests::errorOf(readHdr(tests::sourceFolder() / "tests/fuzz/regressions/Pictures" / name, kLimits))
                .reason,
            testing::HasSubstr("header is damaged"))
            << name;
    }
}

// Found by tests/fuzz: OpenCV gave a damaged WebP to its decoder of DICOM, which ended the program.
TEST(DamagedWebp, IsNotTakenForDicom) {
    const Path file = tests::sourceFolder() / "tests/fuzz/regressions/Pictures/webp_with_dicom_mark";
    EXPECT_THAT(tests::errorOf(readPhoto(file, kLimits)).reason, testing::HasSubstr("cannot be decoded"));
}

class DamagedVideo : public testing::TestWithParam<const char*> {};

TEST_P(DamagedVideo, PlaysOrGivesAReason) {
    const TempFolder folder;
    const Path file = folder / (std::string("a") + GetParam());
    const bool mp4 = std::string(GetParam()) == ".mp4";
    {
        cv::VideoWriter writer(file.string(), cv::CAP_FFMPEG,
                               mp4 ? cv::VideoWriter::fourcc('m', 'p', '4', 'v')
                                   : cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                               30, {64, 32});
        ASSERT_TRUE(writer.isOpened());
        Random random(8);
        cv::Mat picture(32, 64, CV_8UC3);
        for (int i = 0; i < 12; ++i) {
            for (int b = 0; b < 64 * 32 * 3; ++b) picture.data[b] = static_cast<uint8_t>(random.below(256));
            writer.write(picture);
        }
    }
    const std::string good = readBytes(file);
    int played = 0;
    damage(good, file, [&](const std::string& how) {
        SCOPED_TRACE(how);
        auto player = VideoPlayer::open(file);
        if (!player) {
            EXPECT_FALSE(player.error().reason.empty());
            return;
        }
        ++played;
        int64_t before = 0;
        for (int i = 0; i < 30; ++i) {
            const VideoFrame* frame = player->waitFor(i / player->info().fps);
            ASSERT_NE(frame, nullptr);
            ASSERT_GE(frame->index, before);
            ASSERT_LE(frame->index, i);
            before = frame->index;
        }
        ASSERT_NE(player->waitFor(1000), nullptr);
        ASSERT_NE(player->newest(0.1), nullptr);
        ASSERT_NE(player->waitFor(0), nullptr);
        (void)player->status();
        (void)checkVideo(file);
    });
    EXPECT_GT(played, 0); // else nothing was tried
}

INSTANTIATE_TEST_SUITE_P(Kinds, DamagedVideo, testing::Values(".avi", ".mp4", ".mkv"));

} // namespace
} // namespace shoal::media
