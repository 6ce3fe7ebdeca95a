// Whole films of a room of known size.
#include "content/make/depth/FilmDepth.h"

#include "tests/unit/content_depth/TestRoom.h"
#include "tests/unit/media/TestFiles.h"

#include "engine/media/DepthTrack.h"

#include <opencv2/imgproc.hpp>

namespace shoal::depth {
namespace {

namespace fs = std::filesystem;
constexpr int kFrames = 8;

class FilmDepths : public testing::Test {
  protected:
    // Writes a film 256 pixels around, whose camera moves by pace_m each frame. gain: factor of all light;
    // noise: standard deviation of each pixel, grey values.
    void film(const glm::vec3& pace_m, double gain = 1, double noise = 0) {
        cv::RNG random(7);
        cv::VideoWriter writer(film_.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                               24, {256, 128});
        ASSERT_TRUE(writer.isOpened());
        for (int i = 0; i < kFrames; ++i) {
            ImageRgb8 picture = TestRoom().seen(pace_m * static_cast<float>(i - kFrames / 2), 1024);
            const cv::Mat large(picture.height, picture.width, CV_8UC3, picture.pixels.data());
            cv::Mat small;
            cv::resize(large, small, {256, 128}, 0, 0, cv::INTER_AREA);
            cv::Mat sensor(128, 256, CV_32F), filmed;
            random.fill(sensor, cv::RNG::NORMAL, 0, noise);
            cv::cvtColor(sensor, sensor, cv::COLOR_GRAY2BGR);
            small.convertTo(filmed, CV_32F, gain);
            cv::Mat(filmed + sensor).convertTo(small, CV_8U);
            writer.write(small);
        }
    }

    Result<FilmDepth> make(const FilmDepthOptions& options = {}) {
        return makeFilmDepth(film_, out_, options);
    }

    media::TempFolder folder_;
    Path film_ = folder_ / "film.avi", out_ = folder_ / "film.depth.mkv",
         part_ = folder_ / "film.depth.mkv.part";
};

struct Interrupted {};

// Ends the run by an exception after that many of its reports, as if the program had been killed.
FilmDepthOptions interruptedAfter(int reports) {
    FilmDepthOptions options;
    options.progress = [reports, count = 0](double) mutable {
        if (++count == reports) throw Interrupted{};
    };
    return options;
}

} // namespace

// The film's texture has a deviation of a grey value or two, like its noise: enough to find a movement, but
// hardly any distance that several frames agree on.
TEST_F(FilmDepths, AFilmDarkerThanItsNoiseIsNotKnownAndWritesNothing) {
    film({0.04f, 0, 0}, 0.05, 1.5);
    int reports = 0;
    FilmDepthOptions options;
    options.preview = folder_ / "film.png";
    options.progress = [&](double) { ++reports; };
    const auto made = make(options);
    ASSERT_TRUE(made) << made.error().message();
    EXPECT_EQ(*made, FilmDepth::CannotBeKnown);
    EXPECT_EQ(reports, 2 * kFrames / 2) << "a movement was found";
    for (const Path& file : {out_, part_, options.preview}) EXPECT_FALSE(fs::exists(file)) << file;
}

// The run is interrupted in either pass, and in the middle of a record.
TEST_F(FilmDepths, AnInterruptedRunGoesOnToTheSameTrack) {
    film({0.04f, 0, 0});
    const auto made = make();
    ASSERT_TRUE(made) << made.error().message();
    ASSERT_EQ(*made, FilmDepth::Written);
    EXPECT_FALSE(fs::exists(part_));
    const std::string whole = media::readBytes(out_);
    fs::remove(out_);
    for (const int reports : {3, 6}) {
        EXPECT_THROW((void)make(interruptedAfter(reports)), Interrupted);
        EXPECT_FALSE(fs::exists(out_));
        fs::resize_file(part_, fs::file_size(part_) - 1000); // half of the last record
        int more = 0;
        FilmDepthOptions counting;
        counting.progress = [&](double) { ++more; };
        ASSERT_TRUE(make(counting));
        EXPECT_EQ(more, 2 * kFrames / 2 - (reports - 1)) << "what is there is not made again";
        EXPECT_FALSE(fs::exists(part_));
        EXPECT_TRUE(media::readBytes(out_) == whole);
        fs::remove(out_);
    }
}

// Records of other options would be mixed with the new ones.
TEST_F(FilmDepths, RecordsOfOtherOptionsAreNotUsed) {
    film({0.04f, 0, 0});
    EXPECT_THROW((void)make(interruptedAfter(3)), Interrupted);
    int reports = 0;
    FilmDepthOptions other;
    other.height_m = 2;
    other.progress = [&](double) { ++reports; };
    ASSERT_TRUE(make(other));
    EXPECT_EQ(reports, 2 * kFrames / 2);
}

} // namespace shoal::depth
