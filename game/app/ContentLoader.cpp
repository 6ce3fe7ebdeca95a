#include "game/app/ContentLoader.h"

#include "engine/gl/Renderer.h"
#include "game/views/FilmSpaceOf.h"

#include <thread>

namespace shoal::app {

namespace {

render::Composition compositionIn(const PlayOptions& options) {
    return options.look.skip == render::SkippedPass::Objects ? render::Composition::BackgroundOnly
                                                             : options.compose;
}

render::Detail detail() { return gl::rendersInSoftware() ? render::Detail::Lean : render::Detail::Full; }

EnvironmentSetup environmentSetup(const PlayOptions& options, const game::DiveFile& dive, bool seesRoom) {
    const bool own = options.environment.isOwnVideo();
    const bool slow = gl::rendersInSoftware() || std::thread::hardware_concurrency() < 4;
    const Path film = filmFor(dataRoot() / "content" / dive.video, options.film, slow);
    return {.player = {.source = options.environment.orOwn(film),
                       .drawsDepth = options.look.skip != render::SkippedPass::Depth,
                       .roomIsSeen = seesRoom,
                       .waterIsCertain = own || options.water == WaterChoice::On,
                       .analysis = {.pyramid = options.look.glossy == render::Glossy::PhongRings,
                                    .water = options.water == WaterChoice::On ||
                                             (options.water == WaterChoice::Auto && (!own || dive.water)),
                                    .lights = options.shadows == ShadowChoice::On,
                                    .cameraResponse =
                                        compositionIn(options) == render::Composition::CameraResponse}},
            .yaw_deg = options.environment.envYaw_deg,
            .bothEyes = options.stereo == StereoOutput::SideBySide || options.xr};
}

SceneRendererSetup rendererSetup(const PlayOptions& options, const Environment& environment, bool seesRoom) {
    const bool shadows = options.shadows == ShadowChoice::On;
    return {.detail = detail(),
            .shadows = shadows && environment.player().hasDepthTrack(),
            .floorShadows = shadows && seesRoom,
            .occlusion = options.look.occlusion == Occlusion::Ellipsoids,
            .shown = options.look.shown,
            .skip = options.look.skip,
            .compositor = {.composition = compositionIn(options),
                           .backend = options.look.backend,
                           .frameIsCoded = environment.gpu(0).frameIsCoded()}};
}

} // namespace

Status findFilmSpace(const Path& film, const EnvironmentOptions& options, SessionConfig& config) {
    config.dive.space.reset();
    const bool wanted = !config.replay || game::needsFilmSpace(config.replay->header());
    if (wanted && !film.empty() && options.depth)
        config.dive.space = filmSpaceOf(film, glm::radians(options.envYaw_deg));
    return config.replay ? game::checkFilmSpace(config.replay->header(), config.dive.space.get()) : Done{};
}

// Loads the models first, because the light is made for the least roughness of their surfaces.
Status ContentLoader::open(const PlayOptions& options, SessionConfig& config, bool seesRoom, bool filmFirst) {
    EnvironmentSetup wanted = environmentSetup(options, config.dive, seesRoom);
    Models models{reflectanceIn(options.environment), enumName(options.skin),
                  game::speciesShown(config.species, config.dive)};
    if (loaded_ != models) {
        loaded_.reset();
        models_.reset();
        renderer_.reset();
        environment_.reset();
        if (filmFirst) {
            wanted.player.analysis.minRoughness = 1;
            if (Status s = Environment::open(wanted, progress_).moveTo(environment_); !s) return s;
            SceneRendererSetup setup = rendererSetup(options, *environment_, seesRoom);
            setup.compositor.composition = render::Composition::BackgroundOnly;
            if (Status s = SceneRenderer::make({}, setup).moveTo(renderer_); !s) return s;
        }
        auto read = CreatureModels::load(config.species, models.shown, models.skin, models.reflectance,
                                         detail(), progress_);
        if (!read) return read.error();
        renderer_.reset();
        environment_.reset();
        models_ = std::move(*read);
        loaded_ = std::move(models);
        minRoughness_ = models_->minRoughness();
    }
    wanted.player.analysis.minRoughness = minRoughness_;
    const auto dropRenderer = [this] {
        if (renderer_) models_ = renderer_->takeModels();
        renderer_.reset();
    };
    if (!environment_ || environment_->setup() != wanted) {
        dropRenderer();
        environment_.reset();
        if (!progress_(1)) return Error{"", "left while it was loading"};
        if (Status s = Environment::open(wanted, progress_).moveTo(environment_); !s) return s;
        const environment::Player& film = environment_->player();
        if (Status s =
                findFilmSpace(film.hasDepthTrack() ? film.file() : Path(), options.environment, config);
            !s)
            return s;
        space_ = config.dive.space;
    }
    config.dive.space = space_;
    if (options.environment.isOwnVideo()) config.dive.videoLength_s = environment_->player().length_s();
    const SceneRendererSetup setup = rendererSetup(options, *environment_, seesRoom);
    if (renderer_ && renderer_->setup() == setup) return Done{};
    dropRenderer();
    CreatureModels taken = std::move(*models_);
    models_.reset();
    const Status made = SceneRenderer::make(std::move(taken), setup).moveTo(renderer_);
    if (!made) loaded_.reset(); // the models are gone
    return made;
}

} // namespace shoal::app
