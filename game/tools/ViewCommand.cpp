// shoal view: shows any glTF model in any environment, as a picture or in a window with a turning camera.
#include "engine/core/Number.h"
#include "engine/core/WriteFile.h"
#include "game/tools/Commands.h"

#include "engine/gl/Renderer.h"
#include "engine/gl/Target.h"
#include "engine/media/Pictures.h"
#include "engine/occlusion/gpu/LayersGpu.h"
#include "engine/platform/Window.h"
#include "engine/render/BackgroundPass.h"
#include "engine/render/ObjectPass.h"
#include "engine/scene/Model.h"
#include "engine/scene/Surface.h"
#include "game/views/CreatureModels.h"
#include "game/views/Environment.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace shoal::app {

namespace {

constexpr int kSupersampling = 2; // in width and in height, besides multisampling, for written pictures

struct Clip {
    int animation = -1;
    float time_s = 0;
};

// Parses "NAME@SECONDS"; NAME alone starts at 0. As names may contain @, it takes the longest that exists.
Result<Clip> findClip(const scene::Model& model, const std::string& text, const std::string& file) {
    if (text.empty()) return Clip{};
    Clip clip{.animation = model.findAnimation(text)};
    size_t at = std::string::npos;
    while (clip.animation < 0 && at != 0 && (at = text.rfind('@', at - 1)) != std::string::npos)
        clip.animation = model.findAnimation(text.substr(0, at));
    if (clip.animation < 0) {
        at = text.rfind('@');
        std::string names;
        for (const scene::Animation& animation : model.animations)
            names += (names.empty() ? "" : ", ") + animation.name;
        return Error{file, "has no animation named " + text.substr(0, at) +
                               (names.empty() ? "; it has none" : "; it has " + names)};
    }
    if (at != std::string::npos) {
        const auto time_s = parseNumber<float>(std::string_view(text).substr(at + 1), -1e6f, 1e6f);
        if (!time_s) return Error{"--animation " + text, "wants NAME@SECONDS"};
        clip.time_s = *time_s;
    }
    return clip;
}

struct Orbit {
    glm::vec3 target{0};
    float theta = 0, phi = 1.5708f; // radians; theta from +Z towards +X, phi from straight up
    float radius = 1;               // metres
    float modelRadius = 1;          // radius of a sphere around the target that holds the model

    render::View view(float verticalFov, float aspect) const {
        const glm::vec3 back(std::sin(phi) * std::sin(theta), std::cos(phi), std::sin(phi) * std::cos(theta));
        const glm::vec3 right(std::cos(theta), 0, -std::sin(theta)); // level, even straight above the target
        const float far_m = (radius + modelRadius) * 1.01f;
        return {.eyeWorld = target + radius * back,
                .worldFromEye = glm::quat_cast(glm::mat3(right, glm::cross(back, right), back)),
                .verticalFov = verticalFov,
                .aspect = aspect,
                .near_m = std::max((radius - modelRadius) * 0.99f, far_m * 2e-4f),
                .far_m = far_m};
    }
};

bool isLayered(Occlusion occlusion) {
    return occlusion == Occlusion::Ollfb || occlusion == Occlusion::OllfbThesis;
}

class Viewer {
  public:
    explicit Viewer(const ViewOptions& options) : options_(options) {}

    Status open();
    Status writePicture();
    Status showWindow();

  private:
    Status draw(const gl::Target& target, bool withLayers = true);
    void pose();
    Status makeLayers();
    Status followPose(bool moving);
    void aim();

    const ViewOptions& options_;
    std::optional<platform::Headless> headless_; // before all that uses its context, and so destroyed last
    std::optional<platform::Window> window_;
    scene::Model model_;
    scene::Pose pose_;
    Clip clip_;
    render::ModelGpu gpu_;
    render::BodyOccluders body_; // has no parts, as no other body is near
    std::unique_ptr<Environment> environment_;
    std::unique_ptr<render::BackgroundPass> background_;
    std::optional<render::ObjectPass> objects_;
    std::optional<occlusion::LayersGpu> layers_; // of a still pose; empty while the model moves
    Orbit orbit_;
};

// Poses the model, whose meshes have been uploaded.
void Viewer::pose() {
    scene::restPose(model_, pose_);
    if (clip_.animation >= 0) scene::animate(model_, clip_.animation, clip_.time_s, pose_);
    scene::updateGlobals(model_, pose_);
    for (size_t n = 0; n < model_.nodes.size(); ++n) {
        const int mesh = model_.nodes[n].mesh;
        if (mesh >= 0 && !pose_.morphWeights[n].empty())
            render::uploadMorphed(model_.meshes[mesh], pose_.morphWeights[n], gpu_.meshes[mesh]);
    }
}

// Makes the layered fragment buffers of the posed model.
Status Viewer::makeLayers() {
    const scene::Surface surface = scene::posedSurface(model_, pose_);
    const std::vector<uint32_t>& corners = surface.opaque;
    std::vector<glm::uvec3> triangles;
    for (size_t i = 0; i + 2 < corners.size(); i += 3)
        triangles.emplace_back(corners[i], corners[i + 1], corners[i + 2]);
    auto layers = occlusion::LayersGpu::make({surface.positions, surface.normals, triangles},
                                             options_.look.occlusion == Occlusion::Ollfb
                                                 ? occlusion::LayerMethod::Ollfb
                                                 : occlusion::LayerMethod::Thesis,
                                             options_.layers);
    if (!layers) return Error{options_.model, layers.error().message()};
    layers_ = std::move(*layers);
    return Done{};
}

// Puts the camera where the options say, or so that the model fits into the picture.
void Viewer::aim() {
    const scene::Bounds bounds = scene::posedBounds(model_, pose_);
    const glm::vec3 middle = (bounds.low + bounds.high) * 0.5f;
    orbit_.target = options_.target.value_or(middle);
    orbit_.modelRadius =
        std::max(glm::distance(bounds.low, bounds.high) / 2 + glm::distance(orbit_.target, middle), 1e-6f);
    const glm::vec3 orbit = options_.orbit.value_or(glm::vec3(0, 90, 0));
    orbit_.theta = glm::radians(orbit.x);
    orbit_.phi = glm::radians(orbit.y);
    const float fits = orbit_.modelRadius / std::sin(glm::radians(options_.fov_deg) / 2) * 1.05f;
    // A radius of 0 becomes the smallest for which the camera's direction can still be computed.
    orbit_.radius = options_.orbit ? std::max(orbit.z, 1e-5f) : fits;
}

Status Viewer::open() {
    if (Status s = scene::loadModel(options_.model, options_.variant).moveTo(model_); !s) return s;
    if (Status s = findClip(model_, options_.animation, options_.model).moveTo(clip_); !s) return s;
    if (!options_.out.empty()) {
        if (Status s = platform::Headless::open().moveTo(headless_); !s) return s;
    } else {
        auto opened =
            platform::Window::open({"Shoal: " + options_.model, options_.look.size.x, options_.look.size.y});
        if (!opened)
            return Error{"", "there is no display to open a window on; --out FILE.png writes a picture"};
        window_ = std::move(*opened);
    }
    if (isLayered(options_.look.occlusion))
        if (Status can = occlusion::canKeepLayers(); !can) return Error{"--occlusion", can.error().message()};
    auto environment = Environment::open(
        {.player = {.source = options_.environment.orOwn(dataRoot() / "content/video/reef.mp4"),
                    .pyramid = options_.look.glossy == render::Glossy::PhongRings,
                    .minRoughness = scene::minGloss(model_).minRoughness,
                    .quality = light::LightQuality::Still,
                    .diffuse = options_.diffuse,
                    .diffuseWidth = widthOf(options_.diffuseSize)},
         .yaw_deg = options_.environment.envYaw_deg},
        [this](float) { return !window_ || !window_->poll().closing; });
    if (!environment) return environment.error();
    environment_ = std::move(*environment);
    environment_->update(static_cast<double>(options_.at_s), true);
    if (options_.look.occlusion == Occlusion::Ellipsoids) occlusionOf(options_.model, model_);
    if (options_.look.occlusion != Occlusion::Off) {
        body_.albedo = scene::meanBaseColour(model_);
        if (reflectanceIn(options_.environment) == render::Reflectance::Coded)
            body_.albedo = glm::pow(body_.albedo, glm::vec3(1 / 2.2f));
    }
    gpu_ = render::uploadModel(model_, reflectanceIn(options_.environment));
    pose();
    if (Status s = render::BackgroundPass::make(options_.look.backend, false).moveTo(background_); !s)
        return s;
    if (Status s = render::ObjectPass::make(render::Detail::Full, options_.look.occlusion != Occlusion::Off,
                                            options_.look.shown)
                       .moveTo(objects_);
        !s)
        return s;
    aim();
    return Done{};
}

Status Viewer::draw(const gl::Target& target, bool withLayers) {
    target.bind();
    glClearColor(0, 0, 0, 0);
    glDepthMask(GL_TRUE);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    const render::View view =
        orbit_.view(glm::radians(options_.fov_deg),
                    static_cast<float>(target.width()) / static_cast<float>(target.height()));
    const render::Exposure exposure = environment_->exposure(options_.look.tone, options_.look.exposure_ev);
    objects_->setLayers(layers_ && withLayers ? &*layers_ : nullptr);
    objects_->begin();
    objects_->add({.model = model_,
                   .gpu = gpu_,
                   .pose = pose_,
                   .bound = {orbit_.target, orbit_.modelRadius},
                   .body = &body_});
    const render::EyePicture picture{.environment = environment_->gpu(0),
                                     .envFromWorld = environment_->envFromWorld(),
                                     .view = view,
                                     .exposure = exposure,
                                     .canvas = target};
    if (options_.background == Background::Environment &&
        options_.look.skip != render::SkippedPass::Background)
        if (Status s = background_->draw(picture, nullptr); !s) return s;
    if (options_.look.skip == render::SkippedPass::Objects) return Done{};
    return objects_->draw(picture, {}, options_.look.glossy);
}

// Halves width and height with a filter two output pixels wide whose weights fall off, as path tracers do:
// edges are less jagged than with a box. Unpremultiplies alpha.
ImageRgba8 reduced(const ImageRgba8& large) {
    static_assert(kSupersampling == 2);
    constexpr std::array<float, 4> kWeights = {1 / 8.0f, 3 / 8.0f, 3 / 8.0f, 1 / 8.0f};
    ImageRgba8 small(large.width / 2, large.height / 2);
    for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x) {
            glm::vec4 sum(0);
            for (int dy = 0; dy < 4; ++dy)
                for (int dx = 0; dx < 4; ++dx) {
                    const uint8_t* from = large.at(std::clamp(2 * x + dx - 1, 0, large.width - 1),
                                                   std::clamp(2 * y + dy - 1, 0, large.height - 1));
                    sum += kWeights[dx] * kWeights[dy] * glm::vec4(from[0], from[1], from[2], from[3]);
                }
            const glm::vec3 straight = sum.a > 0 ? glm::vec3(sum) * 255.0f / sum.a : glm::vec3(0);
            for (int c = 0; c < 3; ++c)
                small.at(x, y)[c] = static_cast<uint8_t>(std::lround(std::min(straight[c], 255.0f)));
            small.at(x, y)[3] = static_cast<uint8_t>(std::lround(sum.a));
        }
    return small;
}

Status Viewer::writePicture() {
    if (isLayered(options_.look.occlusion))
        if (Status seen = makeLayers(); !seen) return seen;
    const glm::ivec2 size = options_.look.size * kSupersampling;
    GLint maximum = 0;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &maximum);
    if (size.x > maximum || size.y > maximum)
        return Error{"--size", "is more than the graphics driver can draw"};
    const gl::Target target(size.x, size.y, options_.samples);
    if (Status drawn = draw(target); !drawn) return drawn;
    return media::writePng(options_.out, reduced(target.read()));
}

// Rebuilds the layers for a still pose. This takes up to a second, so a moving body is shown without layers.
Status Viewer::followPose(bool moving) {
    if (!isLayered(options_.look.occlusion) || (!moving && layers_)) return Done{};
    window_->setTitle(
        "Shoal: " + options_.model +
        (moving ? " (reflections and shadows of itself are rebuilt when the animation pauses: space)" : ""));
    layers_.reset();
    return moving ? Done{} : makeLayers();
}

Status Viewer::showWindow() {
    gl::Target target;
    bool turned = true; // the camera has turned since the last picture
    double clipStart = glfwGetTime();
    bool moving = !options_.animation.empty() || !model_.animations.empty();
    if (clip_.animation < 0 && !model_.animations.empty()) clip_.animation = 0;
    for (;;) {
        const platform::WindowInput& input = window_->poll();
        // Reads presses, not held keys: a key may be pressed and released between two frames.
        if (input.closing || std::ranges::count(input.keysPressed, GLFW_KEY_ESCAPE)) return Done{};
        for (const int key : input.keysPressed) {
            if (key == GLFW_KEY_SPACE) moving = !moving;
            if (key == GLFW_KEY_F11) window_->toggleFullscreen();
            if (key == GLFW_KEY_N && !model_.animations.empty()) {
                clip_.animation = (clip_.animation + 1) % static_cast<int>(model_.animations.size());
                clipStart = glfwGetTime();
            }
        }
        if (input.leftButton || input.rightButton) {
            orbit_.theta -= static_cast<float>(input.cursorMoved.x) * 0.008f;
            orbit_.phi =
                std::clamp(orbit_.phi - static_cast<float>(input.cursorMoved.y) * 0.008f, 0.01f, 3.13f);
        }
        orbit_.radius *= std::exp2(static_cast<float>(-input.wheel) * 0.15f);
        if (moving && clip_.animation >= 0) {
            const float duration = model_.animations[clip_.animation].duration_s;
            clip_.time_s =
                duration > 0 ? static_cast<float>(std::fmod(glfwGetTime() - clipStart, duration)) : 0;
            pose();
        }
        if (Status shown = followPose(moving && clip_.animation >= 0); !shown) return shown;
        const bool relit = environment_->update(glfwGetTime() + static_cast<double>(options_.at_s), false);
        const glm::ivec2 size = window_->framebufferSize();
        if (size.x > 0 && size.y > 0) {
            const bool resized = target.width() != size.x || target.height() != size.y;
            if (resized) target = gl::Target(size.x, size.y, options_.samples);
            const bool turns = input.leftButton || input.rightButton || input.wheel != 0;
            // A software renderer traces for seconds, so it leaves the layers out while the camera turns.
            const bool withLayers = !(turns && gl::rendersInSoftware());
            if (turns || turned || moving || relit || resized || !input.keysPressed.empty())
                if (Status drawn = draw(target, withLayers); !drawn) return drawn;
            turned = turns;
            target.blitTo(0, 0, size.x, size.y);
        }
        window_->present();
    }
}

// Returns an error if an option of a method is given with another method.
Status checkMethods(const ViewOptions& options) {
    const ViewOptions usual;
    const auto& [views, resolution, maxBytes] = options.layers;
    if (options.diffuse != light::DiffuseMethod::Thesis && options.diffuseSize != usual.diffuseSize)
        return Error{"--diffuse-size", "is for --diffuse thesis"};
    if (!isLayered(options.look.occlusion) &&
        (views != usual.layers.views || resolution != usual.layers.resolution))
        return Error{"--ollfb-views and --ollfb-size", "are for --occlusion ollfb and ollfb-thesis"};
    if (options.look.occlusion == Occlusion::OllfbThesis && !occlusion::ThesisViews::cellsFor(views))
        return Error{"--ollfb-views", "the thesis has 6 n^2 views: 54, 96, 150, 216, 294, 384, 486 ..."};
    return Done{};
}

} // namespace

Status view(const ViewOptions& options) {
    if (Status possible = checkMethods(options); !possible) return possible;
    if (!options.out.empty()) { // outputs are checked before the work
        if (media::writtenAs(options.out) != media::WrittenAs::Png)
            return Error{options.out, "pictures are PNG files; let the name end in .png"};
        if (Status possible = checkOutputs(std::array{NamedFile{"--out", options.out}}); !possible)
            return possible;
    }
    Viewer viewer(options);
    if (Status opened = viewer.open(); !opened) return opened;
    return options.out.empty() ? viewer.showWindow() : viewer.writePicture();
}

} // namespace shoal::app
