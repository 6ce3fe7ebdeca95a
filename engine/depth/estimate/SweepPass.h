// The second pass over a film of one eye, whose camera's movement is known: distances from several frames.
#pragma once

#include "engine/depth/estimate/FilmFrames.h"
#include "engine/depth/estimate/PairScale.h"
#include "engine/depth/estimate/SphereSweep.h"

#include <deque>

namespace shoal::depth {

// How the camera moved: of each frame of the track, and for how many of them the pairs are apart.
struct CameraPath {
    std::vector<PairMotion> motions;
    std::vector<double> baselines_m;
    int step = 1;
};

class SweepPass {
  public:
    // maxInverse_perM: of what is nearest.
    SweepPass(FilmFrames& film, const CameraPath& path, float maxInverse_perM)
        : film_(film), path_(path), maxInverse_perM_(maxInverse_perM) {}

    // In order from whichever on. 1/m.
    void frame(int number, DepthEstimate& out);

  private:
    const SweepImage& imageAt(int number);

    FilmFrames& film_;
    const CameraPath& path_;
    float maxInverse_perM_;
    SphereSweep sweep_;
    std::deque<SweepImage> images_;
    int firstImage_ = -1;
};

} // namespace shoal::depth
