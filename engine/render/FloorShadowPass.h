// Shadows of bodies on the floor of the player's room, which others show: black, with an alpha of how much of
// the floor's light they take. Pairs with shaders/render/FloorShadow.
#pragma once

#include "engine/gl/Program.h"
#include "engine/math/Sphere.h"
#include "engine/render/CastShadow.h"
#include "engine/render/TriangleBatch.h"
#include "engine/render/View.h"

#include <span>
#include <vector>

namespace shoal::render {

class FloorShadowPass {
  public:
    static Result<FloorShadowPass> make();

    // Once a frame: forgets the bodies of the last.
    void begin();
    // body: world frame; what of it is below the floor casts nothing. floor_m: height, world. frames: whose
    // light was found.
    void add(std::span<const occlusion::Ellipsoid> body, const CastingLight& light, float floor_m,
             FrameCoding frames);

    // After the objects: under what they left in the picture, premultiplied, and behind what is nearer by its
    // depth, which stays.
    void draw(const View& view);

    // They hold the shadows; world.
    std::span<const Sphere> spheres() const { return spheres_; }
    bool empty() const { return triangles_.empty(); } // since begin()

  private:
    struct Node {
        glm::vec3 place; // world
        float taken;     // 0 to 1
    };

    gl::Program program_;
    TriangleBatch drawn_;
    std::vector<Node> triangles_; // of all bodies
    std::vector<Sphere> spheres_;
    std::vector<FlatPiece> body_; // scratch: of one
    std::vector<Node> nodes_;     // scratch: of one
};

} // namespace shoal::render
