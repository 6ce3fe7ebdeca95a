// Finds both hands in the pictures of a webcam by learned landmarks, and follows them.
#pragma once

#include "engine/core/Files.h"
#include "input/hands/HandRig.h"
#include "input/hands/webcam/HandFinder.h"

#include <memory>

namespace shoal::hands {

// folder: where get_models puts the models.
Result<std::unique_ptr<HandFinder>> makeLandmarkFinder(const Path& folder, const HandRig& rig);

} // namespace shoal::hands
