// Spherical metadata: of a video's header (MP4 or Matroska) and of a photo's XMP.
#include "engine/media/Ffmpeg.h"
#include "engine/media/SphericalMetadata.h"
#include "tests/fuzz/Target.h"

using namespace shoal;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const fuzz::FileInput file("input");
    media::setUpDecoders();
    const Path& path = file({data, size});
    if (const auto placement = media::panoramaPlacement(path)) {
        fuzz::expect(placement->width > 0 && placement->left + placement->width <= placement->fullWidth);
        fuzz::expect(placement->height > 0 && placement->top + placement->height <= placement->fullHeight);
    }
    const bool matroska = size > 0 && data[0] == 0x1a;
    const media::Input input = media::openInput(path, matroska ? "matroska" : "mov");
    if (input && input->nb_streams > 0) (void)media::sphericalMetadata(*input, *input->streams[0], path);
    return 0;
}
