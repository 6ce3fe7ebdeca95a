// Draws the environment behind everything, with the bodies' shadows, and a layer of objects over it or in the
// texels of its frame. Pairs with shaders/render/Background. This class needs OpenGL 3.3; where the driver
// renders on the processor, make() returns software/SoftwareBackground.
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

// Objects drawn from an eye.
struct ObjectLayer {
    LayerPass& layer;
    View view; // the layer's view: the picture's, or a little wider
    // The tiles of the frame in whose texels the objects are painted; null: they are laid over the picture.
    const FrameTiles* tiles = nullptr;
    bool filmed = false; // whether the camera's blur, noise and glare are applied to the layer
};

class BackgroundPass {
  public:
    // Makes the implementation for this context. Backend::Software works in every context; it falls back to
    // OpenGL for frames that the processor cannot sample. withLayers: whether draw() will be given tiles.
    static Result<std::unique_ptr<BackgroundPass>> make(Backend backend, bool withLayers);
    virtual ~BackgroundPass() = default;

    // Announces the picture that draw() draws next, so that work on it can start while the layer is drawn.
    // The tiles (null: no layer) and the environment's frame must live until draw().
    virtual void prepare(const EyePicture&, const FrameTiles*) {}

    // Helps with the work that prepare() has started.
    virtual void help() {}

    // Draws over the whole canvas, which is bound before and after; neither tests nor changes depth. layer:
    // null for the environment alone. Compiles the program for a new tone curve first.
    virtual Status draw(const EyePicture& picture, const ObjectLayer* layer);

  protected:
    Status drawCells(const EyePicture& picture, const ObjectLayer* layer); // draws cellsToDraw_
    void markTiles(const CellRange& tiles);                                // adds them to tilesToPaint_

    std::vector<CellToDraw> cellsToDraw_; // cells that OpenGL draws
    std::vector<bool> tilesToPaint_;      // by tile: whether it shows objects

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
    gl::Texture shadowTexture_; // holds FilmShadows::remaining()
    glm::ivec2 shadowSize_{0};
    FilmShadows::Version uploadedShadows_;
};

} // namespace shoal::render
