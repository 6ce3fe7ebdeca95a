// A film's planes become the same picture on the graphics card as on the processor, and 10 bits stay 10 bits.
#include "Spheres.h"
#include "engine/core/Random.h"
#include "engine/media/FrameConverter.h"
#include "engine/render/EnvironmentGpu.h"

namespace shoal {
namespace {

using media::ColourMatrix, media::FrameColour, media::Transfer;
using Texel = std::array<float, 3>; // red, green, blue of 0 to 255

class PlanesGL : public WithContext {
  protected:
    void setUpInContext() override {
        pass_ = tests::valueOf(render::PlanesPass::make());
        environment_.emplace();
    }

    // Returns a frame whose codes are codeOf(component, x, y), 0 to 1 of all codes.
    template <class Code>
    media::Frame frameOf(AVPixelFormat format, int width, int height, const Code& codeOf) {
        media::Frame frame = media::makeFrame();
        frame->format = format;
        frame->width = width, frame->height = height;
        EXPECT_EQ(av_frame_get_buffer(frame.get(), 0), 0);
        for (const AVBufferRef* buffer : frame->buf) // av_write_image_line2() sets bits
            if (buffer) std::fill_n(buffer->data, buffer->size, uint8_t{0});
        const AVPixFmtDescriptor& known = *av_pix_fmt_desc_get(format);
        for (int c = 0; c < 3; ++c) {
            const int w = AV_CEIL_RSHIFT(width, c ? known.log2_chroma_w : 0),
                      h = AV_CEIL_RSHIFT(height, c ? known.log2_chroma_h : 0);
            std::vector<uint16_t> codes(static_cast<size_t>(w));
            for (int y = 0; y < h; ++y) {
                for (int x = 0; x < w; ++x)
                    codes[static_cast<size_t>(x)] = static_cast<uint16_t>(
                        std::lround(codeOf(c, x, y) * static_cast<float>((1 << known.comp[c].depth) - 1)));
                av_write_image_line2(codes.data(), frame->data, frame->linesize, &known, 0, y, c, w,
                                     sizeof(uint16_t));
            }
        }
        return frame;
    }

    // Returns a part of a frame as the graphics card shows it.
    std::vector<Texel> shown(const AVFrame& frame, const FrameColour& colour, const media::EyePart& part) {
        converter_.share(frame, colour, film_);
        EXPECT_TRUE(film_.planes.codes[0]);
        pass_->setFrame(film_.planes);
        environment_->setFrame({nullptr, part.width, part.height, 0, &*pass_, {part.x, part.y}});
        std::vector<uint32_t> bits(static_cast<size_t>(part.width) * part.height);
        glBindTexture(GL_TEXTURE_2D, environment_->frameTexture());
        glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, bits.data());
        EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
        std::vector<Texel> texels;
        const auto level = [](uint32_t code) { return static_cast<float>(code & 1023) * 255 / 1023; };
        for (const uint32_t each : bits)
            texels.push_back({level(each), level(each >> 10), level(each >> 20)});
        return texels;
    }

    std::optional<render::PlanesPass> pass_;
    std::optional<render::EnvironmentGpu> environment_;
    media::FrameConverter converter_;
    media::VideoFrame film_;
};

// Codes of all kinds; where codes are light, those of nearly equal channels: differences of light would
// enlarge the step to the next entry of the table. Odd sizes, and a part of the frame as of one eye.
TEST_F(PlanesGL, AreThePictureThatTheProcessorMakes) {
    constexpr media::EyePart kPart{.x = 33, .y = 3, .width = 31, .height = 32};
    std::vector<FrameColour> colours;
    for (const auto matrix : {ColourMatrix::Bt601, ColourMatrix::Bt709, ColourMatrix::Bt2020})
        for (const Transfer transfer : {Transfer::Sdr, Transfer::Pq, Transfer::Hlg})
            for (const auto primaries : {AVCOL_PRI_BT709, AVCOL_PRI_BT2020})
                for (const bool full : {false, true}) colours.push_back({matrix, primaries, transfer, full});
    for (const AVPixelFormat format : {AV_PIX_FMT_YUV420P, AV_PIX_FMT_YUV422P, AV_PIX_FMT_YUV444P,
                                       AV_PIX_FMT_YUV420P10, AV_PIX_FMT_YUV420P12})
        for (const FrameColour& colour : colours) {
            Random random(7);
            const bool isLight = colour.transfer != Transfer::Sdr || colour.primaries != AVCOL_PRI_BT709;
            const media::Frame frame = frameOf(format, 67, 35, [&](int c, int, int) {
                return c > 0 && isLight ? 0.5f + 0.03f * (random.unit() - 0.5f) : random.unit();
            });
            ImageRgb8 bgr;
            ASSERT_TRUE(converter_.convert(*frame, colour, bgr, nullptr));
            const std::vector<Texel> texels = shown(*frame, colour, kPart);
            float most = 0;
            for (int i = 0; i < kPart.width * kPart.height; ++i)
                for (size_t c = 0; c < 3; ++c) {
                    const uint8_t* pixel = bgr.at(kPart.x + i % kPart.width, kPart.y + i / kPart.width);
                    most = std::max(most, std::abs(texels[static_cast<size_t>(i)][c] - pixel[2 - c]));
                }
            EXPECT_LE(most, 1) << av_get_pix_fmt_name(format) << ' ' << nameOf(colour.matrix) << ' '
                               << static_cast<int>(colour.transfer) << colour.primaries << colour.fullRange;
        }
}

// The same texture takes planes of either depth and pixels in turn.
TEST_F(PlanesGL, AFilmOfTenBitsKeepsItsLevels) {
    const auto ramp = [](int c, int x, int) { return c > 0 ? 0.5f : static_cast<float>(x) / 1023; };
    const media::EyePart whole{.width = 1024, .height = 2};
    const std::vector<uint8_t> grey(4 * 1024 * 2, 77);
    for (const auto& [format, levels] : {std::pair(AV_PIX_FMT_YUV420P10, 1024), {AV_PIX_FMT_YUV420P, 256}}) {
        std::set<float> found;
        for (const Texel& texel : shown(*frameOf(format, 1024, 2, ramp), {.fullRange = true}, whole))
            found.insert(texel[1]);
        EXPECT_EQ(found.size(), static_cast<size_t>(levels));
        environment_->setFrame({grey.data(), 1024, 2, 1024});
        std::vector<uint8_t> read(grey.size());
        glBindTexture(GL_TEXTURE_2D, environment_->frameTexture());
        glGetTexImage(GL_TEXTURE_2D, 0, GL_BGRA, GL_UNSIGNED_BYTE, read.data());
        EXPECT_EQ(read, grey);
    }
}

// Forms that are left to the processor.
TEST_F(PlanesGL, OtherFormsAreNotShared) {
    for (const AVPixelFormat format :
         {AV_PIX_FMT_GBRP10, AV_PIX_FMT_YUYV422, AV_PIX_FMT_NV12, AV_PIX_FMT_P010, AV_PIX_FMT_YUV420P10BE,
          AV_PIX_FMT_GRAY8, AV_PIX_FMT_RGB24}) {
        const media::Frame frame = media::makeFrame();
        frame->format = format;
        frame->width = 64, frame->height = 32;
        ASSERT_EQ(av_frame_get_buffer(frame.get(), 0), 0);
        converter_.share(*frame, {}, film_);
        EXPECT_FALSE(film_.planes.codes[0]) << av_get_pix_fmt_name(format);
    }
}

} // namespace
} // namespace shoal
