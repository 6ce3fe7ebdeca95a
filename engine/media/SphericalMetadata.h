// What a video file says of its own shape: Google's Spherical Video V1 (an RDF text in moov.trak.uuid) and
// V2 (st3d, sv3d in the video's sample entry) in MP4, Matroska's Projection in WebM.
// Sources: google/spatial-media docs/spherical-video-rfc.md and -v2-rfc.md; ISO/IEC 14496-12; RFC 9559.
//
// Nothing in the file is trusted: sizes are clamped to the parent's, depth and number of boxes are limited,
// only headers and the few small boxes below are read.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"
#include "engine/media/StereoView.h"

#include <istream>

namespace shoal::media {

enum class Projection { Unknown, Equirect, Cubemap, Mesh };

const char* nameOf(Projection projection);

struct SphericalMetadata {
    bool present = false; // the file says something of projection or stereo
    int version = 0;      // 1 or 2 of Google's, 0 for WebM and where absent
    Projection projection = Projection::Unknown;
    Layout layout = Layout::Auto; // Auto: not stated

    // How the camera stood (V2's prhd, Matroska's pose): degrees to undo, as stated. Yaw counter-clockwise
    // about up, pitch about right upwards, roll clockwise about forward. V1 has none.
    float yaw_deg = 0, pitch_deg = 0, roll_deg = 0;

    // Parts of the full sphere's width or height that the picture lacks at each side (V2's equi, V1's
    // cropping), 0..1; all 0 for a full surround.
    float missingTop = 0, missingBottom = 0, missingLeft = 0, missingRight = 0;

    // Stated by the container whether or not it is spherical; 0 if unknown.
    int frameWidth = 0, frameHeight = 0;
    double shown_s = 0; // MP4: length of the video track after its edit list
};

// Error only if the file cannot be read; a damaged or other file gives what could be found.
Result<SphericalMetadata> readSphericalMetadata(const Path& file);

// The same of a seekable stream of so many bytes.
SphericalMetadata sphericalMetadataOf(std::istream& stream, uint64_t size);

} // namespace shoal::media
