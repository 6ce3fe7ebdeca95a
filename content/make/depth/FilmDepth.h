// Makes the depth track of a film: from its two eyes where it has them, else from the camera's own movement.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Image.h"
#include "engine/media/StereoView.h"

#include <functional>

namespace shoal::depth {

struct FilmDepthOptions {
    media::Layout layout = media::Layout::Auto;
    double baseline_m = 0.064; // distance between the eyes of a stereo film
    // A mono film does not show its scale. One scale for the whole film makes the camera's median height over
    // the surfaces below it height_m or, if speed_mPerS is above 0, the camera's median speed speed_mPerS.
    double height_m = 1.6;
    double speed_mPerS = 0;
    Path preview; // receives a picture of the film's middle beside its depth; empty: none
    std::function<void(double share)> progress;
};

enum class FilmDepth { Written, CannotBeKnown };

// Results per frame are kept in OUT.part until the track is written; an interrupted run goes on from there.
// Returns CannotBeKnown, and writes nothing, if the film has one eye and its camera stands still or only
// turns, or if less than a fiftieth of the sphere, in the mean of all frames, is believed.
Result<FilmDepth> makeFilmDepth(const Path& film, const Path& out, const FilmDepthOptions& options);

} // namespace shoal::depth
