// A FrameConverter converts decoded frames to the picture that is shown and, if they are of high dynamic
// range, to linear light. Internal to this folder.
#pragma once

#include "engine/core/ThreadPool.h"
#include "engine/media/Ffmpeg.h"
#include "engine/media/VideoFrame.h"

#include <array>
#include <memory>
#include <vector>

namespace shoal::media {

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
// Primaries of SDR: BT.2020 and P3 if stated; all others are close to BT.709 and are taken for it. Range: as
// FFmpeg takes it; full for its formats of JPEG, and for grey without a stated range.
FrameColour colourOf(AVCodecID codec, const StatedColour& stated, int width, int height);

// Returns BT.601 for Motion JPEG of any size (JFIF), else the matrix that is stated. Without a known code
// (unspecified, or RGB) the size decides, as in other players: BT.709 from 1280 wide or above 576 high.
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

} // namespace shoal::media
