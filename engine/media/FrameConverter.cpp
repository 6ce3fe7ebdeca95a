#include "engine/media/FrameConverter.h"

#include "engine/core/Vectorise.h"
#include "engine/math/Colour.h"

#include <fmt/core.h>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace shoal::media {

// --- Colours

constexpr double kWhite_cdM2 = 203;    // ITU-R BT.2408
constexpr double kHlgPeak_cdM2 = 1000; // nominal, which makes gamma 1.2: BT.2100, table 5
constexpr double kPqPeak_cdM2 = 10000; // SMPTE ST 2084
constexpr glm::vec3 kLuminance2020{0.2627f, 0.6780f, 0.0593f}; // BT.2020

template <class F> static std::vector<float> tableOf(F&& valueAt) {
    std::vector<float> table(kLightCodes);
    for (size_t i = 0; i < table.size(); ++i)
        table[i] = static_cast<float>(valueAt(static_cast<double>(i) / (kLightCodes - 1)));
    return table;
}

// Returns the light by code, 0 to 1; the scene's for HLG.
static const std::vector<float>& lightByCode(Transfer transfer) {
    static const std::array<std::vector<float>, 3> tables = {tableOf(math::linearFromSrgb<double>),
                                                             tableOf(lightFromPq), tableOf(sceneFromHlg)};
    return tables[static_cast<size_t>(transfer)];
}

// Returns the matrix from linear light of these primaries to Rec. 709's. White stays white.
static glm::mat3 toRec709(AVColorPrimaries primaries) {
    const auto xyzOf = [](AVColorPrimaries of) {
        const AVColorPrimariesDesc& known = *av_csp_primaries_desc_from_id(of);
        const auto xyz = [](const AVCIExy& c) {
            const double x = av_q2d(c.x), y = av_q2d(c.y);
            return glm::dvec3(x, y, 1 - x - y);
        };
        glm::dmat3 matrix(xyz(known.prim.r), xyz(known.prim.g), xyz(known.prim.b));
        const glm::dvec3 white = glm::inverse(matrix) * xyz(known.wp);
        for (int c = 0; c < 3; ++c) matrix[c] *= white[c];
        return matrix;
    };
    const glm::dmat3 matrix = glm::inverse(xyzOf(AVCOL_PRI_BT709)) * xyzOf(primaries);
    const glm::dvec3 white = matrix * glm::dvec3(1);
    return {matrix[0] / white, matrix[1] / white, matrix[2] / white};
}

double lightFromPq(double code) {
    constexpr double kM1 = 2610.0 / 16384, kM2 = 2523.0 / 4096 * 128;
    constexpr double kC1 = 3424.0 / 4096, kC2 = 2413.0 / 4096 * 32, kC3 = 2392.0 / 4096 * 32;
    const double root = std::pow(code, 1 / kM2);
    return kPqPeak_cdM2 / kWhite_cdM2 * std::pow(std::max(root - kC1, 0.0) / (kC2 - kC3 * root), 1 / kM1);
}

double sceneFromHlg(double code) {
    constexpr double kA = 0.17883277, kB = 1 - 4 * kA;
    const double c = 0.5 - kA * std::log(4 * kA);
    return code <= 0.5 ? code * code / 3 : (std::exp((code - c) / kA) + kB) / 12;
}

double hlgGain(double luminance) { return kHlgPeak_cdM2 / kWhite_cdM2 * std::pow(luminance, 0.2); }

ColourMatrix matrixOf(AVCodecID codec, AVColorSpace stated, int width, int height) {
    if (codec == AV_CODEC_ID_MJPEG || stated == AVCOL_SPC_BT470BG || stated == AVCOL_SPC_SMPTE170M)
        return ColourMatrix::Bt601;
    if (stated == AVCOL_SPC_BT709) return ColourMatrix::Bt709;
    if (stated == AVCOL_SPC_BT2020_NCL) return ColourMatrix::Bt2020;
    return width >= 1280 || height > 576 ? ColourMatrix::Bt709 : ColourMatrix::Bt601;
}

Luma lumaOf(ColourMatrix matrix) {
    const AVLumaCoefficients* luma = av_csp_luma_coeffs_from_avcsp(static_cast<AVColorSpace>(matrix));
    return {av_q2d(luma->cr), av_q2d(luma->cb)};
}

const char* nameOf(ColourMatrix matrix) {
    return matrix == ColourMatrix::Bt709 ? "BT.709" : matrix == ColourMatrix::Bt601 ? "BT.601" : "BT.2020";
}

FrameColour colourOf(AVCodecID codec, const StatedColour& stated, int width, int height) {
    FrameColour colour{matrixOf(codec, stated.matrix, width, height)};
    if (stated.matrix == AVCOL_SPC_BT2020_CL || stated.matrix == AVCOL_SPC_ICTCP)
        colour.decodable = Error{"", fmt::format("codes its colours as {}, which cannot be shown; convert it",
                                                 av_color_space_name(stated.matrix))};
    const AVPixFmtDescriptor* format = av_pix_fmt_desc_get(stated.format);
    const bool isGrey = format && format->nb_components < 3 && stated.range == AVCOL_RANGE_UNSPECIFIED;
    colour.fullRange = stated.range == AVCOL_RANGE_JPEG || codec == AV_CODEC_ID_MJPEG || isGrey ||
                       (format && std::string_view(format->name).starts_with("yuvj"));
    if (stated.transfer == AVCOL_TRC_SMPTE2084) colour.transfer = Transfer::Pq;
    if (stated.transfer == AVCOL_TRC_ARIB_STD_B67) colour.transfer = Transfer::Hlg;
    const AVColorPrimaries primaries = stated.primaries;
    const bool isWide = primaries == AVCOL_PRI_BT2020 || primaries == AVCOL_PRI_SMPTE432;
    if (colour.transfer == Transfer::Sdr) {
        if (isWide) colour.primaries = primaries;
        return colour;
    }
    // FFmpeg 5 reads beyond its table at the code that follows the last.
    const bool isKnown = primaries < AVCOL_PRI_NB && av_csp_primaries_desc_from_id(primaries);
    colour.primaries = isKnown ? primaries : AVCOL_PRI_BT2020;
    if (stated.matrix == AVCOL_SPC_UNSPECIFIED) colour.matrix = ColourMatrix::Bt2020;
    return colour;
}

// --- Conversion

namespace {

constexpr int kMaxLightSide = 1024; // twice what a video's light is made from
constexpr int kBands = 32;          // parts of a picture, which threads share

// Returns whether each component is a whole number that lies within its row.
bool canRead(const AVFrame& frame, const AVPixFmtDescriptor& format) {
    constexpr uint64_t kOthers = AV_PIX_FMT_FLAG_HWACCEL | AV_PIX_FMT_FLAG_BAYER | AV_PIX_FMT_FLAG_FLOAT;
    const int kind = frame.format;
    if (format.flags & kOthers || kind == AV_PIX_FMT_MONOWHITE || kind == AV_PIX_FMT_XYZ12LE ||
        kind == AV_PIX_FMT_XYZ12BE || (format.flags & AV_PIX_FMT_FLAG_PAL && !frame.data[1]))
        return false;
    for (int c = 0; c < format.nb_components; ++c) {
        const AVComponentDescriptor& part = format.comp[c];
        const int64_t width = AV_CEIL_RSHIFT(frame.width, c == 1 || c == 2 ? format.log2_chroma_w : 0);
        const int bits = part.shift + part.depth; // of the bytes that are read
        const int64_t end = format.flags & AV_PIX_FMT_FLAG_BITSTREAM
                                ? (width * part.step + part.offset + 7) / 8
                                : (width - 1) * part.step + part.offset +
                                      (bits > 16  ? 4
                                       : bits > 8 ? 2
                                                  : 1);
        if (part.depth > 16 || !frame.data[part.plane] || end > std::abs(frame.linesize[part.plane]))
            return false;
    }
    return true;
}

// Spreads codes over 2^across pixels each.
SHOAL_VECTORISE
void spread(const uint16_t* __restrict codes, int across, int width, float* __restrict out) {
    if (across == 0) // without a gather
        for (int x = 0; x < width; ++x) out[x] = static_cast<float>(codes[x]);
    else
        for (int x = 0; x < width; ++x) out[x] = static_cast<float>(codes[x >> across]);
}

// Returns the index of the table's value at `share`, 0 to 1.
inline int indexOf(float share) {
    return static_cast<int>(std::clamp(share, 0.0f, 1.0f) * static_cast<float>(kLightCodes - 1) + 0.5f);
}

SHOAL_VECTORISE
void lookUp(const float* __restrict table, int width, float* __restrict channel) {
    for (int x = 0; x < width; ++x) channel[x] = table[indexOf(channel[x])];
}

// Turns the scene's light to the display's.
SHOAL_VECTORISE
void applyHlgGain(const float* __restrict table, int width, float* __restrict red, float* __restrict green,
                  float* __restrict blue) {
    for (int x = 0; x < width; ++x) {
        const float gain = table[indexOf(
            std::sqrt(kLuminance2020.r * red[x] + kLuminance2020.g * green[x] + kLuminance2020.b * blue[x]))];
        red[x] *= gain, green[x] *= gain, blue[x] *= gain;
    }
}

// Results are `least` or more.
SHOAL_VECTORISE
void applyMatrix(const glm::mat4x3& m, float least, int width, float* __restrict red, float* __restrict green,
                 float* __restrict blue) {
    for (int x = 0; x < width; ++x) {
        const float a = red[x], b = green[x], c = blue[x];
        red[x] = std::max(m[0][0] * a + m[1][0] * b + m[2][0] * c + m[3][0], least);
        green[x] = std::max(m[0][1] * a + m[1][1] * b + m[2][1] * c + m[3][1], least);
        blue[x] = std::max(m[0][2] * a + m[1][2] * b + m[2][2] * c + m[3][2], least);
    }
}

inline uint8_t byteOf(float share) {
    return static_cast<uint8_t>(std::clamp(share, 0.0f, 1.0f) * 255.0f + 0.5f);
}

SHOAL_VECTORISE
void writeCodes(const float* __restrict red, const float* __restrict green, const float* __restrict blue,
                int width, uint8_t* __restrict bgr) {
    for (int x = 0; x < width; ++x) {
        bgr[3 * x] = byteOf(blue[x]);
        bgr[3 * x + 1] = byteOf(green[x]);
        bgr[3 * x + 2] = byteOf(red[x]);
    }
}

// Codes light of 0 to 1 as sRGB: srgbFromLinear() of shaders/light/ToneCurve.glsl, within 0.18 / 255.
inline uint8_t srgbByteOf(float light) {
    const float s = std::sqrt(light);
    return byteOf(s * (0.0327055681f + s * (3.14826007f + s * 363.2628457f)) /
                  (1.0f + s * (-2.942794804f + s * (323.9342325f + s * 44.69971514f))));
}

SHOAL_VECTORISE
void writeLight(const float* __restrict red, const float* __restrict green, const float* __restrict blue,
                int width, uint8_t* __restrict bgr) {
    for (int x = 0; x < width; ++x) {
        const float scale = 1 / std::max(std::max(red[x], green[x]), std::max(blue[x], 1.0f));
        bgr[3 * x] = srgbByteOf(scale * blue[x]);
        bgr[3 * x + 1] = srgbByteOf(scale * green[x]);
        bgr[3 * x + 2] = srgbByteOf(scale * red[x]);
    }
}

// Returns the first of `parts` shares of `whole` that are of nearly the same size.
int firstOf(int part, int parts, int whole) { return (part * whole + parts - 1) / parts; }

// Adds the weighed means of a channel's pixels to `count` pixels of the light, of which `out` is the first.
void addMeans(const float* channel, int width, int count, float weight, float* out) {
    for (int to = 0, x = 0; to < count; ++to) {
        const int first = x, end = firstOf(to + 1, count, width);
        float sum = 0;
        for (; x < end; ++x) sum += channel[x];
        out[3 * to] += weight * sum / static_cast<float>(end - first);
    }
}

} // namespace

// Makes the matrix from codes to red, green and blue of 0 to 1: H.273, 8.3. Luma is 0 to 1, and differences
// are -1/2 to 1/2; Decoder.cpp has their formula.
void FrameConverter::makeMatrix(const FrameColour& colour) {
    const Luma k = lumaOf(colour.matrix);
    const double ofRed = 2 - 2 * k.red, ofBlue = 2 - 2 * k.blue, green = 1 - k.red - k.blue;
    glm::dmat4x3 m(1);
    if (!isRgb_)
        m = {1, 1, 1, 0, -k.blue * ofBlue / green, ofBlue, ofRed, -k.red * ofRed / green, 0, 0, 0, 0};
    for (int c = 0; c < (isGrey_ ? 1 : 3); ++c) {
        const int depth = isPalette_ ? 8 : format_->comp[c].depth;
        const bool isDifference = !isRgb_ && c > 0, full = colour.fullRange || isRgb_ || depth < 8;
        const auto code = [&](double of8) { return std::ldexp(of8, depth - 8); };
        m[c] /= full ? (1 << depth) - 1 : code(isDifference ? 224 : 219);
        m[3] -= m[c] * (isDifference ? code(128) : full ? 0 : code(16));
    }
    planes_.rgbFromCodes = glm::mat4x3(m);
}

void FrameConverter::readRow(int component, int y, Rows& rows) const {
    const bool isDifference = !isRgb_ && component > 0;
    Row& out = rows.channels[static_cast<size_t>(component)];
    if (isDifference && isGrey_) {
        std::ranges::fill(out, 0.0f);
        return;
    }
    const int across = isDifference ? format_->log2_chroma_w : 0;
    const int width = AV_CEIL_RSHIFT(frame_->width, across);
    const uint8_t* planes[4] = {frame_->data[0], frame_->data[1], frame_->data[2], frame_->data[3]};
    av_read_image_line2(rows.codes.data(), planes, frame_->linesize, format_, 0,
                        isDifference ? y >> format_->log2_chroma_h : y, isPalette_ ? 0 : component, width, 0,
                        sizeof(uint16_t));
    if (isPalette_) // words of alpha, red, green, blue
        for (uint16_t& code : rows.codes)
            code = reinterpret_cast<const uint32_t*>(planes[1])[code] >> (16 - 8 * component) & 255;
    spread(rows.codes.data(), across, frame_->width, out.data());
}

// Converts a row; leaves its light in `rows`. Twin of shaders/render/Planes.frag.
void FrameConverter::convertRow(int y, Rows& rows, uint8_t* bgr) const {
    const int width = frame_->width;
    for (int c = 0; c < 3; ++c) readRow(c, y, rows);
    float *const red = rows.channels[0].data(), *const green = rows.channels[1].data(),
                 *const blue = rows.channels[2].data();
    applyMatrix(planes_.rgbFromCodes, std::numeric_limits<float>::lowest(), width, red, green, blue);
    if (!planes_.lightByCode) return writeCodes(red, green, blue, width, bgr);
    for (Row& channel : rows.channels) lookUp(planes_.lightByCode, width, channel.data());
    if (planes_.isHlg) { // gains by the square root of luminance
        static const auto gains = tableOf([](double root) { return hlgGain(root * root); });
        applyHlgGain(gains.data(), width, red, green, blue);
    }
    applyMatrix(planes_.toRec709, 0, width, red, green, blue);
    writeLight(red, green, blue, width, bgr);
}

void FrameConverter::convertBand(int band, ImageRgb8& bgr) {
    Rows& rows = rows_[static_cast<size_t>(band)];
    rows.codes.resize(static_cast<size_t>(bgr.width));
    for (Row& channel : rows.channels) channel.resize(static_cast<size_t>(bgr.width));
    const int height = radianceLin_ ? radianceLin_->height : bgr.height;
    for (int to = firstOf(band, kBands, height); to < firstOf(band + 1, kBands, height); ++to) {
        const int first = firstOf(to, height, bgr.height), end = firstOf(to + 1, height, bgr.height);
        float* const light = radianceLin_ ? radianceLin_->at(0, to) : nullptr;
        if (light) std::fill_n(light, 3 * radianceLin_->width, 0.0f);
        for (int y = first; y < end; ++y) {
            convertRow(y, rows, bgr.at(0, y));
            for (size_t c = 0; light && c < 3; ++c)
                addMeans(rows.channels[c].data(), bgr.width, radianceLin_->width,
                         1 / static_cast<float>(end - first), light + c);
        }
    }
}

Status FrameConverter::begin(const AVFrame& frame, const FrameColour& colour) {
    frame_ = &frame;
    format_ = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format));
    if (!format_ || !canRead(frame, *format_)) return Error{"", "its picture is of an unknown form"};
    isPalette_ = format_->flags & AV_PIX_FMT_FLAG_PAL;
    isRgb_ = isPalette_ || format_->flags & AV_PIX_FMT_FLAG_RGB;
    isGrey_ = !isRgb_ && format_->nb_components < 3;
    const AVComponentDescriptor* of = format_->comp;
    planes_ = {.bytes = of[0].depth > 8 ? 2 : 1,
               .size = {frame.width, frame.height},
               .chromaShift = {format_->log2_chroma_w, format_->log2_chroma_h},
               .toRec709 = glm::mat4x3(toRec709(colour.primaries)),
               .isHlg = colour.transfer == Transfer::Hlg};
    if (colour.transfer != Transfer::Sdr || colour.primaries != AVCOL_PRI_BT709)
        planes_.lightByCode = lightByCode(colour.transfer).data();
    makeMatrix(colour);
    const bool isThree = !isRgb_ && of[1].plane == 1 && of[2].plane == 2 && of[0].shift == 0;
    for (size_t c = 0; isThree && !(format_->flags & AV_PIX_FMT_FLAG_BE) && c < 3; ++c) {
        planes_.codes[c] = frame.data[c];
        planes_.rowBytes[c] = frame.linesize[c];
    }
    return Done{};
}

void FrameConverter::share(const AVFrame& frame, const FrameColour& colour, VideoFrame& out) {
    if (!out.planesOwner) out.planesOwner = {av_frame_alloc(), FreeAt<av_frame_free>()};
    av_frame_unref(out.planesOwner.get());
    const bool shared = begin(frame, colour) && std::ranges::min(planes_.rowBytes) > 0 &&
                        av_frame_ref(out.planesOwner.get(), &frame) >= 0;
    out.planes = shared ? planes_ : Planes();
}

Status FrameConverter::convert(const AVFrame& frame, const FrameColour& colour, ImageRgb8& bgr,
                               ImageRgbF* radianceLin) {
    if (Status readable = begin(frame, colour); !readable) return readable;
    bgr.fit(frame.width, frame.height);
    radianceLin_ = colour.transfer != Transfer::Sdr ? radianceLin : nullptr;
    if (radianceLin_) {
        const int width = std::min(frame.width, kMaxLightSide);
        radianceLin_->fit(width, std::clamp(frame.height * width / frame.width, 1, kMaxLightSide));
    } else if (radianceLin && !radianceLin->empty()) {
        *radianceLin = {};
    }
    if (!pool_) {
        pool_ = std::make_unique<ThreadPool>(
            static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 8u)) - 1);
        rows_.resize(kBands);
    }
    pool_->parallelFor(kBands, [&](int band) { convertBand(band, bgr); });
    return Done{};
}

} // namespace shoal::media
