#include "engine/render/software/SoftwareBackground.h"

#include "engine/gl/Renderer.h"

#include <algorithm>
#include <thread>

namespace shoal::render {

namespace {

bool canSample(const EyePicture& picture) {
    return canSampleFrames() && showsFrameAsCoded(picture.environment, picture.exposure) &&
           picture.canvas.samples() == 1 && !glIsEnabled(GL_STENCIL_TEST);
}

} // namespace

Result<std::unique_ptr<BackgroundPass>> makeBackgroundPass(Backend backend, bool withLayers) {
    if (backend == Backend::Auto)
        backend = gl::rendersInSoftware() && canSampleFrames() ? Backend::Software : Backend::OpenGL;
    return backend == Backend::Software ? SoftwareBackground::make(withLayers)
                                        : BackgroundPass::make(withLayers);
}

SoftwareBackground::SoftwareBackground()
    : sampler_(std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 4) - 1) {}

Result<std::unique_ptr<BackgroundPass>> SoftwareBackground::make(bool withLayers) {
    std::unique_ptr<SoftwareBackground> pass(new SoftwareBackground);
    if (Status s = pass->setUp(withLayers); !s) return s.error();
    return std::unique_ptr<BackgroundPass>(std::move(pass));
}

void SoftwareBackground::prepare(const EyePicture& picture, const FrameTiles* tiles) {
    if (!canSample(picture)) return;
    sampler_.start({picture.environment.displayFrame(), picture.environment.frameNumber(), tiles,
                    picture.view, picture.envFromEye(), picture.size()});
}

void SoftwareBackground::finish(const EyePicture& picture, const TexelLayer& layer) {
    const gl::Target& drawn = layer.layer.layer();
    drawn.readBgra(layer_);
    TexelPaint paint{.layer = layer_.data(),
                     .layerSize = {drawn.width(), drawn.height()},
                     .eyeFromEnv =
                         glm::transpose(picture.envFromWorld * glm::mat3_cast(layer.view.worldFromEye)),
                     .rayScale = layer.view.halfExtent(),
                     .rayShift = layer.view.shift};
    CameraUniforms uniforms;
    if (layer.filmed) {
        if (grain_.empty()) grain_ = makeGrain();
        uniforms = cameraUniforms(picture.filmed);
        paint.filmed = &uniforms;
        paint.grainy = (cameraFeatures(picture.filmed.response) & kGrainy) != 0;
        paint.grain = grain_.data();
        paint.scattered = &picture.environment.scatteredLight();
    }
    sampler_.finish(&paint);
}

Status SoftwareBackground::draw(const EyePicture& picture, const TexelLayer* layer) {
    if (!canSample(picture)) return BackgroundPass::draw(picture, layer);
    if (!sampler_.started()) prepare(picture, layer ? &layer->tiles : nullptr);
    if (layer)
        finish(picture, *layer);
    else
        sampler_.finish(nullptr);
    if (sampler_.sampledAny()) {
        glBindTexture(GL_TEXTURE_2D, picture.canvas.texture());
        glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, picture.canvas.width(), picture.canvas.height(), GL_BGRA,
                        GL_UNSIGNED_BYTE, sampler_.picture());
    }
    if (std::ranges::any_of(sampler_.left(), &CellToDraw::painted)) uploadPainted();
    return drawCells(picture, sampler_.left(), painted_.name());
}

// Only the runs of tiles that hold anything.
void SoftwareBackground::uploadPainted() {
    const DisplayFrame frame = sampler_.painted().frame();
    const glm::ivec2 size(frame.width, frame.height);
    if (size != paintedSize_) {
        paintedSize_ = size;
        painted_ = makeLatLongTexture();
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, size.x, size.y, 0, GL_BGRA, GL_UNSIGNED_BYTE, nullptr);
    }
    glBindTexture(GL_TEXTURE_2D, painted_.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, frame.rowPixels);
    const auto* texels = reinterpret_cast<const uint32_t*>(frame.pixels);
    for (const PaintedFrame::Run& run : sampler_.painted().runs())
        glTexSubImage2D(GL_TEXTURE_2D, 0, run.low.x, run.low.y, run.high.x - run.low.x,
                        run.high.y - run.low.y, GL_BGRA, GL_UNSIGNED_BYTE,
                        texels + ptrdiff_t{run.low.y} * frame.rowPixels + run.low.x);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

} // namespace shoal::render
