#include "engine/light/library/ShoalLight.h"

#include "engine/light/FindLights.h"
#include "engine/light/InverseToneMap.h"
#include "engine/light/Lookup.h"
#include "engine/light/MakeLight.h"
#include "engine/light/PackedLight.h"
#include "engine/math/Brdf.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

namespace light = shoal::light;

struct ShoalLightMaker {
    light::LightOptions options;
    light::LightMaker maker{options};
    light::MirrorMaps mirrors = light::MirrorMaps::None;
    light::TooBright tooBright = light::TooBright::Cut;
    std::optional<light::LightFinder> finder = {};
    std::vector<uint8_t> threeBytes = {}; // a frame without its alpha
    shoal::ImageRgbF radianceLin = {};    // an HDR frame
};

struct ShoalLight {
    light::EnvironmentLight made;
    light::PackedLight packed;
    light::FoundLights found;               // none unless asked for
    std::vector<ShoalLightTexture> mirrors; // point into packed
};

namespace {

constexpr int kMaxSide = 16384;
constexpr int kMaxMirror = 8192; // Environment.glsl has room for the roughness of 5 levels and one more
constexpr int kMaxTable = 1024;

thread_local const char* error = "";

ShoalLightStatus fail(ShoalLightStatus status, const char* why) {
    error = why;
    return status;
}
ShoalLightStatus bad(const char* why) { return fail(SHOAL_LIGHT_BAD_ARGUMENT, why); }

// Runs work and turns any exception into a status: with checked arguments only memory can run out.
template <class Work> ShoalLightStatus guarded(const Work& work) {
    try {
        work();
        return SHOAL_LIGHT_OK;
    } catch (...) {
        return fail(SHOAL_LIGHT_OUT_OF_MEMORY, "there is not enough memory");
    }
}

// Returns the size of a pixel; 0 for an unknown format.
int bytesPerPixel(int32_t format) {
    constexpr std::array kBytes = {3, 3, 4, 4, 12, 16}; // by ShoalLightFormat
    return format < 0 || format > SHOAL_LIGHT_RGBA32F ? 0 : kBytes[format];
}

void makeFromFloats(ShoalLightMaker& maker, const light::FrameView& frame, int pixelBytes,
                    light::EnvironmentLight& out) {
    maker.radianceLin.fit(frame.width, frame.height);
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x)
            std::memcpy(maker.radianceLin.at(x, y), frame.row(y) + pixelBytes * x, 3 * sizeof(float));
    maker.maker.makeFromHdr(maker.radianceLin, out);
}

void makeFromBytes(ShoalLightMaker& maker, light::FrameView frame, int pixelBytes,
                   light::EnvironmentLight& out) {
    if (pixelBytes == 4) {
        const auto width = static_cast<size_t>(frame.width);
        maker.threeBytes.resize(3 * width * static_cast<size_t>(frame.height));
        for (int y = 0; y < frame.height; ++y) {
            const uint8_t* from = frame.row(y);
            uint8_t* to = maker.threeBytes.data() + 3 * width * static_cast<size_t>(y);
            // Copies four bytes at once; the next pixel overwrites the fourth.
            for (size_t x = 0; x + 1 < width; ++x) std::memcpy(to + 3 * x, from + 4 * x, 4);
            std::memcpy(to + 3 * (width - 1), from + 4 * (width - 1), 3);
        }
        frame.pixels = maker.threeBytes.data(), frame.rowStride = 3 * frame.width;
    }
    maker.maker.make(frame, out);
}

ShoalLightTexture textureOf(const light::HalfImage& image) {
    return {image.pixels.data(), image.width, image.height};
}

// Returns whether the light is made and the direction finite, so that a look-up stays within the map.
bool canBeLookedUp(const ShoalLight* light, const float* direction) {
    return light && !light->packed.places.empty() &&
           std::isfinite(direction[0] + direction[1] + direction[2]);
}

void put(const glm::vec3& colour, float* out) {
    for (int c = 0; c < 3; ++c) out[c] = colour[c];
}

} // namespace

const char* shoalLightError() { return error; }

const char* shoalLightVersion() { return SHOAL_LIGHT_VERSION; }

ShoalLightOptions shoalLightDefaults() { return {SHOAL_LIGHT_VIDEO, 0.25f, 512}; }

ShoalLightStatus shoalLightMakerCreate(const ShoalLightOptions* options, ShoalLightMaker** maker) {
    if (!maker) return bad("there is nowhere to put the maker");
    *maker = nullptr;
    const ShoalLightOptions o = options ? *options : shoalLightDefaults();
    if (o.quality != SHOAL_LIGHT_VIDEO && o.quality != SHOAL_LIGHT_STILL)
        return bad("there is no such quality");
    if (!(o.leastRoughness >= 0 && o.leastRoughness <= 1)) return bad("leastRoughness lies outside 0 to 1");
    if (o.widestMirror < light::kMinBaseWidth || o.widestMirror > kMaxMirror)
        return bad("widestMirror lies outside 256 to 8192");
    return guarded([&] {
        const bool still = o.quality == SHOAL_LIGHT_STILL;
        const bool smooth = o.leastRoughness < light::kMinFilteredRoughness;
        *maker =
            new ShoalLightMaker{.options = {o.widestMirror, o.leastRoughness,
                                            still ? light::LightQuality::Still : light::LightQuality::Video},
                                .mirrors = smooth ? light::MirrorMaps::Mirrors : light::MirrorMaps::None};
    });
}

ShoalLightStatus shoalLightMakerSet(ShoalLightMaker* maker, int32_t setting, int32_t value) {
    if (!maker) return bad("the maker is missing");
    if (setting < SHOAL_LIGHT_FRAMES || setting > SHOAL_LIGHT_FIND_SOURCES)
        return bad("there is no such setting");
    if (value < 0 || value > (setting == SHOAL_LIGHT_FRAMES ? SHOAL_LIGHT_SRGB_UNCLIPPED : 1))
        return bad("the setting has no such value");
    return guarded([&] {
        if (setting == SHOAL_LIGHT_FRAMES) {
            constexpr light::FrameRadiance kFrames[] = {
                light::FrameRadiance::Thesis, light::FrameRadiance::Linear, light::FrameRadiance::Auto};
            maker->options.frames = kFrames[value];
            maker->maker = light::LightMaker(maker->options);
        } else if (setting == SHOAL_LIGHT_SCALED_MAPS) {
            maker->tooBright = value ? light::TooBright::Scale : light::TooBright::Cut;
        } else if (value && !maker->finder) {
            maker->finder.emplace();
        } else if (!value) {
            maker->finder.reset();
        }
    });
}

void shoalLightMakerDestroy(ShoalLightMaker* maker) { delete maker; }

ShoalLightStatus shoalLightCreate(ShoalLight** light) {
    if (!light) return bad("there is nowhere to put the light");
    *light = nullptr;
    return guarded([&] { *light = new ShoalLight; });
}

void shoalLightDestroy(ShoalLight* light) { delete light; }

ShoalLightStatus shoalLightMake(ShoalLightMaker* maker, const ShoalLightFrame* frame, ShoalLight* light) {
    if (!maker || !frame || !light) return bad("the maker, the frame or the light is missing");
    if (!frame->pixels) return bad("the frame has no pixels");
    if (frame->width < 2 || frame->height < 2 || frame->width > kMaxSide || frame->height > kMaxSide)
        return bad("the frame's width or height lies outside 2 to 16384");
    const int pixelBytes = bytesPerPixel(frame->format);
    if (pixelBytes == 0) return bad("the frame has no known format");
    const ptrdiff_t tight = static_cast<ptrdiff_t>(pixelBytes) * frame->width;
    const ptrdiff_t rowBytes = frame->rowBytes == 0 ? tight : frame->rowBytes;
    if (rowBytes > -tight && rowBytes < tight)
        return bad("the frame's rowBytes are fewer than its pixels take");
    const bool bgr = frame->format == SHOAL_LIGHT_BGR8 || frame->format == SHOAL_LIGHT_BGRA8;
    const light::FrameView view{static_cast<const uint8_t*>(frame->pixels), frame->width, frame->height,
                                rowBytes, bgr};
    const ShoalLightStatus status = guarded([&] {
        if (pixelBytes > 4)
            makeFromFloats(*maker, view, pixelBytes, light->made);
        else
            makeFromBytes(*maker, view, pixelBytes, light->made);
        light::packLight(light->made, maker->mirrors, light->packed, maker->tooBright);
        light->found = {};
        if (maker->finder) maker->finder->find(light->made.radiance, light->found);
        light->mirrors.clear();
        for (const light::HalfImage& level : light->packed.mirrors)
            light->mirrors.push_back(textureOf(level));
    });
    if (status != SHOAL_LIGHT_OK) { // the light and the maker may be incomplete
        *light = ShoalLight();
        maker->maker = light::LightMaker(maker->options);
        maker->threeBytes.clear();
    }
    return status;
}

void shoalLightMaps(const ShoalLight* light, ShoalLightMaps* maps) {
    if (!maps) return;
    *maps = {};
    if (!light || light->packed.places.empty()) return;
    const light::PackedLight& packed = light->packed;
    maps->lightMap = textureOf(packed.atlas);
    maps->lightPlaces = &packed.places[0].x;
    maps->mapCount = static_cast<int32_t>(packed.places.size());
    maps->mirrorLevels = static_cast<int32_t>(light->mirrors.size());
    maps->mirrors = light->mirrors.data();
    maps->mirrorRoughness = packed.mirrorRoughness.data();
}

float shoalLightScale(const ShoalLight* light) { return light ? light->packed.scale : 1; }

int32_t shoalLightSources(const ShoalLight* light, ShoalLightSource* sources, int32_t room) {
    if (!light || !sources) return 0;
    const auto count = std::min(static_cast<int32_t>(light->found.count), std::max(room, 0));
    for (int32_t i = 0; i < count; ++i) {
        const light::FoundLight& found = light->found.lights[i];
        put(found.direction, sources[i].direction);
        put(found.irradiance, sources[i].irradiance);
        sources[i].radius = found.radius;
        sources[i].share = found.share;
    }
    return count;
}

ShoalLightStatus shoalLightSurfaceTable(int32_t size, float* scaleBias) {
    if (size < 2 || size > kMaxTable) return bad("the table's size lies outside 2 to 1024");
    if (!scaleBias) return bad("there is nowhere to put the table");
    return guarded([&] { std::ranges::copy(shoal::math::makeDfgTable(size), scaleBias); });
}

void shoalLightDiffuse(const ShoalLight* light, const float normal[3], float radiance[3]) {
    put(canBeLookedUp(light, normal) ? light::lookUp(light->made.diffuse, glm::make_vec3(normal))
                                     : glm::vec3(0),
        radiance);
}

void shoalLightGlossy(const ShoalLight* light, const float direction[3], float roughness, float radiance[3]) {
    const float known = roughness > 0 ? std::min(roughness, 1.0f) : 0; // NaN: 0
    put(canBeLookedUp(light, direction) ? light::lookUpGlossy(light->made, glm::make_vec3(direction), known)
                                        : glm::vec3(0),
        radiance);
}

void shoalLightRadianceFromDisplay(const float display[3], float radiance[3]) {
    put(light::radianceFromDisplay(glm::make_vec3(display)), radiance);
}

void shoalLightDisplayFromRadiance(const float radiance[3], float display[3]) {
    put(light::displayFromRadiance(glm::make_vec3(radiance)), display);
}
