#include "tests/baselines/light/Baselines.h"

#include "engine/light/Lookup.h"
#include "engine/light/MakeLight.h"

#include <memory>

namespace shoal::light::baselines {

namespace {

// Light as the game makes it: for coded frames in the quality of a video, for HDR pictures, which stand
// still, in that of a still; or all in the quality of a video.
struct State {
    State(float minRoughness, bool videoOnly)
        : video({512, minRoughness, LightQuality::Video}), still({1024, minRoughness, LightQuality::Still}),
          forHdr(videoOnly ? &video : &still) {}
    LightMaker video, still;
    LightMaker* forHdr;
    EnvironmentLight light;

    void make(const Input& input) {
        if (input.radianceLin)
            forHdr->makeFromHdr(*input.radianceLin, light);
        else
            video.make(input.coded, light);
    }
};

Label label(bool videoOnly) {
    if (videoOnly) return {"Shoal, video maps for all", "video", "Shoal", "engine/light", Role::Baseline};
    return {"Shoal", "Shoal", "Shoal", "engine/light", Role::Default};
}

} // namespace

DiffuseMethod shoalDiffuse(bool videoOnly) {
    auto state = std::make_shared<State>(1.0f, videoOnly);
    return {label(videoOnly), [state](const Input& input) { state->make(input); },
            [state](std::span<const glm::vec3> normals, std::span<glm::vec3> out) {
                for (size_t i = 0; i < normals.size(); ++i) out[i] = lookUp(state->light.diffuse, normals[i]);
            },
            false};
}

GlossyMethod shoalGlossy(bool videoOnly) {
    auto state = std::make_shared<State>(kMinFilteredRoughness, videoOnly);
    return {label(videoOnly), [state](const Input& input) { state->make(input); },
            [state](std::span<const glm::vec3> dirs, float roughness, std::span<glm::vec3> out) {
                for (size_t i = 0; i < dirs.size(); ++i)
                    out[i] = lookUpGlossy(state->light, dirs[i], roughness);
            },
            false};
}

} // namespace shoal::light::baselines
