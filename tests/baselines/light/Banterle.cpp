// Banterle, Ledda, Debattista and Chalmers 2006, "Inverse Tone Mapping": the inverse of Reinhard's operator
// where the frame has much light, told by the density of the lights that a median cut finds (Debevec 2005, "A
// Median Cut Algorithm for Light Probe Sampling"); the frame as decoded elsewhere.
#include "engine/light/InverseToneMap.h"
#include "tests/baselines/light/Baselines.h"
#include "tests/baselines/light/Expand.h"

#include <algorithm>
#include <cmath>

namespace shoal::light::baselines {

namespace {

constexpr int kWidth = 128, kHeight = 64; // of the map that lights are sought in
constexpr int kCuts = 8;                  // 2^kCuts lights
constexpr float kWhiteRadiance = 10;      // what white becomes, and from which on Reinhard's operator clips
constexpr int kReach = 6;                 // texels: of a light's kernel

struct Region {
    int left, top, right, bottom; // of texels; the last two are not in it
};

class LightMap {
  public:
    explicit LightMap(const ImageRgbF& linear) : sums_(kWidth * kHeight), density_(kWidth * kHeight) {
        for (int y = 0; y < linear.height; ++y)
            for (int x = 0; x < linear.width; ++x) {
                const float* t = linear.at(x, y);
                sums_[at(x * kWidth / linear.width, y * kHeight / linear.height)] +=
                    linearLuminance({t[0], t[1], t[2]});
            }
        cut({0, 0, kWidth, kHeight}, kCuts);
        const float most = *std::ranges::max_element(density_);
        for (float& each : density_) each /= std::max(most, 1e-6f);
    }

    // 0 to 1.
    float of(int x, int y, const ImageRgb8& frame) const {
        return density_[at(x * kWidth / frame.width, y * kHeight / frame.height)];
    }

  private:
    static size_t at(int x, int y) { return static_cast<size_t>(y * kWidth + x); }

    float sumOf(const Region& r) const {
        float sum = 0;
        for (int y = r.top; y < r.bottom; ++y)
            for (int x = r.left; x < r.right; ++x) sum += sums_[at(x, y)];
        return sum;
    }

    // Halves the light of the region along its longer side, and those again; lights are the last ones.
    void cut(const Region& r, int left) {
        const bool wide = r.right - r.left >= r.bottom - r.top;
        if (left == 0 || (wide ? r.right - r.left : r.bottom - r.top) < 2) {
            addLight(r);
            return;
        }
        const float half = sumOf(r) / 2;
        Region first = r, second = r;
        int& edge = wide ? first.right : first.bottom;
        edge = (wide ? r.left : r.top) + 1;
        while (edge < (wide ? r.right : r.bottom) - 1 && sumOf(first) < half) ++edge;
        (wide ? second.left : second.top) = edge;
        cut(first, left - 1);
        cut(second, left - 1);
    }

    // Its luminance, spread around its middle by a kernel that falls to 0 (Epanechnikov's).
    void addLight(const Region& r) {
        const int x0 = (r.left + r.right) / 2, y0 = (r.top + r.bottom) / 2;
        const float light = sumOf(r);
        for (int y = std::max(0, y0 - kReach); y <= std::min(kHeight - 1, y0 + kReach); ++y)
            for (int x = x0 - kReach; x <= x0 + kReach; ++x) {
                const float apart = static_cast<float>((x - x0) * (x - x0) + (y - y0) * (y - y0)) /
                                    static_cast<float>(kReach * kReach);
                density_[at((x + kWidth) % kWidth, y)] += light * std::max(0.0f, 1 - apart);
            }
    }

    std::vector<float> sums_, density_;
};

} // namespace

InverseToneMapMethod banterle() {
    return {{"Reinhard's inverse where there is much light", "", "", "Banterle et al. 2006"},
            [](const ImageRgb8& frame, ImageRgbF& out) {
                forEach(frame, out, decoded);
                const LightMap lights(out);
                for (int y = 0; y < out.height; ++y)
                    for (int x = 0; x < out.width; ++x) {
                        float* texel = out.at(x, y);
                        const float l = linearLuminance({texel[0], texel[1], texel[2]});
                        if (!(l > 0)) continue;
                        const float expanded =
                            0.5f * kWhiteRadiance * kWhiteRadiance *
                            (l - 1 +
                             std::sqrt((1 - l) * (1 - l) + 4 * l / (kWhiteRadiance * kWhiteRadiance)));
                        const float part = lights.of(x, y, frame);
                        for (int c = 0; c < 3; ++c) texel[c] *= 1 + part * (expanded / l - 1);
                    }
            }};
}

} // namespace shoal::light::baselines
