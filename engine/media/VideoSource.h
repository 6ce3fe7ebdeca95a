// Decoder of one video file, frame by frame, for this folder and the webcam's; owned by one thread at a time.
#pragma once

#include "engine/media/Decoder.h"
#include "engine/media/VideoFrame.h"

#include <algorithm>
#include <cmath>

namespace shoal::media {

// Returns how many of the frames that a file states it must have, else it counts as damaged: containers also
// count frames that their edit list or a missing key frame hides.
constexpr int64_t leastFrames(int64_t stated) { return stated - std::max<int64_t>(4, stated / 50); }

// Presents frames at a constant rate: frame i shows the picture with the greatest time stamp, counted from
// the first picture's, at or before (i + 1/4) / fps. Matroska rounds stamps to milliseconds: hence the
// quarter. So pictures are shown again where stamps are sparse, and passed over where they are denser. The
// rate is the container's mean, or that of the densest pictures at the beginning if they are denser.
class VideoSource {
  public:
    // Checks the kind of file and its stated size before any decoder sees it. Layout::Auto is detected from
    // the metadata, else the frame's shape, else the first frame.
    static Result<VideoSource> open(const Path& file, Layout request, Decoding decoding = Decoding::Sparing);

    const VideoInfo& info() const { return info_; }

    // Number of the frame that the next grab() gives, from 0.
    int64_t position() const { return position_; }

    // Decodes the next frame. Returns false at the end, or if nothing more can be decoded. hurries: leaves
    // out pictures that no others refer to, and gives the one before again.
    bool grab(bool hurries = false);

    // Converts the frame grabbed last, blue first, upright and placed in its bounds, into the image's memory.
    // Returns false if that fails or the size is not the first's. radianceLin: as for Decoder::convert().
    bool retrieve(ImageRgb8& bgr, ImageRgbF* radianceLin = nullptr);

    // Makes `out` hold the planes of the frame grabbed last, if retrieve() neither turns nor places it.
    void share(VideoFrame& out) {
        if (info_.metadata.orientation == 1 && !isPlaced_) in_.decoder.share(out);
    }

    glm::ivec2 chromaTexels() const { return in_.decoder.chromaTexels(); } // of the frame grabbed last

    // Makes `number` the next frame, or an earlier one if the file allows no better: the caller grabs on from
    // position(). Returns false if the file cannot be opened again.
    bool seek(int64_t number);

    // Returns the last key frame at or before this frame, by the file's index, or a frame soon after it;
    // where the index is not complete, one a few seconds before the frame.
    int64_t keyFrameBefore(int64_t number) const;

    // Continues at the present frame without a graphics card, after the card has failed.
    void leaveCard();

  private:
    VideoSource() = default;
    Status reopen(); // errors lack the file's name
    void decodeAhead();
    double timeOfAhead() const; // seconds
    void showAhead();
    bool jump(int64_t number);
    double stampOf(double number) const; // time stamp of a frame
    void readInfo();
    bool findLayout(Layout request); // false: the first frame was needed and could not be decoded
    Status readColour();
    void findPlace();

    Path file_;
    Decoding decoding_ = Decoding::Sparing;
    FileDecoder in_; // its frame is shown
    VideoInfo info_;
    int storedWidth_ = 0, storedHeight_ = 0;
    double pixelAspect_ = 1;     // width of an upright pixel by its height
    bool isPlaced_ = false;      // frames are placed in their bounds
    ImageRgb8 stored_, upright_; // scratch
    ImageRgbF storedLin_, uprightLin_;
    int64_t position_ = 0;
    double length_s_ = 0;            // as the file states it; 0: not stated
    Frame ahead_ = makeFrame();      // the picture after the one shown
    double ahead_s_ = 0;             // its time
    double shown_s_ = 0, end_s_ = 0; // times at which the picture shown begins and ends
    bool hasAhead_ = false, isShowing_ = false;
    int64_t begins_ = 0;   // time stamp of the first picture
    bool begun_ = false;   // whether the first picture was decoded
    bool seekable_ = true; // until a seek failed
};

// --- Choice of the frame that a film's decoder makes next, so that what is shown follows a clock. Times are
// in frames of the film: a cost of 1 is real time.

// Cost of recent pictures.
struct DecodingCost {
    double decode = 0; // of each picture
    double show = 0;   // besides, of one that is shown: conversion and analysis

    // Follows the costs of a frame, for which `count` pictures were decoded in all.
    void follow(int64_t count, double decoding, double showing) {
        constexpr double kShare = 0.25; // of the newest costs
        decode += kShare * (decoding / static_cast<double>(count) - decode);
        show += kShare * (showing - show);
    }
};

struct NextFrame {
    int64_t index = 0;
    bool hurries = false; // pictures that no others refer to are left out meanwhile
};

// Returns the frame to make after frame `made`, while frame `due` is due: the next one, or a later one that
// is ready before its time is over, although all pictures before it are decoded too. If decoding these takes
// more than `longest`, the film falls behind by small steps, until a key frame can be made in time.
// keyFrameBefore(index): the last key frame at or before a frame.
template <class KeyFrameBefore>
NextFrame nextFrame(int64_t made, int64_t due, const DecodingCost& cost, double longest,
                    KeyFrameBefore&& keyFrameBefore) {
    // Frame made + n is ready at the time due + n cost.decode + cost.show, and is due until made + n + 1.
    const double late = static_cast<double>(due - made - 1) + cost.show;
    if (late <= 0) return {made + 1};
    const double step = std::ceil(late / (1 - cost.decode));
    if (cost.decode < 1 && step * cost.decode <= longest) return {made + static_cast<int64_t>(step)};
    // With this step decoding gets four fifths of the time, or at least one picture can be left out.
    const double most = std::max(longest / cost.decode, 1.0);
    const auto small = static_cast<int64_t>(std::min(std::max(4 * cost.show / cost.decode, 2.0), most));
    const auto ready = due + static_cast<int64_t>(cost.decode + cost.show);
    return {std::max(made + small, keyFrameBefore(ready)), true};
}

} // namespace shoal::media
