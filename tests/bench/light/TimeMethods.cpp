#include "engine/core/Vectorise.h"
#include "engine/light/MakeLight.h"
#include "engine/light/Pyramid.h"
#include "tests/bench/light/Measure.h"

namespace shoal::bench {

using namespace light::baselines;

namespace {

// Normals of a sphere's pixels, row by row, so that lookups find their neighbours in the cache.
std::vector<glm::vec3> sphereNormals() {
    constexpr int kSize = 80;
    std::vector<glm::vec3> normals;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const float nx = (static_cast<float>(x) + 0.5f) * 2 / kSize - 1;
            const float ny = 1 - (static_cast<float>(y) + 0.5f) * 2 / kSize;
            const float square = 1 - nx * nx - ny * ny;
            if (square > 0) normals.emplace_back(nx, ny, std::sqrt(square));
        }
    return normals;
}

inline uint64_t sumOfWords(const ImageRgb8& frame) {
    uint64_t sum = 0;
    for (size_t i = 0; i + 8 <= frame.pixels.size(); i += 8) {
        uint64_t word;
        std::memcpy(&word, frame.pixels.data() + i, 8);
        sum += word;
    }
    return sum;
}

// Reads the bytes, compiled for any x86-64 and for the widest registers that the processor has. kept: takes
// the result, so that the read is not optimised away.
void readBytes(const ImageRgb8& frame, volatile uint64_t& kept) { kept = sumOfWords(frame); }
SHOAL_VECTORISE void readBytesWide(const ImageRgb8& frame, volatile uint64_t& kept) {
    kept = sumOfWords(frame);
}

} // namespace

void timeMethods(Chart& chart, std::vector<DiffuseMethod>& diffuse, std::vector<GlossyMethod>& glossy,
                 std::vector<PyramidMethod>& pyramids, bool quick) {
    const Environment timed{timedFrame(), {}};
    const auto normals = sphereNormals();
    std::vector<glm::vec3> out(normals.size());
    light::PyramidMaker maker;
    light::RadiancePyramid pyramid, made;
    maker.make(timed.view(), timed.baseWidth(), pyramid);
    const Input input{&pyramid, timed.view(), nullptr};
    light::LightMaker reefMaker({512, kReefRoughness});
    light::EnvironmentLight reefLight;
    volatile uint64_t read = 0;

    const int rounds = quick ? 1 : 4;
    const double budget_ms = quick ? 30 : 80;
    const auto keepLess = [](double& kept, double now) { kept = kept == 0 ? now : std::min(kept, now); };
    const auto update = [&](Cost& cost, auto& method) {
        keepLess(cost.update_us, shortest_us(budget_ms, [&] { method.update(input); }));
    };
    const auto shade = [&](auto&& run) {
        return 1e3 / static_cast<double>(normals.size()) * shortest_us(budget_ms / 8, run);
    };
    // Each round times every method once, so that another program that takes the machine for a second does
    // not slow one method alone.
    for (int round = 0; round < rounds; ++round) {
        std::fprintf(stderr, "chart: timing, round %d of %d\n", round + 1, rounds);
        const double end_us = now_us() + 4e3 * budget_ms;
        while (now_us() < end_us) { // in turn, so that they find the same state of caches and machine
            const double begin_us = now_us();
            readBytes(timed.frame, read);
            const double narrow_us = now_us();
            readBytesWide(timed.frame, read);
            const double wide_us = now_us();
            reefMaker.make(timed.view(), reefLight);
            keepLess(chart.reef_us, now_us() - wide_us);
            keepLess(chart.wideRead_us, wide_us - narrow_us);
            keepLess(chart.read_us, narrow_us - begin_us);
        }
        keepLess(chart.pyramid_us,
                 shortest_us(budget_ms, [&] { maker.make(timed.view(), timed.baseWidth(), pyramid); }));
        for (size_t i = 0; i < diffuse.size(); ++i) {
            Cost& cost = chart.diffuse[i].cost;
            update(cost, diffuse[i]);
            keepLess(cost.shade_ns, shade([&] { diffuse[i].shade(normals, out); }));
        }
        for (size_t i = 0; i < glossy.size(); ++i) {
            Cost& cost = chart.glossy[i].cost;
            update(cost, glossy[i]);
            double sum = 0;
            for (const float roughness : kRoughnesses)
                sum += shade([&] { glossy[i].shade(normals, roughness, out); });
            keepLess(cost.shade_ns, sum / std::size(kRoughnesses));
        }
        for (size_t i = 0; i < pyramids.size(); ++i)
            keepLess(chart.pyramids[i].cost.update_us,
                     shortest_us(budget_ms, [&] { pyramids[i].make(timed.view(), made); }));
    }
    for (size_t i = 0; i < diffuse.size(); ++i)
        if (diffuse[i].readsPyramid) chart.diffuse[i].cost.update_us += chart.pyramid_us;
    for (size_t i = 0; i < glossy.size(); ++i)
        if (glossy[i].readsPyramid) chart.glossy[i].cost.update_us += chart.pyramid_us;
}

} // namespace shoal::bench
