// How right the light is of panoramas that photos are grown to: photos are cut out of panoramas whose light
// is known.
#include "engine/light/Lookup.h"
#include "engine/light/MakeLight.h"
#include "engine/math/LatLong.h"
#include "engine/math/Quantile.h"
#include "engine/panorama/Steps.h"
#include "tests/bench/find_lights/Tables.h"
#include "tests/bench/light/Measure.h"
#include "tests/unit/light/LightWatcher.h"

namespace shoal::bench {

namespace {

constexpr double kFov_deg = 65;
constexpr int kWidth = 256, kHeight = 192; // of a photo
constexpr int kWhole = 512;                // least width of a panorama that is grown

glm::vec3 turned(const glm::vec3& direction, double toTheRight) {
    const auto c = static_cast<float>(std::cos(toTheRight)), s = static_cast<float>(std::sin(toTheRight));
    return {direction.x * c - direction.z * s, direction.y, direction.x * s + direction.z * c};
}

// Returns the photo that a level camera takes, turned to the right of the panorama's middle.
ImageRgbF photoOf(const ImageRgbF& panorama, const panorama::Lens& lens, double toTheRight) {
    ImageRgbF photo(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const glm::dvec3 to(x + 0.5 - kWidth / 2.0, kHeight / 2.0 - y - 0.5, -lens.focal_px);
            const glm::vec3 light =
                light::lookUp(panorama, turned(glm::vec3(glm::normalize(to)), toTheRight));
            for (int c = 0; c < 3; ++c) photo.at(x, y)[c] = light[c];
        }
    return photo;
}

ImageRgbF stretched(ImageRgbF photo) {
    ImageRgbF whole(kWhole, kWhole / 2);
    cv::Mat resized(whole.height, whole.width, CV_32FC3, whole.pixels.data());
    cv::resize(cv::Mat(photo.height, photo.width, CV_32FC3, photo.pixels.data()), resized, resized.size());
    return whole;
}

// Returns what a panorama gives to surfaces that face all ways, each weighed by the root of its solid angle.
std::vector<glm::dvec3> lightOf(const ImageRgbF& panorama, double toTheRight = 0) {
    static light::LightMaker maker({.baseWidth = kWhole, .quality = light::LightQuality::Still});
    light::EnvironmentLight made;
    maker.makeFromHdr(panorama, made);
    std::vector<glm::dvec3> all;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x)
            all.push_back(
                std::sqrt(texelSolidAngle(y, 32, 16)) *
                glm::dvec3(light::lookUp(made.diffuse, turned(texelDirection(x, y, 32, 16), -toTheRight))));
    return all;
}

struct Grown {
    ImageRgbF panorama;
    double toTheRight = 0; // of its middle, from the photo's
};

struct Way {
    const char* name;
    std::function<Grown(const ImageRgbF&)> grow;
    std::array<std::vector<double>, 2> errors{}, scaled{}; // photos that show the strongest light; others
    std::vector<double> times_ms{};
};

} // namespace

void growPhotos(bool quick) {
    const auto lens = panorama::Lens::make(kWidth, kHeight, kFov_deg * panorama::kRadiansPerDegree);
    const auto carved = [&](const ImageRgbF& photo, bool full) {
        auto made = panorama::panoramaFromPhoto(photo, {.fov_deg = kFov_deg, .full = full}).value();
        return Grown{std::move(made.latLong), lens.longitudeOf(made.lightInPhoto.x)};
    };
    std::vector<Way> ways = {
        {"stretched to the whole sphere", [](const ImageRgbF& photo) { return Grown{stretched(photo)}; }},
        {"**carved, poles extrapolated** (`panorama`)",
         [&](const ImageRgbF& photo) { return carved(photo, false); }},
        {"carved to the poles (`--full`, the thesis)",
         [&](const ImageRgbF& photo) { return carved(photo, true); }}};
    light::LightWatcher eye;
    for (const EnvironmentSource& source : quick ? apartSources() : clippedSources()) {
        const auto environment = source.load();
        if (!environment) continue;
        const glm::dvec3 strongest(eye.look(environment->radianceLin).lights[0].direction);
        const std::vector<glm::dvec3> want = lightOf(environment->radianceLin);
        constexpr double kAside = 0.25; // radians from the photo's middle to the light
        for (const double turn : {0.0, std::numbers::pi}) {
            const double toTheRight = std::atan2(strongest.x, -strongest.z) - kAside + turn;
            const size_t group = turn > 0 || std::abs(std::asin(strongest.y)) > lens.latitude;
            const ImageRgbF photo = photoOf(environment->radianceLin, lens, toTheRight);
            for (Way& way : ways) {
                const double began_ms = processor_ms();
                const Grown grown = way.grow(photo);
                way.times_ms.push_back(processor_ms() - began_ms);
                const auto got = lightOf(grown.panorama, toTheRight + grown.toTheRight);
                way.errors[group].push_back(100 * errorOf(got, want).rms);
                way.scaled[group].push_back(100 * errorAfterScaling(got, want).rms);
            }
        }
    }
    std::printf(R"(
## Photos grown to panoramas

Level photos of %g degrees, cut out of the pictures of high dynamic range with all their light: %zu that show the strongest light, %zu
that do not. Error: of diffuse light, root mean square over all directions, of that of the whole picture.

| way | light in it: off, %%: median | 90 of 100 below | after the best factor: median | not in it: off, %%: median | 90 of 100 below | after the best factor: median | ms of processor a photo |
|---|--:|--:|--:|--:|--:|--:|--:|
)",
                kFov_deg, ways[0].errors[0].size(), ways[0].errors[1].size());
    for (Way& way : ways) {
        std::printf("| %s |", way.name);
        for (size_t group = 0; group < 2; ++group)
            std::printf(" %.1f | %.1f | %.1f |", math::median(way.errors[group]),
                        math::quantile(way.errors[group], 0.9), math::median(way.scaled[group]));
        std::printf(" %.3g |\n", math::median(way.times_ms));
    }
}

} // namespace shoal::bench
