// All input of one tick. Nothing else enters the simulation from outside.
#pragma once

#include "engine/scene/HandPose.h"

#include <array>
#include <cstdint>
#include <span>

namespace shoal::game {

constexpr float kHeadReach_m = 10; // a head position farther out, or not finite, is ignored

struct TickInput {
    std::array<hands::HandPose, 2> hands{}; // left, right; viewer's frame
    glm::quat worldFromView{1, 0, 0, 0};
    glm::vec3 headWorld{0}; // between the eyes; within kHeadReach_m of the origin
    bool pause = false;     // held: the tick changes nothing but `paused`
    bool restart = false;   // on the tick it becomes true: a new dive with the next seed
};

// The input as bytes for a Recording: little-endian floats, fixed size.
constexpr size_t kTickInputBytes = 2 * (3 * 4 + 2 + 8 + hands::kJointCount * 8 * 4) + 7 * 4 + 1;
void toBytes(const TickInput&, std::span<uint8_t, kTickInputBytes> out);
TickInput fromBytes(std::span<const uint8_t, kTickInputBytes>);

} // namespace shoal::game
