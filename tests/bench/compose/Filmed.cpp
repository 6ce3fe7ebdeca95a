#include "tests/bench/compose/Filmed.h"

#include "content/make/video/Tone.h"
#include "engine/core/Random.h"
#include "engine/light/InverseToneMap.h"
#include "engine/math/LatLong.h"

#include <glm/gtc/type_ptr.hpp>
#include <opencv2/imgproc.hpp>

namespace shoal::bench {

namespace {

// The film's camera; numbers as in content/make/video.
constexpr float kNoise = 0.004f;
constexpr float kGlowShare = 0.06f;
constexpr float kSharpening = 1.4f;

using reef::toned;

// For each display value the signal that the camera shows as it.
const std::array<float, 256> kSignals = [] {
    std::array<float, 256> table{};
    for (size_t i = 0; i < 256; ++i) {
        float low = 0, high = 1.18f; // high: the signal at which it clips; white may have been brighter
        for (int step = 0; step < 40; ++step) {
            const float middle = (low + high) / 2;
            (toned(middle) * 255 < static_cast<float>(i) ? low : high) = middle;
        }
        table[i] = high;
    }
    return table;
}();

using Layer = Image<float, 4>; // premultiplied, coverage last; no object stands across the seam

template <class Pixels> cv::Mat matOf(Pixels& image) {
    return {image.height, image.width, CV_32FC(Pixels::channels), image.pixels.data()};
}

// Returns the objects in the film's texels, each the mean of kSamples^2 directions.
Layer seenBy(const ImageRgba8& objects, const render::View& view, const glm::mat3& envFromWorld, int width) {
    constexpr int kSamples = 3;
    Layer out(width, width / 2);
    const glm::mat3 eyeFromEnv = glm::transpose(envFromWorld * glm::mat3_cast(view.worldFromEye));
    const glm::vec2 half = view.halfExtent(), size(objects.width, objects.height);
    const auto pixelOf = [&](float x, float y) -> const uint8_t* {
        const glm::vec3 d = eyeFromEnv * directionFromLatLong(glm::vec2(x / static_cast<float>(width),
                                                                        y / static_cast<float>(width / 2)));
        if (d.z > -0.01f) return nullptr;
        const glm::vec2 at =
            ((glm::vec2(d.x, d.y) / -d.z - view.shift) / half * glm::vec2(0.5f, -0.5f) + 0.5f) * size;
        if (at.x < 0 || at.y < 0 || at.x >= size.x || at.y >= size.y) return nullptr;
        return objects.at(static_cast<int>(at.x), static_cast<int>(at.y));
    };
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
            if (!pixelOf(fx + 0.5f, fy + 0.5f)) continue;
            float* to = out.at(x, y);
            for (int i = 0; i < kSamples * kSamples; ++i) {
                const uint8_t* pixel = pixelOf(fx + (static_cast<float>(i % kSamples) + 0.5f) / kSamples,
                                               fy + (static_cast<float>(i / kSamples) + 0.5f) / kSamples);
                if (!pixel || pixel[3] == 0) continue;
                const float cover = static_cast<float>(pixel[3]) / 255;
                for (int c = 0; c < 3; ++c)
                    to[c] +=
                        cover *
                        kSignals[static_cast<size_t>(std::min(static_cast<float>(pixel[c]) / cover, 255.0f))];
                to[3] += cover;
            }
            for (int c = 0; c < 4; ++c) to[c] /= kSamples * kSamples;
        }
    return out;
}

ImageRgbF signalOf(const ImageRgb8& frame) {
    ImageRgbF out(frame.width, frame.height);
    std::ranges::transform(frame.pixels, out.pixels.begin(), [](uint8_t value) { return kSignals[value]; });
    return out;
}

// Returns the light that port and lens scatter, by three running means over seven squares of texels.
constexpr int kGlowTexels = 8;
ImageRgbF glowOf(ImageRgbF& in) {
    ImageRgbF out(in.width / kGlowTexels, in.height / kGlowTexels);
    cv::Mat glow = matOf(out);
    cv::resize(matOf(in), glow, glow.size(), 0, 0, cv::INTER_AREA);
    for (int i = 0; i < 3; ++i) cv::blur(glow, glow, {7, 7}, {-1, -1}, cv::BORDER_REPLICATE);
    return out;
}

// Applies glare, noise and tone to the frame, then sharpens it.
void develop(ImageRgb8& frame, Layer layer, uint32_t seed) {
    ImageRgbF behind = signalOf(frame);
    const ImageRgbF glow = glowOf(behind);
    Random random(seed, 11);
    for (int y = 0; y < layer.height; ++y)
        for (int x = 0; x < layer.width; ++x) {
            float* to = layer.at(x, y);
            const float cover = to[3];
            if (cover <= 0) continue;
            for (int c = 0; c < 3; ++c) {
                const float unseen = 1 - cover;
                float signal = (1 - kGlowShare) * to[c] +
                               kGlowShare * cover * glow.at(x / kGlowTexels, y / kGlowTexels)[c] +
                               unseen * behind.at(x, y)[c];
                const float dice = random.unit() + random.unit() - 1;
                signal += cover * 2.4f * kNoise * dice * std::sqrt(std::min(signal, 1.0f) + 0.02f);
                to[c] = toned(signal) - unseen * toned(behind.at(x, y)[c]);
            }
        }
    Layer soft(layer.width, layer.height);
    const cv::Matx<float, 5, 1> weights(0.0625f, 0.25f, 0.375f, 0.25f, 0.0625f);
    cv::sepFilter2D(matOf(layer), matOf(soft), CV_32F, weights, weights, {-1, -1}, 0, cv::BORDER_REPLICATE);
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x) {
            const float* l = layer.at(x, y);
            const float* s = soft.at(x, y);
            if (l[3] == 0 && s[3] == 0) continue;
            uint8_t* to = frame.at(x, y);
            const glm::vec3 was = glm::vec3(to[0], to[1], to[2]) / 255.0f;
            const glm::vec3 finer = glm::make_vec3(l) - glm::make_vec3(s) - (l[3] - s[3]) * was;
            const float extra = kSharpening * light::linearLuminance(finer);
            for (int c = 0; c < 3; ++c)
                to[c] = static_cast<uint8_t>(
                    std::clamp(255 * (was[c] * (1 - l[3]) + l[c] + extra) + 0.5f, 0.0f, 255.0f));
        }
}

} // namespace

void filmInto(std::span<ImageRgb8* const> takes, const ImageRgba8& objects, const render::View& view,
              const glm::mat3& envFromWorld, uint32_t seed) {
    Layer sharp = seenBy(objects, view, envFromWorld, takes[0]->width), layer(sharp.width, sharp.height);
    const cv::Matx33f lens(0, 0.13f, 0, 0.13f, 0.48f, 0.13f, 0, 0.13f, 0); // shares of a texel's light
    cv::filter2D(matOf(sharp), matOf(layer), CV_32F, lens, {-1, -1}, 0, cv::BORDER_REPLICATE);
    for (ImageRgb8* take : takes) develop(*take, layer, seed++ * 2654435761u);
}

} // namespace shoal::bench
