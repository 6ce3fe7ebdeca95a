// Kinds of files, and metadata: of a video's header (MP4 or Matroska), and of photos, with their profiles.
#include "engine/media/Check.h"
#include "engine/media/Ffmpeg.h"
#include "engine/media/PictureHeader.h"
#include "tests/fuzz/Target.h"

using namespace shoal;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const fuzz::FileInput file("input");
    media::setUpDecoders();
    const Path& path = file({data, size});
    (void)media::mediaKind(path);
    if (const auto kind = media::pictureKind({data, size})) {
        const media::PhotoMetadata photo = media::photoMetadata({data, size}, *kind);
        (void)photo.note();
        fuzz::expect(photo.orientation >= 1 && photo.orientation <= 8);
        if (const auto& placement = photo.placement) {
            fuzz::expect(placement->width > 0 && placement->left + placement->width <= placement->fullWidth);
            fuzz::expect(placement->height > 0 &&
                         placement->top + placement->height <= placement->fullHeight);
        }
        ImageRgb8 picture(2, 1);
        (void)media::convertToSrgb(photo.profile, picture);
    }
    const bool matroska = size > 0 && data[0] == 0x1a;
    const media::Input input = media::openInput(path, matroska ? "matroska" : "mov");
    if (input && input->nb_streams > 0) (void)media::sphericalMetadata(*input, *input->streams[0], path);
    return 0;
}
