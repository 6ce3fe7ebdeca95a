// Pictures of all kinds: the header alone, then decoded under small limits.
#include "engine/media/Pictures.h"
#include "engine/media/Ffmpeg.h"
#include "engine/media/PictureHeader.h"
#include "tests/fuzz/Target.h"

#include <cmath>

using namespace shoal;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const fuzz::FileInput file("input");
    media::setUpDecoders();
    const auto header = media::readPictureHeader({data, size});
    if (!header) return 0;
    fuzz::expect(header->size.width > 0 && header->size.height > 0);
    const media::PictureLimits limits{256, 256};
    if (!media::isHdr(header->kind)) {
        (void)media::readPhoto(file({data, size}), limits);
        return 0;
    }
    const auto picture = media::readHdr(file({data, size}), limits);
    if (picture)
        for (const float value : picture->radianceLin.pixels)
            fuzz::expect(value >= 0 && value <= media::kMaxRadiance);
    return 0;
}
