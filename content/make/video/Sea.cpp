#include "content/make/video/Sea.h"

#include "engine/core/Random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <thread>

namespace shoal::reef {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;
using Complex = std::complex<float>;

// Computes an FFT in place, without scaling; n is a power of two, roots holds exp(+2 pi i k / n).
void transform(Complex* data, int n, const std::vector<Complex>& roots) {
    for (int i = 1, j = 0; i < n; ++i) {
        int bit = n >> 1;
        for (; j & bit; bit >>= 1) j ^= bit;
        j ^= bit;
        if (i < j) std::swap(data[i], data[j]);
    }
    for (int half = 1; half < n; half *= 2) {
        const int stride = n / (2 * half);
        for (int start = 0; start < n; start += 2 * half)
            for (int k = 0; k < half; ++k) {
                const Complex a = data[start + k], w = roots[static_cast<size_t>(k * stride)],
                              b = data[start + k + half];
                const Complex turned(w.real() * b.real() - w.imag() * b.imag(),
                                     w.real() * b.imag() + w.imag() * b.real());
                data[start + k] = a + turned;
                data[start + k + half] = a - turned;
            }
    }
}

int wrapped(int i, int side) { return i & (side - 1); }

// Samples a repeating square bilinearly; p in texels.
template <class T> T repeating(const std::vector<T>& texels, int side, vec2 p) {
    const vec2 base = glm::floor(p), f = p - base;
    const int x0 = wrapped(static_cast<int>(base.x), side), x1 = wrapped(x0 + 1, side);
    const int y0 = wrapped(static_cast<int>(base.y), side), y1 = wrapped(y0 + 1, side);
    const auto at = [&](int x, int y) { return texels[static_cast<size_t>(y * side + x)]; };
    return (at(x0, y0) * (1 - f.x) + at(x1, y0) * f.x) * (1 - f.y) +
           (at(x0, y1) * (1 - f.x) + at(x1, y1) * f.x) * f.y;
}

} // namespace

Sea::Sea(const Scene& scene) : tile_(scene.waves.tile), amplitudes_(kSide * kSide), turns_(kSide * kSide) {
    const Waves& waves = scene.waves;
    const float duration = static_cast<float>(scene.film.frames) / static_cast<float>(scene.film.fps);
    const vec2 wind(std::sin(waves.wind), -std::cos(waves.wind));
    Random random(7);
    double variance = 0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const vec2 k =
                vec2(x < kSide / 2 ? x : x - kSide, y < kSide / 2 ? y : y - kSide) * (2 * kPi / tile_);
            const float length = glm::length(k), phase = random.between(0, 2 * kPi),
                        strength = random.between(0.3f, 1.7f);
            if (length < 2 * kPi / waves.longest || length > 4 * kPi / waves.shortest) continue;
            const float across = glm::dot(k, wind) / length, short2 = length * waves.shortest / (2 * kPi);
            // Slope's variance falls with k a little faster than the equilibrium range's: the chop of a
            // sheltered bay.
            const float power = std::pow(length, -2.7f) * std::exp(-short2 * short2) *
                                (across > 0 ? 0.25f + across * across : 0.12f);
            const Complex height = std::polar(strength * std::sqrt(power) / length, phase);
            amplitudes_[static_cast<size_t>(y * kSide + x)] = height;
            turns_[static_cast<size_t>(y * kSide + x)] =
                std::max(1.0f, std::round(std::sqrt(9.81f * length) * duration / (2 * kPi)));
            variance += 0.5 * static_cast<double>(std::norm(height) * length * length);
        }
    const float scale = waves.rmsSlope / static_cast<float>(std::sqrt(variance));
    for (Complex& a : amplitudes_) a *= scale;
    for (int side = kSide; side >= 16; side /= 2) levels_.emplace_back(static_cast<size_t>(side * side));
}

void Sea::advance(float turn) {
    std::vector<Complex> roots(kSide / 2), field(kSide * kSide);
    for (int i = 0; i < kSide / 2; ++i)
        roots[static_cast<size_t>(i)] = std::polar(1.0f, 2 * kPi * static_cast<float>(i) / kSide);
    // height = Re sum a exp(i (k x - w t)); its slopes along x and z become the real and the imaginary part
    // of one transform.
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const size_t here = static_cast<size_t>(y * kSide + x);
            const size_t there = static_cast<size_t>(wrapped(-y, kSide) * kSide + wrapped(-x, kSide));
            if (turns_[here] == 0 && turns_[there] == 0) continue;
            const vec2 k =
                vec2(x < kSide / 2 ? x : x - kSide, y < kSide / 2 ? y : y - kSide) * (2 * kPi / tile_);
            const auto now = [&](size_t i) {
                const float turns = turns_[i] * turn;
                return amplitudes_[i] * std::polar(1.0f, -2 * kPi * (turns - std::floor(turns)));
            };
            const Complex height = 0.5f * (now(here) + std::conj(now(there)));
            field[here] = height * Complex(0, k.x) + height * Complex(-k.y, 0);
        }
    for (int y = 0; y < kSide; ++y) transform(field.data() + y * kSide, kSide, roots);
    std::vector<Complex> column(kSide);
    for (int x = 0; x < kSide; ++x) {
        for (int y = 0; y < kSide; ++y)
            column[static_cast<size_t>(y)] = field[static_cast<size_t>(y * kSide + x)];
        transform(column.data(), kSide, roots);
        for (int y = 0; y < kSide; ++y)
            levels_[0][static_cast<size_t>(y * kSide + x)] = {column[static_cast<size_t>(y)].real(),
                                                              column[static_cast<size_t>(y)].imag()};
    }
    int side = kSide;
    for (size_t level = 1; level < levels_.size(); ++level, side /= 2)
        for (int y = 0; y < side / 2; ++y)
            for (int x = 0; x < side / 2; ++x) {
                const auto at = [&](int i, int j) {
                    return levels_[level - 1][static_cast<size_t>((2 * y + j) * side + 2 * x + i)];
                };
                levels_[level][static_cast<size_t>(y * side / 2 + x)] =
                    0.25f * (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1));
            }
}

vec2 Sea::slope(const vec2& xz, float width) const {
    const float texel = tile_ / kSide;
    const float level = std::clamp(std::log2(std::max(width / texel, 1.0f)), 0.0f,
                                   static_cast<float>(levels_.size() - 1) - 0.01f);
    const auto fine = static_cast<size_t>(level);
    const float share = level - static_cast<float>(fine);
    const auto look = [&](size_t i) {
        const int side = kSide >> i;
        return repeating(levels_[i], side, xz / tile_ * static_cast<float>(side) - (i ? 0.5f : 0.0f));
    };
    return share < 0.02f ? look(fine) : look(fine) * (1 - share) + look(fine + 1) * share;
}

namespace {
constexpr std::array<float, 4> kDepths = {0.218f, 0.527f, 0.782f, 1.018f}; // shares of the sand's depth
}

Caustics::Caustics(const Scene& scene)
    : toSun_(scene.sun.toSunWater), toSunAir_(scene.sun.toSunAir), tile_(scene.waves.tile),
      layers_(kDepths.size(), std::vector<float>(kSide * kSide)) {
    for (const float share : kDepths) depths_.push_back(-share * scene.sandHeight);
}

// Two photons for each texel go straight from the surface to each depth, in a frame in which a level sea's
// ray would not move sideways.
void Caustics::advance(const Sea& sea) {
    const vec2 level(-toSun_.x / toSun_.y, -toSun_.z / toSun_.y);
    const float texel = tile_ / kSide;
    std::vector<vec2> drift(static_cast<size_t>(kSide) * kSide);
    for (size_t i = 0; i < drift.size(); ++i) {
        const vec2 s = sea.slopes()[i];
        const vec3 down = glm::refract(-toSunAir_, glm::normalize(vec3(-s.x, 1, -s.y)), 1 / kWaterIndex);
        drift[i] = (vec2(down.x, down.z) / -down.y - level) / texel;
    }
    const auto fill = [&](size_t layer) {
        std::vector<float>& map = layers_[layer];
        std::fill(map.begin(), map.end(), 0.0f);
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x)
                for (int part = 0; part < 2; ++part) {
                    const auto at = [&](int i, int j) {
                        return drift[static_cast<size_t>(wrapped(y + j, kSide) * kSide +
                                                         wrapped(x + i, kSide))];
                    };
                    const vec2 d = part ? 0.25f * (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)) : at(0, 0);
                    const vec2 p = vec2(x, y) + (part ? 0.5f : 0.0f) + d * depths_[layer];
                    const vec2 base = glm::floor(p), f = p - base;
                    const int x0 = wrapped(static_cast<int>(base.x), kSide), x1 = wrapped(x0 + 1, kSide);
                    const int y0 = wrapped(static_cast<int>(base.y), kSide), y1 = wrapped(y0 + 1, kSide);
                    float *upper = map.data() + y0 * kSide, *lower = map.data() + y1 * kSide;
                    upper[x0] += 0.5f * (1 - f.x) * (1 - f.y);
                    upper[x1] += 0.5f * f.x * (1 - f.y);
                    lower[x0] += 0.5f * (1 - f.x) * f.y;
                    lower[x1] += 0.5f * f.x * f.y;
                }
        // The sun's disc and the water's small-angle scattering blur what the waves focus; 1 2 1 both ways.
        for (int pass = 0; pass < 2; ++pass) {
            const int step = pass ? kSide : 1;
            std::vector<float> line(kSide);
            for (int j = 0; j < kSide; ++j) {
                float* row = map.data() + (pass ? j : j * kSide);
                for (int i = 0; i < kSide; ++i)
                    line[static_cast<size_t>(i)] =
                        0.25f * (row[wrapped(i - 1, kSide) * step] + row[wrapped(i + 1, kSide) * step]) +
                        0.5f * row[i * step];
                for (int i = 0; i < kSide; ++i) row[i * step] = line[static_cast<size_t>(i)];
            }
        }
    };
    std::thread other([&] {
        for (size_t i = 1; i < layers_.size(); i += 2) fill(i);
    });
    for (size_t i = 0; i < layers_.size(); i += 2) fill(i);
    other.join();
}

float Caustics::at(const vec3& pWorld) const {
    const float depth = std::max(-pWorld.y, 0.0f);
    const vec2 surface = vec2(pWorld.x, pWorld.z) + vec2(toSun_.x, toSun_.z) * (depth / toSun_.y);
    const vec2 texel = surface * (kSide / tile_);
    if (depth <= depths_.front()) {
        const float share = depth / depths_.front();
        return 1 - share + share * repeating(layers_.front(), kSide, texel);
    }
    size_t upper = 0;
    while (upper + 2 < depths_.size() && depths_[upper + 1] < depth) ++upper;
    const float share = std::min((depth - depths_[upper]) / (depths_[upper + 1] - depths_[upper]), 1.0f);
    return repeating(layers_[upper], kSide, texel) * (1 - share) +
           repeating(layers_[upper + 1], kSide, texel) * share;
}

} // namespace shoal::reef
