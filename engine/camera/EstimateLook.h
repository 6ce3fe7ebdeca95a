// The look of a video from one of its frames.
//
// Only stripes of the middle half of the frame are read, where texels are nearly square: 8 % of a
// 2048 x 1024 frame. Nothing is allocated once a frame of this size has been seen. One thread at a time.
#pragma once

#include "engine/camera/FilmLook.h"
#include "engine/light/FrameView.h"

#include <vector>

namespace shoal::camera {

// What a frame tells; counts say how far it can be believed.
struct LookEstimate {
    FilmLook look;
    int edges = 0;                               // that blur was measured at; below kFewEdges blur is 0
    std::array<int, kBrightnesses> flatBlocks{}; // that noise was measured in; bands without: their
                                                 // neighbours' noise
    bool chromaKnown = false;                    // else taken as 4:2:0, which nearly all video is
};

constexpr int kFewEdges = 12;
constexpr int kFewBlocks = 8; // of a band: fewer are likely to be all texture

class LookEstimator {
  public:
    LookEstimate estimate(const light::FrameView& frame);

  private:
    void readStripe(const light::FrameView& frame, int top);
    void measureEdges(float stretch);
    void measureBlur(LookEstimate& out);
    void measureNoise(LookEstimate& out);
    void measureChroma();
    void measureLevels(const light::FrameView& frame, FilmLook& look);

    // Of the stripe in work, row by row: luma and two colour differences, 0 to 255; clipped where a channel
    // is.
    int width_ = 0;
    std::vector<float> luma_, blueLess_, redLess_;
    std::vector<unsigned char> clipped_;

    struct Blocks {
        std::vector<float> fine, coarse; // standard deviations
    };
    struct Edge {
        float blur_texels;
        float step; // of 255
    };
    std::vector<Edge> edges_;
    std::vector<float> blurs_; // scratch
    std::array<Blocks, kBrightnesses> blocks_;
    // Squares of colours' differences of three orders, by whether they begin at an even texel.
    struct Parity {
        double first[2] = {}, second[2] = {}, third[2] = {};
        int count = 0;
    };
    std::array<Parity, 2> chroma_; // across, down
};

} // namespace shoal::camera
