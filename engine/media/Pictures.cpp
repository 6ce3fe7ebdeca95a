#include "engine/media/Pictures.h"

#include "engine/media/Codecs.h"
#include "engine/media/HdrFormats.h"
#include "engine/media/PictureHeader.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <iostream>
#include <mutex>

namespace shoal::media {

namespace {

constexpr uint64_t kMaxFileBytes = 512u << 20;
constexpr uint64_t kMaxHdrFileBytes = 2048ull << 20; // 16384 x 8192 floats are 1.5 GiB

struct PictureFile {
    std::vector<uint8_t> bytes;
    PictureHeader header;
};

// A file of the wanted kind whose stated size is within the limits.
Result<PictureFile> readPictureFile(const Path& file, bool hdr, PictureLimits limits) {
    auto bytes = readFile(file, hdr ? kMaxHdrFileBytes : kMaxFileBytes);
    if (!bytes) return bytes.error();
    const auto header = readPictureHeader(*bytes);
    if (!header) return Error{file.string(), header.error().reason};
    if (isHdr(header->kind) && !hdr)
        return Error{file.string(), "is a high dynamic range picture; give it as --env"};
    if (!isHdr(header->kind) && hdr)
        return Error{file.string(), std::string("is a ") + nameOf(header->kind) +
                                        ", which has no high dynamic range; give it as --photo"};
    if (header->width > limits.maxWidth || header->height > limits.maxHeight)
        return Error{file.string(),
                     "its " + std::to_string(header->width) + "x" + std::to_string(header->height) +
                         " pixels are more than the limit of " + std::to_string(limits.maxWidth) + "x" +
                         std::to_string(limits.maxHeight)};
    return PictureFile{std::move(*bytes), *header};
}

// A view of the image's own memory.
template <class T, int kChannels> cv::Mat viewOf(const Image<T, kChannels>& image) {
    return {image.height, image.width, CV_MAKETYPE(cv::DataType<T>::depth, kChannels),
            const_cast<T*>(image.pixels.data())};
}

// Silences std::cerr for its lifetime: OpenCV 4.6 prints exceptions of imread, imdecode and imencode there,
// whatever the log level. Our own messages do not use it (engine/core/Log.h). One at a time.
class QuietCerr {
  public:
    QuietCerr() : turn_(mutex()), before_(std::cerr.rdbuf(nullptr)) {}
    ~QuietCerr() { std::cerr.rdbuf(before_); }
    QuietCerr(const QuietCerr&) = delete;
    QuietCerr& operator=(const QuietCerr&) = delete;

  private:
    static std::mutex& mutex() {
        static std::mutex mutex;
        return mutex;
    }
    std::unique_lock<std::mutex> turn_;
    std::streambuf* before_;
};

// What OpenCV decodes, red first. decode: gives a matrix of `type`, empty if it cannot; may throw.
template <class Picture, class Decode>
Result<Picture> decoded(const Path& file, PictureKind kind, int type, Decode&& decode) {
    const Error undecodable{file.string(), std::string("cannot be decoded as ") + nameOf(kind) +
                                               ": cut short, damaged, or a rare variant"};
    const auto with = codecs();
    if (!with) return with.error();
    try {
        const QuietCerr quiet;
        const cv::Mat bgr = decode(**with);
        if (bgr.empty() || bgr.type() != type) return undecodable;
        Picture image(bgr.cols, bgr.rows);
        cv::cvtColor(bgr, viewOf(image), cv::COLOR_BGR2RGB);
        return image;
    } catch (const std::exception&) {
        return undecodable;
    }
}

// See HdrPicture::repaired.
int64_t repair(ImageRgbF& image) {
    float largest = 0;
    int64_t bad = 0;
    for (const float value : image.pixels) {
        const bool sound = value >= 0 && value <= kMaxRadiance; // false for NaN
        if (sound)
            largest = std::max(largest, value);
        else
            ++bad;
    }
    if (bad > 0)
        for (float& value : image.pixels)
            if (!(value >= 0 && value <= kMaxRadiance)) value = value > kMaxRadiance ? largest : 0;
    return bad;
}

// As the file's extension says. toOpenCv: the conversion that brings blue first.
Status write(const Path& file, const cv::Mat& rgb, int toOpenCv, const std::string& extension,
             const char* uncodable) {
    assert(!rgb.empty());
    const auto with = codecs();
    if (!with) return with.error();
    std::vector<uint8_t> bytes;
    try {
        const QuietCerr quiet;
        cv::Mat bgr;
        cv::cvtColor(rgb, bgr, toOpenCv);
        if (!(*with)->imencode(extension, bgr, bytes, {})) return Error{file.string(), uncodable};
    } catch (const std::exception& failure) {
        return Error{file.string(), std::string(uncodable) + ": " + failure.what()};
    }
    return writeFileWhole(file, asText(bytes));
}

constexpr const char* kNoPng = "the picture cannot be coded as PNG";

std::string extensionOf(const Path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

} // namespace

Result<ImageRgb8> readPicture(const Path& file, PictureLimits limits) {
    const auto read = readPictureFile(file, false, limits);
    if (!read) return read.error();
    const auto& [bytes, header] = *read;
    if (const char* damage = damageIn(header.kind, bytes); *damage) return Error{file.string(), damage};
    return decoded<ImageRgb8>(file, header.kind, CV_8UC3,
                              [&](const Codecs& with) { return with.imdecode(bytes, cv::IMREAD_COLOR); });
}

Result<HdrPicture> readHdr(const Path& file, PictureLimits limits) {
    const auto read = readPictureFile(file, true, limits);
    if (!read) return read.error();
    const auto& [bytes, header] = *read;
    const int width = static_cast<int>(header.width), height = static_cast<int>(header.height);
    const auto decodeExr = [&](const Codecs& with) {
        const cv::Mat bgr = with.imread(file.string(), cv::IMREAD_ANYDEPTH | cv::IMREAD_COLOR);
        return bgr.cols == width && bgr.rows == height ? bgr : cv::Mat();
    };
    auto image = header.kind == PictureKind::Pfm ? decodePfm(bytes, width, height)
                 : header.kind == PictureKind::Radiance
                     ? decodeRadiance(bytes, width, height)
                     : decoded<ImageRgbF>(file, header.kind, CV_32FC3, decodeExr);
    if (!image) return Error{file.string(), image.error().reason};
    HdrPicture picture{std::move(*image), 0};
    picture.repaired = repair(picture.radianceLin);
    return picture;
}

Status writePng(const Path& file, const ImageRgb8& image) {
    return write(file, viewOf(image), cv::COLOR_RGB2BGR, ".png", kNoPng);
}
Status writePng(const Path& file, const ImageRgba8& image) {
    return write(file, viewOf(image), cv::COLOR_RGBA2BGRA, ".png", kNoPng);
}

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
    return write(file, viewOf(image), cv::COLOR_RGB2BGR, ".jpg", "the picture cannot be coded as JPEG");
}

Status writeHdr(const Path& file, const ImageRgbF& radianceLin) {
    assert(!radianceLin.empty());
    if (writtenAs(file) != WrittenAs::Hdr)
        return Error{file.string(), "has no high dynamic range kind; use .exr, .hdr or .pfm"};
    if (extensionOf(file) == ".pfm") return writeFileWhole(file, encodePfm(radianceLin));
    return write(file, viewOf(radianceLin), cv::COLOR_RGB2BGR, extensionOf(file),
                 "the picture cannot be coded");
}

void toBgra(const ImageRgb8& in, bool bgr, ImageRgba8& out) {
    out.fit(in.width, in.height);
    cv::cvtColor(viewOf(in), viewOf(out), bgr ? cv::COLOR_BGR2BGRA : cv::COLOR_RGB2BGRA);
}

} // namespace shoal::media
