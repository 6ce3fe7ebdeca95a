// The hand tracker of a webcam, or of a clip of one.
#pragma once

#include "input/hands/HandRig.h"
#include "input/hands/HandTracker.h"

#include <memory>

namespace shoal::hands {

struct WebcamOptions {
    std::string file; // a clip; empty: the camera
    int index = 0;    // which camera, as the system counts them
    bool live = true; // a clip keeps its own rate; else it waits for whoever takes its frames
};

// A camera that is not there, or goes, is tried again every second.
std::unique_ptr<HandTracker> makeWebcamTracker(const WebcamOptions& options, const HandRig& rig);

} // namespace shoal::hands
