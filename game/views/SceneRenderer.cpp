#include "game/views/SceneRenderer.h"

#include "engine/core/Log.h"
#include "engine/render/LayerPass.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <utility>

namespace shoal::app {

Result<SceneRenderer::Passes> SceneRenderer::makePasses(const SceneRendererSetup& setup) {
    Passes passes;
    Status made = render::ObjectPass::make(setup.detail, setup.occlusion, setup.shown).moveTo(passes.objects);
    if (made) made = render::ParticlePass::make().moveTo(passes.particles);
    if (made && setup.floorShadows) made = render::FloorShadowPass::make().moveTo(passes.floorShadows);
    if (made) made = render::Compositor::make(setup.compositor).moveTo(passes.compositor);
    if (!made) return made.error();
    return passes;
}

Status SceneRenderer::reloadShaders() {
    auto passes = makePasses(setup_);
    if (!passes) return passes.error();
    beforeReload_ = std::exchange(passes_, std::move(*passes));
    return Done{};
}

void SceneRenderer::set(const game::Snapshot& snapshot, const Environment& environment, const Look& look) {
    environment_ = &environment;
    look_ = look;
    time_s_ = snapshot.time_s;
    headWorld_ = snapshot.headWorld;
    passes_.objects.begin();
    if (passes_.floorShadows) passes_.floorShadows->begin();
    if (!passes_.compositor.drawsObjects()) return;
    const bool bounces = setup_.skip != render::SkippedPass::Bounce;
    const environment::Player& film = environment.player();
    const bool knowsPlaces = bounces && environment.depth();
    animalLight_.follow(snapshot, knowsPlaces ? &film.frame().lightDifference : nullptr,
                        environment.envFromWorld(), {look.lamp, film.water().attenuation_perM},
                        knowsPlaces ? FocusedLight{&film.caustics(), environment.depth(), &film.shadowLight()}
                                    : FocusedLight{});
    const Head viewer{snapshot.headWorld, snapshot.worldFromView};
    creatureModels_->show(snapshot, look.player.value_or(viewer), animalLight_, passes_.objects);
}

// Returns the strongest light, of presence 0 if none stands out.
render::CastingLight SceneRenderer::castingLight() const {
    return render::castingLight(environment_->player().shadowLight(),
                                glm::transpose(environment_->envFromWorld()));
}

// Begins to cast shadows on the film, on their own thread, but not on a film without distances, where they
// would hang in the water.
void SceneRenderer::castShadows() {
    const render::FilmDistances& depth = pictures_[0].environment.depth();
    const bool wanted = setup_.shadows && castsShadows();
    if (!wanted || !depth.map || pictures_[0].surroundings == render::Surroundings::Room) return;
    const gl::PassTimers::Scope scope(&timers_, "shadows");
    filmed_.clear();
    for (const render::EyePicture& picture : pictures_) filmed_.push_back(filmedFrom(picture));
    Shadows& to = *shadows_;
    to.films = environment_->eyesSeeTheSame() ? 1 : static_cast<int>(pictures_.size());
    const uint64_t frame = pictures_[0].environment.frameNumber();
    // Shadows are made once for a frame of the film, for wider views, within which the head may turn.
    constexpr float kWider = 1.2f; // 3 to 4 degrees on each side
    if (to.film.map == depth.map && to.frame == frame &&
        std::ranges::equal(to.from, filmed_, render::holds)) {
        setShadows();
        return;
    }
    for (render::View& view : filmed_) view = render::widened(view, kWider);
    to.from = filmed_;
    to.frame = frame;
    to.film = {depth.map, depth.range, environment_->envFromWorld(), glm::vec3(0)};
    to.coding = look_.exposure.frames;
    to.water = environment_->player().water();
    to.lights[0] = castingLight();
    to.lights[1] = render::restBeside(to.lights[0]);
    to.objects = &passes_.objects;
    to.isRunning = true;
    to.thread.start(to.films, to);
}

void SceneRenderer::Shadows::operator()(int number) {
    render::FilmShadows& on = cast[number];
    const std::span<const render::View> all(from), own = all.subspan(static_cast<size_t>(number), 1);
    render::FilmSurface each = film;
    if (films != 1) each.cameraWorld = own[0].eyeWorld;
    on.begin(each, coding, water);
    const render::NearBodies& bodies = objects->bodies();
    for (size_t body = 0; body < bodies.count(); ++body)
        for (const render::CastingLight& light : lights) // of the player's arms the strongest light alone
            if (&light == &lights[0] || !objects->isInRoom(body))
                on.add(bodies.ellipsoids(body), light, films == 1 ? all : own);
}

void SceneRenderer::finishShadows() {
    if (!shadows_->isRunning) return;
    const PartTimes::Scope part(&timers_.onThread(), "wait for shadows");
    shadows_->thread.finish();
    shadows_->isRunning = false;
    setShadows();
}

void SceneRenderer::setShadows() {
    for (size_t eye = 0; eye < pictures_.size(); ++eye)
        pictures_[eye].shadows = &shadows_->cast[shadows_->films == 1 ? 0 : eye];
}

// Casts the creatures' shadows on the room's floor; the player's hands cast their own.
void SceneRenderer::castOnFloor(std::optional<float> floor_m) {
    if (pictures_[0].surroundings == render::Surroundings::Film || !floor_m) return;
    const render::CastingLight light = castingLight();
    if (!castsShadows() || light.presence == 0) return;
    const render::NearBodies& bodies = passes_.objects.bodies();
    for (size_t body = 0; body < bodies.count(); ++body)
        if (!passes_.objects.isInRoom(body))
            passes_.floorShadows->add(bodies.ellipsoids(body), light, *floor_m, look_.exposure.frames);
}

// Returns the eye's position relative to the film's camera, env frame; 0 without distances or with a picture
// for each eye. It is limited to 0.3 m: an eye farther away moves the film along.
glm::vec3 SceneRenderer::eyeInFilm(const render::View& view) const {
    constexpr float kNearest_m = 0.001f, kFurthest_m = 0.3f;
    const float away = glm::length(view.eyeWorld);
    if (!environment_->depth() || !environment_->eyesSeeTheSame() || away < kNearest_m) return glm::vec3(0);
    return environment_->envFromWorld() * view.eyeWorld * std::min(1.0f, kFurthest_m / away);
}

render::EyePicture SceneRenderer::pictureOf(const Eye& eye) {
    return {.environment = environment_->gpu(eye.eye),
            .envFromWorld = environment_->envFromWorld(),
            .view = eye.view,
            .exposure = look_.exposure,
            .canvas = eye.canvas,
            .eye = eye.eye,
            .filmed = {environment_->player().cameraResponse(), environment_->player().frameIndex()},
            .eyeInFilm = eyeInFilm(eye.view),
            .skip = setup_.skip,
            .surroundings = eye.surroundings,
            .timers = &timers_};
}

Status SceneRenderer::draw(std::span<const Eye> eyes, const render::Compositor::AfterEye& afterEye) {
    pictures_.clear();
    for (const Eye& eye : eyes) pictures_.push_back(pictureOf(eye));
    castShadows();
    if (passes_.floorShadows) castOnFloor(eyes[0].floor_m);
    Status drawn = passes_.compositor.draw(pictures_, *this, afterEye);
    finishShadows(); // if the drawing has failed before: the thread uses the frame's content
    if (drawn || !beforeReload_) return drawn;
    log::warn("{}", drawn.error().message());
    passes_ = std::move(*beforeReload_); // they draw from the next frame on
    beforeReload_.reset();
    return Done{};
}

Status SceneRenderer::drawObjects(const render::EyePicture& picture) {
    if (setup_.skip == render::SkippedPass::Objects) return Done{};
    {
        const gl::PassTimers::Scope scope(&timers_, "objects");
        if (Status drawn = passes_.objects.draw(picture, waterAround(picture), look_.glossy); !drawn)
            return drawn;
    }
    const bool inRoom = picture.surroundings == render::Surroundings::Room;
    if (inRoom && passes_.floorShadows && !passes_.floorShadows->empty()) {
        const gl::PassTimers::Scope scope(&timers_, "shadows");
        passes_.floorShadows->draw(picture.view);
    }
    return Done{};
}

Status SceneRenderer::drawParticles(render::ParticlePass::On on, const render::EyePicture& picture) {
    const water::Water water = waterAround(picture);
    if (!look_.particles || water.none() || setup_.skip == render::SkippedPass::Particles) return Done{};
    const gl::PassTimers::Scope scope(&timers_, "particles");
    return passes_.particles.draw(on, picture, water, time_s_);
}

// Returns the view from which the background is drawn: from the eye's position in the film or, with a picture
// for each eye, from the eye's offset from the head.
render::View SceneRenderer::filmedFrom(const render::EyePicture& picture) const {
    render::View view = picture.view;
    view.eyeWorld = environment_->eyesSeeTheSame() ? glm::transpose(picture.envFromWorld) * picture.eyeInFilm
                                                   : picture.view.eyeWorld - headWorld_;
    return view;
}

std::span<const scene::Sphere> SceneRenderer::visibleSpheres(const render::View& view) {
    spheres_.clear();
    passes_.objects.addVisible(view, spheres_);
    return spheres_;
}

} // namespace shoal::app
