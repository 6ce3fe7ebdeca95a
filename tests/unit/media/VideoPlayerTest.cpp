#include "engine/media/VideoPlayer.h"

#include "engine/media/Check.h"
#include "tests/unit/media/TestFiles.h"

#include <array>
#include <atomic>
#include <functional>
#include <set>
#include <sys/stat.h>
#include <thread>

namespace shoal::media {
namespace {

constexpr double kFps = 30;

VideoPlayer opened(const Path& file, PlayerOptions options = {}) {
    auto player = VideoPlayer::open(file, std::move(options));
    EXPECT_TRUE(player) << (player ? "" : player.error().message());
    return std::move(player).value();
}

VideoPlayer greyFilm(const TempFolder& folder, int pictures, PlayerOptions options = {}) {
    writeGreyVideo(folder / "grey.avi", pictures);
    return opened(folder / "grey.avi", std::move(options));
}

void writeMp4(const Path& file, int frames, const cv::Mat& picture) {
    cv::VideoWriter writer(file.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('m', 'p', '4', 'v'), kFps,
                           picture.size());
    ASSERT_TRUE(writer.isOpened());
    for (int i = 0; i < frames; ++i) writer.write(picture);
}

TEST(VideoPlayer, ShowsEveryFrameInOrderAndLoops) {
    const TempFolder folder;
    auto player = greyFilm(folder, 12);
    for (int i = 0; i < 40; ++i) {
        const VideoFrame* frame = player.waitFor(i / kFps);
        ASSERT_EQ(frame->index, i);
        EXPECT_EQ(frame->number, i % 12);
        EXPECT_EQ(numberOf(frame->pixelsBgr), i % 12);
    }
    EXPECT_EQ(player.status(), "");
}

TEST(VideoPlayer, AFrameStaysUntilTheNextIsDue) {
    const TempFolder folder;
    auto player = greyFilm(folder, 12);
    for (int tick = 0; tick < 48; ++tick) // four ticks a frame, a hair after each
        EXPECT_EQ(player.waitFor(tick / (4 * kFps) + 1e-5)->index, tick / 4) << tick;
}

TEST(VideoPlayer, WaitForJumpsAheadAndBack) {
    const TempFolder folder;
    for (const int first : {0, 1000}) { // within the film, and beyond its end before its length is counted
        auto player = greyFilm(folder, 37);
        for (const int index : {first, 36, 3, 37, 38, 399, 0, 1, 4000 + 17, 73, 74})
            EXPECT_EQ(numberOf(player.waitFor(index / kFps)->pixelsBgr), index % 37) << index;
    }
}

// The caller's time runs faster than any decoder: frames are left out, order and due times hold.
TEST(VideoPlayer, NewestNeverGoesBackNorAhead) {
    const TempFolder folder;
    auto player = greyFilm(folder, 45);
    int64_t before = 0;
    int64_t distinct = 0;
    for (int call = 0; distinct < 100; ++call) {
        const double time_s = call * 1e-4;
        const VideoFrame* frame = player.newest(time_s);
        ASSERT_GE(frame->index, before);
        ASSERT_LE(static_cast<double>(frame->index) / kFps, time_s + 1e-6);
        ASSERT_EQ(numberOf(frame->pixelsBgr), frame->index % 45);
        distinct += frame->index != before;
        before = frame->index;
        std::this_thread::yield();
    }
}

TEST(VideoPlayer, NewestReachesTheDueFrameAfterAHangAndSkipsTheRest) {
    const TempFolder folder;
    const Path file = folder / "grey.avi";
    writeGreyVideo(file, 45);
    std::atomic<int> prepared{0};
    PlayerOptions options;
    options.prepare = [&](const VideoFrame&) { ++prepared; };
    auto player = opened(file, std::move(options));
    const double time_s = 1000 / kFps; // as if the game had hung for half a minute
    while (player.newest(time_s)->index != 1000) std::this_thread::yield();
    EXPECT_EQ(numberOf(player.newest(time_s)->pixelsBgr), 1000 % 45);
    // Frames read ahead before and after the jump, and a few on the way, but not the thousand between.
    EXPECT_LT(prepared, 30);
}

TEST(VideoPlayer, NewestTakesUpAnEarlierTime) {
    const TempFolder folder;
    auto player = greyFilm(folder, 45);
    ASSERT_EQ(player.waitFor(40 / kFps)->index, 40);
    EXPECT_EQ(player.newest(38 / kFps)->index, 40) << "a small step back keeps the frame";
    while (player.newest(5 / kFps)->index != 5) std::this_thread::yield();
}

// Memory is taken once: one picture for each slot, or one for all if none is kept.
TEST(VideoPlayer, PrepareSeesTheFrameInTheSlotItIsShownFrom) {
    for (const bool keep : {true, false}) {
        const TempFolder folder;
        std::set<const uint8_t*> memory;
        std::array<int, kFrameSlots> preparedNumber{};
        auto player = greyFilm(folder, 20,
                               {.prepare =
                                    [&](const VideoFrame& frame) {
                                        memory.insert(frame.pixelsBgr.pixels.data());
                                        preparedNumber.at(frame.slot) = numberOf(frame.pixelsBgr);
                                    },
                                .keepPixels = keep});
        for (int i = 0; i < 60; ++i) {
            const VideoFrame* frame = player.waitFor(i / kFps);
            EXPECT_EQ(preparedNumber.at(frame->slot), i % 20);
            EXPECT_EQ(frame->pixelsBgr.empty(), !keep);
        }
        EXPECT_LE(memory.size(), keep ? kFrameSlots : 1);
    }
}

TEST(VideoPlayer, KeepsTheNativeRateUnlessItIsAbsurd) {
    const TempFolder folder;
    for (const auto& [stated, kept] : {std::pair(24.0, 24.0), {50.0, 50.0}, {1000.0, kFallbackFps}}) {
        writeGreyVideo(folder / "rate.avi", 10, stated);
        auto player = opened(folder / "rate.avi");
        EXPECT_DOUBLE_EQ(player.info().fps, kept);
        EXPECT_EQ(player.waitFor(7.5 / kept)->index, 7);
    }
}

TEST(VideoPlayer, ATruncatedFileKeepsItsLastGoodFrameAndSaysSoOnce) {
    const TempFolder folder;
    const Path whole = folder / "whole.avi", cut = folder / "cut.avi";
    writeGreyVideo(whole, 40);
    const std::string bytes = readBytes(whole);
    const size_t pictures = bytes.find("movi"), index1 = bytes.rfind("idx1");
    writeBytes(cut, bytes.substr(0, (pictures + index1) / 2));
    auto player = opened(cut);
    const VideoFrame* last = player.waitFor(1e6);
    const int64_t index = last->index;
    EXPECT_NEAR(static_cast<double>(index), 19, 2); // all pictures take about the same room
    EXPECT_EQ(numberOf(last->pixelsBgr), index);
    const std::string message = player.status();
    EXPECT_NE(message.find("the last good frame stays"), std::string::npos) << message;
    EXPECT_EQ(player.status(), "");
    EXPECT_EQ(player.waitFor(2e6)->index, index);
    EXPECT_EQ(player.newest(3e6)->index, index);
    EXPECT_EQ(numberOf(player.waitFor(2 / kFps)->pixelsBgr), 2) << "what is good can be shown again";
    EXPECT_EQ(player.waitFor(2e6)->index, index);
}

// While it plays: cut, overwritten with nothing that is video, replaced by another, removed.
TEST(VideoPlayer, AFileThatChangesWhilePlayingNeverEndsThePlaying) {
    const TempFolder folder;
    const Path whole = folder / "whole.avi", file = folder / "film.avi", other = folder / "other.avi";
    writeGreyVideo(whole, 400);
    writeGreyVideo(other, 100);
    const std::string bytes = readBytes(whole);
    const std::array<std::function<void()>, 5> faults = {
        [&] { std::filesystem::resize_file(file, bytes.size() / 8); },
        [&] { std::filesystem::resize_file(file, 0); },
        [&] { writeBytes(file, std::string(bytes.size(), '\x5a')); },
        [&] { std::filesystem::rename(other, file); },
        [&] { std::filesystem::remove(file); },
    };
    for (size_t i = 0; i < faults.size(); ++i) {
        writeBytes(file, bytes);
        auto player = opened(file);
        EXPECT_EQ(numberOf(player.waitFor(10 / kFps)->pixelsBgr), 10);
        faults[i]();
        for (const double time_s : {20 / kFps, 390 / kFps, 30 / kFps, 1e3, 0.0}) {
            const VideoFrame* frame = player.waitFor(time_s);
            ASSERT_NE(frame, nullptr) << "fault " << i << " at " << time_s;
            EXPECT_EQ(frame->pixelsBgr.width, player.info().width) << "fault " << i;
        }
        EXPECT_NE(player.newest(1e4), nullptr);
    }
}

// In a telephone's clip the track's matrix says how the telephone was held.
TEST(VideoPlayer, AClipIsTurnedUpright) {
    const TempFolder folder;
    const Path file = folder / "turned.mp4";
    cv::Mat leftBright(32, 96, CV_8UC3, cv::Scalar::all(20));
    leftBright(cv::Rect(0, 0, 48, 32)) = cv::Scalar::all(220);
    writeMp4(file, 3, leftBright);
    // Row by row a b u, c d v, x y w; of 16.16 bits, the last column of 2.30 (ISO/IEC 14496-12, 8.3.2).
    const auto matrix = [](int a, int b, int c, int d) {
        std::string bytes;
        for (const int value : {a << 16, b << 16, 0, c << 16, d << 16, 0, 0, 0, 1 << 30})
            for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
        return bytes;
    };
    const std::string upright = readBytes(file);
    const size_t at = upright.find(matrix(1, 0, 0, 1), upright.find("tkhd"));
    ASSERT_NE(at, std::string::npos);
    const auto bright = [&](const std::string& how, bool across, std::array<int, 2> place) {
        std::string turned = upright;
        writeBytes(file, turned.replace(at, how.size(), how));
        auto player = opened(file);
        const ImageRgb8& picture = player.waitFor(0)->pixelsBgr;
        return picture.width == (across ? 32 : 96) && picture.height == (across ? 96 : 32) &&
               *picture.at(place[0], place[1]) > 180;
    };
    EXPECT_TRUE(bright(matrix(1, 0, 0, 1), false, {8, 16}));
    EXPECT_TRUE(bright(matrix(0, 1, -1, 0), true, {16, 8})) << "clockwise: what was left is above";
    EXPECT_TRUE(bright(matrix(-1, 0, 0, -1), false, {88, 16}));
    EXPECT_TRUE(bright(matrix(0, -1, 1, 0), true, {16, 88}));
}

// FFmpeg's own writer gives each track one edit: version, flags, count, then duration, media time and rate.
TEST(VideoPlayer, AnEditListGivesTheLengthShown) {
    const TempFolder folder;
    const Path file = folder / "edited.mp4";
    writeMp4(file, 30, cv::Mat(32, 64, CV_8UC3, cv::Scalar::all(99)));
    EXPECT_EQ(opened(file).info().frameCount, 30);
    std::string bytes = readBytes(file);
    const size_t at = bytes.find("elst") + 12;
    ASSERT_LT(at, bytes.size());
    const auto byte = [&](size_t i) { return static_cast<uint8_t>(bytes[at + i]); };
    ASSERT_EQ(byte(2) << 8 | byte(3), 1000) << "thousandths of a second";
    bytes[at + 2] = static_cast<char>(500 >> 8);
    bytes[at + 3] = static_cast<char>(500 & 0xff);
    writeBytes(file, bytes);
    EXPECT_EQ(opened(file).info().frameCount, 15);
}

// The file is refused by its header alone, before a decoder reads it.
TEST(VideoPlayer, RefusesWhatStatesAPictureTooLarge) {
    const TempFolder folder;
    const Path file = folder / "grey.avi";
    writeGreyVideo(file, 1);
    std::string bytes = readBytes(file);
    const size_t format = bytes.find("strf");
    ASSERT_NE(format, std::string::npos);
    // BITMAPINFOHEADER behind name and size: its size, width, height; little endian.
    bytes.replace(format + 12, 8, std::string("\x30\x75\0\0\x30\x75\0\0", 8));
    writeBytes(file, bytes);
    const auto player = VideoPlayer::open(file);
    ASSERT_FALSE(player);
    EXPECT_NE(player.error().reason.find("30000x30000"), std::string::npos) << player.error().reason;
}

TEST(VideoPlayer, EndsWhileBusy) {
    const TempFolder folder;
    for (int i = 0; i < 20; ++i) greyFilm(folder, 40).newest(i);
}

TEST(VideoPlayer, CheckPassesFilmsOfLessThanASecond) {
    const TempFolder folder;
    const Path file = folder.path() / "short.avi";
    writeGreyVideo(file, 5);
    const auto checked = checkVideo(file);
    ASSERT_TRUE(checked) << checked.error().message();
    EXPECT_NE(checked->find("0.2 s"), std::string::npos) << *checked;
}

TEST(VideoPlayer, RefusesWhatIsNoVideo) {
    const TempFolder folder;
    writeBytes(folder / "empty.mp4", "");
    writeBytes(folder / "text.mp4", "#EXTM3U\nhttp://localhost/x.ts\n");
    writeBytes(folder / "head.mp4", std::string("\0\0\0\x18"
                                                "ftypisom\0\0\0\0isommp42",
                                                24));
    ASSERT_EQ(::mkfifo((folder / "pipe.mp4").c_str(), 0600), 0);
    std::filesystem::create_directory(folder / "folder.mp4");
    for (const char* name : {"empty.mp4", "text.mp4", "head.mp4", "pipe.mp4", "folder.mp4", "missing.mp4"}) {
        const auto player = VideoPlayer::open(folder / name);
        ASSERT_FALSE(player) << name;
        EXPECT_NE(player.error().message().find(name), std::string::npos);
        EXPECT_FALSE(player.error().reason.empty());
    }
}

} // namespace
} // namespace shoal::media
