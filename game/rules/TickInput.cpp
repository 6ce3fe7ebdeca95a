#include "game/rules/TickInput.h"

#include <bit>
#include <cstring>
#include <type_traits>

namespace shoal::game {

static_assert(std::endian::native == std::endian::little, "recordings are little-endian");

namespace {

// Visits every field but the flags of the last byte, in the order of the file.
template <class Input, class Visit> void visit(Input& input, Visit&& io) {
    const auto vector = [&](auto& v) { io(v.x), io(v.y), io(v.z); };
    const auto quaternion = [&](auto& q) { io(q.w), io(q.x), io(q.y), io(q.z); };
    for (auto& hand : input.hands) {
        io(hand.tracked);
        io(hand.solid);
        io(hand.confidence);
        io(hand.grip);
        io(hand.pinch);
        io(hand.time_us);
        for (auto& joint : hand.joints) {
            vector(joint.position);
            quaternion(joint.orientation);
            io(joint.radius);
        }
    }
    quaternion(input.worldFromView);
    vector(input.headWorld);
}

} // namespace

void toBytes(const TickInput& input, std::span<uint8_t, kTickInputBytes> out) {
    uint8_t* at = out.data();
    visit(input, [&](const auto& value) {
        std::memcpy(at, &value, sizeof value);
        at += sizeof value;
    });
    *at = static_cast<uint8_t>((input.pause ? 1 : 0) | (input.restart ? 2 : 0));
}

TickInput fromBytes(std::span<const uint8_t, kTickInputBytes> bytes) {
    TickInput input;
    const uint8_t* at = bytes.data();
    visit(input, [&]<class T>(T& value) {
        if constexpr (std::is_same_v<T, bool>)
            value = *at != 0; // a file may hold any byte
        else
            std::memcpy(&value, at, sizeof value);
        at += sizeof value;
    });
    input.pause = (*at & 1) != 0;
    input.restart = (*at & 2) != 0;
    return input;
}

} // namespace shoal::game
