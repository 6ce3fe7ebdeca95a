// The first pass over a film of one eye: the camera's movement, and distances from pairs of frames.
#pragma once

#include "engine/depth/estimate/FilmFrames.h"
#include "engine/depth/estimate/PairDepth.h"

#include <deque>

namespace shoal::depth {

class MotionPass {
  public:
    explicit MotionPass(FilmFrames& film) : film_(film) {}

    // How far the frames of a pair are apart: places over the whole film, wider and wider pairs. False: the
    // camera stands still or only turns.
    bool chooseGap();
    // In frames of the track.
    int step() const { return gap_ / kFilmStep; }

    // In order. The first call may be for any frame of the track: pairs that end there are made first.
    FrameRecord frame(int number);

  private:
    void readFaces(int64_t filmFrame, CubeFaces& out) { flow_.makeFaces(film_.eye(filmFrame), out); }
    std::vector<RelativePose> posesOverFilm(int gap, int64_t longest);
    const CubeFaces& facesAt(int number);

    FilmFrames& film_;
    CubeFlow flow_;
    int gap_ = kFilmStep; // frames of the film
    std::deque<CubeFaces> faces_;
    std::deque<PairDepth> pairs_;
    int firstFaces_ = 0, firstPair_ = 0, nextPair_ = -1;
};

} // namespace shoal::depth
