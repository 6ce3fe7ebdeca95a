// What the passes of an eye's picture have in common.
#pragma once

#include "engine/gl/Target.h"
#include "engine/render/BackgroundCells.h"
#include "engine/render/EnvironmentGpu.h"
#include "engine/render/EquirectComposite.h"
#include "engine/render/FilmShadows.h"
#include "engine/render/View.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace shoal::render {

// One eye's picture: the environment, the camera, and the canvas that it is drawn on.
struct EyePicture {
    const EnvironmentGpu& environment;
    glm::mat3 envFromWorld{1};
    View view;
    Exposure exposure;
    const gl::Target& canvas;
    int eye = 0;             // 0 left, 1 right
    bool sharesFrame = true; // both eyes see the same frame of the video
    FilmedFrame filmed;      // what the video's camera did to the frame
    // Of the eye, from the film's camera, env frame: what the film shows is drawn at its distance, as far as
    // it is known. 0: as if it were endlessly far, so that the eye sees what the camera saw.
    glm::vec3 eyeInFilm{0};
    const FilmShadows* shadows = nullptr; // on what the film shows, under the objects; null: none
    SkippedPass skip = SkippedPass::None;
    Surroundings surroundings = Surroundings::Film;

    glm::ivec2 size() const { return {canvas.width(), canvas.height()}; }
    // Those that there is anything of; null: none.
    const FilmShadows* seenShadows() const { return shadows && !shadows->empty() ? shadows : nullptr; }
    // How the eye sees the film in space; without distances where it sees what the camera saw.
    FilmSpace filmSpace() const {
        if (eyeInFilm == glm::vec3(0) || !environment.widenedDepth()) return {};
        return {environment.widenedDepth(), eyeInFilm};
    }
    glm::mat3 envFromEye() const { return envFromWorld * glm::mat3_cast(view.worldFromEye); }
};

} // namespace shoal::render
