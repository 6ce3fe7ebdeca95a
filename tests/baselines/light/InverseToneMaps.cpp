#include "tests/baselines/light/Baselines.h"
#include "tests/baselines/light/Expand.h"

#include "engine/light/InverseToneMap.h"
#include "engine/light/Pyramid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shoal::light::baselines {

namespace {

template <class Expand> InverseToneMapMethod method(Label label, Expand expand) {
    return {std::move(label),
            [expand](const ImageRgb8& frame, ImageRgbF& out) { forEach(frame, out, expand); }};
}

// Statistics of a picture by Masia et al.: luminances of decoded values; natural logarithms.
struct Statistics {
    float logMean = 0, key = 0, clippedPercent = 0;
};

Statistics statisticsOf(const ImageRgbF& linear) {
    constexpr float kNone = 1e-6f; // black has no logarithm
    double sum = 0, clipped = 0;
    float least = std::numeric_limits<float>::max(), most = kNone;
    for (size_t i = 0; i < linear.pixels.size(); i += 3) {
        const float* texel = &linear.pixels[i];
        const float l = linearLuminance({texel[0], texel[1], texel[2]});
        sum += std::log(l + kNone);
        clipped += l * 255 >= 254;
        least = std::min(least, l + kNone), most = std::max(most, l + kNone);
    }
    const auto count = static_cast<double>(linear.pixels.size() / 3);
    const auto logMean = static_cast<float>(sum / count);
    return {logMean, (logMean - std::log(least)) / std::max(std::log(most) - std::log(least), 1e-6f),
            static_cast<float>(100 * clipped / count)};
}

template <class Gamma> InverseToneMapMethod masia(std::string year, Gamma gammaOf) {
    return {{"luminance to a power by statistics, " + year, "", "", "Masia et al. " + year},
            [gammaOf](const ImageRgb8& frame, ImageRgbF& out) {
                forEach(frame, out, decoded);
                const float gamma = gammaOf(statisticsOf(out));
                for (size_t i = 0; i < out.pixels.size(); i += 3) {
                    float* texel = &out.pixels[i];
                    const float l = linearLuminance({texel[0], texel[1], texel[2]});
                    const float scale = l > 0 ? std::pow(l, gamma - 1) : 0.0f;
                    for (int c = 0; c < 3; ++c) texel[c] *= scale;
                }
            }};
}

// How near clipped pixels are, 0 to 1, on a map of 128 x 64 texels; as the papers do, without regard to what
// a lat-long stretches. likeness: how much luminances may differ, coded; the largest: any.
InverseToneMapMethod brightenedAround(Label label, int clippedFrom, float sigma_texels, float likeness) {
    return {std::move(label), [=](const ImageRgb8& frame, ImageRgbF& out) {
                constexpr int kWidth = 128, kHeight = 64;
                std::vector<float> clipped(kWidth * kHeight), level(clipped.size()), count(clipped.size());
                const auto cellOf = [&](size_t pixel) {
                    const size_t x = pixel % frame.width, y = pixel / frame.width;
                    return y * kHeight / frame.height * kWidth + x * kWidth / frame.width;
                };
                for (size_t i = 0; i < frame.pixels.size(); i += 3) {
                    const uint8_t* coded = &frame.pixels[i];
                    const size_t cell = cellOf(i / 3);
                    clipped[cell] += std::max({coded[0], coded[1], coded[2]}) >= clippedFrom;
                    level[cell] += linearLuminance(glm::vec3(coded[0], coded[1], coded[2]) / 255.0f);
                    ++count[cell];
                }
                for (size_t i = 0; i < count.size(); ++i)
                    if (count[i] > 0) clipped[i] /= count[i], level[i] /= count[i];
                std::vector<float> near(clipped.size());
                const int reach = static_cast<int>(3 * sigma_texels);
                for (int y = 0; y < kHeight; ++y)
                    for (int x = 0; x < kWidth; ++x) {
                        const auto at = static_cast<size_t>(y * kWidth + x);
                        float sum = 0, weights = 0;
                        for (int j = std::max(0, y - reach); j <= std::min(kHeight - 1, y + reach); ++j)
                            for (int i = -reach; i <= reach; ++i) {
                                const auto from =
                                    static_cast<size_t>(j * kWidth + ((x + i) % kWidth + kWidth) % kWidth);
                                if (count[from] == 0) continue;
                                const float apart = static_cast<float>(i * i + (j - y) * (j - y)) /
                                                    (sigma_texels * sigma_texels);
                                const float unlike = (level[from] - level[at]) / likeness;
                                const float weight = std::exp(-0.5f * (apart + unlike * unlike));
                                sum += weight * clipped[from], weights += weight;
                            }
                        near[at] = weights > 0 ? sum / weights : 0.0f;
                    }
                forEach(frame, out, decoded);
                for (size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] *= 1 + 3 * near[cellOf(i / 3)];
            }};
}

} // namespace

InverseToneMapMethod masia2009() {
    return masia("2009", [](const Statistics& of) { return 10.44f * of.key - 6.282f; });
}

InverseToneMapMethod masia2017() {
    return masia("2017", [](const Statistics& of) {
        return 2.4379f + 0.2319f * of.logMean - 1.1228f * of.key + 0.0085f * of.clippedPercent;
    });
}

InverseToneMapMethod rempel() {
    // A standard deviation of 30 pixels at 1920 around.
    return brightenedAround({"brightened around what is clipped", "", "", "Rempel et al. 2007"}, 230,
                            30 * 128 / 1920.0f, std::numeric_limits<float>::max());
}

InverseToneMapMethod kovaleski() {
    return brightenedAround({"the same by a bilateral filter", "", "", "Kovaleski and Oliveira 2014"}, 230,
                            150 * 128 / 1920.0f, 25 / 255.0f);
}

InverseToneMapMethod thesisInverse(bool linearised) {
    if (linearised)
        return method({"thesis' operator, of linearised values", "", "", "thesis, eq. 4.1 to 4.3"},
                      [](const glm::vec3& coded) { return radianceFromDisplay(decoded(coded)); });
    return method({"thesis' operator, of coded values", "", "", "thesis, eq. 4.1 to 4.3", Role::Thesis},
                  [](const glm::vec3& coded) { return radianceFromDisplay(coded); });
}

InverseToneMapMethod plainLinear() { return method({"sRGB decoded", "", "", "IEC 61966-2-1"}, decoded); }

InverseToneMapMethod clippedLight() {
    return {{"clipped light by the ground's", "", "", "this project", Role::Default},
            [](const ImageRgb8& frame, ImageRgbF& out) {
                // At the frame's own width, or the next power of two below.
                PyramidMaker maker;
                RadiancePyramid pyramid;
                maker.make({frame.at(0, 0), frame.width, frame.height, ptrdiff_t{3} * frame.width, false},
                           frame.width, pyramid, FrameRadiance::Auto);
                out = std::move(pyramid.levels[0]);
            }};
}

InverseToneMapMethod akyuz(float gamma) {
    const std::string name = gamma == 1 ? "luminance stretched" : "luminance stretched, to the power of 2.2";
    return {{name, "", "", "Akyuz et al. 2007"}, [gamma](const ImageRgb8& frame, ImageRgbF& out) {
                float minimum = std::numeric_limits<float>::max(), maximum = 0;
                forEach(frame, out, [&](const glm::vec3& coded) {
                    const glm::vec3 linear = decoded(coded);
                    const float l = linearLuminance(linear);
                    minimum = std::min(minimum, l), maximum = std::max(maximum, l);
                    return linear;
                });
                forEach(frame, out, [&](const glm::vec3& coded) {
                    return akyuzRadiance(decoded(coded), minimum, maximum, 1, gamma);
                });
            }};
}

InverseToneMapMethod landis() {
    return method({"expanded above half", "", "", "Landis 2002"},
                  [](const glm::vec3& coded) { return landisRadiance(decoded(coded)); });
}

} // namespace shoal::light::baselines
