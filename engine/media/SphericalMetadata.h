// Spherical metadata of videos and photos: projection, stereo layout, and the part of the sphere covered.
// Videos: Google's Spherical Video V1 and V2 in MP4, Projection and StereoMode in Matroska. Photos: Google's
// Photo Sphere XMP in JPEG.
// Sources: google/spatial-media docs/spherical-video-rfc.md and -v2-rfc.md; ISO/IEC 14496-12; RFC 9559.
#pragma once

#include "engine/core/Files.h"
#include "engine/media/StereoView.h"

#include <optional>

struct AVFormatContext;
struct AVStream;

namespace shoal::media {

enum class Projection { Unknown, Equirect, Cubemap, Mesh };

struct SphericalMetadata {
    bool present = false; // the file states a projection or a stereo layout
    Projection projection = Projection::Unknown;
    Layout layout = Layout::Auto; // Auto: not stated
    bool partial = false;         // a part of the sphere is missing
};

// Reads a video's metadata from libavformat, and from the file what libavformat drops.
SphericalMetadata sphericalMetadata(const AVFormatContext& input, const AVStream& stream, const Path& file);

// Size of the full equirectangular picture, and the part that the file holds; pixels from the top left.
struct PanoramaPlacement {
    int fullWidth = 0, fullHeight = 0;
    int left = 0, top = 0, width = 0, height = 0;
};

// Reads a JPEG photo's placement; empty if the file cannot be read, does not state it, or contradicts itself.
std::optional<PanoramaPlacement> panoramaPlacement(const Path& file);

} // namespace shoal::media
