// Draws the reef's frames and hands them, raw, to an encoder on standard output:
//     make_video_frames FIRST COUNT FRAMES WIDTH   writes COUNT frames of a loop of FRAMES, WIDTH x WIDTH/2,
//     3 bytes a pixel make_video_frames --truth FRAME FRAMES WIDTH FILE.hdr   writes a frame's linear
//     radiance before the camera
#include "engine/core/Image.h"
#include "engine/gl/Program.h"
#include "engine/media/Pictures.h"
#include "engine/platform/Headless.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

using namespace shoal;

// The picture's height is drawn in bands, so that no single draw takes seconds.
constexpr int kBands = 16;

void draw(const gl::Program& program, int frame, int frames, int width, bool linear) {
    program.use();
    program.set("turn", static_cast<float>(frame) / static_cast<float>(frames));
    program.set("frameNumber", static_cast<float>(frame));
    program.set("linearOut", linear ? 1 : 0);
    glViewport(0, 0, width, width / 2);
    glEnable(GL_SCISSOR_TEST);
    for (int band = 0; band < kBands; ++band) {
        const int rows = width / 2 / kBands;
        glScissor(0, band * rows, width, rows);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glFinish();
    }
}

int fail(const std::string& sentence) {
    std::fprintf(stderr, "make_video_frames: %s\n", sentence.c_str());
    return 1;
}

} // namespace

int main(int argc, char** argv) {
    const bool truth = argc == 6 && std::strcmp(argv[1], "--truth") == 0;
    if (!truth && argc != 5)
        return fail("wants FIRST COUNT FRAMES WIDTH, or --truth FRAME FRAMES WIDTH FILE");
    auto context = platform::Headless::open();
    if (!context) return fail(context.error().sentence());
    auto program = gl::Program::load("../content/make/video/Reef");
    if (!program) return fail(program.error().sentence());
    const int width = std::atoi(argv[4]);
    if (width < 64 || width > 8192) return fail("the width is 64 to 8192");
    const gl::VertexArray nothing = gl::VertexArray::make();
    glBindVertexArray(nothing.name());
    const gl::Texture texture = gl::Texture::make();
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glTexImage2D(GL_TEXTURE_2D, 0, truth ? GL_RGBA32F : GL_RGBA8, width, width / 2, 0, GL_RGBA, GL_FLOAT,
                 nullptr);
    const gl::Framebuffer target = gl::Framebuffer::make();
    glBindFramebuffer(GL_FRAMEBUFFER, target.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name(), 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    if (truth) {
        draw(*program, std::atoi(argv[2]), std::atoi(argv[3]), width, true);
        ImageRgbF image(width, width / 2);
        glReadPixels(0, 0, width, width / 2, GL_RGB, GL_FLOAT, image.pixels.data());
        const Status written = media::writeHdr(argv[5], image);
        return written ? 0 : fail(written.error().sentence());
    }
    const int first = std::atoi(argv[1]), count = std::atoi(argv[2]), frames = std::atoi(argv[3]);
    ImageRgb8 image(width, width / 2);
    for (int frame = first; frame < first + count; ++frame) {
        draw(*program, frame, frames, width, false);
        glReadPixels(0, 0, width, width / 2, GL_RGB, GL_UNSIGNED_BYTE, image.pixels.data());
        if (std::fwrite(image.pixels.data(), 1, image.pixels.size(), stdout) != image.pixels.size())
            return fail("the encoder stopped listening");
        std::fprintf(stderr, "\rframe %d of %d", frame + 1, frames);
    }
    std::fprintf(stderr, "\n");
    return 0;
}
