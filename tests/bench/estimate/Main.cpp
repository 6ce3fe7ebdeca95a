// bench_estimate make FOLDER : writes made films and their true depth there.
// bench_estimate measure NAME FILM TRUTH FROM_S : estimates the depth of the film, which begins at that
// second of the truth, and prints a line for each frame of the track: name, time, shares and factors, and
// the processor's seconds a frame of the track.
#include "content/make/depth/FilmDepth.h"
#include "engine/core/Files.h"
#include "engine/core/Result.h"
#include "engine/math/Quantile.h"
#include "engine/media/DepthTrack.h"
#include "tests/bench/Bench.h"
#include "tests/bench/estimate/Scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

namespace {

using namespace shoal;
using namespace shoal::bench;

// Shares are of solid angle.
struct FrameAccuracy {
    double time_s = 0;    // of the film
    double right = 0;     // share of confident texels within 10 % of the truth, after one factor for the film
    double rightOwn = 0;  // the same after a factor of the frame's own
    double covered = 0;   // share of texels nearer than 10 m that are confident
    double ownFactor = 1; // median of estimated over true distances, over that of the film
};

struct Accuracy {
    double factor = 1; // median of estimated over true distances
    std::vector<FrameAccuracy> frames;
};

constexpr double kConfident = 0.6;     // confidence at which depth is believed in full (content/README.md)
constexpr double kNear_perM = 0.1;     // 10 m
constexpr double kBeyond_perM = 0.002; // half of the first code; the truth has no distance below

struct Texel {
    double truth_perM, estimated_perM, weight;
    bool isConfident;
};

std::vector<Texel> texelsOf(const media::DepthFrame& estimated, const media::DepthFrame& truth) {
    std::vector<Texel> texels;
    for (int y = 0; y < estimated.height; ++y) {
        const double weight = std::cos((0.5 - (y + 0.5) / estimated.height) * std::numbers::pi);
        for (int x = 0; x < estimated.width; ++x) {
            const int tx = x * truth.width / estimated.width, ty = y * truth.height / estimated.height;
            const auto sure = estimated.confidence[static_cast<size_t>(y / 2) * estimated.width / 2 +
                                                   static_cast<size_t>(x / 2)];
            texels.push_back({static_cast<double>(truth.inverse_perM(tx, ty)),
                              static_cast<double>(estimated.inverse_perM(x, y)), weight,
                              sure >= kConfident * media::kMaxDepthCode});
        }
    }
    return texels;
}

// Returns the median of estimated over true distances, of all confident texels.
double factorOf(const std::vector<std::vector<Texel>>& frames) {
    std::vector<double> factors;
    for (const auto& texels : frames)
        for (const Texel& each : texels)
            if (each.isConfident && each.truth_perM > kBeyond_perM && each.estimated_perM > 0)
                factors.push_back(each.truth_perM / each.estimated_perM);
    return factors.empty() ? 1 : math::median(factors);
}

double rightShare(const std::vector<Texel>& texels, double factor) {
    double right = 0, all = 0;
    for (const Texel& each : texels) {
        if (!each.isConfident) continue;
        all += each.weight;
        const double estimated = each.estimated_perM * factor;
        if (each.truth_perM <= kBeyond_perM)
            right += estimated < 2.5 * kBeyond_perM ? each.weight : 0; // beyond 200 m
        else if (estimated > 0 && std::abs(each.truth_perM / estimated - 1) <= 0.1)
            right += each.weight;
    }
    return all > 0 ? right / all : 0;
}

double coveredShare(const std::vector<Texel>& texels) {
    double covered = 0, all = 0;
    for (const Texel& each : texels) {
        if (each.truth_perM < kNear_perM) continue;
        all += each.weight;
        covered += each.isConfident ? each.weight : 0;
    }
    return all > 0 ? covered / all : 0;
}

// The film begins at from_s of the truth, which may be longer.
Result<Accuracy> accuracyOf(const Path& estimated, const Path& truth, double from_s) {
    auto made = media::DepthTrack::open(estimated);
    if (!made) return made.error();
    auto known = media::DepthTrack::open(truth);
    if (!known) return known.error();
    std::vector<std::vector<Texel>> frames;
    Accuracy result;
    media::DepthFrame ours, theirs;
    for (int i = 0; i < made->info().frameCount; ++i) {
        const double time_s = made->info().duration_s * i / made->info().frameCount;
        if (!made->read(i, ours) || !known->read(known->frameAt(from_s + time_s), theirs))
            return Error{estimated.string(), "cannot be compared: a frame of it or of the truth is damaged"};
        frames.push_back(texelsOf(ours, theirs));
        result.frames.push_back({});
        result.frames.back().time_s = time_s;
    }
    result.factor = factorOf(frames);
    for (size_t i = 0; i < frames.size(); ++i) {
        const double own = factorOf({frames[i]});
        FrameAccuracy& frame = result.frames[i];
        frame.right = rightShare(frames[i], result.factor);
        frame.rightOwn = rightShare(frames[i], own);
        frame.covered = coveredShare(frames[i]);
        frame.ownFactor = own / result.factor;
    }
    return result;
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
    if (what == "make" && argc == 3) done = makeScenes(argv[2]);
    if (what == "measure" && argc == 6) done = measure(argv[2], argv[3], argv[4], std::atof(argv[5]));
    return exitStatus("bench_estimate", done);
}
