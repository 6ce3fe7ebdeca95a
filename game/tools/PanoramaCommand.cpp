// shoal panorama: grows an ordinary photo to a full environment.
#include "engine/core/WriteFile.h"
#include "game/tools/Commands.h"

#include "engine/environment/PhotoEnvironment.h"
#include "engine/media/Pictures.h"

#include <cstdio>

namespace shoal::app {

namespace {

bool isHdrName(const Path& file) { return media::writtenAs(file) == media::WrittenAs::Hdr; }

template <class Picture, class Write>
Result<std::string> convert(const PanoramaOptions& options, Result<Picture> photo, Write&& write) {
    if (!photo) return photo.error();
    auto made = environment::environmentFrom(options.photo, std::move(*photo), options.fov_deg);
    if (!made) return made.error();
    if (Status s = write(options.out, made->picture); !s) return s.error();
    return std::to_string(made->picture.width) + "x" + std::to_string(made->picture.height) + ", " +
           made->what;
}

Result<std::string> makePanorama(const PanoramaOptions& options) {
    // Outputs are checked before the work, which takes seconds.
    if (media::writtenAs(options.out) == media::WrittenAs::Nothing)
        return Error{options.out, "is of no kind that can be written; use .png or .jpg, or .hdr, .exr or "
                                  ".pfm for a high dynamic range photo"};
    if (Status possible = checkOutputs(std::array{NamedFile{"--out", options.out}},
                                       std::array{NamedFile{"PHOTO", options.photo}});
        !possible)
        return possible.error();
    if (isHdrName(options.photo) && !isHdrName(options.out))
        return Error{options.out, "would lose the photo's high dynamic range; use .hdr, .exr or .pfm"};
    if (!isHdrName(options.photo) && isHdrName(options.out))
        return Error{options.out, "is for high dynamic range, which this photo has not; use .png or .jpg"};
    if (!isHdrName(options.photo) && options.layer.empty())
        return convert(options, media::readPicture(options.photo), media::writePicture);
    auto read = media::readHdr(options.photo, {}, options.layer);
    return convert(options, read ? Result<ImageRgbF>(std::move(read->radianceLin)) : read.error(),
                   media::writeHdr);
}

} // namespace

Status panorama(const PanoramaOptions& options) {
    const auto made = makePanorama(options);
    if (!made) return made.error();
    std::printf("%s: %s\n", options.out.c_str(), made->c_str());
    return Done{};
}

} // namespace shoal::app
