#include "engine/core/Random.h"
#include "engine/media/Check.h"
#include "engine/media/PictureHeader.h"
#include "tests/unit/media/TestFiles.h"

#include <opencv2/imgcodecs.hpp>

#include <sys/stat.h>

namespace shoal::media {
namespace {

ImageRgb8 noise8(int width, int height) {
    Random random(1);
    ImageRgb8 image(width, height);
    for (auto& value : image.pixels) value = static_cast<uint8_t>(random.below(256));
    return image;
}

class Pictures : public testing::Test {
  protected:
    const TempFolder folder;
};
using HdrPictures = Pictures;
using Check = Pictures;

// Radiance over twelve decades, beyond half floats.
ImageRgbF noiseF(int width, int height) {
    Random random(2);
    ImageRgbF image(width, height);
    for (auto& value : image.pixels) value = std::pow(10.0f, random.between(-6, 6));
    return image;
}

TEST_F(Pictures, PngRoundTripIsExact) {
    const ImageRgb8 image = noise8(37, 19);
    ASSERT_TRUE(writePng(folder / "a.png", image));
    const auto read = tests::valueOf(readPicture(folder / "a.png"));
    EXPECT_EQ(read.width, 37);
    EXPECT_EQ(read.height, 19);
    EXPECT_EQ(read.pixels, image.pixels);
}

TEST_F(Pictures, PngKeepsAlpha) {
    ImageRgba8 image(2, 1);
    image.pixels = {1, 2, 3, 4, 250, 251, 252, 0};
    ASSERT_TRUE(writePng(folder / "a.png", image));
    const cv::Mat bgra = cv::imread((folder / "a.png").string(), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(bgra.channels(), 4);
    EXPECT_EQ(bgra.at<cv::Vec4b>(0, 0), cv::Vec4b(3, 2, 1, 4));
    EXPECT_EQ(bgra.at<cv::Vec4b>(0, 1), cv::Vec4b(252, 251, 250, 0));
}

TEST_F(Pictures, ReadsEachKindByItsContent) {
    const ImageRgb8 image = noise8(24, 16);
    cv::Mat bgr(16, 24, CV_8UC3);
    for (int i = 0; i < 24 * 16; ++i)
        for (int c = 0; c < 3; ++c) bgr.data[3 * i + c] = image.pixels[3 * i + 2 - c];
    for (const char* extension : {".bmp", ".ppm", ".webp", ".png", ".tif"}) {
        const Path real = folder / (std::string("a") + extension), disguised = folder / "a.jpg";
        cv::imwrite(real.string(), bgr, {cv::IMWRITE_WEBP_QUALITY, 101}); // above 100: lossless
        std::filesystem::rename(real, disguised);
        const auto read = readPicture(disguised);
        ASSERT_TRUE(read) << extension << ": " << read.error().message();
        EXPECT_EQ(read->pixels, image.pixels) << extension;
    }
}

TEST_F(Pictures, SizeIsCheckedBeforeDecoding) {
    ASSERT_TRUE(writePng(folder / "a.png", noise8(40, 20)));
    EXPECT_TRUE(readPicture(folder / "a.png", {40, 20}));
    EXPECT_FALSE(readPicture(folder / "a.png", {39, 20}));
    EXPECT_FALSE(readPicture(folder / "a.png", {40, 19}));

    // A header that promises 2^31 - 1 squared, with a right checksum or not, is refused for its size.
    std::string bytes = readBytes(folder / "a.png");
    bytes.replace(16, 8, "\x7f\xff\xff\xff\x7f\xff\xff\xff");
    writeBytes(folder / "bomb.png", bytes);
    EXPECT_THAT(tests::errorOf(readPicture(folder / "bomb.png")).reason,
                testing::HasSubstr("2147483647x2147483647"));
}

TEST_F(Pictures, CutAndAlteredFilesAreNamedAsSuch) {
    cv::Mat picture(32, 64, CV_8UC3);
    cv::randu(picture, 0, 256);
    for (const char* name : {"a.png", "a.jpg"}) {
        cv::imwrite((folder / name).string(), picture);
        const std::string good = readBytes(folder / name);
        writeBytes(folder / name, good.substr(0, good.size() / 2));
        EXPECT_THAT(tests::errorOf(readPicture(folder / name)).reason, testing::HasSubstr("cut short"))
            << name;
    }
    cv::imwrite((folder / "a.png").string(), picture);
    std::string bytes = readBytes(folder / "a.png");
    bytes[bytes.size() / 2] ^= 1;
    writeBytes(folder / "a.png", bytes);
    EXPECT_THAT(tests::errorOf(readPicture(folder / "a.png")).reason, testing::HasSubstr("damaged"));
}

TEST_F(Pictures, AFileThatIsNoPictureIsRefusedByName) {
    writeBytes(folder / "text.png", "this is no picture");
    writeBytes(folder / "empty.png", "");
    ASSERT_EQ(::mkfifo((folder / "pipe.png").c_str(), 0600), 0);
    std::filesystem::create_directory(folder / "folder.png");
    for (const char* name : {"text.png", "empty.png", "pipe.png", "folder.png", "missing.png"}) {
        EXPECT_THAT(tests::errorOf(readPicture(folder / name)).message(), testing::HasSubstr(name)) << name;
        EXPECT_FALSE(readHdr(folder / name));
        EXPECT_FALSE(checkPicture(folder / name));
    }
}

TEST_F(HdrPictures, PfmAndExrRoundTripsAreExact) {
    const ImageRgbF image = noiseF(33, 17);
    for (const char* name : {"a.pfm", "a.exr"}) {
        ASSERT_TRUE(writeHdr(folder / name, image)) << name;
        const auto read = tests::valueOf(readHdr(folder / name));
        EXPECT_EQ(read.note(), "");
        EXPECT_EQ(read.radianceLin.width, 33);
        EXPECT_EQ(read.radianceLin.height, 17);
        EXPECT_EQ(read.radianceLin.pixels, image.pixels) << name;
    }
}

TEST_F(HdrPictures, RadianceKeepsEachPixelWithinItsSharedExponent) {
    const ImageRgbF image = noiseF(33, 17);
    ASSERT_TRUE(writeHdr(folder / "a.hdr", image));
    const auto read = tests::valueOf(readHdr(folder / "a.hdr"));
    for (int y = 0; y < 17; ++y)
        for (int x = 0; x < 33; ++x) {
            const float* wanted = image.at(x, y);
            const float* got = read.radianceLin.at(x, y);
            // The largest component has a mantissa of 128..255, truncated: below 1/128 of it, whatever the
            // component.
            const float bound = std::max({wanted[0], wanted[1], wanted[2]}) / 128;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], wanted[c], bound) << x << ' ' << y << ' ' << c;
        }
}

// Header and pixels by hand: (128, 64, 0) * 2^(129 - 136) = (1, 0.5, 0).
TEST_F(HdrPictures, RadianceFlatAndBothRunLengthCodes) {
    const auto picture = [&](int width, const std::string& pixels) {
        writeBytes(folder / "a.hdr",
                   "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X " + std::to_string(width) + "\n" + pixels);
        const auto read = readHdr(folder / "a.hdr");
        return read ? read->radianceLin.pixels : std::vector<float>{};
    };
    const std::string pixel("\x80\x40\x00\x81", 4), black("\x80\x40\x00\x00", 4);
    EXPECT_EQ(picture(2, pixel + black), (std::vector<float>{1, 0.5f, 0, 0, 0, 0}));
    // The old code: repeat the pixel before twice.
    EXPECT_EQ(picture(3, pixel + std::string("\1\1\1\2", 4)),
              (std::vector<float>{1, 0.5f, 0, 1, 0.5f, 0, 1, 0.5f, 0}));
    // The new one, 8 pixels: red as a run, green as copies, blue and exponent as runs.
    const std::string line = std::string("\2\2\0\x08", 4) + "\x88\x80" + "\x08" + "@@@@@@@@" +
                             std::string("\x88\0", 2) + "\x88\x81";
    std::vector<float> eight;
    for (int i = 0; i < 8; ++i) eight.insert(eight.end(), {1, 0.5f, 0});
    EXPECT_EQ(picture(8, line), eight);
    // A run over the line's end, a repeat without a pixel, too few bytes.
    EXPECT_TRUE(picture(8, std::string("\2\2\0\x08", 4) + "\x89\x80" + std::string(20, 'x')).empty());
    EXPECT_TRUE(picture(2, std::string("\1\1\1\1", 4) + pixel).empty());
    EXPECT_TRUE(picture(8, line.substr(0, line.size() - 1)).empty());
}

// Pixels '0' to '5' of two rows of three, in the order of each resolution line; exponent 136: mantissas are
// values.
TEST_F(HdrPictures, RadianceHeadersAreObeyed) {
    const auto read = [&](const std::string& header, const std::string& order) {
        std::string bytes = "#?RADIANCE\n" + header;
        for (const char pixel : order) bytes += std::string(3, pixel) + '\x88';
        writeBytes(folder / "a.hdr", bytes);
        return readHdr(folder / "a.hdr");
    };
    for (const auto& [line, order] : {std::pair("-Y 2 +X 3", "012345"),
                                      {"-Y 2 -X 3", "210543"},
                                      {"+Y 2 +X 3", "345012"},
                                      {"+Y 2 -X 3", "543210"},
                                      {"+X 3 -Y 2", "031425"},
                                      {"+X 3 +Y 2", "304152"},
                                      {"-X 3 -Y 2", "251403"},
                                      {"-X 3 +Y 2", "524130"}})
        for (const std::string end : {"\n", "\r\n"}) {
            const auto picture =
                tests::valueOf(read("FORMAT=32-bit_rle_rgbe" + end + end + line + end, order));
            ASSERT_EQ(picture.radianceLin.width, 3) << line;
            for (size_t i = 0; i < 18; ++i)
                EXPECT_EQ(picture.radianceLin.pixels[i], static_cast<float>('0' + i / 3)) << line;
        }
    const struct {
        const char* lines;
        float red, green, blue; // of '0', which is 48
        const char* note;
    } kHeaders[] = {
        {"EXPOSURE=4\nEXPOSURE= 0.5\n", 24, 24, 24, "divided by its exposure 2"},
        {"COLORCORR=1 2 4\r\n", 48, 24, 12, "divided by its exposure 1, 2, 4"},
        {"PIXASPECT=2\n", 48, 48, 48, "its pixels count as square"},
        {"GAMMA=1\nPRIMARIES=0 0 0 0 0 0 0 0\n", 48, 48, 48,
         "its primaries span no colours and count as those of Rec. 709"},
        {"FORMAT=32-bit_rle_xyze\n", 48, 48, 48, "converted to the primaries of Rec. 709"},
        {"PRIMARIES=.708 .292 .17 .797 .131 .046 .3127 .329\n", 48, 48, 48,
         "converted to the primaries of Rec. 709"},
    };
    for (const auto& each : kHeaders) {
        const auto picture = tests::valueOf(read(each.lines + std::string("\n-Y 1 +X 1\n"), "0"));
        const float* p = picture.radianceLin.at(0, 0);
        EXPECT_NEAR(p[0], each.red, 1e-3f) << each.lines;
        EXPECT_NEAR(p[1], each.green, 1e-3f) << each.lines;
        EXPECT_NEAR(p[2], each.blue, 1e-3f) << each.lines;
        EXPECT_EQ(picture.notes, std::vector<std::string>{each.note});
    }
    for (const auto& [bad, reason] :
         {std::pair("EXPOSURE=0\n", "states an exposure of 0, which its light cannot be divided by"),
          {"COLORCORR=1 -1 1\n", "states an exposure of 1, -1, 1, which its light cannot be divided by"},
          {"GAMMA=2.2\n", "states a GAMMA of 2.2; only linear light (1) is read"}})
        EXPECT_EQ(read(bad + std::string("\n-Y 1 +X 1\n"), "0").error().reason, reason);
    for (const char* bad : {"COLORCORR=1\n\n-Y 1 +X 1\n", "FORMAT=other\n\n-Y 1 +X 1\n", "\n-Y 1 +Y 1\n",
                            "\n-Y 1\n", "\n-Y 1 +X 1", "-Y 1 +X 1\n"})
        EXPECT_FALSE(read(bad, "0000")) << bad;
}

TEST_F(HdrPictures, PfmIsReadFromTheBottomInEitherByteOrderAndInGrey) {
    const auto floats = [](std::initializer_list<float> values, bool bigEndian) {
        std::string text;
        for (const float value : values) {
            std::string four(reinterpret_cast<const char*>(&value), 4);
            if (bigEndian) std::reverse(four.begin(), four.end());
            text += four;
        }
        return text;
    };
    writeBytes(folder / "big.pfm", "PF\n1 2\n2.0\n" + floats({1, 2, 3, 4, 5, 6}, true));
    const auto big = tests::valueOf(readHdr(folder / "big.pfm"));
    EXPECT_EQ(big.radianceLin.pixels, (std::vector<float>{8, 10, 12, 2, 4, 6})); // doubled by the scale
    writeBytes(folder / "alpha.pfm", "PF4\r\n1 2\r\n-1.0\r\n" + floats({1, 2, 3, 0, 4, 5, 6, 0}, false));
    EXPECT_EQ(tests::valueOf(readHdr(folder / "alpha.pfm")).radianceLin.pixels,
              (std::vector<float>{4, 5, 6, 1, 2, 3}));
    writeBytes(folder / "grey.pfm", "Pf\n1 2\n-1.0\n" + floats({1, 2}, false));
    const auto grey = tests::valueOf(readHdr(folder / "grey.pfm"));
    EXPECT_EQ(grey.radianceLin.pixels, (std::vector<float>{2, 2, 2, 1, 1, 1}));
}

TEST_F(HdrPictures, ValuesThatAreNoLightAreReplacedAndCounted) {
    constexpr float kInf = std::numeric_limits<float>::infinity();
    ImageRgbF image(2, 2);
    image.pixels = {1, -2, std::nanf(""), kInf, -kInf, 78944, 3e38f, 0, 1, 2, 3, kMaxRadiance}; // of a sun
    for (const char* name : {"a.pfm", "a.exr"}) {
        ASSERT_TRUE(writeHdr(folder / name, image));
        const auto read = tests::valueOf(readHdr(folder / name));
        EXPECT_EQ(read.radianceLin.pixels, (std::vector<float>{1, 0, 0, kMaxRadiance, 0, 78944, kMaxRadiance,
                                                               0, 1, 2, 3, kMaxRadiance}))
            << name;
        EXPECT_EQ(read.note(), "; 4 components were NaN, infinite or negative and are replaced; 1 components "
                               "were above 10^9 and count as 10^9");
    }
}

TEST_F(HdrPictures, LimitsAndKindsAreChecked) {
    for (const char* name : {"a.pfm", "a.exr", "a.hdr"}) {
        ASSERT_TRUE(writeHdr(folder / name, noiseF(40, 20)));
        EXPECT_TRUE(readHdr(folder / name, {40, 20})) << name;
        EXPECT_FALSE(readHdr(folder / name, {39, 20})) << name;
        EXPECT_FALSE(readHdr(folder / name, {40, 19})) << name;
        EXPECT_FALSE(readPicture(folder / name)) << name;
    }
    ASSERT_TRUE(writePng(folder / "a.png", noise8(4, 2)));
    EXPECT_FALSE(readHdr(folder / "a.png"));
    EXPECT_FALSE(writeHdr(folder / "a.jpg", noiseF(4, 2)));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.jpg"));
}

TEST_F(Check, PicturesAreDescribed) {
    ASSERT_TRUE(writePng(folder / "pano.png", noise8(64, 32)));
    EXPECT_EQ(*checkPicture(folder / "pano.png"), "64x32 PNG picture, lat-long mono");
    // Squares and 4:1 strips are two eyes' pictures only where they look so, as in play.
    for (const auto& [width, height] : {std::pair(48, 32), {64, 64}, {128, 32}}) {
        ASSERT_TRUE(writePng(folder / "photo.png", noise8(width, height)));
        EXPECT_NE(checkPicture(folder / "photo.png")->find("an ordinary picture, which is grown"),
                  std::string::npos);
    }
    ImageRgbF bad(4, 2);
    bad.pixels[5] = -1;
    ASSERT_TRUE(writeHdr(folder / "bad.pfm", bad));
    EXPECT_NE(checkPicture(folder / "bad.pfm")->find("1 components"), std::string::npos);
    EXPECT_EQ(readHdr(folder / "bad.pfm", {}, "a").error().reason, kNoLayers);
    for (const char* name : {"pano.png", "bad.pfm"})
        EXPECT_EQ(checkMedia(folder / name, "a").error().reason, kNoLayers);
}

} // namespace
} // namespace shoal::media
