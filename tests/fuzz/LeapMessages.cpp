// Messages of a hand tracker's service, a line each, to hands as the game takes them.
#include "input/hands/HandFilter.h"
#include "input/hands/leap/LeapMessage.h"
#include "tests/fuzz/Target.h"

#include <glm/geometric.hpp>

#include <cmath>

using namespace shoal;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const hands::HandRig rig = *hands::HandRig::load(dataRoot() / "content/models/hand_skeleton.json");
    hands::LeapTracks tracks(rig, hands::kDeskMount);
    std::string_view rest(reinterpret_cast<const char*>(data), size);
    int64_t time_us = 0;
    while (!rest.empty()) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(rest.size(), line.size() + 1));
        const auto message = hands::readLeapMessage(line);
        const auto* frame = message ? std::get_if<hands::LeapFrame>(&*message) : nullptr;
        if (!frame) continue;
        const hands::HandFrame seen = tracks.frame(*frame, frame->time_us.value_or(time_us += 10'000));
        for (const hands::HandPose& hand : seen.hands)
            if (hand.tracked)
                for (const hands::Joint& joint : hand.joints) {
                    fuzz::expect(glm::length(joint.position) < 100);
                    fuzz::expect(std::fabs(glm::length(joint.orientation) - 1) < 0.01f);
                }
    }
    return 0;
}
