// Somebody with a mouse and nothing but the picture: points at a fish, clicks when the hand is there.
#include "game/rules/ReachHelp.h"
#include "input/hands/MouseHands.h"
#include "tests/playthrough/Play.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <cmath>

namespace shoal::game {
namespace {

TEST(MousePlay, CatchesFishWithPointingAndClicking) {
    const auto files = loadDiveFiles((dataRoot() / "tests/playthrough/dive/cove.toml").string());
    ASSERT_TRUE(files) << files.error().message();
    auto rig = hands::HandRig::load(dataRoot() / "content/models/hand_skeleton.json");
    ASSERT_TRUE(rig) << rig.error().message();
    int maximum = 0, sum = 0;
    for (uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
        Dive dive(files->species, files->dive, seed);
        hands::MouseHands mouse(*rig);
        hands::MouseInput pointer;
        ReachHelp reach;
        Snapshot now;
        Events events;
        TickInput input;
        dive.snapshot(now);
        int target = -1, since = 0, held = 0;
        const float tanY = std::tan(0.5f * pointer.fovY), tanX = tanY * pointer.aspect;
        for (int tick = 0; tick < 90 * 120; ++tick) {
            // The nearest fish well inside the view and within reach; another one every three seconds.
            if (!pointer.close && (target < 0 || ++since > 360)) {
                since = 0;
                target = -1;
                float best = 10;
                for (const CreatureView& c : now.creatures) {
                    const glm::vec3 p = c.position;
                    const float distance = glm::length(p);
                    if (files->species[c.species].shark || c.gait.motion != Motion::Swim || p.z > -0.3f)
                        continue;
                    if (std::fabs(p.x) > -0.8f * tanX * p.z || std::fabs(p.y) > -0.8f * tanY * p.z) continue;
                    if (distance < best && distance < 1.4f) best = distance, target = static_cast<int>(c.id);
                }
            }
            if (target >= 0) {
                const glm::vec3 p = now.creatures[target].position;
                // As people point: leading a moving thing, fast from afar, slower as it comes near; at most
                // two half screens a second.
                const glm::vec3 soon = p + now.creatures[target].velocity * 0.2f;
                const glm::vec2 aim(soon.x / -soon.z / tanX, soon.y / -soon.z / tanY);
                const glm::vec2 error = aim - pointer.cursor;
                const float length = glm::length(error), step = std::min(2.0f, 4 * length + 0.05f) / 120;
                pointer.cursor += length > step ? error * (step / length) : error;
                const glm::vec3 ray =
                    glm::normalize(glm::vec3(pointer.cursor.x * tanX, pointer.cursor.y * tanY, -1));
                pointer.reach_m = reach.update(now, files->species, ray, mouse.distance_m());
                const glm::vec3 grasp = hands::graspCentre(now.hands[1].joints);
                if (!pointer.close && glm::distance(grasp, p) < 0.07f) pointer.close = true, held = 0;
            }
            if (pointer.close && ++held > 170) pointer.close = false, target = -1;
            input.hands = mouse.update(pointer, sim::kTick_s);
            events.clear();
            dive.step(input, events);
            dive.snapshot(now);
        }
        std::printf("seed %d: %d caught, %d lost, %d points\n", static_cast<int>(seed), now.caught, now.lost,
                    now.score);
        EXPECT_GE(now.caught, 5) << "seed " << seed;
        maximum = std::max(maximum, now.caught);
        sum += now.caught;
    }
    EXPECT_LT(maximum, 60);
    // As hard as a game should be: 11 to 15 catches in a dive; single dives differ by a third, the mean of
    // eight by an eighth.
    EXPECT_GE(sum, 8 * 9);
    EXPECT_LE(sum, 8 * 17);
}

} // namespace
} // namespace shoal::game
