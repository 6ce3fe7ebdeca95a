// The hands' baked shade is of the hands that it stands beside, and what is not is refused.
#include "content/make/models/shade/HandShade.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace shoal::render {
namespace {

using hands::Side;

Path models() { return dataRoot() / "content" / "models"; }

class EachHandShade : public testing::TestWithParam<Side> {
  protected:
    EachHandShade() {
        auto hand = make::loadHand(models(), GetParam());
        auto shade = readShade(models() /
                               (GetParam() == Side::Left ? "hand_left.shade.json" : "hand_right.shade.json"));
        EXPECT_TRUE(hand.ok() && shade.ok());
        if (hand && shade) hand_ = std::move(*hand), shade_ = std::move(*shade);
    }
    make::Hand hand_;
    BakedShade shade_;
};

// Fails when a hand has changed: content/make/models/make_shade bakes it anew.
TEST_P(EachHandShade, IsOfTheHandBesideIt) {
    ASSERT_TRUE(wearShade(shade_, hand_.model));
    const scene::Primitive& skin = hand_.model.meshes.at(0).primitives.at(0);
    EXPECT_EQ(skin.folds.size(), skin.positions.size());
    EXPECT_EQ(skin.foldsBesideOwn.size(), skin.positions.size());
    EXPECT_GE(shade_.parts.size(), 16u);
}

// But for what rounding, another compiler's too, moves across a step or a ray past an edge.
TEST_P(EachHandShade, IsWhatItsMakerMakes) {
    const BakedShade again = make::foldHand(hand_, shade_.parts);
    const auto differing = [](const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) {
        EXPECT_EQ(a.size(), b.size());
        size_t count = 0;
        for (size_t v = 0; v < std::min(a.size(), b.size()); ++v)
            for (int i = 0; i < 4; ++i) count += std::abs(a[v][i] - b[v][i]) > 0.004f;
        return static_cast<double>(count) / static_cast<double>(4 * a.size());
    };
    EXPECT_LT(differing(again.folds, shade_.folds), 0.01);
    EXPECT_LT(differing(again.besideOwn, shade_.besideOwn), 0.01);
    EXPECT_EQ(again.skin, shade_.skin);
}

TEST_P(EachHandShade, OfAnotherModelIsRefusedAndChangesNothing) {
    scene::Model moved = hand_.model;
    moved.meshes[0].primitives[0].positions[7].x += 1e-6f;
    EXPECT_FALSE(wearShade(shade_, moved));
    BakedShade shorter = shade_, elsewhere = shade_;
    shorter.folds.pop_back(), shorter.besideOwn.pop_back();
    EXPECT_FALSE(wearShade(shorter, hand_.model));
    elsewhere.parts[0].joint = static_cast<uint16_t>(hand_.model.nodes.size());
    EXPECT_FALSE(wearShade(elsewhere, hand_.model));
    for (const scene::Model* model : {&moved, &hand_.model}) {
        EXPECT_TRUE(model->meshes[0].primitives[0].folds.empty());
        EXPECT_TRUE(model->meshes[0].primitives[0].foldsBesideOwn.empty());
    }
}

INSTANTIATE_TEST_SUITE_P(Both, EachHandShade, testing::Values(Side::Left, Side::Right),
                         [](const auto& side) { return side.param == Side::Left ? "left" : "right"; });

TEST(HandShade, OfOneHandMirrorsTheOthers) {
    const auto left = readShade(models() / "hand_left.shade.json"),
               right = readShade(models() / "hand_right.shade.json");
    ASSERT_TRUE(left.ok() && right.ok());
    const auto mirrored = make::mirrored(right->parts);
    ASSERT_EQ(left->parts.size(), mirrored.size());
    for (size_t k = 0; k < mirrored.size(); ++k) {
        const occlusion::Ellipsoid &a = left->parts[k].atRest, &b = mirrored[k].atRest;
        EXPECT_EQ(left->parts[k].joint, mirrored[k].joint);
        EXPECT_LT(glm::distance(a.centre, b.centre), 1e-6f);
        EXPECT_LT(glm::distance(a.semiAxes, b.semiAxes), 1e-6f);
        EXPECT_GT(glm::determinant(b.worldFromAxes), 0.999f);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_GT(glm::dot(a.worldFromAxes[axis], b.worldFromAxes[axis]), 0.99999f);
    }
}

TEST(BakedShade, IsReadAsItWasWritten) {
    BakedShade shade;
    shade.skin = 0x0123456789abcdef;
    const glm::mat3 turned(glm::vec3(0, 1, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 0, 1));
    shade.parts = {{{{0.01f, -0.02f, 0.03f}, turned, {0.01f, 0.02f, 0.04f}}, 5}};
    shade.folds = {{0, 0.5f, -0.252f, 1}, {-1, 0, 0, 0.004f}};
    shade.besideOwn = {{0.1f, 0, 0, -0.1f}, {0, 0, 0, 0}};
    const auto read = parseShade(written(shade));
    ASSERT_TRUE(read.ok()) << read.error().reason;
    EXPECT_EQ(read->skin, shade.skin);
    ASSERT_EQ(read->parts.size(), 1u);
    EXPECT_EQ(read->parts[0].joint, 5);
    EXPECT_LT(glm::distance(read->parts[0].atRest.centre, shade.parts[0].atRest.centre), 1e-6f);
    EXPECT_LT(glm::distance(read->parts[0].atRest.semiAxes, shade.parts[0].atRest.semiAxes), 1e-6f);
    for (int k = 0; k < 3; ++k)
        EXPECT_LT(glm::distance(read->parts[0].atRest.worldFromAxes[k], turned[k]), 1e-6f);
    ASSERT_EQ(read->folds.size(), 2u);
    ASSERT_EQ(read->besideOwn.size(), 2u);
    for (size_t v = 0; v < 2; ++v) {
        EXPECT_LT(glm::distance(read->folds[v], shade.folds[v]), 1e-6f);
        EXPECT_LT(glm::distance(read->besideOwn[v], shade.besideOwn[v]), 1e-6f);
    }
}

TEST(BakedShade, ThatIsNoneIsRefused) {
    const std::string skin = R"({"skin": "0123456789abcdef", )", none = R"("ellipsoids": [], )",
                      folds = R"("folds": [0, 0, 0, 9], "foldsBesideOwn": [0, 0, 0, -9])";
    ASSERT_TRUE(parseShade(skin + none + folds + "}").ok());
    const auto ellipsoid = [](const char* node, const char* centre, const char* turn, const char* semi) {
        return std::string(R"("ellipsoids": [{"node": )") + node + R"(, "centre": )" + centre +
               R"(, "turn": )" + turn + R"(, "semiAxes": )" + semi + "}], ";
    };
    ASSERT_TRUE(
        parseShade(skin + ellipsoid("3", "[0, 0, 0]", "[0, 0, 0, 1]", "[1, 1, 1]") + folds + "}").ok());
    std::string many = R"("ellipsoids": [0)";
    for (int k = 0; k < 99; ++k) many += ", 0";
    for (const std::string& text : {
             std::string(),
             std::string("[]"),
             none + folds,
             skin + folds + "}",
             skin + none + "}",
             R"({"skin": "12", )" + none + folds + "}",
             R"({"skin": 12, )" + none + folds + "}",
             skin + many + "], " + folds + "}",
             skin + ellipsoid("-1", "[0, 0, 0]", "[0, 0, 0, 1]", "[1, 1, 1]") + folds + "}",
             skin + ellipsoid("70000", "[0, 0, 0]", "[0, 0, 0, 1]", "[1, 1, 1]") + folds + "}",
             skin + ellipsoid("3", "[0, 0]", "[0, 0, 0, 1]", "[1, 1, 1]") + folds + "}",
             skin + ellipsoid("3", "[0, 0, 1e39]", "[0, 0, 0, 1]", "[1, 1, 1]") + folds + "}",
             skin + ellipsoid("3", "[0, 0, 0]", "[0, 0, 0, 0]", "[1, 1, 1]") + folds + "}",
             skin + ellipsoid("3", "[0, 0, 0]", "[0, 0, 0, 1]", "[1, 0, 1]") + folds + "}",
             skin + ellipsoid("3", "[0, 0, 0]", "[0, 0, 0, 1]", "[1, null, 1]") + folds + "}",
             skin + none + R"("folds": [0, 0, 0], "foldsBesideOwn": [0, 0, 0]})",
             skin + none + R"("folds": [0, 0, 0, 2001], "foldsBesideOwn": [0, 0, 0, 0]})",
             skin + none + R"("folds": [0, 0, 0, 0.5], "foldsBesideOwn": [0, 0, 0, 0]})",
             skin + none + R"("folds": [0, 0, 0, 18446744073709551615], "foldsBesideOwn": [0, 0, 0, 0]})",
             skin + none + R"("folds": [0, 0, 0, 0], "foldsBesideOwn": []})",
         })
        EXPECT_FALSE(parseShade(text).ok()) << text;
    EXPECT_FALSE(readShade(models() / "none.shade.json").ok());
}

} // namespace
} // namespace shoal::render
