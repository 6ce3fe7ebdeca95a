// Second pass over a film of one eye, once its camera's movement is known: finds distances from several
// frames.
#pragma once

#include "content/make/depth/FilmFrames.h"
#include "content/make/depth/PairScale.h"
#include "content/make/depth/SphereSweep.h"

#include <deque>

namespace shoal::depth {

// Movement of the camera: a pair for each frame of the track.
struct CameraPath {
    std::vector<PairMotion> motions;
    std::vector<double> baselines_m;
    int step = 1; // distance between the frames of a pair, in frames of the track
};

class SweepPass {
  public:
    // maxInverse_perM: inverse distance of the nearest thing.
    SweepPass(FilmFrames& film, const CameraPath& path, float maxInverse_perM)
        : film_(film), path_(path), maxInverse_perM_(maxInverse_perM) {}

    // Call it for each frame of the track in order, beginning at any frame. Inverse distances are in 1/m.
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
