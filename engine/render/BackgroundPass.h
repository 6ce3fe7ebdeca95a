// Draws the environment behind everything, with the shadows of bodies on it, and a layer of objects in the
// texels of its frame if there is one. Pairs with shaders/render/Background. This is the OpenGL
// implementation, for any context from 3.3; where the driver renders on the processor, make() returns
// software/SoftwareBackground instead.
#pragma once

#include "engine/gl/Program.h"
#include "engine/render/BackgroundCells.h"
#include "engine/render/EquirectComposite.h"
#include "engine/render/EyePicture.h"
#include "engine/render/LayerPass.h"
#include "engine/render/TriangleBatch.h"

#include <memory>
#include <vector>

namespace shoal::render {

// Objects as an eye sees them, to be put into the texels of the frame.
struct TexelLayer {
    LayerPass& layer;
    View view; // of the layer, a little wider than the picture's
    const FrameTiles& tiles;
    bool filmed = false; // whether the layer gets the response of the frame's camera
};

class BackgroundPass {
  public:
    // Makes the implementation for this context. Backend::Software works in every context, and draws with
    // OpenGL the pictures that it cannot sample. withLayers: whether draw() will be given layers.
    static Result<std::unique_ptr<BackgroundPass>> make(Backend backend, bool withLayers);
    virtual ~BackgroundPass() = default;

    // Tells that this picture is drawn next, and starts work that may run while the layer is drawn. The tiles
    // (null if there is no layer) and the environment's frame must live until draw().
    virtual void prepare(const EyePicture&, const FrameTiles*) {}

    // Draws over the whole canvas, which is bound before and after; neither tests nor changes depth. layer:
    // null for the environment alone. Compiles the program for a new tone curve first.
    virtual Status draw(const EyePicture& picture, const TexelLayer* layer);

  protected:
    Status drawCells(const EyePicture& picture, const TexelLayer* layer); // draws the cells in drawn_
    void want(const FrameTiles& tiles, const BackgroundCell& cell); // marks the tiles that the cell shows

    std::vector<CellToDraw> drawn_; // cells that OpenGL draws
    std::vector<bool> wanted_;      // by tile

  private:
    struct Corner {
        glm::vec2 place, uv;
        glm::vec3 directionEnv;
    };

    gl::Variants programs_;
    TriangleBatch rectangles_;
    BackgroundCells cells_;
    std::vector<Corner> corners_; // scratch
    EquirectComposite composite_;
    gl::Texture shadowTexture_; // of FilmShadows::remaining()
    glm::ivec2 shadowSize_{0};
    FilmShadows::Version uploadedShadows_;
};

} // namespace shoal::render
