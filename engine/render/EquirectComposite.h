// Puts a layer of objects, as an eye sees them, into the texels of the video's frame: a copy of the frame's
// tiles with the objects in them, which the background then shows instead of the frame. Pairs with
// shaders/render/EquirectComposite.
//
// Each texel takes what the layer shows in its middle's direction, so that no triangle is ever drawn in the
// equirectangular map, where straight edges bend and a pole tears them apart: seam and poles need no care.
#pragma once

#include "engine/gl/Program.h"
#include "engine/render/CameraComposite.h"
#include "engine/render/EnvironmentGpu.h"
#include "engine/render/FrameTiles.h"
#include "engine/render/TriangleBatch.h"
#include "engine/render/View.h"

#include <vector>

namespace shoal::render {

class EquirectComposite {
  public:
    static Result<EquirectComposite> make();

    // Writes the wanted tiles (indices as FrameTiles counts them). layer: a texture of display values,
    // premultiplied, seen by layerView; nothing may be in it beside the chosen tiles. Leaves another
    // framebuffer bound. Display-coded frames only. filmed: null for the layer as it is; the program for a
    // camera response of a new kind is compiled first.
    Status paint(const EnvironmentGpu& environment, const FrameTiles& tiles, const std::vector<bool>& wanted,
                 GLuint layer, const View& layerView, const glm::mat3& envFromWorld,
                 const FilmedFrame* filmed = nullptr);

    GLuint texture() const { return frame_.name(); } // undefined beside the tiles painted last

  private:
    gl::Variants programs_;
    gl::Texture grain_; // once something is filmed
    TriangleBatch drawn_;
    gl::Texture frame_;
    gl::Framebuffer framebuffer_;
    glm::ivec2 size_{0};
    std::vector<glm::vec2> corners_; // scratch: of the tiles' triangles, uv
};

} // namespace shoal::render
