// Sends one known pulse through the real hidapi, then silence; run below umockdev, which checks the bytes.
#include "input/haptics/Rack.h"

#include <cstdio>

int main() {
    using namespace shoal::haptics;
    Rack rack(hidapiBus());
    HapticFrame frame;
    frame.actuators[0] = {1, 40};
    rack.step(frame, 0);
    for (const std::string& complaint : rack.takeComplaints())
        std::fprintf(stderr, "%s\n", complaint.c_str());
    if (rack.ready() != 1) {
        std::fprintf(stderr, "%zu devices instead of one\n", rack.ready());
        return 1;
    }
    frame.actuators[0] = {1, 250};
    rack.step(frame, 0.1);
    return rack.ready() == 1 ? 0 : 1;
}
