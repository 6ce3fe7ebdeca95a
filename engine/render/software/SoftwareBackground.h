// Samples the background, and paints objects into the frame's texels, on the processor: what llvmpipe takes 6
// ns a pixel for takes 1 ns here. OpenGL draws the cells that this leaves (at the poles and the frame's
// edges), and whole pictures that it cannot sample: HDR frames, other exposures or tone curves, multisampled
// canvases.
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
    // Cells without objects are kept from an earlier picture of the same frame and view: a second eye's
    // picture, and those until the film goes on, differ by objects only.
    void prepare(const EyePicture& picture, const FrameTiles* tiles) override;
    Status draw(const EyePicture& picture, const TexelLayer* layer) override;

  private:
    struct Shown {
        DisplayFrame frame;
        uint64_t frameNumber = 0;
        glm::vec2 halfExtent{0}, shift{0}; // of the view
        glm::mat3 envFromRay{1};
        glm::ivec2 size{0};     // of the picture
        glm::vec3 eyeInFilm{0}; // 0 where the film has no distances, too
        bool operator==(const Shown&) const = default;
    };
    enum class Content { Unknown, Frame, Shaded, Objects };
    struct State { // of a cell
        SampledCell sampled;
        bool here = false;                // else OpenGL draws it
        Content shown = Content::Unknown; // in the picture; Shaded: by shadows_
        bool shaded = false;              // there are shadows
        bool painted = false;             // before the layer is known: there may be shadows or objects
        bool due = false;                 // is sampled next
    };
    struct SampleRow { // the due ones of a row of cells
        SoftwareBackground* pass;
        DisplayFrame frame, painted;
        void operator()(int row) const;
    };
    struct Run {             // of tiles, as FrameTiles counts them
        int row, first, end; // of columns
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
    std::vector<uint8_t> grain_;    // once something is filmed
    CameraUniforms uniforms_;       // of the frame, then
    // A copy of the frame with shadows and objects in its texels, of which only the wanted tiles are written.
    // Not a vector, which would touch all of its memory: objects are in few places.
    std::unique_ptr<uint32_t[]> texels_;
    glm::ivec2 texelsSize_{0};
    std::vector<Run> runs_; // of wanted tiles
    FrameTiles covered_;    // those of the layer's in which there is something
    SampleRow sampleRow_{};
    ThreadPool threadPool_; // last, so that it ends before what it reads
};

} // namespace shoal::render
