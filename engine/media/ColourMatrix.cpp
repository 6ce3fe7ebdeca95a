#include "engine/media/ColourMatrix.h"

namespace shoal::media {

Luma lumaOf(ColourMatrix matrix) {
    switch (matrix) {
    case ColourMatrix::Bt709:
        return {0.2126, 0.0722};
    case ColourMatrix::Bt2020:
        return {0.2627, 0.0593};
    case ColourMatrix::Bt601:
        break;
    }
    return {0.299, 0.114};
}

const char* nameOf(ColourMatrix matrix) {
    constexpr const char* kNames[] = {"BT.601", "BT.709", "BT.2020"};
    return kNames[static_cast<int>(matrix)];
}

ColourMatrix colourMatrixOf(int code, int width, int height) {
    if (code == 1) return ColourMatrix::Bt709;
    if (code == 5 || code == 6) return ColourMatrix::Bt601;
    if (code == 9) return ColourMatrix::Bt2020;
    return width >= 1280 || height > 576 ? ColourMatrix::Bt709 : ColourMatrix::Bt601;
}

} // namespace shoal::media
