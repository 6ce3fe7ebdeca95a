#include "tests/baselines/light/Baselines.h"

#include "engine/light/InverseToneMap.h"
#include "engine/math/Colour.h"

#include <limits>

namespace shoal::light::baselines {

namespace {

float luminance(const glm::vec3& linear) {
    return 0.2126f * linear.x + 0.7152f * linear.y + 0.0722f * linear.z; // Rec. 709
}

glm::vec3 decoded(const glm::vec3& coded) {
    return {math::linearFromSrgb(coded.x), math::linearFromSrgb(coded.y), math::linearFromSrgb(coded.z)};
}

// expand(coded colour): 0 to 1 in, linear radiance out.
template <class Expand> void forEach(const ImageRgb8& frame, ImageRgbF& out, Expand&& expand) {
    if (out.width != frame.width || out.height != frame.height) out = ImageRgbF(frame.width, frame.height);
    for (size_t i = 0; i < frame.pixels.size(); i += 3) {
        const uint8_t* coded = &frame.pixels[i];
        const glm::vec3 radiance = expand(glm::vec3(coded[0], coded[1], coded[2]) / 255.0f);
        for (int c = 0; c < 3; ++c) out.pixels[i + static_cast<size_t>(c)] = radiance[c];
    }
}

template <class Expand> InverseToneMapMethod method(Label label, Expand expand) {
    return {std::move(label),
            [expand](const ImageRgb8& frame, ImageRgbF& out) { forEach(frame, out, expand); }};
}

} // namespace

InverseToneMapMethod thesisInverse(bool linearised) {
    if (linearised)
        return method({"thesis' operator, of linearised values", "", "", "thesis, eq. 4.1 to 4.3"},
                      [](const glm::vec3& coded) { return radianceFromDisplay(decoded(coded)); });
    return method({"thesis' operator, of coded values", "", "", "thesis, eq. 4.1 to 4.3", Role::Default},
                  [](const glm::vec3& coded) { return radianceFromDisplay(coded); });
}

InverseToneMapMethod plainLinear() { return method({"sRGB decoded", "", "", "IEC 61966-2-1"}, decoded); }

InverseToneMapMethod akyuz(float gamma) {
    const std::string name = gamma == 1 ? "luminance stretched" : "luminance stretched, to the power of 2.2";
    return {{name, "", "", "Akyuz et al. 2007"}, [gamma](const ImageRgb8& frame, ImageRgbF& out) {
                float minimum = std::numeric_limits<float>::max(), maximum = 0;
                forEach(frame, out, [&](const glm::vec3& coded) {
                    const glm::vec3 linear = decoded(coded);
                    const float l = luminance(linear);
                    minimum = std::min(minimum, l), maximum = std::max(maximum, l);
                    return linear;
                });
                const float range = std::max(maximum - minimum, 1e-6f);
                for (size_t i = 0; i < out.pixels.size(); i += 3) {
                    float* texel = &out.pixels[i];
                    const float l = luminance({texel[0], texel[1], texel[2]});
                    const float scale =
                        l > 0 ? std::pow(std::max(0.0f, l - minimum) / range, gamma) / l : 0.0f;
                    for (int c = 0; c < 3; ++c) texel[c] *= scale;
                }
            }};
}

InverseToneMapMethod landis() {
    return method({"expanded above half", "", "", "Landis 2002"}, [](const glm::vec3& coded) {
        constexpr float kThreshold = 0.5f, kMax = 10;
        const glm::vec3 linear = decoded(coded);
        const float above = std::max(0.0f, (luminance(linear) - kThreshold) / (1 - kThreshold));
        const float part = above * above;
        return linear * (1 - part + part * kMax);
    });
}

} // namespace shoal::light::baselines
