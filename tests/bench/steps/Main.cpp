// bench_steps FOLDER COUNT {FILM FIRST}...: how much diffuse light changes from each frame of a clip to the
// next, as the game makes it from the coded frames, and in truth. FOLDER holds the true radiance of these
// frames before the camera, FILM_NNNN.hdr. tests/bench/light_steps traces them and starts it.
#include "engine/light/MakeLight.h"
#include "engine/math/Colour.h"
#include "engine/math/LatLong.h"
#include "engine/math/Quantile.h"
#include "engine/media/Pictures.h"
#include "engine/media/VideoPlayer.h"
#include "tests/bench/Bench.h"

#include <fmt/core.h>

namespace {

using namespace shoal;

struct Method {
    const char* name;
    light::FrameRadiance frames;
};
constexpr Method kMethods[] = {{"thesis", light::FrameRadiance::Thesis},
                               {"linear", light::FrameRadiance::Linear},
                               {"auto (the game)", light::FrameRadiance::Auto}};

// Light of one frame of a clip by each method; the last is the truth.
using Lights = std::array<ImageRgbF, std::size(kMethods) + 1>;

// Returns the camera's exposure, which adapts, so that the true light has to follow: the median factor over
// pixels neither clipped nor nearly black. (Small lamps seldom fall on the pixels that stand for them.)
double exposureOf(const ImageRgb8& bgr, const ImageRgbF& radianceLin) {
    std::vector<double> ratios;
    for (int y = 0; y < radianceLin.height; ++y)
        for (int x = 0; x < radianceLin.width; ++x) {
            const uint8_t green =
                bgr.at(x * bgr.width / radianceLin.width, y * bgr.height / radianceLin.height)[1];
            if (green > 20 && green < 230)
                ratios.push_back(math::linearOfByte()[green] / radianceLin.at(x, y)[1]);
        }
    return math::median(ratios);
}

// Returns the root of the integrated squared difference over the integrated square.
double stepBetween(const ImageRgbF& before, const ImageRgbF& after) {
    double off = 0, whole = 0;
    for (int y = 0; y < before.height; ++y) {
        const double weight = texelSolidAngle(y, before.width, before.height);
        for (int i = 0; i < 3 * before.width; ++i) {
            const double a = before.at(0, y)[i], b = after.at(0, y)[i];
            off += weight * (b - a) * (b - a);
            whole += weight * a * a;
        }
    }
    return std::sqrt(off / whole);
}

Result<std::vector<Lights>> lightsOf(const Path& folder, const std::string& film, int first, int count) {
    auto player = media::VideoPlayer::open(dataRoot() / "content/video" / (film + ".mp4"));
    if (!player) return player.error();
    std::vector<light::LightMaker> makers;
    for (const Method& method : kMethods)
        makers.emplace_back(
            light::LightOptions{.baseWidth = 512, .minRoughness = 0.5f, .frames = method.frames});
    light::LightMaker trueMaker({.baseWidth = 512, .minRoughness = 0.5f});
    light::EnvironmentLight made;
    std::vector<Lights> lights;
    for (int frame = first; frame < first + count; ++frame) {
        const ImageRgb8& shown = player->waitFor((frame + 0.5) / player->info().fps)->pixelsBgr;
        auto truth = media::readHdr(folder / fmt::format("{}_{:04}.hdr", film, frame));
        if (!truth) return truth.error();
        Lights& out = lights.emplace_back();
        for (size_t i = 0; i < makers.size(); ++i) {
            makers[i].make({shown.pixels.data(), shown.width, shown.height, ptrdiff_t{3} * shown.width},
                           made);
            out[i] = made.diffuse;
        }
        const auto exposure = static_cast<float>(exposureOf(shown, truth->radianceLin));
        for (float& value : truth->radianceLin.pixels) value *= exposure;
        trueMaker.makeFromHdr(truth->radianceLin, made);
        out.back() = made.diffuse;
    }
    return lights;
}

void printClip(const std::string& name, const std::vector<Lights>& lights) {
    for (size_t i = 0; i < std::size(kMethods); ++i) {
        std::vector<double> steps, trueSteps, excesses;
        for (size_t frame = 1; frame < lights.size(); ++frame) {
            steps.push_back(100 * stepBetween(lights[frame - 1][i], lights[frame][i]));
            trueSteps.push_back(100 * stepBetween(lights[frame - 1].back(), lights[frame].back()));
            excesses.push_back(steps.back() - trueSteps.back());
        }
        fmt::print("| {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", name, kMethods[i].name,
                   math::median(trueSteps), math::median(steps), math::median(excesses),
                   math::quantile(excesses, 0.9), *std::ranges::max_element(excesses));
    }
}

} // namespace

int main(int argc, char** argv) {
    if (bench::lacksArguments(argc, 4, "bench_steps FOLDER COUNT {FILM FIRST}...")) return 2;
    fmt::print("| clip | light | true step, median % | step, median % | above the true one, median % | "
               "90 of 100 below % | most % |\n|---|---|---|---|---|---|---|\n");
    for (int i = 3; i + 1 < argc; i += 2) {
        const auto lights = lightsOf(argv[1], argv[i], std::atoi(argv[i + 1]), std::atoi(argv[2]));
        if (!lights) return bench::exitStatus("bench_steps", lights.error());
        printClip(fmt::format("{} {}", argv[i], argv[i + 1]), *lights);
    }
}
