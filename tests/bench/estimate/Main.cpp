// bench_estimate make FOLDER : writes made films and their true depth there.
// bench_estimate measure NAME FILM TRUTH FROM_S : estimates the depth of the film, which begins at that
// second of the truth, and prints a line for each frame of the track: name, time, shares and factors as
// Accuracy.h has them, and the processor's seconds a frame of the track.
#include "content/make/depth/FilmDepth.h"
#include "tests/bench/estimate/Accuracy.h"
#include "tests/bench/estimate/Scenes.h"
#include "tests/bench/light/Timing.h"

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

using namespace shoal;
using namespace shoal::bench;

Status make(const Path& folder) {
    for (const NamedScene& scene : scenes()) {
        std::error_code ignored;
        if (std::filesystem::exists(folder / (scene.name + ".truth.mkv"), ignored)) continue;
        if (Status s = makeScene(scene, folder); !s) return s;
    }
    return Done{};
}

void print(const std::string& name, const Accuracy& accuracy, double each_s) {
    for (const FrameAccuracy& f : accuracy.frames)
        std::printf("%s\t%.3f\t%.4f\t%.4f\t%.4f\t%.4f\t%.4f\t%.3f\n", name.c_str(), f.time_s, f.right,
                    f.rightOwn, f.covered, f.ownFactor, accuracy.factor, each_s);
}

Status measure(const std::string& name, const Path& film, const Path& truth, double from_s) {
    const Path track = film.string() + ".depth.mkv";
    depth::FilmDepthOptions options;
    if (name == "stereo") options.layout = media::Layout::TopBottom;
    const double began_ms = processor_ms();
    const auto made = depth::makeFilmDepth(film, track, options);
    if (!made) return made.error();
    if (*made == depth::FilmDepth::CannotBeKnown) {
        std::printf("%s\tcannot be known\n", name.c_str());
        return Done{};
    }
    const double all_s = 1e-3 * (processor_ms() - began_ms);
    const auto accuracy = accuracyOf(track, truth, from_s);
    if (!accuracy) return accuracy.error();
    print(name, *accuracy, all_s / static_cast<double>(accuracy->frames.size()));
    return Done{};
}

} // namespace

int main(int argc, char** argv) {
    const std::string what = argc > 1 ? argv[1] : "";
    Status done = Error{"", "wrong arguments"};
    if (what == "make" && argc == 3) done = make(argv[2]);
    if (what == "measure" && argc == 6) done = measure(argv[2], argv[3], argv[4], std::atof(argv[5]));
    if (!done) std::fprintf(stderr, "bench_estimate: %s\n", done.error().message().c_str());
    return done ? 0 : 1;
}
