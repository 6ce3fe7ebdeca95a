#include "engine/render/Compositor.h"

#include "engine/gl/Renderer.h"

namespace shoal::render {

namespace {

// A layer for texels is this much wider than the eye's picture: the filter reaches a texel beyond its edge.
constexpr float kLayerWidth = 1.02f;

// Returns the composition that is possible: an HDR frame has no coded texels and no camera.
Composition possible(const CompositorSetup& setup) {
    const Composition wanted = setup.composition;
    if (setup.frameIsCoded) return wanted;
    if (wanted == Composition::VideoTexels) return Composition::MatchedResolution;
    return wanted == Composition::CameraResponse ? Composition::Plain : wanted;
}

} // namespace

Result<Compositor> Compositor::make(const CompositorSetup& setup) {
    Compositor made;
    made.composition_ = possible(setup);
    const bool filtered = setup.frameIsCoded && made.composition_ != Composition::MatchedResolution;
    made.samples_ = filtered ? gl::defaultSamples() : 4;
    if (Status s = BackgroundPass::make(setup.backend, made.mayDrawIntoTexels()).moveTo(made.background_); !s)
        return s.error();
    // Objects in texels are filtered with them, but for an eye beside the film's camera none are in texels.
    made.smoothsOutlines_ =
        made.samples_ > 1 && made.drawsObjects() && (!setup.frameIsCoded || made.mayDrawIntoTexels());
    if (made.mayDrawIntoTexels() || made.composition_ == Composition::MatchedResolution ||
        made.smoothsOutlines_)
        for (LayerPass& layer : made.layers_)
            if (Status s = LayerPass::make().moveTo(layer); !s) return s.error();
    return made;
}

glm::ivec2 Compositor::layerSize(const EyePicture& picture) const {
    if (composition_ == Composition::Plain || !showsFilm(picture)) return picture.size();
    auto rows = static_cast<float>(picture.environment.displayFrame().height);
    if (filmed() && drawsIntoTexels(picture)) rows /= layerTexels(picture.filmed.response, samples_);
    return sizeAsFine(drawsIntoTexels(picture) ? widened(picture.view, kLayerWidth) : picture.view,
                      picture.size(), static_cast<int>(rows));
}

// Without a layer, objects are drawn into the canvas, for example if the video is finer than the canvas. HDR
// pictures have no texels to blur objects, whose outlines would show stairs in a canvas of one sample.
bool Compositor::usesLayer(const EyePicture& picture) const {
    return drawsIntoTexels(picture) || (smoothsOutlines_ && picture.canvas.samples() == 1) ||
           ((mayDrawIntoTexels() || composition_ == Composition::MatchedResolution) &&
            layerSize(picture) != picture.size());
}

// Chooses the tiles with objects, and begins the background.
void Compositor::prepareBackground(const EyePicture& picture, CompositorScene& scene) {
    const PartTimes::Scope part(picture.partTimes(), "background");
    const DisplayFrame& frame = picture.environment.displayFrame();
    if (drawsIntoTexels(picture))
        tiles_.choose({frame.width, frame.height}, picture.envFromWorld,
                      scene.visibleSpheres(widened(picture.view, kLayerWidth)), picture.view.eyeWorld);
    if (drawsFilm(picture)) background_->prepare(picture, drawsIntoTexels(picture) ? &tiles_ : nullptr);
}

// Draws objects, and particles in front of them, into the eye's layer.
Status Compositor::drawLayer(EyePicture picture, CompositorScene& scene) {
    const glm::ivec2 size = layerSize(picture);
    if (drawsIntoTexels(picture)) {
        picture.view = widened(picture.view, kLayerWidth);
        picture.exposure = {.frames = picture.exposure.frames}; // objects in the frame are exposed with it
    }
    picture.view.heightPixels = size.y;
    layerOf(picture).begin(size, samples_);
    if (Status s = scene.drawObjects(picture); !s) return s;
    if (Status s = scene.drawParticles(ParticlePass::On::Objects, picture); !s) return s;
    layerOf(picture).end();
    if (samples_ != 1) return Done{};
    timed(picture.partTimes(), "wait for the layer", [&] {
        glFlush();
        background_->help();
        layerOf(picture).pixels();
    });
    timed(picture.partTimes(), "outlines", [&] { layerOf(picture).smoothOutlines(); });
    return Done{};
}

Status Compositor::drawBackground(const EyePicture& picture) {
    if (!drawsFilm(picture)) {
        glClearColor(0, 0, 0, showsFilm(picture) ? 1 : 0);
        glClear(GL_COLOR_BUFFER_BIT);
        return Done{};
    }
    const gl::PassTimers::Scope scope(picture.timers, "background");
    if (!drawsObjects() || !usesLayer(picture)) return background_->draw(picture, nullptr);
    const bool inTexels = drawsIntoTexels(picture);
    const ObjectLayer layer{layerOf(picture), inTexels ? widened(picture.view, kLayerWidth) : picture.view,
                            inTexels ? &tiles_ : nullptr, filmed()};
    return background_->draw(picture, &layer);
}

Status Compositor::drawForeground(EyePicture picture, CompositorScene& scene) {
    if (!drawsObjects()) return Done{};
    if (usesLayer(picture)) {
        if (!drawsFilm(picture)) layerOf(picture).layOver();
        // The layer has the particles in front of its objects; it hides those behind them.
        picture.layer = layerOf(picture).texture();
        picture.layerWidth = drawsIntoTexels(picture) ? kLayerWidth : 1;
        return scene.drawParticles(ParticlePass::On::Picture, picture);
    }
    glFlush(); // the background's pixels are drawn while the objects' vertices are shaded
    picture.canvas.bind();
    // The background has filled every pixel: only the depth needs clearing.
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    if (Status s = scene.drawObjects(picture); !s) return s;
    return scene.drawParticles(ParticlePass::On::Everything, picture);
}

Status Compositor::draw(std::span<const EyePicture> eyes, CompositorScene& scene, const AfterEye& afterEye) {
    prepareBackground(eyes[0], scene);
    // Software renderers finish a framebuffer before they begin another, so layers come before all canvases.
    for (const EyePicture& eye : eyes)
        if (usesLayer(eye))
            if (Status s = drawLayer(eye, scene); !s) return s;
    scene.finishShadows();
    for (const EyePicture& eye : eyes) {
        eye.canvas.bindColour();
        // The background comes first, though objects hide some of it: testing all depths would cost more.
        if (Status s = drawBackground(eye); !s) return s;
        if (&eye != &eyes.back()) prepareBackground((&eye)[1], scene);
        if (Status s = drawForeground(eye, scene); !s) return s;
        if (afterEye) afterEye(eye);
    }
    return Done{};
}

Status Compositor::drawDepth(const EyePicture& picture, GLuint into) {
    if (!drawsObjects()) {
        glBindFramebuffer(GL_FRAMEBUFFER, into);
        glDepthMask(GL_TRUE);
        glClear(GL_DEPTH_BUFFER_BIT);
        return Done{};
    }
    if (!depth_)
        if (Status s = DepthPass::make().moveTo(depth_); !s) return s;
    const bool film = drawsFilm(picture) && picture.environment.depth().map;
    depth_->draw(usesLayer(picture) ? layerOf(picture).layer() : picture.canvas,
                 drawsIntoTexels(picture) ? 1 / kLayerWidth : 1.0f, into, picture, film);
    return Done{};
}

} // namespace shoal::render
