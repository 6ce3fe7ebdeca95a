// Cameras, through OpenCV.
#pragma once

#include "engine/media/live/LiveFeed.h"

#include <string>
#include <vector>

namespace shoal::media {

// address: "camera:0" and so on. Does not let itself be interrupted while the camera is silent: OpenCV waits
// for ten seconds.
LiveFeed cameraFeed(const CameraAddress& address);

struct CameraListed {
    int index = 0;
    std::string name;
};
// As the system lists them, without opening any.
std::vector<CameraListed> listCameras();

} // namespace shoal::media
