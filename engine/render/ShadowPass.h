// Dims the background where bodies shade what it shows. Pairs with shaders/render/Shadow.
//
// Differential rendering (Debevec 1998, "Rendering Synthetic Objects into Real Scenes"): the picture is
// multiplied by what the surface would send back shaded over what it sends back unshaded, never more than 1,
// so that a wrong guess at the surface or the light is a faint mistake.
#pragma once

#include "engine/gl/Program.h"
#include "engine/render/CastShadow.h"
#include "engine/render/TriangleBatch.h"
#include "engine/render/View.h"
#include "engine/water/Water.h"

#include <span>
#include <vector>

namespace shoal::render {

// What of the display values of a surface `distance_m` away is left where a shadow takes that share of its
// irradiance, 0 to 1. Display values are taken for square roots of light (water/Water.h), but where frames
// are coded as the thesis has them, whose radiance goes by display values where it is not bright
// (light/InverseToneMap.h). The water between mixes squares; its own light, which is not dimmed, is taken to
// be as bright as the surface.
glm::vec3 leftOf(const glm::vec3& taken, FrameCoding frames, const water::Water& water, float distance_m);

class ShadowPass {
  public:
    static Result<ShadowPass> make();

    // Once a frame: forgets the bodies of the last.
    void begin();
    // body: world frame; eyes: that draw() is called for, as it has them.
    void add(std::span<const occlusion::Ellipsoid> body, const CastingLight& light, const FilmSurface& film,
             std::span<const View> eyes);

    // Objects that are in the picture already, before the film: a texture whose alpha says where, seen so
    // much wider (1: not at all) than a picture of this many pixels.
    struct Cover {
        GLuint texture = 0;
        float wider = 1;
        glm::ivec2 size{0};
    };

    // After the background, before objects; depth is neither asked nor changed. view: as the
    // eye sees the film, whose camera is at the world's origin. Nothing is drawn where nothing casts. cover:
    // null where nothing covers.
    void draw(const View& view, FrameCoding frames, const water::Water& water, const Cover* cover = nullptr);

    bool empty() const { return corners_.empty(); } // since begin()

  private:
    struct Vertex {
        glm::vec3 place, left;
    };

    gl::Program plain_, covered_;
    TriangleBatch drawn_;
    std::vector<ShadowGrid::Node> nodes_;  // of all bodies
    std::vector<size_t> corners_;          // of triangles, in nodes_
    std::vector<FlatPiece> body_;          // scratch: of one
    ShadowGrid grid_;                      // scratch: of one
    std::vector<Vertex> seen_, triangles_; // scratch: of all nodes; of all triangles
};

} // namespace shoal::render
