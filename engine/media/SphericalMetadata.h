// Spherical metadata of videos and photos: projection, stereo layout, and the part of the sphere covered.
// Videos: Google's Spherical Video V1 and V2 in MP4, Projection and StereoMode in Matroska. Photos:
// PhotoMetadata.h.
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

// Returns the text of <name>value</name> or name="value" in XMP; empty if absent. Single values need no XML
// parser, which hostile entities could attack.
std::string_view xmpValue(std::string_view xmp, const std::string& name);

// Reads the placement from XMP whose names begin with `space`; empty if it is missing or contradicts itself.
std::optional<PanoramaPlacement> placementIn(std::string_view xmp, const std::string& space);

} // namespace shoal::media
