// Where a photo lies in the full surround, if it says so: Google's Photo Sphere XMP ("GPano") in a JPEG.
#pragma once

#include "engine/core/Files.h"

#include <optional>

namespace shoal::media {

// Pixels of the full lat-long picture, and the part of it that the file holds, from the top left.
struct PanoramaPlacement {
    int fullWidth = 0, fullHeight = 0;
    int left = 0, top = 0, width = 0, height = 0;
    double heading_deg = 0; // compass heading of the full picture's centre column; 0 if not stated
};

// Nothing if the file cannot be read, does not say, or says what cannot be (part larger than the whole).
std::optional<PanoramaPlacement> panoramaPlacement(const Path& file);

} // namespace shoal::media
