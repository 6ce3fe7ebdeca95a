// Films of high dynamic range (PQ, HLG), of wide primaries and of rare pixel formats.
#include "engine/light/MakeLight.h"
#include "engine/media/Check.h"
#include "engine/media/VideoPlayer.h"
#include "tests/unit/light/Environments.h"
#include "tests/unit/media/CodedFrames.h"
#include "tests/unit/media/TestFiles.h"

namespace shoal::media {
namespace {

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
            const auto [bgr, light] = filmed(
                light::paint(64, 32, [&](const glm::dvec3& d) { return d.x > 0 && isHdr ? lamp : sea; }),
                format, transfer);
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
    for (const auto& [format, transfer, sun] : {std::tuple(AV_PIX_FMT_YUV420P10, AVCOL_TRC_SMPTE2084, 9000.0),
                                                {AV_PIX_FMT_YUV420P12, AVCOL_TRC_SMPTE2084, 9000.0},
                                                {AV_PIX_FMT_YUV420P10, AVCOL_TRC_ARIB_STD_B67, 900.0}}) {
        const glm::dvec3 to = glm::normalize(glm::dvec3(0.3, 0.8, -0.5));
        const auto paint = [&](const glm::dvec3& d) {
            const double apart = std::acos(std::clamp(glm::dot(d, to), -1.0, 1.0)) / glm::radians(3.0);
            return glm::dvec3(0.1, 0.2, 0.3) * (1.2 + d.y) +
                   (sun / 203 - 0.7) * glm::dvec3(1, 0.9, 0.8) * std::exp(-apart * apart);
        };
        const ImageRgbF light = filmed(light::paint(2048, 1024, paint), format, transfer).light;
        EXPECT_EQ(light.width, 1024);
        EXPECT_EQ(light.height, 512);
        EXPECT_LT(differenceOfLight(light, light::paint(1024, 512, paint)), 0.005);
    }
}

// The stream's colours count where the frame states none; what is no whole number is refused.
TEST(HdrFilm, StatedColoursTellAndOthersAreRefused) {
    EXPECT_EQ(colourOf(AV_CODEC_ID_AV1, {.transfer = AVCOL_TRC_SMPTE2084}, 64, 32).primaries,
              AVCOL_PRI_BT2020);
    EXPECT_EQ(colourOf(AV_CODEC_ID_AV1, {.transfer = AVCOL_TRC_ARIB_STD_B67}, 64, 32).matrix,
              ColourMatrix::Bt2020);
    EXPECT_EQ(colourOf(AV_CODEC_ID_AV1, {.primaries = AVCOL_PRI_BT470BG}, 64, 32).primaries, AVCOL_PRI_BT709);
    for (const AVColorSpace matrix : {AVCOL_SPC_BT2020_CL, AVCOL_SPC_ICTCP})
        EXPECT_FALSE(colourOf(AV_CODEC_ID_HEVC, {matrix}, 64, 32).decodable) << matrix;
    ImageRgb8 bgr;
    for (const AVPixelFormat format : {AV_PIX_FMT_GBRPF32, AV_PIX_FMT_UYYVYY411, AV_PIX_FMT_BAYER_RGGB8})
        EXPECT_FALSE(FrameConverter().convert(*blankFrame(format, 64, 64), {}, bgr, nullptr)) << format;
}

// FFV1 leaves the colours to the container; the message of HEVC stands in frames alone.
TEST(HdrFilm, FilesAreLitAsMeasured) {
    const TempFolder folder;
    const Path hlg = folder / "hlg.mkv", pq = sharedData("files/pq.mp4");
    for (const std::string codec :
         {"ffv1 -color_trc arib-std-b67 -color_primaries bt2020 -colorspace bt2020nc "
          "-vf setparams=color_trc=arib-std-b67:color_primaries=bt2020:colorspace=bt2020nc", // FFmpeg 7
          "libx265 -x265-params log-level=none:colorprim=9:transfer=14:colormatrix=9:atc-sei=18"}) {
        if (!ffmpeg("-f lavfi -i color=c=white:s=64x32:r=25:d=1 -pix_fmt yuv420p10le -c:v " + codec, hlg))
            continue; // no such encoder
        EXPECT_THAT(tests::valueOf(checkVideo(hlg)), testing::HasSubstr("HLG, lit as measured"));
        auto player = tests::valueOf(VideoPlayer::open(hlg));
        const VideoFrame& frame = *player.waitFor(0);
        ASSERT_FALSE(frame.radianceLin.pixels.empty());
        EXPECT_NEAR(frame.radianceLin.at(9, 9)[1], 1000.0f / 203, 0.05f);
    }
    if (pq.empty()) GTEST_SKIP() << "no shared files/pq.mp4";
    EXPECT_THAT(tests::valueOf(checkVideo(pq)), testing::HasSubstr("PQ, lit as measured"));
    auto player = tests::valueOf(VideoPlayer::open(pq));
    const VideoFrame& frame = *player.waitFor(0);
    for (const auto& [row, light] : {std::pair{0, 4.9f}, {40, 1.0f}, {200, 0.18f}}) {
        EXPECT_NEAR(frame.radianceLin.at(100, row)[1], light, 0.02f * light);
        EXPECT_NEAR(frame.pixelsBgr.at(100, row)[1], 255 * math::srgbFromLinear(std::min(light, 1.0f)), 1);
    }
}

} // namespace
} // namespace shoal::media
