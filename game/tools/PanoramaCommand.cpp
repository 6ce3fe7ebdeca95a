// shoal panorama: grows an ordinary photo to a full environment.
#include "engine/core/WriteFile.h"
#include "game/tools/Commands.h"

#include "engine/environment/PhotoEnvironment.h"
#include "engine/media/Check.h"
#include "engine/media/Pictures.h"

#include <glm/gtc/quaternion.hpp>

#include <cstdio>

namespace shoal::app {

template <class Picture, class Write>
static Status convert(const PanoramaOptions& options, Picture photo, const media::PhotoMetadata& metadata,
                      Write&& write) {
    auto made = environment::environmentFrom(options.photo, std::move(photo), metadata,
                                             {.fov_deg = options.fov_deg, .full = options.full});
    if (!made) return made.error();
    const bool isMono = made->layout == media::Layout::Mono;
    if (glm::angle(made->envFromPhoto) > 0) // the file that is written does not state it
        made->what += isMono ? "; levelled" : "; not levelled, because it shows two eyes' pictures";
    Picture level;
    const Picture& out = isMono
                             ? environment::leftEyeOf(made->picture, made->layout, level, made->envFromPhoto)
                             : made->picture;
    if (Status s = write(options.out, out); !s) return s;
    std::printf("%s: %dx%d, %s\n", options.out.c_str(), made->picture.width, made->picture.height,
                made->what.c_str());
    return Done{};
}

Status panorama(const PanoramaOptions& options) {
    // Outputs are checked before the work, which takes seconds.
    if (media::writtenAs(options.out) == media::WrittenAs::Nothing)
        return Error{options.out, "is of no kind that can be written; use .png or .jpg, or .hdr, .exr or "
                                  ".pfm for a high dynamic range photo"};
    if (Status possible = checkOutputs(std::array{NamedFile{"--out", options.out}},
                                       std::array{NamedFile{"PHOTO", options.photo}});
        !possible)
        return possible;
    const auto kind = media::mediaKind(options.photo, options.layer);
    if (!kind) return kind.error();
    const bool isHdr = *kind == media::MediaKind::Hdr;
    const bool writesHdr = media::writtenAs(options.out) == media::WrittenAs::Hdr;
    if (isHdr && !writesHdr)
        return Error{options.out, "would lose the photo's high dynamic range; use .hdr, .exr or .pfm"};
    if (!isHdr && writesHdr)
        return Error{options.out, "is for high dynamic range, which this photo has not; use .png or .jpg"};
    if (!isHdr) {
        auto photo = media::readPhoto(options.photo);
        if (!photo) return photo.error();
        return convert(options, std::move(photo->picture), photo->metadata, media::writePicture);
    }
    auto read = media::readHdr(options.photo, {}, options.layer);
    if (!read) return read.error();
    return convert(options, std::move(read->radianceLin), {}, media::writeHdr);
}

} // namespace shoal::app
