// Stored occlusion belongs to the model beside it; that of another model is refused.
#include "content/make/models/occlusion/HandOcclusion.h"
#include "engine/scene/Model.h"
#include "tests/Test.h"

namespace shoal::render {
namespace {

using hands::Side;

Path models() { return dataRoot() / "content" / "models"; }

class EachHandOcclusion : public testing::TestWithParam<Side> {
  protected:
    EachHandOcclusion() {
        auto hand = make::loadHand(models(), GetParam());
        auto baked = readBakedOcclusion(
            models() / (GetParam() == Side::Left ? "hand_left.occlusion.json" : "hand_right.occlusion.json"));
        EXPECT_TRUE(hand.ok() && baked.ok());
        if (hand && baked) hand_ = std::move(*hand), shade_ = std::move(*baked);
    }
    make::Hand hand_;
    BakedOcclusion shade_;
};

// Fails when a hand has changed: content/make/models/make_occlusion bakes it anew.
TEST_P(EachHandOcclusion, IsOfTheHandBesideIt) {
    ASSERT_TRUE(applyBakedOcclusion(shade_, hand_.model));
    const scene::Primitive& skin = hand_.model.meshes.at(0).primitives.at(0);
    EXPECT_EQ(skin.selfOcclusion.size(), skin.positions.size());
    EXPECT_EQ(skin.selfOcclusionBesideOwn.size(), skin.positions.size());
    EXPECT_GE(shade_.parts.size(), 16u);
}

// Returns the share of values that differ by more than a step. Rounding, also by another compiler, moves few
// values across a step and few rays past an edge.
double differing(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) {
    EXPECT_EQ(a.size(), b.size());
    size_t count = 0;
    for (size_t v = 0; v < std::min(a.size(), b.size()); ++v)
        for (int i = 0; i < 4; ++i) count += std::abs(a[v][i] - b[v][i]) > 0.004f;
    return static_cast<double>(count) / static_cast<double>(4 * a.size());
}

TEST_P(EachHandOcclusion, IsWhatItsMakerMakes) {
    const BakedOcclusion again = make::selfOccludeHand(hand_, shade_.parts);
    EXPECT_LT(differing(again.selfOcclusion, shade_.selfOcclusion), 0.01);
    EXPECT_LT(differing(again.besideOwn, shade_.besideOwn), 0.01);
    EXPECT_EQ(again.skin, shade_.skin);
}

TEST_P(EachHandOcclusion, AFileOfAnotherModelIsRefusedAndChangesNothing) {
    scene::Model moved = hand_.model;
    moved.meshes[0].primitives[0].positions[7].x += 1e-6f;
    EXPECT_FALSE(applyBakedOcclusion(shade_, moved));
    BakedOcclusion shorter = shade_, elsewhere = shade_;
    shorter.selfOcclusion.pop_back(), shorter.besideOwn.pop_back();
    EXPECT_FALSE(applyBakedOcclusion(shorter, hand_.model));
    elsewhere.parts[0].joint = static_cast<uint16_t>(hand_.model.nodes.size());
    EXPECT_FALSE(applyBakedOcclusion(elsewhere, hand_.model));
    for (const scene::Model* model : {&moved, &hand_.model}) {
        EXPECT_TRUE(model->meshes[0].primitives[0].selfOcclusion.empty());
        EXPECT_TRUE(model->meshes[0].primitives[0].selfOcclusionBesideOwn.empty());
    }
}

INSTANTIATE_TEST_SUITE_P(Both, EachHandOcclusion, testing::Values(Side::Left, Side::Right),
                         [](const auto& side) { return side.param == Side::Left ? "left" : "right"; });

// Every creature is compared, up to rounding, another compiler's too.
TEST(CreatureOcclusion, IsOfTheModelBesideItAndWhatItsMakerMakes) {
    int compared = 0;
    for (const auto& entry : std::filesystem::directory_iterator(models())) {
        const Path& file = entry.path();
        if (file.extension() != ".glb" || file.stem().string().starts_with("hand_")) continue;
        auto model = scene::loadModel(file);
        const auto baked = readBakedOcclusion(bakedOcclusionBeside(file)), again = make::fitCreature(file);
        ASSERT_TRUE(model.ok() && baked.ok() && again.ok()) << file;
        EXPECT_TRUE(applyBakedOcclusion(*baked, *model)) << file;
        EXPECT_LT(differing(again->selfOcclusion, baked->selfOcclusion), 0.01) << file;
        ASSERT_EQ(baked->parts.size(), again->parts.size()) << file;
        for (size_t k = 0; k < baked->parts.size(); ++k, ++compared) {
            const occlusion::Ellipsoid &a = baked->parts[k].atRest, &b = again->parts[k].atRest;
            EXPECT_EQ(baked->parts[k].joint, again->parts[k].joint) << file;
            EXPECT_LT(glm::distance(a.centre, b.centre), 1e-4f) << file;
            EXPECT_LT(glm::distance(a.semiAxes, b.semiAxes), 1e-4f) << file;
        }
    }
    EXPECT_GE(compared, 8 * 4);
}

TEST(HandOcclusion, OneHandMirrorsTheOther) {
    const auto left = readBakedOcclusion(models() / "hand_left.occlusion.json"),
               right = readBakedOcclusion(models() / "hand_right.occlusion.json");
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

TEST(BakedOcclusion, IsReadAsItWasWritten) {
    const glm::mat3 turned(glm::vec3(0, 1, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 0, 1));
    const BakedOcclusion baked{
        .skin = 0x0123456789abcdef,
        .parts = {{{{0.01f, -0.02f, 0.03f}, turned, {0.01f, 0.02f, 0.04f}}, 5}},
        .selfOcclusion = {{0, 0.5f, -0.252f, 1}, {-1, 0, 0, 0.004f}},
        .besideOwn = {{0.1f, 0, 0, -0.1f}, {0, 0, 0, 0}},
    };
    const auto read = parseBakedOcclusion(make::written(baked));
    ASSERT_TRUE(read.ok()) << read.error().reason;
    EXPECT_EQ(read->skin, baked.skin);
    ASSERT_EQ(read->parts.size(), 1u);
    EXPECT_EQ(read->parts[0].joint, 5);
    EXPECT_LT(glm::distance(read->parts[0].atRest.centre, baked.parts[0].atRest.centre), 1e-6f);
    EXPECT_LT(glm::distance(read->parts[0].atRest.semiAxes, baked.parts[0].atRest.semiAxes), 1e-6f);
    for (int k = 0; k < 3; ++k)
        EXPECT_LT(glm::distance(read->parts[0].atRest.worldFromAxes[k], turned[k]), 1e-6f);
    ASSERT_EQ(read->selfOcclusion.size(), 2u);
    ASSERT_EQ(read->besideOwn.size(), 2u);
    for (size_t v = 0; v < 2; ++v) {
        EXPECT_LT(glm::distance(read->selfOcclusion[v], baked.selfOcclusion[v]), 1e-6f);
        EXPECT_LT(glm::distance(read->besideOwn[v], baked.besideOwn[v]), 1e-6f);
    }
}

TEST(BakedOcclusion, AFileOfAnotherKindIsRefused) {
    const std::string skin = R"({"skin": "0123456789abcdef", )", none = R"("ellipsoids": [], )",
                      selfOcclusion =
                          R"("selfOcclusion": [0, 0, 0, 9], "selfOcclusionBesideOwn": [0, 0, 0, -9])";
    ASSERT_TRUE(parseBakedOcclusion(skin + none + selfOcclusion + "}").ok());
    const auto ellipsoid = [](const char* node, const char* centre, const char* turn, const char* semi) {
        return std::string(R"("ellipsoids": [{"node": )") + node + R"(, "centre": )" + centre +
               R"(, "turn": )" + turn + R"(, "semiAxes": )" + semi + "}], ";
    };
    ASSERT_TRUE(parseBakedOcclusion(skin + ellipsoid("3", "[0, 0, 0]", "[0, 0, 0, 1]", "[1, 1, 1]") +
                                    selfOcclusion + "}")
                    .ok());
    std::string many = R"("ellipsoids": [0)";
    for (int k = 0; k < 99; ++k) many += ", 0";
    for (
        const std::string& text : {
            std::string(),
            std::string("[]"),
            none + selfOcclusion,
            skin + selfOcclusion + "}",
            skin + none + "}",
            R"({"skin": "12", )" + none + selfOcclusion + "}",
            R"({"skin": 12, )" + none + selfOcclusion + "}",
            skin + many + "], " + selfOcclusion + "}",
            skin + ellipsoid("-1", "[0, 0, 0]", "[0, 0, 0, 1]", "[1, 1, 1]") + selfOcclusion + "}",
            skin + ellipsoid("70000", "[0, 0, 0]", "[0, 0, 0, 1]", "[1, 1, 1]") + selfOcclusion + "}",
            skin + ellipsoid("3", "[0, 0]", "[0, 0, 0, 1]", "[1, 1, 1]") + selfOcclusion + "}",
            skin + ellipsoid("3", "[0, 0, 1e39]", "[0, 0, 0, 1]", "[1, 1, 1]") + selfOcclusion + "}",
            skin + ellipsoid("3", "[0, 0, 0]", "[0, 0, 0, 0]", "[1, 1, 1]") + selfOcclusion + "}",
            skin + ellipsoid("3", "[0, 0, 0]", "[0, 0, 0, 1]", "[1, 0, 1]") + selfOcclusion + "}",
            skin + ellipsoid("3", "[0, 0, 0]", "[0, 0, 0, 1]", "[1, null, 1]") + selfOcclusion + "}",
            skin + none + R"("selfOcclusion": [0, 0, 0], "selfOcclusionBesideOwn": [0, 0, 0]})",
            skin + none + R"("selfOcclusion": [0, 0, 0, 2001], "selfOcclusionBesideOwn": [0, 0, 0, 0]})",
            skin + none + R"("selfOcclusion": [0, 0, 0, 0.5], "selfOcclusionBesideOwn": [0, 0, 0, 0]})",
            skin + none +
                R"("selfOcclusion": [0, 0, 0, 18446744073709551615], "selfOcclusionBesideOwn": [0, 0, 0, 0]})",
            skin + none + R"("selfOcclusion": [], "selfOcclusionBesideOwn": [0, 0, 0, 0]})",
        })
        EXPECT_FALSE(parseBakedOcclusion(text).ok()) << text;
    EXPECT_FALSE(readBakedOcclusion(models() / "none.occlusion.json").ok());
}

} // namespace
} // namespace shoal::render
