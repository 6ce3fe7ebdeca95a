// Makes a full environment of any photo, for all commands that take one.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Image.h"
#include "engine/core/Result.h"

#include <functional>
#include <optional>
#include <string>

namespace shoal::environment {

template <class Picture> struct PhotoEnvironment {
    Picture picture;  // lat-long; unchanged if the photo was one
    std::string what; // description of what was done: one clause, for a message to the user
};

// Returns the photo as an environment. A partial panorama, whose metadata (GPano) give its place, is put
// there and completed; a photo that is lat-long (mono or stereo) by its shape and content stays as it is; any
// other is extrapolated, which takes seconds and shows progress on a terminal. fov_deg: declares an ordinary
// photo with this field of view. file: the photo's file.
template <class Picture> // ImageRgb8, or ImageRgbF of linear light
Result<PhotoEnvironment<Picture>> environmentFrom(const Path& file, Picture photo,
                                                  std::optional<double> fov_deg,
                                                  const std::function<void(double)>& progress = {});

} // namespace shoal::environment
