// Films of high dynamic range (PQ, HLG), of wide primaries and of rare pixel formats.
#include "engine/light/MakeLight.h"
#include "engine/math/Colour.h"
#include "engine/media/Check.h"
#include "engine/media/FrameConverter.h"
#include "engine/media/VideoPlayer.h"
#include "tests/unit/light/Environments.h"
#include "tests/unit/media/TestFiles.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/mat3x3.hpp>

namespace shoal::media {
namespace {

using Paint = std::function<glm::dvec3(const glm::dvec3& direction)>; // light, 1 is white

// Columns: ITU-R BT.2087, table 1.
const glm::dmat3 kTo2020(0.6274, 0.0691, 0.0164, 0.3293, 0.9195, 0.0880, 0.0433, 0.0114, 0.8956);

// The inverse EOTF of SMPTE ST 2084, of 0 to 1.
double pqOf(double light) {
    const double power = std::pow(light, 0.1593017578125);
    return std::pow((0.8359375 + 18.8515625 * power) / (1 + 18.6875 * power), 78.84375);
}

// Codes light of Rec. 709 primaries.
glm::dvec3 codesOf(const glm::dvec3& light709, AVColorTransferCharacteristic transfer) {
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

struct Case {
    AVPixelFormat format;
    AVColorTransferCharacteristic transfer;
};

// Makes a frame of limited range, BT.2020, lat-long.
Frame frameOf(const Case& of, int width, int height, const Paint& paint) {
    Frame frame = makeFrame();
    frame->format = of.format;
    frame->width = width, frame->height = height;
    EXPECT_EQ(av_frame_get_buffer(frame.get(), 0), 0);
    for (const AVBufferRef* buffer : frame->buf) // av_write_image_line2() sets bits
        if (buffer) std::memset(buffer->data, 0, buffer->size);
    const AVPixFmtDescriptor& format = *av_pix_fmt_desc_get(of.format);
    const bool isRgb = format.flags & AV_PIX_FMT_FLAG_RGB;
    for (int c = 0; c < 3; ++c) {
        const bool half = c > 0 && !isRgb;
        const int across = half ? format.log2_chroma_w : 0, down = half ? format.log2_chroma_h : 0;
        const int depth = format.comp[c].depth;
        std::vector<uint16_t> codes(static_cast<size_t>(width >> across));
        for (int y = 0; y < height >> down; ++y) {
            for (int x = 0; x < width >> across; ++x) {
                const glm::dvec3 rgb = codesOf(
                    paint(texelDirection<double>(x, y, width >> across, height >> down)), of.transfer);
                const double luma = glm::dot(rgb, {0.2627, 0.6780, 0.0593});
                const double share = isRgb    ? rgb[c] * ((1 << depth) - 1)
                                     : c == 0 ? std::ldexp(16 + 219 * luma, depth - 8)
                                     : c == 1 ? std::ldexp(128 + 224 * (rgb.b - luma) / 1.8814, depth - 8)
                                              : std::ldexp(128 + 224 * (rgb.r - luma) / 1.4746, depth - 8);
                codes[static_cast<size_t>(x)] = static_cast<uint16_t>(std::lround(share));
            }
            av_write_image_line2(codes.data(), frame->data, frame->linesize, &format, 0, y, c,
                                 width >> across, sizeof(uint16_t));
        }
    }
    return frame;
}

struct Converted {
    ImageRgb8 bgr;
    ImageRgbF light;
};
Converted converted(const Frame& frame, AVColorTransferCharacteristic transfer) {
    Converted out;
    const FrameColour colour =
        colourOf(AV_CODEC_ID_HEVC, {AVCOL_SPC_BT2020_NCL, AVCOL_PRI_BT2020, transfer}, 64, 32);
    EXPECT_TRUE(FrameConverter().convert(*frame, colour, false, out.bgr, &out.light));
    return out;
}

// BT.2408, table 1 and section 3.2, and the ends of both curves: code and cd/m^2.
TEST(HdrFilm, CurvesPassThroughThePublishedPoints) {
    for (const auto& [code, light_cdM2] :
         {std::pair{0.0, 0.0}, {0.508078, 100.0}, {0.58, 203.0}, {0.751827, 1000.0}, {1.0, 10000.0}})
        EXPECT_NEAR(203 * lightFromPq(code), light_cdM2, 0.01 * light_cdM2);
    for (const auto& [code, light_cdM2] :
         {std::pair{0.0, 0.0}, {0.5, 1000 * std::pow(1.0 / 12, 1.2)}, {0.75, 203.0}, {1.0, 1000.0}}) {
        const double scene = sceneFromHlg(code);
        EXPECT_NEAR(203 * hlgGain(scene) * scene, light_cdM2, 0.002 * light_cdM2);
    }
}

// A step of 10 bits is up to 1.1 % of the light (HLG: 2 %), a difference's 1.9 times that in blue.
TEST(HdrFilm, ColoursAreReadFromEveryFormat) {
    const glm::dvec3 sea(0.1, 0.5, 0.8), lamp(4.0, 3.0, 2.0);
    for (const AVPixelFormat format :
         {AV_PIX_FMT_YUV420P10, AV_PIX_FMT_P010, AV_PIX_FMT_YUV422P12, AV_PIX_FMT_YUV444P10BE,
          AV_PIX_FMT_GBRP10, AV_PIX_FMT_GBRAP12, AV_PIX_FMT_RGB48, AV_PIX_FMT_NV12, AV_PIX_FMT_YUV444P})
        for (const auto transfer : {AVCOL_TRC_SMPTE2084, AVCOL_TRC_ARIB_STD_B67, AVCOL_TRC_BT2020_10}) {
            const bool isHdr = transfer != AVCOL_TRC_BT2020_10;
            const int depth = av_pix_fmt_desc_get(format)->comp[0].depth;
            if (isHdr && depth == 8) continue;
            const auto [bgr, light] =
                converted(frameOf({format, transfer}, 64, 32,
                                  [&](const glm::dvec3& d) { return d.x > 0 && isHdr ? lamp : sea; }),
                          transfer);
            EXPECT_EQ(light.empty(), !isHdr);
            for (int c = 0; c < 3; ++c) {
                // Below white as it is, above it divided by the largest channel.
                EXPECT_NEAR(bgr.at(16, 20)[2 - c], 255 * math::srgbFromLinear(sea[c]), depth == 8 ? 4 : 2)
                    << av_get_pix_fmt_name(format) << ' ' << transfer << ' ' << c;
                if (!isHdr) continue;
                EXPECT_NEAR(bgr.at(48, 20)[2 - c], 255 * math::srgbFromLinear(lamp[c] / 4), 2) << c;
                EXPECT_NEAR(double{light.at(16, 20)[c]}, sea[c], 0.03 * sea[c] + 0.003) << c;
                EXPECT_NEAR(double{light.at(48, 20)[c]}, lamp[c], 0.03 * lamp[c]) << c;
            }
        }
}

// Relative root mean square difference of the diffuse light, in shares.
double differenceOfLight(const ImageRgbF& made, const ImageRgbF& truth) {
    light::EnvironmentLight a, b;
    light::LightMaker({512, 0.1f}).makeFromHdr(made, a);
    light::LightMaker({512, 0.1f}).makeFromHdr(truth, b);
    double difference = 0, whole = 0;
    for (int y = 0; y < a.diffuse.height; ++y)
        for (int i = 0; i < 3 * a.diffuse.width; ++i) {
            const double of = a.diffuse.at(0, y)[i], to = b.diffuse.at(0, y)[i],
                         weight = texelSolidAngle(y, a.diffuse.width, a.diffuse.height);
            difference += weight * (of - to) * (of - to);
            whole += weight * to * to;
        }
    return std::sqrt(difference / whole);
}

// A sky with a sun of 3 degrees, as bright as the film can tell: 900 and 9000 cd/m^2. One beyond the peak is
// cut off there, and nothing else is lost.
TEST(HdrFilm, LightsAsThePanoramaThatWasCoded) {
    struct Film {
        Case of;
        double sun, tolerance;
    };
    for (const Film& film : {Film{{AV_PIX_FMT_YUV420P10, AVCOL_TRC_SMPTE2084}, 9000, 0.005},
                             Film{{AV_PIX_FMT_YUV420P12, AVCOL_TRC_SMPTE2084}, 9000, 0.005},
                             Film{{AV_PIX_FMT_YUV420P10, AVCOL_TRC_ARIB_STD_B67}, 900, 0.005}}) {
        const glm::dvec3 to = glm::normalize(glm::dvec3(0.3, 0.8, -0.5));
        const Paint paint = [&](const glm::dvec3& d) {
            const double apart = std::acos(std::clamp(glm::dot(d, to), -1.0, 1.0)) / glm::radians(3.0);
            return glm::dvec3(0.1, 0.2, 0.3) * (1.2 + d.y) +
                   (film.sun / 203 - 0.7) * glm::dvec3(1, 0.9, 0.8) * std::exp(-apart * apart);
        };
        const ImageRgbF light = converted(frameOf(film.of, 2048, 1024, paint), film.of.transfer).light;
        EXPECT_EQ(light.width, 1024);
        EXPECT_EQ(light.height, 512);
        EXPECT_LT(differenceOfLight(light, light::paint(1024, 512, paint)), film.tolerance);
    }
}

// The stream's colours count where the frame states none; what is no whole number is refused.
TEST(HdrFilm, StatedColoursTellAndOthersAreRefused) {
    EXPECT_EQ(colourOf(AV_CODEC_ID_AV1, {.transfer = AVCOL_TRC_SMPTE2084}, 64, 32).primaries,
              AVCOL_PRI_BT2020);
    EXPECT_EQ(colourOf(AV_CODEC_ID_AV1, {.transfer = AVCOL_TRC_ARIB_STD_B67}, 64, 32).matrix,
              ColourMatrix::Bt2020);
    EXPECT_EQ(colourOf(AV_CODEC_ID_AV1, {.primaries = AVCOL_PRI_BT470BG}, 64, 32).primaries, AVCOL_PRI_BT709);
    ImageRgb8 bgr;
    for (const AVPixelFormat format : {AV_PIX_FMT_GBRPF32, AV_PIX_FMT_UYYVYY411, AV_PIX_FMT_BAYER_RGGB8}) {
        const Frame frame = makeFrame();
        frame->format = format;
        frame->width = frame->height = 64;
        ASSERT_EQ(av_frame_get_buffer(frame.get(), 0), 0);
        EXPECT_FALSE(FrameConverter().convert(*frame, {}, false, bgr, nullptr)) << format;
    }
}

TEST(HdrFilm, FilesAreLitAsMeasured) {
    const TempFolder folder;
    const Path hlg = folder / "hlg.mkv", pq = sharedData("files/pq.mp4");
    const std::string command =
        "ffmpeg -v error -f lavfi -i color=c=white:s=64x32:r=25:d=1 -c:v ffv1 -pix_fmt "
        "yuv420p10le -color_trc arib-std-b67 -color_primaries bt2020 -colorspace "
        "bt2020nc " +
        hlg.string() + " >/dev/null 2>&1";
    if (std::system(command.c_str()) == 0) {
        EXPECT_THAT(tests::valueOf(checkVideo(hlg)), testing::HasSubstr("HLG, lit as measured"));
        auto player = tests::valueOf(VideoPlayer::open(hlg));
        EXPECT_NEAR(player.waitFor(0)->radianceLin.at(9, 9)[1], 1000.0f / 203, 0.01f);
    }
    if (pq.empty()) GTEST_SKIP() << "no shared files/pq.mp4";
    EXPECT_THAT(tests::valueOf(checkVideo(pq)), testing::HasSubstr("PQ, lit as measured"));
    auto player = tests::valueOf(VideoPlayer::open(pq));
    EXPECT_EQ(player.waitFor(0)->radianceLin.width, 512);
}

} // namespace
} // namespace shoal::media
