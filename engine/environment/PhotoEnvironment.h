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
    std::string what; // what was done, one clause for a person to read
};

// Returns the photo as an environment. A photo whose metadata (GPano) tell its place is put there and
// completed; one that is lat-long, mono or stereo, by shape and content stays as it is; any other is grown,
// which takes seconds and shows its progress on a terminal. fov_deg, if given, declares an ordinary photo.
// file: the photo's file.
template <class Picture> // ImageRgb8, or ImageRgbF of linear light
Result<PhotoEnvironment<Picture>> environmentFrom(const Path& file, Picture photo,
                                                  std::optional<double> fov_deg,
                                                  const std::function<void(double)>& progress = {});

} // namespace shoal::environment
