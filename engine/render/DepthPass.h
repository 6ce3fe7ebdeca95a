// Copies a target's depth to a framebuffer of another size or format, and adds that of a film. Pairs with
// shaders/render/Depth.
#pragma once

#include "engine/gl/Program.h"
#include "engine/gl/Target.h"
#include "engine/render/EnvironmentGpu.h"
#include "engine/render/View.h"
#include "engine/render/WholePicture.h"

#include <glm/vec2.hpp>

namespace shoal::render {

class DepthPass {
  public:
    static Result<DepthPass> make();

    // A film with distances, as an eye sees it.
    struct Film {
        const EnvironmentGpu& environment;
        const View& view;
        glm::mat3 envFromEye;
        glm::vec3 eyeInFilm; // as in EyePicture
    };

    // Copies each pixel's nearest sample, unfiltered. part: of the target's width and height, about its
    // middle. Fills the lowest left `size` pixels of `into`, which has depth. film: null without distances.
    void draw(const gl::Target& from, float part, GLuint into, glm::ivec2 size, const Film* film = nullptr);

  private:
    gl::Program plain_, filmed_;
    WholePicture picture_;
    gl::Texture copy_; // without multisampling
    gl::Framebuffer copyTarget_;
    glm::ivec2 copySize_{0};
};

} // namespace shoal::render
