// An off-screen picture of the objects alone, at a resolution of its own. Laid over the background it is
// enlarged as the background's texels are. Pairs with shaders/render/Layer.
#pragma once

#include "engine/gl/Program.h"
#include "engine/gl/Target.h"
#include "engine/render/TriangleBatch.h"
#include "engine/render/View.h"
#include "engine/render/software/SmoothOutlines.h"
#include "engine/scene/Model.h"

#include <optional>
#include <span>
#include <vector>

namespace shoal::render {

// A part of the picture: -1 to 1, right and up positive.
struct Box {
    glm::vec2 low{-1}, high{1};
};

// Around the sphere's outline; all of the picture where the sphere surrounds the eye. May reach beyond the
// edges.
Box boxAround(const glm::vec3& centreWorld, float radius, const View& view);

// How large a picture of `pixels` has to be drawn to show as many pixels in its middle, where a picture of a
// plane is coarsest, as a lat-long frame of so many rows has: never more than `pixels`.
glm::ivec2 sizeAsFine(const View& view, glm::ivec2 pixels, int frameRows);

// The same eye with an image plane so much larger (1: equal).
View widened(const View& view, float factor);

class LayerPass {
  public:
    static Result<LayerPass> make();

    // What is drawn next goes into the layer, which is empty: colours premultiplied by alpha.
    void begin(glm::ivec2 size, int samples);

    // Nothing more is drawn into it; leaves another framebuffer bound.
    void end() const { layer_->resolve(); }

    // Instead of more samples a pixel, after end(): what is in it with smoother outlines. Waits until it is
    // drawn: for software renderers.
    void smoothOutlines();

    // Over the bound framebuffer, wherever one of the spheres is seen: there must be nothing in the layer
    // beside them. Where its pixels have been read, only the cells of the picture in which there are any.
    void layOver(std::span<const scene::Sphere> spheres, const View& view);

    // After begin().
    glm::ivec2 size() const { return {layer_->width(), layer_->height()}; }
    const gl::Target& layer();
    // After end(): of the layer, blue first, from the lowest row; read once, waiting until it is drawn.
    const std::vector<uint32_t>& pixels();
    const Coverage& coverage(); // of the pixels; smoothed outlines reach one pixel further

  private:
    void read();
    void markSpheres(std::span<const scene::Sphere> spheres, const View& view);
    void unmarkEmpty(); // needs the pixels

    gl::Program program_;
    TriangleBatch drawn_;
    std::optional<gl::Target> layer_;
    int samples_ = 0;
    OutlineSmoother smoother_;
    std::vector<uint32_t> pixels_;   // of the layer
    Coverage coverage_;              // of these
    bool areRead_ = false;           // since begin()
    bool areNewer_ = false;          // than what is in the layer's texture
    std::vector<bool> marked_;       // scratch: the cells of a grid over the picture
    std::vector<glm::vec2> corners_; // scratch: of their triangles
};

} // namespace shoal::render
