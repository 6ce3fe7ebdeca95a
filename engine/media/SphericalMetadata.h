// Stereo layouts of a frame, and their detection; and spherical metadata of videos and photos: projection,
// stereo layout, the part of the sphere covered, and how the sphere is turned. Videos: Google's Spherical
// Video V1 and V2 in MP4, Projection and StereoMode in Matroska, and V1 in its tags. Photos: Pictures.h.
// Sources: google/spatial-media docs/spherical-video-rfc.md and -v2-rfc.md; ISO/IEC 14496-12; RFC 9559.
#pragma once

#include "engine/core/EnumNames.h"
#include "engine/core/Files.h"
#include "engine/core/Image.h"

#include <glm/gtc/quaternion.hpp>

#include <array>
#include <optional>

struct AVFormatContext;
struct AVStream;

namespace shoal::media {

// Auto: to be detected, or unknown. The others name the left eye's half first.
enum class Layout { Auto, Mono, TopBottom, LeftRight, BottomTop, RightLeft };

// Part of a frame that one eye sees, pixels. The halves of an odd size are rounded down.
struct EyePart {
    int x = 0, y = 0, width = 0, height = 0;
};

// Returns an eye's part. eye: 0 left, 1 right. Both eyes see the whole of a mono frame. layout is not Auto.
EyePart eyePart(Layout layout, int eye, int width, int height);

// Guesses by the frame's shape alone, expecting 2:1 for each eye within 6 %: 2:1 is mono, 1:1 top-bottom, 4:1
// left-right. Auto if the shape is ambiguous (16:9 is used for all three).
Layout layoutFromShape(double width, double height);

// Detects the layout from a frame: two eyes see the same but for small shifts along the rows, the halves of
// one panorama do not. Compares halves in blocks that have structure. Mono if neither pair of halves is
// alike, or both are; Auto if nothing can be told: blank, a fade, plain water. frame: either channel order.
Layout layoutFromContent(const ImageRgb8& frame);

// Detects a still picture's layout by its shape and content: 2:1 is mono unless it shows two eyes' pictures
// squeezed; squares and 4:1 strips are as often ordinary pictures, so they must show two eyes. Auto: an
// ordinary picture. Two eyes are looked for in 8-bit pictures alone.
Layout layoutOf(const ImageRgb8& picture);
Layout layoutOf(const ImageRgbF& picture);

// --- Metadata

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
    // Returns what is done to the picture for its orientation, bounds and pose, a clause each after "; ";
    // empty: nothing.
    std::string note() const;
};

// Returns the rotation from the world into the picture, for an environment that is turned to the right by yaw
// too, radians. It has the same bits on every machine.
glm::quat filmFromWorld(const glm::quat& envFromFilm, float yaw);

// Reads a video's metadata from libavformat, and from the file what libavformat drops.
SphericalMetadata sphericalMetadata(const AVFormatContext& input, const AVStream& stream, const Path& file);
// Reads those of a file's first video; as if there were none, if it cannot be read.
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
// orientation is one of the eight ways in which a picture may be turned or mirrored, by its number in EXIF
// (CIPA DC-008, tag 274): 1 is upright, and from 5 on columns are stored as rows. Pictures: ImageRgb8 or
// ImageRgbF.

constexpr bool swapsSides(int orientation) { return orientation >= 5; }
std::string uprightNote(int orientation); // the clause for the person, after "; "; empty for 1

// Makes a stored picture upright; `upright` takes its size. Any number but 1 to 8 counts as 1.
template <class Picture> void makeUpright(const Picture& stored, int orientation, Picture& upright);

// Places each eye's picture in its bounds within `whole`, which keeps its size: the picture takes the size
// that fits. The rest of the sphere mirrors it, which is continuous everywhere around a centred half.
template <class Picture>
void placeInSphere(const Picture& upright, Layout layout, const SphereBounds& bounds, Picture& whole);

} // namespace shoal::media

template <>
inline constexpr std::array shoal::kEnumNames<shoal::media::Projection> = {
    "unknown", "lat-long", "a cube map", "a mesh", "of another projection"};

template <>
inline constexpr std::array shoal::kEnumNames<shoal::media::Layout> = {
    "auto", "mono", "top-bottom", "left-right", "bottom-top", "right-left"};
