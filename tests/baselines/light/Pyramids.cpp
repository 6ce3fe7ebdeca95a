#include "tests/baselines/light/Baselines.h"

#include "engine/core/Vectorise.h"
#include "engine/light/Pyramid.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace shoal::light::baselines {

namespace {

constexpr int kAskedWidth = 1024;

// Turns a row of coded bytes into radiance; scales: as many floats as there are pixels.
SHOAL_VECTORISE
void expandRow(const uint8_t* __restrict coded, int width, bool bgr, float* __restrict scales,
               float* __restrict out) {
    for (int i = 0; i < 3 * width; ++i) out[i] = static_cast<float>(coded[i]) * (1.0f / 255);
    const float first = bgr ? 0.11f : 0.30f, last = bgr ? 0.30f : 0.11f;
    for (int x = 0; x < width; ++x) { // radianceFromDisplay()
        const float l = first * out[3 * x] + 0.59f * out[3 * x + 1] + last * out[3 * x + 2];
        const float l2 = l * l, l4 = l2 * l2;
        scales[x] = 10.0f * l4 * l4 * l2 + 1.8f;
    }
    for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c) out[3 * x + c] *= scales[x];
}

// Adds means of kFactor texels side by side to sum.
template <int kFactor>
SHOAL_VECTORISE void addNarrowed(const float* __restrict in, int width, float share, float* __restrict sum) {
    for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c)
            for (int i = 0; i < kFactor; ++i) sum[3 * x + c] += share * in[3 * (kFactor * x + i) + c];
}

// Does the same for widths that do not divide: means of the texels that begin within, one at least.
void addAnyNarrowed(const float* in, int inWidth, int width, float share, float* sum) {
    for (int x = 0; x < width; ++x, sum += 3) {
        const int left = x * inWidth / width, right = std::max(left + 1, (x + 1) * inWidth / width);
        const float part = share / static_cast<float>(right - left);
        for (int i = left; i < right; ++i)
            for (int c = 0; c < 3; ++c) sum[c] += part * in[3 * i + c];
    }
}

void addRow(const float* in, int inWidth, int width, float share, float* sum) {
    if (inWidth == width)
        addNarrowed<1>(in, width, share, sum);
    else if (inWidth == 2 * width)
        addNarrowed<2>(in, width, share / 2, sum);
    else
        addAnyNarrowed(in, inWidth, width, share, sum);
}

// Shrinks by plain means. rowOf(y): row y of the input, which is inWidth x inHeight.
template <class RowOf> void shrink(int inWidth, int inHeight, RowOf&& rowOf, ImageRgbF& out) {
    std::fill(out.pixels.begin(), out.pixels.end(), 0.0f);
    for (int y = 0; y < out.height; ++y) {
        const int top = y * inHeight / out.height,
                  bottom = std::max(top + 1, (y + 1) * inHeight / out.height);
        for (int row = top; row < bottom; ++row)
            addRow(rowOf(row), inWidth, out.width, 1.0f / static_cast<float>(bottom - top), out.at(0, y));
    }
}

struct State {
    PyramidMaker maker;
    ImageRgb8 half;
    std::vector<float> row, scales;

    FrameView halved(const FrameView& frame, bool mean) {
        half.fit(frame.width / 2, frame.height / 2);
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
        row.resize(static_cast<size_t>(frame.width) * 3);
        scales.resize(static_cast<size_t>(frame.width));
        const auto expanded = [&](int y) {
            expandRow(frame.pixels + y * frame.rowStride, frame.width, frame.bgr, scales.data(), row.data());
            return row.data();
        };
        size_t k = 0;
        for (int width = baseWidthFor(frame.width, kAskedWidth); width >= 2; width /= 2, ++k) {
            if (out.levels.size() <= k) out.levels.emplace_back();
            out.levels[k].fit(width, width / 2);
            if (k == 0) {
                shrink(frame.width, frame.height, expanded, out.levels[0]);
                if (frame.bgr) // the blue ahead of the red
                    for (size_t i = 0; i < out.levels[0].pixels.size(); i += 3)
                        std::swap(out.levels[0].pixels[i], out.levels[0].pixels[i + 2]);
            } else {
                const ImageRgbF& before = out.levels[k - 1];
                shrink(
                    before.width, before.height, [&](int y) { return before.at(0, y); }, out.levels[k]);
            }
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
             source != PyramidSource::Whole ? Role::Baseline
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

} // namespace shoal::light::baselines
