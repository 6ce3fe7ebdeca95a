#include "engine/media/SphericalMetadata.h"

#include "engine/core/Number.h"
#include "engine/math/Trigonometry.h"
#include "engine/media/Decoder.h"
#include "engine/media/PictureHeader.h"

#include <fmt/core.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <vector>

namespace shoal::media {

std::string_view xmpValue(std::string_view xmp, const std::string& name) {
    const size_t at = xmp.find(name);
    const size_t begin = at == xmp.npos ? at : xmp.find_first_not_of(" \t\r\n=>\"'", at + name.size());
    return begin == xmp.npos ? "" : xmp.substr(begin, xmp.find_first_of(" \t\r\n<\"'", begin) - begin);
}

std::optional<PanoramaPlacement> placementIn(std::string_view xmp, const std::string& space) {
    constexpr int kMaxPixels = 1 << 20;
    const auto pixels = [&](const char* name) {
        return parseNumber(xmpValue(xmp, space + name), 0, kMaxPixels).value_or(-1);
    };
    const PanoramaPlacement p{.fullWidth = pixels("FullPanoWidthPixels"),
                              .fullHeight = pixels("FullPanoHeightPixels"),
                              .left = pixels("CroppedAreaLeftPixels"),
                              .top = pixels("CroppedAreaTopPixels"),
                              .width = pixels("CroppedAreaImageWidthPixels"),
                              .height = pixels("CroppedAreaImageHeightPixels")};
    if (p.left < 0 || p.top < 0 || p.width < 1 || p.height < 1) return std::nullopt;
    if (p.left + p.width > p.fullWidth || p.top + p.height > p.fullHeight) return std::nullopt;
    return p;
}

// Returns the beginning of an MP4 file's movie box, or of a Matroska file; empty if there is none.
static std::vector<uint8_t> headerOf(const Path& file, bool matroska) {
    std::ifstream stream(file, std::ios::binary);
    std::array<uint8_t, 16> head{}; // size, name, and the large size if size is 1
    constexpr uint64_t kMost = 1 << 20;
    uint64_t size = kMost;
    for (uint64_t at = 0; !matroska && !hasText(head, 4, "moov"); at += size) {
        stream.seekg(static_cast<std::streamoff>(at));
        if (!stream.read(reinterpret_cast<char*>(head.data()), head.size())) return {};
        size = big32(head, 0) == 1 ? big64(head, 8) : big32(head, 0);
        if (size == 0) size = INT64_MAX - at; // up to the file's end
        if (size < 8 || size > INT64_MAX - at) return {};
    }
    std::vector<uint8_t> header(std::clamp<uint64_t>(size, head.size(), kMost) - head.size());
    stream.read(reinterpret_cast<char*>(header.data()), static_cast<std::streamsize>(header.size()));
    return header;
}

// Returns V2's rotation of the sphere: counter-clockwise about up, then counter-clockwise about right, then
// clockwise about ahead, each about the axes that the rotations before it have turned. Degrees.
static glm::quat turned(float yaw, float pitch, float roll) {
    return math::rotationAbout({0, 1, 0}, glm::radians(yaw)) *
           math::rotationAbout({1, 0, 0}, glm::radians(pitch)) *
           math::rotationAbout({0, 0, -1}, glm::radians(roll));
}

// Returns the box of V2, from its name on; empty if there is none. Its name alone may stand in any text.
static ByteSpan boxOfSecondVersion(ByteSpan header) {
    const std::string_view text = asText(header);
    for (size_t at = text.find("sv3d"); at != text.npos; at = text.find("sv3d", at + 1))
        if (at >= 4 && (hasText(header, at + 8, "svhd") || hasText(header, at + 8, "proj")))
            return header.subspan(at, std::min<size_t>(big32(header, at - 4), header.size() - at));
    return {};
}

// Reads V2's box, which libavformat drops if its header box is missing. Sets m.projection; empty: no bounds.
static std::optional<AVSphericalMapping> unreadMapping(ByteSpan box, SphericalMetadata& m) {
    const std::string_view text = asText(box);
    const auto has = [&](std::string_view name) { return text.find(name) != text.npos; };
    m.projection = has("mshp") ? Projection::Mesh : has("cbmp") ? Projection::Cubemap : Projection::Unknown;
    const auto field = [&](std::string_view sizeAndName, size_t index) { // behind version and flags
        const size_t at = text.find(sizeAndName) + 12 + 4 * index;
        return has(sizeAndName) && at + 4 <= box.size() ? big32(box, at) : 0;
    };
    constexpr std::string_view kBounds{"\0\0\0\34equi", 8}, kPose{"\0\0\0\30prhd", 8};
    if (!has(kBounds)) return std::nullopt;
    AVSphericalMapping s{};
    s.projection = AV_SPHERICAL_EQUIRECTANGULAR_TILE;
    s.yaw = static_cast<int32_t>(field(kPose, 0));
    s.pitch = static_cast<int32_t>(field(kPose, 1));
    s.roll = static_cast<int32_t>(field(kPose, 2));
    s.bound_top = field(kBounds, 0), s.bound_bottom = field(kBounds, 1);
    s.bound_left = field(kBounds, 2), s.bound_right = field(kBounds, 3);
    return s;
}

// Reads V2's metadata.
static void readMapping(const AVSphericalMapping& s, SphericalMetadata& m) {
    const char* named = av_spherical_projection_name(s.projection);
    const std::string_view name = named ? named : "";
    const bool half = name == "half equirectangular",
               tile = s.projection == AV_SPHERICAL_EQUIRECTANGULAR_TILE;
    m.projection = half || tile || s.projection == AV_SPHERICAL_EQUIRECTANGULAR ? Projection::Equirect
                   : s.projection == AV_SPHERICAL_CUBEMAP                       ? Projection::Cubemap
                   : name == "rectilinear"                                      ? Projection::Unknown
                                                                                : Projection::Other;
    const auto share = [](uint32_t bound) { return bound / 4294967296.0; }; // 0.32 bits
    if (half) m.bounds = {.left = 0.25, .right = 0.25};
    if (tile)
        m.bounds = {share(s.bound_left), share(s.bound_top), share(s.bound_right), share(s.bound_bottom)};
    const auto degrees = [](int32_t fixed) { return static_cast<float>(fixed) / 65536; }; // 16.16 bits
    m.envFromFilm = turned(degrees(s.yaw), degrees(s.pitch), degrees(s.roll));
}

// Reads V1's metadata. They state where the viewer looks at first, so the sphere turns the other way.
static void readFirstVersion(std::string_view xmp, SphericalMetadata& m) {
    const std::string space = "GSpherical:";
    const auto degrees = [&](const char* name) {
        return parseNumber(xmpValue(xmp, space + name), -360.0f, 360.0f).value_or(0);
    };
    m.projection = Projection::Equirect;
    m.layout = enumNamed<Layout>(xmpValue(xmp, space + "StereoMode")).value_or(Layout::Auto);
    m.envFromFilm =
        glm::conjugate(turned(-degrees("InitialViewHeadingDegrees"), degrees("InitialViewPitchDegrees"),
                              degrees("InitialViewRollDegrees")));
    if (const auto p = placementIn(xmp, space)) {
        const double across = p->fullWidth, down = p->fullHeight;
        m.bounds = {p->left / across, p->top / down, (p->fullWidth - p->left - p->width) / across,
                    (p->fullHeight - p->top - p->height) / down};
    }
}

static Layout statedLayout(const AVStereo3D& s) {
    const bool rightFirst = s.flags & AV_STEREO3D_FLAG_INVERT;
    if (s.type == AV_STEREO3D_2D) return Layout::Mono;
    if (s.type == AV_STEREO3D_SIDEBYSIDE) return rightFirst ? Layout::RightLeft : Layout::LeftRight;
    if (s.type == AV_STEREO3D_TOPBOTTOM) return rightFirst ? Layout::BottomTop : Layout::TopBottom;
    return Layout::Auto;
}

// Returns the orientation nearest to a display matrix: rows a b u, c d v, x y w, where a stored point (p, q)
// is shown at (a p + c q + x, b p + d q + y), both downwards (ISO/IEC 14496-12, 8.3.2).
static int orientationOf(std::span<const int32_t, 9> matrix) {
    const int64_t a = matrix[0], b = matrix[1], c = matrix[3], d = matrix[4];
    const bool across = std::abs(b) + std::abs(c) > std::abs(a) + std::abs(d);
    const bool leftRight = (across ? c : a) < 0, upsideDown = (across ? b : d) < 0;
    return (across ? 5 : 1) + (leftRight ? (upsideDown ? 2 : 1) : upsideDown ? 3 : 0);
}

SphericalMetadata sphericalMetadata(const AVFormatContext& input, const AVStream& stream, const Path& file) {
    constexpr std::string_view kMatroskaMesh = "\x76\x71\x81\x03";           // ProjectionType, of one byte: 3
    constexpr std::string_view kRightLeft{"\0\0\0\x0dst3d\0\0\0\0\x04", 13}; // unknown to libavformat
    const bool matroska = std::string_view(input.iformat->name).starts_with("matroska");
    SphericalMetadata m;
    if (stream.codecpar->codec_type != AVMEDIA_TYPE_VIDEO) return m;
    if (const auto* matrix = sideData<int32_t>(stream, AV_PKT_DATA_DISPLAYMATRIX, 9))
        m.orientation = orientationOf(std::span<const int32_t, 9>(matrix, 9));
    const std::vector<uint8_t> header = headerOf(file, matroska);
    const ByteSpan box = matroska ? ByteSpan() : boxOfSecondVersion(header);
    const auto holds = [&](std::string_view text) { return asText(header).find(text) != text.npos; };
    if (const auto* s = sideData<AVSphericalMapping>(stream, AV_PKT_DATA_SPHERICAL))
        readMapping(*s, m);
    else if (matroska && holds(kMatroskaMesh))
        m.projection = Projection::Mesh;
    else if (const auto unread = unreadMapping(box, m))
        readMapping(*unread, m);
    const auto* tag = matroska ? av_dict_get(stream.metadata, "spherical-video", nullptr, 0) : nullptr;
    const std::string_view xmp = tag ? tag->value : asText(header);
    const bool second = matroska ? m.projection != Projection::Unknown : !box.empty();
    if (!second && xmpValue(xmp, "GSpherical:Spherical") == "true") readFirstVersion(xmp, m);
    if (matroska && m.projection == Projection::Unknown)
        return m; // a flat video: its StereoMode does not describe a panorama
    if (const auto* s = sideData<AVStereo3D>(stream, AV_PKT_DATA_STEREO3D))
        m.layout = statedLayout(*s);
    else if (!matroska && holds(kRightLeft))
        m.layout = Layout::RightLeft;
    constexpr double kLeast = 1 / 8.0; // of each side: a small file may not ask for gigabytes
    m.boundsIgnored = !(m.bounds.width() >= kLeast && m.bounds.height() >= kLeast);
    if (m.boundsIgnored) m.bounds = {};
    return m;
}

SphericalMetadata sphericalMetadata(const Path& file) {
    setUpDecoders();
    FileDecoder film;
    return film.openFilm(file) ? sphericalMetadata(*film.input, film.opened(), file) : SphericalMetadata{};
}

glm::quat filmFromWorld(const glm::quat& envFromFilm, float yaw) {
    // Positive angles about +Y turn to the left: a direction yaw to the right comes ahead.
    return glm::conjugate(envFromFilm) * math::rotationAbout({0, 1, 0}, yaw);
}

std::string SphericalMetadata::note() const {
    std::string text = uprightNote(orientation);
    if (boundsIgnored) text += "; its bounds make no sense, or too large a picture, and are ignored";
    if (!bounds.isWhole())
        text += fmt::format("; covers {:.0f} x {:.0f} of 360 x 180 degrees, and the rest mirrors it",
                            360 * bounds.width(), 180 * bounds.height());
    if (const float turn = glm::angle(envFromFilm); turn > 0)
        text += fmt::format("; turned by {:.4g} degrees as it states", glm::degrees(turn));
    return text;
}

template <class Picture> static cv::Mat viewOf(const Picture& picture, const EyePart& part) {
    using Value = typename decltype(picture.pixels)::value_type;
    const void* pixels = picture.pixels.data();
    const cv::Mat whole(picture.height, picture.width, CV_MAKETYPE(cv::DataType<Value>::depth, 3),
                        const_cast<void*>(pixels));
    return whole({part.x, part.y, part.width, part.height});
}

template <class Picture> void makeUpright(const Picture& stored, int orientation, Picture& upright) {
    const bool across = swapsSides(orientation);
    upright.fit(across ? stored.height : stored.width, across ? stored.width : stored.height);
    if (stored.empty()) return;
    const cv::Mat from = viewOf(stored, {0, 0, stored.width, stored.height});
    cv::Mat to = viewOf(upright, {0, 0, upright.width, upright.height});
    across ? cv::transpose(from, to) : from.copyTo(to);
    constexpr int kFlips[] = {1, -1, 0}; // after the transposition: left and right, both, upside down
    if (const int step = (orientation - 1) % 4; step > 0) cv::flip(to, to, kFlips[step - 1]);
}

std::string uprightNote(int orientation) {
    return orientation == 1 ? "" : fmt::format("; turned upright from its orientation {}", orientation);
}

template <class Picture>
void placeInSphere(const Picture& upright, Layout layout, const SphereBounds& bounds, Picture& whole) {
    const auto part = [](int of, double share) { return static_cast<int>(std::lround(of * share)); };
    for (const int eye : {0, 1}) {
        cv::Mat from = viewOf(upright, eyePart(layout, eye, upright.width, upright.height));
        cv::Mat to = viewOf(whole, eyePart(layout, eye, whole.width, whole.height));
        if (from.empty() || to.empty()) continue; // half of a single row
        const cv::Size size(std::max(part(to.cols, bounds.width()), 1),
                            std::max(part(to.rows, bounds.height()), 1));
        if (from.size() != size) cv::resize(from, from, size, 0, 0, cv::INTER_AREA);
        const int left = std::min(part(to.cols, bounds.left), to.cols - size.width);
        const int top = std::min(part(to.rows, bounds.top), to.rows - size.height);
        cv::copyMakeBorder(from, to, top, to.rows - top - size.height, left, to.cols - left - size.width,
                           cv::BORDER_REFLECT | cv::BORDER_ISOLATED);
    }
}

template void makeUpright(const ImageRgb8&, int, ImageRgb8&);
template void makeUpright(const ImageRgbF&, int, ImageRgbF&);
template void placeInSphere(const ImageRgb8&, Layout, const SphereBounds&, ImageRgb8&);
template void placeInSphere(const ImageRgbF&, Layout, const SphereBounds&, ImageRgbF&);

} // namespace shoal::media
