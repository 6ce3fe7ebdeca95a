#include "tests/bench/compose/Filmed.h"

#include "content/make/video/Tone.h"
#include "engine/core/Random.h"
#include "engine/math/LatLong.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace shoal::bench {

namespace {

// The film's camera; numbers as in content/make/video.
constexpr float kNoise = 0.004f;
constexpr float kGlowShare = 0.06f;
constexpr float kSharpening = 1.4f;

using reef::toned;

// Returns, for each display value, the signal that the camera shows as it.
std::array<float, 256> signals() {
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
}

using Layer = Image<float, 4>; // premultiplied, coverage last

// Rectangle of a picture that holds everything that is not empty.
struct Part {
    int left = 0, top = 0, right = 0, bottom = 0;
};

Part partOf(const Layer& layer, int margin) {
    Part part{layer.width, layer.height, 0, 0};
    for (int y = 0; y < layer.height; ++y)
        for (int x = 0; x < layer.width; ++x)
            if (layer.at(x, y)[3] != 0) {
                part.left = std::min(part.left, x);
                part.right = std::max(part.right, x + 1);
                part.top = std::min(part.top, y);
                part.bottom = std::max(part.bottom, y + 1);
            }
    return {std::max(part.left - margin, 0), std::max(part.top - margin, 0),
            std::min(part.right + margin, layer.width), std::min(part.bottom + margin, layer.height)};
}

// Filters rows and columns by weights of texels from -reach to reach; texels beyond an edge repeat it. No
// object here stands across the seam.
template <class Pixels>
Pixels filtered(const Pixels& in, const std::vector<float>& weights, const Part& part) {
    const int reach = static_cast<int>(weights.size() / 2);
    Pixels along(in.width, in.height), out(in.width, in.height);
    for (const bool rows : {true, false}) {
        const Pixels& from = rows ? in : along;
        Pixels& to = rows ? along : out;
        for (int y = part.top; y < part.bottom; ++y)
            for (int x = part.left; x < part.right; ++x)
                for (int i = -reach; i <= reach; ++i) {
                    const auto* value = rows ? from.at(std::clamp(x + i, 0, in.width - 1), y)
                                             : from.at(x, std::clamp(y + i, 0, in.height - 1));
                    for (int c = 0; c < Pixels::channels; ++c)
                        to.at(x, y)[c] += weights[static_cast<size_t>(i + reach)] * value[c];
                }
    }
    return out;
}

// Returns the objects in the film's texels, each the mean of kSamples^2 directions.
Layer seenBy(const ImageRgba8& objects, const render::View& view, const glm::mat3& envFromWorld, int width) {
    static const std::array<float, 256> signal = signals();
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
                        signal[static_cast<size_t>(std::min(static_cast<float>(pixel[c]) / cover, 255.0f))];
                to[3] += cover;
            }
            for (int c = 0; c < 4; ++c) to[c] /= kSamples * kSamples;
        }
    return out;
}

float lumaOf(const float* c) { return 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2]; }

ImageRgbF signalOf(const ImageRgb8& frame) {
    static const std::array<float, 256> signal = signals();
    ImageRgbF out(frame.width, frame.height);
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x)
            for (int c = 0; c < 3; ++c) out.at(x, y)[c] = signal[frame.at(x, y)[c]];
    return out;
}

// Returns the light that port and lens scatter, by three running means over seven squares of texels.
constexpr int kGlowTexels = 8;
ImageRgbF glowOf(const ImageRgbF& in) {
    ImageRgbF out(in.width / kGlowTexels, in.height / kGlowTexels);
    for (int y = 0; y < out.height * kGlowTexels; ++y)
        for (int x = 0; x < out.width * kGlowTexels; ++x)
            for (int c = 0; c < 3; ++c)
                out.at(x / kGlowTexels, y / kGlowTexels)[c] += in.at(x, y)[c] / (kGlowTexels * kGlowTexels);
    for (int i = 0; i < 3; ++i)
        out = filtered(out, std::vector<float>(7, 1 / 7.0f), {0, 0, out.width, out.height});
    return out;
}

// Applies glare, noise and tone to the frame, then sharpens it.
void develop(ImageRgb8& frame, Layer layer, uint32_t seed) {
    const ImageRgbF behind = signalOf(frame), glow = glowOf(behind);
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
    const Layer soft = filtered(layer, {0.0625f, 0.25f, 0.375f, 0.25f, 0.0625f}, partOf(layer, 2));
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x) {
            const float* l = layer.at(x, y);
            const float* s = soft.at(x, y);
            if (l[3] == 0 && s[3] == 0) continue;
            uint8_t* to = frame.at(x, y);
            const float was[3] = {static_cast<float>(to[0]) / 255, static_cast<float>(to[1]) / 255,
                                  static_cast<float>(to[2]) / 255};
            const float extra = kSharpening * (lumaOf(l) - lumaOf(s) - (l[3] - s[3]) * lumaOf(was));
            for (int c = 0; c < 3; ++c)
                to[c] = static_cast<uint8_t>(
                    std::clamp(255 * (was[c] * (1 - l[3]) + l[c] + extra) + 0.5f, 0.0f, 255.0f));
        }
}

} // namespace

void filmInto(std::span<ImageRgb8* const> takes, const ImageRgba8& objects, const render::View& view,
              const glm::mat3& envFromWorld, uint32_t seed) {
    Layer layer = seenBy(objects, view, envFromWorld, takes[0]->width);
    // The lens: 0.48 of a texel's light, 0.13 of each neighbour's.
    const Layer sharp = layer;
    const Part lit = partOf(sharp, 1);
    for (int y = std::max(lit.top, 1); y < std::min(lit.bottom, layer.height - 1); ++y)
        for (int x = std::max(lit.left, 1); x < std::min(lit.right, layer.width - 1); ++x)
            for (int c = 0; c < 4; ++c)
                layer.at(x, y)[c] =
                    0.48f * sharp.at(x, y)[c] + 0.13f * (sharp.at(x + 1, y)[c] + sharp.at(x - 1, y)[c] +
                                                         sharp.at(x, y - 1)[c] + sharp.at(x, y + 1)[c]);
    for (ImageRgb8* take : takes) develop(*take, layer, seed++ * 2654435761u);
}

} // namespace shoal::bench
