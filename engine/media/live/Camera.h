// Video4Linux cameras, through OpenCV.
#pragma once

#include "engine/media/live/LiveFeed.h"

#include <string>
#include <vector>

namespace shoal::media {

// Cannot be interrupted while the camera is silent: OpenCV waits for ten seconds.
LiveFeed cameraFeed(const CameraAddress& address);

struct CameraListed {
    int index = 0;
    std::string name;
};
// As the system lists them; none is opened.
std::vector<CameraListed> listCameras();

} // namespace shoal::media
