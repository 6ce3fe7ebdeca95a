// One eye's picture: the environment, the camera, and the canvas that it is drawn on.
#pragma once

#include "engine/gl/Target.h"
#include "engine/render/CameraComposite.h"
#include "engine/render/Composition.h"
#include "engine/render/EnvironmentGpu.h"
#include "engine/render/View.h"

namespace shoal::render {

struct EyePicture {
    const EnvironmentGpu& environment;
    glm::mat3 envFromWorld{1};
    View view;
    Exposure exposure;
    const gl::Target& canvas;
    int eye = 0;             // 0 left, 1 right
    bool sharesFrame = true; // both eyes see the same frame of the video
    FilmedFrame filmed;      // what the video's camera did to the frame
    SkippedPass skip = SkippedPass::None;

    glm::ivec2 size() const { return {canvas.width(), canvas.height()}; }
    glm::mat3 envFromEye() const { return envFromWorld * glm::mat3_cast(view.worldFromEye); }
};

} // namespace shoal::render
