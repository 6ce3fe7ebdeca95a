#include "engine/render/ParticlePass.h"

#include "shaders/render/Attributes.glsl"

#include <array>
#include <cmath>
#include <numbers>

namespace shoal::render {

namespace {

constexpr GLsizei kSpecks = 600;
constexpr float kCube_m = 4.2f; // side of the cube of specks: eight a cubic metre
constexpr glm::dvec3 kDrift_mps(0.023, -0.011, 0.015);
constexpr double kSwell_s = 7; // period of the swell that sways them

constexpr std::array kParticleDefines = {SHOAL_TONE_DEFINES, "SCALED_LIGHT", "FILM_DEPTH", "LAYER"};
constexpr unsigned kScaledLight = 1u << kToneFeatures, kFilmDepth = kScaledLight << 1,
                   kLayer = kFilmDepth << 1;

// Returns whether any part of the film is as near as specks are.
bool hidesSpecks(const EnvironmentGpu& environment, const glm::vec3& eyeInFilm) {
    if (!environment.depth().range) return false;
    const auto film = environment.depth().range->around(glm::vec3(0, 1, 0), std::numbers::pi_v<float>);
    return film.max_perM * (kCube_m / 2 + glm::length(eyeInFilm)) > 1;
}

} // namespace

Result<ParticlePass> ParticlePass::make() {
    ParticlePass pass;
    pass.programs_ = gl::Variants("render/Particles", kParticleDefines);
    pass.nothing_ = gl::VertexArray::make();
    if (auto program = pass.programs_.get(0); !program) return program.error();
    return pass;
}

Status ParticlePass::draw(On on, const EyePicture& picture, const water::Water& water, double time_s) {
    const bool filmHides = hidesSpecks(picture.environment, picture.eyeInFilm);
    const unsigned features = toneFeatures(picture.exposure) |
                              (picture.environment.lightIsScaled() ? kScaledLight : 0u) |
                              (filmHides ? kFilmDepth : 0u) | (picture.layer ? kLayer : 0u);
    auto found = programs_.get(features);
    if (!found) return found.error();
    const gl::Program& program = **found;
    program.use();
    picture.bind(program, water, filmHides);
    // Wrapped here in double precision: floats are too coarse after hours.
    program.set("drift_m", glm::vec3(glm::mod(kDrift_mps * time_s, static_cast<double>(kCube_m))));
    program.set("swell", static_cast<float>(std::fmod(time_s / kSwell_s, 1.0) * 2 * std::numbers::pi));
    program.set("cube_m", kCube_m);
    program.set("pixelsPerSlope",
                static_cast<float>(picture.view.heightPixels) / (2 * picture.view.halfExtent().y));
    if (picture.layer) {
        program.setTexture("layer", UNIT_BASE_COLOUR, picture.layer);
        program.set("layerFromPixel", glm::vec3(1.0f / (picture.layerWidth * glm::vec2(picture.size())),
                                                0.5f - 0.5f / picture.layerWidth));
    }

    gl::setEnabled(GL_DEPTH_TEST, on != On::Picture);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    if (on == On::Objects)
        glBlendFuncSeparate(GL_DST_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    else
        glBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA); // premultiplied
    glEnable(GL_PROGRAM_POINT_SIZE);
    glBindVertexArray(nothing_.name());
    glDrawArrays(GL_POINTS, 0, kSpecks);
    glBindVertexArray(0);
    glDisable(GL_PROGRAM_POINT_SIZE);
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
    return Done{};
}

} // namespace shoal::render
