// shoal light: writes the light of an environment, for other engines and for measuring.
#include "engine/core/WriteFile.h"
#include "game/tools/Commands.h"

#include "engine/core/Log.h"
#include "engine/environment/PhotoEnvironment.h"
#include "engine/light/BruteForceDiffuse.h"
#include "engine/light/Lookup.h"
#include "engine/light/MakeLight.h"
#include "engine/math/LatLong.h"
#include "engine/math/SphericalHarmonics.h"
#include "engine/media/Check.h"
#include "engine/media/Pictures.h"
#include "engine/media/VideoPlayer.h"

#include <nlohmann/json.hpp>

namespace shoal::app {

constexpr int kWidestLight = 4096;

// Reads a photo as an environment, or the video's frame at that time and its light if it is PQ or HLG: the
// left eye's picture, turned as the file asks.
static Result<ImageRgb8> readCoded(const Path& file, bool isPhoto, float at_s, ImageRgbF& radianceLin) {
    ImageRgb8 turned;
    if (isPhoto) {
        auto photo = media::readPhoto(file);
        if (!photo) return photo.error();
        const auto made = environment::environmentFrom(file, std::move(photo->picture), photo->metadata, {});
        if (!made) return made.error();
        return environment::leftEyeOf(made->picture, made->layout, turned, made->envFromPhoto);
    }
    auto player = media::VideoPlayer::open(file);
    if (!player) return player.error();
    const media::VideoFrame& frame = *player->waitFor(static_cast<double>(at_s));
    const glm::quat& envFromFilm = player->info().metadata.envFromFilm;
    ImageRgbF turnedLin;
    radianceLin = environment::leftEyeOf(frame.radianceLin, frame.layout, turnedLin, envFromFilm);
    return environment::leftEyeOf(frame.pixelsBgr, frame.layout, turned, envFromFilm);
}

static Result<light::EnvironmentLight> makeLight(const LightOptions& options) {
    const bool asTheThesis = options.method == light::DiffuseMethod::Thesis;
    const light::FrameRadiance frames = asTheThesis && options.frames == light::FrameRadiance::Auto
                                            ? light::FrameRadiance::Thesis
                                            : options.frames;
    light::LightMaker maker({kWidestLight, light::kMinFilteredRoughness, light::LightQuality::Still, frames});
    light::EnvironmentLight made;
    const auto kind = media::mediaKind(options.file, options.layer);
    if (!kind) return kind.error();
    if (*kind == media::MediaKind::Hdr) {
        auto picture = media::readHdr(options.file, {}, options.layer);
        if (!picture) return picture.error();
        maker.makeFromHdr(picture->radianceLin, made);
        if (const std::string note = picture->note(); !note.empty())
            log::info("{}: {}", options.file, note.substr(2));
        return made;
    }
    const bool isPhoto = *kind == media::MediaKind::Photo;
    ImageRgbF radianceLin;
    auto coded = readCoded(options.file, isPhoto, options.at_s, radianceLin);
    if (!coded) return coded.error();
    if (!radianceLin.empty() && light::takesMeasured(frames)) {
        maker.makeFromHdr(radianceLin, made);
        return made;
    }
    maker.make({coded->pixels.data(), coded->width, coded->height, static_cast<ptrdiff_t>(coded->width) * 3,
                !isPhoto},
               made);
    return made;
}

// Fills a lat-long map by a function of direction.
template <class F> static void fill(ImageRgbF& map, F&& radianceIn) {
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            const glm::vec3 value = radianceIn(texelDirection<double>(x, y, map.width, map.height));
            for (int c = 0; c < 3; ++c) map.at(x, y)[c] = value[c];
        }
}

// Makes the glossy levels of the roughnesses that are asked for, each as wide as the level that is no
// rougher, and all maps by the method that is asked for. Where no roughness is asked for, levels whose lobes
// are narrower than a texel of the pyramid stay as they are.
static void makeAsAsked(const LightOptions& options, light::EnvironmentLight& made) {
    const bool asTheThesis = options.method == light::DiffuseMethod::Thesis;
    std::vector<light::GlossyLevel> levels;
    for (const float r : options.roughness)
        levels.push_back(
            {r, light::glossyImage(made, static_cast<size_t>(light::lodFromRoughness(made.glossy, r)))});
    if (levels.empty() && asTheThesis) levels = made.glossy;
    for (auto& [roughness, map] : levels)
        fill(map, [&, r = roughness](const glm::dvec3& direction) {
            return asTheThesis ? light::phongRingsRadiance(made.radiance, direction, static_cast<double>(r))
                               : light::lookUpGlossy(made, direction, r);
        });
    if (!levels.empty()) made.glossy = std::move(levels);
    if (asTheThesis) light::BruteForceDiffuse(widthOf(options.diffuseSize)).make(made.radiance, made.diffuse);
}

static std::string harmonics(const light::EnvironmentLight& made) {
    const math::ShRgb radiance = math::shProject(made.radiance.levels.front());
    nlohmann::ordered_json json;
    json["about"] = "Radiance on real orthonormal spherical harmonics, index l (l + 1) + m, without the "
                    "Condon-Shortley phase, linear Rec. 709; +Y up, the picture's centre column looks along "
                    "-Z, columns grow to +X. Times cosine[l] / pi: radiance leaving a white matte surface.";
    json["cosine"] = math::kShCosine;
    for (const glm::dvec3& c : radiance) json["radiance"].push_back({c.r, c.g, c.b});
    return json.dump(2) + "\n";
}

// Returns a level's name: its roughness with two digits, or as many as tell it from the level before.
static std::string glossyName(const std::vector<light::GlossyLevel>& levels, size_t k) {
    const auto name = [&](size_t level, int digits) {
        return fmt::format("glossy_{:.{}f}", levels[level].roughness, digits);
    };
    int digits = 2;
    while (k > 0 && digits < 9 && name(k, digits) == name(k - 1, digits)) ++digits;
    return name(k, digits);
}

static Status writeAll(const LightOptions& options, const light::EnvironmentLight& made) {
    std::vector<NamedBytes> files;
    const auto put = [&](const std::string& stem, const ImageRgbF& image) -> Status {
        const std::string name = stem + "." + enumName(options.format);
        auto bytes = media::encodeHdr(name, image);
        if (!bytes) return bytes.error();
        files.push_back({name, std::move(*bytes)});
        return Done{};
    };
    ImageRgbF diffuse(widthOf(options.diffuseSize), widthOf(options.diffuseSize) / 2);
    fill(diffuse, [&](const glm::dvec3& direction) { return light::lookUp(made.diffuse, direction); });
    if (Status s = put("diffuse", diffuse); !s) return s;
    for (size_t k = 0; k < made.glossy.size(); ++k) {
        const std::string name = options.roughness.empty() ? glossyName(made.glossy, k)
                                                           : fmt::format("glossy_{}", options.roughness[k]);
        if (Status s = put(name, light::glossyImage(made, k)); !s) return s;
    }
    files.push_back({"sh.json", harmonics(made)});
    return writeFolderWhole(options.out, files);
}

Status light(const LightOptions& options) {
    auto made = makeLight(options);
    if (!made) return made.error();
    makeAsAsked(options, *made);
    return writeAll(options, *made);
}

} // namespace shoal::app
