#include "content/make/video/Frame.h"

#include "content/make/video/Light.h"
#include "engine/math/LatLong.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::reef {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

float luminance(const vec3& c) { return glm::dot(c, vec3(0.2126f, 0.7152f, 0.0722f)); }

// Returns the number of samples of a row, in proportion to the length of its circle on the sphere.
int columns(int y, int width) {
    const float ring = std::sin((static_cast<float>(y) + 0.5f) / static_cast<float>(width / 2) * kPi);
    return std::clamp(static_cast<int>(static_cast<float>(width) * ring * 1.05f) + 8, 16, width);
}

} // namespace

Filming::Filming(const Scene& scene, const Route& route, World& world)
    : scene_(scene), route_(route), world_(world), sea_(scene), caustics_(scene) {}

// All surfaces are matte: nothing looks wet under water. Fine relief and colour come from repeating noise at
// three scales, of which the finer ones fade out where a pixel covers more than their grain.
vec3 Filming::shade(Hit& hit, float footprint) const {
    vec3 bump(0);
    float tone = 1;
    vec3 tint(1);
    const auto fade = [&](float grain) { return std::clamp(1.6f - footprint / grain, 0.0f, 1.0f); };
    const vec4 wide = lumps_.at(hit.p * 0.83f);
    if (hit.kind == Kind::Rock || hit.kind == Kind::Coral || hit.kind == Kind::Soft) {
        const vec4 middle = lumps_.at(hit.p * 2.9f + vec3(0.3f, 0.1f, 0.7f));
        const float fineFade = fade(0.02f), middleFade = fade(0.05f);
        const vec4 fine = fineFade > 0 ? cells_.at(hit.p * (hit.kind == Kind::Coral ? 7.1f : 4.3f)) : vec4(0);
        if (hit.kind == Kind::Rock) {
            bump = middleFade * 0.035f * vec3(middle) + fineFade * 0.011f * vec3(fine);
            tone = 1 + 0.45f * middle.w * middleFade + 0.30f * fine.w * fineFade + 0.25f * wide.w;
            const float crust =
                glm::smoothstep(0.10f, 0.28f, middle.w * 0.7f + wide.w * 0.5f + 0.25f * fine.w * fineFade);
            tint = glm::mix(vec3(1), vec3(1.22f, 0.92f, 0.95f), crust);
            const float turf = glm::smoothstep(0.05f, 0.3f, -middle.w + 0.3f * wide.w);
            tint = glm::mix(tint, vec3(0.72f, 0.82f, 0.52f), 0.8f * turf);
        } else {
            bump = middleFade * 0.008f * vec3(middle) + fineFade * 0.013f * vec3(fine);
            tone = 1 + 0.22f * middle.w + 0.38f * fine.w * fineFade;
            tint = glm::mix(vec3(1), vec3(0.88f, 1.0f, 0.8f), glm::smoothstep(0.0f, 0.5f, wide.w));
        }
    } else if (hit.kind == Kind::Sand) {
        const vec4 middle = lumps_.at(vec3(hit.p.x, 0.21f, hit.p.z) * 2.3f);
        const vec4 fine = fade(0.018f) > 0 ? lumps_.at(vec3(hit.p.x, 0.4f, hit.p.z) * 6.3f) : vec4(0);
        bump = (0.018f * vec3(middle) * fade(0.05f) + 0.006f * vec3(fine) * fade(0.018f)) * vec3(1, 0, 1);
        const float speck = glm::smoothstep(0.15f, 0.75f, fine.w * fade(0.018f));
        tone = 1 + 0.14f * middle.w * fade(0.06f) + 0.24f * fine.w * fade(0.018f) - 0.22f * speck +
               0.10f * wide.w;
        tint = glm::mix(vec3(1), vec3(0.94f, 1.0f, 0.92f), glm::smoothstep(-0.2f, 0.4f, wide.w));
    }
    const vec3 smooth = hit.normal;
    const vec3 n = glm::normalize(smooth - (bump - smooth * glm::dot(bump, smooth)));
    const vec3 albedo = hit.albedo * std::max(tone, 0.15f) * tint;
    const vec3& toSun = scene_.sun.toSunWater;
    const float facing = glm::dot(n, toSun);
    float lit = hit.kind == Kind::Leaf
                    ? std::max(facing, 0.0f) * 0.75f + std::max(-facing, 0.0f) * 0.45f + 0.1f
                    : std::max(facing, 0.0f);
    if (lit > 0) lit *= world_.sunlitSoft(hit.p + smooth * 0.035f);
    if (lit > 0) lit *= caustics_.at(hit.p);
    if (lit > 0 && world_.isShadedByAnimal(hit.p + smooth * 0.01f)) lit = 0;
    // Indirect light comes from above on the whole, so relief shows in it too; pits are darker.
    const float relief = hit.kind == Kind::Animal ? 1 : // is smooth
                             std::clamp(1 + 0.55f * (n.y - smooth.y), 0.3f, 1.6f) *
                                 std::clamp(0.75f + 0.35f * tone, 0.5f, 1.25f);
    vec3 irradiance = sunAtDepth(scene_, -hit.p.y) * lit + hit.indirect * relief;
    for (const Lamps::Arriving& light : world_.lamps().at(hit.p + smooth * 0.02f)) {
        const float towards = glm::dot(n, light.toLamp);
        irradiance += light.irradiance *
                      (hit.kind == Kind::Leaf ? 0.6f * std::fabs(towards) + 0.1f : std::max(towards, 0.0f));
    }
    return albedo * irradiance / kPi + hit.glow * (hit.kind == Kind::Lamp ? 1.0f : tone * relief);
}

vec3 Filming::surfaceFromBelow(const vec3& dir, float distance, float pixelAngle) const {
    const vec3 p = camera_ + dir * distance;
    const vec2 slope = sea_.slope({p.x, p.z}, distance * pixelAngle / std::max(dir.y, 0.15f));
    const vec3 normal = glm::normalize(vec3(-slope.x, 1, -slope.y));
    const Window window = throughSurface(dir, normal);
    vec3 out(0);
    if (window.through > 0) {
        const float off = std::max(1 - glm::dot(window.dirAir, scene_.sun.toSunAir), 0.0f);
        // The sun's disc, widened by ripples that are too fine for the tile: the same irradiance over a wider
        // spot.
        constexpr float kSpot = 2.2e-4f;
        const vec3 disc = scene_.sun.irradiance * (std::exp(-off / kSpot) / (2 * kPi * kSpot));
        out = (skyRadiance(scene_, window.dirAir) + disc) * (window.through * kWaterIndex * kWaterIndex);
    }
    if (window.through < 1) {
        // The reflected ray sees water, and the sand behind it.
        vec3 down = dir - 2 * glm::dot(dir, normal) * normal;
        down.y = std::min(down.y, -0.02f);
        const float path = scene_.sandHeight / down.y;
        const vec3 through = scene_.water.transmittance(path), sun = sunAtDepth(scene_, 2.5f);
        const vec3 veil =
            scene_.water.scattered * (sun * scene_.water.phase(glm::dot(down, scene_.sun.toSunWater)) +
                                      world_.ambient(p + down * std::min(path * 0.4f, 4.0f)));
        const vec3 sand = scene_.sandAlbedo * sunAtDepth(scene_, -scene_.sandHeight) * (0.7f / kPi);
        out += (1 - window.through) * (sand * through + veil * (1.0f - through));
    }
    return out;
}

Filming::Sample Filming::look(const vec2& uv, float pixelAngle) const {
    const vec3 dir = directionFromLatLong(uv);
    const float above = dir.y > 0.004f ? -camera_.y / dir.y : 1e9f;
    Hit hit;
    Sample sample;
    constexpr float kFar = 45;
    if (world_.trace(camera_, dir, std::min(above, kFar), hit)) {
        if (glm::dot(hit.normal, dir) > 0 && hit.kind == Kind::Leaf) hit.normal = -hit.normal;
        sample = {shade(hit, hit.distance * pixelAngle), hit.distance};
    } else if (above < kFar)
        sample = {surfaceFromBelow(dir, above, pixelAngle), above};
    else
        sample = {vec3(0), kFar};
    sample.radiance =
        sample.radiance * scene_.water.transmittance(sample.distance) + veil_.at(uv, sample.distance);
    return sample;
}

Drawn Filming::draw(float turn, int width, bool edges, const vec3& beside) {
    const int height = width / 2;
    camera_ = route_.at(turn) + beside;
    sea_.advance(turn);
    caustics_.advance(sea_);
    world_.advance(turn, route_.at(turn));
    veil_.fill(scene_, world_, caustics_, camera_, width);
    const float pixelAngle = kPi / static_cast<float>(height);
    std::vector<std::vector<Sample>> rows(static_cast<size_t>(height));
#pragma omp parallel for schedule(dynamic, 4)
    for (int y = 0; y < height; ++y) {
        auto& row = rows[static_cast<size_t>(y)];
        const int n = columns(y, width);
        row.resize(static_cast<size_t>(n));
        for (int x = 0; x < n; ++x)
            row[static_cast<size_t>(x)] = look({(static_cast<float>(x) + 0.5f) / static_cast<float>(n),
                                                (static_cast<float>(y) + 0.5f) / static_cast<float>(height)},
                                               pixelAngle);
    }
    ImageRgbF image(width, height);
    std::vector<float> distance(static_cast<size_t>(width) * height);
#pragma omp parallel for schedule(dynamic, 4)
    for (int y = 0; y < height; ++y) {
        const auto& row = rows[static_cast<size_t>(y)];
        const int n = static_cast<int>(row.size());
        std::vector<Sample> fine = row;
        const auto other = [&](int j, int x) -> const Sample& {
            const auto& there = rows[static_cast<size_t>(std::clamp(j, 0, height - 1))];
            return there[std::min(static_cast<size_t>(x) * there.size() / row.size(), there.size() - 1)];
        };
        for (int x = 0; edges && x < n; ++x) {
            const Sample& here = row[static_cast<size_t>(x)];
            const float mine = std::log2(luminance(here.radiance) + 0.02f);
            float differs = 0;
            for (const Sample* next :
                 {&row[static_cast<size_t>((x + 1) % n)], &row[static_cast<size_t>((x + n - 1) % n)],
                  &other(y - 1, x), &other(y + 1, x)})
                differs = std::max(differs, std::fabs(std::log2(luminance(next->radiance) + 0.02f) - mine));
            if (differs < 0.5f) continue;
            vec3 sum = here.radiance;
            constexpr vec2 kMore[2] = {{-0.33f, 0.25f}, {0.30f, -0.31f}};
            for (const vec2& o : kMore) {
                const vec2 uv((static_cast<float>(x) + 0.5f + o.x) / static_cast<float>(n),
                              (static_cast<float>(y) + 0.5f + o.y) / static_cast<float>(height));
                sum += look(uv, pixelAngle).radiance;
            }
            fine[static_cast<size_t>(x)].radiance = sum / 3.0f;
        }
        for (int x = 0; x < width; ++x) {
            const float p = (static_cast<float>(x) + 0.5f) * static_cast<float>(n) /
                                static_cast<float>(width) -
                            0.5f,
                        base = std::floor(p), f = p - base;
            const int i = (static_cast<int>(base) + n) % n;
            const Sample &a = fine[static_cast<size_t>(i)], &b = fine[static_cast<size_t>((i + 1) % n)];
            const vec3 c = n == width ? a.radiance : a.radiance * (1 - f) + b.radiance * f;
            for (int k = 0; k < 3; ++k) image.at(x, y)[k] = c[k];
            distance[static_cast<size_t>(y * width + x)] = f < 0.5f ? a.distance : b.distance;
        }
    }
    return {std::move(image), std::move(distance), camera_};
}

} // namespace shoal::reef
