#include "tests/bench/bounce/Animals.h"

#include "engine/gl/Renderer.h"
#include "engine/gl/Target.h"
#include "engine/light/InverseToneMap.h"
#include "engine/math/Colour.h"
#include "engine/math/LatLong.h"
#include "engine/math/Quantile.h"
#include "engine/media/Pictures.h"
#include "engine/platform/Window.h"
#include "engine/scene/Spine.h"
#include "engine/scene/Surface.h"
#include "game/app/ContentLoader.h"
#include "game/views/Environment.h"
#include "game/views/SceneRenderer.h"
#include "tests/bench/Bench.h"

#include <fmt/core.h>
#include <glm/gtc/type_ptr.hpp>

#include <numeric>

namespace shoal::bench {

namespace {

// An animal that keeps its place beside the camera, straight, as at the beginning of its swimming clip.
struct Posed {
    const char* species;
    glm::vec3 place{0};
    float yaw_deg; // of its nose, from away from the camera to the left
    float fov_deg;
};
const Posed kPosed[] = {{"ray", {-0.7f, -0.55f, -1.3f}, 60, 50}, {"snapper", {0.35f, -0.5f, -0.8f}, 110, 24}};

constexpr double kFps = 24;
constexpr int kPicture = 240; // pixels, square

glm::quat turnOf(const Posed& posed) {
    return glm::angleAxis(glm::radians(180 + posed.yaw_deg), glm::vec3(0, 1, 0));
}

render::View viewOf(const Posed& posed) {
    render::View view;
    view.worldFromEye = glm::quatLookAt(glm::normalize(posed.place), glm::vec3(0, 1, 0));
    view.verticalFov = glm::radians(posed.fov_deg);
    view.aspect = 1;
    view.heightPixels = kPicture;
    return view;
}

glm::vec3 albedoAt(const scene::Model& model, const scene::Primitive& primitive, size_t vertex) {
    const scene::Material& material = model.materialOf(primitive);
    glm::vec3 albedo(material.baseColourLin);
    const ImageRgba8* image = model.imageOf(material.baseColour);
    const auto& uvs = primitive.texCoords[material.baseColour.texCoord];
    if (!image || uvs.empty()) return albedo;
    const glm::ivec2 texel = glm::fract(uvs[vertex]) * glm::vec2(image->width, image->height);
    for (int k = 0; k < 3; ++k) albedo[k] *= math::linearOfByte()[image->at(texel.x, texel.y)[k]];
    return albedo;
}

Status writeMesh(const Posed& posed, const game::Species& species, const Path& file) {
    auto model = scene::loadModel(dataRoot() / "content" / species.model);
    if (!model) return model.error();
    scene::Pose pose;
    scene::restPose(*model, pose);
    const scene::Bounds bounds = scene::posedBounds(*model, pose);
    const float length_m = bounds.high.z - bounds.low.z;
    const scene::Spine spine = scene::findSpine(*model, length_m, bounds.low.z);
    scene::animate(*model, model->findAnimation("swim"), 0, pose);
    scene::scaleWave(spine, 0, pose);
    scene::updateGlobals(*model, pose);
    const scene::Surface surface = scene::posedSurface(*model, pose);
    const glm::quat turn = turnOf(posed);
    const float size = species.length_m / length_m;
    std::string text;
    size_t i = 0;
    for (const int node : model->order) {
        if (model->nodes[node].mesh < 0) continue;
        for (const scene::Primitive& primitive : model->meshes[model->nodes[node].mesh].primitives)
            for (size_t v = 0; v < primitive.positions.size(); ++v, ++i) {
                const glm::vec3 p = 1000.0f * (posed.place + turn * (size * surface.positions[i]));
                const glm::vec3 n = turn * surface.normals[i], a = albedoAt(*model, primitive, v);
                text += fmt::format("v {} {} {} {} {} {} {} {} {}\n", p.x, p.y, p.z, n.x, n.y, n.z, a.r, a.g,
                                    a.b);
            }
    }
    for (size_t t = 0; t < surface.indices.size(); t += 3)
        text +=
            fmt::format("f {} {} {}\n", surface.indices[t], surface.indices[t + 1], surface.indices[t + 2]);
    return writeFileWhole(file, text);
}

float luminance(const uint8_t* srgb) {
    const std::array<float, 256>& linear = math::linearOfByte();
    return light::linearLuminance({linear[srgb[0]], linear[srgb[1]], linear[srgb[2]]});
}

// Returns the view of a traced frame, as bright beside the animal as the game's picture.
ImageRgba8 seenIn(const ImageRgbF& traced, const render::View& view, const ImageRgba8& game,
                  const ImageRgba8& animal) {
    std::vector<glm::vec3> seen;
    std::vector<float> factors;
    for (int y = 0; y < kPicture; ++y)
        for (int x = 0; x < kPicture; ++x) {
            const glm::vec2 at = (glm::vec2(x, y) + 0.5f) * (2.0f / kPicture) - 1.0f;
            const glm::vec3 ray(at * glm::vec2(1, -1) * view.halfExtent(), -1);
            const glm::ivec2 texel = latLongFromDirection(view.worldFromEye * glm::normalize(ray)) *
                                     glm::vec2(traced.width, traced.height);
            seen.push_back(glm::make_vec3(traced.at(texel.x, texel.y)));
            if (animal.at(x, y)[3] == 0)
                factors.push_back(luminance(game.at(x, y)) / light::linearLuminance(seen.back()));
        }
    const float factor = math::median(factors);
    ImageRgba8 picture(kPicture, kPicture);
    for (size_t i = 0; i < seen.size(); ++i)
        for (size_t k = 0; k < 4; ++k) {
            const float value =
                k < 3 ? math::srgbFromLinear(std::min(factor * seen[i][static_cast<int>(k)], 1.0f)) : 1;
            picture.pixels[4 * i + k] = static_cast<uint8_t>(std::lround(255 * value));
        }
    return picture;
}

// Returns the mean luminance over the animal.
double meanOver(const ImageRgba8& picture, const ImageRgba8& animal) {
    double sum = 0, count = 0;
    for (size_t i = 0; i < animal.pixels.size(); i += 4)
        if (animal.pixels[i + 3] == 255) sum += luminance(&picture.pixels[i]), ++count;
    return sum / count;
}

// The game's models, and what it draws them with.
class Drawing {
  public:
    Status open() {
        if (Status s = platform::Headless::open().moveTo(context_); !s) return s;
        gl::spreadRasterThreads();
        app::PlayOptions options;
        options.headless = true;
        if (Status s = app::makeSessionConfig(options).moveTo(plan_); !s) return s;
        const app::EnvironmentSetup setup{
            .player = {.source = {.video = (dataRoot() / "content/video/reef.mp4").string()},
                       .minRoughness = 0.25f,
                       .water = true,
                       .lights = true,
                       .cameraResponse = true}};
        if (Status s = app::Environment::open(setup).moveTo(environment_); !s) return s;
        if (Status s = app::CreatureModels::load(
                           plan_->species, game::speciesShown(plan_->species, plan_->dive), "light",
                           app::reflectanceIn(setup.player.source), render::Detail::Lean)
                           .moveTo(models_);
            !s)
            return s;
        return app::SceneRenderer::make(models_, {.detail = render::Detail::Lean}).moveTo(renderer_);
    }

    // Shows a frame: first after those of the second before, or alone, so that its ground is its own mean.
    void show(int frame, bool withWaves) {
        if (withWaves)
            for (int at = frame - static_cast<int>(kFps); at < frame; ++at)
                environment_->update(middle(at), true);
        else
            environment_->update(middle(0), true);
        environment_->update(middle(frame), true);
    }

    Result<ImageRgba8> draw(const Posed& posed, int frame, bool alone) {
        game::Snapshot snapshot;
        snapshot.time_s = middle(frame);
        game::CreatureView creature;
        creature.species = game::findSpecies(plan_->species, posed.species);
        creature.position = posed.place;
        creature.worldFromBody = turnOf(posed);
        creature.length = plan_->species[creature.species].length_m;
        snapshot.creatures.push_back(creature);
        const gl::Target target(kPicture, kPicture, alone ? 1 : 4);
        renderer_->set(snapshot, *environment_,
                       {.exposure = environment_->exposure(app::Tone::Auto, 0), .particles = false});
        const app::SceneRenderer::Eye eye{0, viewOf(posed), target};
        target.bind();
        glClearColor(0, 0, 0, 0);
        glClear(GL_COLOR_BUFFER_BIT);
        if (Status s = alone ? renderer_->drawObjectsAlone(eye) : renderer_->draw({&eye, 1}); !s)
            return s.error();
        return target.read();
    }

  private:
    static double middle(int frame) { return (frame + 0.5) / kFps; }

    std::optional<platform::Headless> context_;
    std::optional<app::SessionConfig> plan_;
    std::unique_ptr<app::Environment> environment_;
    app::CreatureModels models_;
    std::optional<app::SceneRenderer> renderer_;
};

// Returns the root mean square of values about a row of others, both as shares of their mean.
double off(const std::vector<double>& values, const std::vector<double>& others) {
    const auto mean = [](const std::vector<double>& of) {
        return std::accumulate(of.begin(), of.end(), 0.0) / static_cast<double>(of.size());
    };
    double sum = 0;
    for (size_t i = 0; i < values.size(); ++i) {
        const double difference = values[i] / mean(values) - others[i] / mean(others);
        sum += difference * difference / static_cast<double>(values.size());
    }
    return std::sqrt(sum);
}

} // namespace

Status writeAnimals(const Path& folder) {
    const auto species = game::loadSpecies(dataRoot() / "content/species.toml");
    if (!species) return species.error();
    for (const Posed& posed : kPosed)
        if (Status s = writeMesh(posed, (*species)[game::findSpecies(*species, posed.species)],
                                 folder / (std::string(posed.species) + ".mesh"));
            !s)
            return s;
    return Done{};
}

Status writePictures(const Path& folder, std::span<const int> frames) {
    Drawing drawing;
    if (Status s = drawing.open(); !s) return s;
    enum Row { kTraced, kWith, kWithout, kRows };
    constexpr int kAnimals = std::size(kPosed);
    ImageRgba8 sheet(kPicture * static_cast<int>(frames.size()), kPicture * kRows * kAnimals);
    std::array<std::array<std::vector<double>, kRows>, kAnimals> means;
    for (size_t column = 0; column < frames.size(); ++column) {
        std::array<std::array<ImageRgba8, kRows>, kAnimals> pictures;
        for (const Row row : {kWith, kWithout}) {
            drawing.show(frames[column], row == kWith);
            for (size_t i = 0; i < kAnimals; ++i) {
                auto drawn = drawing.draw(kPosed[i], frames[column], false);
                if (!drawn) return drawn.error();
                pictures[i][row] = std::move(*drawn);
            }
        }
        for (size_t i = 0; i < kAnimals; ++i) {
            const auto alone = drawing.draw(kPosed[i], frames[column], true);
            if (!alone) return alone.error();
            const auto traced =
                media::readHdr(folder / fmt::format("{}_{:04d}.hdr", kPosed[i].species, frames[column]));
            if (!traced) return traced.error();
            pictures[i][kTraced] =
                seenIn(traced->radianceLin, viewOf(kPosed[i]), pictures[i][kWithout], *alone);
            for (size_t row = 0; row < kRows; ++row) {
                means[i][row].push_back(meanOver(pictures[i][row], *alone));
                for (int y = 0; y < kPicture; ++y)
                    std::copy_n(pictures[i][row].at(0, y), 4 * kPicture,
                                sheet.at(kPicture * static_cast<int>(column),
                                         kPicture * static_cast<int>(i * kRows + row) + y));
            }
        }
    }
    std::string table =
        "\nThe same on two animals whose pictures are traced, with all other light: means over the animal.\n"
        "\n| animal | error without, % | with, % | change in truth, % | found, % |\n|---|--:|--:|--:|--:|\n";
    for (size_t i = 0; i < kAnimals; ++i) {
        const std::vector<double> steady(frames.size(), 1.0);
        table += fmt::format("| {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n", kPosed[i].species,
                             100 * off(means[i][kWithout], means[i][kTraced]),
                             100 * off(means[i][kWith], means[i][kTraced]),
                             100 * off(means[i][kTraced], steady), 100 * off(means[i][kWith], steady));
    }
    if (Status s = writeFileWhole(folder / "animals.md", table); !s) return s;
    return media::writePng(folder / "caustics.png", sheet);
}

} // namespace shoal::bench
