#include "engine/media/VideoSource.h"

#include "engine/media/Bytes.h"
#include "engine/media/PictureHeader.h"
#include "engine/media/Quiet.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

namespace shoal::media {

namespace {

// Containers we hand to FFmpeg. Others it knows include play lists and scripts that name further files.
bool isVideoContainer(ByteSpan b) {
    for (const char* name : {"ftyp", "moov", "mdat", "wide", "free", "skip", "pnot", "styp", "moof"})
        if (hasText(b, 4, name)) return true;
    return hasText(b, 0, "\x1A\x45\xDF\xA3") ||                // Matroska, WebM
           (hasText(b, 0, "RIFF") && hasText(b, 8, "AVI ")) || //
           hasText(b, 0, "OggS") || hasText(b, 0, "FLV") ||    //
           hasText(b, 0, std::string_view("\0\0\1\xBA", 4)) || // MPEG program stream
           (b.size() > 188 && b[0] == 0x47 && b[188] == 0x47); // MPEG transport stream
}

Status checkBeforeDecoding(const Path& file, const SphericalMetadata& metadata) {
    std::array<uint8_t, 4096> head{};
    std::ifstream stream(file, std::ios::binary);
    stream.read(reinterpret_cast<char*>(head.data()), head.size());
    const ByteSpan bytes = std::span(head).first(static_cast<size_t>(stream.gcount()));
    if (bytes.empty()) return Error{file.string(), "is empty, or cannot be read"};
    if (const auto picture = readPictureHeader(bytes))
        return Error{file.string(), std::string("is a ") + nameOf(picture->kind) +
                                        " picture, not a video; give it as " +
                                        (isHdr(picture->kind) ? "--env" : "--photo")};
    if (!isVideoContainer(bytes))
        return Error{file.string(),
                     "is not a video of a known kind (MP4, MOV, WebM, MKV, AVI, MPEG, OGG, FLV)"};
    if (metadata.frameWidth > kMaxVideoSide || metadata.frameHeight > kMaxVideoSide)
        return Error{file.string(), "its " + std::to_string(metadata.frameWidth) + "x" +
                                        std::to_string(metadata.frameHeight) +
                                        " pixels are more than the limit of " +
                                        std::to_string(kMaxVideoSide) + " a side"};
    return Done{};
}

// FFmpeg gives the container's four letters; several stand for one codec.
std::string codecName(double fourcc) {
    const auto code = static_cast<uint32_t>(static_cast<int64_t>(fourcc));
    std::string name;
    for (int shift = 0; shift < 32; shift += 8) {
        const char letter = static_cast<char>(code >> shift & 0xff);
        if (letter > ' ' && letter < 127) name += letter;
    }
    if (name == "avc1" || name == "avc3" || name == "H264") return "h264";
    if (name == "hvc1" || name == "hev1" || name == "HEVC") return "hevc";
    if (name == "vp09" || name == "VP90") return "vp9";
    if (name == "av01" || name == "AV01") return "av1";
    return name;
}

} // namespace

Result<VideoSource> VideoSource::open(const Path& file) {
    setUpDecoders();
    auto metadata = readSphericalMetadata(file);
    if (!metadata) return metadata.error();
    if (const Status fit = checkBeforeDecoding(file, *metadata); !fit) return fit.error();

    VideoSource source;
    std::error_code code;
    source.file_ = std::filesystem::absolute(file, code); // a leading '/' keeps FFmpeg from seeing a protocol
    if (!source.reopen())
        return Error{file.string(), "has no video that can be decoded: damaged, cut short, only sound, or of "
                                    "a codec that is not installed"};

    VideoInfo& info = source.info_;
    const auto number = [&](int property) {
        const double value = source.capture_.get(property);
        return std::isfinite(value) ? value : 0.0;
    };
    const double width = number(cv::CAP_PROP_FRAME_WIDTH), height = number(cv::CAP_PROP_FRAME_HEIGHT);
    if (width < 2 || height < 2) return Error{file.string(), "its picture has no size"};
    if (width > kMaxVideoSide || height > kMaxVideoSide)
        return Error{file.string(),
                     "its picture is larger than the limit of " + std::to_string(kMaxVideoSide) + " a side"};
    info.width = static_cast<int>(width);
    info.height = static_cast<int>(height);
    const double fps = number(cv::CAP_PROP_FPS);
    info.fps = fps >= kMinFps && fps <= kMaxFps ? fps : kFallbackFps;
    const double count = number(cv::CAP_PROP_FRAME_COUNT);
    info.frameCount = count > 1 && count < 1e8 ? static_cast<int64_t>(count) : 0;
    // An edit list may show fewer frames than are stored.
    const double shown = std::round(metadata->shown_s * info.fps);
    if (shown >= 1 && shown < static_cast<double>(info.frameCount))
        info.frameCount = static_cast<int64_t>(shown);
    info.duration_s = static_cast<double>(info.frameCount) / info.fps;
    info.codec = codecName(number(cv::CAP_PROP_FOURCC));
    info.metadata = *metadata;
    // Motion JPEG is BT.601 whatever its size (JFIF).
    info.matrix = info.codec == "MJPG" ? ColourMatrix::Bt601
                                       : colourMatrixOf(metadata->matrixCode, info.width, info.height);
    return source;
}

bool VideoSource::reopen() {
    try {
        capture_.release();
        capture_.open(file_.string(), cv::CAP_FFMPEG);
        position_ = 0;
        grabbedSinceSeek_ = 0;
        jumped_ = false;
        return capture_.isOpened();
    } catch (const std::exception&) {
        return false;
    }
}

bool VideoSource::grab() {
    try {
        if (!capture_.grab()) {
            if (!jumped_ || grabbedSinceSeek_ > 0) return false;
            // A seek that led nowhere: from here on this file is only read in order.
            seekable_ = false;
            const int64_t wanted = position_;
            if (!reopen()) return false;
            while (position_ < wanted) {
                if (!capture_.grab()) return false;
                ++position_;
            }
            if (!capture_.grab()) return false;
        }
    } catch (const std::exception&) {
        return false;
    }
    ++position_;
    ++grabbedSinceSeek_;
    return true;
}

bool VideoSource::retrieve(ImageRgb8& bgr) {
    try {
        cv::Mat target(bgr.height, bgr.width, CV_8UC3, bgr.pixels.data());
        // A frame of another size would make OpenCV take memory of its own.
        if (!capture_.retrieve(target) || target.data != bgr.pixels.data()) return false;
        if (info_.matrix == ColourMatrix::Bt601) return true;
        // Few rows at a time: of a whole picture OpenCV would make a copy first.
        constexpr int kRows = 16;
        const cv::Matx33f correction(correctionBgr(info_.matrix).data());
        for (int y = 0; y < target.rows; y += kRows) {
            cv::Mat rows = target.rowRange(y, std::min(y + kRows, target.rows));
            cv::transform(rows, corrected_, correction);
            corrected_.copyTo(rows);
        }
        return true;
    } catch (const std::exception&) {
        return false;
    }
}

bool VideoSource::seek(int64_t number) {
    if (number == position_) return true;
    // Near the stated end a seek could fall behind the real one, so it stops short and the caller grabs on.
    constexpr int64_t kShortOfEnd = 16;
    const int64_t safe = std::clamp(number, int64_t{0}, std::max(int64_t{0}, info_.frameCount - kShortOfEnd));
    if (number >= position_ && safe <= position_) return true;
    if (seekable_) {
        try {
            const auto wanted = static_cast<double>(safe);
            if (capture_.set(cv::CAP_PROP_POS_FRAMES, wanted) &&
                capture_.get(cv::CAP_PROP_POS_FRAMES) == wanted) {
                position_ = safe;
                grabbedSinceSeek_ = 0;
                jumped_ = true;
                return true;
            }
        } catch (const std::exception&) {
        }
        seekable_ = false;
        return reopen(); // the failed seek has moved the decoder to nobody knows where
    }
    return number >= position_ || reopen();
}

} // namespace shoal::media
