// Measures how seamless each way of compositing is, and its cost: bench_compose FOLDER [--quick].
//
// Truth: the dive's own film, with the game's objects filmed into it (Filmed.h, Encode.h). Every way then
// draws the same objects over the same film without them, coded alike, and is compared with that.
#include "engine/gl/Renderer.h"
#include "engine/gl/Target.h"
#include "engine/media/VideoPlayer.h"
#include "engine/platform/Window.h"
#include "game/session/GameSession.h"
#include "game/views/Environment.h"
#include "game/views/SceneRenderer.h"
#include "tests/bench/compose/Distance.h"
#include "tests/bench/compose/Encode.h"
#include "tests/bench/compose/Filmed.h"
#include "tests/bench/compose/Report.h"

#include <glm/gtc/quaternion.hpp>

namespace shoal::bench {

namespace {

constexpr int kFps = 24, kTaken = 16; // frames that are filmed and coded for each scene, ...
constexpr int kShown = 12;            // ... and the one that is compared
constexpr int kFine = 2;              // pixels of the objects' own picture for one of the shown picture

struct Scene {
    int frame; // of the film
    float yaw_deg;
};
// The frames whose truth content/truth keeps: open water, reef, overhang, tunnel.
constexpr Scene kScenes[] = {{120, 0}, {560, 0}, {860, 20}, {1060, 0}, {1260, -20}};

constexpr glm::ivec2 kPicture(1280, 720);
constexpr float kFov_deg = 65; // vertical, as in the game

// One of the compositions that are compared.
struct Way {
    render::Composition composition;
    const char* name;
};
constexpr Way kWays[] = {{render::Composition::Plain, "plain"},
                         {render::Composition::MatchedResolution, "resolution"},
                         {render::Composition::VideoTexels, "texels"},
                         {render::Composition::CameraResponse, "camera"},
                         {render::Composition::BackgroundOnly, kBackgroundAlone}}; // last; timed only

using namespace app;

void runOn(GameSession& session, double seconds) {
    if (auto* mouse = std::get_if<MouseSource>(&session.source))
        mouse->frame(nullptr, {}, session.shown, static_cast<float>(seconds), glm::radians(kFov_deg),
                     static_cast<float>(kPicture.x) / static_cast<float>(kPicture.y));
    session.advance(seconds);
}

// Runs the simulation to a time of the dive, without a player.
GameSession runTo(const SessionConfig& plan, double time_s) {
    GameSession session(plan);
    while (session.shown.time_s < time_s) runOn(session, 1.0 / 60);
    return session;
}

Result<std::unique_ptr<Environment>> openVideo(const Path& file) {
    return Environment::open({.player = {.source = {.video = file.string(), .layout = media::Layout::Mono},
                                         .minRoughness = 0.25f,
                                         .water = true,
                                         .cameraResponse = true}});
}

// yaw_deg: turn of the view to the right.
render::View viewOf(const game::Snapshot& snapshot, float yaw_deg) {
    render::View view;
    view.worldFromEye = glm::angleAxis(glm::radians(-yaw_deg), glm::vec3(0, 1, 0)) * snapshot.worldFromView;
    view.eyeWorld = snapshot.headWorld;
    view.verticalFov = glm::radians(kFov_deg);
    view.aspect = static_cast<float>(kPicture.x) / static_cast<float>(kPicture.y);
    view.heightPixels = kPicture.y;
    return view;
}

// Draws the whole picture as Play does. target: of any size with the picture's aspect ratio.
Status drawPicture(SceneRenderer& sceneRenderer, const render::View& view, const gl::Target& target) {
    const SceneRenderer::Eye eye{0, view, target};
    return sceneRenderer.draw({&eye, 1});
}

// Draws the objects alone, premultiplied by coverage.
Status drawObjectsAlone(SceneRenderer& sceneRenderer, const render::View& view, const gl::Target& target) {
    target.bind();
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
    return sceneRenderer.drawObjectsAlone({0, view, target});
}

using Renderers = std::vector<app::SceneRenderer>; // as kWays

// Reads the frames of the film around `shown`, which is the one that is compared.
Result<std::vector<ImageRgb8>> readFilm(int shown) {
    auto player = media::VideoPlayer::open(dataRoot() / "content/video/reef.mp4", {});
    if (!player) return player.error();
    std::vector<ImageRgb8> frames;
    for (int frame = shown - kShown; frame < shown - kShown + kTaken; ++frame) {
        ImageRgb8& rgb = frames.emplace_back(player->waitFor((frame + 0.5) / kFps)->pixelsBgr);
        for (size_t i = 0; i < rgb.pixels.size(); i += 3) std::swap(rgb.pixels[i], rgb.pixels[i + 2]);
    }
    return frames;
}

Coverage coverageOf(const ImageRgba8& fine) {
    Coverage out(fine.width / kFine, fine.height / kFine);
    for (int y = 0; y < fine.height; ++y)
        for (int x = 0; x < fine.width; ++x)
            *out.at(x / kFine, y / kFine) += static_cast<float>(fine.at(x, y)[3]) / (255.0f * kFine * kFine);
    return out;
}

double timeOf(int k) { return (k + 0.5) / kFps; }

// Returns the place with most outlines: the middle of the window that is most evenly object and background.
glm::ivec2 worthALook(const Coverage& coverage) {
    constexpr int kWide = 72, kHigh = 60;
    glm::ivec2 best(0);
    float maximum = -1;
    for (int top = 0; top + kHigh <= coverage.height; top += 8)
        for (int left = 0; left + kWide <= coverage.width; left += 8) {
            float covered = 0;
            for (int y = top; y < top + kHigh; y += 2)
                for (int x = left; x < left + kWide; x += 2) covered += *coverage.at(x, y);
            const float share = covered / (kWide * kHigh / 4);
            if (share * (1 - share) <= maximum) continue;
            maximum = share * (1 - share);
            best = {left + kWide / 2, top + kHigh / 2};
        }
    return best;
}

Status measureScene(const Scene& scene, const app::SessionConfig& plan, Renderers& renderers,
                    const Path& folder, Report& report) {
    auto frames = readFilm(scene.frame);
    if (!frames) return frames.error();
    const std::string number = std::to_string(scene.frame);
    const Path emptyFile = folder / ("film_" + number + ".mp4");
    if (Status s = encode(emptyFile, *frames, kFps); !s) return s;
    auto empty = openVideo(emptyFile);
    if (!empty) return empty.error();

    // The objects move while they are filmed, as what is coded with them does. Twice, with other noise; the
    // second take begins a frame later, so that the encoder comes to other decisions.
    std::vector<ImageRgb8> again = *frames;
    const gl::Target fine(kFine * kPicture.x, kFine * kPicture.y, 4);
    app::GameSession run = runTo(plan, static_cast<double>(scene.frame - kShown) / kFps);
    game::Snapshot moment;
    Coverage coverage;
    for (int k = 0; k < kTaken; ++k) {
        if (k) runOn(run, 1.0 / kFps);
        (*empty)->update(timeOf(k), true);
        const render::View view = viewOf(run.shown, scene.yaw_deg);
        renderers[0].set(run.shown, **empty, {.particles = false});
        // A wider view, so that no object is cut off at the picture's edge.
        const render::View wide = render::widened(view, 1.05f);
        if (Status s = drawObjectsAlone(renderers[0], wide, fine); !s) return s;
        const ImageRgba8 objects = fine.read();
        const std::array takes = {&(*frames)[k], &again[k]};
        filmInto(takes, objects, wide, (*empty)->envFromWorld(), static_cast<uint32_t>(scene.frame + k));
        if (k != kShown) continue;
        if (Status s = drawObjectsAlone(renderers[0], view, fine); !s) return s;
        coverage = coverageOf(fine.read());
        moment = run.shown;
    }
    const glm::ivec2 look = worthALook(coverage);
    const gl::Target target(kPicture.x, kPicture.y, 1);
    const render::View view = viewOf(moment, scene.yaw_deg);
    ImageRgba8 truth;
    for (const bool second : {false, true}) {
        const Path file = folder / ((second ? "again_" : "filmed_") + number + ".mp4");
        const std::span<const ImageRgb8> take =
            second ? std::span<const ImageRgb8>(again).subspan(1) : std::span<const ImageRgb8>(*frames);
        if (Status s = encode(file, take, kFps); !s) return s;
        auto filmed = openVideo(file);
        if (!filmed) return filmed.error();
        (*filmed)->update(timeOf(second ? kShown - 1 : kShown), true);
        renderers.back().set(moment, **filmed, {});
        if (Status s = drawPicture(renderers.back(), view, target); !s) return s;
        const ImageRgba8 shown = target.read();
        if (!second) truth = shown;
        report.shown.push_back(
            {scene.frame, second ? kFilmedAgain : kFilmed, shown, distance(shown, truth, coverage), look});
    }
    for (size_t way = 0; way + 1 < std::size(kWays); ++way) {
        // A fresh frame for each: one of them paints it.
        (*empty)->update(timeOf(0), true);
        (*empty)->update(timeOf(kShown), true);
        renderers[way].set(moment, **empty, {});
        if (Status s = drawPicture(renderers[way], view, target); !s) return s;
        const ImageRgba8 shown = target.read();
        report.shown.push_back({scene.frame, kWays[way].name, shown, distance(shown, truth, coverage), look});
    }
    return Done{};
}

// Times all ways in turn in each frame of the same dive, so that other programs slow each alike. Each round
// begins with another way, because the decoder works on after a frame has come.
Status measureCost(const app::SessionConfig& plan, Renderers& renderers, int rounds, Report& report) {
    auto environment = openVideo(dataRoot() / "content/video/reef.mp4");
    if (!environment) return environment.error();
    const gl::Target target(kPicture.x, kPicture.y, 1);
    app::GameSession run = runTo(plan, 10);
    for (int round = 0; round < rounds; ++round) {
        runOn(run, 1.0 / 48); // the film has a new frame every other time
        (*environment)->update(run.shown.time_s, true);
        for (size_t turn = 0; turn < std::size(kWays); ++turn) {
            const size_t way = (turn + round) % std::size(kWays);
            app::SceneRenderer& sceneRenderer = renderers[way];
            const double began_us = now_us(), processorBegan_ms = processor_ms();
            sceneRenderer.set(run.shown, **environment,
                              {.exposure = (*environment)->exposure(app::Tone::Auto, 0), .particles = false});
            if (Status s = drawPicture(sceneRenderer, viewOf(run.shown, 0), target); !s) return s;
            glFinish();
            const double wall_ms = 1e-3 * (now_us() - began_us);
            if (round >= 5)
                report.costs[kWays[way].name].push_back({wall_ms, processor_ms() - processorBegan_ms});
        }
    }
    return Done{};
}

Status run(const Path& folder, bool quick) {
    auto context = platform::Headless::open();
    if (!context) return context.error();
    gl::spreadRasterThreads();
    app::PlayOptions options;
    options.headless = true;
    auto plan = app::makeSessionConfig(options);
    if (!plan) return plan.error();
    const auto detail = gl::rendersInSoftware() ? render::Detail::Lean : render::Detail::Full;
    auto cast = CreatureModels::load(plan->species, game::speciesShown(plan->species, plan->dive), "light",
                                     render::Reflectance::Coded, detail);
    if (!cast) return cast.error();
    Renderers renderers;
    for (const Way& way : kWays) {
        auto sceneRenderer =
            SceneRenderer::make(*cast, {.detail = detail, .compositor = {.composition = way.composition}});
        if (!sceneRenderer) return sceneRenderer.error();
        renderers.push_back(std::move(*sceneRenderer));
    }
    Report report;
    for (const Scene& scene : kScenes) {
        std::fprintf(stderr, "compose: scene of frame %d\n", scene.frame);
        if (Status s = measureScene(scene, *plan, renderers, folder, report); !s) return s;
        if (quick) break;
    }
    std::fprintf(stderr, "compose: times\n");
    if (Status s = measureCost(*plan, renderers, quick ? 25 : 105, report); !s) return s;
    return report.write(folder);
}

} // namespace
} // namespace shoal::bench

int main(int argc, char** argv) {
    using namespace shoal::bench;
    if (lacksArguments(argc, 1, "bench_compose FOLDER [--quick]")) return 2;
    return exitStatus("bench_compose", run(argv[1], argc > 2));
}
