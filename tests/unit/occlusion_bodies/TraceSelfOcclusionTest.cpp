// Self-occlusion of surfaces where it is known in closed form, and how several occluders join.
#include "content/make/models/occlusion/TraceSelfOcclusion.h"

#include "tests/baselines/occlusion/OccludeByEllipsoids.h"
#include <gtest/gtest.h>

#include <cmath>

namespace shoal::occlusion {
namespace {

struct Sheets {
    std::vector<glm::vec3> positions, normals;
    std::vector<uint32_t> indices;

    // A parallelogram of cells by cells, facing cross(right, up).
    void add(const glm::vec3& corner, const glm::vec3& right, const glm::vec3& up, int cells) {
        const auto first = static_cast<uint32_t>(positions.size()), row = static_cast<uint32_t>(cells + 1);
        for (int y = 0; y <= cells; ++y)
            for (int x = 0; x <= cells; ++x) {
                positions.push_back(corner + (right * static_cast<float>(x) + up * static_cast<float>(y)) /
                                                 static_cast<float>(cells));
                normals.push_back(glm::normalize(glm::cross(right, up)));
            }
        for (uint32_t y = 0; y + 1 < row; ++y)
            for (uint32_t x = 0; x + 1 < row; ++x) {
                const uint32_t a = first + y * row + x;
                indices.insert(indices.end(), {a, a + 1, a + row, a + 1, a + row + 1, a + row});
            }
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
// buried and see nothing: what is seen of it must not darken for that. Corners that ask for themselves make
// it 0.69 here.
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
        // The mean over the lower quarter of the sphere, which is half of what a wall sees: (0, -2 / (3 pi),
        // 1 / 3).
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

// At rest, own ellipsoids and the self-occlusion that completes them hide together what self-occlusion alone
// hides.
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
    SmoothLight light;
    light.dominantTowards = glm::normalize(glm::vec3(1, 0.2f, 0));
    light.dominantRadiance = glm::vec3(10);
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
// alike. Six rays leave no speckles there; where each corner kept its own noise, neighbours differed by
// 0.076.
TEST(TraceSelfOcclusion, FewRaysAreSmooth) {
    Sheets bowl;
    constexpr int kRound = 64, kDeep = 32;
    for (int y = 0; y <= kDeep; ++y)
        for (int x = 0; x <= kRound; ++x) {
            const float a = 6.2831853f * static_cast<float>(x % kRound) / kRound,
                        b = 1.5707963f * (static_cast<float>(y) + 0.5f) / (kDeep + 0.5f);
            bowl.positions.emplace_back(std::sin(b) * std::cos(a), -std::cos(b), std::sin(b) * std::sin(a));
            bowl.normals.push_back(-bowl.positions.back());
        }
    for (uint32_t y = 0; y < kDeep; ++y)
        for (uint32_t x = 0; x < kRound; ++x) {
            const uint32_t i = y * (kRound + 1) + x, below = i + kRound + 1;
            bowl.indices.insert(bowl.indices.end(), {i, i + 1, below, i + 1, below + 1, below});
        }
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
    const auto boardOf = [](int cells) {
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

Occluder roundOccluder(const glm::vec3& centre, float radius) {
    return {{centre, glm::mat3(1), glm::vec3(radius)}, 1, {}};
}

TEST(Joining, SideBySideIsNearlyTheSum) {
    const glm::vec3 up(0, 1, 0);
    const Occluder left = roundOccluder({-1.2f, 1, 0}, 1), right = roundOccluder({1.2f, 1, 0}, 1);
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
        many.push_back(roundOccluder(
            {std::cos(angle), 0.6f + 0.05f * static_cast<float>(k % 5), std::sin(angle)}, 0.7f));
        const glm::vec4 hidden = occlusionMoments(axisOcclusion({}, {0, 1, 0}, many), {0, 1, 0});
        EXPECT_LE(hidden.w, 1.0001f);
        EXPECT_LE(glm::length(glm::vec3(hidden)), hidden.w);
    }
    EXPECT_GT(occlusionMoments(axisOcclusion({}, {0, 1, 0}, many), {0, 1, 0}).w, 0.9f);
}

} // namespace
} // namespace shoal::occlusion
