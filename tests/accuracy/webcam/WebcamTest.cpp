// Clips of hands before a webcam, through the tracker and through the program. LandmarksTest.cpp has how well
// hands are found.
#include "HandClip.h"
#include "engine/core/WriteFile.h"
#include "engine/sim/Recording.h"
#include "game/rules/Dive.h"
#include "input/hands/HandTracker.h"
#include "input/hands/webcam/landmarks/LandmarkFinder.h"
#include "tests/Recorded.h"
#include "tests/Test.h"
#include "tests/TestRig.h"

#include <opencv2/videoio.hpp>

#include <chrono>
#include <thread>

namespace shoal::hands {
namespace {

using test::HandClip;
using test::Shown;

constexpr double kRate_Hz = 30;

using tests::rig;

using Moment = std::array<std::optional<Shown>, 2>;

// Returns the clip's moments: a right hand, then both, at several places; a gesture lasts half a second.
std::vector<Moment> session() {
    std::vector<Moment> moments;
    for (int part = 0; part < 12; ++part)
        for (int i = 0; i < 15; ++i) {
            const float t = static_cast<float>(part * 15 + i) / 180;
            Moment m;
            const auto gesture = static_cast<Gesture>((part + part / 3) % 3);
            const bool two = part >= 6;
            m[1] = Shown{{two ? -0.14f : -0.12f + 0.2f * t, 0.05f * std::sin(9 * t) - 0.02f,
                          -0.5f + 0.10f * std::cos(7 * t)},
                         gesture,
                         0.25f * std::sin(11 * t),
                         0.15f * std::sin(5 * t)};
            if (two)
                m[0] = Shown{{0.13f, 0.05f * std::cos(8 * t) - 0.02f, -0.47f + 0.06f * std::sin(6 * t)},
                             static_cast<Gesture>((part + 1) % 3),
                             0.2f * std::cos(9 * t),
                             0.1f};
            moments.push_back(m);
        }
    return moments;
}

// An encoded clip that goes through the tracker's own thread and through the program.
class WebcamClip : public testing::Test {
  protected:
    tests::ScratchFolder folder_;
    static Path clipFile() { return tests::cacheFolder() / "webcam_gestures.avi"; }
    const size_t frames_ = session().size();

    void SetUp() override {
        if (const auto finder = LandmarkFinder::load(handModelFolder(), rig()); !finder)
            GTEST_SKIP() << finder.error().message();
        if (std::filesystem::exists(clipFile())) return;
        std::filesystem::create_directories(clipFile().parent_path());
        auto clip = HandClip::make({480, 270}, kWebcamFov);
        if (!clip) GTEST_SKIP() << clip.error().message();
        const Status written =
            tests::writeWhole(clipFile(), [&](const Path& file) { return write(*clip, file); });
        if (!written) GTEST_SKIP() << written.error().message();
    }
    static Status write(HandClip& clip, const Path& file) {
        cv::VideoWriter writer(file.string(), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), kRate_Hz,
                               {480, 270});
        if (!writer.isOpened()) return Error{"", "needs a codec to write clips with"};
        for (const Moment& moment : session()) {
            std::array<std::optional<HandPose>, 2> poses;
            for (size_t side = 0; side < 2; ++side)
                if (moment[side])
                    poses[side] = test::shownHand(rig(), side == 0 ? Side::Left : Side::Right, *moment[side]);
            writer.write(clip.picture(clip.hands(poses), test::Behind::Room));
        }
        return Done{};
    }
};

TEST_F(WebcamClip, IsPlayedThrough) {
    const auto hands = makeWebcamTracker({.file = clipFile().string(), .live = false}, rig());
    HandFrame frame;
    size_t frames = 0, rights = 0, lefts = 0, fists = 0, pinches = 0;
    int64_t last_us = -1;
    while (hands->stream().take(frame, std::chrono::minutes(10))) {
        ++frames;
        EXPECT_GT(frame.time_us, last_us);
        last_us = frame.time_us;
        lefts += frame.hands[0].tracked;
        rights += frame.hands[1].tracked;
        fists += frame.hands[1].grip > 0.5f;
        pinches += frame.hands[1].grip <= 0.5f && frame.hands[1].pinch > 0.5f;
        if (frame.hands[0].tracked && frame.hands[1].tracked) { // as the viewer sees them, not the camera
            EXPECT_LT(frame.hands[0].joints[kPalmJoint].position.x,
                      frame.hands[1].joints[kPalmJoint].position.x);
        }
    }
    EXPECT_EQ(frames, frames_);
    EXPECT_NEAR(static_cast<double>(last_us) * 1e-6, static_cast<double>(frames_ - 1) / kRate_Hz, 0.01);
    EXPECT_GE(rights, 170u); // of 180
    EXPECT_GE(lefts, 85u);   // of 90
    EXPECT_NEAR(static_cast<double>(fists), 60, 8);
    EXPECT_NEAR(static_cast<double>(pinches), 60, 8);
    EXPECT_FALSE(hands->stream().state().present) << "a clip that is over shows no hands";
}

TEST_F(WebcamClip, ASmallerHandIsNearerByAsMuch) {
    const auto first = [&](float size) {
        const auto hands =
            makeWebcamTracker({.file = clipFile().string(), .live = false, .handSize = size}, rig());
        HandFrame frame;
        while (hands->stream().take(frame, std::chrono::minutes(10)))
            if (frame.hands[1].tracked) break;
        return frame;
    };
    const HandFrame rigs = first(1), small = first(0.8f);
    ASSERT_TRUE(rigs.hands[1].tracked && small.hands[1].tracked);
    EXPECT_FLOAT_EQ(small.rigDistance_m[1], rigs.rigDistance_m[1]);
    EXPECT_NEAR(spanOf(small.hands[1]), 0.8f * spanOf(rigs.hands[1]), 1e-5f);
    const auto distance_m = [](const HandFrame& frame) { // from the camera, which kCameraMount puts there
        const auto& [viewerFromCamera, cameraCentre, viewerCentre, reach] = kCameraMount;
        const glm::vec3 palm = frame.hands[1].joints[kPalmJoint].position;
        return glm::length(cameraCentre + glm::conjugate(viewerFromCamera) * (palm - viewerCentre) / reach);
    };
    EXPECT_NEAR(distance_m(rigs), rigs.rigDistance_m[1], 1e-5f);
    EXPECT_NEAR(distance_m(small), 0.8f * rigs.rigDistance_m[1], 1e-5f);
}

// The program with this clip of hands, its data below `folder`. Returns the log; empty: it failed.
std::string playClip(const Path& folder, const Path& clip, const std::string& options) {
    const Path log = folder / "err.txt";
    const std::string command =
        "env -u DISPLAY -u WAYLAND_DISPLAY XDG_DATA_HOME='" + folder.string() + "' timeout 1000 '" +
        tests::program() + "' play --headless --size 64x36 --skip objects --hands webcam:" + clip.string() +
        " " + options + " 2>" + log.string();
    if (std::system(command.c_str()) != 0) return {};
    return readText(log).value();
}

TEST_F(WebcamClip, PlaysTheGame) {
    std::filesystem::create_directories(folder_ / "shoal");
    std::filesystem::create_directory_symlink(handModelFolder(), folder_ / "shoal/models");
    const Path replay = folder_ / "run.replay";
    const std::string log = playClip(folder_.path(), clipFile(),
                                     "--at " + std::to_string(static_cast<double>(frames_) / kRate_Hz) +
                                         " --record " + replay.string());
    EXPECT_NE(log.find("Hands: Webcam"), std::string::npos) << log;
    const auto recording = tests::valueOf(tests::readRecorded(replay));
    size_t fromWebcam = 0, closed = 0;
    for (size_t tick = 0; tick < recording.ticks(); ++tick) {
        const auto input = tests::inputAt(recording, tick);
        fromWebcam += input.hands[1].tracked && input.hands[1].time_us > 0;
        closed += input.hands[1].tracked && input.hands[1].grip > 0.5f && input.hands[1].time_us > 0;
    }
    EXPECT_GT(fromWebcam, 600u); // of 720 ticks
    EXPECT_NEAR(static_cast<double>(closed), 240, 60);
}

// Writes a clip of a picture with a white left and a black right half. Returns false without a codec.
bool writeHalf(const Path& file) {
    cv::VideoWriter writer(file.string(), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), kRate_Hz, {320, 200});
    cv::Mat half(200, 320, CV_8UC3, cv::Scalar::all(0));
    half.colRange(0, 160).setTo(cv::Scalar::all(255));
    for (int i = 0; i < 40; ++i) writer.write(half);
    return writer.isOpened();
}

TEST(WebcamHands, WithoutModelsTheScriptThatFetchesThemIsNamed) {
    const tests::ScratchFolder folder;
    const Path file = folder / "half.avi";
    if (!writeHalf(file)) GTEST_SKIP() << "needs a codec to write clips with";
    const std::string sentence =
        "palm_detection_full.tflite: there is no such file; " + handModelScript().string() + " fetches it";
    EXPECT_TRUE(std::filesystem::is_regular_file(handModelScript()));
    for (const std::string& clip : {file.string(), std::string()}) { // a camera is not opened
        const auto hands = makeWebcamTracker({.file = clip, .live = false, .models = folder.path()}, rig());
        HandFrame frame;
        while (!hands->stream().state().lacksModels)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        EXPECT_FALSE(hands->stream().take(frame));
        EXPECT_FALSE(hands->stream().state().present);
        EXPECT_NE(hands->stream().state().description.find(sentence), std::string::npos)
            << hands->stream().state().description;
    }
    const std::string log = playClip(folder.path(), file, "--at 1.5");
    EXPECT_NE(log.find("Hands: mouse; Webcam: "), std::string::npos) << log;
    EXPECT_NE(log.find(sentence), std::string::npos) << log;
}

TEST(WebcamHands, AFileThatIsNoClipIsSaidAndForgotten) {
    const tests::ScratchFolder folder;
    const Path file = folder / "no_clip.avi";
    ASSERT_TRUE(writeFileWhole(file, "RIFF, but not really"));
    const auto hands = makeWebcamTracker({.file = file.string(), .live = false}, rig());
    HandFrame frame;
    EXPECT_FALSE(hands->stream().take(frame, std::chrono::minutes(10)));
    EXPECT_FALSE(hands->stream().state().present);
    EXPECT_FALSE(hands->stream().state().lacksModels);
}

TEST(WebcamHands, ThePlayerIsShownAsInAMirrorWhileSomebodyLooks) {
    CameraPreview preview;
    ImageRgba8 picture;
    EXPECT_FALSE(preview.isWatched()) << "nobody has looked yet";
    EXPECT_FALSE(preview.look(picture));
    EXPECT_TRUE(preview.isWatched());
    preview.show(ImageRgba8(2, 2));
    EXPECT_FALSE(preview.isWatched());
    EXPECT_TRUE(preview.look(picture));
    EXPECT_FALSE(preview.look(picture)) << "the same again";

    const tests::ScratchFolder folder;
    const Path file = folder / "half.avi";
    if (!writeHalf(file)) GTEST_SKIP() << "needs a codec to write clips with";
    if (const auto finder = LandmarkFinder::load(handModelFolder(), rig()); !finder)
        GTEST_SKIP() << finder.error().message();
    const auto hands = makeWebcamTracker({.file = file.string(), .live = false}, rig());
    bool shown = hands->preview()->look(picture);
    for (HandFrame frame; hands->stream().take(frame, std::chrono::minutes(10));)
        shown |= hands->preview()->look(picture);
    ASSERT_TRUE(shown);
    EXPECT_EQ(picture.width, CameraPreview::kWidth);
    EXPECT_EQ(picture.height, 150);
    EXPECT_LT(picture.at(30, 75)[0], 40);
    EXPECT_GT(picture.at(210, 75)[0], 215);
}

} // namespace
} // namespace shoal::hands
