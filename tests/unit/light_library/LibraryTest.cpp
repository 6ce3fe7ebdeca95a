// The library's C interface: what it takes, what it refuses, and that its textures, sampled as
// shaders/light/Environment.glsl samples them, hold the light that its look-ups give.
#include "engine/light/library/ShoalLight.h"
#include "tests/Test.h"
#include "tests/unit/Heap.h"

#include <glm/gtc/packing.hpp>

namespace {

using shoal::heap::kUnlimited, shoal::heap::left;

// Makers and lights of the C interface, owned by scope; failures are thrown.
using Colour = std::array<float, 3>;
using Direction = std::array<float, 3>;

void check(ShoalLightStatus status) {
    if (status != SHOAL_LIGHT_OK) throw std::runtime_error(shoalLightError());
}

template <class T, auto kDestroy> struct Owned {
    T* object = nullptr;
    Owned() = default;
    Owned(const Owned&) = delete;
    ~Owned() { kDestroy(object); }
};

struct Light : Owned<ShoalLight, shoalLightDestroy> {
    Light() { check(shoalLightCreate(&object)); }
    ShoalLightMaps maps() const {
        ShoalLightMaps maps;
        shoalLightMaps(object, &maps);
        return maps;
    }
    Colour diffuse(const Direction& normal) const {
        Colour radiance;
        shoalLightDiffuse(object, normal.data(), radiance.data());
        return radiance;
    }
    Colour glossy(const Direction& mirrored, float roughness) const {
        Colour radiance;
        shoalLightGlossy(object, mirrored.data(), roughness, radiance.data());
        return radiance;
    }
    std::vector<ShoalLightSource> sources() const {
        std::vector<ShoalLightSource> found(3);
        found.resize(static_cast<size_t>(shoalLightSources(object, found.data(), 3)));
        return found;
    }
};

struct Maker : Owned<ShoalLightMaker, shoalLightMakerDestroy> {
    explicit Maker(const ShoalLightOptions& options = shoalLightDefaults()) {
        check(shoalLightMakerCreate(&options, &object));
    }
    void set(int32_t setting, int32_t value) { check(shoalLightMakerSet(object, setting, value)); }
    void make(const ShoalLightFrame& frame, Light& light) {
        check(shoalLightMake(object, &frame, light.object));
    }
};

constexpr int kWidth = 256, kHeight = 128;

// Returns a frame of four bytes a pixel: blue above, sand below, a bright patch between.
std::vector<uint8_t> scene() {
    std::vector<uint8_t> rgba;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const bool sun = x > 90 && x < 120 && y > 60 && y < 80;
            const int shade = 40 + y / 2;
            const int red = sun ? 255 : shade, green = sun ? 250 : 90, blue = sun ? 240 : 255 - shade;
            for (const int byte : {red, green, blue, x & 255}) rgba.push_back(static_cast<uint8_t>(byte));
        }
    return rgba;
}

ShoalLightFrame frameOf(const std::vector<uint8_t>& rgba) {
    return {rgba.data(), kWidth, kHeight, 0, SHOAL_LIGHT_RGBA8};
}

// Returns the frame in another layout.
std::vector<uint8_t> reordered(const std::vector<uint8_t>& rgba, int channels, bool bgr) {
    std::vector<uint8_t> out;
    for (size_t i = 0; i < rgba.size(); i += 4)
        for (size_t c = 0; c < static_cast<size_t>(channels); ++c)
            out.push_back(rgba[i + (bgr && c < 3 ? 2 - c : c)]);
    return out;
}

std::vector<uint16_t> halvesOf(const Light& light) {
    const ShoalLightTexture map = light.maps().lightMap;
    return {map.rgba, map.rgba + 4 * static_cast<size_t>(map.width) * static_cast<size_t>(map.height)};
}

// Samples a texture as a linear, clamped sampler does.
Colour sampled(const ShoalLightTexture& texture, float u, float v) {
    const float x = u * static_cast<float>(texture.width) - 0.5f,
                y = v * static_cast<float>(texture.height) - 0.5f;
    const float x0 = std::floor(x), y0 = std::floor(y);
    Colour sum{};
    for (int corner = 0; corner < 4; ++corner) {
        const int dx = corner & 1, dy = corner >> 1;
        const float weight = (dx ? x - x0 : 1 - x + x0) * (dy ? y - y0 : 1 - y + y0);
        const int column = std::clamp(static_cast<int>(x0) + dx, 0, texture.width - 1);
        const int row = std::clamp(static_cast<int>(y0) + dy, 0, texture.height - 1);
        for (size_t c = 0; c < 3; ++c)
            sum[c] += weight * glm::unpackHalf1x16(texture.rgba[4 * (row * texture.width + column) + c]);
    }
    return sum;
}

// Twin of filteredRadiance() in Environment.glsl.
Colour filtered(const ShoalLightMaps& maps, const Direction& d, int map) {
    constexpr float kPi = std::numbers::pi_v<float>;
    const float u = 0.5f + std::atan2(d[0], -d[2]) * 0.5f / kPi, v = 0.5f - std::asin(d[1]) / kPi;
    const float* place = maps.lightPlaces + 4 * map;
    return sampled(maps.lightMap, u * place[0] + place[2], v * place[1] + place[3]);
}

// Returns directions over the sphere, poles and both sides of the seam among them.
std::vector<Direction> directions() {
    std::vector<Direction> out = {{0, 1, 0}, {0, -1, 0}, {1e-4f, 0, 1}, {-1e-4f, 0, 1}};
    for (int i = 0; i < 60; ++i) {
        const float y = 1 - (static_cast<float>(i) + 0.5f) / 30, ring = std::sqrt(1 - y * y);
        const float turn = 2.39996f * static_cast<float>(i);
        out.push_back({ring * std::sin(turn), y, ring * std::cos(turn)});
    }
    return out;
}

TEST(LightLibrary, TexturesHoldWhatTheLookUpsGive) {
    Maker maker({SHOAL_LIGHT_VIDEO, 0.1f, 512});
    Light light;
    maker.make(frameOf(scene()), light);
    const ShoalLightMaps maps = light.maps();
    ASSERT_EQ(maps.mapCount, 17);
    for (const Direction& d : directions()) {
        const Colour matte = light.diffuse(d), sampledMatte = filtered(maps, d, 0);
        for (size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(sampledMatte[c] / matte[c], 1, 1e-3); // of a half float: 5e-4
        for (int k = 0; k < maps.mapCount; ++k) {
            const float roughness = std::pow(10.0f, -static_cast<float>(k) / 16);
            const Colour wanted = light.glossy(d, roughness), got = filtered(maps, d, k);
            for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(got[c] / wanted[c], 1, 2e-3) << "map " << k;
        }
    }
}

TEST(LightLibrary, EveryLayoutOfAFrameGivesTheSameLight) {
    const std::vector<uint8_t> rgba = scene();
    Maker maker;
    Light light;
    maker.make(frameOf(rgba), light);
    const std::vector<uint16_t> wanted = halvesOf(light);
    for (const auto& [format, channels, bgr] : {std::tuple{SHOAL_LIGHT_BGR8, 3, true},
                                                {SHOAL_LIGHT_RGB8, 3, false},
                                                {SHOAL_LIGHT_BGRA8, 4, true}}) {
        maker.make({reordered(rgba, channels, bgr).data(), kWidth, kHeight, 0, format}, light);
        EXPECT_EQ(halvesOf(light), wanted) << format;
    }
    // Rows may have gaps and run upwards.
    const std::vector<uint8_t> bgr = reordered(rgba, 3, true);
    constexpr ptrdiff_t kTight = 3 * kWidth, kWide = kTight + 40;
    std::vector<uint8_t> upwards(kWide * kHeight, 200);
    for (int y = 0; y < kHeight; ++y)
        std::memcpy(upwards.data() + (kHeight - 1 - y) * kWide, bgr.data() + y * kTight, kTight);
    maker.make({upwards.data() + (kHeight - 1) * kWide, kWidth, kHeight, -kWide, SHOAL_LIGHT_BGR8}, light);
    EXPECT_EQ(halvesOf(light), wanted);
}

TEST(LightLibrary, FloatsAreTakenAsRadianceAndMended) {
    Maker maker;
    Light light;
    std::vector<float> rgb(3 * kWidth * kHeight, 2.0f);
    maker.make({rgb.data(), kWidth, kHeight, 0, SHOAL_LIGHT_RGB32F}, light);
    EXPECT_NEAR(light.diffuse({0, 1, 0})[0], 2, 1e-4);
    rgb[0] = std::numeric_limits<float>::quiet_NaN();
    rgb[4] = std::numeric_limits<float>::infinity();
    rgb[8] = -3;
    maker.make({rgb.data(), kWidth, kHeight, 0, SHOAL_LIGHT_RGB32F}, light);
    for (const uint16_t half : halvesOf(light)) ASSERT_LT(half, 0x7c00); // finite, not negative
}

TEST(LightLibrary, MirrorsAreMadeForSmoothSurfacesOnly) {
    const std::vector<uint8_t> rgba = scene();
    Light light;
    Maker({SHOAL_LIGHT_VIDEO, 0.1f, 1024}).make(frameOf(rgba), light);
    EXPECT_EQ(light.maps().mirrorLevels, 0);
    Maker({SHOAL_LIGHT_VIDEO, 0.05f, 1024}).make(frameOf(rgba), light);
    const ShoalLightMaps maps = light.maps();
    ASSERT_EQ(maps.mirrorLevels, 1); // as wide as the frame
    EXPECT_EQ(maps.mirrors[0].width, kWidth);
    EXPECT_LT(maps.mirrorRoughness[0], maps.mirrorRoughness[1]);
    EXPECT_NEAR(maps.mirrorRoughness[1], 0.1f, 1e-6);
    // The mirror shows the frame's own light: sand, row 110.
    const Colour shown = sampled(maps.mirrors[0], (100 + 0.5f) / kWidth, (110 + 0.5f) / kHeight);
    const float coded[3] = {95 / 255.0f, 90 / 255.0f, 160 / 255.0f};
    Colour wanted;
    shoalLightRadianceFromDisplay(coded, wanted.data());
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(shown[c] / wanted[c], 1, 0.01);
    shoalLightDisplayFromRadiance(wanted.data(), wanted.data());
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(wanted[c], coded[c], 1e-4);
    Maker({SHOAL_LIGHT_VIDEO, 0.5f, 1024}).make(frameOf(rgba), light);
    EXPECT_LT(light.maps().mapCount, 17);
}

TEST(LightLibrary, WrongInputIsSaidAndLeavesTheLight) {
    const std::vector<uint8_t> rgba = scene();
    Maker maker;
    Light light;
    maker.make(frameOf(rgba), light);
    const std::vector<uint16_t> before = halvesOf(light);
    const ShoalLightFrame good = frameOf(rgba);
    const auto refuses = [&](ShoalLightFrame frame, const char* word) {
        EXPECT_EQ(shoalLightMake(maker.object, &frame, light.object), SHOAL_LIGHT_BAD_ARGUMENT);
        EXPECT_NE(std::strstr(shoalLightError(), word), nullptr) << shoalLightError();
    };
    ShoalLightFrame bad = good;
    bad.pixels = nullptr, refuses(bad, "pixels");
    for (const int32_t size : {-1, 0, 1, 16385, std::numeric_limits<int32_t>::max()}) {
        bad = good, bad.width = size, refuses(bad, "width");
        bad = good, bad.height = size, refuses(bad, "height");
    }
    for (const ptrdiff_t rowBytes : {4 * kWidth - 1, 1, -1, 1 - 4 * kWidth}) {
        bad = good, bad.rowBytes = rowBytes, refuses(bad, "rowBytes");
    }
    for (const int32_t format : {-1, 6, 1000}) bad = good, bad.format = format, refuses(bad, "format");
    EXPECT_EQ(halvesOf(light), before);

    ShoalLightMaker* none = nullptr;
    for (const ShoalLightOptions& options :
         {ShoalLightOptions{2, 0.1f, 1024}, ShoalLightOptions{0, 1.1f, 1024},
          ShoalLightOptions{0, std::numeric_limits<float>::quiet_NaN(), 1024},
          ShoalLightOptions{0, 0.1f, 255}, ShoalLightOptions{0, 0.1f, 8193}}) {
        EXPECT_EQ(shoalLightMakerCreate(&options, &none), SHOAL_LIGHT_BAD_ARGUMENT);
        EXPECT_EQ(none, nullptr);
    }
    float table[8];
    for (const int32_t size : {-1, 0, 1, 1025})
        EXPECT_EQ(shoalLightSurfaceTable(size, table), SHOAL_LIGHT_BAD_ARGUMENT);
    EXPECT_EQ(shoalLightSurfaceTable(2, nullptr), SHOAL_LIGHT_BAD_ARGUMENT);
    EXPECT_EQ(shoalLightMake(nullptr, &good, light.object), SHOAL_LIGHT_BAD_ARGUMENT);
    EXPECT_EQ(shoalLightMakerCreate(nullptr, nullptr), SHOAL_LIGHT_BAD_ARGUMENT);
    EXPECT_EQ(shoalLightCreate(nullptr), SHOAL_LIGHT_BAD_ARGUMENT);
}

TEST(LightLibrary, NothingAndNonsenseAreBlack) {
    Light empty;
    EXPECT_EQ(empty.maps().lightMap.rgba, nullptr);
    EXPECT_EQ(empty.glossy({0, 1, 0}, 0.5f), Colour{});
    Colour radiance{1, 1, 1};
    shoalLightDiffuse(nullptr, Direction{0, 1, 0}.data(), radiance.data());
    EXPECT_EQ(radiance, Colour{});
    shoalLightDestroy(nullptr);
    shoalLightMakerDestroy(nullptr);

    Light light;
    Maker().make(frameOf(scene()), light);
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                    kInf = std::numeric_limits<float>::infinity();
    EXPECT_EQ(light.diffuse({kNan, 0, 0}), Colour{});
    EXPECT_EQ(light.glossy({0, kInf, 0}, 0.5f), Colour{});
    for (const float roughness : {-1.0f, 7.0f, kNan, kInf})
        EXPECT_GT(light.glossy({0, 1, 0}, roughness)[2], 0);
    EXPECT_GT(light.diffuse({0, 1000, 0})[2], 0);
}

// A sky of 1 and a sun overhead, half its sphere's width from the seam.
std::vector<float> sunnySky(float sun) {
    std::vector<float> rgb(3 * kWidth * kHeight, 1.0f);
    for (int y = 18; y < 22; ++y)
        for (int x = 126; x < 130; ++x) std::fill_n(&rgb[3 * (y * kWidth + x)], 3, sun);
    return rgb;
}

TEST(LightLibrary, ScaledMapsHoldASunThatHalfFloatsCannot) {
    for (const float sun : {100.0f, 1e9f}) {
        const std::vector<float> rgb = sunnySky(sun);
        const ShoalLightFrame frame{rgb.data(), kWidth, kHeight, 0, SHOAL_LIGHT_RGB32F};
        Maker maker({SHOAL_LIGHT_STILL, 0.1f, 512});
        Light cut, scaled;
        maker.make(frame, cut);
        maker.set(SHOAL_LIGHT_SCALED_MAPS, 1);
        maker.make(frame, scaled);
        EXPECT_EQ(shoalLightScale(cut.object), 1);
        EXPECT_EQ(shoalLightScale(scaled.object) > 1, sun > 65504);
        for (const Direction& d : directions())
            for (int k = 0; k < scaled.maps().mapCount; ++k) {
                const float wanted = scaled.glossy(d, std::pow(10.0f, -static_cast<float>(k) / 16))[1];
                // A hundredth, and steps of 2^-24 where half floats end.
                EXPECT_NEAR(shoalLightScale(scaled.object) * filtered(scaled.maps(), d, k)[1], wanted,
                            0.01f * wanted + shoalLightScale(scaled.object) * std::ldexp(1.0f, -24))
                    << "map " << k;
            }
    }
}

TEST(LightLibrary, FramesAreWhatTheMakerIsTold) {
    const std::vector<uint8_t> grey(3 * kWidth * kHeight, 128);
    const ShoalLightFrame frame{grey.data(), kWidth, kHeight, 0, SHOAL_LIGHT_RGB8};
    Maker maker;
    Light light;
    // By the formula: 128 / 255 (10 (128 / 255)^10 + 1.8); by IEC 61966-2-1: 0.2159.
    for (const auto& [frames, wanted] :
         {std::pair(SHOAL_LIGHT_THESIS, 0.9086f), std::pair(SHOAL_LIGHT_SRGB, 0.2159f),
          std::pair(SHOAL_LIGHT_SRGB_UNCLIPPED, 0.2159f)}) {
        maker.set(SHOAL_LIGHT_FRAMES, frames);
        maker.make(frame, light);
        EXPECT_NEAR(light.diffuse({0, 1, 0})[0], wanted, 1e-3f);
    }
    EXPECT_EQ(shoalLightMakerSet(maker.object, SHOAL_LIGHT_FRAMES, 3), SHOAL_LIGHT_BAD_ARGUMENT);
    EXPECT_EQ(shoalLightMakerSet(maker.object, 3, 0), SHOAL_LIGHT_BAD_ARGUMENT);
    EXPECT_EQ(shoalLightMakerSet(nullptr, SHOAL_LIGHT_FRAMES, 0), SHOAL_LIGHT_BAD_ARGUMENT);
}

TEST(LightLibrary, SourcesAreFoundWhereAskedFor) {
    const std::vector<float> rgb = sunnySky(3000);
    const ShoalLightFrame frame{rgb.data(), kWidth, kHeight, 0, SHOAL_LIGHT_RGB32F};
    Maker maker;
    Light light;
    maker.make(frame, light);
    EXPECT_TRUE(light.sources().empty());
    maker.set(SHOAL_LIGHT_FIND_SOURCES, 1);
    maker.make(frame, light);
    ASSERT_EQ(light.sources().size(), 1u);
    const ShoalLightSource sun = light.sources()[0];
    // The middle of its texels: u = 1/2, v = 20 / 128.
    const float up = std::cos(std::numbers::pi_v<float> * 20 / 128);
    EXPECT_NEAR(sun.direction[1], up, 0.01f);
    EXPECT_LT(sun.direction[2], 0);
    EXPECT_NEAR(sun.direction[0], 0, 0.02f);
    // Sixteen texels of (2 pi / 256) (pi / 128) sin(pi 20 / 128) of 3000, on a plane that faces them.
    const float wanted = 3000 * 16 * 6.024e-4f * std::sin(std::numbers::pi_v<float> * 20 / 128);
    EXPECT_NEAR(sun.irradiance[1], wanted, 0.1f * wanted);
    EXPECT_GT(sun.share, 0.5f);
    EXPECT_EQ(shoalLightSources(light.object, nullptr, 3), 0);
    ShoalLightSource one;
    EXPECT_EQ(shoalLightSources(light.object, &one, 0), 0);
    EXPECT_EQ(shoalLightSources(nullptr, &one, 1), 0);
}

TEST(LightLibrary, TheSurfaceTableKeepsEnergy) {
    std::vector<float> table(2 * 32 * 32);
    check(shoalLightSurfaceTable(32, table.data()));
    for (size_t i = 0; i < table.size(); i += 2) {
        EXPECT_GE(table[i], 0);
        EXPECT_GE(table[i + 1], 0);
        EXPECT_LE(table[i] + table[i + 1], 1.001f);
    }
    EXPECT_STREQ(shoalLightVersion(), "1.1.0");
}

// Nothing is allocated from a light's second frame on; an error says that there is not enough memory, and the
// maker and the light serve again.
TEST(LightLibraryMemory, ASecondFrameTakesNone) {
    const std::vector<uint8_t> bytes(4 * kWidth * kHeight, 99);
    const std::vector<float> floats(4 * kWidth * kHeight, 0.5f);
    for (const int32_t format : {SHOAL_LIGHT_BGR8, SHOAL_LIGHT_RGBA8, SHOAL_LIGHT_RGBA32F}) {
        const bool coded = format != SHOAL_LIGHT_RGBA32F;
        const void* pixels = coded ? static_cast<const void*>(bytes.data()) : floats.data();
        const ShoalLightFrame frame{pixels, kWidth, kHeight, 0, format};
        Maker maker({SHOAL_LIGHT_VIDEO, 0.05f, 512});
        Light light;
        maker.make(frame, light);
        left = 0;
        EXPECT_NO_THROW(maker.make(frame, light)) << format;
        left = kUnlimited;
    }
}

TEST(LightLibraryMemory, TooLittleIsSaidWhereverItEnds) {
    const std::vector<uint8_t> bytes(4 * kWidth * kHeight, 99);
    const ShoalLightFrame frame{bytes.data(), kWidth, kHeight, 0, SHOAL_LIGHT_RGBA8};
    const ShoalLightOptions options{SHOAL_LIGHT_VIDEO, 0.5f, 256};
    ShoalLightMaker* none = nullptr;
    left = 0;
    EXPECT_EQ(shoalLightMakerCreate(&options, &none), SHOAL_LIGHT_OUT_OF_MEMORY);
    left = kUnlimited;
    EXPECT_EQ(none, nullptr);

    Light wanted;
    Maker(options).make(frame, wanted);
    std::optional<Maker> maker(std::in_place, options);
    int failures = 0;
    for (long enough = 0;; enough += 1 + enough / 4) {
        Light light;
        left = enough;
        const ShoalLightStatus status = shoalLightMake(maker->object, &frame, light.object);
        left = kUnlimited;
        if (status == SHOAL_LIGHT_OK) break;
        ++failures;
        ASSERT_EQ(status, SHOAL_LIGHT_OUT_OF_MEMORY);
        EXPECT_EQ(light.maps().mapCount, 0);
        if (failures % 5) continue; // now and then: the same maker, with enough of it
        maker->make(frame, light);
        EXPECT_EQ(light.diffuse({0, 1, 0}), wanted.diffuse({0, 1, 0}));
        maker.emplace(options);
    }
    EXPECT_GT(failures, 10);
}

} // namespace
