// Depth tracks are read as they were written, or refused.
#include "content/make/depth/DepthTrackWriter.h"
#include "engine/core/Random.h"
#include "engine/media/Check.h"
#include "tests/unit/media/TestFiles.h"

namespace shoal::media {
namespace {

// Returns a frame of slopes and noise, a different one for each number.
DepthFrame frameOf(int number, int width) {
    Random random(static_cast<uint32_t>(number));
    DepthFrame frame{width, width / 2, {}, {}};
    for (int i = 0; i < width * width / 2; ++i)
        frame.inverse.push_back(
            static_cast<uint16_t>((i + 7 * number + random.below(9)) % (kMaxDepthCode + 1)));
    for (int i = 0; i < width * width / 8; ++i)
        frame.confidence.push_back(static_cast<uint16_t>(random.below(kMaxDepthCode + 1)));
    return frame;
}

Status write(const Path& file, const DepthTrackInfo& info, const std::vector<std::string>& films = {}) {
    auto writer = DepthTrackWriter::make(info, films);
    if (!writer) return writer.error();
    for (int i = 0; i < info.frameCount; ++i)
        if (Status added = writer->add(frameOf(i, info.width)); !added) return added;
    return writer->finish(file);
}

bool same(const DepthFrame& a, const DepthFrame& b) {
    return a.width == b.width && a.height == b.height && a.inverse == b.inverse &&
           a.confidence == b.confidence;
}

constexpr DepthTrackInfo kSmall{32, 16, 9, 0.75};

class DepthTracks : public testing::Test {
  protected:
    // Replaces a text in the file by another of the same length.
    void replace(const std::string& from, const std::string& to) {
        std::string bytes = readBytes(file_);
        const size_t at = bytes.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        bytes.replace(at, from.size(), to);
        writeBytes(file_, bytes);
    }
    std::string reason(const Path& film = {}) const {
        const auto track = DepthTrack::open(file_, film);
        return track ? "" : track.error().reason;
    }

    TempFolder folder_;
    Path file_ = folder_ / "film.depth.mkv";
};

// 512 around FFmpeg cuts frames into four slices; up to 256 they are one.
TEST_F(DepthTracks, ComeBackAsTheyWereInAnyOrder) {
    for (const int width : {16, 256, 512}) {
        SCOPED_TRACE(width);
        const DepthTrackInfo info{width, width / 2, 50, 50 / 12.0};
        ASSERT_TRUE(write(file_, info));
        auto track = tests::valueOf(DepthTrack::open(file_));
        EXPECT_EQ(track.info().width, width);
        EXPECT_EQ(track.info().height, width / 2);
        EXPECT_EQ(track.info().frameCount, 50);
        EXPECT_EQ(track.info().duration_s, 50 / 12.0);
        DepthFrame frame;
        for (const int number : {0, 1, 2, 40, 49, 0, 7, 3, 49, 48}) {
            ASSERT_TRUE(track.read(number, frame)) << number;
            EXPECT_TRUE(same(frame, frameOf(number, width))) << number;
        }
        EXPECT_FALSE(track.read(-1, frame));
        EXPECT_FALSE(track.read(50, frame));
        EXPECT_TRUE(same(frame, frameOf(48, width))) << "stays as it was";
    }
}

TEST_F(DepthTracks, WriteTheSameBytesEachTime) {
    ASSERT_TRUE(write(file_, kSmall));
    const std::string bytes = readBytes(file_);
    ASSERT_TRUE(write(file_, kSmall));
    EXPECT_EQ(readBytes(file_), bytes);
}

// Stamps are whole milliseconds: each frame is found at rates that do not divide them.
TEST_F(DepthTracks, FindEachFrameAtEveryRate) {
    for (const double rate : {0.1, 1.0, 12.0, 24000 / 1001.0, 30000 / 1001.0, 60000 / 1001.0, 240.0}) {
        SCOPED_TRACE(rate);
        const int count = 300;
        ASSERT_TRUE(write(file_, {16, 8, count, count / rate}));
        auto track = tests::valueOf(DepthTrack::open(file_));
        DepthFrame frame;
        for (const int number : {299, 0, 1, 100, 298, 33, 34}) {
            ASSERT_TRUE(track.read(number, frame)) << number;
            EXPECT_TRUE(same(frame, frameOf(number, 16))) << number;
            EXPECT_EQ(track.frameAt(number / rate), number);
        }
    }
}

// Twelve a second for a film of 24: of two as near the later, which at the film's end is its beginning.
TEST_F(DepthTracks, FrameAtIsTheNearestAroundTheJoint) {
    ASSERT_TRUE(write(file_, {16, 8, 24, 2}));
    const auto track = tests::valueOf(DepthTrack::open(file_));
    EXPECT_EQ(track.frameAt(0), 0);
    EXPECT_EQ(track.frameAt(0.04), 0);
    EXPECT_EQ(track.frameAt(0.042), 1);
    EXPECT_EQ(track.frameAt(1), 12);
    EXPECT_EQ(track.frameAt(1.95), 23);
    EXPECT_EQ(track.frameAt(1.96), 0);
    EXPECT_EQ(track.frameAt(2), 0);
    EXPECT_EQ(track.frameAt(2000.5), 6);
    EXPECT_EQ(track.frameAt(-0.5), 18);
}

TEST_F(DepthTracks, BelongToTheVersionsOfAFilm) {
    writeBytes(folder_ / "film.mp4", std::string(5000, 'a'));
    writeBytes(folder_ / "film.small.mp4", std::string(3000, 'b'));
    writeBytes(folder_ / "other.mp4", std::string(5000, 'c'));
    EXPECT_EQ(depthTrackOf(folder_ / "film.mp4"), file_);
    EXPECT_EQ(depthTrackOf(folder_ / "film.small.mp4"), file_);
    EXPECT_EQ(depthTrackOf("a/dive.one.webm"), Path("a/dive.one.depth.mkv"));
    std::vector<std::string> films;
    for (const char* name : {"film.mp4", "film.small.mp4"}) films.push_back(*filmIdentity(folder_ / name));
    EXPECT_NE(films[0], films[1]);
    ASSERT_TRUE(write(file_, kSmall, films));
    EXPECT_EQ(reason(), "");
    EXPECT_EQ(reason(folder_ / "film.mp4"), "");
    EXPECT_EQ(reason(folder_ / "film.small.mp4"), "");
    EXPECT_EQ(reason(folder_ / "other.mp4"), "is the depth of another film");
    EXPECT_NE(reason(folder_ / "none.mp4"), "");
}

// The identity is of the first megabyte: FNV-1a of "a" is af63dc4c8601ec8c.
TEST_F(DepthTracks, TellFilmsByTheirBeginning) {
    writeBytes(folder_ / "a", "a");
    EXPECT_EQ(*filmIdentity(folder_ / "a"), "af63dc4c8601ec8c");
    std::string bytes(3 << 20, 'x');
    writeBytes(folder_ / "a", bytes);
    const std::string before = *filmIdentity(folder_ / "a");
    bytes[1 << 20] = 'y';
    writeBytes(folder_ / "a", bytes);
    EXPECT_EQ(*filmIdentity(folder_ / "a"), before);
    bytes[(1 << 20) - 1] = 'y';
    writeBytes(folder_ / "a", bytes);
    EXPECT_NE(*filmIdentity(folder_ / "a"), before);
}

TEST_F(DepthTracks, TracksOfAnotherKindAreRefused) {
    const std::string another = "is a depth track of another version";
    EXPECT_NE(reason(), ""); // there is none
    ASSERT_TRUE(write(file_, kSmall));
    replace("equirectangular mono", "equirectangular side");
    EXPECT_EQ(reason(), another);
    ASSERT_TRUE(write(file_, kSmall));
    replace("SHOAL_DEPTH", "OTHER_DEPTH");
    EXPECT_EQ(reason(), "is no depth track");
    writeBytes(file_, "no Matroska at all");
    EXPECT_EQ(reason(), "is no depth track");
    writeGreyVideo(folder_ / "grey.avi", 3);
    std::filesystem::rename(folder_ / "grey.avi", file_);
    EXPECT_EQ(reason(), "is no depth track");
}

// Width and height as Matroska codes them: one byte 0xb0 or 0xba, the length of the number, the number.
TEST_F(DepthTracks, TracksOfAnotherSizeAreRefused) {
    ASSERT_TRUE(write(file_, {64, 32, 3, 0.25}));
    const std::string good = readBytes(file_);
    const size_t width = good.find("\xb0\x81\x40"), height = good.find("\xba\x81\x20");
    ASSERT_NE(width, std::string::npos);
    ASSERT_NE(height, std::string::npos);
    for (const auto& [across, down, why] :
         {std::tuple(64, 64, "no half"), {48, 24, "no power of two"}, {8, 4, "too small"}}) {
        std::string bad = good;
        bad[width + 2] = static_cast<char>(across);
        bad[height + 2] = static_cast<char>(down);
        writeBytes(file_, bad);
        EXPECT_EQ(reason(), "is damaged: its header makes no sense") << why;
    }
    // A header of a larger track before smaller frames: what the packets hold decides, and is refused.
    std::string bad = good;
    bad[width + 2] = 32, bad[height + 2] = 16;
    writeBytes(file_, bad);
    auto track = DepthTrack::open(file_);
    DepthFrame frame;
    if (track) {
        EXPECT_TRUE(!track->read(0, frame) || frame.inverse.size() == 32u * 16);
    }
}

TEST_F(DepthTracks, TracksOfImpossibleLengthsAreNotWritten) {
    EXPECT_FALSE(DepthTrackWriter::make({256, 128, 0, 1}, {}));
    EXPECT_FALSE(DepthTrackWriter::make({256, 128, 10, 0}, {}));
    EXPECT_FALSE(DepthTrackWriter::make({256, 128, 10, std::nan("")}, {}));
    EXPECT_FALSE(DepthTrackWriter::make({256, 128, 10, 1e7}, {}));
    EXPECT_FALSE(DepthTrackWriter::make({256, 128, 241, 1}, {})) << "more than stamps can tell apart";
    EXPECT_FALSE(DepthTrackWriter::make({256, 100, 10, 1}, {}));
    EXPECT_FALSE(DepthTrackWriter::make({300, 150, 10, 1}, {}));
    EXPECT_FALSE(DepthTrackWriter::make({8192, 4096, 10, 1}, {}));
    EXPECT_FALSE(DepthTrackWriter::make({16, std::numeric_limits<int>::min() + 8, 10, 1}, {}))
        << "twice it is 16";
    auto writer = tests::valueOf(DepthTrackWriter::make(kSmall, {}));
    EXPECT_FALSE(writer.add(frameOf(0, 16)));
    EXPECT_FALSE(writer.add({32, 16, std::vector<uint16_t>(32 * 16), {}})) << "no confidence";
    EXPECT_TRUE(writer.add(frameOf(0, 32)));
    EXPECT_FALSE(writer.finish(file_)) << "frames are missing";
    EXPECT_FALSE(std::filesystem::exists(file_));
}

// A file that is cut gives an error or all frames: behind the last frame lies only the table of contents.
TEST_F(DepthTracks, CutAnywhereGiveAnErrorOrAllFrames) {
    ASSERT_TRUE(write(file_, kSmall));
    const std::string good = readBytes(file_);
    size_t whole = 0;
    for (size_t length = 0; length < good.size(); length += 3) {
        writeBytes(file_, good.substr(0, length));
        auto track = DepthTrack::open(file_);
        if (!track) continue;
        ++whole;
        DepthFrame frame;
        for (int i = 0; i < kSmall.frameCount; ++i)
            EXPECT_TRUE(track->read(i, frame) && same(frame, frameOf(i, kSmall.width))) << length << " " << i;
    }
    EXPECT_LT(whole * 3, good.size() / 8);
}

// With any byte damaged, a frame that is read is one of the original frames.
TEST_F(DepthTracks, DamagedGiveNoWrongFrames) {
    ASSERT_TRUE(write(file_, kSmall));
    const std::string good = readBytes(file_);
    std::vector<DepthFrame> frames;
    for (int i = 0; i < kSmall.frameCount; ++i) frames.push_back(frameOf(i, kSmall.width));
    int missing = 0;
    for (size_t at = 0; at < good.size(); at += 11) {
        std::string bad = good;
        bad[at] = static_cast<char>(bad[at] ^ (1 << at % 8));
        writeBytes(file_, bad);
        auto track = DepthTrack::open(file_);
        if (!track) continue;
        DepthFrame frame;
        for (int i = 0; i < track->info().frameCount && i < kSmall.frameCount; ++i) {
            if (!track->read(i, frame)) {
                ++missing;
                continue;
            }
            EXPECT_TRUE(
                std::ranges::any_of(frames, [&](const DepthFrame& each) { return same(each, frame); }))
                << "byte " << at << ", frame " << i;
        }
    }
    EXPECT_GT(missing, 100) << "most bytes are frames";
}

// Half a step: 1 / 32 of a value at 16 steps an octave; half a code where steps are codes.
TEST_F(DepthTracks, CodesAreWithinHalfAStep) {
    constexpr float kCode_perM = kMaxInverse_perM / kMaxDepthCode;
    for (const int steps : {8, 16, 32, kExactDepthSteps})
        for (float inverse = 0; inverse <= kMaxInverse_perM; inverse += 0.00037f) {
            const float back = depthCode(inverse, steps) * kCode_perM;
            const float tolerance = kCode_perM * 0.501f +
                                    (steps == kExactDepthSteps ? 0 : inverse / static_cast<float>(2 * steps));
            ASSERT_NEAR(back, inverse, tolerance) << steps;
        }
    EXPECT_EQ(depthCode(0), 0);
    EXPECT_EQ(depthCode(-1), 0);
    EXPECT_EQ(depthCode(std::nanf("")), 0);
    EXPECT_EQ(depthCode(1e9f), kMaxDepthCode);
}

TEST_F(DepthTracks, CheckSaysWhatTheyAre) {
    auto writer = DepthTrackWriter::make({16, 8, 2, 4}, {});
    DepthFrame frame{16, 8, std::vector<uint16_t>(128, uint16_t{100}),
                     std::vector<uint16_t>(32, kMaxDepthCode)};
    frame.inverse[5] = 512;
    ASSERT_TRUE(writer && writer->add(frame));
    std::ranges::fill(frame.confidence, uint16_t{0});
    ASSERT_TRUE(writer->add(frame) && writer->finish(file_));
    const auto said = tests::valueOf(checkDepthTrack(file_));
    EXPECT_EQ(said, "16x8 depth track, 0.5 frames/s, 4.0 s, nearest 0.50 m, mean confidence 50 %");

    ASSERT_TRUE(write(file_, kSmall));
    std::string bad = readBytes(file_);
    bad[bad.size() / 2] ^= 1; // within a frame
    writeBytes(file_, bad);
    EXPECT_EQ(tests::errorOf(checkDepthTrack(file_)).reason, "is damaged: 8 of 9 frames can be decoded");
}

TEST_F(DepthTracks, CheckOfAFilmSaysWhatLiesBesideIt) {
    const Path film = folder_ / "film.avi";
    writeGreyVideo(film, 10);
    const auto said = [&] {
        const auto checked = checkVideo(film);
        return checked ? *checked : checked.error().reason;
    };
    EXPECT_EQ(said().find("depth"), std::string::npos) << said();
    ASSERT_TRUE(write(file_, kSmall, {*filmIdentity(film)}));
    EXPECT_TRUE(said().ends_with("; with depth, 32x16")) << said();
    ASSERT_TRUE(write(file_, kSmall, {std::string(16, '0')}));
    EXPECT_TRUE(said().ends_with("; without depth, because film.depth.mkv is the depth of another film"))
        << said();
}

} // namespace
} // namespace shoal::media
