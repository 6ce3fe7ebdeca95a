#include "engine/core/WriteFile.h"
#include "engine/math/SphericalHarmonics.h"
#include "engine/scene/Model.h"
#include "game/app/ContentLoader.h"
#include "game/app/GuideAnimal.h"
#include "game/views/ArmPose.h"
#include "game/views/CreatureModels.h"
#include "game/views/DynamicQuality.h"
#include "game/views/Environment.h"
#include "tests/Test.h"
#include "tests/playthrough/Rooms.h"
#include "tests/unit/depth/MadeMap.h"

namespace shoal::app {
namespace {

// Six animals, more than are updated in each picture, in a room that is white at 1 m all around, except
// behind the viewer, where it is black.
struct Swim {
    depth::LightDifference room;
    AnimalLight light;
    game::Snapshot shown{.creatures = std::vector<game::CreatureView>(6)};

    Swim() {
        ImageRgbF radiance(64, 32);
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 64; ++x) std::fill_n(radiance.at(x, y), 3, x >= 16 && x < 48 ? 1.0f : 0.0f);
        room.make(radiance, depth::mapOf([](const glm::vec3&) { return 1.0f; }, 256));
    }
    void picture() {
        light.follow(shown, &room, glm::mat3(1));
        shown.time_s += 1 / 60.0;
    }
    glm::vec3 even(size_t animal) const { return light.of(animal)[0]; }
    glm::vec3 evenAt(const glm::vec3& place) const { return room.at(place)[0]; }
};

const glm::vec3 kAhead(0, 0, -0.5f);

// Returns what a matte white surface with this normal sends back in the light of these harmonics.
float reflected(const depth::LightHarmonics& light, const glm::dvec3& normal) {
    const math::ShBasis basis = math::shBasis(normal);
    double sum = 0;
    for (int l = 0, k = 0; l <= 2; ++l)
        for (int m = -l; m <= l; ++m, ++k) sum += math::kShCosine[l] * basis[k] * light[k].x;
    return static_cast<float>(sum / glm::pi<double>());
}

// The clamped cosine's first three bands err by at most 3/32 at right angles to the light, 1/16 towards it
// and away from it (Ramamoorthi and Hanrahan 2001, equation 9).
TEST(AnimalLight, TheLampLightsWhatFacesItByTheSquareOfTheDistance) {
    AnimalLight light;
    game::Snapshot shown;
    shown.headWorld = {0.1f, -0.15f, 0.2f}; // the lamp is 0.15 m above it
    shown.creatures.resize(3);
    const glm::vec3 lamp(0.1f, 0, 0.2f), away = glm::normalize(glm::vec3(1, 2, -2));
    constexpr float kLamp = 0.2f;
    const float distances_m[3] = {0.5f, 1, 3};
    for (size_t i = 0; i < 3; ++i) shown.creatures[i].position = lamp + distances_m[i] * away;
    const glm::mat3 envFromWorld = glm::mat3_cast(glm::angleAxis(0.7f, glm::vec3(0, 1, 0)));
    light.follow(shown, nullptr, envFromWorld, {.radiance = kLamp});
    for (size_t i = 0; i < 3; ++i) {
        // The lamp is a disc 0.3 m wide to both sides, and from a metre as bright as the dive says.
        const float d = distances_m[i], bright = kLamp * 1.09f / (d * d + 0.09f);
        for (const glm::vec3& normal : {-away, away, glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)}) {
            const float facing = std::max(glm::dot(normal, -away), 0.0f);
            EXPECT_NEAR(reflected(light.of(i), envFromWorld * normal), bright * facing,
                        bright * 3 / 32 + 1e-5f);
        }
        EXPECT_NEAR(reflected(light.of(i), envFromWorld * -away), bright * 17 / 16, 1e-4f * bright);
    }
    light.follow(shown, nullptr, envFromWorld, {.radiance = kLamp, .attenuation_perM = glm::vec3(0.4f)});
    EXPECT_NEAR(reflected(light.of(2), envFromWorld * -away),
                kLamp * 1.09f / 9.09f * 17 / 16 * std::exp(-1.2f), 1e-4f);
}

// Ground 1 m below the camera that is now 1.2 times as bright as in its mean.
TEST(AnimalLight, WavesLightBacksByWhatTheGroundGains) {
    const auto map = depth::mapOf([](const glm::vec3& dir) { return std::max(-dir.y, 0.0f); });
    ImageRgbF before(64, 32), now(64, 32);
    std::ranges::fill(before.pixels, 1.0f);
    std::ranges::fill(now.pixels, 1.22f);
    depth::Caustics caustics;
    caustics.follow(before, 0);
    caustics.follow(now, 0.048f); // the mean follows by a share of 1 - exp(-0.096)
    const float gain = caustics.changeAt(kAhead, {0, 1, 0}, 0.2f, map);
    EXPECT_NEAR(gain, 1.22f / (1 + 0.22f * 0.0915f) - 1, 1e-3f);
    light::ShadowLight from{.groundIrradiance = glm::vec3(glm::pi<float>())};
    AnimalLight light;
    game::Snapshot shown;
    shown.creatures.resize(1);
    shown.creatures[0].position = kAhead;
    const auto on = [&](const glm::dvec3& normal) {
        shown.time_s += 1 / 30.0; // the film's light is looked up no more often
        light.follow(shown, nullptr, glm::mat3(1), {}, {&caustics, &map, &from});
        return reflected(light.of(0), normal);
    };
    EXPECT_EQ(on({0, 1, 0}), 0); // no light casts shadows: nothing to focus
    from.presence = 1;
    EXPECT_NEAR(on({0, 1, 0}), gain * 17 / 16, 1e-4f); // see the lamp above
    EXPECT_NEAR(on({0, -1, 0}), 0, gain / 16 + 1e-4f);
}

TEST(AnimalLight, FollowsEveryAnimalWithoutAStep) {
    Swim swim;
    for (auto& animal : swim.shown.creatures) animal.position = kAhead * 0.2f;
    swim.picture();
    const float from = swim.even(0).x;
    for (auto& animal : swim.shown.creatures) animal.position = kAhead; // moved by 0.4 m, as by swimming
    const float to = swim.evenAt(kAhead).x;
    ASSERT_GT(to, from);
    float last = from;
    for (int picture = 0; picture < 120; ++picture) {
        swim.picture();
        // A time constant of 0.25 s is 15 pictures.
        EXPECT_LE(swim.even(5).x - last, (to - from) / 15);
        EXPECT_GE(swim.even(5).x, last);
        last = swim.even(5).x;
    }
    for (size_t i = 0; i < 6; ++i) EXPECT_NEAR(swim.even(i).x, to, 0.01f * (to - from)) << i;
}

TEST(AnimalLight, NewAnimalsAndThoseThatComeInElsewhereHaveTheLightOfTheirPlaceAtOnce) {
    Swim swim;
    for (auto& animal : swim.shown.creatures) animal.position = kAhead;
    swim.picture();
    ASSERT_NE(swim.evenAt(kAhead), glm::vec3(0));
    for (size_t i = 0; i < 6; ++i) EXPECT_EQ(swim.even(i), swim.evenAt(kAhead)) << i;
    swim.picture();
    swim.shown.creatures[5].position = {0, 0, 0.2f}; // in a sixtieth of a second
    swim.picture();
    EXPECT_LT(glm::distance(swim.even(5), swim.evenAt({0, 0, 0.2f})), 1e-6f); // rounding
}

// Arms reach from an estimated shoulder to where the hand is, whatever the hand and the head do.

constexpr float kNear_m = 1e-5f; // of single precision, at arm's length

glm::vec3 placeOf(const ArmPose& arm, ArmJoint joint) {
    return glm::vec3(arm[static_cast<size_t>(joint)][3]);
}

float bendOf(const ArmPose& arm) { // radians; 0: straight
    const glm::vec3 elbow = placeOf(arm, ArmJoint::Elbow);
    const glm::vec3 fore = glm::normalize(placeOf(arm, ArmJoint::Wrist) - elbow),
                    upper = glm::normalize(elbow - placeOf(arm, ArmJoint::UpperArm));
    return std::acos(glm::clamp(glm::dot(fore, upper), -1.0f, 1.0f));
}

std::vector<Head> heads() {
    std::vector<Head> all;
    for (int yaw = -180; yaw < 180; yaw += 60)
        for (int pitch = -90; pitch <= 90; pitch += 15)
            for (int roll = -60; roll <= 60; roll += 30)
                all.push_back(
                    {{0.1f, -0.2f, 0.3f},
                     glm::angleAxis(glm::radians(static_cast<float>(yaw)), glm::vec3(0, 1, 0)) *
                         glm::angleAxis(glm::radians(static_cast<float>(pitch)), glm::vec3(1, 0, 0)) *
                         glm::angleAxis(glm::radians(static_cast<float>(roll)), glm::vec3(0, 0, 1))});
    return all;
}

// The bones keep their lengths within reach, and by the law of cosines the elbow's angle follows.
TEST(ArmPose, BendsAsTheLawOfCosinesSays) {
    const glm::vec3 shoulder = shoulderWorld(hands::Side::Right, {});
    for (const float distance : {0.1f, 0.2f, 0.4f, 0.55f}) {
        const hands::Joint wrist{.position =
                                     shoulder + distance * glm::normalize(glm::vec3(-0.3f, 0.4f, -1))};
        const ArmPose arm = poseArm(hands::Side::Right, wrist, {});
        EXPECT_NEAR(glm::distance(placeOf(arm, ArmJoint::Wrist), placeOf(arm, ArmJoint::Elbow)), kForearm_m,
                    kNear_m);
        EXPECT_NEAR(glm::distance(placeOf(arm, ArmJoint::Elbow), shoulder), kUpperArm_m, kNear_m);
        const float cosine = (distance * distance - kForearm_m * kForearm_m - kUpperArm_m * kUpperArm_m) /
                             (2 * kForearm_m * kUpperArm_m);
        EXPECT_NEAR(std::cos(bendOf(arm)), cosine, 1e-4f) << distance;
        EXPECT_NEAR(stretchOf(arm), 1, 1e-4f);
        EXPECT_LT(placeOf(arm, ArmJoint::Elbow).y, std::max(shoulder.y, wrist.position.y)); // it hangs
    }
}

TEST(ArmPose, StretchesBothBonesAlikeBeyondItsReach) {
    const glm::vec3 shoulder = shoulderWorld(hands::Side::Left, {});
    const float distance = 1.5f * (kForearm_m + kUpperArm_m);
    const ArmPose arm = poseArm(hands::Side::Left, {.position = shoulder + glm::vec3(0, 0, -distance)}, {});
    EXPECT_NEAR(stretchOf(arm), 1.5f, 1e-4f);
    EXPECT_NEAR(glm::distance(placeOf(arm, ArmJoint::Wrist), placeOf(arm, ArmJoint::Elbow)),
                1.5f * kForearm_m, 1e-4f);
    EXPECT_NEAR(bendOf(arm), 0, 0.01f);
}

// An elbow on the circle where both bones meet is where the arm bends, whatever the head does; nothing
// changes where none is given, or one that lies in the line from wrist to shoulder.
TEST(ArmPose, BendsAtTheElbowThatATrackerGives) {
    const hands::Side side = hands::Side::Right;
    for (const Head& head : heads()) {
        const glm::vec3 shoulder = shoulderWorld(side, head);
        const hands::Joint wrist{.position = shoulder + head.worldFromView * glm::vec3(-0.15f, 0.1f, -0.35f)};
        const glm::vec3 apart = shoulder - wrist.position;
        const float distance = glm::length(apart);
        const glm::vec3 back = apart / distance;
        const float along =
            (distance * distance + kForearm_m * kForearm_m - kUpperArm_m * kUpperArm_m) / (2 * distance);
        const float off = std::sqrt(kForearm_m * kForearm_m - along * along);
        const glm::vec3 first = glm::normalize(glm::cross(back, head.worldFromView * glm::vec3(0, 1, 0)));
        for (int turn = 0; turn < 360; turn += 30) {
            const glm::vec3 point = glm::angleAxis(glm::radians(static_cast<float>(turn)), back) * first;
            const glm::vec3 elbow = wrist.position + along * back + off * point;
            const ArmPose arm = poseArm(side, wrist, head, (elbow - wrist.position) / kForearm_m);
            EXPECT_LT(glm::distance(placeOf(arm, ArmJoint::Elbow), elbow), kNear_m) << turn;
        }
        const glm::vec3 loose = placeOf(poseArm(side, wrist, head), ArmJoint::Elbow);
        EXPECT_EQ(placeOf(poseArm(side, wrist, head, back), ArmJoint::Elbow), loose);
    }
}

// For every head and hand the wrist is the hand's own, joints are rotations, and no shoulder is in view.
TEST(ArmPose, HoldsForEveryHeadAndHand) {
    for (const Head& head : heads())
        for (const hands::Side side : {hands::Side::Left, hands::Side::Right})
            for (const glm::vec3 place :
                 {glm::vec3(0, 0, -0.3f), glm::vec3(-0.4f, 0.3f, -0.5f), glm::vec3(0.5f, -0.4f, 0.1f),
                  glm::vec3(0, 0.2f, -1.2f), glm::vec3(0)}) {
                const hands::Joint wrist{.position = place == glm::vec3(0)
                                                         ? shoulderWorld(side, head)
                                                         : head.positionWorld + head.worldFromView * place,
                                         .orientation = head.worldFromView};
                const ArmPose arm = poseArm(side, wrist, head);
                EXPECT_EQ(placeOf(arm, ArmJoint::Wrist), wrist.position);
                for (const glm::mat4& joint : arm) {
                    EXPECT_NEAR(glm::determinant(glm::mat3(joint)), 1, 1e-3f);
                    for (int axis = 0; axis < 3; ++axis)
                        EXPECT_NEAR(glm::length(glm::vec3(joint[axis])), 1, 1e-3f);
                }
                const glm::vec3 inView =
                    glm::conjugate(head.worldFromView) * (shoulderWorld(side, head) - head.positionWorld);
                EXPECT_GT(inView.z, 0.02f);
                EXPECT_GT(std::hypot(inView.x, inView.y), 0.32f);
            }
}

// The arm models have their joints where poseArm() expects them, are closed behind, and enclose the wrist.
TEST(ArmModels, AreWhatTheyArePosedAs) {
    for (const char* name : {"arm_left", "arm_right"}) {
        const auto model =
            tests::valueOf(scene::loadModel(dataRoot() / "content/models" / (std::string(name) + ".glb")));
        scene::Pose rest;
        scene::restPose(model, rest);
        scene::updateGlobals(model, rest);
        const std::array<float, kArmJointNames.size()> places_m = {
            0, 0, kForearm_m / 2, kForearm_m, kForearm_m, kForearm_m, kForearm_m + kUpperArm_m};
        for (size_t k = 0; k < kArmJointNames.size(); ++k) {
            const int node = model.findNode(std::string(kArmJointNames[k]));
            ASSERT_GE(node, 0) << kArmJointNames[k];
            EXPECT_LT(glm::distance(glm::vec3(rest.modelFromNode[static_cast<size_t>(node)][3]),
                                    glm::vec3(0, 0, places_m[k])),
                      kNear_m);
        }
        ASSERT_EQ(model.meshes.size(), 1u);
        ASSERT_EQ(model.meshes[0].primitives.size(), 1u);
        const scene::Primitive& sleeve = model.meshes[0].primitives[0];
        EXPECT_LE(sleeve.indices.size() / 3, 3000u);
        // Half widths where it starts, inside the hand's wrist, at the hem, and at its end.
        float least_m = 1, front_m = 1, end_m = 0, behind_m = 1;
        for (const glm::vec3& p : sleeve.positions) {
            front_m = std::min(front_m, p.z), end_m = std::max(end_m, p.z);
            if (p.z < 0.1f) least_m = std::min(least_m, std::hypot(p.x, p.y));
        }
        for (const glm::vec3& p : sleeve.positions)
            if (p.z > end_m - 1e-4f) behind_m = std::min(behind_m, std::hypot(p.x, p.y));
        EXPECT_LT(front_m, 0.012f);
        EXPECT_LT(least_m, 0.0195f); // the wrist's own half height
        EXPECT_LT(behind_m, 0.001f);
        EXPECT_GT(end_m, kForearm_m + kUpperArm_m);
    }
}

// Tests the dynamic quality control on a simulated machine, whose frame time is the sum of a fixed part, a
// part for each pixel and a part for the light.

constexpr double kBudget_ms = 1000.0 / 60;

struct Machine {
    double fixed_ms = 2, pixels_ms = 6, light_ms = 1;
    double frame_ms(const Quality& q) const {
        return fixed_ms + pixels_ms * static_cast<double>(q.scale * q.scale) + light_ms / q.lightEvery;
    }
};

struct Ride {
    Quality end;
    int changes = 0;
    double last_ms = 0;
    float largestStep = 0; // largest change of the scale between two frames
};

Ride ride(DynamicQuality& dynamicQuality, const Machine& machine, int frames) {
    Ride result;
    Quality before = dynamicQuality.quality();
    for (int i = 0; i < frames; ++i) {
        result.last_ms = machine.frame_ms(dynamicQuality.quality());
        dynamicQuality.frame(result.last_ms);
        const Quality now = dynamicQuality.quality();
        result.changes += now.scale != before.scale || now.lightEvery != before.lightEvery;
        result.largestStep = std::max(result.largestStep, std::abs(now.scale - before.scale));
        before = now;
    }
    result.end = before;
    return result;
}

// Frames take 1.5 times the budget: pixels must become fewer within two seconds, and then stay steady.
TEST(DynamicQuality, DrawsFewerPixelsUntilFramesFit) {
    DynamicQuality dynamicQuality(kBudget_ms);
    const Machine slow{4, 20, 1};
    ride(dynamicQuality, slow, 120);
    const Ride settled = ride(dynamicQuality, slow, 3600);
    EXPECT_LT(settled.last_ms, kBudget_ms);
    EXPECT_GT(settled.end.scale, 0.6f); // not lower than needed: 0.72 would just fit
    EXPECT_EQ(settled.end.lightEvery, 1);
    EXPECT_LE(settled.changes, 6);
}

TEST(DynamicQuality, StepsAreSmallWhereTheLoadIs) {
    DynamicQuality dynamicQuality(kBudget_ms);
    EXPECT_LT(ride(dynamicQuality, {4, 13, 1}, 600).largestStep, 0.065f);
}

// Half of the width is not enough: then the light is made less often, too, down to the limits of both.
TEST(DynamicQuality, ThenMakesLightLessOften) {
    DynamicQuality some(kBudget_ms), most(kBudget_ms);
    const Ride result = ride(some, {12, 12, 4}, 1200), end = ride(most, {500, 500, 50}, 3000);
    EXPECT_NEAR(result.end.scale, 0.506f, 0.01f);
    EXPECT_GT(result.end.lightEvery, 1);
    EXPECT_LT(result.last_ms, kBudget_ms);
    EXPECT_GE(end.end.scale, DynamicQuality::kMinScale);
    EXPECT_EQ(end.end.lightEvery, DynamicQuality::kMaxLightEvery);
}

// An artificial load comes and goes: full quality must be back 40 s after its end.
TEST(DynamicQuality, TakesItBackWhenTheLoadIsGone) {
    DynamicQuality dynamicQuality(kBudget_ms);
    ride(dynamicQuality, {}, 600);
    EXPECT_LT(ride(dynamicQuality, {4, 30, 1}, 1200).end.scale, 0.7f);
    const Ride after = ride(dynamicQuality, {}, 60 * 40);
    EXPECT_EQ(after.end.scale, 1.0f);
    EXPECT_EQ(after.end.lightEvery, 1);
}

// The load lies between two steps: the control tries the upper one ever less often, at last every 15 s.
TEST(DynamicQuality, DoesNotSwingAtTheEdge) {
    for (double pixels_ms = 10; pixels_ms < 30; pixels_ms += 0.37) {
        DynamicQuality dynamicQuality(kBudget_ms);
        ride(dynamicQuality, {3, pixels_ms, 1}, 3600);
        EXPECT_LE(ride(dynamicQuality, {3, pixels_ms, 1}, 3600).changes, 8) << pixels_ms;
    }
}

TEST(DynamicQuality, OneSlowFrameChangesNothing) {
    DynamicQuality dynamicQuality(kBudget_ms);
    for (int i = 0; i < 600; ++i) {
        dynamicQuality.frame(i % 100 == 50 ? 60 : 8);
        EXPECT_EQ(dynamicQuality.quality().scale, 1.0f);
    }
}

TEST(FilmChoice, SlowMachinesPlayTheSmallVersionIfThereIsOne) {
    const tests::ScratchFolder folder;
    const Path best = folder / "sea.mp4", small = folder / "sea.small.mp4";
    ASSERT_TRUE(writeFileWhole(best, "b"));
    EXPECT_EQ(filmFor(best, FilmChoice::Auto, true), best);
    EXPECT_EQ(filmFor(best, FilmChoice::Small, false), best);
    ASSERT_TRUE(writeFileWhole(small, "s"));
    EXPECT_EQ(filmFor(best, FilmChoice::Auto, true), small);
    EXPECT_EQ(filmFor(best, FilmChoice::Auto, false), best);
    EXPECT_EQ(filmFor(best, FilmChoice::Small, false), small);
    EXPECT_EQ(filmFor(best, FilmChoice::Best, true), best);
}

// The room files, for playthroughs on machines that decode no film, equal the rooms that the program makes of
// the films' depth tracks. With SHOAL_UPDATE=1 the files are written anew.

// Returns the distances that a space was made of: those in the middles of cells, at the times of steps.
game::Room roomIn(const game::FilmSpace& space, double length_s) {
    game::Room room{length_s, {}};
    for (int step = 0; step < space.steps(); ++step) {
        const auto moment = space.at((step + 1e-6) * length_s / space.steps());
        for (int cell = 0; cell < game::FilmSpace::kCells; ++cell)
            room.surface_mm.push_back(static_cast<uint16_t>(
                std::lround(1000 * space.surface_m(moment, game::FilmSpace::directionOf(cell)))));
    }
    return room;
}

TEST(Rooms, AreWhatTheProgramMakesOfTheFilms) {
    for (const std::string& dive : game::diveNames()) {
        const auto files = tests::valueOf(game::loadDiveFiles(dive));
        const Path film = dataRoot() / "content" / files.dive.video;
        const auto made = filmSpaceOf(film, 0);
        ASSERT_TRUE(made) << film;
        const Path file = game::roomFileOf(files.dive.video);
        if (std::getenv("SHOAL_UPDATE")) {
            ASSERT_TRUE(game::writeRoom(file, roomIn(*made, made->length_s()))) << file;
        }
        const auto kept = tests::valueOf(game::roomOf(files.dive.video));
        EXPECT_EQ((kept)->hash(), made->hash()) << file << ": SHOAL_UPDATE=1 writes it anew";
    }
}

TEST(GuideAnimal, TurnsOnItsOwnToTheRightOfTheMiddle) {
    GuideAnimal guide;
    const game::Snapshot viewer{.worldFromView = glm::angleAxis(0.7f, glm::vec3(0, 1, 0)),
                                .headWorld = {1, 2, 3},
                                .creatures = std::vector<game::CreatureView>(5)};
    const auto ahead = [&](const glm::vec2& tanHalf, float dt_s, bool turns) {
        const game::Snapshot& shown = guide.show(viewer, 3, {}, 2, tanHalf, dt_s, turns);
        EXPECT_EQ(shown.creatures.size(), 1u);
        const game::CreatureView& animal = shown.creatures[0];
        const glm::vec3 eye = glm::conjugate(viewer.worldFromView) * (animal.position - viewer.headWorld);
        const float half = -eye.z * tanHalf.x; // of the picture there
        EXPECT_LT(eye.x + animal.length, half) << "wholly in the picture";
        EXPECT_GT(eye.x - animal.length, -0.25f * half) << "beside the page";
        return animal.worldFromBody * glm::vec3(0, 0, 1);
    };
    const glm::vec3 first = ahead({1, 0.56f}, 0, true);
    EXPECT_EQ(ahead({0.5f, 1}, 1, false), first);
    EXPECT_LT(glm::dot(ahead({1, 0.56f}, 2, true), first), 0);
}

} // namespace
} // namespace shoal::app
