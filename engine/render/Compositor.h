// Combines virtual objects with the filmed background, for one eye or two. On the OpenGL thread only.
#pragma once

#include "engine/render/BackgroundPass.h"
#include "engine/render/HeadsetPasses.h"
#include "engine/render/ParticlePass.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>

namespace shoal::render {

// Scene that draws its objects and particles into the bound framebuffer when a compositor asks.
class CompositorScene {
  public:
    // Draws with depth, which has been cleared. Colours are premultiplied by coverage.
    virtual Status drawObjects(const EyePicture& picture) = 0;
    virtual Status drawParticles(ParticlePass::On on, const EyePicture& picture) = 0;
    // Completes the shadows of the pictures that are being drawn, which are cast while layers are drawn.
    virtual void finishShadows() = 0;
    // Returns spheres that hold all objects in the view, world frame; valid until the next call.
    virtual std::span<const scene::Sphere> visibleSpheres(const View& view) = 0;

  protected:
    ~CompositorScene() = default;
};

struct CompositorSetup {
    Composition composition = Composition::Plain;
    Backend backend = Backend::Auto;
    bool frameIsCoded = true; // else HDR: nothing can be put into its texels, and no camera filmed it

    bool operator==(const CompositorSetup&) const = default;
};

class Compositor {
  public:
    static Result<Compositor> make(const CompositorSetup& setup);

    using AfterEye = std::function<void(const EyePicture&)>;
    // Draws each eye's picture; afterEye is called with its canvas bound.
    Status draw(std::span<const EyePicture> eyes, CompositorScene& scene, const AfterEye& afterEye);

    // Draws depth into a framebuffer: that of the objects just drawn in this picture (in the canvas or in a
    // layer) and that of the film where it is known, or else that of the far plane.
    Status drawDepth(const EyePicture& picture, GLuint into);

    bool drawsObjects() const { return composition_ != Composition::BackgroundOnly; }

  private:
    static bool showsFilm(const EyePicture& picture) { return picture.surroundings == Surroundings::Film; }
    static bool drawsFilm(const EyePicture& picture) {
        return showsFilm(picture) && picture.skip != SkippedPass::Background;
    }
    bool filmed() const { return composition_ == Composition::CameraResponse; }
    bool mayDrawIntoTexels() const { return composition_ == Composition::VideoTexels || filmed(); }
    // To an eye beside the film's camera, texels and objects have different parallaxes: objects cannot then
    // be painted into texels.
    bool drawsIntoTexels(const EyePicture& picture) const {
        return mayDrawIntoTexels() && showsFilm(picture) && !picture.filmParallax().depth;
    }
    glm::ivec2 layerSize(const EyePicture& picture) const;
    bool usesLayer(const EyePicture& picture) const;
    LayerPass& layerOf(const EyePicture& picture) { return layers_[static_cast<size_t>(picture.eye)]; }
    void prepareBackground(const EyePicture& picture, CompositorScene& scene);
    Status drawLayer(EyePicture picture, CompositorScene& scene);
    Status drawBackground(const EyePicture& picture);
    Status drawForeground(EyePicture picture, CompositorScene& scene);

    Composition composition_ = Composition::BackgroundOnly;
    std::unique_ptr<BackgroundPass> background_;
    std::array<LayerPass, 2> layers_; // by eye; for objects at their own resolution or in texels
    int samples_ = 1;                 // of a layer's pixel; if 1, its outlines are smoothed
    bool smoothsOutlines_ = false;    // whether objects in a canvas of one sample are smoothed
    FrameTiles tiles_;                // for the eye drawn last
    std::optional<DepthPass> depth_;  // made when it is first needed
};

} // namespace shoal::render
