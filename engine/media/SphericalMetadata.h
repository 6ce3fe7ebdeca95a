// Spherical metadata of videos and photos: projection, stereo layout, and the part of the sphere covered.
// Videos: Google's Spherical Video V1 (RDF text in moov.trak.uuid) and V2 (st3d and sv3d in the sample entry)
// in MP4, Projection and StereoMode in Matroska. Photos: Google's Photo Sphere XMP in JPEG.
// Sources: google/spatial-media docs/spherical-video-rfc.md and -v2-rfc.md; ISO/IEC 14496-12; RFC 9559.
#pragma once

#include "engine/core/Files.h"
#include "engine/media/Bytes.h"
#include "engine/media/StereoView.h"

#include <istream>
#include <optional>

struct AVStream;

namespace shoal::media {

enum class Projection { Unknown, Equirect, Cubemap, Mesh };

const char* nameOf(Projection projection);

struct SphericalMetadata {
    bool present = false; // the file states a projection or a stereo layout
    int version = 0;      // 1 or 2 of Google's, 0 for Matroska and where absent
    Projection projection = Projection::Unknown;
    Layout layout = Layout::Auto; // Auto: not stated

    // Fractions of the full sphere's width or height that are missing at each side (V2's equi, V1's
    // cropping), 0..1; all 0 for a full environment.
    float missingTop = 0, missingBottom = 0, missingLeft = 0, missingRight = 0;
};

// Of an MP4 or MOV file, given as a seekable stream of `size` bytes. A damaged or other file gives what could
// be found. Read here because libavformat 5.1 ignores sv3d without svhd, V1 without StitchingSoftware and
// V1's cropping. Bounded: sizes are clamped to the parent's, the number of boxes is limited.
SphericalMetadata mp4Metadata(std::istream& stream, uint64_t size);

// Of a Matroska or WebM video, as libavformat read it; fileBegin: the file's first bytes.
SphericalMetadata matroskaMetadata(const AVStream& stream, ByteSpan fileBegin);

// Pixels of the full equirectangular picture, and the part of it that the file holds, from the top left.
struct PanoramaPlacement {
    int fullWidth = 0, fullHeight = 0;
    int left = 0, top = 0, width = 0, height = 0;
};

// Of a JPEG photo. Nothing if the file cannot be read, does not state it, or contradicts itself.
std::optional<PanoramaPlacement> panoramaPlacement(const Path& file);

} // namespace shoal::media
