#include "game/rules/TickInput.h"

#include <bit>
#include <cstring>

namespace shoal::game {

static_assert(std::endian::native == std::endian::little, "recordings are little-endian");

namespace {

// Visits every field in the order of the file; Put writes it, Take reads it.
template <class Visit, class Input> void visit(Input& input, Visit& io) {
    for (auto& hand : input.hands) {
        io.flag(hand.tracked);
        io.flag(hand.solid);
        io.number(hand.confidence);
        io.number(hand.grip);
        io.number(hand.pinch);
        io.time(hand.time_us);
        for (auto& joint : hand.joints) {
            for (int i = 0; i < 3; ++i) io.number(joint.position[i]);
            io.number(joint.orientation.w);
            io.number(joint.orientation.x);
            io.number(joint.orientation.y);
            io.number(joint.orientation.z);
            io.number(joint.radius);
        }
    }
    io.number(input.worldFromView.w);
    io.number(input.worldFromView.x);
    io.number(input.worldFromView.y);
    io.number(input.worldFromView.z);
    for (int i = 0; i < 3; ++i) io.number(input.headWorld[i]);
    io.flags(input.pause, input.restart);
}

struct Put {
    uint8_t* at;
    void number(float value) {
        std::memcpy(at, &value, sizeof value);
        at += sizeof value;
    }
    void time(int64_t value) {
        std::memcpy(at, &value, sizeof value);
        at += sizeof value;
    }
    void flag(bool value) { *at++ = value; }
    void flags(bool a, bool b) { *at++ = static_cast<uint8_t>((a ? 1 : 0) | (b ? 2 : 0)); }
};

struct Take {
    const uint8_t* at;
    void number(float& value) {
        std::memcpy(&value, at, sizeof value);
        at += sizeof value;
    }
    void time(int64_t& value) {
        std::memcpy(&value, at, sizeof value);
        at += sizeof value;
    }
    void flag(bool& value) { value = *at++ != 0; }
    void flags(bool& a, bool& b) {
        a = (*at & 1) != 0;
        b = (*at++ & 2) != 0;
    }
};

} // namespace

void toBytes(const TickInput& input, std::span<uint8_t, kTickInputBytes> out) {
    Put put{out.data()};
    visit(input, put);
}

TickInput fromBytes(std::span<const uint8_t, kTickInputBytes> bytes) {
    TickInput input;
    Take take{bytes.data()};
    visit(input, take);
    return input;
}

} // namespace shoal::game
