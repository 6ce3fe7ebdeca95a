// How well hands are found in a webcam's pictures, by colour and by landmarks: bench_webcam [FOLDER
// [PICTURES]]. Prints a table, and with a folder writes every tenth picture there with what landmarks found.
#include "engine/core/Files.h"
#include "input/hands/webcam/HandDetector.h"
#include "input/hands/webcam/landmarks/LandmarkFinder.h"
#include "tests/accuracy/webcam/HandRows.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

using namespace shoal;
using namespace shoal::hands;

int main(int count, char** arguments) {
    const std::string folder = count > 1 ? arguments[1] : "";
    const int pictures = count > 2 ? std::max(10, std::atoi(arguments[2])) : 90;
    const auto rig = HandRig::load(dataRoot() / "content/models/hand_skeleton.json");
    auto clip = test::HandClip::make({test::kRowWidth, test::kRowHeight}, kWebcamFov);
    if (!rig || !clip) {
        std::fprintf(stderr, "%s\n", (rig ? clip.error() : rig.error()).message().c_str());
        return 1;
    }
    std::puts("| hands | method | found, % | other side | phantoms | tips off, mm | ms a picture "
              "|\n|---|---|--:|--:|--:|--:|--:|");
    for (const test::Row& row : test::rows()) {
        HandDetector colour(*rig);
        auto landmarks = makeLandmarkFinder(handModelFolder(), *rig);
        if (!landmarks) {
            std::fprintf(stderr, "%s\n", landmarks.error().message().c_str());
            return 1;
        }
        const auto look = [&](int number, const cv::Mat& picture, const std::vector<HandFrame>& found) {
            if (folder.empty() || number % 10 != 9) return;
            cv::Mat drawn = picture.clone();
            test::drawHands(drawn, found[0]);
            std::string name = row.name;
            std::replace(name.begin(), name.end(), ' ', '_');
            cv::imwrite(folder + "/" + name + "_" + std::to_string(number) + ".png", drawn);
        };
        const auto results = test::measure(*clip, *rig, row, pictures, {landmarks->get(), &colour}, look);
        for (size_t i = 0; i < results.size(); ++i) {
            const test::RowResult& result = results[i];
            std::printf("| %s | %s | ", row.name, i == 0 ? "landmarks" : "colour");
            if (result.shown) std::printf("%.1f", 100.0 * result.found / result.shown);
            std::printf(" | %d | %d | ", result.otherSide, result.phantoms);
            if (result.found) std::printf("%.1f", result.tipMedian_mm());
            std::printf(" | %.1f |\n", test::medianOf(result.ms));
            std::fflush(stdout);
        }
    }
    return 0;
}
