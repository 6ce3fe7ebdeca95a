// Cuts the sphere into few texels of a pyramid, small where a lobe is steep, large where it is flat: the
// quadrature rule by which a glossy level is summed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace shoal::light {

struct LobeCell {
    int width = 0;    // of the pyramid level the texel is in
    int row = 0;      // in that level
    int column = 0;   // in that level, 0 .. width - 1
    float weight = 0; // of its radiance; all weights of a rule sum to 1
};

// For the GGX lobe (math::ggxMirrorLobe) around the texel centres of one glossy level.
//
// The idea is that of filtered importance sampling (Krivanek and Colbert 2008, "Real-time Shading with
// Filtered Importance Sampling"): a sample that speaks for a large solid angle reads a coarse level. But
// instead of points drawn from the lobe, the texels of all levels are taken as what they are, means over
// cells: start with the coarsest, split the worst into four, stop when enough are had. The cells cover the
// sphere once, so nothing is missed and nothing counted twice, and each cell's weight is the lobe integrated
// over it. At the poles, where texels crowd, it stops splitting by itself.
class LobeCells {
  public:
    static constexpr int kCoarsestWidth = 8; // of the pyramid levels used

    // outWidth: of the glossy level; cells: most that a rule may have; finestWidth: widest pyramid level it
    // may use. Powers of two, finestWidth >= kCoarsestWidth.
    LobeCells(int outWidth, double roughness, int cells, int finestWidth);

    // The rule for the texel centre in this row and column of the level. out is emptied first.
    void choose(int row, int column, std::vector<LobeCell>& out);

  private:
    static constexpr int kFine = 4; // points across a cell, for the lobe's integral over it

    struct Latitude {
        double sine = 0, ring = 0;
    };
    struct Row {
        Latitude centre;
        double solidAngle = 0; // of one texel
        double radius = 0;     // from centre to the farthest corner, radians
        Latitude fine[kFine];
        double fineSolidAngle[kFine] = {};
    };
    struct Node {
        double error = 0;
        int level = 0, row = 0, column = 0;
    };

    double lobe(double cosine) const;
    void push(int level, int row, int column);
    double integral(const Node& node) const;
    double cosineOfTurn(int64_t at) const {
        return cosines_[static_cast<size_t>(at) & (cosines_.size() - 1)];
    }

    int outWidth_, maxWidth_;
    double alpha_;
    size_t cells_;
    std::vector<std::vector<Row>> levels_; // coarsest first
    std::vector<double> cosines_;          // of a full turn, in steps finer than any cell
    std::vector<Node> nodes_;              // heap, largest error first
    Latitude axis_;
    int64_t axisTurn_ = 0; // longitude of the axis in steps of cosines_
};

} // namespace shoal::light
