// From coded pictures to pictures: of files, streams and cameras. For this room; one thread's.
#pragma once

#include "engine/core/Image.h"
#include "engine/core/Result.h"
#include "engine/media/ColourMatrix.h"
#include "engine/media/Ffmpeg.h"

#include <vector>

struct SwsContext;

namespace shoal::media {

// Error: no picture of that size is played.
Status checkPictureSize(int width, int height);

// Motion JPEG is BT.601 whatever its size (JFIF); else as colourMatrixOf() says, whose codes FFmpeg has too.
ColourMatrix matrixOf(AVCodecID codec, AVColorSpace stated, int width, int height);

// Whether pictures may be held back: a thread for each of several pictures is quicker, but late by as many.
enum class HoldBack { None, ByThreads };

class PictureDecoder {
  public:
    PictureDecoder();
    ~PictureDecoder();
    PictureDecoder(PictureDecoder&& other) noexcept;
    PictureDecoder& operator=(PictureDecoder&& other) noexcept;

    // threads: at least 1. Error: no such codec is installed, or it does not start.
    Status open(const AVCodecParameters& parameters, AVRational timeBase, HoldBack holdBack, int threads);

    // A packet; null: no more will come. What cannot be decoded is passed over. hurry: so are pictures that
    // no other needs.
    void send(const AVPacket* packet, double arrived_s = 0, bool hurry = false);
    void forget(); // what it began with: packets have been left out

    // The next picture that is complete, if there is one.
    bool receive();
    // Of the picture received last:
    const AVFrame& frame() const { return *frame_; }
    double arrived_s() const; // its packet
    ColourMatrix matrix() const;

    // The picture received last, blue first; takes its size. Colours by the matrix and the range that it
    // states; as exactly as 8 bits can where it is 4:2:0 or 4:2:2 of 8 bits itself. Error: it is too large,
    // or of an unknown form.
    Status convert(ImageRgb8& bgr);

  private:
    bool fullRange() const;
    void convertPlanes(int differenceRowShift, ImageRgb8& bgr) const;
    Status convertRare(ImageRgb8& bgr);

    Codec codec_;
    Frame frame_;
    SwsContext* scaler_ = nullptr; // of rare forms
    std::vector<uint8_t> rows_;    // theirs, with room behind each
};

} // namespace shoal::media
