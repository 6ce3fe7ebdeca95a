#include "engine/media/PanoramaPlacement.h"

#include "engine/media/JpegSegments.h"
#include "engine/media/RdfText.h"

#include <fstream>
#include <vector>

namespace shoal::media {

static std::optional<PanoramaPlacement> placementIn(std::string_view xmp) {
    if (rdfValue(xmp, "GPano:ProjectionType") != "equirectangular") return std::nullopt;
    constexpr double kMaxPixels = 1 << 20;
    const auto pixels = [&](const char* name) {
        const double value = rdfNumber(xmp, name).value_or(-1);
        return value >= 0 && value <= kMaxPixels ? static_cast<int>(value) : -1;
    };
    PanoramaPlacement p;
    p.fullWidth = pixels("GPano:FullPanoWidthPixels");
    p.fullHeight = pixels("GPano:FullPanoHeightPixels");
    p.left = pixels("GPano:CroppedAreaLeftPixels");
    p.top = pixels("GPano:CroppedAreaTopPixels");
    p.width = pixels("GPano:CroppedAreaImageWidthPixels");
    p.height = pixels("GPano:CroppedAreaImageHeightPixels");
    p.heading_deg = rdfNumber(xmp, "GPano:PoseHeadingDegrees").value_or(0);
    if (p.left < 0 || p.top < 0 || p.width < 1 || p.height < 1) return std::nullopt;
    if (p.left + p.width > p.fullWidth || p.top + p.height > p.fullHeight) return std::nullopt;
    return p;
}

std::optional<PanoramaPlacement> panoramaPlacement(const Path& file) {
    std::error_code code;
    if (!std::filesystem::is_regular_file(file, code)) return std::nullopt;
    std::vector<uint8_t> head(1 << 20); // the XMP segment is among the first
    std::ifstream stream(file, std::ios::binary);
    stream.read(reinterpret_cast<char*>(head.data()), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<size_t>(stream.gcount()));
    if (!hasText(head, 0, "\xff\xd8\xff")) return std::nullopt;

    std::optional<PanoramaPlacement> found;
    walkJpeg(head, [&](uint8_t marker, ByteSpan payload) {
        constexpr std::string_view kXmp{"http://ns.adobe.com/xap/1.0/\0", 29};
        if (marker == 0xe1 && hasText(payload, 0, kXmp))
            found = placementIn(asText(payload.subspan(kXmp.size())));
        return found.has_value();
    });
    return found;
}

} // namespace shoal::media
