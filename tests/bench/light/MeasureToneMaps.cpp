#include "engine/light/InverseToneMap.h"
#include "engine/light/Pyramid.h"
#include "engine/math/Colour.h"
#include "engine/math/LatLong.h"
#include "engine/math/Quantile.h"
#include "tests/bench/light/Measure.h"
#include "tests/unit/media/CodedFrames.h"

#include <glm/gtc/type_ptr.hpp>

namespace shoal::bench {

using namespace light::baselines;

namespace {

// The picture as a camera would record it: a tenth of its pixels above 0.8, clipped at 1, sRGB, 8 bits.
struct Exposed {
    ImageRgb8 frame;
    ImageRgbF radianceLin; // before it was clipped, of the same scale
};

Exposed expose(const ImageRgbF& radianceLin) {
    std::vector<float> luminances;
    for (size_t i = 0; i < radianceLin.pixels.size(); i += 3)
        luminances.push_back(light::linearLuminance(glm::make_vec3(&radianceLin.pixels[i])));
    const float exposure = 0.8f / math::quantile(luminances, 0.9);

    Exposed exposed{ImageRgb8(radianceLin.width, radianceLin.height), radianceLin};
    for (size_t i = 0; i < radianceLin.pixels.size(); ++i) {
        exposed.radianceLin.pixels[i] *= exposure;
        const float clipped = std::clamp(exposed.radianceLin.pixels[i], 0.0f, 1.0f);
        exposed.frame.pixels[i] = static_cast<uint8_t>(std::lround(255 * math::srgbFromLinear(clipped)));
    }
    return exposed;
}

// Light of roughness 0.5 needs no more than 256 texels around.
ImageRgbF quartered(ImageRgbF image) {
    ImageRgbF half;
    for (int i = 0; i < 2 && image.width > 256; ++i) {
        light::halve(image, half);
        std::swap(image, half);
    }
    return image;
}

bool isClipped(const uint8_t* coded) { return std::max({coded[0], coded[1], coded[2]}) == 255; }

// The two parts of a frame's decoded radiance.
struct Parts {
    ImageRgbF unclipped, clipped;
};

Parts partsOf(const ImageRgb8& frame) {
    Parts parts{ImageRgbF(frame.width, frame.height), ImageRgbF(frame.width, frame.height)};
    for (size_t i = 0; i < frame.pixels.size(); i += 3) {
        ImageRgbF& part = isClipped(&frame.pixels[i]) ? parts.clipped : parts.unclipped;
        for (size_t c = i; c < i + 3; ++c) part.pixels[c] = math::linearOfByte()[frame.pixels[c]];
    }
    return parts;
}

// Returns the true radiance of a frame's pixel. lit: coarser than the frame.
const float* litAt(const ImageRgb8& frame, const ImageRgbF& lit, int x, int y) {
    return lit.at(x * lit.width / frame.width, y * lit.height / frame.height);
}

// Returns the factor from true radiance to the frame's, by its unclipped pixels.
double exposureOf(const ImageRgb8& frame, const ImageRgbF& lit) {
    double both = 0, own = 0;
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x)
            for (int c = 0; !isClipped(frame.at(x, y)) && c < 3; ++c) {
                const double light = litAt(frame, lit, x, y)[c];
                both += light * double{math::linearOfByte()[frame.at(x, y)[c]]}, own += light * light;
            }
    return both / own;
}

// Sets each connected region of clipped pixels (over the seam too) to the mean of its true radiance. lit:
// true radiance, as fine as the frame or coarser; the frame is `exposure` times as bright.
ImageRgbF withTrueRegions(const ImageRgb8& frame, const ImageRgbF& lit, double exposure) {
    const Parts parts = partsOf(frame);
    ImageRgbF out = parts.unclipped;
    std::vector<uint8_t> left(out.pixels.size() / 3);
    for (size_t i = 0; i < left.size(); ++i) left[i] = isClipped(&frame.pixels[3 * i]);
    std::vector<std::pair<int, int>> region;
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x) {
            region.clear();
            const auto take = [&](int column, int row) {
                if (row < 0 || row == frame.height) return;
                column = (column + frame.width) % frame.width;
                uint8_t& waits = left[static_cast<size_t>(row) * frame.width + column];
                if (waits) region.emplace_back(column, row);
                waits = 0;
            };
            take(x, y);
            glm::dvec3 sum(0);
            double weights = 0;
            for (size_t i = 0; i < region.size(); ++i) {
                const auto [column, row] = region[i];
                const double weight = texelSolidAngle(row, frame.width, frame.height);
                const float* light = litAt(frame, lit, column, row);
                sum += weight * glm::dvec3(light[0], light[1], light[2]), weights += weight;
                take(column - 1, row), take(column + 1, row), take(column, row - 1), take(column, row + 1);
            }
            for (const auto& [column, row] : region)
                for (int c = 0; c < 3; ++c)
                    out.at(column, row)[c] = static_cast<float>(sum[c] / weights * exposure);
        }
    return out;
}

} // namespace

void measureToneMaps(Chart& chart, bool quick, std::span<const glm::dvec3> dirs) {
    const auto methods = inverseToneMapMethods();
    for (const auto& each : methods) chart.toneMaps.push_back({each.label, {}, {}});
    // Bounds that use the truth, which no method knows; they have no time.
    const size_t oneGain = methods.size(), trueRegions = methods.size() + 1;
    chart.toneMaps.push_back({{"bound: clipped pixels times the one best gain", "", "", ""}, {}, {}});
    chart.toneMaps.push_back({{"bound: clipped regions at their true means", "", "", ""}, {}, {}});
    const size_t first = chart.toneMaps.size();
    constexpr AVColorTransferCharacteristic kTransfers[] = {AVCOL_TRC_SMPTE2084, AVCOL_TRC_ARIB_STD_B67};
    chart.toneMaps.push_back({{"film in PQ, as measured", "", "", ""}, {}, {}});
    chart.toneMaps.push_back({{"film in HLG, as measured", "", "", ""}, {}, {}});
    const light::Lobe lobes[] = {light::diffuseLobe(), light::glossyLobe(0.5)};
    // lit: the light that the frame was filmed in, of 256 or 512 texels around. whole: the same, finer if it
    // is known so; the frame is `exposure` times as bright.
    const auto measure = [&](const std::string& name, const ImageRgb8& frame, const ImageRgbF& lit,
                             const ImageRgbF& whole, double exposure) {
        std::fprintf(stderr, "chart: inverse tone mapping, %s\n", name.c_str());
        chart.toneMapEnvironments.push_back(name);
        const Truth truth = integrals(lit, dirs, lobes);
        const auto add = [&](size_t row, const ImageRgbF& radianceLin) {
            const Truth got = integrals(quartered(radianceLin), dirs, lobes);
            auto& errors = chart.toneMaps[row].errors.emplace_back();
            for (size_t lobe = 0; lobe < std::size(lobes); ++lobe)
                errors.push_back(errorAfterScaling(column(got, lobe), column(truth, lobe)));
        };
        ImageRgbF expanded;
        for (size_t i = 0; i < methods.size(); ++i) {
            methods[i].expand(frame, expanded);
            add(i, expanded);
        }
        for (size_t i = 0; i < std::size(kTransfers); ++i)
            add(first + i, media::filmed(whole, AV_PIX_FMT_YUV420P10, kTransfers[i], exposure).light);
        add(trueRegions, withTrueRegions(frame, whole, exposure));
        const Parts parts = partsOf(frame);
        const Truth unclipped = integrals(quartered(parts.unclipped), dirs, lobes);
        const Truth clipped = integrals(quartered(parts.clipped), dirs, lobes);
        auto& best = chart.toneMaps[oneGain].errors.emplace_back();
        for (size_t lobe = 0; lobe < std::size(lobes); ++lobe) {
            const auto want = column(truth, lobe);
            best.push_back({1e30, 0});
            for (double gain = 1; gain < 2000; gain *= 1.1) {
                auto got = column(unclipped, lobe);
                const auto more = column(clipped, lobe);
                for (size_t i = 0; i < got.size(); ++i) got[i] += gain * more[i];
                const EnvironmentError error = errorAfterScaling(std::move(got), want);
                if (error.rms < best.back().rms) best.back() = error;
            }
        }
    };
    for (const EnvironmentSource& source : clippedSources()) {
        if (quick && chart.toneMapEnvironments.size() == 2) break;
        const auto environment = source.load();
        if (!environment) continue;
        const Exposed exposed = expose(environment->radianceLin);
        measure(source.name, exposed.frame, quartered(exposed.radianceLin), exposed.radianceLin, 1);
    }
    chart.toneMapsClipped = chart.toneMapEnvironments.size();
    chart.toneMapsApart = std::min(chart.toneMapsClipped, apartSources().size());
    for (const EnvironmentSource& source : filmedSources())
        if (const auto one = source.load()) {
            measure(source.name, one->frame, one->radianceLin, one->radianceLin,
                    exposureOf(one->frame, one->radianceLin));
            if (quick) break;
        }

    const ImageRgb8 frame = timedFrame();
    ImageRgbF expanded;
    for (size_t i = 0; i < methods.size(); ++i)
        chart.toneMaps[i].cost.update_us =
            shortest_us(quick ? 0 : 200, [&] { methods[i].expand(frame, expanded); });
}

} // namespace shoal::bench
