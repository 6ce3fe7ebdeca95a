// Samples the background on the processor, with objects in its texels or laid over it: 1 ns a pixel where
// llvmpipe takes 6. OpenGL draws the cells at the poles and the frame's edges, and all of a picture with an
// HDR frame, another exposure or tone curve, or a multisampled canvas.
#pragma once

#include "engine/core/ThreadPool.h"
#include "engine/render/BackgroundPass.h"
#include "engine/render/software/FrameSampler.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace shoal::render {

class SoftwareBackground final : public BackgroundPass {
  public:
    SoftwareBackground();

    // Begins to sample the cells without objects and shadows, on helper threads, while OpenGL still draws the
    // objects. Cells of an eye's earlier picture of the same frame and view are kept: until the film's next
    // frame, pictures at rest differ only where objects are.
    void prepare(const EyePicture& picture, const FrameTiles* tiles) override;
    void help() override { threadPool_.finish(); }
    Status draw(const EyePicture& picture, const ObjectLayer* layer) override;

  private:
    struct Sampled { // the film as the view shows it
        DisplayFrame frame;
        uint64_t frameNumber = 0;
        glm::vec2 halfExtent{0}, shift{0}; // of the view
        glm::mat3 envFromRay{1};
        glm::ivec2 size{0};     // of the picture
        glm::vec3 eyeInFilm{0}; // 0 also if the film has no distances
        bool operator==(const Sampled&) const = default;
    };
    struct State { // of a cell
        SampledCell sampled;
        CellRange tiles;   // of the frame
        bool here = false; // whether it is sampled here; otherwise OpenGL draws it
        // The shadows that the cell's pixels show, null for none; empty if the pixels show objects too.
        std::optional<FilmShadows::Version> shows{};
        bool due = false;          // whether it is made next:
        bool isSampled = false;    // its pixels show the background already
        bool isPainted = false;    // it is sampled from texels_, otherwise from the frame
        bool isUnderLayer = false; // the layer is laid over it
    };
    static constexpr int kParts = 32; // number of parts into which the cells are divided for threads
    struct Eye {
        Sampled film;
        BackgroundCells grid;
        std::vector<State> states;     // of the grid's cells
        std::vector<uint32_t> picture; // rows from the bottom
    };
    struct SamplePart { // samples the due cells of a part
        SoftwareBackground* pass;
        void operator()(int part) const;
    };

    static void classify(const EyePicture& picture, Eye& eye);
    void layOverCell(const glm::ivec2& low, const glm::ivec2& high) const;
    void paintFrame(const EyePicture& picture, const ObjectLayer* layer);

    std::array<Eye, 2> eyes_;
    Eye* eye_ = eyes_.data(); // the one whose picture is sampled
    bool started_ = false;
    // A copy of the frame with shadows and objects in its texels, of which only the wanted tiles are written.
    // Not a vector, which would touch all of its memory: objects are in few places.
    std::unique_ptr<uint32_t[]> texels_;
    glm::ivec2 texelsSize_{0};
    DisplayFrame over_;              // the layer that is laid over the picture
    std::vector<glm::vec2> corners_; // scratch: of cells over which OpenGL lays it
    std::vector<glm::ivec2> tiles_;  // scratch: the wanted tiles
    SamplePart samplePart_{this};
    ThreadPool threadPool_; // last, so that its threads end before their data
};

} // namespace shoal::render
