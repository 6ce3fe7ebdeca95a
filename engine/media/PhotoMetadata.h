// Facts that cameras and editors write beside a photo's pixels: how it is stored (EXIF), which part of the
// sphere it shows and how its camera was held (Google's Photo Sphere XMP, "GPano"), and its colours (ICC).
// Sources: CIPA DC-008; ISO 23008-12, 6.5 (AVIF); developers.google.com/streetview/spherical-metadata; ICC.1,
// annex B; Adobe's XMP specification, part 3.
#pragma once

#include "engine/media/SphericalMetadata.h"

#include <span>
#include <string>
#include <vector>

namespace shoal::media {

enum class PictureKind;

struct PhotoMetadata {
    int orientation = 1; // SphericalMetadata.h
    // Place of the upright picture in its panorama; empty: not stated, or ignored.
    std::optional<PanoramaPlacement> placement;
    bool placementIgnored = false; // it contradicts itself
    float heading_deg = 0, pitch_deg = 0, roll_deg = 0;
    std::vector<uint8_t> profile; // ICC, or made of a PNG's gAMA and cHRM; empty: none

    // Returns whether the photo states that it is a part of a panorama, and not all of it.
    bool isPart() const {
        return placement &&
               (placement->width < placement->fullWidth || placement->height < placement->fullHeight);
    }
    // Returns the rotation that makes the panorama's horizon level; both have the axes of env. Pitch lifts
    // the middle of the picture; positive roll has turned the horizon counterclockwise in it. The heading,
    // which tells where north is, is ignored: the middle of the picture stays ahead.
    glm::quat envFromPhoto() const;
    // Returns what is done for the orientation and the pose, a clause each after "; "; empty: nothing.
    std::string note() const;
};

// Reads the metadata of a JPEG, PNG, WebP or TIFF; of an AVIF only its orientation and colour profile; of
// other kinds nothing. bytes: the whole file.
PhotoMetadata photoMetadata(std::span<const uint8_t> bytes, PictureKind kind);

// Converts a picture in place to sRGB: relative colorimetric, with the black point of sRGB. profile: ICC,
// untrusted; of red, green and blue, or of grey where all pixels are grey. Empty: none. Returns what was
// done, a clause after "; "; empty: there is no profile, or it gives the colours of sRGB. A damaged one, or
// one of other components than the picture's, is ignored.
std::string convertToSrgb(std::span<const uint8_t> profile, ImageRgb8& picture);

// Returns a photo's layout if it is lat-long by shape and content or by metadata; Auto: an ordinary photo.
template <class Picture> Layout layoutOf(const Picture& photo, const PhotoMetadata& metadata) {
    const Layout layout = layoutOf(photo);
    return layout == Layout::Auto && metadata.placement ? Layout::Mono : layout;
}

} // namespace shoal::media
