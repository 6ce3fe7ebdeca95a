// Ticks of the simulation with any input at all: finite, bounded, and the same when played again.
#include "game/rules/Dive.h"
#include "tests/fuzz/Target.h"
#include "tests/playthrough/Rooms.h"

#include <glm/geometric.hpp>

#include <cmath>

using namespace shoal;
using fuzz::Bytes;

namespace {

// The hand before, a little or wholly changed.
void change(hands::HandPose& hand, Bytes& bytes) {
    const auto what = bytes.next<uint8_t>();
    hand.tracked = (what & 1) != 0;
    hand.solid = (what & 2) == 0;
    if (what & 4) hand.confidence = hand.grip = bytes.next<float>();
    if (what & 8) { // all of it moves
        const glm::vec3 by(bytes.next<int8_t>(), bytes.next<int8_t>(), bytes.next<int8_t>());
        for (hands::Joint& joint : hand.joints) joint.position += 0.004f * by;
    }
    if (what & 16) { // closes or opens
        const float share = static_cast<float>(bytes.next<uint8_t>()) / 255;
        for (int i = 2; i < hands::kJointCount; ++i)
            hand.joints[i].position = glm::mix(hand.joints[i].position, hand.joints[0].position, share);
        hand.grip = share;
    }
    if (what & 32) { // any bits in any joint
        hands::Joint& joint = hand.joints[bytes.next<uint8_t>() % hands::kJointCount];
        joint.position = bytes.next<glm::vec3>();
        joint.orientation = bytes.next<glm::quat>();
        joint.radius = bytes.next<float>();
    }
    if (what & 64) hand.time_us = bytes.next<int64_t>();
}

std::vector<game::TickInput> inputsFrom(Bytes bytes) {
    constexpr size_t kMaxTicks = 150;
    std::vector<game::TickInput> inputs;
    game::TickInput input;
    for (int h = 0; h < 2; ++h)
        for (int i = 0; i < hands::kJointCount; ++i) {
            const auto along = static_cast<float>(i);
            input.hands[h].joints[i].position = {h == 0 ? -0.2f : 0.2f, -0.1f + 0.01f * along,
                                                 -0.4f - 0.003f * along};
            input.hands[h].joints[i].radius = 0.01f;
        }
    while (!bytes.empty() && inputs.size() < kMaxTicks) {
        const auto what = bytes.next<uint8_t>();
        for (int h = 0; h < 2; ++h)
            if (what & (1 << h)) change(input.hands[h], bytes);
        if (what & 4) input.worldFromView = bytes.next<glm::quat>();
        if (what & 8) input.headWorld = bytes.next<glm::vec3>();
        input.pause = (what & 48) == 48;
        input.restart = (what & 192) == 192;
        const int ticks = 1 + bytes.next<uint8_t>() % 32;
        for (int i = 0; i < ticks; ++i) inputs.push_back(input);
    }
    return inputs;
}

bool isFinite(glm::vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void check(const game::DiveState& state) {
    constexpr float kFarthest_m = 60; // the whale comes from 40 m
    const auto swims = [](const game::Swimmer& swimmer) {
        fuzz::expect(isFinite(swimmer.position) && glm::length(swimmer.position) < kFarthest_m);
        fuzz::expect(std::fabs(glm::length(swimmer.forward) - 1) < 0.01f);
    };
    for (const game::Fish& fish : state.fish) {
        swims(fish);
        fuzz::expect(std::isfinite(fish.speed) && fish.heldBy >= -1 && fish.heldBy < 2);
    }
    swims(state.shark);
    for (const physics::Contact& contact : state.contacts) {
        fuzz::expect(contact.depth >= 0 && contact.depth < 1 && isFinite(contact.point));
        fuzz::expect(std::fabs(glm::length(contact.normal) - 1) < 0.01f);
        fuzz::expect(contact.closingSpeed >= 0 && std::isfinite(contact.closingSpeed));
    }
    for (const game::Hand& hand : {state.hands[0], state.hands[1]})
        for (const hands::Joint& joint : hand.joints) fuzz::expect(isFinite(joint.position));
}

uint64_t played(uint64_t seed, const std::vector<game::TickInput>& inputs, bool checked) {
    // With an odd seed in the room of its film.
    static const std::array<game::DiveFiles, 2> waters = [] {
        game::DiveFiles open = *game::loadDiveFiles("night"), film = open;
        film.dive.space = game::roomOf(film.dive.video).value();
        return std::array{open, film};
    }();
    const game::DiveFiles& files = waters[seed % 2];
    game::Dive dive(files.species, files.dive, seed);
    game::Events events;
    game::Snapshot snapshot;
    for (const game::TickInput& input : inputs) {
        std::array<uint8_t, game::kTickInputBytes> bytes;
        game::toBytes(input, bytes);
        events.clear();
        dive.step(game::fromBytes(bytes), events);
        if (!checked) continue;
        check(dive.state());
        dive.snapshot(snapshot);
    }
    return dive.stateHash();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    Bytes bytes(data, size);
    const uint64_t seed = bytes.next<uint8_t>();
    const std::vector<game::TickInput> inputs = inputsFrom(bytes);
    fuzz::expect(played(seed, inputs, true) == played(seed, inputs, false));
    return 0;
}
