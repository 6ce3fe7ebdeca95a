// For this room and the webcam's: one video file being decoded, frame by frame. Owned by one thread at a
// time.
#pragma once

#include "engine/media/PictureDecoder.h"
#include "engine/media/VideoInfo.h"

#include <memory>

struct AVFormatContext;
struct AVStream;

namespace shoal::media {

struct CloseInput {
    void operator()(AVFormatContext* input) const;
};

class VideoSource {
  public:
    // Checks the kind of file and its stated size before any decoder sees it. info() lacks layout.
    static Result<VideoSource> open(const Path& file);

    const VideoInfo& info() const { return info_; }

    // Number of the frame that the next grab() gives, from 0.
    int64_t position() const { return position_; }

    // Decodes the next frame. False at the end, or where nothing more can be decoded.
    bool grab();

    // The frame grabbed last, blue first and turned upright, into the image's own memory. False if it cannot
    // be had or has another size than info() says.
    bool retrieve(ImageRgb8& bgr);

    // Makes `number` the next frame, or a smaller number if that is as near as the file lets: the caller
    // grabs on from position(). False if the file cannot be opened again.
    //
    // Frames are told by their time stamps, as many as fit between at the container's mean rate: exact where
    // no frame is half a one early or late.
    bool seek(int64_t number);

  private:
    VideoSource() = default;
    Status reopen(); // without the file's name
    bool decode();   // the next frame
    bool jump(int64_t number);
    const AVStream& stream() const;
    void readInfo(const SphericalMetadata& metadata);

    Path file_;
    const char* container_ = ""; // as FFmpeg calls it
    std::unique_ptr<AVFormatContext, CloseInput> input_;
    int stream_ = -1;
    PictureDecoder decoder_;
    Packet packet_ = makePacket();
    VideoInfo info_;
    int quarterTurns_ = 0; // clockwise, to be upright
    ImageRgb8 unturned_;   // scratch, where there are some
    int64_t position_ = 0;
    double rate_ = 0;      // frames a second as the container says, however absurd
    int64_t begins_ = 0;   // time stamp of frame 0, once that was decoded
    bool begun_ = false;   // it was
    bool held_ = false;    // the next frame is decoded already
    bool drained_ = false; // the decoder knows that the file is over
    bool seekable_ = true; // until a seek went wrong
};

} // namespace shoal::media
