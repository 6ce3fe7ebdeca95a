#include "engine/environment/PhotoEnvironment.h"
#include "engine/media/Check.h"
#include "engine/media/PictureHeader.h"
#include "tests/unit/media/TestFiles.h"

#include <lcms2.h>
#include <opencv2/imgcodecs.hpp>
#include <zlib.h>

namespace shoal::media {
namespace {

struct Metadata {
    int orientation = 1;
    std::string xmp, profile;
    std::vector<std::pair<std::string, std::string>> chunks = {}; // further ones of PNG
};

// Returns a TIFF structure, of short and byte values, whose data begin behind the directory; the sides of
// tiles are of 64 bits.
std::string tiff(bool little, std::vector<std::pair<int, std::string>> entries, const std::string& pixels) {
    const auto of = [&](uint64_t value, int bytes) { return number(value, bytes, little); };
    std::erase_if(entries, [](const auto& entry) { return entry.second.empty(); });
    const size_t end = 8 + 2 + 12 * entries.size() + 4;
    std::string directory = of(entries.size(), 2), data = pixels;
    for (const auto& [tag, value] : entries) {
        const auto [type, size] = tag == 700 || tag == 34675 ? std::pair(1, 1)
                                  : tag == 322 || tag == 323 ? std::pair(16, 8)
                                                             : std::pair(3, 2);
        directory +=
            of(tag, 2) + of(type, 2) + of(value.size() / size, 4) +
            (value.size() > 4 ? of(end + data.size(), 4) : (value + std::string(3, '\0')).substr(0, 4));
        if (value.size() > 4) data += value;
    }
    return (little ? std::string("II*\0", 4) : std::string("MM\0*", 4)) + of(8, 4) + directory + of(0, 4) +
           data;
}

std::string tiffOf(const cv::Mat& bgr, const Metadata& m, bool little) {
    std::string pixels;
    for (const cv::Vec3b& p : cv::Mat_<cv::Vec3b>(bgr))
        pixels += {static_cast<char>(p[2]), static_cast<char>(p[1]), static_cast<char>(p[0])};
    const auto of = [&](int value) { return number(value, 2, little); };
    std::vector<std::pair<int, std::string>> entries = {
        {256, of(bgr.cols)},
        {257, of(bgr.rows)},
        {258, of(8) + of(8) + of(8)},
        {259, of(1)},
        {262, of(2)},
        {273, of(14 + 12 * (10 + !m.xmp.empty() + !m.profile.empty()))},
        {274, of(m.orientation)},
        {277, of(3)},
        {278, of(bgr.rows)},
        {279, of(3 * bgr.cols * bgr.rows)},
        {700, m.xmp},
        {34675, m.profile}};
    return tiff(little, entries, pixels);
}

// Returns a file of the kind (an ending) with the metadata. packed: PNG's XMP is compressed.
std::string fileOf(const std::string& kind, const cv::Mat& bgr, const Metadata& m, bool packed = false) {
    if (kind == ".tif") return tiffOf(bgr, m, packed);
    std::vector<uint8_t> coded;
    cv::imencode(kind, bgr, coded, {cv::IMWRITE_WEBP_QUALITY, 101, cv::IMWRITE_JPEG_QUALITY, 100});
    std::string file(coded.begin(), coded.end());
    const std::string oriented = tiff(packed, {{274, number(m.orientation, 2, packed)}}, "");
    const auto zip = [](const std::string& text) {
        std::string zipped(compressBound(text.size()), '\0');
        uLongf size = zipped.size();
        compress(reinterpret_cast<Bytef*>(zipped.data()), &size, reinterpret_cast<const Bytef*>(text.data()),
                 text.size());
        return zipped.substr(0, size);
    };
    if (kind == ".jpg") {
        const auto segment = [](char marker, const std::string& payload) {
            return std::string("\xff") + marker + number(payload.size() + 2, 2, false) + payload;
        };
        const std::string icc("ICC_PROFILE\0", 12);
        const size_t half = m.profile.size() / 2; // in two parts, the second one first
        return file.insert(2, segment('\xe1', std::string("Exif\0\0", 6) + oriented) +
                                  segment('\xe1', std::string("http://ns.adobe.com/xap/1.0/\0", 29) + m.xmp) +
                                  segment('\xe2', icc + "\2\2" + m.profile.substr(half)) +
                                  segment('\xe2', icc + "\1\2" + m.profile.substr(0, half)));
    }
    const bool png = kind == ".png";
    const auto chunk = [&](const std::string& name, const std::string& data) {
        if (data.empty()) return data;
        const std::string named = name + data;
        const auto sum =
            crc32(0, reinterpret_cast<const Bytef*>(named.data()), static_cast<uInt>(named.size()));
        return png ? number(data.size(), 4, false) + named + number(sum, 4, false)
                   : name + number(data.size(), 4, true) + data + std::string(data.size() & 1, '\0');
    };
    std::string more;
    for (const auto& [name, data] : m.chunks) more += chunk(name, data);
    if (png)
        return file.insert(
            33, more + chunk("iCCP", m.profile.empty() ? "" : std::string("p\0\0", 3) + zip(m.profile)) +
                    chunk("eXIf", oriented) +
                    chunk("iTXt", std::string("XML:com.adobe.xmp\0", 18) + (packed ? '\1' : '\0') +
                                      std::string("\0en\0\0", 5) + (packed ? zip(m.xmp) : m.xmp)));
    const std::string chunks =
        "WEBP" +
        chunk("VP8X", number(0x2c, 4, true) + number(bgr.cols - 1, 3, true) + number(bgr.rows - 1, 3, true)) +
        chunk("ICCP", m.profile) + file.substr(12) + chunk("EXIF", oriented) + chunk("XMP ", m.xmp);
    return "RIFF" + number(chunks.size(), 4, true) + chunks;
}

constexpr const char* kNone = "";
constexpr const char* kConverted = "; converted to sRGB from the colours that it states";
constexpr const char* kIgnored = "; its colour profile is damaged or not for its colours, and is ignored";

constexpr const char* kKinds[] = {".jpg", ".png", ".webp", ".tif"};

class Photos : public testing::Test {
  protected:
    Photo read(const std::string& kind, const cv::Mat& bgr, const Metadata& m, bool packed = false) {
        writeBytes(folder / ("a" + kind), fileOf(kind, bgr, m, packed));
        return tests::valueOf(readPhoto(folder / ("a" + kind)));
    }
    const TempFolder folder;
};

std::string cornersOf(const ImageRgb8& p) {
    std::string names;
    for (const auto& [x, y] :
         {std::pair(2, 2), {p.width - 3, 2}, {2, p.height - 3}, {p.width - 3, p.height - 3}}) {
        const uint8_t* c = p.at(x, y);
        names += c[0] > 128 ? (c[1] > 128 ? 'W' : 'R') : c[1] > 128 ? 'G' : c[2] > 128 ? 'B' : '?';
    }
    return names;
}

// CIPA DC-008, tag 274: the sides on which the first stored row and column lie.
TEST_F(Photos, AreTurnedUprightInAllEightWays) {
    cv::Mat stored(16, 32, CV_8UC3);
    stored({0, 0, 16, 8}) = cv::Scalar(0, 0, 255);
    stored({16, 0, 16, 8}) = cv::Scalar(0, 255, 0);
    stored({0, 8, 16, 8}) = cv::Scalar(255, 0, 0);
    stored({16, 8, 16, 8}) = cv::Scalar::all(255);
    constexpr const char* kUpright[] = {"RGBW", "RGBW", "GRWB", "WBGR", "BWRG",
                                        "RBGW", "BRWG", "WGBR", "GWRB", "RGBW"};
    for (const std::string kind : kKinds)
        for (int orientation = 0; orientation <= 9; ++orientation) // 0 and 9: none
            for (const bool little : {false, true}) {
                const Photo photo = read(kind, stored, {.orientation = orientation}, little);
                EXPECT_EQ(cornersOf(photo.picture), kUpright[orientation]) << kind << orientation;
                EXPECT_EQ(photo.picture.width, orientation >= 5 && orientation <= 8 ? 16 : 32) << kind;
            }
}

// The orientations are those that libavif writes and reads for turns and mirrors (ISO
// 23008-12, 6.5.10, 6.5.12).
TEST_F(Photos, AvifBoxesAreObeyedWithinBounds) {
    const auto size = [](uint64_t width, uint64_t height) {
        return box("ispe", std::string(4, '\0') + number(width, 4, false) + number(height, 4, false));
    };
    const auto file = [&](const std::string& properties) {
        return box("ftyp", std::string("avif\0\0\0\0mif1", 12)) +
               box("meta",
                   std::string(4, '\0') + box("hdlr", "pict") + box("iprp", box("ipco", properties))) +
               box("mdat", size(9999, 9999));
    };
    const auto bytesOf = [](const std::string& text) {
        return std::vector<uint8_t>(text.begin(), text.end());
    };
    constexpr int kOrientations[4][3] = {{1, 4, 2}, {8, 5, 7}, {3, 2, 4}, {6, 7, 5}};
    for (int turns = 0; turns < 4; ++turns)
        for (int mirror = -1; mirror < 2; ++mirror) {
            const std::string mirrored = mirror < 0 ? "" : box("imir", number(mirror, 1, true));
            const auto bytes = bytesOf(file(size(8, 4) + size(32, 16) + box("colr", "profICC") +
                                            box("irot", number(turns, 1, true)) + mirrored));
            const auto header = tests::valueOf(readPictureHeader(bytes));
            EXPECT_EQ(std::pair(header.size.width, header.size.height), std::pair(int64_t{32}, int64_t{16}));
            const PhotoMetadata metadata = photoMetadata(bytes, PictureKind::Avif);
            EXPECT_EQ(metadata.orientation, kOrientations[turns][mirror + 1]) << turns << mirror;
            EXPECT_EQ(metadata.profile, bytesOf("ICC"));
        }
    const std::string whole = file(size(32, 16) + box("irot", "\1"));
    for (size_t cut = 0; cut < whole.size(); ++cut) {
        const auto bytes = bytesOf(whole.substr(0, cut));
        (void)readPictureHeader(bytes);
        (void)photoMetadata(bytes, PictureKind::Avif);
    }
}

std::string gpano(const std::string& part, const std::string& pose = "") {
    return R"(<rdf:Description GPano:ProjectionType="equirectangular" GPano:FullPanoWidthPixels="8000"
        GPano:FullPanoHeightPixels="4000" )" +
           part + R"( GPano:CroppedAreaLeftPixels="1000">
        <GPano:CroppedAreaTopPixels>1250</GPano:CroppedAreaTopPixels>)" +
           pose + "</rdf:Description>";
}
const std::string kPart =
    R"(GPano:CroppedAreaImageWidthPixels="6000" GPano:CroppedAreaImageHeightPixels="1500")";

TEST_F(Photos, ArePlacedWhereTheyBelongInAllKinds) {
    const cv::Mat pixels(24, 96, CV_8UC3, cv::Scalar::all(200));
    for (const std::string kind : kKinds)
        for (const bool packed : {false, true}) {
            const Photo photo = read(kind, pixels, {.xmp = gpano(kPart)}, packed);
            ASSERT_TRUE(photo.metadata.isPart()) << kind;
            const auto [fullWidth, fullHeight, left, top, width, height] = *photo.metadata.placement;
            EXPECT_EQ((std::array{fullWidth, fullHeight, left, top, width, height}),
                      (std::array{8000, 4000, 1000, 1250, 6000, 1500}));
            const Path file = folder / ("a" + kind);
            EXPECT_NE(checkPicture(file)->find("6000x1500 at 1000, 1250 of 8000x4000"), std::string::npos);
            const auto whole =
                tests::valueOf(environment::environmentFrom(file, photo.picture, photo.metadata, {}));
            EXPECT_EQ(whole.picture.width, 2 * whole.picture.height);
        }
    for (const char* wrong :
         {R"(GPano:CroppedAreaImageWidthPixels="9000" GPano:CroppedAreaImageHeightPixels="1500")",
          R"(GPano:CroppedAreaImageWidthPixels="-1")"}) {
        const Photo photo = read(".png", pixels, {.xmp = gpano(wrong)});
        EXPECT_FALSE(photo.metadata.placement);
        EXPECT_NE(photo.note().find("contradicts itself"), std::string::npos);
    }
    EXPECT_EQ(read(".png", pixels, {.xmp = "<x/>"}).note(), "");
}

// Google: pitch is that of the picture's middle; as roll increases, the horizon turns counterclockwise in it.
TEST_F(Photos, AreLevelledByTheirPose) {
    const std::string pose = R"(<GPano:PoseHeadingDegrees>90</GPano:PoseHeadingDegrees>
        <GPano:PosePitchDegrees>20</GPano:PosePitchDegrees><GPano:PoseRollDegrees>30.0</GPano:PoseRollDegrees>)";
    const Photo photo =
        read(".webp", cv::Mat(32, 64, CV_8UC3, cv::Scalar::all(9)), {.xmp = gpano(kPart, pose)});
    const glm::mat3 env = glm::mat3_cast(photo.metadata.envFromPhoto());
    const auto near = [](const glm::vec3& a, const glm::vec3& b) { return glm::length(a - b) < 1e-6f; };
    const float p = glm::radians(20.0f), r = glm::radians(30.0f);
    EXPECT_TRUE(near(env * glm::vec3(0, 0, -1), {0, std::sin(p), -std::cos(p)}));
    const glm::mat3 level = glm::mat3_cast(PhotoMetadata{.roll_deg = 30}.envFromPhoto());
    EXPECT_TRUE(near(glm::transpose(level) * glm::vec3(0, 1, 0), {-std::sin(r), std::cos(r), 0}));
    EXPECT_NE(photo.note().find("pitch 20 and roll 30 degrees"), std::string::npos) << photo.note();
}

// Returns an RGB profile of Rec. 709's primaries in this order and this gamma (0: sRGB's curve), or a grey
// one.
std::string profileOf(std::array<int, 3> order, double gamma, bool grey = false) {
    constexpr cmsCIExyY kWhite = {0.3127, 0.329, 1},
                        kPrimaries[] = {{0.64, 0.33, 1}, {0.3, 0.6, 1}, {0.15, 0.06, 1}};
    const double srgb[] = {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045};
    cmsToneCurve* curve =
        gamma > 0 ? cmsBuildGamma(nullptr, gamma) : cmsBuildParametricToneCurve(nullptr, 4, srgb);
    const auto of = [&](int i) { return kPrimaries[order[i]]; };
    const cmsCIExyYTRIPLE primaries = {of(0), of(1), of(2)};
    cmsToneCurve* curves[] = {curve, curve, curve};
    const cmsHPROFILE profile =
        grey ? cmsCreateGrayProfile(&kWhite, curve) : cmsCreateRGBProfile(&kWhite, &primaries, curves);
    cmsUInt32Number size = 0;
    cmsSaveProfileToMem(profile, nullptr, &size);
    std::string bytes(size, '\0');
    cmsSaveProfileToMem(profile, bytes.data(), &size);
    cmsCloseProfile(profile);
    cmsFreeToneCurve(curve);
    return bytes;
}

TEST_F(Photos, AreConvertedToSrgbByTheirProfiles) {
    cv::Mat pixels(16, 32, CV_8UC3, cv::Scalar(30, 120, 200)); // blue first
    const auto expect = [&](const std::string& kind, const std::string& profile, std::array<int, 3> wanted,
                            const char* use, int within = 2) {
        const Photo photo = read(kind, pixels, {.profile = profile});
        EXPECT_EQ(photo.colourNote, use) << kind;
        for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(photo.picture.at(9, 9)[c], wanted[c], within) << kind << c;
    };
    const auto coded = [](double linear) { // IEC 61966-2-1
        return static_cast<int>(std::lround(255 * (1.055 * std::pow(linear / 255, 1 / 2.4) - 0.055)));
    };
    for (const std::string kind : kKinds) {
        expect(kind, profileOf({1, 0, 2}, 0), {120, 200, 30}, kConverted);
        expect(kind, profileOf({0, 1, 2}, 1), {coded(200), coded(120), coded(30)}, kConverted, 3);
        expect(kind, profileOf({0, 1, 2}, 1, true), {200, 120, 30}, kIgnored);
        expect(kind, "no profile, which is damaged", {200, 120, 30}, kIgnored);
        expect(kind, "", {200, 120, 30}, kNone);
    }
    expect(".png", profileOf({0, 1, 2}, 0), {200, 120, 30}, kNone, 0);
    pixels = cv::Scalar::all(55);
    expect(".tif", profileOf({0, 1, 2}, 1, true), {coded(55), coded(55), coded(55)}, kConverted);
}

// PNG specification, sections 11.3.2.1, 11.3.2.2 and 4.3: what sRGB or iCCP states goes before these.
TEST_F(Photos, PngsAreConvertedFromTheirGammaAndPrimaries) {
    const cv::Mat pixels(16, 32, CV_8UC3, cv::Scalar(30, 120, 200)); // blue first
    const auto big = [](std::initializer_list<uint64_t> values) {
        std::string text;
        for (const uint64_t value : values) text += number(value, 4, false);
        return text;
    };
    const std::string rec709 = big({31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000}),
                      swapped = big({31270, 32900, 30000, 60000, 64000, 33000, 15000, 6000});
    const struct {
        std::vector<std::pair<std::string, std::string>> chunks;
        std::array<int, 3> wanted;
        const char* use;
    } kCases[] = {
        {{{"gAMA", big({45455})}, {"cHRM", rec709}}, {200, 120, 30}, kNone},
        {{{"cHRM", swapped}}, {120, 200, 30}, kConverted},
        {{{"sRGB", std::string(1, '\0')}, {"cHRM", swapped}}, {200, 120, 30}, kNone},
        {{{"cHRM", std::string(32, '\0')}}, {200, 120, 30}, kNone},
        // 255 (1.055 (c / 255)^(1 / 2.4) - 0.055)
        {{{"gAMA", big({100000})}}, {229, 182, 96}, kConverted},
    };
    for (const auto& each : kCases) {
        const Photo photo = read(".png", pixels, {.chunks = each.chunks});
        EXPECT_EQ(photo.colourNote, each.use) << each.chunks[0].first;
        for (size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(photo.picture.at(9, 9)[c], each.wanted[c], 3) << each.chunks[0].first << c;
    }
}

// Every other cut of a JPEG is refused, or loses nothing of the picture.
TEST_F(Photos, AJpegMayLackItsEndMarkAlone) {
    cv::Mat pixels(40, 64, CV_8UC3);
    cv::randu(pixels, 0, 256);
    for (const int progressive : {0, 1}) {
        std::vector<uint8_t> jpeg;
        cv::imencode(".jpg", pixels, jpeg, {cv::IMWRITE_JPEG_PROGRESSIVE, progressive});
        const std::string whole(jpeg.begin(), jpeg.end());
        const Path file = folder / "a.jpg";
        writeBytes(file, whole);
        const ImageRgb8 wanted = tests::valueOf(readPicture(file));
        for (size_t missing = 1; missing < whole.size() - 20; missing += missing < 99 ? 1 : 7) {
            writeBytes(file, whole.substr(0, whole.size() - missing));
            const auto cut = readPicture(file);
            EXPECT_EQ(cut.ok(), missing <= 2) << progressive << ' ' << missing;
            EXPECT_TRUE(!cut || cut->pixels == wanted.pixels) << progressive << ' ' << missing;
        }
    }
}

TEST_F(Photos, TiffsSizesAreCheckedBeforeDecoding) {
    const std::string good = tiffOf(cv::Mat(8, 16, CV_8UC3, cv::Scalar::all(1)), {}, true);
    const auto changed = [&](int tag, int to, int value) { // of a short entry
        std::string bytes = good;
        const size_t at = bytes.find(number(tag, 2, true) + number(3, 2, true), 8);
        bytes.replace(at, 2, number(to, 2, true));
        writeBytes(folder / "a.tif", bytes.replace(at + 8, 2, number(value, 2, true)));
        return readPicture(folder / "a.tif", {16, 8});
    };
    EXPECT_TRUE(changed(256, 256, 16));
    EXPECT_FALSE(changed(256, 256, 17));
    EXPECT_FALSE(changed(257, 257, 0));
    EXPECT_EQ(tests::valueOf(mediaKind(folder / "a.tif")), MediaKind::Photo);
    EXPECT_FALSE(changed(274, 254, 1)) << "a raw photo's thumbnail";

    // libtiff takes memory for such a tile, whose sides are of BigTIFF's type.
    for (const bool little : {true, false}) {
        const std::string side = number(1 << 16, 8, little);
        const std::string tiled =
            tiff(little,
                 {{256, number(16, 2, little)}, {257, number(8, 2, little)}, {322, side}, {323, side}}, "");
        const std::vector<uint8_t> bytes(tiled.begin(), tiled.end());
        EXPECT_EQ(tiffNumber(bytes, TiffTag::TileWidth), 1u << 16);
        EXPECT_FALSE(readPictureHeader(bytes));
    }
}

// Made of one panorama; see the data's README.
TEST_F(Photos, SharedOnesAreAsTheirMetadataSay) {
    const auto shared = [](const char* name) { return sharedData(std::string("files/") + name); };
    if (shared("pano.png").empty()) GTEST_SKIP() << "no shared files/pano.png";
    const ImageRgb8 pano = tests::valueOf(readPicture(shared("pano.png")));
    const auto expect = [&](const char* name, double most, const char* said) {
        const Photo photo = tests::valueOf(readPhoto(shared(name)));
        const auto made =
            tests::valueOf(environment::environmentFrom(shared(name), photo.picture, photo.metadata, {}));
        ASSERT_EQ(made.picture.width, pano.width) << name;
        ASSERT_EQ(made.picture.height, pano.height) << name;
        double sum = 0;
        ImageRgb8 wanted;
        makeUpright(pano, photo.metadata.orientation, wanted);
        const size_t quarter = pano.pixels.size() / 4; // the rows that crop.png holds
        for (size_t i = quarter; i < 3 * quarter; ++i)
            sum += std::abs(wanted.pixels[i] - made.picture.pixels[i]);
        EXPECT_LE(sum / static_cast<double>(2 * quarter), most) << name;
        EXPECT_NE(checkPicture(shared(name))->find(said), std::string::npos) << *checkPicture(shared(name));
    };
    expect("rot.webp", 0, "its orientation 3");
    expect("crop.png", 2, "1024x256 at 0, 128 of 1024x512");
    expect("icc_swap.jpg", 3, "converted to sRGB");
    expect("gp.jpg", 3, "pitch 20 and roll 30 degrees");
}

// Found by tests/fuzz: OpenCV gave a damaged WebP to its decoder of DICOM, which ended the program.
TEST_F(Photos, ADamagedWebpIsNotTakenForDicom) {
    const Path file = tests::sourceFolder() / "tests/fuzz/regressions/Pictures/webp_with_dicom_mark";
    EXPECT_THAT(tests::errorOf(readPhoto(file, {2048, 2048})).reason,
                testing::HasSubstr("cannot be decoded"));
}

} // namespace
} // namespace shoal::media
