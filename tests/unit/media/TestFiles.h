// Small files that the media tests make for themselves.
#pragma once

#include "engine/core/Files.h"
#include "engine/media/Pictures.h"
#include "tests/Test.h"

#include <opencv2/videoio.hpp>

namespace shoal::media {

using TempFolder = tests::ScratchFolder;

// Returns a file of the reference data, or an empty path.
inline Path sharedData(const std::string& name) {
    const Path file = tests::sharedDataFolder() / name;
    return std::filesystem::exists(file) ? file : Path{};
}

inline Result<ImageRgb8> readPicture(const Path& file, PictureLimits limits = {}) {
    auto photo = readPhoto(file, limits);
    if (!photo) return photo.error();
    return std::move(photo->picture);
}

inline void writeBytes(const Path& file, std::string_view bytes) {
    std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

inline std::string readBytes(const Path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// Returns a number's bytes; more than eight: with zeros before, or behind.
inline std::string number(uint64_t value, int bytes, bool little) {
    std::string text;
    for (int i = 0; i < bytes; ++i) {
        const int place = little ? i : bytes - 1 - i;
        text += static_cast<char>(place < 8 ? value >> 8 * place & 0xff : 0);
    }
    return text;
}

// Returns a box of a file of ISO/IEC 14496-12.
inline std::string box(const std::string& name, const std::string& payload) {
    return number(payload.size() + 8, 4, false) + name + payload;
}

// Makes a file by the program; false where there is none or it lacks a coder.
inline bool ffmpeg(const std::string& arguments, const Path& file) {
    const std::string command =
        "ffmpeg -v error -y " + arguments + " '" + file.string() + "' >/dev/null 2>&1";
    return std::system(command.c_str()) == 0;
}

inline cv::Mat matOf(const cv::Mat& picture) { return picture; }
inline cv::Mat matOf(const ImageRgb8& bgr) {
    return cv::Mat(bgr.height, bgr.width, CV_8UC3, const_cast<uint8_t*>(bgr.pixels.data())).clone();
}

// Writes a film of so many pictures; codec: four letters.
template <class Picture>
void writeFilm(const Path& file, const char (&codec)[5], int count, Picture&& picture, double fps = 30) {
    cv::VideoWriter writer;
    for (int i = 0; i < count; ++i) {
        const cv::Mat bgr = matOf(picture(i));
        if (i == 0)
            writer.open(file.string(), cv::CAP_FFMPEG,
                        cv::VideoWriter::fourcc(codec[0], codec[1], codec[2], codec[3]), fps, bgr.size());
        ASSERT_TRUE(writer.isOpened()) << file;
        writer.write(bgr);
    }
}

// Frame i is uniform grey of level kFirstGrey + kGreyStep * i: numberOf() reads it back. JPEG at its default
// quality keeps a uniform grey within one level, so up to 50 frames stay distinct.
constexpr int kFirstGrey = 20, kGreyStep = 4;

inline cv::Mat greyPicture(int number, int width = 64, int height = 32) {
    return cv::Mat(height, width, CV_8UC3, cv::Scalar::all(kFirstGrey + kGreyStep * number));
}

inline void writeGreyVideo(const Path& file, int frames, double fps = 30) {
    const auto picture = [](int i) { return greyPicture(i); };
    writeFilm(file, "MJPG", frames, picture, fps);
}

inline int numberOf(const ImageRgb8& picture) {
    const int grey = picture.at(picture.width / 2, picture.height / 2)[1];
    return (grey - kFirstGrey + kGreyStep / 2) / kGreyStep;
}

} // namespace shoal::media
