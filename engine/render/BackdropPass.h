// Draws the surround behind what is already there (depth at the far plane). Pairs with
// shaders/render/Backdrop.
#pragma once

#include "engine/gl/Program.h"
#include "engine/render/SurroundGpu.h"
#include "engine/render/View.h"

namespace shoal::render {

class BackdropPass {
  public:
    static Result<BackdropPass> make();

    // envFromWorld: how the surround is turned against the world.
    void draw(const SurroundGpu& surround, const View& view, const glm::mat3& envFromWorld,
              const Exposure& exposure) const;

  private:
    gl::Program program_;
    gl::VertexArray nothing_; // a core context wants one, even for vertices without attributes
};

} // namespace shoal::render
