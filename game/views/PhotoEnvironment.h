// From any photo to a full environment, for all commands that take one.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Image.h"
#include "engine/core/Result.h"

#include <functional>
#include <optional>
#include <string>

namespace shoal::app {

template <class Picture> struct PhotoEnvironment {
    Picture picture;  // lat-long; as it came if it was that already
    std::string what; // one clause on what was done: for a person to read
};

// A photo that says where it belongs (GPano) is put there and completed; one that is lat-long, mono or
// stereo, by its shape and content stays as it is; another is grown, which takes seconds and shows its
// progress on a terminal. fov_deg, where given, means that it is an ordinary photo, whatever it looks like.
// file: where it was read from.
template <class Picture> // ImageRgb8, or ImageRgbF of linear light
Result<PhotoEnvironment<Picture>> environmentFrom(const Path& file, Picture photo,
                                                  std::optional<double> fov_deg,
                                                  const std::function<void(double)>& progress = {});

} // namespace shoal::app
