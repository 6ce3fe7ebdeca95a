// Film frames that a depth track is made of: every second one. Reading them in order is quick; any order is
// possible.
#pragma once

#include "engine/light/FrameView.h"
#include "engine/media/VideoPlayer.h"

namespace shoal::depth {

constexpr int kFilmStep = 2; // film frames for each frame of the track

class FilmFrames {
  public:
    explicit FilmFrames(media::VideoPlayer& player) : player_(player), info_(player.info()) {}

    const media::VideoInfo& info() const { return info_; }
    int trackCount() const;
    bool isStereo() const { return info_.layout != media::Layout::Mono; }

    // Valid until the next call. eye: 0 left, 1 right.
    light::FrameView eye(int64_t filmFrame, int eye = 0);

  private:
    media::VideoPlayer& player_;
    media::VideoInfo info_;
};

} // namespace shoal::depth
