// OpenEXR's own library reads and writes, on the calling thread. Internal to this folder; errors lack a path.
#pragma once

#include "engine/media/PictureHeader.h"

namespace shoal::media {

// Reads a layer of flat channels R, G and B, of luminance and chroma Y, RY and BY, or of Y alone, black
// outside of its data window. Its size is that of the display window. layer: see readHdr(). Does not
// convert the primaries. Takes memory only once the windows are within the limits.
Result<HdrPicture> decodeExr(const Path& file, ByteSpan bytes, const std::string& layer,
                             PictureLimits limits);

// Encodes as 32-bit floats, ZIP-compressed.
Result<std::string> encodeExr(const ImageRgbF& image);

// Converts colours to Rec. 709 primaries; white stays white (Bradford's adaptation), and components that
// become negative are 0. False, without a change, if these primaries span no colours.
bool toRec709(ImageRgbF& image, const Primaries& from);

} // namespace shoal::media
