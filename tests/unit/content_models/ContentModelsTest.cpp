// The game's models hold the nodes and clips that the game finds by name.
#include "engine/scene/Surface.h"
#include "engine/scene/Vertices.h"
#include "tests/TestRig.h"
#include "tests/unit/scene/Fixture.h"

namespace shoal::scene {
namespace {

// The clips that the game plays last as long as it expects.
void expectClips(const Model& model, const std::vector<std::string>& clips) {
    for (const std::string& clip : clips) {
        const int index = model.findAnimation(clip);
        ASSERT_GE(index, 0) << clip;
        const float duration_s = model.animations[static_cast<size_t>(index)].duration_s;
        EXPECT_TRUE(duration_s >= 0.4f && duration_s <= 1.6f) << clip << ": " << duration_s;
    }
}

size_t triangles(const Model& model) {
    size_t count = 0;
    for (const Mesh& mesh : model.meshes)
        for (const Primitive& part : mesh.primitives) count += part.indices.size() / 3;
    return count;
}

struct AnimalCase {
    const char* name;
    float length_m;
    float ahead; // how much of it lies ahead of its origin
    int maxTexels;
    std::vector<std::string> clips;
};

class Animals : public testing::TestWithParam<AnimalCase> {
  protected:
    const AnimalCase& animal = GetParam();
    const Model model = shipped(animal.name);
};

TEST_P(Animals, FaceForwardAtTheirRealSizeCentredOnTheBody) {
    const Bounds bounds = posedBounds(model, restOf(model));
    // Tail fins are sampled at their meshes' columns, which may miss the longest ray: 2 %.
    const float tolerance = 0.02f * animal.length_m;
    EXPECT_NEAR(bounds.high.z, animal.ahead * animal.length_m, tolerance);
    EXPECT_NEAR(bounds.low.z, (animal.ahead - 1) * animal.length_m, tolerance);
    // Mirror images in x, but for the ripple of the fins in the middle, which stay inside the body's width.
    EXPECT_NEAR(bounds.high.x, -bounds.low.x, 1e-4f * animal.length_m);
}

// A dive draws some 35 of them on two cores, vertices on one. So each is one opaque body and at most one more
// draw of translucent fins, whose two sides are separate skins: culling leaves the one that faces the eye.
TEST_P(Animals, AreFewAndLeanDraws) {
    ASSERT_EQ(model.meshes.size(), 1u);
    const auto& parts = model.meshes[0].primitives;
    ASSERT_GE(parts.size(), 1u);
    ASSERT_LE(parts.size(), 2u);
    size_t vertices = 0;
    for (size_t i = 0; i < parts.size(); ++i) {
        const Material& material = model.materials[static_cast<size_t>(parts[i].material)];
        EXPECT_EQ(material.alphaMode, i == 0 ? AlphaMode::Opaque : AlphaMode::Blend) << material.name;
        EXPECT_FALSE(material.doubleSided) << material.name;
        vertices += parts[i].positions.size();
    }
    EXPECT_GE(triangles(model), 1500u);
    EXPECT_LE(triangles(model), 6000u);
    EXPECT_LT(static_cast<double>(vertices), static_cast<double>(triangles(model)) / 1.5);
    for (const ImageRgba8& image : model.images) {
        EXPECT_LE(image.width, animal.maxTexels);
        EXPECT_LE(image.height, animal.maxTexels);
    }
}

// The engine makes coarser meshes, for afar, when it loads a model: the body must give way well.
TEST_P(Animals, HaveTwoLowerLevelsOfDetailAtLeast) {
    ASSERT_FALSE(model.meshes.empty());
    const Primitive& body = model.meshes[0].primitives[0];
    const std::vector<Lod> lods = makeLods(body, body.positions);
    ASSERT_GE(lods.size(), 2u);
    EXPECT_LE(lods[0].indices.size(), body.indices.size() * 6 / 10);
    EXPECT_LE(lods[1].indices.size(), body.indices.size() * 35 / 100);
    // The loss of half the triangles must not show: it moves the surface of an animal of 0.2 m by less than a
    // pixel at 0.6 m, where a metre has 1000 pixels.
    EXPECT_LT(lods[0].error, 0.005f * animal.length_m);
    // meshoptimizer 0.22 can give the eyes alone for a small error.
    const auto longest = [&](const std::vector<uint32_t>& vertices) {
        glm::vec3 low = body.positions[vertices[0]], high = low;
        for (const uint32_t v : vertices) {
            low = glm::min(low, body.positions[v]);
            high = glm::max(high, body.positions[v]);
        }
        return glm::length(high - low);
    };
    for (const Lod& lod : lods) EXPECT_GT(longest(lod.vertices), 0.3f * longest(body.indices));
}

// A flat strip can be two triangles; bent to a half circle of 1 m it lacks, with every second row, 1.5 mm.
TEST(LevelsOfDetail, AreMeasuredInTheGivenPose) {
    Primitive strip;
    std::vector<glm::vec3> bent;
    constexpr uint32_t kRows = 32;
    for (uint32_t i = 0; i <= kRows; ++i)
        for (const float across : {0.0f, 0.1f}) {
            const float along = static_cast<float>(i) / kRows, angle = glm::pi<float>() * along;
            strip.positions.emplace_back(across, 0, along);
            bent.emplace_back(across, std::sin(angle) / glm::pi<float>(), std::cos(angle) / glm::pi<float>());
            if (i == kRows || across > 0) continue;
            for (const uint32_t corner : {0, 2, 1, 1, 2, 3}) strip.indices.push_back(2 * i + corner);
        }
    EXPECT_LT(makeLods(strip, strip.positions)[0].error, 1e-5f);
    EXPECT_GT(makeLods(strip, bent)[0].error, 5e-4f);
}

TEST_P(Animals, HoldTheClipsThatTheGamePlays) { expectClips(model, animal.clips); }

TEST_P(Animals, ClipsLoopWithoutAJerk) {
    for (const Animation& clip : model.animations)
        for (const Channel& channel : clip.channels) {
            const size_t width = channel.target == Channel::Target::Rotation ? 4 : 3;
            ASSERT_GE(channel.values.size(), 2 * width);
            // First and last key are one phase of sines evaluated in double and rounded to float.
            for (size_t i = 0; i < width; ++i)
                EXPECT_NEAR(channel.values[i], channel.values[channel.values.size() - width + i], 1e-6f)
                    << clip.name;
        }
}

// The tail sweeps sideways, as a fish's does, and further than the head.
TEST_P(Animals, SwimSideways) {
    const int clip = model.findAnimation(animal.clips.front());
    ASSERT_GE(clip, 0);
    const int head = model.findNode("spine_0"), tail = model.findNode("spine_8");
    ASSERT_GE(head, 0);
    ASSERT_GE(tail, 0);
    float headSway = 0, tailSway = 0, tailLift = 0;
    Pose pose;
    const float duration_s = model.animations[static_cast<size_t>(clip)].duration_s;
    for (int i = 0; i < 32; ++i) {
        restPose(model, pose);
        animate(model, clip, duration_s * static_cast<float>(i) / 32, pose);
        updateGlobals(model, pose);
        const glm::vec4 h = pose.modelFromNode[static_cast<size_t>(head)][3];
        const glm::vec4 t = pose.modelFromNode[static_cast<size_t>(tail)][3];
        headSway = std::max(headSway, std::abs(h.x));
        tailSway = std::max(tailSway, std::abs(t.x));
        tailLift = std::max(tailLift, std::abs(t.y));
    }
    EXPECT_GT(tailSway, 0.02f * animal.length_m);
    EXPECT_GT(tailSway, 1.5f * headSway);
    EXPECT_GT(tailSway, tailLift);
}

const std::vector<std::string> kFish = {"swim", "dart", "struggle"};

INSTANTIATE_TEST_SUITE_P(Content, Animals,
                         testing::Values(AnimalCase{"clownfish", 0.11f, 0.5f, 512, kFish},
                                         AnimalCase{"angelfish", 0.25f, 0.5f, 512, kFish},
                                         AnimalCase{"snapper", 0.32f, 0.5f, 512, kFish},
                                         AnimalCase{"sardine", 0.12f, 0.5f, 512, kFish},
                                         AnimalCase{"boxfish", 0.20f, 0.5f, 512, kFish},
                                         AnimalCase{"idol", 0.19f, 0.5f, 512, kFish},
                                         // Its tail is all whip: the origin lies in the disc.
                                         AnimalCase{"ray", 1.176f, 0.357f, 1024, kFish},
                                         AnimalCase{"shark", 1.8f, 0.5f, 1024, {"cruise", "lunge", "bite"}}),
                         tests::byName);

TEST(AnimalModels, AreSmallFilesTogether) {
    uintmax_t bytes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(dataRoot() / "content" / "models"))
        if (entry.path().extension() == ".glb") bytes += entry.file_size();
    EXPECT_LE(bytes, 9'000'000u);
}

TEST(SharkModel, OpensItsJawToBite) {
    const Model model = shipped("shark");
    const int clip = model.findAnimation("bite"), jaw = model.findNode("jaw");
    ASSERT_GE(clip, 0);
    ASSERT_GE(jaw, 0);
    Pose pose = restOf(model);
    animate(model, clip, 0.47f * model.animations[static_cast<size_t>(clip)].duration_s, pose);
    // The jaw points ahead of its hinge: turned about +X, its tip goes down.
    EXPECT_GT(glm::angle(pose.local[static_cast<size_t>(jaw)].rotation), 0.5f);
    EXPECT_GT(glm::axis(pose.local[static_cast<size_t>(jaw)].rotation).x, 0.9f);
}

class Hands : public testing::TestWithParam<const char*> {
  protected:
    const Model model = shipped(GetParam());
};

TEST_P(Hands, HaveTheJointsOfOpenXrInOrder) {
    ASSERT_EQ(model.skins.size(), 1u);
    ASSERT_EQ(model.skins[0].joints.size(), hands::kJointNames.size());
    for (size_t i = 0; i < hands::kJointNames.size(); ++i) {
        const Node& node = model.nodes[static_cast<size_t>(model.skins[0].joints[i])];
        EXPECT_EQ(node.name, hands::kJointNames[i]);
        const int parent = hands::kJointParent[i];
        if (parent >= 0) {
            EXPECT_EQ(node.parent, model.skins[0].joints[static_cast<size_t>(parent)]) << node.name;
        }
    }
}

// A joint set to its rest pose leaves the skin where it is: the game sets joints in the world, so the inverse
// bind matrices must undo the rest pose.
TEST_P(Hands, RestPoseUndoesTheBindMatrices) {
    std::vector<glm::mat4> matrices;
    skinMatrices(model, 0, restOf(model), matrices);
    for (const glm::mat4& m : matrices)
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r)
                // Five rotations in float along a finger: 5 * 4 roundings of 6e-8, and a margin of two.
                EXPECT_NEAR(m[c][r], c == r ? 1.0f : 0.0f, 3e-6f);
}

TEST_P(Hands, CanWearThreeComplexionsAndAGlove) {
    EXPECT_EQ(model.variants, (std::vector<std::string>{"light", "medium", "dark", "glove"}));
    for (const std::string& look : model.variants) {
        const Model dressed = shipped(GetParam(), look);
        const Material& material = dressed.materialOf(dressed.meshes[0].primitives[0]);
        EXPECT_EQ(material.name, look);
        ASSERT_TRUE(dressed.imageOf(material.baseColour));
        EXPECT_EQ(dressed.imageOf(material.baseColour)->pixels, model.imageOf(material.baseColour)->pixels);
        size_t unread = 0;
        for (const ImageRgba8& image : dressed.images) unread += image.empty();
        EXPECT_GE(unread, 3u) << "other looks' colours";
    }
}

// Hands are drawn nearest of all models, in every frame, on two cores.
TEST_P(Hands, AreOneLeanDraw) {
    ASSERT_EQ(model.meshes.size(), 1u);
    ASSERT_EQ(model.meshes[0].primitives.size(), 1u);
    EXPECT_LE(triangles(model), 6000u);
    EXPECT_LE(model.meshes[0].primitives[0].positions.size(), 4000u);
}

// A hand ends in a wrist of three quarters of the palm's breadth; a sleeve hides it (models/arms.py).
TEST_P(Hands, EndInAWrist) {
    ASSERT_FALSE(model.meshes.empty());
    const Primitive& skin = model.meshes[0].primitives[0];
    const auto breadth = [&](float from_m, float to_m) { // across, of what lies between, without the thumb
        float low = 1, high = -1;
        for (size_t v = 0; v < skin.positions.size(); ++v) {
            const glm::vec3& p = skin.positions[v];
            const bool thumb = hands::kJointNames[skin.joints[v][0]].starts_with("thumb");
            if (thumb || p.z < from_m || p.z > to_m) continue;
            low = std::min(low, p.x);
            high = std::max(high, p.x);
        }
        return high - low;
    };
    const float palm = breadth(-0.100f, -0.075f);
    EXPECT_NEAR(palm, 0.085f, 0.01f);
    EXPECT_NEAR(breadth(0.005f, 0.020f) / palm, 0.68f, 0.05f);
    float end_m = 0;
    for (const glm::vec3& p : skin.positions) end_m = std::max(end_m, p.z);
    EXPECT_GE(end_m, 0.022f);
    EXPECT_LE(end_m, 0.035f);
}

// Animals that are no fish pulse, or bend up and down, and yet can be a species of a dive.
TEST(OtherAnimals, AreAsLargeAsInLifeAndHoldTheClipsThatTheGamePlays) {
    struct Case {
        const char* name;
        glm::vec3 size_m; // across, high, long
    };
    for (const Case& animal : {Case{"jellyfish", {0.2f, 0.42f, 0.2f}}, Case{"humpback", {7.1f, 3.0f, 12}}}) {
        const Model model = shipped(animal.name);
        const Bounds bounds = posedBounds(model, restOf(model));
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR((bounds.high - bounds.low)[axis] / animal.size_m[axis], 1, 0.15f)
                << animal.name << axis;
        expectClips(model, kFish);
        EXPECT_LE(triangles(model), 6000u);
    }
}

// A thing without its weed is as large as in life and centred on its origin: its capsule lies along Z.
TEST(Things, AreCentredAtTheirRealSizeAndLoseTheirWeed) {
    struct Case {
        const char* name;
        glm::vec3 size_m; // across, high, long
        std::vector<std::string> clips;
    };
    for (const Case& thing : {Case{"mussel", {0.038f, 0.046f, 0.09f}, {"loose", "drift", "open"}},
                              Case{"stone", {0.064f, 0.046f, 0.085f}, {"loose", "drift"}},
                              Case{"bottle", {0.068f, 0.068f, 0.24f}, {}}}) {
        SCOPED_TRACE(thing.name);
        const Model model = shipped(thing.name);
        const auto boundsIn = [&](const std::string& clip) { // at rest if there is none of this name
            Pose pose = restOf(model);
            if (const int index = model.findAnimation(clip); index >= 0) animate(model, index, 0, pose);
            updateGlobals(model, pose);
            return posedBounds(model, pose);
        };
        for (const std::string& clip : thing.clips) EXPECT_GE(model.findAnimation(clip), 0) << clip;
        const Bounds rest = boundsIn("rest"), bare = boundsIn("loose"), open = boundsIn("open");
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR((bare.high - bare.low)[axis], thing.size_m[axis], 0.002f) << axis;
            EXPECT_NEAR(bare.high[axis], -bare.low[axis], 0.002f) << axis;
        }
        // The game measures the length at rest, with weed.
        EXPECT_NEAR(rest.high.z - rest.low.z, thing.size_m.z, 0.003f);
        EXPECT_EQ(boundsIn("drift").high.y > 0.1f, !thing.clips.empty());   // its weed
        EXPECT_EQ(open.low.x < 1.5f * bare.low.x, thing.clips.size() == 3); // its shells gape
        EXPECT_LE(triangles(model), 3000u);
    }
}

// Linear blending squeezes the inside of a bent joint, stretches the webs between fingers and thins what
// bends. Few edges may shrink below a quarter of their length or stretch beyond twice it. In these poses at
// most 0.22 and 0.32 % did, and the volume was 0.948 (fist) to 1.024 (fanned) of that at rest.
TEST(HandModels, KeepTheFleshOnTheBones) {
    const Model model = shipped("hand_right");
    const Primitive& skin = model.meshes[0].primitives[0];
    struct Case {
        const char* name;
        hands::HandShape shape;
    };
    for (const auto& [name, shape] :
         {Case{"flat", {}}, Case{"fist", {{1, 1, 1, 1, 1}, 0}},
          Case{"pinch", {{0.55f, 0.6f, 0.15f, 0.1f, 0.1f}, 0}}, Case{"fanned", {{}, 1}}}) {
        SCOPED_TRACE(name);
        const hands::HandPose hand = tests::rig().pose(hands::Side::Right, shape, {});
        Pose pose = restOf(model);
        for (size_t i = 0; i < hands::kJointNames.size(); ++i)
            pose.modelFromNode[static_cast<size_t>(model.skins[0].joints[i])] =
                glm::translate(glm::mat4(1), hand.joints[i].position) *
                glm::mat4_cast(hand.joints[i].orientation);
        std::vector<glm::mat4> joints;
        skinMatrices(model, 0, pose, joints);
        std::vector<glm::vec3> posed(skin.positions.size());
        for (size_t v = 0; v < posed.size(); ++v)
            posed[v] = glm::vec3(skinMatrix(skin, v, joints) * glm::vec4(skin.positions[v], 1));
        size_t squeezed = 0, stretched = 0;
        double volume = 0, before = 0;
        const auto solid = [](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
            return static_cast<double>(glm::dot(a, glm::cross(b, c))) / 6;
        };
        for (size_t t = 0; t < skin.indices.size(); t += 3) {
            const uint32_t* of = &skin.indices[t];
            for (int k = 0; k < 3; ++k) {
                const uint32_t a = of[k], b = of[(k + 1) % 3];
                const float rest = glm::distance(skin.positions[a], skin.positions[b]);
                if (rest < 1e-4f) continue;
                const float ratio = glm::distance(posed[a], posed[b]) / rest;
                squeezed += ratio < 0.25f ? 1 : 0;
                stretched += ratio > 2 ? 1 : 0;
            }
            volume += solid(posed[of[0]], posed[of[1]], posed[of[2]]);
            before += solid(skin.positions[of[0]], skin.positions[of[1]], skin.positions[of[2]]);
        }
        const auto share = [&](size_t count) {
            return static_cast<double>(count) / static_cast<double>(skin.indices.size());
        };
        EXPECT_LT(share(squeezed), 0.01);
        EXPECT_LT(share(stretched), 0.01);
        EXPECT_NEAR(volume / before, 1, 0.055);
    }
}

TEST(HandModels, AreMirrorImages) {
    const Model left = shipped("hand_left"), right = shipped("hand_right");
    ASSERT_FALSE(left.meshes.empty());
    ASSERT_FALSE(right.meshes.empty());
    const Primitive &l = left.meshes[0].primitives[0], &r = right.meshes[0].primitives[0];
    ASSERT_EQ(l.positions.size(), r.positions.size());
    for (size_t i = 0; i < l.positions.size(); ++i) {
        EXPECT_EQ(l.positions[i], r.positions[i] * glm::vec3(-1, 1, 1));
        EXPECT_EQ(l.weights[i], r.weights[i]);
    }
    const Pose lp = restOf(left), rp = restOf(right);
    for (size_t i = 0; i < hands::kJointNames.size(); ++i) {
        // The joint's axes, mirrored: x of a mirrored right-handed frame turns about.
        const auto lm = lp.modelFromNode[static_cast<size_t>(left.skins[0].joints[i])];
        const auto rm = rp.modelFromNode[static_cast<size_t>(right.skins[0].joints[i])];
        for (int axis : {1, 2, 3})
            EXPECT_LT(glm::length(glm::vec3(lm[axis]) - glm::vec3(rm[axis]) * glm::vec3(-1, 1, 1)), 1e-5f)
                << hands::kJointNames[i];
    }
}

INSTANTIATE_TEST_SUITE_P(Content, Hands, testing::Values("hand_left", "hand_right"),
                         [](const auto& spec) { return std::string(spec.param); });

// However its fingers bend, a hand stays in the sphere around it, which is little larger than a hand.
TEST(Hands, StayWithinTheirReach) {
    const Model model = shipped("hand_left");
    Pose pose = restOf(model);
    const std::vector<NodeSphere> reach = boundingSpheresOf(model, pose);
    const glm::mat4 worldFromModel = glm::scale(glm::translate(glm::mat4(1), {3, -1, 2}), glm::vec3(1.5f));
    for (const float bend : {0.0f, 0.4f, 0.8f, 1.2f}) {
        restPose(model, pose);
        for (size_t n = 0; n < model.nodes.size(); ++n)
            if (model.nodes[n].name.find("index") == 0 || model.nodes[n].name.find("thumb") == 0)
                pose.local[n].rotation = pose.local[n].rotation * glm::angleAxis(bend, glm::vec3(1, 0, 0));
        updateGlobals(model, pose);
        std::vector<Sphere> parts;
        placeSpheres(reach, pose, worldFromModel, parts);
        const Sphere sphere = boundingSphereOf(parts);
        EXPECT_LT(sphere.radius, 1.5f * 0.2f);
        float furthest = 0, outside = 0;
        for (const glm::vec3& p : posedSurface(model, pose).positions) {
            const glm::vec3 world(worldFromModel * glm::vec4(p, 1));
            furthest = std::max(furthest, glm::distance(world, sphere.centre));
            float nearest = INFINITY; // to a part
            for (const Sphere& part : parts)
                nearest = std::min(nearest, glm::distance(world, part.centre) - part.radius);
            outside = std::max(outside, nearest);
        }
        EXPECT_LT(outside, 0.002f) << bend;
        EXPECT_LT(furthest, sphere.radius + 0.002f) << bend;
        EXPECT_GT(furthest, 0.7f * sphere.radius);
    }
}

} // namespace
} // namespace shoal::scene
