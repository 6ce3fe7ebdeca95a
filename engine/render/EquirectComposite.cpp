#include "engine/render/EquirectComposite.h"

#include <array>
#include <cassert>

namespace shoal::render {

namespace {

constexpr std::array<const char*, 3> kCompositeDefines = {"FILMED", "GRAINY",
                                                          "SHARES_COLOUR"}; // as CameraFeature

} // namespace

Result<EquirectComposite> EquirectComposite::make() {
    EquirectComposite pass;
    pass.programs_ = gl::Variants("render/EquirectComposite", kCompositeDefines);
    // Compiled now, so that a broken shader is known at the start.
    for (const unsigned features : {0u, static_cast<unsigned>(kFilmed)})
        if (auto program = pass.programs_.get(features); !program) return program.error();
    pass.drawn_ = TriangleBatch::make();
    pass.framebuffer_ = gl::Framebuffer::make();
    return pass;
}

Status EquirectComposite::paint(const EnvironmentGpu& environment, const FrameTiles& tiles,
                                const std::vector<bool>& wanted, GLuint layer, const View& layerView,
                                const glm::mat3& envFromWorld, const FilmedFrame* filmed) {
    assert(environment.frameIsCoded());
    const glm::ivec2 size = tiles.frameSize();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    if (size != size_) {
        size_ = size;
        frame_ = makeLatLongTexture();
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, size.x, size.y, 0, GL_BGRA, GL_UNSIGNED_BYTE, nullptr);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, frame_.name(), 0);
        assert(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
    }
    corners_.clear();
    eachRun(wanted, FrameTiles::kCount, [&](int first, int end, int row) {
        for (int tile = first; tile < end; ++tile) {
            const glm::vec2 low = tiles.lowOf({tile, row}), high = tiles.lowOf({tile + 1, row + 1});
            if (low.x < high.x && low.y < high.y)
                addRectangle(low / glm::vec2(size), high / glm::vec2(size), corners_);
        }
    });
    if (corners_.empty()) return Done{};

    auto found = programs_.get(filmed ? cameraFeatures(filmed->response) : 0);
    if (!found) return found.error();
    const gl::Program& program = **found;
    const GLuint frame = environment.frameTexture(); // before other textures are bound: it may upload
    program.use();
    if (filmed) {
        if (!grain_) grain_ = makeGrainTexture();
        setCameraUniforms(program, *filmed);
        program.setTexture("scattered", 1, environment.scatteredTexture());
        program.setTexture("grain", 3, grain_.name());
    }
    program.setTexture("frame", 2, frame);
    program.setTexture("layer", 0, layer);
    program.set("eyeFromEnv", glm::transpose(envFromWorld * glm::mat3_cast(layerView.worldFromEye)));
    program.set("rayScale", layerView.halfExtent());
    program.set("rayShift", layerView.shift);
    glViewport(0, 0, size.x, size.y);
    glDisable(GL_BLEND);
    drawn_.draw(corners_);
    return Done{};
}

} // namespace shoal::render
