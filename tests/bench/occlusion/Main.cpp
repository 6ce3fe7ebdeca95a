// bench_occlusion FOLDER [--quick]: measures, writes tables and what the picture is drawn from.
// tests/bench/occlusion_chart builds it, starts it and draws.
#include "tests/bench/occlusion/Measure.h"

int main(int argc, char** argv) {
    using namespace shoal;
    if (bench::lacksArguments(argc, 1, "bench_occlusion FOLDER [--quick | --sheet]")) return 2;
    const std::string option = argc == 3 ? argv[2] : "";
    const bool quick = option == "--quick";
    const Path folder = argv[1];
    const auto scenes = bench::makeScenes();
    if (!scenes) return bench::exitStatus("occlusion", scenes.error());
    Status done = bench::writeSheet(std::span(*scenes).first(bench::kShownScenes), folder);
    if (!done || option == "--sheet") return bench::exitStatus("occlusion", done);
    // The fish, and the two scenes of the picture.
    const auto some = std::span(*scenes).subspan(quick ? 3 : 0, quick ? 3 : scenes->size());
    const auto chart = bench::measureOcclusion(some, quick);
    const auto layers = bench::measureLayers(some, quick);
    done = bench::writeOcclusionMarkdown(chart, layers, folder);
    if (done) done = bench::writeOcclusionPicture(chart, folder);
    return bench::exitStatus("occlusion", done);
}
