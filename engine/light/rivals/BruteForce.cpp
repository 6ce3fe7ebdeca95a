#include "engine/light/rivals/Rivals.h"

#include "engine/light/Lookup.h"
#include "engine/light/Vectorise.h"
#include "engine/light/rivals/Levels.h"
#include "engine/math/LatLong.h"

#include <memory>

namespace shoal::light::rivals {

namespace {

// Directions of texels and what comes from them (or arrives at them), as planes for the vectoriser.
struct Planes {
    std::vector<float> x, y, z;          // unit length
    std::vector<float> solidAngleOverPi; // steradians / pi
    std::vector<float> r, g, b;

    explicit Planes(int width) {
        const int height = width / 2;
        for (int row = 0; row < height; ++row)
            for (int column = 0; column < width; ++column) {
                const auto d = directionFromLatLong(glm::dvec2((column + 0.5) / width, (row + 0.5) / height));
                x.push_back(static_cast<float>(d.x));
                y.push_back(static_cast<float>(d.y));
                z.push_back(static_cast<float>(d.z));
                solidAngleOverPi.push_back(
                    static_cast<float>(texelSolidAngle(row, width, height) * std::numbers::inv_pi));
            }
        for (auto* plane : {&r, &g, &b}) plane->resize(x.size());
    }
};

constexpr size_t kBlock = 64; // texels out, so that their sums stay in the nearest cache

SHOAL_VECTORISE
void gather(const float* __restrict nx, const float* __restrict ny, const float* __restrict nz,
            const Planes& in, float* __restrict outR, float* __restrict outG, float* __restrict outB) {
    for (size_t i = 0; i < in.x.size(); ++i) {
        const float x = in.x[i], y = in.y[i], z = in.z[i], r = in.r[i], g = in.g[i], b = in.b[i];
        for (size_t k = 0; k < kBlock; ++k) {
            const float cosine = nx[k] * x + ny[k] * y + nz[k] * z;
            const float clamped = cosine > 0 ? cosine : 0;
            outR[k] += clamped * r;
            outG[k] += clamped * g;
            outB[k] += clamped * b;
        }
    }
}

struct State {
    Planes planes; // the same texels in and out, but for the radiance
    std::vector<float> r, g, b;
    ImageRgbF map;

    explicit State(int width) : planes(width), map(width, width / 2) {}

    void make(const ImageRgbF& level) {
        for (size_t i = 0; i < planes.x.size(); ++i) {
            planes.r[i] = level.pixels[3 * i] * planes.solidAngleOverPi[i];
            planes.g[i] = level.pixels[3 * i + 1] * planes.solidAngleOverPi[i];
            planes.b[i] = level.pixels[3 * i + 2] * planes.solidAngleOverPi[i];
        }
        for (auto* sums : {&r, &g, &b}) sums->assign(planes.x.size(), 0.0f);
        for (size_t i = 0; i < planes.x.size(); i += kBlock)
            gather(&planes.x[i], &planes.y[i], &planes.z[i], planes, &r[i], &g[i], &b[i]);
        for (size_t i = 0; i < planes.x.size(); ++i)
            map.pixels[3 * i] = r[i], map.pixels[3 * i + 1] = g[i], map.pixels[3 * i + 2] = b[i];
    }
};

} // namespace

DiffuseMethod bruteForce(int width) {
    auto state = std::make_shared<State>(width);
    const std::string size = std::to_string(width) + "x" + std::to_string(width / 2);
    return {{"brute force " + size, size, "brute force", "thesis, eq. 2.2",
             width == 64 ? Role::Thesis : Role::Rival},
            true,
            [state, width](const Input& input) { state->make(levelOfWidth(*input.pyramid, width)); },
            [state](std::span<const glm::vec3> normals, std::span<glm::vec3> out) {
                for (size_t i = 0; i < normals.size(); ++i) out[i] = lookUp(state->map, normals[i]);
            }};
}

} // namespace shoal::light::rivals
