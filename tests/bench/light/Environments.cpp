#include "tests/bench/light/Environments.h"

#include "engine/light/InverseToneMap.h"
#include "engine/math/SphericalHarmonics.h"
#include "engine/media/Pictures.h"
#include "engine/media/VideoPlayer.h"
#include "tests/baselines/light/Expand.h"
#include "tests/unit/light/Environments.h"

namespace shoal::bench {

namespace {

constexpr int kWidth = 1024; // of made environments

EnvironmentSource made(const std::string& name, std::function<ImageRgbF()> make) {
    return {name, [=] { return std::optional(Environment{{}, make()}); }};
}

EnvironmentSource painted(const std::string& name, const std::function<double(const glm::dvec3&)>& radiance) {
    return made(name, [=] {
        return light::paint(kWidth, kWidth / 2, [&](const glm::dvec3& d) { return glm::dvec3(radiance(d)); });
    });
}

// A sky of radiance 1 and a sun ten thousand times as bright: a disc of 0.4 degrees' radius, which at the
// horizon covers 2 x 2 texels, and near a pole as many as share its solid angle. centre: u, v.
EnvironmentSource sun(const std::string& where, const glm::dvec2& centre) {
    const glm::dvec3 to = directionFromLatLong(centre);
    const double reach = std::cos(0.4 * std::numbers::pi / 180);
    return painted("made: sun " + where,
                   [=](const glm::dvec3& d) { return glm::dot(d, to) > reach ? 1e4 : 1.0; });
}

std::optional<ImageRgb8> frameOf(const Path& file, std::optional<int> number = std::nullopt) {
    auto player = media::VideoPlayer::open(file);
    if (!player) return std::nullopt;
    ImageRgb8 frame = player->waitFor(number ? *number / player->info().fps : 1.0)->pixelsBgr;
    for (size_t i = 0; i < frame.pixels.size(); i += 3) std::swap(frame.pixels[i], frame.pixels[i + 2]);
    return frame;
}

Path gameVideo(const std::string& name) { return dataRoot() / "content/video" / (name + ".mp4"); }

EnvironmentSource video(const std::string& film) {
    return {"video: " + film, [=]() -> std::optional<Environment> {
                auto frame = frameOf(gameVideo(film));
                if (!frame) return std::nullopt;
                Environment environment{std::move(*frame), {}};
                light::baselines::forEach(environment.frame, environment.radianceLin,
                                          light::radianceFromDisplay);
                return environment;
            }};
}

// Returns sources of panoramas that tests/bench/get_pictures fetched.
std::vector<EnvironmentSource> hdrs(std::initializer_list<std::string> stems) {
    std::vector<EnvironmentSource> sources;
    for (const std::string& stem : stems)
        sources.push_back({"hdr: " + stem, [=]() -> std::optional<Environment> {
                               auto picture =
                                   media::readHdr(dataRoot() / "build/bench-pictures" / (stem + ".exr"));
                               if (!picture) return std::nullopt;
                               return Environment{{}, std::move(picture->radianceLin)};
                           }});
    return sources;
}

} // namespace

std::vector<EnvironmentSource> apartSources() {
    return hdrs({"blender_sunset", "pmndrs_lobby", "pmndrs_night", "pmndrs_studio"});
}

std::vector<EnvironmentSource> clippedSources() {
    auto sources = apartSources();
    std::ranges::move(hdrs({"blender_city",     "blender_courtyard", "blender_forest",  "blender_interior",
                            "blender_night",    "blender_studio",    "blender_sunrise", "pmndrs_apartment",
                            "pmndrs_bridge",    "pmndrs_city",       "pmndrs_dawn",     "pmndrs_esplanade",
                            "pmndrs_forest",    "pmndrs_hall",       "pmndrs_lab",      "pmndrs_park",
                            "pmndrs_sky",       "pmndrs_sunrise",    "pmndrs_sunset",   "pmndrs_venice",
                            "pmndrs_warehouse", "pmndrs_workshop"}),
                      std::back_inserter(sources));
    return sources;
}

std::vector<EnvironmentSource> environmentSources(bool quick) {
    const auto step = painted("made: half black, half white", [](const glm::dvec3& d) { return d.x > 0; });
    const auto gradient = painted("made: smooth gradient", [](const glm::dvec3& d) { return 1 + 0.8 * d.y; });
    auto all = hdrs({"blender_courtyard", "blender_sunrise", "blender_city", "blender_forest",
                     "blender_interior", "blender_night", "blender_studio", "blender_sunset"});
    if (quick) {
        all.resize(2);
        all.insert(all.end(), {video("reef.small"), step, gradient, sun("at the zenith", {0.5, 0})});
        return all;
    }
    const auto checkerboard = [] {
        ImageRgbF image(kWidth, kWidth / 2);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                for (int c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<float>((x + y) % 2);
        return image;
    };
    all.insert(all.end(), {video("reef"), video("night"), video("kelp"),
                           painted("made: uniform", [](const glm::dvec3&) { return 1.0; }), gradient, step,
                           made("made: checkerboard of single texels", checkerboard),
                           sun("at the zenith", {0.5, 0}), sun("beside the pole", {0.3, 0.015}),
                           sun("at the horizon", {0.5, 0.5}), sun("on the seam", {0, 0.5})});
    return all;
}

std::vector<EnvironmentSource> filmedSources() {
    std::vector<EnvironmentSource> all;
    std::error_code gone;
    for (const auto& entry : std::filesystem::directory_iterator(dataRoot() / "content" / "truth", gone)) {
        const Path file = entry.path();
        const std::string stem = file.stem().string(); // FILM_FRAME
        if (file.extension() != ".hdr") continue;
        const size_t end = stem.find('_');
        const Path video = gameVideo(stem.substr(0, end));
        const int number = std::atoi(stem.substr(end + 1).c_str());
        all.push_back({"film: " + stem, [=]() -> std::optional<Environment> {
                           auto frame = frameOf(video, number);
                           auto truth = media::readHdr(file);
                           if (!frame || !truth) return std::nullopt;
                           return Environment{std::move(*frame), std::move(truth->radianceLin)};
                       }});
    }
    std::ranges::sort(all, {}, &EnvironmentSource::name);
    return all;
}

ImageRgb8 timedFrame() { return frameOf(gameVideo("reef.small")).value(); }

bool hasPointSun(const ImageRgbF& radianceLin) {
    struct Texel {
        double luminance = 0, solidAngle = 0;
    };
    std::vector<Texel> texels;
    double whole = 0;
    math::eachTexel(radianceLin, [&](const glm::vec3& radiance, double solidAngle, const glm::vec3&) {
        const double luminance = light::thesisLuminance(radiance);
        texels.push_back({luminance, solidAngle});
        whole += luminance * solidAngle;
    });
    std::ranges::sort(texels, std::greater{}, &Texel::luminance);
    double sphere = 0, bright = 0;
    for (const Texel& each : texels) {
        if (sphere > 4e-4 * std::numbers::pi) break;
        sphere += each.solidAngle;
        bright += each.luminance * each.solidAngle;
    }
    return bright > 0.05 * whole;
}

} // namespace shoal::bench
