// Shadows on a film, against the closed form at the places that the film shows.
#include "engine/render/FilmShadows.h"
#include "tests/Test.h"
#include "tests/unit/shadow/ShadowScene.h"

namespace shoal::render {
namespace {

using tests::filmOf, tests::kGround_m, tests::levelGround, tests::lightAt, tests::rangeOf, tests::toPlane;

const water::Water kSea{.veil = {{{0.05f, 0.15f, 0.25f}}}, .attenuation_perM = {0.2f, 0.1f, 0.08f}};

const occlusion::Ellipsoid kShark{{0.3f, -0.4f, -1.6f}, glm::mat3(1), {0.2f, 0.22f, 1.1f}};

std::vector<FlatPiece> flat(std::span<const occlusion::Ellipsoid> body, const CastingLight& light) {
    std::vector<FlatPiece> out;
    flatten(body, light, out);
    return out;
}

// Four eyes that see everything.
std::vector<View> everywhere() {
    std::vector<View> eyes;
    for (int k = 0; k < 4; ++k)
        eyes.push_back({.worldFromEye =
                            glm::angleAxis(static_cast<float>(k) * glm::half_pi<float>(), glm::vec3(0, 1, 0)),
                        .verticalFov = 3.1f,
                        .aspect = 1});
    return eyes;
}

struct Scene {
    const depth::DepthMap& map;
    CastingLight light = lightAt(66, 12);
    water::Water water{};
    glm::mat3 envFromWorld{1};
    glm::vec3 cameraWorld{0};
};

FilmShadows shadowsOf(const occlusion::Ellipsoid& body, const Scene& scene,
                      const std::vector<View>& eyes = everywhere()) {
    const depth::DepthRange range = rangeOf(scene.map);
    FilmShadows shadows;
    shadows.begin({&scene.map, &range, scene.envFromWorld, scene.cameraWorld}, FrameCoding::Srgb,
                  scene.water);
    shadows.add({&body, 1}, scene.light, eyes);
    return shadows;
}

glm::vec3 directionOf(const FilmShadows& shadows, int x, int y) {
    return texelDirection(x, y, shadows.remaining().width, shadows.remaining().height);
}

// Calls visit(direction in the film's frame, remaining light) for each texel.
template <class Visit> void eachTexel(const FilmShadows& shadows, Visit&& visit) {
    for (int y = 0; y < shadows.remaining().height; ++y)
        for (int x = 0; x < shadows.remaining().width; ++x) {
            const uint8_t* left = shadows.remaining().at(x, y);
            visit(directionOf(shadows, x, y), glm::vec3(left[2], left[1], left[0]) / 255.0f);
        }
}

int shadedTexels(const FilmShadows& shadows) {
    int count = 0;
    eachTexel(shadows, [&](const glm::vec3&, const glm::vec3& left) { count += left != glm::vec3(1); });
    return count;
}

// On level and tilted planes the remaining light is the closed form's for the place, times the share that the
// plane's slope towards the light leaves. Nothing is dimmed elsewhere.
TEST(FilmShadows, OnPlanesAreTheClosedForm) {
    for (const glm::vec3& normal : {glm::vec3(0, 1, 0), glm::normalize(glm::vec3(0.5f, 1, 0.2f))}) {
        const auto map = filmOf([&](const glm::vec3& dir) { return toPlane(dir, normal, -kGround_m); });
        const Scene scene{.map = map, .water = kSea};
        const FilmShadows shadows = shadowsOf(kShark, scene);
        ASSERT_FALSE(shadows.empty());
        const auto pieces = flat({&kShark, 1}, scene.light);
        const glm::vec3 share = scene.light.shareAt(glm::dot(normal, scene.light.towards));
        double error = 0, worst = 0, darkest = 0;
        int counted = 0;
        eachTexel(shadows, [&](const glm::vec3& dir, const glm::vec3& left) {
            const float distance = toPlane(dir, normal, -kGround_m);
            const float hidden = distance < 20 ? covered(pieces, scene.light, distance * dir) : 0;
            const glm::vec3 expected =
                remainingOf(hidden * share, FrameCoding::Srgb, surfaceShare(kSea, distance));
            for (int c = 0; c < 3; ++c) {
                const double off = static_cast<double>(std::abs(left[c] - expected[c]));
                worst = std::max(worst, off);
                error += hidden > 0 ? off : 0;
            }
            counted += hidden > 0;
            darkest = std::max(darkest, static_cast<double>(1 - expected.x));
        });
        EXPECT_GT(darkest, 0.1);
        ASSERT_GT(counted, 2000);
        // The map's rounding tilts the normal by 0.05 on average, which changes the share by a few
        // hundredths and display values by half of that; where it tilts it by 0.2, the share by a tenth.
        EXPECT_LT(error / (3.0 * counted), 0.004);
        EXPECT_LT(worst, 0.045);
    }
}

TEST(FilmShadows, FollowTheFilmsFrameAndItsCamera) {
    const auto ground = levelGround();
    const FilmShadows straight = shadowsOf(kShark, {.map = ground});
    // The film turned by a quarter about the vertical: so is the shadow on its map.
    const Scene turned{.map = ground,
                       .envFromWorld = glm::mat3(
                           glm::mat4_cast(glm::angleAxis(-glm::half_pi<float>(), glm::vec3(0, 1, 0))))};
    const FilmShadows aside = shadowsOf(kShark, turned);
    const int width = straight.remaining().width;
    for (int y = 0; y < straight.remaining().height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(straight.remaining().at(x, y)[c],
                            aside.remaining().at((x + width / 4) % width, y)[c], 1);
    // Camera and body moved alike: nothing changes.
    const glm::vec3 shift(0.03f, 0, -0.02f);
    occlusion::Ellipsoid moved = kShark;
    moved.centre += shift;
    const FilmShadows beside = shadowsOf(moved, {.map = ground, .cameraWorld = shift});
    for (size_t i = 0; i < straight.remaining().pixels.size(); ++i)
        ASSERT_NEAR(straight.remaining().pixels[i], beside.remaining().pixels[i], 1);
}

// Tiles say where something is shaded, with the texels beside it that enlarging the map reaches.
TEST(FilmShadows, NothingIsShadedBesideTheTiles) {
    const auto ground = levelGround();
    for (const float radius_deg : {5.0f, 20.0f, 30.0f}) {
        const FilmShadows shadows = shadowsOf(kShark, {.map = ground, .light = lightAt(60, radius_deg)});
        const Image<uint8_t, 4>& left = shadows.remaining();
        int shaded = 0;
        for (int y = 0; y < left.height; ++y)
            for (int x = 0; x < left.width; ++x) {
                if (left.at(x, y)[0] == 255 && left.at(x, y)[1] == 255 && left.at(x, y)[2] == 255) continue;
                ++shaded;
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx) {
                        const glm::vec2 texel(x + dx, std::clamp(y + dy, 0, left.height - 1));
                        const glm::vec2 uv = (texel + 0.5f) / glm::vec2(left.width, left.height);
                        ASSERT_TRUE(shadows.tiles().isChosen(
                            FrameTiles::between(uv, uv, shadows.tiles().frameSize())));
                    }
            }
        EXPECT_GT(shaded, 500) << radius_deg << " degrees";
    }
}

// Ground 1 m below the camera ends 1.6 m ahead of it; the ground beyond lies 0.4 m lower. Both are dimmed,
// and no texel by more than the closed form says for its place.
TEST(FilmShadows, OverAStepFallOnBothSides) {
    const auto distance = [](const glm::vec3& dir) {
        const float near_m = toPlane(dir, {0, 1, 0}, 1), far_m = toPlane(dir, {0, 1, 0}, 1.4f);
        return near_m * -dir.z < 1.6f ? near_m : far_m;
    };
    const auto map = filmOf(distance);
    const CastingLight light = lightAt(90, 8);
    const FilmShadows shadows = shadowsOf(kShark, {.map = map, .light = light});
    const auto pieces = flat({&kShark, 1}, light);
    int onNear = 0, onFar = 0, wrong = 0;
    eachTexel(shadows, [&](const glm::vec3& dir, const glm::vec3& left) {
        const float distance_m = distance(dir);
        if (!(distance_m < 6)) return;
        const glm::vec3 place = distance_m * dir;
        const float hidden = covered(pieces, light, place);
        if (left.x < 0.95f) (std::abs(place.y + 1) < 0.1f ? onNear : onFar) += 1;
        // The cosine at a step's edge may be that of a steep place: less light than level ground has.
        wrong += 1 - left.x > hidden * 0.55f + 0.02f;
    });
    EXPECT_GT(onNear, 200);
    EXPECT_GT(onFar, 200);
    EXPECT_EQ(wrong, 0);
}

// Below a ledge that the body's shadow falls on nothing is dimmed: the ground there has lost that light to
// the ledge already. The film shows a ledge 0.5 m below the shark, and ground 0.9 m below that where it ends.
TEST(FilmShadows, DoNotFallThroughWhatTheyFallOn) {
    const auto distance = [](const glm::vec3& dir) {
        const float ledge_m = toPlane(dir, {0, 1, 0}, 0.8f);
        return ledge_m * dir.z < -0.9f ? ledge_m : toPlane(dir, {0, 1, 0}, 1.7f);
    };
    // The film shows the lower ground up to z = -1.9, past the ledge's edge at z = -0.9.
    const auto map = filmOf(distance);
    const occlusion::Ellipsoid fish{{0, -0.3f, -1.5f}, glm::mat3(1), {0.1f, 0.1f, 0.2f}};
    const CastingLight light = lightAt(90, 8);
    const FilmShadows shadows = shadowsOf(fish, {.map = map, .light = light});
    int onLedge = 0, below = 0;
    eachTexel(shadows, [&](const glm::vec3& dir, const glm::vec3& left) {
        if (left.x > 0.98f) return;
        ++((distance(dir) * dir).y > -1 ? onLedge : below);
    });
    EXPECT_GT(onLedge, 100);
    EXPECT_EQ(below, 0);
}

TEST(FilmShadows, NothingIsShadedWhereNothingCasts) {
    const auto ground = levelGround();
    const auto unknown = filmOf([](const glm::vec3&) { return INFINITY; });
    const auto isEmpty = [](const FilmShadows& shadows) {
        return shadows.empty() && shadedTexels(shadows) == 0;
    };
    CastingLight dark = lightAt(66, 16);
    dark.share = glm::vec3(0);
    EXPECT_TRUE(isEmpty(shadowsOf({{0, 1, -2}, glm::mat3(1), {0.01f, 0.01f, 0.02f}}, {.map = ground})))
        << "a small fish";
    EXPECT_TRUE(isEmpty(shadowsOf(kShark, {.map = unknown}))) << "distances that nobody knows";
    EXPECT_TRUE(isEmpty(shadowsOf({{0, kGround_m - 1, 0}, glm::mat3(1), glm::vec3(0.1f)}, {.map = ground})))
        << "below the ground";
    EXPECT_TRUE(isEmpty(shadowsOf(kShark, {.map = ground, .light = dark}))) << "no light";
    EXPECT_TRUE(isEmpty(
        shadowsOf(kShark, {.map = ground},
                  {View{.worldFromEye = glm::angleAxis(0.9f, glm::vec3(1, 0, 0)), .verticalFov = 0.9f}})))
        << "looking up";
    EXPECT_EQ(lightAt(10, 16).raised(), 0);
    EXPECT_EQ(lightAt(66, 16).raised(), 1);
}

// Nothing stays of the last frame, and two bodies leave the product of what each leaves.
TEST(FilmShadows, BodiesMultiplyAndFramesBeginAnew) {
    const auto ground = levelGround();
    const auto range = rangeOf(ground);
    const CastingLight light = lightAt(66, 12);
    const std::vector<View> eyes = everywhere();
    occlusion::Ellipsoid other = kShark;
    other.centre.x += 0.2f;
    const FilmShadows one = shadowsOf(kShark, {.map = ground}), two = shadowsOf(other, {.map = ground});
    FilmShadows both;
    both.begin({&ground, &range}, FrameCoding::Srgb, {});
    both.add({&kShark, 1}, light, eyes);
    both.add({&other, 1}, light, eyes);
    for (size_t i = 0; i < both.remaining().pixels.size(); ++i)
        ASSERT_NEAR(both.remaining().pixels[i],
                    one.remaining().pixels[i] * two.remaining().pixels[i] / 255.0f, 1);
    const uint64_t before = both.version().second;
    both.begin({&ground, &range}, FrameCoding::Srgb, {});
    EXPECT_GT(both.version().second, before);
    EXPECT_TRUE(both.empty());
    EXPECT_EQ(shadedTexels(both), 0);
}

struct Steps {
    float comingIn = 0; // largest change in a step while less than 0.025 is taken
    float ever = 0;     // largest change in any step
    float most = 0;     // most that is taken
};

// Measures the share of display values taken in the middle of a body's shadow as it sinks, in 1000 steps.
Steps stepsOfSinking(const glm::vec3& half, float ground_m, float from_m, float to_m) {
    const CastingLight light = lightAt(66, 16);
    const auto ground = levelGround(ground_m);
    const auto range = rangeOf(ground);
    FilmShadows shadows;
    Steps steps;
    float before = 0;
    const std::vector<View> eyes = everywhere();
    // Always at one texel: where the body's shadow is at the end.
    const glm::vec3 under = glm::vec3(0, to_m, -1) - light.towards * ((to_m - ground_m) / light.towards.y);
    const glm::vec2 uv = latLongFromDirection(glm::normalize(under));
    for (int step = 0; step <= 1000; ++step) {
        const float height = from_m + (to_m - from_m) * static_cast<float>(step) / 1000;
        const occlusion::Ellipsoid body{{0, height, -1}, glm::mat3(1), half};
        shadows.begin({&ground, &range}, FrameCoding::Srgb, {});
        shadows.add({&body, 1}, light, eyes);
        const Image<uint8_t, 4>& left = shadows.remaining();
        const auto x = static_cast<int>(uv.x * static_cast<float>(left.width)),
                   y = static_cast<int>(uv.y * static_cast<float>(left.height));
        const float now = 1 - static_cast<float>(left.at(x, y)[2]) / 255;
        steps.ever = std::max(steps.ever, std::abs(now - before));
        if (before < 0.025f) steps.comingIn = steps.ever;
        steps.most = std::max(steps.most, now);
        before = now;
    }
    return steps;
}

// The shadow of a fish that sinks comes in by at most a display value at a time; so does a shark's that comes
// within the reach of shadows, 8 m. The body moves by 2 mm (shark: 4) a step, a shadow's edge of a light of
// 16 degrees is at least that wide.
TEST(FilmShadows, ComeInWithoutAStep) {
    const glm::vec3 fish(0.03f, 0.05f, 0.1f), shark(0.2f, 0.22f, 1.1f);
    for (const Steps& steps : {stepsOfSinking(fish, kGround_m, 1, -1.1f), stepsOfSinking(shark, -6, 2, -2)}) {
        EXPECT_LE(steps.comingIn, 1.01f / 255);
        EXPECT_LT(steps.ever, 0.01f);
        EXPECT_GT(steps.most, 0.025f);
    }
}

// Eyes all around look past bodies all around: each eye that sees a shaded place gets its shadow.
TEST(FilmShadows, AreWorkedOutWhereAnEyeMaySeeThem) {
    const auto ground = levelGround();
    int seen = 0, unseen = 0, leftOut = 0;
    for (int k = 0; k < 6; ++k) {
        const float turn = static_cast<float>(k) * glm::pi<float>() / 3;
        const occlusion::Ellipsoid body{{2 * std::cos(turn), -0.2f, 2 * std::sin(turn)},
                                        glm::mat3(1),
                                        {0.1f, 0.1f, k % 3 == 0 ? 0.9f : 0.2f}};
        const Scene scene{.map = ground};
        const FilmShadows all = shadowsOf(body, scene);
        for (int yaw = 0; yaw < 12; ++yaw)
            for (const float pitch : {-0.9f, 0.0f, 0.5f}) {
                const View eye{.eyeWorld = {0.1f, 0.05f, -0.1f},
                               .worldFromEye = glm::angleAxis(static_cast<float>(yaw) * glm::pi<float>() / 6,
                                                              glm::vec3(0, 1, 0)) *
                                               glm::angleAxis(pitch, glm::vec3(1, 0, 0)),
                               .verticalFov = 0.6f,
                               .shift = {0.1f, -0.05f}};
                const FilmShadows mine = shadowsOf(body, scene, {eye});
                int missing = 0, wanted = 0;
                const glm::mat4 clipFromWorld = eye.clipFromWorld();
                for (int y = all.remaining().height / 2; y < all.remaining().height; ++y)
                    for (int x = 0; x < all.remaining().width; ++x) {
                        if (all.remaining().at(x, y)[2] == 255) continue;
                        const glm::vec3 dir = directionOf(all, x, y);
                        const glm::vec4 clip = clipFromWorld * glm::vec4(dir * (kGround_m / dir.y), 1);
                        if (!(clip.w > 0 && std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w)) continue;
                        ++wanted;
                        missing += mine.remaining().at(x, y)[2] > all.remaining().at(x, y)[2] + 1;
                    }
                EXPECT_EQ(missing, 0) << k << ", " << yaw << ", " << pitch;
                seen += wanted > 0, unseen += wanted == 0, leftOut += mine.empty();
            }
    }
    EXPECT_GT(seen, 10);
    EXPECT_GT(leftOut, unseen / 2);
}

TEST(FilmShadows, LeaveNoMoreThanThereIs) {
    const CastingLight light = lightAt(66, 16);
    for (const FrameCoding frames : {FrameCoding::Srgb, FrameCoding::Thesis})
        for (const float hidden : {0.0f, 0.3f, 1.0f})
            for (const float distance_m : {0.5f, 3.0f, 30.0f}) {
                const glm::vec3 left =
                    remainingOf(hidden * light.share, frames, surfaceShare(kSea, distance_m));
                for (int c = 0; c < 3; ++c) {
                    EXPECT_LE(left[c], 1);
                    EXPECT_GE(left[c], 1 - hidden * light.share[c] - 1e-6f);
                }
            }
    // Light of deep water, of a grey surface at 3 m and of the water before it.
    for (int c = 0; c < 3; ++c) {
        const float arrives = std::exp(-3 * kSea.attenuation_perM[c]),
                    water = (1 - arrives) * kSea.veil[0][c];
        EXPECT_NEAR(surfaceShare(kSea, 3)[c] * (0.25f * arrives + water), 0.25f * arrives, 1e-6f);
    }
    EXPECT_EQ(surfaceShare({}, 3), glm::vec3(1)) << "in air";
    // Half of 40 % of the light is hidden: 0.8 of it is left, and its square root as display values show it.
    EXPECT_NEAR(remainingOf(0.5f * light.share, FrameCoding::Thesis, glm::vec3(1)).x, 0.8f, 1e-6f);
    EXPECT_NEAR(remainingOf(0.5f * light.share, FrameCoding::Srgb, glm::vec3(1)).x, std::sqrt(0.8f), 1e-6f);
    EXPECT_NEAR(remainingOf(1.0f * light.share, FrameCoding::Srgb, surfaceShare(kSea, 100)).y, 1,
                1e-3f); // all veil
}

// The shadow in closed form against rays to every part of the light.

constexpr float kPi = std::numbers::pi_v<float>;

bool meets(const occlusion::Ellipsoid& body, const glm::vec3& from, const glm::vec3& dir) {
    const glm::mat3 axesFromWorld = glm::transpose(body.worldFromAxes);
    const glm::vec3 o = (axesFromWorld * (from - body.centre)) / body.semiAxes;
    const glm::vec3 d = (axesFromWorld * dir) / body.semiAxes;
    const float b = glm::dot(o, d), a = glm::dot(d, d), c = glm::dot(o, o) - 1;
    return b < 0 && b * b > a * c;
}

struct Difference {
    float maximum = 0;         // largest difference of the hidden share
    float light = 0, rays = 0; // hidden share by the closed form and by rays, summed over square metres
};

// Compares both on the level ground around what a body shades there.
Difference compare(const occlusion::Ellipsoid& body, const CastingLight& light) {
    const auto seen = flat({&body, 1}, light);
    const float level = std::sqrt(1 - light.towards.y * light.towards.y);
    const float rise = light.towards.y - light.tangent * level; // of the disc's lower edge
    glm::vec2 low(INFINITY), high(-INFINITY);
    for (const FlatPiece& piece : seen) {
        const float away = (piece.middle.y - kGround_m) / light.towards.y;
        const glm::vec3 under = piece.middle - away * light.towards;
        const float reach = (piece.halfAlong_m + piece.halfAside_m + 2 * light.tangent * away) / rise;
        low = glm::min(low, glm::vec2(under.x, under.z) - reach);
        high = glm::max(high, glm::vec2(under.x, under.z) + reach);
    }
    Difference all;
    constexpr int kSteps = 40;
    const glm::vec2 step = (high - low) / static_cast<float>(kSteps);
    for (int y = 0; y <= kSteps; ++y)
        for (int x = 0; x <= kSteps; ++x) {
            const glm::vec2 xz = low + step * glm::vec2(x, y);
            const glm::vec3 place(xz.x, kGround_m, xz.y);
            const float form = covered(seen, light, place),
                        rays = tests::hiddenByRays(
                            light, 4000, [&](const glm::vec3&to) { return meets(body, place, to); });
            all.maximum = std::max(all.maximum, std::abs(form - rays));
            all.light += form * step.x * step.y;
            all.rays += rays * step.x * step.y;
        }
    return all;
}

// The closed form takes the product of two strips' shares of the light's disc for a rectangle's share. The
// error is largest for a sphere about as large as the light, and for a shark's slices under a narrow light.
TEST(CastShadow, ASphereAndASharkUnderACapShadeAsRaysFindIt) {
    const glm::vec3 along = glm::normalize(glm::vec3(0.8f, 0.2f, 0.5f)),
                    aside = glm::normalize(glm::vec3(0.5f, 0, -0.8f));
    const occlusion::Ellipsoid sphere{.semiAxes = glm::vec3(0.12f)},
        shark{{1, 0, -2}, glm::mat3(aside, glm::cross(along, aside), along), {0.2f, 0.22f, 1.1f}};
    for (const float radius_deg : {4.0f, 10.0f, 16.0f, 25.0f})
        for (const float elevation_deg : {90.0f, 66.0f})
            for (const bool isShark : {false, true}) {
                SCOPED_TRACE(testing::Message()
                             << radius_deg << " degrees wide, " << elevation_deg << " high");
                const Difference d = compare(isShark ? shark : sphere, lightAt(elevation_deg, radius_deg));
                EXPECT_LT(d.maximum, !isShark ? 0.16f : radius_deg < 5 ? 0.3f : 0.14f);
                EXPECT_NEAR(d.light, d.rays, 0.06f * d.rays);
            }
}

// A sphere of radius r at height h above level ground hides (r / h)^2 of an even sky's irradiance from the
// place below it. There the closed form finds up to a half more: the product of two strips' shares is a third
// denser in the middle than the disc, and two slices of a sphere are a tenth larger.
TEST(CastShadow, AllOtherLightIsThatOfAnEvenSky) {
    CastingLight found = lightAt(66, 12);
    found.presence = 0.5f;
    const CastingLight rest = restBeside(found);
    EXPECT_EQ(rest.share, 1.0f - 0.5f * found.share);
    for (const float radius : {0.05f, 0.1f, 0.2f}) {
        const float height = 1, share = radius * radius / (height * height);
        const occlusion::Ellipsoid sphere{.semiAxes = glm::vec3(radius)};
        const auto seen = flat({&sphere, 1}, rest);
        const float below = covered(seen, rest, {0, -height, 0});
        EXPECT_GT(below, share);
        EXPECT_LT(below, 1.5f * share);
        EXPECT_EQ(covered(seen, rest, {0, 0.1f, 0}), 0) << "above it";
    }
}

// A part behind another part of the same body hides nothing more, and parts that touch leave no gap.
TEST(CastShadow, PartsShadeAsTheirUnion) {
    const CastingLight light = lightAt(90, 10);
    const auto sphere = [](const glm::vec3& centre, float radius) {
        return occlusion::Ellipsoid{centre, glm::mat3(1), glm::vec3(radius)};
    };
    const auto taken = [&](const std::vector<occlusion::Ellipsoid>& body) {
        float area = 0;
        for (const FlatPiece& piece : flat(body, light)) area += 4 * piece.halfAlong_m * piece.halfAside_m;
        return area;
    };
    const float one = taken({sphere({0, 0, 0}, 0.1f)});
    EXPECT_NEAR(one, kPi * 0.01f, 0.03f * one);
    EXPECT_NEAR(taken({sphere({0, 0, 0}, 0.1f), sphere({0, 0.15f, 0}, 0.05f)}), one, 1e-3f * one);
    EXPECT_NEAR(taken({sphere({0, 0, 0}, 0.1f), sphere({0.2f, 0, 0}, 0.1f)}), 2 * one, 0.1f * one);
    EXPECT_NEAR(taken({sphere({0, 0, 0}, 0.1f), sphere({0.2f, 0, 0}, 0.1f), sphere({0, 0, 0.2f}, 0.1f)}),
                3 * one, 0.1f * one);
}

TEST(CastShadow, ALevelPlaneLosesNothingOfItsShare) {
    const CastingLight light = lightAt(66, 12);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(light.shareAt(light.towards.y)[c], light.share[c], 1e-6f);
    EXPECT_EQ(light.shareAt(0), glm::vec3(0));
    EXPECT_GT(light.shareAt(1).x, light.share.x);
}

// The share of a disc before a line is a polynomial: within 0.003 of what it stands for, and without a step.
TEST(CastShadow, TheShareOfADiscIsNearItsIntegral) {
    float before = 0;
    for (int i = -1100; i <= 1100; ++i) {
        const float t = static_cast<float>(i) / 1000, c = std::clamp(t, -1.0f, 1.0f);
        const float exact = 0.5f + (c * std::sqrt(1 - c * c) + std::asin(c)) / kPi;
        EXPECT_NEAR(discBefore(t), exact, 0.003f) << t;
        EXPECT_GE(discBefore(t), before - 1e-6f);
        before = discBefore(t);
    }
    EXPECT_EQ(discBefore(-2), discBefore(-1));
    EXPECT_NEAR(discBefore(-1), 0, 1e-6f);
    EXPECT_NEAR(discBefore(1), 1, 1e-6f);
}

} // namespace
} // namespace shoal::render
