// Occlusion by ellipsoids where it is known in closed form.
#include "content/make/models/occlusion/Bvh.h"
#include "content/make/models/occlusion/FitEllipsoids.h"
#include "content/make/models/occlusion/TraceSelfOcclusion.h"
#include "engine/occlusion/SmoothLight.h"
#include "tests/Cells.h"
#include "tests/Test.h"
#include "tests/baselines/occlusion/OccludeByEllipsoids.h"
#include "tests/unit/light/Environments.h"

namespace shoal::occlusion {
namespace {

using tests::addCells;

const glm::vec3 kSlants[] = {{0, 1, 0}, {0.6f, 0.8f, 0}, {0.3f, -0.5f, 0.81f}, {-0.7f, 0.1f, -0.7f}};

Occluder sphereAt(const glm::vec3& centre, float radius) {
    return {{centre, glm::mat3(1), glm::vec3(radius)}, 1, {}};
}

float shareOf(const glm::vec3& normal, std::span<const Occluder> occluders) {
    return occlusionMoments(axisOcclusion({}, normal, occluders), normal).w;
}

// Tests the largest angle between a direction and the nearest end, and how evenly cosines add up.
TEST(Axes, AreSpreadEvenly) {
    for (int i = 0; i < 500; ++i) {
        const auto k = static_cast<float>(i);
        const glm::vec3 d =
            glm::normalize(glm::vec3(std::sin(k), std::cos(1.7f * k), std::sin(2.3f * k + 1)));
        float nearest = 0, sum = 0;
        for (const glm::vec3& axis : kAxes) {
            nearest = std::max(nearest, std::abs(glm::dot(axis, d)));
            sum += std::abs(glm::dot(axis, d)) * 2 / kAxisCount;
        }
        EXPECT_GT(nearest, 0.93f) << i;
        EXPECT_NEAR(sum, 1, 0.025f) << i;
    }
}

// Straight ahead a sphere takes sin^2 of its half angle. Few axes see it now larger, now smaller: within a
// twentieth of the hemisphere each, and less on the mean.
TEST(Ellipsoid, ASphereAheadTakesTheSquareOfItsSine) {
    for (const float sine : {0.3f, 0.5f, 0.7f, 0.9f}) {
        float mean = 0;
        for (const glm::vec3& normal : kSlants) {
            const glm::vec3 n = glm::normalize(normal);
            const Occluder sphere = sphereAt(n, sine);
            const float share = shareOf(n, {&sphere, 1});
            EXPECT_NEAR(share, sine * sine, 0.05f) << sine;
            mean += share / 4;
        }
        EXPECT_NEAR(mean, sine * sine, 0.04f) << sine;
    }
}

// From its skin it is a half space: facing it all is taken, looking away hardly anything, along it half.
TEST(Ellipsoid, IsAHalfSpaceFromItsSkinAndWithin) {
    const glm::mat3 turn = glm::mat3_cast(glm::normalize(glm::quat(0.6f, 0.3f, -0.5f, 0.2f)));
    for (const float depth : {0.0f, 0.01f, 0.1f}) {
        const Occluder body = {{turn * glm::vec3(-0.2f + depth, 0, 0), turn, {0.2f, 0.3f, 0.5f}}, 1, {}};
        EXPECT_GT(shareOf(turn * glm::vec3(-1, 0, 0), {&body, 1}), 0.96f);
        EXPECT_LT(shareOf(turn * glm::vec3(1, 0, 0), {&body, 1}), 0.04f);
        EXPECT_NEAR(shareOf(turn * glm::vec3(0, 1, 0), {&body, 1}), 0.5f, 0.06f);
    }
    const Occluder around = {{{}, glm::mat3(1), glm::vec3(1)}, 1, {}}; // from its very middle
    EXPECT_TRUE(std::isfinite(shareOf({0, 1, 0}, {&around, 1})));
}

TEST(Ellipsoid, NoSizeFarAwayOrBehindTakesNothing) {
    const Occluder none[] = {sphereAt({0, 1, 0}, 1e-4f),
                             sphereAt({0, 300, 0}, 0.1f),
                             sphereAt({0, -2, 0}, 1),
                             {{{0, 1, 0}, glm::mat3(1), glm::vec3(0.5f)}, 0, {}}};
    for (const Occluder& each : none) EXPECT_LT(shareOf({0, 1, 0}, {&each, 1}), 1e-3f);
}

// Scene and surface turned together: the axes do not turn with them.
TEST(Ellipsoid, TakesMuchTheSameWhicheverWayTheSceneIsTurned) {
    float minimum = 1, maximum = 0;
    for (int i = 0; i < 40; ++i) {
        const auto k = static_cast<float>(i);
        const glm::mat3 turn = glm::mat3_cast(
            glm::normalize(glm::quat(std::sin(k), std::cos(2 * k), std::sin(3 * k), std::cos(5 * k))));
        const Occluder body = {{turn * glm::vec3(0.3f, 0.6f, -0.2f), turn, {0.15f, 0.4f, 0.6f}}, 1, {}};
        const float share = shareOf(turn * glm::vec3(0, 1, 0), {&body, 1});
        minimum = std::min(minimum, share), maximum = std::max(maximum, share);
    }
    EXPECT_LT(maximum - minimum, 0.06f);
    EXPECT_GT(minimum, 0.15f);
}

TEST(Take, NothingTakesExactlyNothing) {
    SmoothLight light;
    light.ahead.fill({1, 2, 3});
    light.behind.fill({3, 2, 1});
    light.dominantRadiance = glm::vec3(50);
    const OcclusionResult taken = occlude({}, {0, 1, 0}, {}, {}, {}, light);
    EXPECT_EQ(taken.share, 0);
    EXPECT_EQ(taken.radiance, glm::vec3(0));
}

// In a white furnace, bodies reflect as much light as they take.
TEST(Take, WhiteBodiesInEvenLightTakeLittle) {
    SmoothLight light;
    light.ahead.fill(glm::vec3(1));
    light.behind.fill(glm::vec3(1));
    light.even[0] = glm::vec3(1);
    Occluder black = sphereAt({0, 1.5f, 0}, 0.6f), white = black;
    white.albedo = glm::vec3(1);
    const OcclusionResult dark = occlude({}, {0, 1, 0}, {}, {}, {&black, 1}, light),
                          lit = occlude({}, {0, 1, 0}, {}, {}, {&white, 1}, light);
    EXPECT_NEAR(dark.radiance.x, dark.share, 0.03f * dark.share);
    EXPECT_NEAR(lit.radiance.x, dark.share * dark.share, 0.03f * dark.share); // white in each other's shade
}

// A dominant light is fully hidden behind a sphere, fully visible beside it, and fades in between.
TEST(Take, ADominantLightRunsFromAllToNoneAcrossTheEdge) {
    SmoothLight light{.dominantShare = 0.02f, .dominantRadiance = glm::vec3(50)};
    float before = 2;
    for (float angle = 0; angle < 0.8f; angle += 0.02f) {
        light.dominantTowards = {std::sin(angle), std::cos(angle), 0};
        const Occluder sphere = sphereAt({0, 2, 0}, 0.8f); // half angle 0.41
        const float hidden = occlude({}, {0, 1, 0}, {}, {}, {&sphere, 1}, light).radiance.x / std::cos(angle);
        EXPECT_LE(hidden, before + 0.02f) << angle;
        if (angle < 0.2f) {
            EXPECT_NEAR(hidden, 1, 0.02f) << angle;
        }
        if (std::abs(angle - 0.41f) < 0.011f) {
            EXPECT_NEAR(hidden, 0.5f, 0.12f);
        }
        if (angle > 0.66f) {
            EXPECT_NEAR(hidden, 0, 0.01f) << angle;
        }
        before = hidden;
    }
}

// A body's skin is now outside, now within its own ellipsoids.
TEST(OpenLobe, IsWholeWhereItLooksOutOfASkin) {
    const Occluder body = {{{}, glm::mat3(1), {0.2f, 0.3f, 0.5f}}, 1, {}};
    for (const float depth : {-0.02f, 0.0f, 0.02f}) {
        EXPECT_EQ(lobeVisibility({0.2f - depth, 0, 0}, {1, 0, 0}, 0.4f, {&body, 1}), 1) << depth;
        EXPECT_LT(lobeVisibility({0.2f - depth, 0, 0}, {-1, 0, 0}, 0.4f, {&body, 1}), 0.01f) << depth;
    }
}

struct Sheets {
    std::vector<glm::vec3> positions, normals;
    std::vector<uint32_t> indices;

    // A parallelogram of cells by cells, facing cross(right, up).
    void add(const glm::vec3& corner, const glm::vec3& right, const glm::vec3& up, uint32_t cells) {
        addCells(positions, indices, cells, cells,
                 [&](float u, float v) { return corner + u * right + v * up; });
        normals.resize(positions.size(), glm::normalize(glm::cross(right, up)));
    }
    SelfOccludingMesh body() const { return {positions, normals, indices}; }
};

// Returns the occlusion of a surface by itself and, before that, by others.
glm::vec4 withSelfOcclusion(const glm::vec4& selfOcclusion, const glm::vec3& normal,
                            AxisOcclusion hidden = {}) {
    for (size_t k = 0; k < kAxisCount; ++k) {
        const float along = glm::dot(glm::vec3(selfOcclusion), kAxes[k]);
        const float side = glm::dot(normal, kAxes[k]) < 0 ? -1.0f : 1.0f;
        hidden[k] = glm::clamp(hidden[k] + selfOcclusion.w + side * along, 0.0f, 1.0f);
    }
    return occlusionMoments(hidden, normal);
}

// Ground as wide as the horizon hides half of what a wall sees, wherever on it. The wall's lowest corners are
// buried and see nothing: what is seen must not darken for that; asking for corners makes it 0.69.
TEST(TraceSelfOcclusion, ABuriedRootLeavesWhatIsSeenAsItIs) {
    Sheets sheets;
    sheets.add({-0.5f, -0.4f, 0}, {1, 0, 0}, {0, 1.5f, 0}, 2); // the wall, facing +z
    sheets.add({-40, 0, 40}, {80, 0, 0}, {0, 0, -80}, 2);      // the ground, facing up
    sheets.add({-40, -0.5f, -40}, {80, 0, 0}, {0, 0, 80}, 1);  // and what is below it
    const auto selfOcclusion = traceSelfOcclusion(sheets.body(), 256);
    for (const float height : {0.1f, 0.2f, 0.3f}) {
        const glm::vec4 hidden =
            withSelfOcclusion(glm::mix(selfOcclusion[1], selfOcclusion[4], (height + 0.4f) / 0.75f),
                              {0, 0, 1}); // in the middle
        EXPECT_NEAR(hidden.w, 0.5f, 0.1f) << height;
        // The mean over the sphere's lower quarter, half of what a wall sees: (0, -2 / (3 pi), 1 / 3).
        EXPECT_NEAR(hidden.y, -0.2122f, 0.06f) << height;
        EXPECT_NEAR(hidden.z, 0.3333f, 0.07f) << height;
    }
}

// Corners do not darken if all samples between them lie behind a label.
TEST(TraceSelfOcclusion, ALabelLeavesTheCornersOfItsWallAsTheyAre) {
    Sheets sheets;
    sheets.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1);
    sheets.add({0.1f, 0.1f, 0.001f}, {0.8f, 0, 0}, {0, 0.8f, 0}, 1);
    const auto selfOcclusion = traceSelfOcclusion(sheets.body(), 64);
    for (size_t corner = 0; corner < 4; ++corner)
        EXPECT_LT(withSelfOcclusion(selfOcclusion[corner], sheets.normals[corner]).w, 0.15f) << corner;
}

// At rest, own ellipsoids and what completes them hide together what self-occlusion alone hides.
TEST(TraceSelfOcclusion, CompleteTheBodysOwnEllipsoids) {
    Sheets sheets;
    sheets.add({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, 12);   // a floor, facing up
    sheets.add({-1, 0, -0.4f}, {2, 0, 0}, {0, 1, 0}, 6); // a wall on it, facing +z
    const std::vector<Occluder> own = {{{{0, 0.5f, -0.5f}, glm::mat3(1), {1, 0.5f, 0.1f}}, 1, {}}};
    const auto alone = traceSelfOcclusion(sheets.body(), 64);
    auto rest = alone;
    completeOwn(sheets.body(), own, rest);
    int compared = 0;
    for (size_t v = 0; v < 13 * 13; ++v) {
        const glm::vec3& p = sheets.positions[v];
        if (p.z < 0.1f || std::abs(p.x) > 0.9f) continue;
        const glm::vec3& n = sheets.normals[v];
        const glm::vec4 both = withSelfOcclusion(rest[v], n, axisOcclusion(p, n, own)),
                        right = withSelfOcclusion(alone[v], n);
        EXPECT_NEAR(both.w, right.w, 0.03f) << p.x << ' ' << p.z;
        EXPECT_LT(glm::distance(glm::vec3(both), glm::vec3(right)), 0.05f) << p.x << ' ' << p.z;
        ++compared;
    }
    EXPECT_GT(compared, 40);
}

// An ellipsoid that stands out of the skin that it stands for hides less of a dominant light from it than by
// itself: self-occlusion that say nothing of how high a direction is do not give all of it back.
TEST(TraceSelfOcclusion, GiveBackSomeOfTheDominantLightThatOwnEllipsoidsHide) {
    Sheets skin;
    skin.add({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, 16);
    const std::vector<Occluder> own = {{{{0.5f, -0.2f, 0}, glm::mat3(1), {0.5f, 0.4f, 0.5f}}, 1, {}}};
    auto selfOcclusion = traceSelfOcclusion(skin.body(), 8);
    completeOwn(skin.body(), own, selfOcclusion);
    const SmoothLight light{.dominantTowards = glm::normalize(glm::vec3(1, 0.2f, 0)),
                            .dominantRadiance = glm::vec3(10)};
    const size_t before = 4 * 17 + 8; // it, as seen from the dominant light: x = -0.5, z = 0
    for (const size_t v : {before, before + 2 * 17, before + 3 * 17}) {
        const glm::vec3 p = skin.positions[v];
        const float alone = occlude(p, {0, 1, 0}, own, {}, {}, light).radiance.x,
                    whole = occlude(p, {0, 1, 0}, own, {selfOcclusion[v], {}}, {}, light).radiance.x;
        EXPECT_GT(alone, 0.02f) << p.x;
        EXPECT_LE(whole, 0.4f * alone) << p.x;
    }
}

// Half a hollow sphere hides half of what each place in it sees, for all of a sphere's inside sees all of it
// alike. Six rays leave no speckles; where each corner kept its own noise, neighbours differed by 0.076.
TEST(TraceSelfOcclusion, FewRaysAreSmooth) {
    Sheets bowl;
    constexpr int kRound = 64, kDeep = 32;
    addCells(bowl.positions, bowl.indices, kRound, kDeep, [](float u, float v) {
        const float a = 6.2831853f * std::fmod(u, 1.0f), b = 1.5707963f * (v * kDeep + 0.5f) / (kDeep + 0.5f);
        return glm::vec3(std::sin(b) * std::cos(a), -std::cos(b), std::sin(b) * std::sin(a));
    });
    for (const glm::vec3& p : bowl.positions) bowl.normals.push_back(-p);
    const auto selfOcclusion = traceSelfOcclusion(bowl.body(), 6);
    const auto hiddenAt = [&](size_t i) {
        return static_cast<double>(withSelfOcclusion(selfOcclusion[i], bowl.normals[i]).w);
    };
    double apart = 0, off = 0;
    int count = 0;
    for (int y = 2; y < kDeep - 1; ++y)
        for (int x = 1; x < kRound; ++x, ++count) {
            const size_t i = static_cast<size_t>(y * (kRound + 1) + x);
            apart += std::pow(hiddenAt(i) - hiddenAt(i - 1), 2);
            off += hiddenAt(i) - 0.5;
        }
    EXPECT_LE(std::sqrt(apart / count), 0.01);
    EXPECT_NEAR(off / count, 0, 0.01);
}

TEST(TraceSelfOcclusion, NothingHasNone) {
    EXPECT_TRUE(traceSelfOcclusion({}, 8).empty());
    const std::vector<glm::vec3> point(3, glm::vec3(1)), up(3, glm::vec3(0, 1, 0));
    const std::vector<uint32_t> indices = {0, 1, 2};
    for (const glm::vec4& selfOcclusion : traceSelfOcclusion({point, up, indices}, 8))
        EXPECT_EQ(selfOcclusion, glm::vec4(0));
    Sheets flat; // sees no part of itself
    flat.add({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 3);
    for (const glm::vec4& selfOcclusion : traceSelfOcclusion(flat.body(), 8))
        EXPECT_EQ(selfOcclusion, glm::vec4(0));
}

// A tile hangs before a board: its shade on the board ends one edge of the tile away. Two triangles cannot
// represent that and would be dark from corner to corner; small ones are dark behind the tile alone.
TEST(TraceSelfOcclusion, DetailThatCornersCannotCarryIsLeftOut) {
    const auto boardOf = [](uint32_t cells) {
        Sheets sheets;
        sheets.add({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, cells);              // the board, facing +z
        sheets.add({0.55f, 0.55f, 0.05f}, {0.3f, 0, 0}, {0, 0.3f, 0}, 1);  // the tile
        sheets.add({0.85f, 0.55f, 0.05f}, {-0.3f, 0, 0}, {0, 0.3f, 0}, 1); // and its back
        return traceSelfOcclusion(sheets.body(), 256);
    };
    const auto coarse = boardOf(1);
    for (size_t corner = 0; corner < 4; ++corner) EXPECT_EQ(coarse[corner], glm::vec4(0));
    constexpr int kCells = 40;
    const auto board = boardOf(kCells);
    const auto hiddenAt = [&](float x, float y) {
        const auto column = static_cast<size_t>(std::lround((x + 1) * kCells / 2)),
                   row = static_cast<size_t>(std::lround((y + 1) * kCells / 2));
        return withSelfOcclusion(board[row * (kCells + 1) + column], {0, 0, 1}).w;
    };
    EXPECT_GT(hiddenAt(0.7f, 0.7f), 0.8f);
    EXPECT_LT(hiddenAt(-0.5f, -0.5f), 0.01f);
    EXPECT_LT(hiddenAt(0, 0), 0.05f);
}

TEST(Joining, SideBySideIsNearlyTheSum) {
    const glm::vec3 up(0, 1, 0);
    const Occluder left = sphereAt({-1.2f, 1, 0}, 1), right = sphereAt({1.2f, 1, 0}, 1);
    const float one = occlusionMoments(axisOcclusion({}, up, {&left, 1}), up).w;
    const Occluder both[] = {left, right};
    const glm::vec4 hidden = occlusionMoments(axisOcclusion({}, up, both), up);
    const float joint = hidden.w, product = 1 - (1 - one) * (1 - one);
    EXPECT_GT(one, 0.2f);
    EXPECT_GT(joint, 0.5f * (product + 2 * one));
    EXPECT_LE(joint, 2 * one + 1e-6f);
    EXPECT_NEAR(hidden.x, 0, 0.05f * one);
}

TEST(Joining, ManyNeverTakeMoreThanAll) {
    std::vector<Occluder> many;
    for (int k = 0; k < 24; ++k) {
        const float angle = 0.8f * static_cast<float>(k);
        many.push_back(
            sphereAt({std::cos(angle), 0.6f + 0.05f * static_cast<float>(k % 5), std::sin(angle)}, 0.7f));
        const glm::vec4 hidden = occlusionMoments(axisOcclusion({}, {0, 1, 0}, many), {0, 1, 0});
        EXPECT_LE(hidden.w, 1.0001f);
        EXPECT_LE(glm::length(glm::vec3(hidden)), hidden.w);
    }
    EXPECT_GT(occlusionMoments(axisOcclusion({}, {0, 1, 0}, many), {0, 1, 0}).w, 0.9f);
}

struct Skin {
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> indices;
    std::vector<uint16_t> joints;
    RestBody body() const { return {positions, indices, joints}; }
};

void addEllipsoid(Skin& skin, const glm::vec3& centre, const glm::vec3& semiAxes, uint16_t joint) {
    addCells(skin.positions, skin.indices, 48, 24,
             [&](float u, float v) { return centre + semiAxes * directionFromLatLong(glm::vec2(1 - u, v)); });
    skin.joints.resize(skin.positions.size(), joint);
}

TEST(FitEllipsoids, GivesBackAnEllipsoid) {
    Skin skin;
    addEllipsoid(skin, {0.1f, -0.2f, 0.3f}, {0.2f, 0.1f, 0.4f}, 3);
    const auto parts = fitEllipsoids(skin.body(), Parts::ByShape, 1);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].joint, 3);
    EXPECT_LT(glm::distance(parts[0].atRest.centre, glm::vec3(0.1f, -0.2f, 0.3f)), 0.004f);
    // A fortieth of the length is a sample's size.
    const glm::vec3& semi = parts[0].atRest.semiAxes;
    EXPECT_THAT((std::vector{semi.x, semi.y, semi.z}),
                testing::UnorderedElementsAre(testing::FloatNear(0.1f, 0.006f),
                                              testing::FloatNear(0.2f, 0.006f),
                                              testing::FloatNear(0.4f, 0.01f)));
}

TEST(FitEllipsoids, GivesEachJointItsOwn) {
    Skin skin;
    addEllipsoid(skin, {0, 0, 0}, glm::vec3(0.1f), 5);
    addEllipsoid(skin, {0, 0, 0.3f}, glm::vec3(0.05f, 0.05f, 0.2f), 7);
    for (const Parts by : {Parts::ByJoint, Parts::ByShape}) {
        const auto parts = fitEllipsoids(skin.body(), by, 2);
        ASSERT_EQ(parts.size(), 2u);
        EXPECT_NE(parts[0].joint, parts[1].joint);
        for (const BodyPart& part : parts)
            EXPECT_NEAR(part.atRest.centre.z, part.joint == 5 ? 0.0f : 0.3f, 0.03f);
    }
}

TEST(FitEllipsoids, MakesNothingOfNothing) {
    EXPECT_TRUE(fitEllipsoids({}, Parts::ByShape, 4).empty());
    const std::vector<glm::vec3> point(3, glm::vec3(1));
    const std::vector<uint32_t> indices = {0, 1, 2};
    const std::vector<uint16_t> joints(3, 0);
    EXPECT_TRUE(fitEllipsoids({point, indices, joints}, Parts::ByShape, 4).empty());
    // One triangle has no inside.
    const std::vector<glm::vec3> one = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (const BodyPart& part : fitEllipsoids({one, indices, joints}, Parts::ByShape, 4))
        EXPECT_TRUE(std::isfinite(glm::dot(part.atRest.semiAxes, glm::vec3(1))));
}

TEST(Bvh, MeetsWhatEveryTriangleTriedInTurnMeets) {
    Skin skin;
    addEllipsoid(skin, {0, 0, 0}, {0.3f, 0.2f, 0.5f}, 0);
    addEllipsoid(skin, {0.4f, 0, 0}, {0.1f, 0.3f, 0.1f}, 0);
    const Bvh bvh(skin.positions, skin.indices);
    int met = 0;
    for (int i = 0; i < 500; ++i) {
        const auto k = static_cast<float>(i);
        const glm::vec3 origin(std::sin(k), std::cos(1.7f * k), 1.5f * std::sin(2.3f * k));
        const glm::vec3 direction = glm::normalize(glm::vec3(0.2f * std::sin(5 * k), 0.1f, 0.1f) - origin);
        const auto touch = bvh.first(origin, direction, 0, INFINITY);
        EXPECT_EQ(touch.has_value(), bvh.blocked(origin, direction, 0, INFINITY));
        met += touch.has_value();
        if (i % 50 != 0) continue;
        float nearest = INFINITY;
        for (size_t t = 0; t < skin.indices.size(); t += 3) {
            const Bvh alone(skin.positions, std::span(skin.indices).subspan(t, 3));
            if (const auto one = alone.first(origin, direction, 0, INFINITY))
                nearest = std::min(nearest, one->distance);
        }
        EXPECT_EQ(touch ? touch->distance : INFINITY, nearest);
    }
    EXPECT_GT(met, 100);
    EXPECT_FALSE(Bvh({}, {}).first({}, {0, 0, 1}, 0, 1));
}

TEST(SmoothLight, FindsTheDominantLightAndKeepsTheMean) {
    const glm::vec3 dominant = glm::normalize(glm::vec3(0.3f, 0.8f, -0.4f));
    const ImageRgbF map = light::paint(64, 32, [&](const glm::dvec3& d) {
        return glm::dvec3(glm::dot(glm::vec3(d), dominant) > 0.95f ? 20 : 1);
    });
    const double mean = light::meanOf(map).x;
    const SmoothLight light = smoothLight(map);
    EXPECT_GT(glm::dot(light.dominantTowards, dominant), 0.999f);
    EXPECT_NEAR(light.dominantShare, 1 - 0.95f * 0.95f, 0.02f);
    const double dominantMean =
        static_cast<double>(light.dominantRadiance.x * (1 - std::sqrt(1 - light.dominantShare)) / 2);
    double around = 0;
    for (size_t k = 0; k < kAxisCount; ++k)
        around += static_cast<double>(light.ahead[k].x + light.behind[k].x) / (2 * kAxisCount);
    EXPECT_NEAR(around + dominantMean, mean, 0.01 * mean); // ends have not quite the same share of the sphere
    EXPECT_NEAR(static_cast<double>(light.even[0].x), mean, 1e-4 * mean);
}

TEST(SmoothLight, EvenLightHasNoDominantLight) {
    const SmoothLight light = smoothLight(light::uniform(64, glm::dvec3(2)));
    for (size_t k = 0; k < kAxisCount; ++k) {
        EXPECT_NEAR(light.ahead[k].y, 2, 1e-4f);
        EXPECT_NEAR(light.behind[k].y, 2, 1e-4f);
    }
    EXPECT_NEAR(light.even[0].y, 2, 1e-4f);
    EXPECT_NEAR(light.even[2].y, 0, 1e-4f);
    EXPECT_EQ(light.dominantRadiance.y, 0);
}

} // namespace
} // namespace shoal::occlusion
