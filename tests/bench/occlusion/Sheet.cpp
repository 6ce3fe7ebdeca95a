#include "engine/light/InverseToneMap.h"
#include "engine/light/Lookup.h"
#include "engine/light/MakeLight.h"
#include "engine/media/Pictures.h"
#include "tests/baselines/occlusion/OllfbThesis.h"
#include "tests/baselines/occlusion/TracedOllfb.h"
#include "tests/baselines/occlusion/Visibility.h"
#include "tests/bench/light/Environments.h"
#include "tests/bench/occlusion/LayeredBodies.h"
#include "tests/bench/occlusion/Measure.h"
#include "tests/bench/occlusion/Truth.h"

#include <glm/gtc/matrix_transform.hpp>

namespace shoal::bench {

namespace {

constexpr int kWidth = 240, kHeight = 180, kSide = 2; // a picture; samples a pixel, each way
constexpr int kColumns = 5;                           // off, thesis, cured, ellipsoids, truth

struct Sample {
    glm::vec3 look{0}; // the camera's ray
    std::optional<Receiver> at;
};

std::vector<Sample> samplesOf(const Scene& scene, const Rays& rays) {
    const glm::mat3 worldFromEye =
        glm::transpose(glm::mat3(glm::lookAt(scene.camera.eye, scene.camera.target, glm::vec3(0, 1, 0))));
    std::vector<Sample> samples;
    const int width = kWidth * kSide, height = kHeight * kSide;
    const float scale = 2 * std::tan(scene.camera.fovY / 2) / static_cast<float>(height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec3 eye((static_cast<float>(x) + 0.5f - 0.5f * static_cast<float>(width)) * scale,
                                (0.5f * static_cast<float>(height) - static_cast<float>(y) - 0.5f) * scale,
                                -1);
            Sample sample{glm::normalize(worldFromEye * eye), {}};
            if (const auto at = rays.touch(scene.camera.eye, sample.look, 0))
                sample.at = receiverAt(scene, *at);
            samples.push_back(sample);
        }
    return samples;
}

using Colours = std::vector<glm::vec3>; // radiance, one a sample

Colours matte(const Scene& scene, const Rays& rays, const Lit& lit, const std::vector<Sample>& samples,
              OcclusionMethod method) {
    method.build(scene, rays);
    method.relight(lit);
    Colours out(samples.size());
    onAllCores(static_cast<size_t>(kHeight * kSide), [&](size_t row) {
        for (size_t i = row * kWidth * kSide; i < (row + 1) * kWidth * kSide; ++i)
            if (samples[i].at) {
                method.shade({&*samples[i].at, 1}, {&out[i], 1});
                out[i] *= scene.bodies[samples[i].at->body].albedoLin;
            }
    });
    return out;
}

template <class Method>
Colours mirrored(const Scene& scene, const Method& method, const Lit& lit, const std::vector<Sample>& samples,
                 int bounces) {
    Colours out(samples.size());
    onAllCores(samples.size(), [&](size_t i) {
        if (!samples[i].at) return;
        const Receiver& at = *samples[i].at;
        const glm::vec3 to =
            occlusion::followMirrors(method, at.position, at.mirrored, 10 * scene.nearest, bounces).direction;
        out[i] = 0.9f * light::lookUp(lit.light.radiance, to, 0.0f);
    });
    return out;
}

std::vector<Colours> columnsOf(const Scene& scene, const Rays& rays, const Lit& lit,
                               const std::vector<Sample>& samples) {
    if (scene.mirror) {
        const LayeredBodies<occlusion::OllfbThesis> thesis(scene, {.cells = 5, .resolution = 64});
        const LayeredBodies<occlusion::TracedOllfb> cured(scene, {.views = 150, .resolution = 64});
        const Colours off = mirrored(scene, rays, lit, samples, 0);
        return {off, mirrored(scene, thesis, lit, samples, 1), mirrored(scene, cured, lit, samples, 8), off,
                mirrored(scene, rays, lit, samples, 8)};
    }
    std::vector<Colours> all;
    for (const OcclusionMethod& method :
         {ignored(), thesisLayers(64), curedLayers(64), ellipsoids(Casting::All), exactRays(512)})
        all.push_back(matte(scene, rays, lit, samples, method));
    return all;
}

// Returns the light of a frame of the game's video, in open water.
Result<Lit> reefLight() {
    const auto sources = filmedSources();
    const auto environment = sources.empty() ? std::nullopt : sources.front().load();
    if (!environment) return Error{"content/video/reef.mp4", "cannot be read"};
    Lit lit;
    light::LightMaker({.baseWidth = 2048, .minRoughness = 0.25f}).make(environment->view(), lit.light);
    lit.harmonics = math::shProject(lit.light.radiance.levels[2]);
    return lit;
}

} // namespace

Status writeSheet(std::span<const Scene> scenes, const Path& folder) {
    const auto lit = reefLight();
    if (!lit) return lit.error();
    ImageRgb8 sheet(kColumns * kWidth, static_cast<int>(scenes.size()) * kHeight);
    for (size_t s = 0; s < scenes.size(); ++s) {
        std::fprintf(stderr, "occlusion: picture of %s\n", scenes[s].name.c_str());
        const Rays rays(scenes[s].meshes());
        const auto samples = samplesOf(scenes[s], rays);
        const auto columns = columnsOf(scenes[s], rays, *lit, samples);
        for (int column = 0; column < kColumns; ++column)
            for (int y = 0; y < kHeight; ++y)
                for (int x = 0; x < kWidth; ++x) {
                    glm::vec3 sum(0); // of display values, as an eye's own blur would have it
                    for (int part = 0; part < kSide * kSide; ++part) {
                        const size_t i = static_cast<size_t>(y * kSide + part / kSide) * kWidth * kSide +
                                         static_cast<size_t>(x * kSide + part % kSide);
                        const glm::vec3 radiance =
                            samples[i].at ? columns[column][i]
                                          : light::lookUp(lit->light.radiance, samples[i].look, 1.0f);
                        sum += glm::clamp(light::displayFromRadiance(radiance), 0.0f, 1.0f);
                    }
                    uint8_t* pixel = sheet.at(column * kWidth + x, static_cast<int>(s) * kHeight + y);
                    for (int c = 0; c < 3; ++c)
                        pixel[c] = static_cast<uint8_t>(std::lround(sum[c] * 255 / (kSide * kSide)));
                }
    }
    return media::writePng(folder / "occlusion_sheet.png", sheet);
}

} // namespace shoal::bench
