// Holds the distance in every direction (env frame) from the film's camera to the surface that a frame shows,
// aligned to the frame's edges. It serves to hide objects, cast shadows and shift the film for moved eyes.
#pragma once

#include "engine/core/Image.h"
#include "engine/light/FrameView.h"
#include "engine/math/LatLong.h"
#include "engine/media/DepthTrack.h"
#include "shaders/render/Attributes.glsl"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace shoal::depth {

// The map's least distance: the film never hides a hand that is nearer.
constexpr auto kNearest_m = static_cast<float>(FILM_NEAREST_M);

constexpr int kMapWidth = 1024; // chosen by tests/bench/figures/depth.md

struct DepthMap {
    static constexpr float kSteps = 255; // code of an inverse distance of 1 / kNearest_m

    // Lat-long; inverse distance in steps: rounded within 1 % at 3 m, 3.3 % at 10 m. 0: far away, or unknown.
    Image<uint8_t, 1> inverse;

    static constexpr float perM(int code) { return static_cast<float>(code) / (kSteps * kNearest_m); }

    // Returns the inverse distance in 1/m, interpolated linearly; 0 if it is unknown. dirEnv: unit length.
    float inverse_perM(const glm::vec3& dirEnv) const;
};

// Finds the first surface of the film on the ray from an eye beside the camera, by fixed-point iteration from
// the near end. Returns the direction from the camera to it. Where the ray passes behind a depth edge, which
// the frame does not show, returns the direction to the far surface beside that edge.
// eyeEnv: metres from the film's camera, at most a third of a metre; dirEnv: unit length.
glm::vec3 filmDirectionSeen(const DepthMap& map, const glm::vec3& eyeEnv, const glm::vec3& dirEnv);

// Widens near surfaces by a texel. A film's texels at an edge mix the colours of both sides: if they shifted
// with the far side, a moved eye would see a ghost of the edge.
void widenNear(const DepthMap& map, DepthMap& out);

// Finds the nearest and farthest distance within a part of a film without reading every texel: they tell
// whether the film can hide an object at all, or hides it fully.
class DepthRange {
  public:
    struct Range {
        float min_perM = 0, max_perM = 0; // inverse distances
    };

    // Allocates only for a map of a new size.
    void make(const DepthMap& map);

    // Returns the range within this angle of a direction, and a little around it. dirEnv: unit length.
    Range around(const glm::vec3& dirEnv, float halfAngle) const;

    static constexpr glm::ivec2 kCells{128, 64}; // of equal size, row by row
    struct Codes {
        uint8_t min = 255, max = 0;
    };
    const Codes& codesIn(size_t cell) const { return cells_[cell]; }

  private:
    std::vector<Codes> cells_;
    std::vector<uint8_t> columnMin_, columnMax_; // scratch: range of each column in a row of cells
};

// A texel of a depth track where a near and a far surface meet, with its eight neighbours.
struct DepthEdge {
    int x, y;
    std::array<float, 9> inverse; // steps of DepthMap, row by row
    std::array<bool, 9> isNear;
};

// Aligns frames of a depth track to the film's own edges. Allocates nothing once the map has its size.
class DepthRefiner {
  public:
    explicit DepthRefiner(int mapWidth = kMapWidth) : mapWidth_(mapWidth) {}

    // film: the frame that depth belongs to.
    void refine(const media::DepthFrame& depth, const light::FrameView& film, DepthMap& out);

    // Interpolates linearly between the track's texels, without the film. For comparison.
    void enlarge(const media::DepthFrame& depth, DepthMap& out);

  private:
    // A position between texels of the track: the first of two, and the second's weight in 256ths.
    struct Interpolation {
        int first, second, weight;
    };
    static Interpolation interpolationOf(int fine, int fineCount, int coarseCount, bool repeats);

    bool findEdge(int x, int y, DepthEdge& edge) const;
    void weightByConfidence(const media::DepthFrame& depth);
    void placeTexels(int scale);
    void readColours(const light::FrameView& film, int scale);
    void split(const DepthEdge& edge, int scale, DepthMap& out) const;

    int mapWidth_;
    Image<uint8_t, 1> coarse_; // inverse distances in DepthMap's steps, less where confidence is low
    // Scratch.
    std::vector<DepthEdge> edges_;
    size_t padded_ = 0;                  // map texels per track texel, rounded up to a multiple of kLanes
    std::vector<Interpolation> columns_; // by column of the map
    Image<uint16_t, 1> wide_;            // the track enlarged to the map's width, in 256ths
    std::vector<int> filmColumns_;       // by column of the map: its first byte in the film
    std::vector<float> nearness_;        // see placeTexels()
    Image<uint8_t, 1> wanted_;           // by texel of the track: whether its colours are needed
    std::vector<uint8_t> colours_;       // by texel of the map, see readColours()
    Image<float, 3> means_;              // mean colours of the track's texels
};

} // namespace shoal::depth
