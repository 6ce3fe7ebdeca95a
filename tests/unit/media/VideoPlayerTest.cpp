#include "engine/media/VideoPlayer.h"
#include "engine/core/Hash.h"
#include "engine/media/Check.h"
#include "engine/media/Ffmpeg.h"
#include "engine/media/VideoSource.h"
#include "tests/unit/media/TestFiles.h"

#include <fmt/ranges.h>

#include <atomic>
#include <sys/stat.h>
#include <thread>

namespace shoal::media {
namespace {

constexpr double kFps = 30;

VideoPlayer opened(const Path& file, PlayerOptions options = {}) {
    return tests::valueOf(VideoPlayer::open(file, std::move(options)));
}

class VideoPlayers : public testing::Test {
  protected:
    VideoPlayer greyFilm(int pictures, PlayerOptions options = {}) {
        writeGreyVideo(folder / "grey.avi", pictures);
        return opened(folder / "grey.avi", std::move(options));
    }
    const TempFolder folder;
};

TEST_F(VideoPlayers, ShowsEveryFrameInOrderAndLoops) {
    auto player = greyFilm(12);
    for (int i = 0; i < 40; ++i) {
        const VideoFrame* frame = player.waitFor(i / kFps);
        ASSERT_EQ(frame->index, i);
        EXPECT_EQ(frame->number, i % 12);
        EXPECT_EQ(numberOf(frame->pixelsBgr), i % 12);
    }
    EXPECT_EQ(player.status(), "");
}

TEST_F(VideoPlayers, WaitForJumpsAheadAndBack) {
    for (const int first : {0, 1000}) { // within the film, and beyond its end before its length is counted
        auto player = greyFilm(37);
        for (const int index : {first, 36, 3, 37, 38, 399, 0, 1, 4000 + 17, 73, 74})
            EXPECT_EQ(numberOf(player.waitFor(index / kFps)->pixelsBgr), index % 37) << index;
    }
}

// The caller's time runs faster than any decoder: frames are left out, order and due times hold.
TEST_F(VideoPlayers, NewestNeverGoesBackNorAhead) {
    auto player = greyFilm(45);
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

TEST_F(VideoPlayers, NewestReachesTheDueFrameAfterAHangAndSkipsTheRest) {
    std::atomic<int> prepared{0};
    auto player = greyFilm(45, {.prepare = [&](const VideoFrame&) { ++prepared; }});
    // As if the game had hung for half a minute. The clock goes on: a decoder that takes longer than a frame
    // makes one that is due when it is ready.
    int64_t shown = 0;
    for (double due = 1000; shown < 1000; due += 0.01) {
        const VideoFrame* frame = player.newest(due / kFps);
        shown = frame->index;
        ASSERT_EQ(numberOf(frame->pixelsBgr), shown % 45);
        for (int i = 0; i < 1000; ++i) std::this_thread::yield(); // else the player's thread may starve
    }
    // Frames read ahead before and after the jump, and a few on the way, but not the thousand between.
    EXPECT_LT(prepared, 30);
}

TEST_F(VideoPlayers, NewestTakesUpAnEarlierTime) {
    auto player = greyFilm(45);
    ASSERT_EQ(player.waitFor(40 / kFps)->index, 40);
    EXPECT_EQ(player.newest(38 / kFps)->index, 40) << "a small step back keeps the frame";
    while (player.newest(5 / kFps)->index != 5) std::this_thread::yield();
}

// Memory is taken once: one picture for each slot, or one for all if none is kept.
TEST_F(VideoPlayers, PrepareSeesTheFrameInTheSlotItIsShownFrom) {
    for (const bool keep : {true, false}) {
        std::set<const uint8_t*> memory;
        std::array<int, kFrameSlots> preparedNumber{};
        auto player = greyFilm(20, {.prepare =
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

// They are the decoder's own memory, which it must not write while the frame is shown.
TEST_F(VideoPlayers, KeepsTheDecodersPlanes) {
    auto player = greyFilm(20, {.keepPixels = false, .keepPlanes = true});
    for (int i = 0; i < 60; ++i) {
        const Planes& planes = player.waitFor(i / kFps)->planes;
        ASSERT_TRUE(planes.codes[0]);
        const int grey = planes.codes[0][ptrdiff_t{16} * planes.rowBytes[0] + 32]; // JPEG: of full range
        EXPECT_EQ((grey - kFirstGrey + kGreyStep / 2) / kGreyStep, i % 20);
    }
}

TEST_F(VideoPlayers, KeepsTheNativeRateUnlessItIsAbsurd) {
    for (const auto& [stated, kept] : {std::pair(24.0, 24.0), {50.0, 50.0}, {1000.0, kMaxFps}}) {
        writeGreyVideo(folder / "rate.avi", 50, stated);
        auto player = opened(folder / "rate.avi");
        EXPECT_DOUBLE_EQ(player.info().fps, kept);
        EXPECT_EQ(player.waitFor(7.5 / kept)->index, 7);
        EXPECT_NEAR(numberOf(player.waitFor(7.5 / kept)->pixelsBgr), 7 * stated / kept, 1.5);
    }
}

TEST_F(VideoPlayers, ATruncatedFileKeepsItsLastGoodFrameAndSaysSoOnce) {
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
    EXPECT_THAT(player.status(), testing::HasSubstr("the last good frame stays"));
    EXPECT_EQ(player.status(), "");
    EXPECT_EQ(player.waitFor(2e6)->index, index);
    EXPECT_EQ(player.newest(3e6)->index, index);
    EXPECT_EQ(numberOf(player.waitFor(2 / kFps)->pixelsBgr), 2) << "what is good can be shown again";
    EXPECT_EQ(player.waitFor(2e6)->index, index);
}

// While it plays: cut, overwritten with nothing that is video, replaced by another, removed.
TEST_F(VideoPlayers, AFileThatChangesWhilePlayingNeverEndsThePlaying) {
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

// The matrix of a clip's track says how the telephone was held; editors mirror by it. All eight ways.
TEST_F(VideoPlayers, AClipIsTurnedUpright) {
    const Path file = folder / "turned.mp4";
    cv::Mat cornerBright(32, 96, CV_8UC3, cv::Scalar::all(20));
    cornerBright(cv::Rect(0, 0, 48, 16)) = cv::Scalar::all(220);
    writeFilm(file, "mp4v", 3, [&](int) { return cornerBright; });
    // Row by row a b u, c d v, x y w; of 16.16 bits, the last column of 2.30 (ISO/IEC 14496-12, 8.3.2).
    const auto matrix = [](const std::array<int, 4>& m) {
        std::string bytes;
        for (const int value : {m[0] << 16, m[1] << 16, 0, m[2] << 16, m[3] << 16, 0, 0, 0, 1 << 30})
            bytes += number(static_cast<uint32_t>(value), 4, false);
        return bytes;
    };
    const std::string upright = readBytes(file);
    const size_t at = upright.find(matrix({1, 0, 0, 1}), upright.find("tkhd"));
    ASSERT_NE(at, std::string::npos);
    // A point (p, q) is shown at (a p + c q, b p + d q), so the corner is where both are least.
    for (const std::array<int, 4>& m : {std::array{1, 0, 0, 1},
                                        {-1, 0, 0, 1},
                                        {-1, 0, 0, -1},
                                        {1, 0, 0, -1},
                                        {0, 1, 1, 0},
                                        {0, 1, -1, 0},
                                        {0, -1, -1, 0},
                                        {0, -1, 1, 0}}) {
        SCOPED_TRACE(fmt::format("{}", fmt::join(m, " ")));
        std::string turned = upright;
        writeBytes(file, turned.replace(at, 36, matrix(m)));
        auto player = opened(file, {.keepPlanes = true});
        const bool isUpright = m == std::array{1, 0, 0, 1};
        EXPECT_EQ(player.waitFor(0)->planes.codes[0] != nullptr, isUpright);
        const std::string checked = tests::valueOf(checkVideo(file));
        EXPECT_EQ(checked.find("turned upright") == checked.npos, isUpright) << checked;
        EXPECT_THAT(checked,
                    testing::AllOf(testing::HasSubstr(", 0.1 s, "), testing::HasSubstr("; has no sound")));
        const ImageRgb8& picture = player.waitFor(0)->pixelsBgr;
        ASSERT_EQ(std::pair(picture.width, picture.height), m[0] ? std::pair(96, 32) : std::pair(32, 96));
        const bool right = m[0] + m[2] < 0, below = m[1] + m[3] < 0;
        for (const bool x : {false, true})
            for (const bool y : {false, true})
                EXPECT_EQ(*picture.at(picture.width / 4 * (x ? 3 : 1), picture.height / 4 * (y ? 3 : 1)) >
                              180,
                          x == right && y == below);
    }
}

// Copies a film into a Matroska file whose pictures have these times, and whose header states a mean rate.
void writeTimes(const Path& from, const Path& to, const std::vector<int>& times_ms, AVRational rate,
                AVFieldOrder order = AV_FIELD_UNKNOWN) {
    const Input in = openInput(from);
    AVFormatContext* out = nullptr;
    ASSERT_GE(avformat_alloc_output_context2(&out, nullptr, "matroska", to.c_str()), 0);
    AVStream& stream = *avformat_new_stream(out, nullptr);
    ASSERT_GE(avcodec_parameters_copy(stream.codecpar, in->streams[0]->codecpar), 0);
    stream.codecpar->codec_tag = 0;
    stream.codecpar->field_order = order;
    stream.time_base = {1, 1000};
    stream.avg_frame_rate = rate;
    ASSERT_GE(avio_open(&out->pb, to.c_str(), AVIO_FLAG_WRITE), 0);
    ASSERT_GE(avformat_write_header(out, nullptr), 0);
    const Packet packet = makePacket();
    for (const int time_ms : times_ms) {
        ASSERT_GE(av_read_frame(in.get(), packet.get()), 0);
        packet->pts = packet->dts = time_ms;
        packet->duration = 0;
        ASSERT_GE(av_write_frame(out, packet.get()), 0);
    }
    av_write_trailer(out);
    avio_closep(&out->pb);
    avformat_free_context(out);
}

// Dense at first, then sparse; a picture that lasts; pictures of five seconds; from 23 ms on.
TEST_F(VideoPlayers, ThePictureThatIsDueIsShown) {
    writeGreyVideo(folder / "grey.avi", 20);
    const Path file = folder / "times.mkv";
    const struct {
        std::vector<int> times_ms;
        AVRational rate;
        int step_ms; // of the times that are asked for
    } kFilms[] = {{{0, 40, 80, 120, 160, 200, 400, 600, 800, 1000, 1200}, {8, 1}, 40},
                  {{23, 56, 90, 123, 156, 1023, 1056, 1090}, {15, 2}, 100},
                  {{0, 5000, 10000, 15000}, {1, 5}, 1000},
                  {{0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30}, {500, 1}, 100}};
    for (const auto& film : kFilms) {
        writeTimes(folder / "grey.avi", file, film.times_ms, film.rate);
        const auto due = [&](int time_ms) {
            const auto after = std::ranges::upper_bound(film.times_ms, time_ms + film.times_ms.front());
            return static_cast<int>(after - film.times_ms.begin()) - 1;
        };
        const int length_ms = film.times_ms.back() - film.times_ms.front();
        auto player = opened(file);
        for (int time_ms = 0; time_ms <= length_ms; time_ms += film.step_ms) // in order
            EXPECT_EQ(numberOf(player.waitFor(time_ms * 1e-3 + 1e-4)->pixelsBgr), due(time_ms)) << time_ms;
        auto jumper = opened(file);
        for (int time_ms = length_ms; time_ms >= 0; time_ms -= film.step_ms)
            EXPECT_EQ(numberOf(jumper.waitFor(time_ms * 1e-3 + 1e-4)->pixelsBgr), due(time_ms)) << time_ms;
        EXPECT_EQ(player.status() + jumper.status(), "");
        const auto check = tests::valueOf(checkVideo(file));
        EXPECT_NE(check.find(fmt::format(" {:.4g} frames/s", av_q2d(film.rate))), std::string::npos) << check;
    }
}

// Fields of one frame may have stamps of their own, but they are one picture.
TEST_F(VideoPlayers, InterlacedFilmsHaveTheRateThatTheyState) {
    writeGreyVideo(folder / "grey.avi", 6);
    for (const auto& [order, fps] : {std::pair(AV_FIELD_PROGRESSIVE, 50.0), {AV_FIELD_TT, 25.0}}) {
        writeTimes(folder / "grey.avi", folder / "fields.mkv", {0, 20, 40, 60, 80, 100}, {25, 1}, order);
        EXPECT_NEAR(opened(folder / "fields.mkv").info().fps, fps, 0.01) << order;
    }
}

// FFmpeg's own writer gives each track one edit: version, flags, count, then duration, media time and rate.
TEST_F(VideoPlayers, AnEditListGivesTheLengthShown) {
    const Path file = folder / "edited.mp4";
    writeFilm(file, "mp4v", 30, [](int) { return cv::Mat(32, 64, CV_8UC3, cv::Scalar::all(99)); });
    EXPECT_EQ(opened(file).info().frameCount, 30);
    std::string bytes = readBytes(file);
    const size_t at = bytes.find("elst") + 12;
    ASSERT_LT(at, bytes.size());
    ASSERT_EQ(bytes.substr(at, 4), number(1000, 4, false)) << "thousandths of a second";
    writeBytes(file, bytes.replace(at, 4, number(500, 4, false)));
    EXPECT_EQ(opened(file).info().frameCount, 15);
}

// The file is refused by its header alone, before a decoder reads it.
TEST_F(VideoPlayers, RefusesWhatStatesAPictureTooLarge) {
    const Path file = folder / "grey.avi";
    writeGreyVideo(file, 1);
    std::string bytes = readBytes(file);
    const size_t format = bytes.find("strf");
    ASSERT_NE(format, std::string::npos);
    // BITMAPINFOHEADER behind name and size: its size, width, height; little endian.
    bytes.replace(format + 12, 8, std::string("\x30\x75\0\0\x30\x75\0\0", 8));
    writeBytes(file, bytes);
    EXPECT_THAT(tests::errorOf(VideoPlayer::open(file)).reason, testing::HasSubstr("30000x30000"));
}

// Seeks to what the index names. Returns how many key frames there are. reordered: pictures come so many
// frames later in the file than they are shown.
int64_t checkKeyFrames(const Path& file, int reordered = 0) {
    auto source = tests::valueOf(VideoSource::open(file, Layout::Mono));
    EXPECT_TRUE(source.grab());
    int64_t keyFrames = 0;
    for (int64_t number = source.info().frameCount - 20; number > 0; ++keyFrames) {
        const int64_t key = source.keyFrameBefore(number);
        EXPECT_LE(key, number);
        EXPECT_EQ(source.keyFrameBefore(key), key);
        EXPECT_TRUE(source.seek(key));
        EXPECT_NEAR(static_cast<double>(source.position()), static_cast<double>(key), 2 * reordered)
            << number;
        number = std::min(key, source.position()) - 1;
    }
    return keyFrames;
}

TEST_F(VideoPlayers, TheIndexTellsKeyFrames) {
    const Path file = folder / "film.mp4";
    writeFilm(file, "mp4v", 100, [](int) { return cv::Mat(32, 64, CV_8UC3, cv::Scalar::all(99)); });
    EXPECT_EQ(checkKeyFrames(file), 7) << "one in 12 of the first 80";
    writeGreyVideo(folder / "grey.avi", 40);
    EXPECT_EQ(checkKeyFrames(folder / "grey.avi"), 20) << "all";
}

TEST_F(VideoPlayers, EndsWhileBusy) {
    for (int i = 0; i < 20; ++i) greyFilm(40).newest(i);
}

TEST_F(VideoPlayers, RefusesWhatIsNoVideo) {
    writeBytes(folder / "empty.mp4", "");
    writeBytes(folder / "text.mp4", "#EXTM3U\nhttp://localhost/x.ts\n");
    writeBytes(folder / "head.mp4", std::string("\0\0\0\x18"
                                                "ftypisom\0\0\0\0isommp42",
                                                24));
    ASSERT_EQ(::mkfifo((folder / "pipe.mp4").c_str(), 0600), 0);
    std::filesystem::create_directory(folder / "folder.mp4");
    for (const char* name : {"empty.mp4", "text.mp4", "head.mp4", "pipe.mp4", "folder.mp4", "missing.mp4"}) {
        const Error error = tests::errorOf(VideoPlayer::open(folder / name));
        EXPECT_THAT(error.message(), testing::HasSubstr(name));
        EXPECT_NE(error.reason, "") << name;
    }
}

struct Facts {
    const char* name;
    int width, height;
    double fps;
    int frames;
    Layout layout;
};

void PrintTo(const Facts& facts, std::ostream* stream) { *stream << facts.name; }

class SharedVideo : public testing::TestWithParam<Facts> {
  protected:
    void SetUp() override {
        file = sharedData(std::string("video/") + GetParam().name);
        if (file.empty()) GTEST_SKIP() << "no shared video/" << GetParam().name;
    }
    Path file;
};

uint64_t hashOf(const ImageRgb8& picture) {
    Hash hash;
    hash.bytes(picture.pixels.data(), picture.pixels.size());
    return hash.value();
}

TEST_P(SharedVideo, HasItsFacts) {
    const Facts& facts = GetParam();
    const auto player = tests::valueOf(VideoPlayer::open(file));
    const VideoInfo& info = player.info();
    EXPECT_EQ(info.width, facts.width);
    EXPECT_EQ(info.height, facts.height);
    EXPECT_NEAR(info.fps, facts.fps, 0.005); // stated to two decimals
    EXPECT_EQ(info.codec, "h264");
    EXPECT_EQ(info.layout, facts.layout) << info.layoutSource;
    EXPECT_NEAR(static_cast<double>(info.frameCount), facts.frames, 0.01 * facts.frames);
    EXPECT_TRUE(tests::succeeded(checkVideo(file)));
}

TEST_P(SharedVideo, TellsItsKeyFrames) {
    const bool isInFragments = GetParam().frames > 1000; // which have no index before they are read
    EXPECT_TRUE(isInFragments || checkKeyFrames(file, 1) > 0);
}

// A decoder that hurries leaves pictures out, but counts the same frames.
TEST_P(SharedVideo, HurriesToItsEnd) {
    auto source = tests::valueOf(VideoSource::open(file, Layout::Mono));
    while (source.grab(true)) {
    }
    EXPECT_EQ(source.position(), GetParam().frames);
}

// Played in order, over the loop; then the same pictures by jumps in a fresh player.
TEST_P(SharedVideo, PlaysAndSeeksAlike) {
    const Facts& facts = GetParam();
    auto player = tests::valueOf(VideoPlayer::open(file));
    const double fps = player.info().fps;
    const int played = facts.frames + 5;
    std::vector<uint64_t> hashes;
    int64_t passLength = 0;
    for (int i = 0; i < played; ++i) {
        const VideoFrame* frame = player.waitFor(i / fps);
        ASSERT_EQ(frame->index, i);
        if (i > 0 && frame->number == 0) passLength = i;
        hashes.push_back(hashOf(frame->pixelsBgr));
    }
    EXPECT_EQ(player.status(), "");
    ASSERT_EQ(passLength, facts.frames);
    for (int i = facts.frames; i < played; ++i) EXPECT_EQ(hashes[i], hashes[i - facts.frames]);

    auto jumper = std::move(VideoPlayer::open(file)).value();
    for (const int index : {facts.frames - 1, 7, facts.frames / 2, facts.frames * 3 + 11, 1})
        EXPECT_EQ(hashOf(jumper.waitFor(index / fps)->pixelsBgr), hashes[index % facts.frames]) << index;
}

INSTANTIATE_TEST_SUITE_P(
    Files, SharedVideo,
    testing::Values(Facts{"overpass_360_mono_2048x1024.mp4", 2048, 1024, 29.97, 120, Layout::Mono},
                    Facts{"congo_360_overunder_1920x1080.mp4", 1920, 1080, 917425.0 / 30618, 300,
                          Layout::TopBottom},
                    Facts{"richo_360_mono_426x214.mp4", 426, 214, 30, 1202, Layout::Mono}));

// Squeezes a picture to 2:1 by leaving rows out.
ImageRgb8 squeezed(const ImageRgb8& picture) {
    ImageRgb8 out(picture.width, picture.width / 2);
    for (int y = 0; y < out.height; ++y)
        std::copy_n(picture.at(0, y * picture.height / out.height), 3 * out.width, out.at(0, y));
    return out;
}

TEST(SharedVideos, SqueezedStereoIsFoundByContent) {
    const Path file = sharedData("video/congo_360_overunder_1920x1080.mp4");
    if (file.empty()) GTEST_SKIP() << "no shared video/congo_360_overunder_1920x1080.mp4";
    auto player = tests::valueOf(VideoPlayer::open(file));
    for (const double at_s : {0.0, 3.0, 6.0})
        EXPECT_EQ(layoutOf(squeezed(player.waitFor(at_s)->pixelsBgr)), Layout::TopBottom) << at_s;
}

// Rooms and landscapes of one eye, one of them a room whose opposite walls are alike.
TEST(SharedHdrs, AreMonoByContent) {
    for (const char* name : {"fidelity/lightroom_14b_1k.hdr", "fidelity/aircraft_workshop_01_1k.hdr",
                             "hdr/studio_small_03_1k.hdr", "hdr/st_fagans_interior_1k.hdr"}) {
        const Path file = sharedData(name);
        if (file.empty()) GTEST_SKIP() << "no shared " << name;
        const auto picture = tests::valueOf(readHdr(file));
        ImageRgb8 coded(picture.radianceLin.width, picture.radianceLin.height);
        for (size_t i = 0; i < coded.pixels.size(); ++i)
            coded.pixels[i] =
                static_cast<uint8_t>(255 * std::sqrt(std::clamp(picture.radianceLin.pixels[i], 0.0f, 1.0f)));
        EXPECT_EQ(layoutOf(coded), Layout::Mono) << name;
    }
}

TEST(SharedPhotos, HaveTheirFactsAndLayout) {
    const struct {
        const char* name;
        int width, height;
        Layout layout;
    } kFacts[] = {{"coral_underwater_360_overunder_2048.jpg", 2048, 2048, Layout::TopBottom},
                  {"petra_360_2048x1024.jpg", 2048, 1024, Layout::Mono},
                  {"puydesancy_360_4096x2048.jpg", 4096, 2048, Layout::Mono}};
    for (const auto& facts : kFacts) {
        const Path file = sharedData(std::string("photo/") + facts.name);
        if (file.empty()) GTEST_SKIP() << "no shared photo/" << facts.name;
        const auto picture = tests::valueOf(readPicture(file));
        EXPECT_EQ(picture.width, facts.width);
        EXPECT_EQ(picture.height, facts.height);
        EXPECT_EQ(layoutFromShape(picture.width, picture.height), facts.layout);
        EXPECT_EQ(layoutFromContent(picture), facts.layout) << facts.name;
        EXPECT_EQ(layoutOf(squeezed(picture)), facts.layout) << facts.name;
    }
}

} // namespace
} // namespace shoal::media
