// Prints tables of how well hands are found in a webcam's pictures.
#include "input/hands/webcam/landmarks/LandmarkFinder.h"
#include "tests/accuracy/webcam/HandRows.h"
#include "tests/bench/Bench.h"

using namespace shoal;
using namespace shoal::hands;

namespace {

LandmarkFinder landmarkFinder(const HandRig& rig) {
    auto finder = LandmarkFinder::load(handModelFolder(), rig);
    if (finder) return std::move(*finder);
    std::fprintf(stderr, "%s\n", finder.error().message().c_str());
    std::exit(1);
}

int pictures = 90;

void printRows(test::HandClip& clip, const HandRig& rig) {
    std::puts("| hands | found, % | other side | phantoms | tips off, mm | ms a picture "
              "|\n|---|--:|--:|--:|--:|--:|");
    for (const test::Row& row : test::rows()) {
        LandmarkFinder finder = landmarkFinder(rig);
        const test::RowResult result = test::measure(clip, rig, row, pictures, finder);
        std::printf("| %s | ", row.name);
        if (result.shown) std::printf("%.1f", 100.0 * result.found / result.shown);
        std::printf(" | %d | %d | ", result.otherSide, result.phantoms);
        if (result.found) std::printf("%.1f", result.tipMedian_mm());
        std::printf(" | %.1f |\n", test::medianOf(result.ms));
        std::fflush(stdout);
    }
}

void printSizes(test::HandClip& clip, const HandRig& rig) {
    std::puts(
        "\n| hands of size, % | measured, % | at, m | found, % | wrist's distance off, % | once measured, % "
        "|\n|--:|--:|--:|--:|--:|--:|");
    for (const float size : {0.85f, 1.0f, 1.15f}) {
        LandmarkFinder measuring = landmarkFinder(rig);
        const double measured = test::measuredSize(clip, rig, size, measuring);
        for (const float distance_m : {0.3f, 0.5f, 0.9f}) {
            LandmarkFinder finder = landmarkFinder(rig);
            const test::Row row{.name = "size", .distance_m = distance_m, .size = size};
            const test::RowResult result = test::measure(clip, rig, row, pictures, finder);
            std::printf("| %.0f | %.1f | %.1f | %.1f | %.1f | %.1f |\n", 100 * size, 100 * measured,
                        distance_m, 100.0 * result.found / std::max(result.shown, 1),
                        result.wristOff_percent(1), result.wristOff_percent(measured));
            std::fflush(stdout);
        }
    }
}

} // namespace

int main(int argc, char**) {
    if (argc > 1) pictures = 9; // --quick
    const auto rig = HandRig::load(dataRoot() / "content/models/hand_skeleton.json");
    auto clip = test::HandClip::make({test::kRowWidth, test::kRowHeight}, kWebcamFov);
    if (!rig || !clip) {
        std::fprintf(stderr, "%s\n", (rig ? clip.error() : rig.error()).message().c_str());
        return 1;
    }
    printRows(*clip, *rig);
    printSizes(*clip, *rig);
}
