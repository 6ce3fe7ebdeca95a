// Marine snow: specks that drift between the viewer and the animals. Pairs with shaders/render/Particles.
#pragma once

#include "engine/gl/Objects.h"
#include "engine/gl/Program.h"
#include "engine/render/EyePicture.h"
#include "engine/water/Water.h"

namespace shoal::render {

class ParticlePass {
  public:
    static Result<ParticlePass> make();

    enum class On {
        Everything, // the picture with depth: nearer objects hide specks
        Objects,    // the same, but only where alpha shows an object
        Picture     // the picture without depth: the picture's layer hides specks
    };

    // Draws the specks, after all else. time_s places every speck, so equal times give equal pictures. Nearer
    // parts of the film hide specks.
    Status draw(On on, const EyePicture& picture, const water::Water& water, double time_s);

  private:
    gl::Variants programs_;
    gl::VertexArray nothing_; // no attributes: the shader makes specks from their indices
};

} // namespace shoal::render
