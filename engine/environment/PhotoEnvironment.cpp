#include "engine/environment/PhotoEnvironment.h"

#include "engine/core/Log.h"
#include "engine/media/SphericalMetadata.h"
#include "engine/media/StereoView.h"
#include "engine/panorama/Panorama.h"

#include <algorithm>
#include <cstdio>
#include <unistd.h>

namespace shoal::environment {

namespace {

// Returns whether the picture is lat-long, mono or stereo. Squares and 4:1 strips have the shape of stereo
// pictures, but are as often ordinary photos, so their content must look like a stereo pair.
bool isLatLong(const ImageRgb8& picture) {
    const media::Layout shape = media::layoutFromShape(picture.width, picture.height);
    if (shape == media::Layout::Mono || shape == media::Layout::Auto) return shape == media::Layout::Mono;
    const media::Layout content = media::layoutFromContent(picture);
    return content == media::Layout::TopBottom || content == media::Layout::LeftRight;
}
bool isLatLong(const ImageRgbF& picture) {
    return media::layoutFromShape(picture.width, picture.height) == media::Layout::Mono;
}

} // namespace

template <class Picture>
Result<PhotoEnvironment<Picture>> environmentFrom(const Path& file, Picture photo,
                                                  std::optional<double> fov_deg,
                                                  const std::function<void(double)>& progress) {
    const auto placement = fov_deg ? std::nullopt : media::panoramaPlacement(file);
    if (placement && (placement->width < placement->fullWidth || placement->height < placement->fullHeight)) {
        const auto share = [](int pixels, int of) { return static_cast<double>(pixels) / of; };
        auto placed = panorama::completePanorama(
            photo,
            {share(placement->left, placement->fullWidth), share(placement->top, placement->fullHeight),
             share(placement->left + placement->width, placement->fullWidth),
             share(placement->top + placement->height, placement->fullHeight)});
        if (!placed) return Error{file.string(), placed.error().reason};
        return PhotoEnvironment<Picture>{
            std::move(*placed), "put where its metadata (GPano) says that it belongs, and completed"};
    }
    if (placement || (!fov_deg && isLatLong(photo)))
        return PhotoEnvironment<Picture>{std::move(photo), "a full environment already, kept as it is"};

    // The progress overwrites a line on a terminal; elsewhere it is one line of the log.
    const bool watched = isatty(STDERR_FILENO) == 1;
    if (!watched) log::info("growing {} to a full environment", file.string());
    int shown = -1;
    const auto show = [&](double share) {
        if (progress) progress(share);
        const int percent = static_cast<int>(share * 100);
        if (!watched || percent == shown) return;
        shown = percent;
        std::fprintf(stderr, "\rshoal: growing the photo to a full environment: %d %%", percent);
        std::fflush(stderr);
    };
    auto grown = panorama::panoramaFromPhoto(photo, {.fov_deg = fov_deg, .progress = show});
    if (watched) std::fputs("\r\033[K", stderr);
    if (!grown) return Error{file.string(), grown.error().reason};
    // The seam where the ends meet is hidden if its step is at most one level of 8 bits, or no larger than
    // the picture's usual steps.
    const bool hidden = grown->wrapStep <= std::max(grown->usualStep, 1 / 255.0);
    return PhotoEnvironment<Picture>{
        std::move(grown->latLong),
        fmt::format("grown around its light at pixel {:.0f}, {:.0f}, which stands {:.1f} degrees high in the "
                    "middle; the seam where its ends meet can{} be seen: its largest step is {:.2f} % of "
                    "white, and a tenth of the picture's own steps are above {:.2f} %",
                    grown->lightInPhoto.x, grown->lightInPhoto.y, grown->lightLatitude_deg,
                    hidden ? "not" : "", grown->wrapStep * 100, grown->usualStep * 100)};
}

template Result<PhotoEnvironment<ImageRgb8>> environmentFrom(const Path&, ImageRgb8, std::optional<double>,
                                                             const std::function<void(double)>&);
template Result<PhotoEnvironment<ImageRgbF>> environmentFrom(const Path&, ImageRgbF, std::optional<double>,
                                                             const std::function<void(double)>&);

} // namespace shoal::environment
