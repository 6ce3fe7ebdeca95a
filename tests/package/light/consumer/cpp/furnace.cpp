// Light that is known, by the C++ header. Exits 1 with what was wrong.
#include <ShoalLight.hpp>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <thread>
#include <vector>

namespace {

constexpr int kWidth = 512, kHeight = 256;
int failures = 0;

void near(const char* what, double value, double wanted, double tolerance) {
    std::printf("%s: %.6f (%.6f)\n", what, value, wanted);
    if (std::abs(value - wanted) <= tolerance) return;
    std::fprintf(stderr, "%s is %.6f instead of %.6f\n", what, value, wanted);
    ++failures;
}

} // namespace

int main() {
    shoallight::Maker maker;
    shoallight::Light light;
    near("an empty light's maps", light.maps().mapCount, 0, 0);
    near("an empty light", light.diffuse({0, 1, 0})[0], 0, 0);

    std::thread decoder([&] { // where a program would make light
        const std::vector<float> white(3 * kWidth * kHeight, 1.0f);
        maker.make({white.data(), kWidth, kHeight, 0, SHOAL_LIGHT_RGB32F}, light);
    });
    decoder.join();
    near("irradiance in a white furnace", 3.14159265 * light.diffuse({0, 0.6f, -0.8f})[2], 3.14159265, 1e-4);
    near("a mirror of roughness 0.5", light.glossy({1, 0, 0}, 0.5f)[1], 1, 1e-4);
    near("maps down to a roughness of 0.25", light.maps().mapCount, 11, 0);
    near("no mirrors unless asked for", light.maps().mirrorLevels, 0, 0);

    // Coded orange. Its light is that of the formula, whatever the order of its bytes.
    const float coded[3] = {1, 0.5f, 0};
    float radiance[3];
    shoalLightRadianceFromDisplay(coded, radiance);
    std::vector<uint8_t> orange;
    for (int i = 0; i < kWidth * kHeight; ++i) orange.insert(orange.end(), {255, 128, 0, 7});
    maker.make({orange.data(), kWidth, kHeight, 0, SHOAL_LIGHT_RGBA8}, light);
    near("red of a surface in orange", light.diffuse({0, 1, 0})[0], radiance[0], 0.01 * radiance[0]);
    near("green of a surface in orange", light.diffuse({0, 1, 0})[1], radiance[1], 0.01 * radiance[0]);
    maker.make({orange.data(), kWidth, kHeight, 0, SHOAL_LIGHT_BGRA8}, light);
    near("blue of a surface in blue", light.diffuse({0, 1, 0})[2] > 5 * light.diffuse({0, 1, 0})[0], 1, 0);

    try {
        shoallight::Maker({SHOAL_LIGHT_VIDEO, -1, 1024});
        near("a maker of a roughness below 0", 1, 0, 0);
    } catch (const shoallight::Error& error) {
        near("its failure's status", error.status, SHOAL_LIGHT_BAD_ARGUMENT, 0);
    }
    return failures > 0;
}
