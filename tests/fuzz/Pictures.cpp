// Pictures of all kinds: the header alone, then decoded under small limits.
#include "engine/media/Pictures.h"
#include "engine/media/Ffmpeg.h"
#include "engine/media/PictureHeader.h"
#include "tests/fuzz/Target.h"

using namespace shoal;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const fuzz::FileInput file("input");
    media::setUpDecoders();
    const Path& path = file({data, size});
    if (const auto header = media::readPictureHeader({data, size}))
        fuzz::expect(header->size.width > 0 && header->size.height > 0);
    const media::PictureLimits limits{256, 256};
    const auto photo = media::readPhoto(path, limits);
    if (photo) {
        const ImageRgb8& picture = photo->picture;
        fuzz::expect(picture.pixels.size() ==
                     size_t{3} * static_cast<size_t>(picture.width * picture.height));
    }
    const auto light = media::readHdr(path, limits);
    if (light)
        for (const float value : light->radianceLin.pixels)
            fuzz::expect(value >= 0 && value <= media::kMaxRadiance);
    fuzz::expect((photo || !photo.error().reason.empty()) && (light || !light.error().reason.empty()));
    fuzz::taken += photo || light;
    return 0;
}
