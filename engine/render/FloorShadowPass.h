// Shadows of bodies on the floor of the player's own room, which the headset shows: black, with alpha the
// share of the floor's light that they take. Pairs with shaders/render/FloorShadow.
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

    // Begins a frame without bodies.
    void begin();
    // Adds the shadow of a body, world frame; its parts below the floor cast none. floor_m: height, world.
    // frames: coding of the frames from which the light was estimated.
    void add(std::span<const occlusion::Ellipsoid> body, const CastingLight& light, float floor_m,
             FrameCoding frames);

    // Draws the shadows, after the objects: beneath the picture's premultiplied colours, and only where its
    // depth is not nearer. Does not change depth.
    void draw(const View& view);

    bool empty() const { return triangles_.empty(); } // since begin()

  private:
    struct Node {
        glm::vec3 place; // world
        float taken;     // 0 to 1
    };

    gl::Program program_;
    TriangleBatch drawn_;
    std::vector<Node> triangles_; // of all bodies
    std::vector<FlatPiece> body_; // scratch: of one body
    std::vector<Node> nodes_;     // scratch: of one body
};

} // namespace shoal::render
