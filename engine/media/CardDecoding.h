// Decoding of films by a graphics card, through FFmpeg: VAAPI and CUDA. Internal to this folder.
#pragma once

#include "engine/media/Ffmpeg.h"

namespace shoal::media {

// Returns an opened decoder whose pictures are on a card; null if there is none for this stream.
Codec openOnCard(const AVStream& stream, int64_t maxPixels);

// Pictures brought back from a card. Keeps its memory between them.
class CardPictures {
  public:
    // Replaces a picture on the card by a copy in planes, as decoders in software give it. False: it cannot.
    bool bringBack(AVFrame& picture);
    // Makes `picture` a copy in planes of NV12 or P010, which have both colour differences in one plane.
    bool copyInPlanes(const AVFrame& codes, AVFrame& picture);

  private:
    Frame codes_ = makeFrame(), copy_ = makeFrame();
    std::unique_ptr<AVBufferPool, FreeAt<av_buffer_pool_uninit>> pool_; // of pictures of pictureBytes_
    int pictureBytes_ = 0;
};

} // namespace shoal::media
