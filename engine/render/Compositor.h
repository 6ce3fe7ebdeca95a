// Strategies that combine virtual objects with the filmed background, for one eye or two. The thread of the
// OpenGL context only.
#pragma once

#include "engine/gl/PassTimers.h"
#include "engine/render/BackgroundPass.h"
#include "engine/render/EyePicture.h"
#include "engine/render/ShadowPass.h"
#include "engine/render/SnowPass.h"

#include <functional>
#include <memory>
#include <span>

namespace shoal::render {

// What a compositor asks the scene to draw, into the framebuffer that is bound.
class CompositorScene {
  public:
    // With depth, which has been cleared. Colours are premultiplied by coverage.
    virtual Status drawObjects(const EyePicture& picture) = 0;
    virtual Status drawParticles(SnowPass::On on, const EyePicture& picture) = 0;
    // On the background just drawn. cover: where objects are in it already; null: nowhere.
    virtual Status drawShadows(const EyePicture& picture, const ShadowPass::Cover* cover) = 0;
    virtual gl::PassTimers& timers() = 0;
    // Spheres that hold all objects in the view; world. Valid until the next call.
    virtual std::span<const scene::Sphere> visibleSpheres(const View& view) = 0;

  protected:
    ~CompositorScene() = default;
};

// The base class draws the background only.
class Compositor {
  public:
    explicit Compositor(std::unique_ptr<BackgroundPass> background) : background_(std::move(background)) {}
    virtual ~Compositor() = default;
    Compositor(const Compositor&) = delete;
    Compositor& operator=(const Compositor&) = delete;

    using AfterEye = std::function<void(const EyePicture&)>;
    // Draws each eye's picture; afterEye is called with its canvas bound.
    Status draw(std::span<const EyePicture> eyes, CompositorScene& scene, const AfterEye& afterEye);

    virtual bool drawsObjects() const { return false; } // else the scene is never asked

  protected:
    // Called in this order: prepare() for the first eye, drawLayer() for each, then the others eye by eye.
    // Software renderers finish a framebuffer before they begin another, so layers come before all canvases.
    virtual void prepare(const EyePicture& picture, CompositorScene&) { prepareBackground(picture, nullptr); }
    virtual Status drawLayer(const EyePicture&, CompositorScene&) { return Done{}; }
    virtual Status drawBackground(const EyePicture& picture, CompositorScene& scene) {
        return drawBackgroundPass(picture, scene, nullptr);
    }
    virtual bool needsDepth(const EyePicture&) const { return false; } // of the canvas, in drawForeground()
    virtual Status drawForeground(const EyePicture&, CompositorScene&) { return Done{}; }
    virtual bool eyesShareBackground() const { return true; }

    void prepareBackground(const EyePicture& picture, const FrameTiles* tiles);
    Status drawBackgroundPass(const EyePicture& picture, CompositorScene& scene, const TexelLayer* layer);

  private:
    std::unique_ptr<BackgroundPass> background_;
};

struct CompositorSetup {
    Composition composition = Composition::Plain;
    Backend backend = Backend::Auto;
    int layerSamples = 0;     // anti-aliasing of layers; 0: by driver and composition
    bool frameIsCoded = true; // else HDR: nothing can be put into its texels, and no camera filmed it
};
Result<std::unique_ptr<Compositor>> makeCompositor(const CompositorSetup& setup);

} // namespace shoal::render
