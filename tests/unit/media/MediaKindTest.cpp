// The kind of a file is that of its content, whatever its name; and its reason, if it cannot be shown.
#include "engine/media/Check.h"
#include "engine/media/VideoSource.h"
#include "tests/unit/Wav.h"
#include "tests/unit/media/TestFiles.h"

namespace shoal::media {
namespace {

using namespace std::string_literals;

struct MediaKinds : testing::Test {
    TempFolder folder;

    std::string kindOf(const Path& file) {
        const auto kind = mediaKind(file);
        if (!kind) return kind.error().reason;
        constexpr const char* kNames[] = {"photo", "hdr", "video", "depth track"};
        return kNames[static_cast<size_t>(*kind)];
    }
    std::string kindOfBytes(const std::string& bytes) {
        writeBytes(folder / "name.mp4", bytes);
        return kindOf(folder / "name.mp4");
    }
    Path made(const std::string& how, const std::string& name) {
        const std::string sources = "-f lavfi -i testsrc=s=64x32:r=25:d=0.4 -f lavfi -i sine=d=0.4 ";
        return ffmpeg(sources + how, folder / name) ? folder / name : Path();
    }
};

std::string ftyp(const std::string& brands) { return box("ftyp", brands); }

// A little-endian TIFF of one entry, a number of 32 bits.
std::string tiff(int tag) {
    const auto of = [](int value, int bytes) { return number(value, bytes, true); };
    return "II*\0"s + of(8, 4) + of(1, 2) + of(tag, 2) + of(4, 2) + of(1, 4) + of(1, 4) + of(0, 4);
}

TEST_F(MediaKinds, FirstBytesTell) {
    const std::string raw = "is a camera raw picture; convert it to JPEG",
                      heic = "is a HEIC picture; convert it to JPEG",
                      jxl = "is a JPEG XL picture; convert it to JPEG";
    const std::pair<std::string, std::string> cases[] = {
        {"\xff\xd8\xff\xe0", "photo"},
        {"RIFF\4\0\0\0WEBP"s, "photo"},
        {"P6\n2 1 255\n", "photo"},
        {tiff(256), "photo"},
        {ftyp("avif\0\0\0\0avifmif1miaf"s), "photo"},
        {ftyp("mif1\0\0\0\0mif1avif"s), "photo"},
        {"#?RADIANCE\n", "hdr"},
        {"\x76\x2f\x31\x01", "hdr"},
        {ftyp("heic\0\0\0\0mif1heic"s), heic},
        {ftyp("mif1\0\0\0\0mif1heix"s), heic},
        {ftyp("msf1\0\0\0\0hevc"s), heic},
        {ftyp("crx \0\0\0\1crx isom"s), raw},
        {tiff(254), raw},   // of a thumbnail: NEF, ARW
        {tiff(50706), raw}, // DNG
        {"II*\0\x10\0\0\0CR\2\0"s, raw},
        {"FUJIFILMCCD-RAW 0201", raw},
        {"\xff\x0a\xfa\x1f", jxl},
        {"\0\0\0\x0cJXL \r\n\x87\n"s, jxl},
        {"\0\0\0\x0cjP  \r\n\x87\n"s, "is a JPEG 2000 picture; convert it to JPEG"},
        {"GIF89a", "is a GIF picture; convert it to JPEG"},
        {"ID3\4\0\0\0\0\x7f\x7f"s, "is only sound"},
        {wavOf(2, 48000, std::vector<int16_t>(4096)), "is only sound"},
        {"", "is empty"},
    };
    for (const auto& [bytes, kind] : cases) EXPECT_EQ(kindOfBytes(bytes), kind) << bytes.substr(0, 24);
    EXPECT_THAT(kindOfBytes("no film, but text"), testing::StartsWith("is neither a picture"));
    EXPECT_EQ(kindOf("/nowhere/a.mp4"), "there is no such file");
    for (const Layout layout : {Layout::Auto, Layout::Mono}) {
        writeBytes(folder / "a.mp4", ftyp("heic\0\0\0\0mif1heic"s));
        EXPECT_EQ(VideoSource::open(folder / "a.mp4", layout).error().reason, heic);
    }
    EXPECT_EQ(readPhoto(folder / "a.mp4").error().reason, heic);
}

TEST_F(MediaKinds, ContainersAreOpened) {
    if (made("-frames:v 1", "a.png").empty()) GTEST_SKIP() << "needs ffmpeg to make files";
    const std::string film = "-c:v mpeg1video -an",
                      cover = "-c:v mjpeg -vf trim=end_frame=1 -disposition:v attached_pic ";
    for (const auto& [how, name, kind] : std::initializer_list<std::array<std::string, 3>>{
             {"-c:v mpeg4 -c:a aac", "a.mp4", "video"},
             {"-f 3gp -c:v mpeg4 -an", "a.3gp", "video"},
             {"-f mp4 -c:v mpeg4 -an", "a.insv", "video"},
             {"-f flv -c:v flv1 -an", "a.flv", "video"},
             {"-f mpeg " + film, "a.mpg", "video"},
             {"-f mpegts " + film, "a", "video"},
             {"-f matroska -c:v mpeg4 -an", "no ending", "video"},
             {"-vn -c:a aac", "a.m4a", "is only sound"},
             {cover + "-c:a aac -f mp4", "cover.mp4", "is only sound"},
             {cover + "-c:a flac", "cover.flac", "is only sound"},
             {"-vn -c:a flac", "a.mka", "is only sound"},
             {"-an -f asf -c:v msmpeg4", "a.wmv",
              "is of a kind that is not read: ASF (Advanced / Active Streaming Format)"}}) {
        const Path file = made(how, name);
        if (file.empty()) continue; // this ffmpeg lacks that coder
        EXPECT_EQ(kindOf(file), kind) << name;
        EXPECT_EQ(checkMedia(file).ok(), kind == "video") << name;
    }
}

TEST_F(MediaKinds, AvifIsReadAsAPicture) {
    const Path file = made("-an -frames:v 1 -vf geq=200:128:128 -pix_fmt yuv420p -still-picture 1", "a.avif");
    if (file.empty()) GTEST_SKIP() << "this ffmpeg writes no AVIF";
    EXPECT_EQ(tests::valueOf(checkMedia(file)), "64x32 AVIF picture, lat-long mono");
    EXPECT_NEAR(tests::valueOf(readPicture(file)).at(32, 16)[0], (200 - 16) * 255 / 219.0, 2);
    EXPECT_FALSE(readPicture(file, {63, 32}));
    std::string cut = readBytes(file);
    for (const size_t size : {cut.size() - 20, cut.size() / 2, size_t{40}}) {
        writeBytes(file, cut.substr(0, size));
        (void)readPicture(file);
    }
}

} // namespace
} // namespace shoal::media
