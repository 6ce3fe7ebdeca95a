// Hands from a webcam, or from a clip of one, on a thread of their own.
#pragma once

#include "input/hands/HandFrame.h"
#include "input/hands/HandRig.h"

#include <memory>

namespace shoal::hands {

struct WebcamOptions {
    std::string file; // a clip; empty: the camera
    int index = 0;    // which camera, as the system counts them
    bool live = true; // a clip keeps its own rate; else it waits for whoever takes its frames
};

class WebcamHands {
  public:
    // A camera that is not there, or goes, is tried again every second until this dies.
    WebcamHands(const WebcamOptions& options, const HandRig& rig);
    WebcamHands(WebcamHands&&) noexcept;
    WebcamHands& operator=(WebcamHands&&) noexcept;
    ~WebcamHands();

    static constexpr const char* kName = "Webcam";
    HandStream& stream();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace shoal::hands
