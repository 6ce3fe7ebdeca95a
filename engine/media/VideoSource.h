// Decoder of one video file, frame by frame, through FFmpeg. For this folder and the webcam's; owned by one
// thread at a time.
#pragma once

#include "engine/media/Decoder.h"
#include "engine/media/VideoFrame.h"

namespace shoal::media {

// Returns how many of the frames that a file states it must have, else it counts as damaged: containers also
// count frames that their edit list or a missing key frame hides.
constexpr int64_t leastFrames(int64_t stated) { return stated - std::max<int64_t>(4, stated / 50); }

class VideoSource {
  public:
    // Checks the kind of file and its stated size before any decoder sees it. Layout::Auto is detected from
    // the metadata, else the frame's shape, else the first frame.
    static Result<VideoSource> open(const Path& file, Layout request);

    const VideoInfo& info() const { return info_; }

    // Number of the frame that the next grab() gives, from 0.
    int64_t position() const { return position_; }

    // Decodes the next frame. Returns false at the end, or if nothing more can be decoded.
    bool grab();

    // Converts the frame grabbed last, blue first and upright, into the image's memory. Returns false if it
    // cannot be converted or has another size than info() says. radianceLin: as for Decoder::convert().
    bool retrieve(ImageRgb8& bgr, ImageRgbF* radianceLin = nullptr);

    glm::ivec2 chromaTexels() const { return in_.decoder.chromaTexels(); } // of the frame grabbed last

    // Makes `number` the next frame, or an earlier one if the file allows no better: the caller grabs on from
    // position(). Returns false if the file cannot be opened again.
    //
    // Frame numbers are computed from time stamps at the container's mean rate: exact if no frame is half a
    // frame early or late.
    bool seek(int64_t number);

  private:
    VideoSource() = default;
    Status reopen(); // errors lack the file's name
    bool decode();   // the next frame
    bool jump(int64_t number);
    void readInfo();
    bool findLayout(Layout request); // false: the first frame was needed and could not be decoded

    Path file_;
    FileDecoder in_;
    VideoInfo info_;
    int quarterTurns_ = 0; // clockwise, to make pictures upright
    ImageRgb8 unturned_;   // scratch for rotation
    ImageRgbF unturnedLin_;
    int64_t position_ = 0;
    double rate_ = 0;      // frames a second by the container, unchecked
    int64_t begins_ = 0;   // time stamp of frame 0
    bool begun_ = false;   // whether frame 0 was decoded
    bool held_ = false;    // whether the next frame is decoded already
    bool seekable_ = true; // until a seek failed
};

} // namespace shoal::media
