// From coded pictures to pictures, each as soon as it can be had. Internal to this folder; one thread's.
#pragma once

#include "engine/core/Image.h"
#include "engine/core/Result.h"
#include "engine/media/live/Packet.h"

struct SwsContext;

namespace shoal::media {

class StreamDecoder {
  public:
    StreamDecoder();
    ~StreamDecoder();
    StreamDecoder(const StreamDecoder&) = delete;
    StreamDecoder& operator=(const StreamDecoder&) = delete;

    Status open(const AVCodecParameters& parameters, AVRational timeBase);

    // A packet; null: no more will come. What cannot be decoded is passed over. hurry: so are pictures that
    // no other needs.
    void send(const AVPacket* packet, double arrived_s, bool hurry);
    void forget(); // what it began with: packets have been left out

    // The next picture that is complete, if there is one.
    bool receive();
    double arrived_s() const; // its packet

    // The picture received last, blue first; takes its size. Error: it is too large, or of an unknown form.
    Status convert(ImageRgb8& bgr);

  private:
    Codec codec_;
    Frame frame_;
    SwsContext* scaler_ = nullptr;
};

} // namespace shoal::media
