// Hands as the service sends them: real recordings where the reference data is, and made-up ones.
#pragma once

#include "engine/core/Files.h"
#include "input/hands/HandRig.h"

#include <optional>
#include <string>
#include <vector>

namespace shoal::hands::test {

// Returns data/hands/leap/NAME.json below $SHOAL_SHARED or ../shared beside the sources; it may not exist.
Path sharedRecording(const std::string& name);

// Returns the messages of a recording as they went over the socket; rows packed by a schema are unpacked.
std::vector<std::string> readRecordingMessages(const Path& file);

// One frame of a hand posed by the rig, in the Leap's desk frame and millimetres, as a service of that
// protocol version would send it: joints from 5 on, everything at 6, mere fingertips before.
struct MadeHand {
    Side side = Side::Right;
    int64_t id = 1;
    HandPose pose;                    // device's frame, metres
    std::optional<glm::vec3> elbow{}; // device's frame, metres; sent at 6
};
std::string madeFrame(int version, int64_t id, int64_t time_us, const std::vector<MadeHand>& hands);

// Returns a right hand over the device that closes, stays closed and opens again, 100 frames a second.
std::vector<MadeHand> closingHand(const HandRig& rig, int frames, float amplitude = 1);
std::vector<std::string> closingRecording(const HandRig& rig, int version, int frames);

} // namespace shoal::hands::test
