#include "engine/media/Pictures.h"

#include "engine/media/Codecs.h"
#include "engine/media/PictureHeader.h"
#include "engine/media/Quiet.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cassert>
#include <cctype>

namespace shoal::media {

namespace {

constexpr uint64_t kMaxFileBytes = 512u << 20;
constexpr const char* kPng = ".png";

// kind: as file names end, with its dot.
template <int kChannels>
Status writeColour(const Path& file, const Image<uint8_t, kChannels>& image, int toOpenCv, const char* kind) {
    assert(!image.empty());
    const auto with = codecs();
    if (!with) return with.error();
    const std::string uncodable =
        std::string("the picture cannot be coded as ") + (kind == kPng ? "PNG" : "JPEG");
    try {
        const cv::Mat rgb(image.height, image.width, CV_8UC(kChannels),
                          const_cast<uint8_t*>(image.pixels.data()));
        cv::Mat bgr;
        cv::cvtColor(rgb, bgr, toOpenCv);
        std::vector<uint8_t> bytes;
        if (!(*with)->imencode(kind, bgr, bytes)) return Error{file.string(), uncodable};
        return writeFileWhole(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    } catch (const std::exception& failure) {
        return Error{file.string(), uncodable + ": " + failure.what()};
    }
}

} // namespace

Result<ImageRgb8> readPicture(const Path& file, PictureLimits limits) {
    auto bytes = readFile(file, kMaxFileBytes);
    if (!bytes) return bytes.error();
    const auto header = readPictureHeader(*bytes);
    if (!header) return Error{file.string(), header.error().reason};
    if (isHdr(header->kind)) return Error{file.string(), "is a high dynamic range picture; give it as --env"};
    if (header->width > limits.maxWidth || header->height > limits.maxHeight)
        return Error{file.string(),
                     "its " + std::to_string(header->width) + "x" + std::to_string(header->height) +
                         " pixels are more than the limit of " + std::to_string(limits.maxWidth) + "x" +
                         std::to_string(limits.maxHeight)};
    if (const char* damage = damageIn(header->kind, *bytes); *damage) return Error{file.string(), damage};
    const auto with = codecs();
    if (!with) return with.error();
    try {
        const QuietCerr quiet;
        const cv::Mat bgr = (*with)->imdecode(*bytes, cv::IMREAD_COLOR);
        if (bgr.empty() || bgr.type() != CV_8UC3)
            return Error{file.string(), std::string("cannot be decoded as ") + nameOf(header->kind) +
                                            ": damaged, or a rare variant"};
        ImageRgb8 image(bgr.cols, bgr.rows);
        cv::Mat rgb(bgr.rows, bgr.cols, CV_8UC3, image.pixels.data());
        cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
        return image;
    } catch (const std::exception&) {
        return Error{file.string(), std::string("cannot be decoded as ") + nameOf(header->kind)};
    }
}

Status writePng(const Path& file, const ImageRgb8& image) {
    return writeColour(file, image, cv::COLOR_RGB2BGR, kPng);
}
Status writePng(const Path& file, const ImageRgba8& image) {
    return writeColour(file, image, cv::COLOR_RGBA2BGRA, kPng);
}

WrittenAs writtenAs(const Path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ending == ".png") return WrittenAs::Png;
    if (ending == ".jpg" || ending == ".jpeg") return WrittenAs::Jpeg;
    if (ending == ".hdr" || ending == ".exr" || ending == ".pfm") return WrittenAs::Hdr;
    return WrittenAs::Nothing;
}

Status writePicture(const Path& file, const ImageRgb8& image) {
    const WrittenAs kind = writtenAs(file);
    if (kind != WrittenAs::Png && kind != WrittenAs::Jpeg)
        return Error{file.string(), "is of no kind that photos are written as; use .png or .jpg"};
    return writeColour(file, image, cv::COLOR_RGB2BGR, kind == WrittenAs::Png ? kPng : ".jpg");
}

void toBgra(const ImageRgb8& in, bool bgr, ImageRgba8& out) {
    if (out.width != in.width || out.height != in.height) out = ImageRgba8(in.width, in.height);
    const cv::Mat from(in.height, in.width, CV_8UC3, const_cast<uint8_t*>(in.pixels.data()));
    cv::Mat to(out.height, out.width, CV_8UC4, out.pixels.data());
    cv::cvtColor(from, to, bgr ? cv::COLOR_BGR2BGRA : cv::COLOR_RGB2BGRA);
}

} // namespace shoal::media
