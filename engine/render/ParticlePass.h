// Marine snow: specks that drift between the viewer and what swims. Pairs with shaders/render/Particles.
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
        Everything, // that has been drawn with depth: near things hide specks
        Objects,    // the same, but only where alpha says that there are any
        Picture     // without depth: nothing hides specks
    };

    // After all else. time_s places every speck, so equal times give equal pictures. What of the film is
    // nearer than a speck hides it.
    Status draw(On on, const EyePicture& picture, const water::Water& water, double time_s);

  private:
    gl::Variants programs_;
    gl::VertexArray nothing_; // specks come from their numbers
};

} // namespace shoal::render
