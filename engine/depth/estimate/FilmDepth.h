// Makes the depth track of a film: from its two eyes where it has them, else from the camera's own movement.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Image.h"
#include "engine/media/StereoView.h"

#include <functional>

namespace shoal::depth {

struct FilmDepthOptions {
    media::Layout layout = media::Layout::Auto;
    double baseline_m = 0.064; // between the eyes of a stereo film
    // The scale of a mono film cannot be seen. The median height of the camera over what lies below it is
    // taken for this, once for the whole film,
    double height_m = 1.6;
    double speed_mPerS = 0; // or, where it is above 0, the median speed of the camera for this.
    Path preview;           // a picture of the film's middle and its depth, side by side; empty: none
    std::function<void(double share)> progress;
};

enum class FilmDepth { Written, CannotBeKnown };

// Results per frame are kept in OUT.part until the track is written; an interrupted run goes on from there.
// CannotBeKnown: the film has one eye and its camera stands still or only turns, or of all frames together
// less than a fiftieth of the sphere is believed. Nothing is written then.
Result<FilmDepth> makeFilmDepth(const Path& film, const Path& out, const FilmDepthOptions& options);

} // namespace shoal::depth
