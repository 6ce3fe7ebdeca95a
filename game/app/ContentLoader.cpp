#include "game/app/ContentLoader.h"

#include "engine/core/Log.h"
#include "engine/gl/Renderer.h"
#include "engine/math/Trigonometry.h"
#include "engine/media/DepthTrack.h"
#include "engine/media/SphericalMetadata.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <future>
#include <numbers>
#include <thread>

namespace shoal::app {

using game::FilmSpace;

static render::Composition compositionIn(const PlayOptions& options) {
    return options.look.skip == render::SkippedPass::Objects ? render::Composition::BackgroundOnly
                                                             : options.compose;
}

static render::Detail detail() {
    return gl::rendersInSoftware() ? render::Detail::Lean : render::Detail::Full;
}

static EnvironmentSetup environmentSetup(const PlayOptions& options, const game::DiveFile& dive,
                                         bool seesRoom) {
    const bool own = options.environment.isOwnVideo();
    const bool inSoftware = gl::rendersInSoftware();
    const bool cardDraws = !inSoftware && options.look.backend != render::Backend::Software;
    const bool slowComputer = inSoftware || std::thread::hardware_concurrency() < 4;
    const Path film = filmFor(dataRoot() / "content" / dive.video, options.film, slowComputer);
    return {.player = {.source = options.environment.orOwn(film),
                       .drawsDepth = options.look.skip != render::SkippedPass::Depth,
                       .roomIsSeen = seesRoom,
                       .waterIsCertain = own || options.water == WaterChoice::On,
                       .pyramid = options.look.glossy == render::Glossy::PhongRings,
                       .water = options.water == WaterChoice::On ||
                                (options.water == WaterChoice::Auto && (!own || dive.water)),
                       .lights = options.shadows == ShadowChoice::On,
                       .cameraResponse = compositionIn(options) == render::Composition::CameraResponse,
                       .planes = cardDraws,
                       .decoding = !cardDraws                             ? media::Decoding::Sparing
                                   : options.decode == DecodeChoice::Auto ? media::Decoding::Card
                                                                          : media::Decoding::AllThreads},
            .yaw_deg = options.environment.envYaw_deg,
            .bothEyes = options.stereo == StereoOutput::SideBySide || options.xr};
}

static SceneRendererSetup rendererSetup(const PlayOptions& options, const Environment& environment,
                                        bool seesRoom) {
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

constexpr double kSteps_Hz = 4;
constexpr int kBelieved = media::kMaxDepthCode / 2; // confidence below which a distance is ignored

// Returns the cell of each texel of the track. Uses no C library trigonometry, because the grid is hashed.
static std::vector<int> cellsOf(int width, int height, const glm::mat3& worldFromFilm) {
    constexpr float kPi = std::numbers::pi_v<float>;
    std::vector<glm::vec2> ahead; // direction of each column: towards +X and -Z
    for (int x = 0; x < width; ++x) {
        const float right = kPi * (static_cast<float>(2 * x + 1) / static_cast<float>(width) - 1);
        ahead.emplace_back(math::sine(right), math::cosine(right));
    }
    std::vector<int> cells;
    cells.reserve(static_cast<size_t>(width) * height);
    for (int y = 0; y < height; ++y) {
        const float up = kPi * 0.5f * (1 - static_cast<float>(2 * y + 1) / static_cast<float>(height));
        const float level = math::cosine(up), rise = math::sine(up);
        for (const glm::vec2 a : ahead)
            cells.push_back(FilmSpace::cellOf(worldFromFilm * glm::vec3(a.x * level, rise, -a.y * level)));
    }
    return cells;
}

static void addStep(const media::DepthFrame& frame, const std::vector<int>& cells,
                    std::span<uint16_t> step_mm) {
    std::fill(step_mm.begin(), step_mm.end(), static_cast<uint16_t>(1000 * FilmSpace::kFar_m));
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x) {
            if (frame.confidence[static_cast<size_t>(y / 2) * (frame.width / 2) + x / 2] < kBelieved)
                continue;
            const float inverse = std::max(frame.inverse_perM(x, y), 1 / FilmSpace::kFar_m);
            uint16_t& nearest = step_mm[cells[static_cast<size_t>(y) * frame.width + x]];
            nearest = std::min(nearest, static_cast<uint16_t>(1000 / inverse));
        }
}

std::shared_ptr<const FilmSpace> filmSpaceOf(const Path& film, float yaw) {
    const Path file = media::depthTrackOf(film);
    std::error_code missing;
    if (!std::filesystem::exists(file, missing)) return nullptr;
    auto track = media::DepthTrack::open(file, film);
    if (!track) return nullptr; // the film's player says why
    const media::DepthTrackInfo& info = track->info();
    const int steps =
        std::clamp(static_cast<int>(std::ceil(info.duration_s * kSteps_Hz)), 1, FilmSpace::kMaxSteps);
    const glm::quat filmFromWorld = media::filmFromWorld(media::sphericalMetadata(film).envFromFilm, yaw);
    const std::vector<int> cells =
        cellsOf(info.width, info.height, glm::transpose(glm::mat3_cast(filmFromWorld)));
    std::vector<uint16_t> surface_mm(static_cast<size_t>(steps) * FilmSpace::kCells);
    media::DepthFrame frame;
    for (int step = 0; step < steps; ++step) {
        const int number = track->frameAt(step * info.duration_s / steps);
        const std::span step_mm =
            std::span(surface_mm).subspan(static_cast<size_t>(step) * FilmSpace::kCells, FilmSpace::kCells);
        if (!track->read(number, frame)) {
            log::warn("{}: damaged in frame {}; animals take the film for open water", file.string(), number);
            return nullptr;
        }
        addStep(frame, cells, step_mm);
    }
    return std::make_shared<const FilmSpace>(info.duration_s, std::move(surface_mm));
}

Status findFilmSpace(const Path& film, const EnvironmentOptions& options, SessionConfig& config) {
    config.dive.space.reset();
    const bool wanted = !config.replay || game::needsFilmSpace(config.replay->header());
    if (wanted && !film.empty() && options.depth)
        config.dive.space = filmSpaceOf(film, glm::radians(options.envYaw_deg));
    return config.replay ? game::checkFilmSpace(config.replay->header(), config.dive.space.get()) : Done{};
}

std::optional<float> ContentLoader::loadSpecies(const SessionConfig& config, size_t species) {
    if (unloadable_ == species) return std::nullopt;
    const Result<float> added = models_.add(config.species, species, loaded_->reflectance, detail());
    if (added) return *added;
    log::warn("{}", added.error().message());
    unloadable_ = species;
    return std::nullopt;
}

// Loads the models first, because the light is made for the least roughness of their surfaces.
Status ContentLoader::open(const PlayOptions& options, SessionConfig& config, bool seesRoom, bool filmFirst) {
    EnvironmentSetup wanted = environmentSetup(options, config.dive, seesRoom);
    Models models{reflectanceIn(options.environment), enumName(options.skin),
                  game::speciesShown(config.species, config.dive)};
    if (loaded_ != models) {
        renderer_.reset();
        environment_.reset();
        loaded_.reset();
        models_ = {};
        if (filmFirst) {
            wanted.player.minRoughness = 1;
            if (Status s = Environment::open(wanted, progress_).moveTo(environment_); !s) return s;
            SceneRendererSetup setup = rendererSetup(options, *environment_, seesRoom);
            setup.compositor.composition = render::Composition::BackgroundOnly;
            if (Status s = SceneRenderer::make(models_, setup).moveTo(renderer_); !s) return s;
        }
        if (Status s = CreatureModels::load(config.species, models.shown, models.skin, models.reflectance,
                                            detail(), progress_)
                           .moveTo(models_);
            !s)
            return s;
        renderer_.reset();
        environment_.reset();
        loaded_ = std::move(models);
    }
    wanted.player.minRoughness = models_.minRoughness();
    std::future<Status> space; // found while shaders are compiled
    if (!environment_ || environment_->setup() != wanted) {
        renderer_.reset();
        environment_.reset();
        if (!progress_(1)) return Error{"", "left while it was loading"};
        if (Status s = Environment::open(wanted, progress_).moveTo(environment_); !s) return s;
        const environment::Player& film = environment_->player();
        space = std::async(std::launch::async, [&, file = film.hasDepthTrack() ? film.file() : Path()] {
            return findFilmSpace(file, options.environment, config);
        });
    }
    if (options.environment.isOwnVideo()) config.dive.videoLength_s = environment_->player().length_s();
    const SceneRendererSetup setup = rendererSetup(options, *environment_, seesRoom);
    Status made = Done{};
    if (!renderer_ || renderer_->setup() != setup) {
        renderer_.reset();
        made = SceneRenderer::make(models_, setup).moveTo(renderer_);
    }
    if (space.valid()) {
        if (Status s = space.get(); !s) return s;
        space_ = config.dive.space;
    }
    config.dive.space = space_;
    return made;
}

} // namespace shoal::app
