// bench_occlusion FOLDER [--quick]: measures, writes tables and what the picture is drawn from.
// tests/bench/occlusion_chart builds it, starts it and draws.
#include "tests/TestPaths.h"
#include "tests/bench/occlusion/Report.h"
#include "tests/bench/occlusion/Sheet.h"

#include <cstdio>
#include <cstdlib>
#include <string>

int main(int argc, char** argv) {
    using namespace shoal;
    const std::string option = argc == 3 ? argv[2] : "";
    if (argc < 2 || argc > 3 || (!option.empty() && option != "--quick" && option != "--sheet")) {
        std::fprintf(stderr, "usage: bench_occlusion FOLDER [--quick | --sheet]\n");
        return 2;
    }
    const bool quick = option == "--quick";
    const auto complain = [](const Error& error) {
        std::fprintf(stderr, "occlusion: %s\n", error.message().c_str());
        return 1;
    };
    const Path folder = argv[1];
    const char* shared = std::getenv("SHOAL_SHARED");
    const auto scenes = bench::makeScenes();
    if (!scenes) return complain(scenes.error());
    if (const Status drawn = bench::writeSheet(std::span(*scenes).first(bench::kShownScenes), folder); !drawn)
        return complain(drawn.error());
    if (option == "--sheet") return 0;
    const auto chart = bench::measureOcclusion(*scenes, shared ? shared : "", quick);
    const auto layers = bench::measureLayers(*scenes, quick);
    for (const Status& written :
         {bench::writeOcclusionMarkdown(chart, layers, folder), bench::writeOcclusionPicture(chart, folder)})
        if (!written) return complain(written.error());
}
