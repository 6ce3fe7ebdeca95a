// How far off what one frame of a film shows is, in every direction, at the film's own edges: what objects,
// shadows and eyes that move are drawn with. env frame, from the film's camera.
#pragma once

#include "engine/core/Image.h"
#include "engine/light/FrameView.h"
#include "engine/math/LatLong.h"
#include "engine/media/DepthTrack.h"
#include "shaders/render/Attributes.glsl"

#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace shoal::depth {

// Nothing is taken to be nearer: a hand that reaches so far is never hidden.
constexpr auto kNearest_m = static_cast<float>(FILM_NEAREST_M);

constexpr int kMapWidth = 1024; // tests/bench/figures/depth.md tells why

struct DepthMap {
    static constexpr float kSteps = 255; // of an inverse distance of 1 / kNearest_m

    // Lat-long; inverse distance in steps: within 1.2 % at 3 m, 4 % at 10 m. 0: far away, or
    // not known well enough.
    Image<uint8_t, 1> inverse;

    static constexpr float perM(int code) { return static_cast<float>(code) / (kSteps * kNearest_m); }

    // 1/m, between the texels linear. dirEnv: unit length.
    float inverse_perM(const glm::vec3& dirEnv) const;
    // Infinite where nothing is known.
    float distance_m(const glm::vec3& dirEnv) const { return 1 / inverse_perM(dirEnv); }
};

// What a look along a ray meets: see searchAlong().
struct Seen {
    glm::vec3 dirEnv;   // where the film shows it, from its camera
    float inverse_perM; // of its distance from the film's camera
};

// What an eye beside the film's camera sees in a direction: the first of what the film shows that lies on the
// ray, found by fixed-point iteration from the near end. Where the ray passes behind an edge, what no frame
// shows, it is what stands behind beside that edge. eyeEnv: metres from the film's camera, a third of a metre
// at most; dirEnv: unit length.
Seen searchAlong(const DepthMap& map, const glm::vec3& eyeEnv, const glm::vec3& dirEnv);

// What is near, a texel wider. Texels of a film at an edge have something of both sides: an eye that sees
// them move with what is far sees a ghost of the edge.
void widenNear(const DepthMap& map, DepthMap& out);

// Brings frames of a track to the film's own edges. Allocates nothing once the map has its size.
class DepthRefiner {
  public:
    explicit DepthRefiner(int mapWidth = kMapWidth) : mapWidth_(mapWidth) {}

    // film: the frame that depth belongs to.
    void refine(const media::DepthFrame& depth, const light::FrameView& film, DepthMap& out);

    // Without looking at the film: linear between the track's texels. To compare with.
    void enlarge(const media::DepthFrame& depth, DepthMap& out);

  private:
    // A place between the track's texels: the first of two, and the second's weight in 256ths.
    struct Between {
        int first, second, weight;
    };
    static Between between(int fine, int fineCount, int coarseCount, bool repeats);

    // A texel of the track where near and far meet, with those around it.
    struct Edge {
        int x, y;
        std::array<float, 9> inverse; // as DepthMap has it, row by row
        std::array<bool, 9> isNear;
    };
    bool findEdge(int x, int y, Edge& edge) const;
    void readTrusted(const media::DepthFrame& depth);
    void placeTexels(int scale);
    void readColours(const light::FrameView& film, int scale);
    void split(const Edge& edge, int scale, DepthMap& out) const;

    int mapWidth_;
    Image<uint8_t, 1> coarse_; // inverse distances as DepthMap has them, where they are trusted
    // Scratch.
    std::vector<Edge> edges_;
    int placedScale_ = 0;          // that nearness_ is for
    size_t padded_ = 0;            // texels of the map in one of the track, rounded up for vectors
    std::vector<Between> columns_; // of the map
    Image<uint16_t, 1> wide_;      // the track as wide as the map, in 256ths
    std::vector<int> filmColumns_; // of the map: the first byte of theirs in the film
    std::vector<float> nearness_;  // see placeTexels()
    Image<uint8_t, 1> wanted_;     // texels of the track whose colours are needed
    std::vector<uint8_t> colours_; // of the map's texels, see readColours()
    Image<float, 3> means_;        // and of the track's
};

} // namespace shoal::depth
