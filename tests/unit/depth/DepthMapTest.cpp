// Maps of distances are linear where there is no edge, have their edges at the film's, and are far away where
// the track is not sure.
#include "content/make/depth/DepthTrackWriter.h"
#include "engine/depth/LightDifference.h"
#include "tests/Test.h"
#include "tests/unit/depth/MadeMap.h"

namespace shoal::depth {
namespace {

constexpr int kTrackWidth = 256, kTrackHeight = 128, kScale = kMapWidth / kTrackWidth;
constexpr int kMapHeight = kMapWidth / 2, kFilmScale = 2; // film pixels to a texel of the map
constexpr float kCode_perM = DepthMap::perM(1);           // of the map's codes

// Track codes for the map's.
uint16_t trackCode(float mapCode) { return media::depthCode(mapCode * kCode_perM, media::kExactDepthSteps); }

media::DepthFrame trackOf(const std::function<float(int x, int y)>& mapCode,
                          int confidence = media::kMaxDepthCode) {
    media::DepthFrame track{kTrackWidth, kTrackHeight, {}, {}};
    for (int y = 0; y < kTrackHeight; ++y)
        for (int x = 0; x < kTrackWidth; ++x) track.inverse.push_back(trackCode(mapCode(x, y)));
    track.confidence.assign(static_cast<size_t>(kTrackWidth) * kTrackHeight / 4,
                            static_cast<uint16_t>(confidence));
    return track;
}

// isNear: returns whether a texel of the map is near; near texels get another colour than the rest.
ImageRgb8 filmOf(const std::function<bool(int x, int y)>& isNear) {
    ImageRgb8 film(kMapWidth * kFilmScale, kMapHeight * kFilmScale);
    for (int y = 0; y < film.height; ++y)
        for (int x = 0; x < film.width; ++x) {
            const bool near = isNear(x / kFilmScale, y / kFilmScale);
            uint8_t* pixel = film.at(x, y);
            pixel[0] = near ? 60 : 140, pixel[1] = near ? 90 : 120, pixel[2] = near ? 110 : 70;
        }
    return film;
}

DepthMap refined(const media::DepthFrame& track, const ImageRgb8& film) {
    DepthRefiner refiner;
    DepthMap map;
    refiner.refine(track, viewOf(film, true), map);
    return map;
}
DepthMap enlarged(const media::DepthFrame& track) {
    DepthRefiner refiner;
    DepthMap map;
    refiner.enlarge(track, map);
    return map;
}

ImageRgb8 checkerboard() {
    return filmOf([](int x, int y) { return (x / 3 + y / 5) % 2 == 0; });
}

constexpr float kFar = 40, kNear = 160; // codes of the map
bool isNear(uint8_t code) { return code > 0.5f * (kFar + kNear); }

TEST(DepthMap, IsLinearBetweenTexels) {
    DepthMap map;
    map.inverse = Image<uint8_t, 1>(64, 32);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) *map.inverse.at(x, y) = static_cast<uint8_t>(3 * x + y);
    const auto at = [&](float x, float y) {
        return map.inverse_perM(directionFromLatLong(glm::vec2(x / 64, y / 32)));
    };
    constexpr float kTol = 1e-3f; // of float angles, times the steepest slope: 60 codes of 0.0065 a texel
    EXPECT_NEAR(at(10.5f, 7.5f), (30 + 7) * kCode_perM, kTol);
    EXPECT_NEAR(at(11, 7.5f), (31.5f + 7) * kCode_perM, kTol);
    EXPECT_NEAR(at(11, 8), (31.5f + 7.5f) * kCode_perM, kTol);
    EXPECT_NEAR(at(11.25f, 20.5f), (32.25f + 20) * kCode_perM, kTol);
    // The seam: between the last column and the first.
    EXPECT_NEAR(at(0, 10.5f), (0.5f * (189 + 0) + 10) * kCode_perM, 0.02f);
    // Beyond the first and last rows these go on.
    EXPECT_NEAR(at(20.5f, 0.1f), 60 * kCode_perM, kTol);
    EXPECT_NEAR(at(20.5f, 31.9f), (60 + 31) * kCode_perM, kTol);
    for (const float y : {-1.0f, 1.0f}) {
        const float pole = map.inverse_perM({0, y, 0});
        EXPECT_TRUE(pole >= 0 && pole <= 1 / kNearest_m) << pole;
    }
}

TEST(DepthMap, AnUnknownPlaceIsInfinitelyFar) { EXPECT_EQ(DepthMap().inverse_perM({0, 0, -1}), 0); }

// Half a code of the map and half a code of the track: 1 / 510 / 0.6 and 4 / 2046 per metre.
TEST(DepthMap, KeepsDistancesToItsStep) {
    for (const float metres : {0.61f, 0.8f, 1.0f, 1.7f, 3.0f, 6.0f, 10.0f, 20.0f}) {
        const DepthMap map = enlarged(trackOf([&](int, int) { return 1 / metres / kCode_perM; }));
        EXPECT_NEAR(map.inverse_perM({0, 0, -1}), 1 / metres, kCode_perM / 2 + 4 / 2046.0f) << metres;
    }
    const DepthMap within = enlarged(trackOf([&](int, int) { return 1 / 0.3f / kCode_perM; }));
    EXPECT_FLOAT_EQ(1 / within.inverse_perM({0, 0, -1}), kNearest_m) << "nothing is nearer";
    EXPECT_EQ(enlarged(trackOf([](int, int) { return 0.0f; })).inverse_perM({0, 0, -1}), 0);
}

// Below a confidence of a quarter a distance is ignored, from 0.6 on it counts in full, and it fades between.
TEST(DepthMap, DoubtIsFarAway) {
    const auto code = [](float confidence) {
        const auto track =
            trackOf([](int, int) { return 200.0f; }, static_cast<int>(confidence * media::kMaxDepthCode));
        return int{*refined(track, checkerboard()).inverse.at(500, 300)};
    };
    EXPECT_EQ(code(0), 0);
    EXPECT_EQ(code(0.24f), 0);
    EXPECT_NEAR(code(0.425f), 100, 2);
    EXPECT_EQ(code(0.61f), 200);
    EXPECT_EQ(code(1), 200);
}

// 6 codes from one texel of the track to the next is a slope, whatever the film's colours do.
TEST(DepthRefiner, LeavesSlopesAsTheyAre) {
    const auto slope = [](int x, int y) {
        return 20 + 6.0f * static_cast<float>(std::min(x % 32, 32 - x % 32)) + 0.5f * static_cast<float>(y);
    };
    const auto track = trackOf(slope);
    EXPECT_EQ(refined(track, checkerboard()).inverse.pixels, enlarged(track).inverse.pixels);
}

// Ends of a near surface in texels of the map, as the track and as the film have it: at most half a texel of
// the track apart, as each of its texels is what most of it is.
using Displaced = std::pair<int, int>;
class DepthEdges : public testing::TestWithParam<Displaced> {};

TEST_P(DepthEdges, LieWithinATexelOfTheFilmsAcross) {
    const auto [byTrack, byFilm] = GetParam();
    // A band of a quarter of the map, so that there are two edges: where it begins, which may be the seam,
    // and where it ends.
    const auto within = [](int x, int begin) {
        return ((x - begin) % kMapWidth + kMapWidth) % kMapWidth < kMapWidth / 4;
    };
    const auto track = trackOf([&](int x, int) { return within(x * kScale, byTrack) ? kNear : kFar; });
    const DepthMap map = refined(track, filmOf([&](int x, int) { return within(x, byFilm); }));
    for (const int y : {0, 1, 100, 256, kMapHeight - 2, kMapHeight - 1})
        for (int x = 0; x < kMapWidth; ++x) {
            // Texels beside the edge may be either.
            if (within(x - 1, byFilm) != within(x + 1, byFilm)) continue;
            EXPECT_EQ(isNear(*map.inverse.at(x, y)), within(x, byFilm)) << x << " " << y;
        }
}

TEST_P(DepthEdges, LieWithinATexelOfTheFilmsDown) {
    const auto [byTrack, byFilm] = GetParam();
    if (byTrack == 0) return; // would lie at the pole
    const auto track = trackOf([&](int, int y) { return y * kScale >= byTrack ? kNear : kFar; });
    const DepthMap map = refined(track, filmOf([&](int, int y) { return y >= byFilm; }));
    for (int y = 0; y < kMapHeight; ++y) {
        if (std::abs(2 * (y - byFilm) + 1) == 1) continue; // either
        for (const int x : {0, 1, 500, kMapWidth - 1})
            EXPECT_EQ(isNear(*map.inverse.at(x, y)), y >= byFilm) << x << " " << y;
    }
}

INSTANTIATE_TEST_SUITE_P(ByHalfATexel, DepthEdges,
                         testing::Values(Displaced{400, 400}, Displaced{400, 398}, Displaced{400, 399},
                                         Displaced{400, 401}, Displaced{400, 402}, Displaced{0, 0},
                                         Displaced{0, 2}, Displaced{0, -2}, Displaced{4, 5}, Displaced{4, 3},
                                         Displaced{508, 506}));

// Near and far distances stay the same up to the edge, without a ring of intermediate ones.
TEST(DepthRefiner, MakesNoHalo) {
    const auto track = trackOf([](int x, int) { return x < 100 ? kNear : kFar; });
    const DepthMap map = refined(track, filmOf([](int x, int) { return x < 401; }));
    const uint8_t* row = map.inverse.at(0, 256);
    int between = 0;
    for (int x = 390; x < 412; ++x) between += std::abs(row[x] - kNear) > 2 && std::abs(row[x] - kFar) > 2;
    EXPECT_LE(between, 1);
}

// An edge that the film does not show is where the track has it.
TEST(DepthRefiner, WithoutColoursTheEdgeIsTheTracks) {
    const auto track = trackOf([](int x, int) { return x < 100 ? kNear : kFar; });
    const DepthMap map = refined(track, filmOf([](int, int) { return false; }));
    const uint8_t* row = map.inverse.at(0, 256);
    for (int x = 300; x < 500; ++x) EXPECT_EQ(isNear(row[x]), x < 400) << x;
}

TEST(DepthRefiner, SmallFilmsAreEnlargedAlone) {
    const auto track = trackOf([](int x, int) { return x < 100 ? kNear : kFar; });
    const ImageRgb8 film(512, 256);
    EXPECT_EQ(refined(track, film).inverse.pixels, enlarged(track).inverse.pixels);
}

// Sizes of films that are no multiple of the map's, and of tracks from the smallest to larger than the map.
TEST(DepthRefiner, TakesFilmsAndTracksOfAllSizes) {
    for (const auto& [width, height] :
         {std::pair{1024, 512}, {1500, 800}, {4096, 600}, {1100, 2100}, {3840, 1920}}) {
        const ImageRgb8 film(width, height);
        for (const int trackWidth : {16, 128, 512, 1024, 2048}) {
            media::DepthFrame track{trackWidth, trackWidth / 2, {}, {}};
            for (int i = 0; i < trackWidth * trackWidth / 2; ++i)
                track.inverse.push_back(i / 5 % 3 ? trackCode(kNear) : trackCode(kFar));
            track.confidence.assign(static_cast<size_t>(trackWidth) * trackWidth / 8, media::kMaxDepthCode);
            const DepthMap map = refined(track, film);
            EXPECT_EQ(map.inverse.width, kMapWidth);
            EXPECT_EQ(map.inverse.height, kMapHeight);
            // Roundings of both codes may add up to one.
            EXPECT_GE(*std::ranges::min_element(map.inverse.pixels), kFar - 1);
            EXPECT_LE(*std::ranges::max_element(map.inverse.pixels), kNear + 1);
        }
    }
}

// A step of the map's codes is 1 / (255 * 0.6) = 0.0065 / m, so a distance is half that off; an eye 0.3 m
// beside sees that by 0.001 rad. The search stops within 0.0015 rad.
constexpr float kOff_rad = 2.5e-3f;
constexpr float kPi = std::numbers::pi_v<float>, kTexel_rad = 2 * kPi / kMapWidth;

const std::array<glm::vec3, 4> kEyes = {
    {{0.032f, 0, 0}, {-0.1f, 0.05f, 0.05f}, {0.3f, 0, 0}, {0, -0.2f, -0.2f}}};

float angleBetween(const glm::vec3& a, const glm::vec3& b) { return glm::length(glm::cross(a, b)); }

TEST(Search, MeetsAWallWhereItIs) {
    const DepthMap map = mapOf([](const glm::vec3& d) { return std::max(-d.z, 0.0f) / 2; }); // z = -2
    for (const glm::vec3& eye : kEyes)
        for (float x = -1; x <= 1; x += 0.25f)
            for (float y = -0.5f; y <= 0.5f; y += 0.25f) {
                const glm::vec3 ray = glm::normalize(glm::vec3(x, y, -1));
                const glm::vec3 met = eye + ray * ((-2 - eye.z) / ray.z);
                const glm::vec3 seen = filmDirectionSeen(map, eye, ray);
                EXPECT_LT(angleBetween(seen, glm::normalize(met)), kOff_rad) << x << " " << y;
                EXPECT_NEAR(map.inverse_perM(seen), 1 / glm::length(met), 0.004f);
            }
}

// A rock covers columns 100 to 199 and rows 50 to 79 of a film of slopes. A ring of one texel around it
// becomes as near, also across the seam, and nothing else changes.
TEST(Search, NearThingsAreWidenedByATexel) {
    DepthMap map, widened;
    map.inverse = Image<uint8_t, 1>(1024, 512);
    const auto slope = [](int x, int y) { return static_cast<uint8_t>(10 + (x + y) % 8); };
    const auto isRock = [](int x, int y) {
        return (x >= 100 && x < 200 && y >= 50 && y < 80) || (x == 1023 && y == 300);
    };
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 1024; ++x) *map.inverse.at(x, y) = isRock(x, y) ? 90 : slope(x, y);
    widenNear(map, widened);
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 1024; ++x) {
            const bool near = isRock(x, y) || isRock((x + 1) % 1024, y) || isRock((x + 1023) % 1024, y) ||
                              isRock(x, y - 1) || isRock(x, y + 1);
            ASSERT_EQ(*widened.inverse.at(x, y), near ? 90 : slope(x, y)) << x << " " << y;
        }
}

TEST(Search, MovesNothingThatIsEndlesslyFar) {
    const DepthMap map = mapOf([](const glm::vec3&) { return 0.0f; });
    for (const glm::vec3& eye : kEyes) {
        const glm::vec3 ray = glm::normalize(glm::vec3(0.4f, 0.2f, -1));
        EXPECT_LT(angleBetween(filmDirectionSeen(map, eye, ray), ray), 1e-5f);
    }
}

// A wall 1 m ahead that ends at x = 0. From the right the eye sees past its edge, where nothing is behind it:
// what the camera did not see is as empty as what it saw. From the left, the wall hides what the camera saw.
TEST(Search, SeesPastAnEdgeAndIsStoppedByOneThatComesBefore) {
    for (const auto& [eye_m, behind_perM] : {std::pair(0.1f, 0.0f), {-0.1f, 0.1f}}) {
        const DepthMap map =
            mapOf([&](const glm::vec3& d) { return d.x < 0 ? std::max(-d.z, 0.0f) : behind_perM; });
        for (float x = -0.4f; x <= 0.4f; x += 0.01f) {
            if (std::abs(x + eye_m) < 2 * kTexel_rad) continue; // the edge itself
            const glm::vec3 seen = filmDirectionSeen(map, {eye_m, 0, 0}, glm::normalize(glm::vec3(x, 0, -1)));
            EXPECT_EQ(map.inverse_perM(seen) > 0.5f, x < -eye_m) << x << " from " << eye_m;
        }
    }
}

TEST(Range, HoldsEveryTexelOfACap) {
    const DepthMap map = mapOf([](const glm::vec3& d) { return 0.8f + 0.7f * d.x * d.y; });
    DepthRange range;
    range.make(map);
    for (const glm::vec3 middle :
         {glm::vec3(0, 0, -1), glm::vec3(0, 0, 1), glm::vec3(0, 1, 0), glm::vec3(0.6f, -0.8f, 0)})
        for (const float halfAngle : {0.02f, 0.3f, 1.2f}) {
            const DepthRange::Range found = range.around(middle, halfAngle);
            for (int y = 0; y < kMapHeight; y += 3)
                for (int x = 0; x < kMapWidth; x += 3) {
                    const glm::vec3 dir = texelDirection(x, y, kMapWidth, kMapHeight);
                    if (glm::dot(dir, middle) < std::cos(halfAngle)) continue;
                    ASSERT_GE(DepthMap::perM(*map.inverse.at(x, y)), found.min_perM);
                    ASSERT_LE(DepthMap::perM(*map.inverse.at(x, y)), found.max_perM);
                }
        }
    // Not more than a cell around: the map changes by 0.7 of its sine a radian, a cell is 0.05 wide.
    const DepthRange::Range small = range.around({0, 0, -1}, 0.02f);
    EXPECT_LT(small.max_perM - small.min_perM, 0.7f * 2 * 0.08f * 0.08f + 0.01f);
}

// An infinite matte white wall across +X, at this distance from the camera, with a lit disc.
struct Wall {
    float litRadius_m;
    ImageRgbF radiance{64, 32};
    DepthMap map;

    Wall(float distance_m, float litRadius)
        : litRadius_m(litRadius),
          map(mapOf([&](const glm::vec3& d) { return std::max(d.x, 0.0f) / distance_m; })) {
        // Each texel is the mean of 16 x 16 looks, so that its edge is smooth.
        for (int y = 0; y < 512; ++y)
            for (int x = 0; x < 1024; ++x) {
                const glm::vec3 dir = texelDirection(x, y, 1024, 512);
                const bool lit =
                    dir.x > 0 && glm::length(glm::vec2(dir.y, dir.z)) / dir.x * distance_m < litRadius;
                for (int c = 0; lit && c < 3; ++c) radiance.at(x / 16, y / 16)[c] += 1 / 256.0f;
            }
    }
    // Over all directions, of a lit disc of radiance 1: its solid angle from its axis.
    float fluence(float away_m) const {
        return 2 * kPi * (1 - away_m / std::sqrt(away_m * away_m + litRadius_m * litRadius_m));
    }
};

constexpr float kY00 = 0.282095f;

TEST(LightDifference, NearASunlitWallThereIsMoreOfItsLight) {
    const Wall wall(1, 1);
    LightDifference light;
    light.make(wall.radiance, wall.map);
    for (const glm::vec3& harmonic : light.at(glm::vec3(0)))
        EXPECT_EQ(harmonic, glm::vec3(0)) << "at the camera";
    for (const float towards_m : {-0.7f, 0.3f, 0.5f}) {
        const LightHarmonics beyond = light.at({towards_m, 0, 0});
        const float more = wall.fluence(1 - towards_m) - wall.fluence(1);
        // The disc's edge may be off by a quarter of a ray's width, sqrt(4 pi / 144).
        const float edge = 2 * kPi / std::hypot(1.0f, 1 - towards_m), off = 0.25f * std::sqrt(4 * kPi / 144);
        EXPECT_NEAR(beyond[0].x / kY00, more, edge * off) << towards_m;
        EXPECT_EQ(more > 0, beyond[3].x > 0) << "from +X";
        EXPECT_NEAR(beyond[1].x, 0, 0.1f) << "as much from above as from below";
        EXPECT_NEAR(beyond[2].x, 0, 0.1f);
    }
}

TEST(LightDifference, WhatIsFarGivesTheCamerasLight) {
    const Wall wall(LightDifference::kFar_m + 0.5f, 4);
    LightDifference light;
    light.make(wall.radiance, wall.map);
    for (const glm::vec3& harmonic : light.at({1, 0.5f, -1})) EXPECT_EQ(harmonic, glm::vec3(0));
}

} // namespace
} // namespace shoal::depth
