#include "engine/media/ColourMatrix.h"

#include <cmath>

namespace shoal::media {

namespace {

// Luma's weights of red and blue; green has the rest.
struct Luma {
    double red, blue;
};

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

} // namespace

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

// With Y = Kr R + Kg G + Kb B, Cb = (B - Y) / (2 - 2 Kb), Cr = (R - Y) / (2 - 2 Kr) (BT.601, BT.709 item 3):
// the decoded (R, G, B) gives back Y, Cb, Cr by BT.601's weights; the actual weights k then mean
//   R' = Y + (2 - 2 kr) Cr,  B' = Y + (2 - 2 kb) Cb,  G' = (Y - kr R' - kb B') / kg.
std::array<float, 9> correctionBgr(ColourMatrix actual) {
    const Luma from = lumaOf(ColourMatrix::Bt601), to = lumaOf(actual);
    const double y[3] = {from.blue, 1 - from.red - from.blue, from.red}; // over (B, G, R)
    const double stretchBlue = (1 - to.blue) / (1 - from.blue), stretchRed = (1 - to.red) / (1 - from.red);
    double rows[3][3];
    for (int i = 0; i < 3; ++i) {
        const double blue = y[i] + stretchBlue * ((i == 0) - y[i]);
        const double red = y[i] + stretchRed * ((i == 2) - y[i]);
        rows[0][i] = blue;
        rows[1][i] = (y[i] - to.red * red - to.blue * blue) / (1 - to.red - to.blue);
        rows[2][i] = red;
    }
    std::array<float, 9> matrix{};
    for (int row = 0; row < 3; ++row) {
        double others = 0;
        for (int i = 0; i < 3; ++i)
            if (i != row) {
                const double rounded = std::round(rows[row][i] * 1024) / 1024;
                matrix[static_cast<size_t>(3 * row + i)] = static_cast<float>(rounded);
                others += rounded;
            }
        matrix[static_cast<size_t>(4 * row)] = static_cast<float>(1 - others);
    }
    return matrix;
}

} // namespace shoal::media
