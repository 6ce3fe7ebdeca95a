#include "game/views/CreatureModels.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace shoal::app {
namespace {

constexpr double kPicture_s = 1.0 / 60;

// A room white at 1 m all around, except behind the viewer, where it is black.
struct HalfWhiteRoom {
    depth::LightDifference light;
    HalfWhiteRoom() {
        depth::DepthMap map;
        map.inverse = Image<uint8_t, 1>(256, 128);
        std::ranges::fill(map.inverse.pixels,
                          static_cast<uint8_t>(depth::DepthMap::kSteps * depth::kNearest_m));
        ImageRgbF radiance(64, 32);
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 64; ++x) std::fill_n(radiance.at(x, y), 3, x >= 16 && x < 48 ? 1.0f : 0.0f);
        light.make(radiance, map);
    }
};

struct Swim {
    HalfWhiteRoom room;
    AnimalLight light;
    game::Snapshot shown;

    explicit Swim(size_t animals) { shown.creatures.resize(animals); }
    void picture() {
        light.follow(shown, &room.light, glm::mat3(1));
        shown.time_s += kPicture_s;
    }
    glm::vec3 even(size_t animal) const { return (*light.of(animal))[0]; }
    glm::vec3 evenAt(const glm::vec3& place) const { return room.light.at(place)[0]; }
};

const glm::vec3 kAhead(0, 0, -0.5f);

TEST(AnimalLight, WithoutDistancesIsTheCameras) {
    AnimalLight light;
    game::Snapshot shown;
    shown.creatures.resize(2);
    light.follow(shown, nullptr, glm::mat3(1));
    EXPECT_EQ(light.of(0), nullptr);
}

TEST(AnimalLight, NewAnimalsHaveTheLightOfTheirPlaceAtOnce) {
    Swim swim(6); // more animals than are updated in each picture
    for (auto& animal : swim.shown.creatures) animal.position = kAhead;
    swim.picture();
    ASSERT_NE(swim.evenAt(kAhead), glm::vec3(0));
    for (size_t i = 0; i < 6; ++i) EXPECT_EQ(swim.even(i), swim.evenAt(kAhead)) << i;
}

TEST(AnimalLight, FollowsEveryAnimalWithoutAStep) {
    Swim swim(6);
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

TEST(AnimalLight, FollowsAnAnimalThatComesInElsewhere) {
    Swim swim(6);
    swim.picture();
    swim.picture();
    swim.shown.creatures[5].position = {0, 0, -0.7f}; // in a sixtieth of a second
    swim.picture();
    EXPECT_EQ(swim.even(5), swim.evenAt({0, 0, -0.7f}));
}

} // namespace
} // namespace shoal::app
