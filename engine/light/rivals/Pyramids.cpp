#include "engine/light/rivals/Rivals.h"

#include "engine/light/InverseToneMap.h"
#include "engine/light/Pyramid.h"
#include "engine/light/Vectorise.h"

#include <memory>

namespace shoal::light::rivals {

namespace {

constexpr int kAskedWidth = 1024;

// Coded bytes, red first, to radiance.
SHOAL_VECTORISE
void expandRow(const uint8_t* __restrict coded, int width, float* __restrict out) {
    for (int x = 0; x < width; ++x) {
        const float r = static_cast<float>(coded[3 * x]) / 255,
                    g = static_cast<float>(coded[3 * x + 1]) / 255,
                    b = static_cast<float>(coded[3 * x + 2]) / 255;
        const glm::vec3 radiance = radianceFromDisplay({r, g, b});
        out[3 * x] = radiance.x;
        out[3 * x + 1] = radiance.y;
        out[3 * x + 2] = radiance.z;
    }
}

// Plain means of width x height source texels each; where sizes do not divide, of those that begin within
// (one at least).
void shrink(const ImageRgbF& in, ImageRgbF& out) {
    for (int y = 0; y < out.height; ++y) {
        const int top = y * in.height / out.height;
        const int bottom = std::max(top + 1, (y + 1) * in.height / out.height);
        for (int x = 0; x < out.width; ++x) {
            const int left = x * in.width / out.width;
            const int right = std::max(left + 1, (x + 1) * in.width / out.width);
            float sum[3] = {};
            for (int row = top; row < bottom; ++row) {
                const float* texel = in.at(left, row);
                for (int column = left; column < right; ++column, texel += 3)
                    for (int c = 0; c < 3; ++c) sum[c] += texel[c];
            }
            const float share = 1.0f / static_cast<float>((right - left) * (bottom - top));
            for (int c = 0; c < 3; ++c) out.at(x, y)[c] = sum[c] * share;
        }
    }
}

struct State {
    PyramidMaker maker;
    ImageRgb8 half;
    ImageRgbF whole;

    FrameView halved(const FrameView& frame, bool mean) {
        if (half.width != frame.width / 2 || half.height != frame.height / 2)
            half = ImageRgb8(frame.width / 2, frame.height / 2);
        for (int y = 0; y < half.height; ++y) {
            const uint8_t* top = frame.pixels + 2 * y * frame.rowStride;
            const uint8_t* bottom = top + frame.rowStride;
            uint8_t* out = half.at(0, y);
            for (int x = 0; x < half.width; ++x, top += 6, bottom += 6, out += 3)
                for (int c = 0; c < 3; ++c)
                    out[c] =
                        mean ? static_cast<uint8_t>((top[c] + top[c + 3] + bottom[c] + bottom[c + 3] + 2) / 4)
                             : top[c];
        }
        return {half.pixels.data(), half.width, half.height, ptrdiff_t{3} * half.width, frame.bgr};
    }

    void plain(const FrameView& frame, RadiancePyramid& out) {
        if (whole.width != frame.width || whole.height != frame.height)
            whole = ImageRgbF(frame.width, frame.height);
        for (int y = 0; y < frame.height; ++y)
            expandRow(frame.pixels + y * frame.rowStride, frame.width, whole.at(0, y));
        size_t k = 0;
        for (int width = baseWidthFor(frame.width, kAskedWidth); width >= 2; width /= 2, ++k) {
            if (out.levels.size() <= k) out.levels.emplace_back();
            if (out.levels[k].width != width) out.levels[k] = ImageRgbF(width, width / 2);
            shrink(k ? out.levels[k - 1] : whole, out.levels[k]);
        }
        out.levels.resize(k);
    }
};

} // namespace

PyramidMethod pyramidFrom(PyramidSource source, bool weighted) {
    auto state = std::make_shared<State>();
    const std::string from = source == PyramidSource::Whole         ? "the whole frame"
                             : source == PyramidSource::HalfDropped ? "every second texel"
                                                                    : "a frame of half the size";
    return {{(weighted ? "solid-angle weighted, from " : "plain means, from ") + from, "", "",
             weighted ? "engine/light" : "thesis, section 4.1",
             source != PyramidSource::Whole ? Role::Rival
             : weighted                     ? Role::Default
                                            : Role::Thesis},
            [=](const FrameView& frame, RadiancePyramid& out) {
                const FrameView view = source == PyramidSource::Whole
                                           ? frame
                                           : state->halved(frame, source == PyramidSource::HalfMean);
                if (weighted)
                    state->maker.make(view, kAskedWidth, out);
                else
                    state->plain(view, out);
            }};
}

} // namespace shoal::light::rivals
