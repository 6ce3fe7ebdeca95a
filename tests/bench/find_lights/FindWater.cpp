// How right the attenuation is that is estimated from films, whose water is known from what made them.
#include "engine/math/Quantile.h"
#include "engine/media/VideoPlayer.h"
#include "engine/water/EstimateWater.h"
#include "tests/bench/Bench.h"
#include "tests/bench/find_lights/Tables.h"

#include <fmt/format.h>
#include <toml++/toml.h>

namespace shoal::bench {

namespace {

// Returns how wrong the share of light is that arrives from 1, 2 and 3 m: mean square over distances and
// channels.
double squareOff(const glm::vec3& found_perM, const glm::vec3& truth_perM) {
    double sum = 0;
    for (const float distance_m : {1.0f, 2.0f, 3.0f}) {
        const glm::dvec3 off(glm::exp(-found_perM * distance_m) - glm::exp(-truth_perM * distance_m));
        sum += glm::dot(off, off) / 9;
    }
    return sum;
}

} // namespace

void findWater(bool quick) {
    std::printf(R"(
## Attenuation of the water

In a frame of each second of the films, whose water content/make/video tells. Error: of the share of light that arrives from
1, 2 and 3 m in each channel, root mean square, %% of the light that is sent.

| film | true, per m: red, green, blue | found: median | without, %% | the same water for all | **found** | us a frame |
|---|---|---|--:|--:|--:|--:|
)");
    const glm::vec3 same_perM = water::attenuationFromVeil(glm::vec3(1)); // by a veil without colour
    for (const auto& [name, scene] :
         {std::pair("reef", "Reef.toml"), {"night", "Reef.toml"}, {"kelp", "Kelp.toml"}}) {
        auto player = media::VideoPlayer::open(dataRoot() / "content/video" / (std::string(name) + ".mp4"));
        if (!player) continue;
        const auto made = toml::parse_file((dataRoot() / "content/make/video" / scene).string());
        glm::vec3 truth_perM(0);
        for (int c = 0; c < 3; ++c) truth_perM[c] = made["water"]["attenuation"][c].value_or(0.0f);
        std::array<std::vector<double>, 3> found;
        std::vector<double> times_us;
        double squares = 0;
        for (double at_s = 0.5; at_s < (quick ? 1 : player->info().duration_s); at_s += 1) {
            const ImageRgb8& frame = player->waitFor(at_s)->pixelsBgr;
            const light::FrameView view{frame.pixels.data(), frame.width, frame.height,
                                        ptrdiff_t{3} * frame.width};
            glm::vec3 found_perM(0);
            times_us.push_back(
                shortest_us(0, [&] { found_perM = water::estimateWater(view).water.attenuation_perM; }));
            squares += squareOff(found_perM, truth_perM);
            for (int c = 0; c < 3; ++c) found[c].push_back(found_perM[c]);
        }
        std::string row = std::string("| ") + name + " |";
        for (int c = 0; c < 3; ++c) row += fmt::format(" {:.3f}", truth_perM[c]);
        row += " |";
        for (auto& each : found) row += fmt::format(" {:.3f}", math::median(each));
        for (const double square : {squareOff(glm::vec3(0), truth_perM), squareOff(same_perM, truth_perM),
                                    squares / static_cast<double>(times_us.size())})
            row += fmt::format(" | {:.1f}", 100 * std::sqrt(square));
        std::printf("%s | %.0f |\n", row.c_str(), math::median(times_us));
    }
}

} // namespace shoal::bench
