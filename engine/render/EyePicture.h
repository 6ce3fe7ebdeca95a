// The input that all passes of an eye's picture share.
#pragma once

#include "engine/gl/PassTimers.h"
#include "engine/gl/Target.h"
#include "engine/render/BackgroundCells.h"
#include "engine/render/EnvironmentGpu.h"
#include "engine/render/EquirectComposite.h"
#include "engine/render/FilmShadows.h"
#include "engine/render/View.h"
#include "engine/water/Water.h"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace shoal::render {

// One eye's picture: the environment, the camera, and the canvas that it is drawn on.
struct EyePicture {
    const EnvironmentGpu& environment;
    glm::mat3 envFromWorld{1};
    View view;
    Exposure exposure;
    const gl::Target& canvas;
    int eye = 0;        // 0 left, 1 right
    FilmedFrame filmed; // the response of the video's camera in this frame
    // Position of the eye from the film's camera, env frame: the film is drawn at its distances, where they
    // are known. 0: the film is drawn infinitely far away, so that the eye sees what the camera saw.
    glm::vec3 eyeInFilm{0};
    const FilmShadows* shadows = nullptr; // shadows on the film, under the objects; null: none
    SkippedPass skip = SkippedPass::None;
    GLuint layer = 0;     // texture of the objects that hide what is drawn next, by its alpha; 0: none
    float layerWidth = 1; // the layer's width, as a multiple of the picture's
    Surroundings surroundings = Surroundings::Film;
    gl::PassTimers* timers = nullptr; // for the passes of this picture; null: nobody asks

    PartTimes* partTimes() const { return timers ? &timers->onThread() : nullptr; }
    glm::ivec2 size() const { return {canvas.width(), canvas.height()}; }
    const FilmShadows* seenShadows() const { return shadows && !shadows->empty() ? shadows : nullptr; }
    // Returns whether the frame is displayed exactly as it is coded: no curve, no exposure.
    bool showsFrameAsCoded() const { return environment.frameIsCoded() && exposure.keepsFrames(); }
    // Returns the film's distances and the eye's position; no distances if the eye sees what the camera saw.
    FilmParallax filmParallax() const {
        if (eyeInFilm == glm::vec3(0) || !environment.depth().widened) return {};
        return {environment.depth().widened, eyeInFilm};
    }
    // Sets the light, the view and the water of a program in use. withDepth: the film's distances too.
    // Pairs with shaders/render/Water.glsl.
    void bind(const gl::Program& program, const water::Water& water, bool withDepth) const {
        environment.bindLight(program);
        if (withDepth) environment.bindDepth(program, eyeInFilm);
        program.set("clipFromWorld", view.clipFromWorld());
        program.set("eyeWorld", view.eyeWorld);
        program.set("envFromWorld", envFromWorld);
        program.set("exposureScale", exposure.scale());
        program.setArray("waterVeil[0]", water.veil);
        program.set("attenuation_perM", water.attenuation_perM);
    }
    glm::mat3 envFromEye() const { return envFromWorld * glm::mat3_cast(view.worldFromEye); }
};

} // namespace shoal::render
