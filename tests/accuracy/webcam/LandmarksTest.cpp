// Hands found by learned landmarks. What needs the models, which no checkout holds, skips by name without.
#ifdef SHOAL_HAND_LANDMARKS
#include "HandRows.h"
#include "engine/core/WriteFile.h"
#include "input/hands/webcam/landmarks/LandmarkFinder.h"
#include "tests/TestPaths.h"
#include "tests/TestRig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

namespace shoal::hands {
namespace {

using tests::rig;

TEST(Landmarks, ModelsThatAreMissingOrDamagedAreSaidWithWhatToDo) {
    const tests::ScratchFolder folder;
    const auto missing = makeLandmarkFinder(folder.path(), rig());
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().message().find("get_models fetches it"), std::string::npos)
        << missing.error().message();
    ASSERT_TRUE(writeFileWhole(folder / "palm_detection_full.tflite", "TFL3"));
    const auto damaged = makeLandmarkFinder(folder.path(), rig());
    ASSERT_FALSE(damaged);
    EXPECT_NE(damaged.error().message().find("damaged"), std::string::npos) << damaged.error().message();
}

class LandmarkRows : public testing::TestWithParam<size_t> {};

TEST_P(LandmarkRows, AreFoundWithoutPhantomsAndTheirFingertipsAreWhereTheyAre) {
    auto finder = makeLandmarkFinder(handModelFolder(), rig());
    if (!finder) GTEST_SKIP() << finder.error().message();
    auto clip = test::HandClip::make({test::kRowWidth, test::kRowHeight}, kWebcamFov);
    if (!clip) GTEST_SKIP() << clip.error().message();
    const test::Row& row = test::rows()[GetParam()];
    const test::RowResult result = test::measure(*clip, rig(), row, 50, {finder->get()})[0];
    EXPECT_EQ(result.phantoms, 0);
    if (result.shown == 0) return;
    EXPECT_GE(result.found, 0.97 * result.shown);
    EXPECT_EQ(result.otherSide, 0);
    EXPECT_LT(result.tipMedian_mm(), row.blur_px > 1 ? 30 : 15);
}

INSTANTIATE_TEST_SUITE_P(All, LandmarkRows, testing::Range(size_t{0}, test::rows().size()),
                         [](const auto& row) {
                             std::string name = test::rows()[row.param].name;
                             std::replace_if(
                                 name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); },
                                 '_');
                             return name;
                         });

TEST(Landmarks, OddPicturesAreSurvived) {
    auto finder = makeLandmarkFinder(handModelFolder(), rig());
    if (!finder) GTEST_SKIP() << finder.error().message();
    double t = 0;
    for (const cv::Size size : {cv::Size(1, 1), cv::Size(2000, 3), cv::Size(3, 2000), cv::Size(640, 480)})
        for (const int value : {0, 255, 128}) {
            const HandFrame frame =
                (*finder)->detect(cv::Mat(size, CV_8UC3, cv::Scalar::all(value)), t += 0.03);
            EXPECT_FALSE(frame.hands[0].tracked || frame.hands[1].tracked);
        }
    EXPECT_FALSE((*finder)->detect(cv::Mat(), t).hands[0].tracked);
    EXPECT_FALSE((*finder)->detect(cv::Mat(9, 9, CV_8UC1, cv::Scalar(0)), t).hands[0].tracked);
}

} // namespace
} // namespace shoal::hands
#endif
