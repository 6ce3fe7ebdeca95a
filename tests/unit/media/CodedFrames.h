// Frames of panoramas, coded by the formulas of the standards: PQ, HLG and SDR of BT.2020.
#pragma once

#include "engine/math/Colour.h"
#include "engine/media/FrameConverter.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace shoal::media {

// Columns: ITU-R BT.2087, table 1.
inline const glm::dmat3 kTo2020(0.6274, 0.0691, 0.0164, 0.3293, 0.9195, 0.0880, 0.0433, 0.0114, 0.8956);

// The inverse EOTF of SMPTE ST 2084, of 0 to 1.
inline double pqOf(double light) {
    const double power = std::pow(light, 0.1593017578125);
    return std::pow((0.8359375 + 18.8515625 * power) / (1 + 18.6875 * power), 78.84375);
}

// Codes light of Rec. 709 primaries.
inline glm::dvec3 codesOf(const glm::dvec3& light709, AVColorTransferCharacteristic transfer) {
    glm::dvec3 c = kTo2020 * light709;
    if (transfer == AVCOL_TRC_SMPTE2084) {
        for (int i = 0; i < 3; ++i) c[i] = pqOf(c[i] * 203 / 10000);
    } else if (transfer == AVCOL_TRC_ARIB_STD_B67) { // BT.2100: the inverse OOTF, then the OETF
        c *= 0.203;
        c *= std::pow(std::max(glm::dot(c, {0.2627, 0.6780, 0.0593}), 1e-9), 1 / 1.2 - 1);
        for (int i = 0; i < 3; ++i)
            c[i] = c[i] <= 1.0 / 12 ? std::sqrt(3 * c[i])
                                    : 0.17883277 * std::log(12 * c[i] - 0.28466892) + 0.55991073;
    } else {
        for (int i = 0; i < 3; ++i) c[i] = math::srgbFromLinear(c[i]);
    }
    return glm::clamp(c, 0.0, 1.0);
}

// Returns a frame of zeros, since av_write_image_line2() sets bits.
inline Frame blankFrame(AVPixelFormat format, int width, int height) {
    Frame frame = makeFrame();
    frame->format = format;
    frame->width = width, frame->height = height;
    if (av_frame_get_buffer(frame.get(), 0) != 0) std::abort();
    for (const AVBufferRef* buffer : frame->buf)
        if (buffer) std::memset(buffer->data, 0, buffer->size);
    return frame;
}

struct Filmed {
    ImageRgb8 bgr;
    ImageRgbF light;
};

// Codes a panorama, of which 1 / exposure is white, as a frame of limited range and of BT.2020, and converts
// it.
inline Filmed filmed(const ImageRgbF& panorama, AVPixelFormat as, AVColorTransferCharacteristic transfer,
                     double exposure = 1) {
    const int width = panorama.width, height = panorama.height;
    const Frame frame = blankFrame(as, width, height);
    const AVPixFmtDescriptor& format = *av_pix_fmt_desc_get(as);
    const bool isRgb = format.flags & AV_PIX_FMT_FLAG_RGB;
    std::vector<glm::dvec3> pixels;
    for (size_t i = 0; i < panorama.pixels.size(); i += 3) {
        const float* t = &panorama.pixels[i];
        pixels.push_back(codesOf(exposure * glm::dvec3(t[0], t[1], t[2]), transfer));
    }
    for (int c = 0; c < 3; ++c) {
        const bool isDifference = c > 0 && !isRgb;
        const int across = isDifference ? 1 << format.log2_chroma_w : 1,
                  down = isDifference ? 1 << format.log2_chroma_h : 1, depth = format.comp[c].depth;
        std::vector<uint16_t> codes;
        for (int y = 0; y < height; y += down) {
            codes.clear();
            for (int x = 0; x < width; x += across) {
                glm::dvec3 rgb(0);
                for (int i = 0; i < across * down; ++i)
                    rgb += pixels[(y + i / across) * width + x + i % across] / double(across * down);
                const double luma = glm::dot(rgb, {0.2627, 0.6780, 0.0593});
                const double code = isRgb    ? rgb[c] * ((1 << depth) - 1)
                                    : c == 0 ? std::ldexp(16 + 219 * luma, depth - 8)
                                    : c == 1 ? std::ldexp(128 + 224 * (rgb.b - luma) / 1.8814, depth - 8)
                                             : std::ldexp(128 + 224 * (rgb.r - luma) / 1.4746, depth - 8);
                codes.push_back(static_cast<uint16_t>(std::lround(code)));
            }
            av_write_image_line2(codes.data(), frame->data, frame->linesize, &format, 0, y / down, c,
                                 static_cast<int>(codes.size()), sizeof(uint16_t));
        }
    }
    Filmed out;
    const FrameColour colour =
        colourOf(AV_CODEC_ID_HEVC, {AVCOL_SPC_BT2020_NCL, AVCOL_PRI_BT2020, transfer}, width, height);
    if (!FrameConverter().convert(*frame, colour, out.bgr, &out.light)) std::abort();
    return out;
}

} // namespace shoal::media
