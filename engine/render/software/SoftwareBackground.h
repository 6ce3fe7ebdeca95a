// Samples the background, and paints objects into the frame's texels, on the processor: 1 ns a pixel where
// llvmpipe takes 6. OpenGL draws the cells that this leaves (at the poles and the frame's edges), and whole
// pictures that it cannot sample: HDR frames, other exposures or tone curves, multisampled canvases.
#pragma once

#include "engine/core/ThreadPool.h"
#include "engine/render/BackgroundPass.h"
#include "engine/render/software/FrameSampler.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace shoal::render {

struct TexelPaint;

class SoftwareBackground final : public BackgroundPass {
  public:
    SoftwareBackground();

    // Begins to sample the cells without objects, on helper threads, while OpenGL still draws the objects.
    // Cells without objects are kept from an earlier picture of the same frame and view: the second eye's
    // picture, and pictures until the film's next frame, differ by objects only.
    void prepare(const EyePicture& picture, const FrameTiles* tiles) override;
    Status draw(const EyePicture& picture, const TexelLayer* layer) override;

  private:
    struct Shown {
        DisplayFrame frame;
        uint64_t frameNumber = 0;
        glm::vec2 halfExtent{0}, shift{0}; // of the view
        glm::mat3 envFromRay{1};
        glm::ivec2 size{0};     // of the picture
        glm::vec3 eyeInFilm{0}; // 0 also where the film has no distances
        bool operator==(const Shown&) const = default;
    };
    enum class Content { Unknown, Frame, Shaded, Objects };
    struct State { // of a cell
        SampledCell sampled;
        bool here = false;                // whether it is sampled here; otherwise OpenGL draws it
        Content shown = Content::Unknown; // content of the picture; Shaded: by shadows_
        bool shaded = false;              // whether there are shadows in it
        bool painted = false; // whether there may be shadows or objects; set before the layer is known
        bool due = false;     // whether it is sampled next
    };
    struct SampleRow { // samples the due cells of a row
        SoftwareBackground* pass;
        DisplayFrame frame, painted;
        void operator()(int row) const;
    };
    struct Run {             // a run of tiles, as FrameTiles counts them
        int row, first, end; // row, and range of columns
    };

    void classify(const EyePicture& picture);
    void findCovered(const TexelLayer& layer, const TexelPaint& paint);
    TexelPaint paintOf(const EyePicture& picture, const TexelLayer& layer);
    void paintFrame(const FrameTiles* objects, const TexelPaint& paint, const FilmShadows* shadows);
    DisplayFrame painted() const;

    Shown shown_;
    FilmShadows::Version shadows_;
    bool started_ = false;
    BackgroundCells grid_;
    std::vector<State> states_;     // of the grid's cells
    std::vector<uint32_t> picture_; // rows from the bottom
    std::vector<uint8_t> grain_;    // made once something is filmed
    CameraUniforms uniforms_;       // of the frame, if it is filmed
    // A copy of the frame with shadows and objects in its texels, of which only the wanted tiles are written.
    // Not a vector, which would touch all of its memory: objects are in few places.
    std::unique_ptr<uint32_t[]> texels_;
    glm::ivec2 texelsSize_{0};
    std::vector<Run> runs_; // of wanted tiles
    FrameTiles covered_;    // the layer's tiles that show something
    SampleRow sampleRow_{};
    ThreadPool threadPool_; // last, so that its threads end before their data
};

} // namespace shoal::render
