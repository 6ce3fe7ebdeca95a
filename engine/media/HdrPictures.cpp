#include "engine/media/Codecs.h"
#include "engine/media/Pfm.h"
#include "engine/media/PictureHeader.h"
#include "engine/media/Pictures.h"
#include "engine/media/Quiet.h"
#include "engine/media/Radiance.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <cmath>
#include <fstream>

namespace shoal::media {

namespace {

constexpr uint64_t kMaxFileBytes = 2048ull << 20; // 16384 x 8192 floats are 1.5 GiB

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

Result<ImageRgbF> decodeExr(const Path& file, const PictureHeader& header) {
    const Error undecodable{file.string(), std::string("cannot be decoded as ") + nameOf(header.kind) +
                                               ": cut short, damaged, or a rare variant"};
    const auto with = codecs();
    if (!with) return with.error();
    try {
        const QuietCerr quiet;
        const cv::Mat bgr = (*with)->imread(file.string(), cv::IMREAD_ANYDEPTH | cv::IMREAD_COLOR);
        if (bgr.type() != CV_32FC3 || bgr.cols != header.width || bgr.rows != header.height)
            return undecodable;
        ImageRgbF image(bgr.cols, bgr.rows);
        cv::Mat rgb(bgr.rows, bgr.cols, CV_32FC3, image.pixels.data());
        cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
        return image;
    } catch (const std::exception&) {
        return undecodable;
    }
}

std::string extensionOf(const Path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

} // namespace

Result<HdrPicture> readHdr(const Path& file, PictureLimits limits) {
    auto bytes = readFile(file, kMaxFileBytes);
    if (!bytes) return bytes.error();
    const auto header = readPictureHeader(*bytes);
    if (!header) return Error{file.string(), header.error().reason};
    if (!isHdr(header->kind))
        return Error{file.string(), std::string("is a ") + nameOf(header->kind) +
                                        ", which has no high dynamic range; give it as --photo"};
    if (header->width > limits.maxWidth || header->height > limits.maxHeight)
        return Error{file.string(),
                     "its " + std::to_string(header->width) + "x" + std::to_string(header->height) +
                         " pixels are more than the limit of " + std::to_string(limits.maxWidth) + "x" +
                         std::to_string(limits.maxHeight)};
    const int width = static_cast<int>(header->width), height = static_cast<int>(header->height);
    auto image = header->kind == PictureKind::Pfm        ? decodePfm(*bytes, width, height)
                 : header->kind == PictureKind::Radiance ? decodeRadiance(*bytes, width, height)
                                                         : decodeExr(file, *header);
    if (!image) return Error{file.string(), image.error().reason};
    HdrPicture picture{std::move(*image), 0};
    picture.repaired = repair(picture.radianceLin);
    return picture;
}

Status writeHdr(const Path& file, const ImageRgbF& radianceLin) {
    assert(!radianceLin.empty());
    const std::string extension = extensionOf(file);
    if (extension == ".pfm") return writeFileWhole(file, encodePfm(radianceLin));
    if (extension != ".exr" && extension != ".hdr")
        return Error{file.string(), "has no high dynamic range kind; use .exr, .hdr or .pfm"};
    const auto with = codecs();
    if (!with) return with.error();
    return writeWhole(file, [&](const Path& temporary) -> Status {
        const Error unwritable{temporary.string(),
                               "cannot be written; is the disk full or the folder read-only?"};
        // Tried first, because OpenCV would complain to standard error.
        if (!std::ofstream(temporary, std::ios::binary)) return unwritable;
        try {
            const cv::Mat rgb(radianceLin.height, radianceLin.width, CV_32FC3,
                              const_cast<float*>(radianceLin.pixels.data()));
            cv::Mat bgr;
            cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
            const QuietCerr quiet;
            if ((*with)->imwrite(temporary.string(), bgr)) return Done{};
        } catch (const std::exception&) {
        }
        return unwritable;
    });
}

} // namespace shoal::media
