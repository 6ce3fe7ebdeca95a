// The distances of the surfaces that one frame of a film shows, in every direction, aligned to the film's own
// edges. Objects, shadows and moving eyes' views are drawn with them. env frame, from the film's camera.
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

// The least distance in the map. So the film never hides a hand that is nearer.
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

// Returns what an eye beside the film's camera sees in a direction, as a direction from that camera: the
// first point of the film on the ray, found by fixed-point iteration from the near end. Where the ray passes
// behind a depth edge, in a place that no frame shows, it returns the surface behind, beside that edge.
// eyeEnv: metres from the film's camera, at most a third of a metre; dirEnv: unit length.
glm::vec3 searchAlong(const DepthMap& map, const glm::vec3& eyeEnv, const glm::vec3& dirEnv);

// Widens near surfaces by a texel. Texels at a film's edges mix the colours of both sides: if they moved with
// the far side, an eye would see a ghost of the edge.
void widenNear(const DepthMap& map, DepthMap& out);

// Nearest and farthest distance within a part of a film, found without reading every texel: tells whether the
// film can hide an object at all, or hides it fully.
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
    std::vector<uint8_t> columnMin_, columnMax_; // scratch: extremes over the rows of a cell
};

// A texel of a depth track at which near and far surfaces meet, with the eight texels around it.
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
    void readTrusted(const media::DepthFrame& depth);
    void placeTexels(int scale);
    void readColours(const light::FrameView& film, int scale);
    void split(const DepthEdge& edge, int scale, DepthMap& out) const;

    int mapWidth_;
    Image<uint8_t, 1> coarse_; // inverse distances in DepthMap's steps, less where confidence is low
    // Scratch.
    std::vector<DepthEdge> edges_;
    size_t padded_ = 0;                  // the map's texels in one of the track, to a multiple of kLanes
    std::vector<Interpolation> columns_; // by column of the map
    Image<uint16_t, 1> wide_;            // the track enlarged to the map's width, in 256ths
    std::vector<int> filmColumns_;       // by column of the map: its first byte in the film
    std::vector<float> nearness_;        // see placeTexels()
    Image<uint8_t, 1> wanted_;           // texels of the track whose colours are needed
    std::vector<uint8_t> colours_;       // by texel of the map, see readColours()
    Image<float, 3> means_;              // mean colours of the track's texels
};

} // namespace shoal::depth
