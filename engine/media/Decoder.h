// Decoders of pictures and sound, through FFmpeg, and the conversion of decoded frames to the picture that is
// shown and, if they are of high dynamic range, to linear light. Internal to this folder; each belongs to one
// thread.
#pragma once

#include "engine/core/Image.h"
#include "engine/core/Result.h"
#include "engine/core/ThreadPool.h"
#include "engine/media/Ffmpeg.h"
#include "engine/media/VideoFrame.h"

extern "C" {
#include <libavutil/pixdesc.h>
}

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

namespace shoal::media {

// --- Conversion

// Codes of ISO/IEC 23091-2 (ITU-T H.273) that a stream or a frame states.
struct StatedColour {
    AVColorSpace matrix = AVCOL_SPC_UNSPECIFIED;
    AVColorPrimaries primaries = AVCOL_PRI_UNSPECIFIED;
    AVColorTransferCharacteristic transfer = AVCOL_TRC_UNSPECIFIED;
    AVColorRange range = AVCOL_RANGE_UNSPECIFIED;
    AVPixelFormat format = AV_PIX_FMT_NONE;
};

struct FrameColour {
    ColourMatrix matrix = ColourMatrix::Bt709;
    AVColorPrimaries primaries = AVCOL_PRI_BT709;
    Transfer transfer = Transfer::Sdr;
    bool fullRange = false;
    Status decodable = Done{}; // fails for luma that is no sum of codes: constant luminance, ICtCp
};

// Returns how frames of this size are decoded. PQ and HLG are of BT.2020 unless other colours are stated.
// Primaries of SDR: BT.2020 and P3 if stated; all others are taken for BT.709, which they are near. Range: as
// FFmpeg takes it, full for its formats of JPEG, and for grey without a statement.
FrameColour colourOf(AVCodecID codec, const StatedColour& stated, int width, int height);

// Returns BT.601 for Motion JPEG of any size (JFIF), else the matrix that is stated. Without a known code
// (unspecified, or RGB) it follows from the size, as in other players: BT.709 from 1280 wide or above 576
// high.
ColourMatrix matrixOf(AVCodecID codec, AVColorSpace stated, int width, int height);

// Weights of red and blue in luma; green's is 1 minus both.
struct Luma {
    double red, blue;
};
Luma lumaOf(ColourMatrix matrix);

// Returns the light of a PQ code, 0 to 1, in units of reference white (SMPTE ST 2084; white: BT.2408).
double lightFromPq(double code);

// Returns the light of the scene, 0 to 1, for an HLG code, 0 to 1 (the inverse OETF of BT.2100).
double sceneFromHlg(double code);

// Returns the light that a display of 1000 cd/m^2 shows for a scene's light (the OOTF of BT.2100), per unit
// of the scene's; in units of reference white. luminance: the scene's, 0 to 1.
double hlgGain(double luminance);

// Converts frames of all pixel formats of whole numbers. Keeps its threads and rows between frames.
class FrameConverter {
  public:
    // bgr takes the frame's size; blue first, sRGB-coded. radianceLin: null, or takes the light of a PQ or
    // HLG frame, reduced to at most kMaxLightSide a side by means over areas; else it becomes empty. Negative
    // light of colours outside of Rec. 709 becomes 0. Fails if the pixel format is unknown.
    //
    // Colours brighter than white are shown divided by their largest channel: hue and saturation stay.
    Status convert(const AVFrame& frame, const FrameColour& colour, ImageRgb8& bgr, ImageRgbF* radianceLin);

    // Makes `out` own the frame and hold its planes, if it has three of YCbCr.
    void share(const AVFrame& frame, const FrameColour& colour, VideoFrame& out);

  private:
    using Row = std::vector<float>;
    struct Rows {
        std::vector<uint16_t> codes;
        std::array<Row, 3> channels; // red, green, blue; at first codes
    };
    Status begin(const AVFrame& frame, const FrameColour& colour);
    void makeMatrix(const FrameColour& colour);
    void readRow(int component, int y, Rows& rows) const;
    void convertRow(int y, Rows& rows, uint8_t* bgr) const;
    void convertBand(int band, ImageRgb8& bgr);

    std::unique_ptr<ThreadPool> pool_;
    std::vector<Rows> rows_; // by band
    // The frame being converted:
    const AVFrame* frame_ = nullptr;
    const AVPixFmtDescriptor* format_ = nullptr;
    bool isRgb_ = false, isPalette_ = false, isGrey_ = false;
    Planes planes_; // without codes unless it has three planes of YCbCr
    ImageRgbF* radianceLin_ = nullptr;
};

// Converts a picture in planes (luma, blue and red difference), which are `strides` bytes a row, to the size
// that bgr has. Each difference stands for two pixels of a row, the last one of an odd width for one, and for
// rowsPerDifference rows, 1 or 2. fullRange: luma 0 to 255, differences span 255; else 16 to 235 and 224
// (BT.601 and 709). Values are within 0.6 of the formula's, clamped to 0 .. 255.
void toBgr(const std::array<const uint8_t*, 3>& planes, const std::array<int, 3>& strides,
           int rowsPerDifference, ColourMatrix matrix, bool fullRange, ImageRgb8& bgr);

// --- Decoding

constexpr int64_t kMaxVideoPixels = int64_t{kMaxVideoSide} * kMaxVideoSide;

// Fails if pictures of that size are not played.
Status checkPictureSize(int width, int height);

// Pictures brought back from a graphics card, which decodes films by VAAPI or CUDA. Keeps its memory between
// them.
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

// ByThreads: each thread decodes its own picture, which is faster but delays pictures by one for each thread.
enum class FrameThreading { None, ByThreads };

// Decoder of packets to frames: pictures, or blocks of sound.
class Decoder {
  public:
    // Fails if no such codec is installed or it does not start. threads: at least 1. maxPixels: larger
    // pictures are skipped like damaged ones. onCard: by a graphics card, if there is one that can.
    Status open(const AVStream& stream, FrameThreading threading, int threads,
                int64_t maxPixels = kMaxVideoPixels, bool onCard = false);
    // Returns whether a graphics card failed: no more frames come.
    bool cardFailed() const { return cardFailed_; }

    // Sends a packet; null drains the decoder. Skips damaged packets; hurry: non-reference pictures too.
    void send(const AVPacket* packet, bool hurry = false);
    void flush() { avcodec_flush_buffers(codec_.get()); } // after a seek, or after packets were left out

    // Receives the next complete frame; false if there is none.
    bool receive();
    // The frame received last.
    AVFrame& frame() { return *frame_; }
    void exchange(Frame& other) { frame_.swap(other); } // receives into `other` from now on
    glm::ivec2 chromaTexels() const; // texels of a picture that share a colour, across and down
    FrameColour colour(const AVFrame& received) const; // as it states, else its stream

    // Converts the picture received last, blue first, by the colours and range that it states, or else its
    // stream; bgr takes its size. radianceLin: null, or takes the light of PQ or HLG; empty for other
    // pictures. Fails if it is too large, or of an unknown pixel format.
    Status convert(ImageRgb8& bgr, ImageRgbF* radianceLin = nullptr);
    void share(VideoFrame& out) { converter_.share(*frame_, colour(*frame_), out); }

  private:
    Codec codec_;
    CardPictures card_;
    bool isOnCard_ = false, cardFailed_ = false;
    Frame frame_ = makeFrame();
    StatedColour stated_; // by the stream
    FrameConverter converter_;
};

// Decoder of one stream of a file.
struct FileDecoder {
    Input input;
    int stream = -1;
    Decoder decoder;
    Packet packet = makePacket();
    bool drained = false; // whether the end of the file was sent to the decoder
    bool hurries = false; // whether next() leaves out pictures that no others refer to

    const AVStream& opened() const { return *input->streams[stream]; }
    // Returns the length that the file states; 0 if it does not.
    double length_s() const {
        return static_cast<double>(std::max<int64_t>(input->duration, 0)) / AV_TIME_BASE;
    }
    // Opens a file's film, without its decoder. The error has no path.
    Status openFilm(const Path& file);
    // Decodes the next frame. Returns false at the end, or after so many packets of the stream without one.
    bool next(int maxPackets);
    // Seeks to a key frame at or before this time stamp. Returns false if the file cannot be read there.
    bool seek(int64_t stamp, int flags = AVSEEK_FLAG_BACKWARD);
};

} // namespace shoal::media
