#include "engine/media/Pictures.h"

#include "engine/core/Log.h"
#include "engine/core/WriteFile.h"
#include "engine/media/Codecs.h"
#include "engine/media/Decoder.h"
#include "engine/media/OpenExr.h"
#include "engine/media/PictureHeader.h"

#include <fmt/ranges.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <utility>

// Compresses by zlib: faster and smaller than by the header's own code. The header frees the result.
static unsigned char* compressed(unsigned char* bytes, int count, int* compressedCount, int) {
    uLongf size = compressBound(static_cast<uLong>(count));
    auto* out = static_cast<unsigned char*>(std::malloc(size));
    if (out && compress2(out, &size, bytes, static_cast<uLong>(count), Z_BEST_SPEED) != Z_OK)
        std::free(std::exchange(out, nullptr));
    *compressedCount = static_cast<int>(size);
    return out;
}
#define STBIW_ZLIB_COMPRESS compressed
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb_image_write.h>

namespace shoal::media {

namespace {

constexpr uint64_t kMaxFileBytes = 512u << 20;
constexpr uint64_t kMaxHdrFileBytes = 2048ull << 20; // 16384 x 8192 floats are 1.5 GiB

using PictureFile = std::pair<std::vector<uint8_t>, PictureHeader>;

// Reads a file of the wanted kind whose stated size is within the limits.
Result<PictureFile> readPictureFile(const Path& file, bool hdr, PictureLimits limits) {
    auto bytes = readFile(file, hdr ? kMaxHdrFileBytes : kMaxFileBytes);
    if (!bytes) return bytes.error();
    const auto header = readPictureHeader(*bytes);
    if (!header) return Error{file.string(), header.error().reason};
    if (isHdr(header->kind) != hdr)
        return Error{file.string(),
                     hdr ? fmt::format("is a {}, which has no high dynamic range; give it as --photo",
                                       nameOf(header->kind))
                         : "is a high dynamic range picture; give it as --env"};
    if (header->kind == PictureKind::Avif) // the decoder of films reads it
        limits = {std::min(limits.maxWidth, kMaxVideoSide), std::min(limits.maxHeight, kMaxVideoSide)};
    if (std::string refusal = beyond(header->size, limits); !refusal.empty())
        return Error{file.string(), std::move(refusal)};
    return PictureFile{std::move(*bytes), *header};
}

// Returns a view of the image's own memory.
template <class T, int kChannels> cv::Mat viewOf(const Image<T, kChannels>& image) {
    return {image.height, image.width, CV_MAKETYPE(cv::DataType<T>::depth, kChannels),
            const_cast<T*>(image.pixels.data())};
}

// --- High dynamic range pictures that no library reads as needed. The errors have no path.

// Reads lines of RGBE pixels; its functions return false when the bytes end or make no sense.
struct LineReader {
    ByteSpan bytes;
    size_t at;

    bool has(size_t count) const { return bytes.size() - at >= count; }

    // Reads the four components one after another: a count above 128 repeats the next byte count - 128 times,
    // a count up to 128 is followed by that many bytes.
    bool coded(std::span<uint8_t> line, size_t width) {
        at += 4;
        for (size_t component = 0; component < 4; ++component)
            for (size_t x = 0; x < width;) {
                if (!has(2)) return false;
                const size_t code = bytes[at++];
                const bool repeat = code > 128;
                const size_t count = repeat ? code - 128 : code;
                if (count == 0 || count > width - x || !has(repeat ? 1 : count)) return false;
                for (size_t i = 0; i < count; ++i, ++x) line[4 * x + component] = bytes[repeat ? at : at + i];
                at += repeat ? 1 : count;
            }
        return true;
    }

    // Reads whole pixels. Mantissas 1 1 1 mark a repeat count; counts in a row are one number in base 256.
    bool flat(std::span<uint8_t> line, size_t width) {
        int shift = 0;
        for (size_t x = 0; x < width;) {
            if (!has(4)) return false;
            const ByteSpan pixel = bytes.subspan(at, 4);
            at += 4;
            if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
                if (x == 0 || shift > 16) return false;
                const size_t count = size_t{pixel[3]} << shift;
                if (count > width - x) return false;
                for (size_t i = 0; i < count; ++i, ++x) std::memcpy(&line[4 * x], &line[4 * (x - 1)], 4);
                shift += 8;
            } else {
                std::memcpy(&line[4 * x++], pixel.data(), 4);
                shift = 0;
            }
        }
        return true;
    }

    bool next(std::span<uint8_t> line, size_t width) {
        const bool isCoded = width >= 8 && width < 32768 && has(4) && bytes[at] == 2 && bytes[at + 1] == 2 &&
                             big16(bytes, at + 2) == width;
        return isCoded ? coded(line, width) : flat(line, width);
    }
};

// Radiance: RGBE pixels, flat or run-length coded. bytes: the whole file, whose header can be read. Ward,
// "Real Pixels", Graphics Gems II, 1991: component = mantissa * 2^(e - 136), black where e is 0. Neither
// OpenCV 4.6 nor stb_image reads Ward's first run-length code; stb_image takes missing pixels for black.
Result<HdrPicture> decodeRadiance(ByteSpan bytes) {
    const RadianceHeader header = readRadianceHeader(bytes);
    const int length = static_cast<int>(header.size.width), lines = static_cast<int>(header.size.height);
    const auto exposure = std::span(header.exposure);
    const bool isUniform = exposure[1] == exposure[0] && exposure[2] == exposure[0];
    const std::string stated = fmt::format("{:.4g}", fmt::join(exposure.first(isUniform ? 1 : 3), ", "));
    if (!std::ranges::all_of(exposure, [](float each) { return each > 0 && std::isfinite(each); }))
        return Error{"",
                     fmt::format("states an exposure of {}, which its light cannot be divided by", stated)};
    if (header.gamma != 1)
        return Error{"",
                     fmt::format("states a GAMMA of {:.4g}; only linear light (1) is read", header.gamma)};
    // Checked before memory is allocated: even the shortest line takes a pixel.
    if ((bytes.size() - header.pixels) / 4 < static_cast<size_t>(lines)) return Error{"", "is cut short"};

    std::array<float, 256> factor{};
    for (size_t e = 1; e < 256; ++e) factor[e] = std::ldexp(1.0f, static_cast<int>(e) - 136);
    HdrPicture picture{.radianceLin = ImageRgbF(length, lines), .primaries = header.primaries};
    std::vector<uint8_t> line(4 * static_cast<size_t>(length));
    LineReader reader{bytes, header.pixels};
    for (int i = 0; i < lines; ++i) {
        if (!reader.next(line, static_cast<size_t>(length)))
            return Error{"", fmt::format("is damaged or cut short at line {}", i)};
        for (int k = 0; k < length; ++k) {
            const uint8_t* pixel = &line[4 * static_cast<size_t>(k)];
            for (size_t c = 0; c < 3; ++c)
                picture.radianceLin.at(k, i)[c] =
                    static_cast<float>(pixel[c]) * factor[pixel[3]] / exposure[c];
        }
    }
    if (header.orientation != 1) {
        const ImageRgbF stored = std::exchange(picture.radianceLin, {}); // a move would leave the old size
        makeUpright(stored, header.orientation, picture.radianceLin);
    }
    if (!isUniform || exposure[0] != 1) picture.notes.push_back("divided by its exposure " + stated);
    if (!header.squarePixels) picture.notes.emplace_back("its pixels count as square");
    return picture;
}

// Bottom row first. OpenCV 4.6 divides by the scale.
Result<HdrPicture> decodePfm(ByteSpan bytes) {
    const PfmHeader header = readPfmHeader(bytes);
    const int width = static_cast<int>(header.size.width), height = static_cast<int>(header.size.height);
    size_t at = header.pixels;
    const size_t needed =
        size_t{4} * static_cast<size_t>(width) * static_cast<size_t>(height) * header.channels;
    if (at > bytes.size() || bytes.size() - at < needed) return Error{"", "is cut short"};

    HdrPicture picture{ImageRgbF(width, height)};
    const float factor = std::abs(header.scale);
    for (int y = height - 1; y >= 0; --y)
        for (int x = 0; x < width; ++x, at += 4 * header.channels)
            for (size_t c = 0; c < 3; ++c) {
                const size_t component = at + (header.channels > 1 ? 4 * c : 0);
                const uint32_t bits = header.scale < 0 ? little32(bytes, component) : big32(bytes, component);
                picture.radianceLin.at(x, y)[c] = std::bit_cast<float>(bits) * factor;
            }
    return picture;
}

// --- Encoders of high dynamic range pictures. OpenCV codes these kinds into a file in the system's temporary
// folder, and does not notice when that is full.

static_assert(std::endian::native == std::endian::little, "a negative scale marks little-endian values");

// Appends to a string, for stb_image_write.
void append(void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<size_t>(size));
}

// Encodes as Radiance RGBE, run-length coded.
std::string encodeRadiance(const ImageRgbF& image) {
    assert(!image.empty());
    std::string bytes;
    stbi_write_hdr_to_func(append, &bytes, image.width, image.height, 3, image.pixels.data());
    return bytes;
}

std::string encodePfm(const ImageRgbF& image) {
    assert(!image.empty());
    std::string bytes =
        "PF\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n-1.0\n";
    const size_t row = static_cast<size_t>(image.width) * 3 * sizeof(float);
    for (int y = image.height - 1; y >= 0; --y) // the bottom row comes first
        bytes.append(reinterpret_cast<const char*>(image.at(0, y)), row);
    return bytes;
}

// Replaces values that are no light: readHdr().
void repair(HdrPicture& picture) {
    float largest = 0;
    int64_t repaired = 0, clamped = 0;
    for (const float value : picture.radianceLin.pixels)
        if (std::isfinite(value)) largest = std::max(largest, std::min(value, kMaxRadiance));
    for (float& value : picture.radianceLin.pixels) {
        if (value >= 0 && value <= kMaxRadiance) continue; // false for NaN
        const bool light = value > kMaxRadiance && std::isfinite(value);
        ++(light ? clamped : repaired);
        value = light ? kMaxRadiance : value > 0 ? largest : 0;
    }
    if (repaired > 0)
        picture.notes.push_back(
            fmt::format("{} components were NaN, infinite or negative and are replaced", repaired));
    if (clamped > 0)
        picture.notes.push_back(fmt::format("{} components were above 10^9 and count as 10^9", clamped));
}

template <int kChannels> Status writePngOf(const Path& file, const Image<uint8_t, kChannels>& image) {
    assert(!image.empty());
    std::string bytes;
    if (!stbi_write_png_to_func(append, &bytes, image.width, image.height, kChannels, image.pixels.data(), 0))
        return Error{file.string(), "there is no memory to code the picture"};
    return writeFileWhole(file, bytes);
}

// Makes a TIFF upright as stored, because OpenCV would turn it, whatever it is asked for.
void clearOrientation(std::vector<uint8_t>& tiff) {
    const ByteSpan entry = tiffEntry(tiff, TiffTag::Orientation);
    if (entry.empty()) return;
    uint8_t* number = tiff.data() + (entry.data() - tiff.data());
    std::fill_n(number, entry.size(), uint8_t{0});
    number[tiff[0] == 'I' ? 0 : entry.size() - 1] = 1;
}

// OpenCV 4.6 does not read AVIF.
bool decodeAvif(const Path& file, ImageRgb8& bgr) {
    FileDecoder in;
    in.input = openInput(file, "mov");
    if (!in.input || avformat_find_stream_info(in.input.get(), nullptr) < 0) return false;
    in.stream = av_find_best_stream(in.input.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
    return in.stream >= 0 && in.decoder.open(in.opened(), FrameThreading::None, 1) && in.next(16) &&
           in.decoder.convert(bgr).ok();
}

// Decodes a picture as it is stored, to red first.
Result<ImageRgb8> decoded(const Path& file, PictureKind kind, const std::vector<uint8_t>& bytes) {
    const auto with = codecs();
    if (!with) return with.error();
    try {
        const log::QuietStandardError quiet; // OpenCV 4.6 prints exceptions, whatever the log level
        ImageRgb8 avif;                      // outlives the matrix that views it
        cv::Mat bgr;
        // A damaged file with this text is left to GDCM, which may end the program.
        if (!hasText(bytes, 128, "DICM"))
            bgr = kind != PictureKind::Avif
                      ? (*with)->imdecode(bytes, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION)
                  : decodeAvif(file, avif) ? viewOf(avif)
                                           : cv::Mat();
        if (!bgr.empty() && bgr.type() == CV_8UC3) {
            ImageRgb8 image(bgr.cols, bgr.rows);
            cv::cvtColor(bgr, viewOf(image), cv::COLOR_BGR2RGB);
            return image;
        }
    } catch (const std::exception&) { // the same as an empty picture
    }
    return Error{file.string(),
                 fmt::format("cannot be decoded as {}: cut short, damaged, or a rare variant", nameOf(kind))};
}

} // namespace

Result<Photo> readPhoto(const Path& file, PictureLimits limits) {
    auto read = readPictureFile(file, false, limits);
    if (!read) return read.error();
    auto& [bytes, header] = *read;
    Photo photo{.metadata = photoMetadata(bytes, header.kind)};
    if (header.kind == PictureKind::Jpeg) {
        if (isCutJpeg(bytes)) return Error{file.string(), "is cut short"};
        bytes.insert(bytes.end(), {0xff, 0xd9}); // OpenCV leaves the last rows undecoded without an end mark
    }
    if (header.kind == PictureKind::Tiff) clearOrientation(bytes);
    const auto stored = decoded(file, header.kind, bytes);
    if (!stored) return stored.error();
    if (header.kind == PictureKind::Avif &&
        (stored->width != header.size.width || stored->height != header.size.height))
        return Error{file.string(), "its header and its pixels state different sizes"};
    makeUpright(*stored, photo.metadata.orientation, photo.picture);
    photo.colourNote = convertToSrgb(photo.metadata.profile, photo.picture);
    return photo;
}

Result<HdrPicture> readHdr(const Path& file, PictureLimits limits, const std::string& layer) {
    const auto read = readPictureFile(file, true, limits);
    if (!read) return read.error();
    const auto& [bytes, header] = *read;
    if (!layer.empty() && header.kind != PictureKind::Exr) return Error{file.string(), kNoLayers};
    auto picture = header.kind == PictureKind::Pfm        ? decodePfm(bytes)
                   : header.kind == PictureKind::Radiance ? decodeRadiance(bytes)
                                                          : decodeExr(file, bytes, layer, limits);
    if (!picture) return Error{file.string(), picture.error().reason};
    repair(*picture);
    constexpr Primaries kRec709 = {0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f};
    const auto isNear = [](float a, float b) { return std::abs(a - b) < 1e-3f; };
    if (!picture->primaries || std::ranges::equal(*picture->primaries, kRec709, isNear)) return picture;
    // Poly Haven's pictures state zeros.
    const bool converted = toRec709(picture->radianceLin, *picture->primaries);
    picture->notes.emplace_back(converted ? "converted to the primaries of Rec. 709"
                                          : "its primaries span no colours and count as those of Rec. 709");
    return picture;
}

std::string HdrPicture::note() const {
    return notes.empty() ? "" : fmt::format("; {}", fmt::join(notes, "; "));
}

Status writePng(const Path& file, const ImageRgb8& image) { return writePngOf(file, image); }
Status writePng(const Path& file, const ImageRgba8& image) { return writePngOf(file, image); }

WrittenAs writtenAs(const Path& file) {
    const std::string extension = extensionOf(file);
    if (extension == ".png") return WrittenAs::Png;
    if (extension == ".jpg" || extension == ".jpeg") return WrittenAs::Jpeg;
    if (extension == ".hdr" || extension == ".exr" || extension == ".pfm") return WrittenAs::Hdr;
    return WrittenAs::Nothing;
}

Status writePicture(const Path& file, const ImageRgb8& image) {
    const WrittenAs kind = writtenAs(file);
    if (kind == WrittenAs::Png) return writePng(file, image);
    if (kind != WrittenAs::Jpeg)
        return Error{file.string(), "is of no kind that photos are written as; use .png or .jpg"};
    constexpr int kQuality = 95;
    std::string bytes;
    stbi_write_jpg_to_func(append, &bytes, image.width, image.height, 3, image.pixels.data(), kQuality);
    return writeFileWhole(file, bytes);
}

Result<std::string> encodeHdr(const Path& name, const ImageRgbF& radianceLin) {
    const std::string extension = extensionOf(name);
    if (extension == ".hdr") return encodeRadiance(radianceLin);
    if (extension == ".pfm") return encodePfm(radianceLin);
    if (extension == ".exr") return encodeExr(radianceLin);
    return Error{name.string(), "has no high dynamic range kind; use .exr, .hdr or .pfm"};
}

Status writeHdr(const Path& file, const ImageRgbF& radianceLin) {
    const auto bytes = encodeHdr(file, radianceLin);
    return bytes ? writeFileWhole(file, *bytes) : Status(bytes.error());
}

void toBgra(const ImageRgb8& in, bool bgr, ImageRgba8& out) {
    out.fit(in.width, in.height);
    cv::cvtColor(viewOf(in), viewOf(out), bgr ? cv::COLOR_BGR2BGRA : cv::COLOR_RGB2BGRA);
}

} // namespace shoal::media
