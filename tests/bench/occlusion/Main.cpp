// bench_occlusion FOLDER [--quick]: measures, writes tables and what the picture is drawn from.
// tests/bench/occlusion_chart builds it, starts it and draws.
#include "tests/bench/occlusion/Report.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>

int main(int argc, char** argv) {
    using namespace shoal;
    if (argc < 2 || argc > 3 || (argc == 3 && std::strcmp(argv[2], "--quick") != 0)) {
        std::fprintf(stderr, "usage: bench_occlusion FOLDER [--quick]\n");
        return 2;
    }
    const auto complain = [](const Error& error) {
        std::fprintf(stderr, "occlusion: %s\n", error.sentence().c_str());
        return 1;
    };
    const Path folder = argv[1];
    const char* shared = std::getenv("SHOAL_SHARED");
    const auto scenes = bench::makeScenes();
    if (!scenes) return complain(scenes.error());
    const auto chart = bench::measureOcclusion(*scenes, shared ? shared : "", argc == 3);
    const auto layers = bench::measureLayers(*scenes, argc == 3);
    for (const Status& written :
         {bench::writeOcclusionMarkdown(chart, layers, folder), bench::writeOcclusionCsv(chart, folder),
          bench::writeOcclusionPicture(chart, folder)})
        if (!written) return complain(written.error());
}
