#include "engine/render/Compositor.h"

#include "engine/gl/Renderer.h"
#include "engine/render/LayerPass.h"

#include <array>
#include <utility>

namespace shoal::render {

void Compositor::prepareBackground(const EyePicture& picture, const FrameTiles* tiles) {
    if (picture.skip != SkippedPass::Background) background_->prepare(picture, tiles);
}

Status Compositor::drawBackgroundPass(const EyePicture& picture, CompositorScene& scene,
                                      const TexelLayer* layer) {
    const gl::PassTimers::Scope scope(scene.timers(), "background");
    if (picture.skip != SkippedPass::Background) return background_->draw(picture, layer);
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    return Done{};
}

Status Compositor::draw(std::span<const EyePicture> eyes, CompositorScene& scene, const AfterEye& afterEye) {
    prepare(eyes[0], scene);
    for (const EyePicture& eye : eyes)
        if (Status s = drawLayer(eye, scene); !s) return s;
    // The background is infinitely far: parallel eyes see the same of it, and copying is quicker than
    // drawing.
    const bool shared =
        eyes.size() == 2 && eyes[0].canvas.samples() == 1 && eyes[0].sharesFrame && eyesShareBackground();
    for (const EyePicture& eye : eyes) {
        const bool first = &eye == eyes.data();
        if (first || !shared) {
            eye.canvas.bindColour();
            if (Status s = drawBackground(eye, scene); !s) return s;
        }
        if (first && shared)
            eye.canvas.blitTo(eyes[1].canvas.framebuffer(), 0, eye.canvas.width(), eye.canvas.height());
        if (needsDepth(eye)) {
            glFlush(); // the background's pixels are drawn while the objects' vertices are shaded
            eye.canvas.bind();
        } else if (shared) {
            eye.canvas.bindColour();
        }
        if (Status s = drawForeground(eye, scene); !s) return s;
        if (afterEye) afterEye(eye);
    }
    return Done{};
}

namespace {

// The layer is this much wider than the eye's picture: the background's filter reaches a texel beyond its
// edge.
constexpr float kLayerWidth = 1.02f;

using Layers = std::array<LayerPass, 2>; // of the eyes

// Into the eye's layer, at the size given; particles in front of objects with them.
Status drawObjectsInto(LayerPass& layer, EyePicture picture, const glm::ivec2& size, int samples,
                       CompositorScene& scene) {
    layer.begin(size, samples);
    picture.view.heightPixels = size.y;
    if (Status s = scene.drawObjects(picture); !s) return s;
    if (Status s = scene.drawParticles(SnowPass::On::Objects, picture); !s) return s;
    layer.end();
    return Done{};
}

size_t indexOf(const EyePicture& picture) { return static_cast<size_t>(picture.eye); }

class PlainCompositor : public Compositor {
  public:
    using Compositor::Compositor;
    bool drawsObjects() const override { return true; }

  protected:
    Status drawBackground(const EyePicture& picture, CompositorScene& scene) override {
        // First, though objects hide some of it: testing the depth of every pixel costs more than that.
        if (Status s = drawBackgroundPass(picture, scene, nullptr); !s) return s;
        return scene.drawShadows(picture, nullptr);
    }
    bool needsDepth(const EyePicture&) const override { return true; }
    Status drawForeground(const EyePicture& picture, CompositorScene& scene) override {
        // Every pixel has a colour from the background: only the depth needs clearing.
        glDepthMask(GL_TRUE);
        glClear(GL_DEPTH_BUFFER_BIT);
        if (Status s = scene.drawObjects(picture); !s) return s;
        return scene.drawParticles(SnowPass::On::Everything, picture);
    }
};

// Objects in a smaller picture, laid over the background; plainly where the video is finer than the canvas.
class ResolutionCompositor final : public PlainCompositor {
  public:
    ResolutionCompositor(std::unique_ptr<BackgroundPass> background, Layers layers, int samples)
        : PlainCompositor(std::move(background)), layers_(std::move(layers)), samples_(samples) {}

  protected:
    static glm::ivec2 layerSize(const EyePicture& picture) {
        return sizeAsFine(picture.view, picture.size(), picture.environment.frameHeight());
    }
    bool needsDepth(const EyePicture& picture) const override { return layerSize(picture) == picture.size(); }
    Status drawLayer(const EyePicture& picture, CompositorScene& scene) override {
        if (needsDepth(picture)) return Done{};
        return drawObjectsInto(layers_[indexOf(picture)], picture, layerSize(picture), samples_, scene);
    }
    Status drawForeground(const EyePicture& picture, CompositorScene& scene) override {
        if (needsDepth(picture)) return PlainCompositor::drawForeground(picture, scene);
        // These particles lie behind the layer's objects; those before them are in it.
        if (Status s = scene.drawParticles(SnowPass::On::Picture, picture); !s) return s;
        layers_[indexOf(picture)].layOver(scene.visibleSpheres(picture.view), picture.view);
        return Done{};
    }

  private:
    Layers layers_;
    int samples_;
};

// Objects in the texels of the frame, over its seam and poles, and for both eyes. Display-coded frames only.
class TexelCompositor final : public Compositor {
  public:
    // filmed: with the response of the video's camera.
    TexelCompositor(std::unique_ptr<BackgroundPass> background, Layers layers, int samples, bool filmed)
        : Compositor(std::move(background)), layers_(std::move(layers)), samples_(samples), filmed_(filmed) {}
    bool drawsObjects() const override { return true; }

  protected:
    void prepare(const EyePicture& picture, CompositorScene& scene) override {
        chooseTiles(picture, scene);
        prepared_ = true;
        prepareBackground(picture, &tiles_);
    }
    Status drawLayer(const EyePicture& picture, CompositorScene& scene) override {
        EyePicture drawn = picture;
        drawn.view = widened(picture.view, kLayerWidth);
        drawn.exposure = {}; // objects in the frame are exposed with it
        auto rows = static_cast<float>(picture.environment.frameHeight());
        if (filmed_) rows /= layerTexels(picture.filmed.response, samples_);
        const glm::ivec2 size = sizeAsFine(drawn.view, picture.size(), static_cast<int>(rows));
        return drawObjectsInto(layers_[indexOf(picture)], drawn, size, samples_, scene);
    }
    Status drawBackground(const EyePicture& picture, CompositorScene& scene) override {
        if (!std::exchange(prepared_, false)) chooseTiles(picture, scene);
        LayerPass& layer = layers_[indexOf(picture)];
        const TexelLayer objects{layer, widened(picture.view, kLayerWidth), tiles_, filmed_};
        if (Status s = drawBackgroundPass(picture, scene, &objects); !s) return s;
        const ShadowPass::Cover cover{layer.layer().texture(), kLayerWidth, picture.size()};
        return scene.drawShadows(picture, &cover);
    }
    Status drawForeground(const EyePicture& picture, CompositorScene& scene) override {
        return scene.drawParticles(SnowPass::On::Picture, picture);
    }
    bool eyesShareBackground() const override { return false; }

  private:
    void chooseTiles(const EyePicture& picture, CompositorScene& scene) {
        tiles_.choose({picture.environment.frameWidth(), picture.environment.frameHeight()},
                      picture.envFromWorld, scene.visibleSpheres(widened(picture.view, kLayerWidth)),
                      picture.view.eyeWorld);
    }

    Layers layers_;
    int samples_;
    bool filmed_;
    FrameTiles tiles_;      // of the eye drawn last
    bool prepared_ = false; // tiles_ are the next eye's
};

// Four samples cost half a frame where the driver renders on the processor; and what is painted into texels
// is filtered by them anyway.
int defaultSamples(Composition composition) {
    return gl::rendersInSoftware() && composition != Composition::MatchedResolution ? 1 : 4;
}

// What is left of it for an HDR frame.
Composition possible(const CompositorSetup& setup) {
    if (setup.frameIsCoded) return setup.composition;
    return setup.composition == Composition::VideoTexels      ? Composition::MatchedResolution
           : setup.composition == Composition::CameraResponse ? Composition::Plain
                                                              : setup.composition;
}

} // namespace

Result<std::unique_ptr<Compositor>> makeCompositor(const CompositorSetup& setup) {
    const Composition composition = possible(setup);
    const bool texels = composition == Composition::VideoTexels || composition == Composition::CameraResponse;
    auto background = makeBackgroundPass(setup.backend, texels);
    if (!background) return background.error();
    if (composition == Composition::BackgroundOnly)
        return std::make_unique<Compositor>(std::move(*background));
    if (composition == Composition::Plain)
        return std::unique_ptr<Compositor>(new PlainCompositor(std::move(*background)));
    std::array<LayerPass, 2> layers;
    for (LayerPass& layer : layers) {
        auto made = LayerPass::make();
        if (!made) return made.error();
        layer = std::move(*made);
    }
    const int samples = setup.layerSamples > 0 ? setup.layerSamples : defaultSamples(composition);
    if (texels)
        return std::unique_ptr<Compositor>(new TexelCompositor(
            std::move(*background), std::move(layers), samples, composition == Composition::CameraResponse));
    return std::unique_ptr<Compositor>(
        new ResolutionCompositor(std::move(*background), std::move(layers), samples));
}

} // namespace shoal::render
