#include "engine/environment/PhotoEnvironment.h"

#include "engine/core/Log.h"
#include "engine/math/LatLong.h"
#include "engine/panorama/Panorama.h"

#include <algorithm>
#include <cstdio>
#include <unistd.h>
#include <utility>

namespace shoal::environment {

namespace {

template <class Picture>
Result<PhotoEnvironment<Picture>> placed(const Path& file, const Picture& photo,
                                         const media::PhotoMetadata& metadata) {
    const media::PanoramaPlacement& p = *metadata.placement;
    const auto share = [](int pixels, int of) { return static_cast<double>(pixels) / of; };
    auto whole = panorama::completePanorama(photo, {share(p.left, p.fullWidth), share(p.top, p.fullHeight),
                                                    share(p.left + p.width, p.fullWidth),
                                                    share(p.top + p.height, p.fullHeight)});
    if (!whole) return Error{file.string(), whole.error().reason};
    return PhotoEnvironment<Picture>{
        .picture = std::move(*whole),
        .envFromPhoto = metadata.envFromPhoto(),
        .what = "put where its metadata (GPano) says that it belongs, and completed"};
}

template <class Picture>
Result<PhotoEnvironment<Picture>> grown(const Path& file, const Picture& photo, const PhotoOptions& options) {
    const bool watched = isatty(STDERR_FILENO) == 1; // a terminal's line can be overwritten
    if (!watched) log::info("growing {} to a full environment", file.string());
    int shown = -1;
    auto full = panorama::panoramaFromPhoto(
        photo, {.fov_deg = options.fov_deg, .full = options.full, .progress = [&](double share) {
                    const auto percent = static_cast<int>(share * 100);
                    if (watched && percent != std::exchange(shown, percent))
                        std::fprintf(stderr, "\rshoal: growing the photo to a full environment: %d %%",
                                     percent);
                    if (options.progress) options.progress(share);
                }});
    if (watched) std::fputs("\r\033[K", stderr);
    if (!full) return Error{file.string(), full.error().reason};
    return PhotoEnvironment<Picture>{
        .picture = std::move(full->latLong),
        .what = fmt::format(
            "grown around its light at pixel {:.0f}, {:.0f}, which stands {:.1f} degrees high in the middle",
            full->lightInPhoto.x, full->lightInPhoto.y, full->lightLatitude_deg)};
}

} // namespace

template <class Picture>
Result<PhotoEnvironment<Picture>> environmentFrom(const Path& file, Picture photo,
                                                  const media::PhotoMetadata& metadata,
                                                  const PhotoOptions& options) {
    if (options.fov_deg) return grown(file, photo, options);
    media::Layout layout = options.layout;
    if (metadata.isPart() && layout == media::Layout::Auto) return placed(file, photo, metadata);
    if (layout == media::Layout::Auto) layout = media::layoutOf(photo, metadata);
    if (layout == media::Layout::Auto) return grown(file, photo, options);
    return PhotoEnvironment<Picture>{std::move(photo), layout, metadata.envFromPhoto(),
                                     "a full environment already, kept as it is"};
}

template <class Picture>
const Picture& leftEyeOf(const Picture& picture, media::Layout layout, Picture& made,
                         const glm::quat& envFromFilm) {
    const media::EyePart part = media::eyePart(layout, 0, picture.width, picture.height);
    const bool turns = glm::angle(envFromFilm) > 0;
    if (!turns && part.width == picture.width && part.height == picture.height) return picture;
    const glm::dmat3 filmFromEnv = glm::transpose(glm::mat3_cast(glm::dquat(envFromFilm)));
    made.fit(part.width, part.height);
    for (int y = 0; y < part.height; ++y) {
        if (!turns) std::copy_n(picture.at(part.x, part.y + y), 3 * part.width, made.at(0, y));
        for (int x = 0; turns && x < part.width; ++x) {
            const glm::dvec2 at =
                latLongFromDirection(filmFromEnv * texelDirection<double>(x, y, part.width, part.height));
            const int column = std::min(static_cast<int>(at.x * part.width), part.width - 1);
            const int row = std::min(static_cast<int>(at.y * part.height), part.height - 1);
            std::copy_n(picture.at(part.x + column, part.y + row), 3, made.at(x, y));
        }
    }
    return made;
}

template const ImageRgb8& leftEyeOf(const ImageRgb8&, media::Layout, ImageRgb8&, const glm::quat&);
template const ImageRgbF& leftEyeOf(const ImageRgbF&, media::Layout, ImageRgbF&, const glm::quat&);
template Result<PhotoEnvironment<ImageRgb8>>
environmentFrom(const Path&, ImageRgb8, const media::PhotoMetadata&, const PhotoOptions&);
template Result<PhotoEnvironment<ImageRgbF>>
environmentFrom(const Path&, ImageRgbF, const media::PhotoMetadata&, const PhotoOptions&);

} // namespace shoal::environment
