// First pass over a film of one eye: finds the camera's movement, and distances from pairs of frames.
#pragma once

#include "content/make/depth/FilmFrames.h"
#include "content/make/depth/PairDepth.h"

#include <deque>

namespace shoal::depth {

class MotionPass {
  public:
    explicit MotionPass(FilmFrames& film) : film_(film) {}

    // Chooses how far the frames of a pair are apart, by trying wider and wider pairs at places over the
    // whole film. Returns false if the camera stands still or only turns.
    bool chooseGap();
    // Distance between the frames of a pair, in frames of the track.
    int step() const { return gap_ / kFilmStep; }

    // Makes the record of a frame. Call it for each frame of the track in order, beginning at any frame.
    FrameRecord frame(int number);

  private:
    void readFaces(int64_t filmFrame, CubeFaces& out) { flow_.makeFaces(film_.eye(filmFrame), out); }
    std::vector<RelativePose> posesOverFilm(int gap, int64_t longest);
    const CubeFaces& facesAt(int number);

    FilmFrames& film_;
    CubeFlow flow_;
    int gap_ = kFilmStep; // distance between the frames of a pair, in frames of the film
    std::deque<CubeFaces> faces_;
    std::deque<PairDepth> pairs_;
    int firstFaces_ = 0, firstPair_ = 0, nextPair_ = -1;
};

} // namespace shoal::depth
