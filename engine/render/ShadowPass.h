// Dims the background where bodies shade the ground that it shows. Pairs with shaders/render/Shadow.
//
// Differential rendering (Debevec 1998, "Rendering Synthetic Objects into Real Scenes"): the picture is
// multiplied by what the ground would send back shaded over what it sends back unshaded, never more than 1,
// so that a wrong guess at the ground or the light is a faint mistake.
#pragma once

#include "engine/gl/Program.h"
#include "engine/render/FloorShadow.h"
#include "engine/render/TriangleBatch.h"
#include "engine/render/View.h"
#include "engine/water/Water.h"

#include <span>
#include <vector>

namespace shoal::render {

// What a shadow that hides `hidden` of the light leaves of the display values of ground `distance_m` away.
// Display values are taken for square roots of light (water/Water.h), but where frames are coded as the
// thesis has them, whose radiance goes by display values where it is not bright (light/InverseToneMap.h). The
// water between mixes squares; its own light, which is not dimmed, is taken to be as bright as the ground.
glm::vec3 leftOfGround(const FloorLight& light, FrameCoding frames, float hidden, const water::Water& water,
                       float distance_m);

class ShadowPass {
  public:
    static Result<ShadowPass> make();

    // Once a frame: forgets the bodies of the last.
    void begin();
    void add(std::span<const occlusion::Ellipsoid> body, const FloorLight& light); // world frame

    // Objects that are in the picture already, before the ground: a texture whose alpha says where, seen so
    // much wider (1: not at all) than a picture of this many pixels.
    struct Cover {
        GLuint texture = 0;
        float wider = 1;
        glm::ivec2 size{0};
    };

    // After the background, before objects; depth is neither asked nor changed. view: from where the ground
    // was filmed, turned as the eye is. Nothing is drawn where nothing casts. cover: null where nothing
    // covers.
    void draw(const View& view, const FloorLight& light, FrameCoding frames, const water::Water& water,
              const Cover* cover = nullptr);

    size_t patches() const { return patches_.size(); } // since begin()

  private:
    struct Patch {
        FloorPatch floor;
        size_t firstPiece = 0, pieces = 0; // of its body, in flat_

        glm::vec2 at(int x, int y) const; // of its grid: world x and z
    };
    struct Vertex {
        glm::vec3 place, left;
    };

    gl::Program plain_, covered_;
    TriangleBatch drawn_;
    std::vector<Patch> patches_;
    std::vector<FlatPiece> flat_, body_;   // of all bodies; of one: scratch
    std::vector<Vertex> grid_, triangles_; // scratch: of a patch; of all
};

} // namespace shoal::render
