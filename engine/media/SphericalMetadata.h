// Spherical metadata of videos and photos: projection, stereo layout, the part of the sphere covered, and how
// the sphere is turned. Videos: Google's Spherical Video V1 and V2 in MP4, Projection and StereoMode in
// Matroska, and V1 in its tags. Photos: PhotoMetadata.h. Sources: google/spatial-media
// docs/spherical-video-rfc.md and -v2-rfc.md; ISO/IEC 14496-12; RFC 9559.
#pragma once

#include "engine/core/Files.h"
#include "engine/media/StereoView.h"

#include <glm/gtc/quaternion.hpp>

#include <optional>

struct AVFormatContext;
struct AVStream;

namespace shoal::media {

// Other: fisheyes and whatever else FFmpeg names.
enum class Projection { Unknown, Equirect, Cubemap, Mesh, Other };

// Shares of the sphere's width (left, right) and height beyond the edges of an eye's picture, 0 to 1.
struct SphereBounds {
    double left = 0, top = 0, right = 0, bottom = 0;

    bool isWhole() const { return left + top + right + bottom == 0; }
    double width() const { return 1 - left - right; }
    double height() const { return 1 - top - bottom; }
};

struct SphericalMetadata {
    Projection projection = Projection::Unknown;
    Layout layout = Layout::Auto; // Auto: not stated
    SphereBounds bounds;
    bool boundsIgnored = false;        // the bounds were such that no picture could be placed in them
    glm::quat envFromFilm{1, 0, 0, 0}; // turns the film's sphere as it demands; both have the axes of env
    int orientation = 1;               // of the stored pictures: see below

    bool isStated() const { return projection != Projection::Unknown || layout != Layout::Auto; }
    // Returns what is done for orientation, bounds and pose, a clause each after "; "; empty: nothing.
    std::string note() const;
};

// Returns the rotation from the world into the picture, for an environment that is turned to the right by yaw
// too, radians. It has the same bits on every machine.
glm::quat filmFromWorld(const glm::quat& envFromFilm, float yaw);

// Reads a video's metadata from libavformat, and from the file those that libavformat drops.
SphericalMetadata sphericalMetadata(const AVFormatContext& input, const AVStream& stream, const Path& file);
// Reads the metadata of a file's first video; returns the defaults if the file cannot be read.
SphericalMetadata sphericalMetadata(const Path& file);

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

// --- How a stored picture becomes one of the whole sphere: upright, then each eye's part in its place. An
// orientation is one of the eight ways in which a picture may be turned or mirrored, by EXIF's number (CIPA
// DC-008, tag 274): 1 is upright, and from 5 on columns are stored as rows. Pictures: ImageRgb8 or ImageRgbF.

constexpr bool swapsSides(int orientation) { return orientation >= 5; }
std::string uprightNote(int orientation); // the clause for the person, after "; "; empty for 1

// Makes a stored picture upright; `upright` takes its size.
template <class Picture> void makeUpright(const Picture& stored, int orientation, Picture& upright);

// Places each eye's picture in its bounds within `whole`, which keeps its size: the picture takes the size
// that fits. The rest of the sphere mirrors it, which is continuous everywhere around a centred half.
template <class Picture>
void placeInSphere(const Picture& upright, Layout layout, const SphereBounds& bounds, Picture& whole);

} // namespace shoal::media

template <>
inline constexpr std::array shoal::kEnumNames<shoal::media::Projection> = {
    "unknown", "lat-long", "a cube map", "a mesh", "of another projection"};
