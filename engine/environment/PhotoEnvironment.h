// Makes a full environment of any photo, for all commands that take one.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Image.h"
#include "engine/core/Result.h"
#include "engine/media/Pictures.h"

#include <functional>
#include <optional>
#include <string>

namespace shoal::environment {

template <class Picture> struct PhotoEnvironment {
    Picture picture; // lat-long; unchanged if the photo was one
    media::Layout layout = media::Layout::Mono;
    glm::quat envFromPhoto{1, 0, 0, 0}; // levels the picture; both have the axes of env
    std::string what;                   // description of what was done: one clause, for a message to the user
};

struct PhotoOptions {
    std::optional<double> fov_deg;              // declares an ordinary photo with this field of view
    bool full = false;                          // panorama::PanoramaOptions::full
    media::Layout layout = media::Layout::Auto; // any other declares a full environment
    std::function<void(double)> progress;       // called with the share done, 0 to 1, while a photo is grown
};

// Returns the photo as an environment. A partial panorama, whose metadata (GPano) give its place, is put
// there and completed; a photo that is lat-long (media::layoutOf()) stays as it is; any other is
// extrapolated, which takes seconds and shows progress on a terminal. file: the photo's file.
template <class Picture> // ImageRgb8, or ImageRgbF of linear light
Result<PhotoEnvironment<Picture>> environmentFrom(const Path& file, Picture photo,
                                                  const media::PhotoMetadata& metadata,
                                                  const PhotoOptions& options);

// Returns the left eye's picture, turned as its file asks (each texel takes the nearest one). Returns
// `picture` if it needs no change; otherwise resizes and fills `made`, and returns it.
template <class Picture>
const Picture& leftEyeOf(const Picture& picture, media::Layout layout, Picture& made,
                         const glm::quat& envFromFilm = glm::quat(1, 0, 0, 0));

} // namespace shoal::environment
