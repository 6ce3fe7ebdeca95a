#include "engine/media/SphericalMetadata.h"

#include "engine/media/Ffmpeg.h"
#include "tests/unit/media/TestFiles.h"

#include <bit>
#include <cstdlib>
#include <sstream>

namespace shoal::media {
namespace {

// Big endian; zeros before eight bytes.
std::string be(uint64_t value, int bytes) {
    std::string text;
    for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(i < 8 ? value >> (8 * i) & 0xff : 0);
    return text;
}

std::string box(const std::string& name, const std::string& payload) {
    return be(payload.size() + 8, 4) + name + payload;
}

std::string fullBox(const std::string& name, const std::string& payload) {
    return box(name, be(0, 4) + payload);
}

std::string fixed(double degrees) {
    return be(static_cast<uint32_t>(static_cast<int32_t>(degrees * 65536)), 4);
}

const std::string kHandler = fullBox("hdlr", be(0, 4) + "vide" + be(0, 12) + "v" + be(0, 1));

std::string sampleEntry(const std::string& children, int width = 2048, int height = 1024) {
    return box("avc1", be(0, 6) + be(1, 2) + be(0, 16) + be(static_cast<uint64_t>(width), 2) +
                           be(static_cast<uint64_t>(height), 2) + be(0, 50) + children);
}

std::string movie(const std::string& inEntry, const std::string& inTrack = "",
                  const std::string& inMovie = "") {
    const std::string table = box("stbl", fullBox("stsd", be(1, 4) + sampleEntry(inEntry)));
    return box("ftyp", "isom") +
           box("moov", inMovie + box("trak", inTrack + box("mdia", kHandler + box("minf", table))));
}

std::string sv3d(const std::string& projection, bool withHeader = true) {
    return box("sv3d", (withHeader ? fullBox("svhd", "test" + be(0, 1)) : "") +
                           box("proj", fullBox("prhd", fixed(30) + fixed(-15.5) + fixed(2)) + projection));
}

const std::string kEquirect = fullBox("equi", be(0, 16));

std::string v1(const std::string& values) {
    const std::string uuid("\xff\xcc\x82\x63\xf8\x55\x4a\x93\x88\x14\x58\x7a\x02\x52\x1f\xdd", 16);
    return box("uuid",
               uuid + "<?xml version=\"1.0\"?><rdf:SphericalVideo>" + values + "</rdf:SphericalVideo>");
}

const std::string kV1TopBottom = "<GSpherical:Spherical>true</GSpherical:Spherical>"
                                 "<GSpherical:ProjectionType>equirectangular</GSpherical:ProjectionType>"
                                 "<GSpherical:StereoMode>top-bottom</GSpherical:StereoMode>";

SphericalMetadata parsed(const std::string& bytes) {
    std::istringstream stream(bytes);
    return mp4Metadata(stream, bytes.size());
}

TEST(SphericalMetadata, V2InTheSampleEntry) {
    const auto m = parsed(movie(fullBox("st3d", be(2, 1)) + sv3d(kEquirect)));
    EXPECT_TRUE(m.present);
    EXPECT_EQ(m.version, 2);
    EXPECT_EQ(m.projection, Projection::Equirect);
    EXPECT_EQ(m.layout, Layout::LeftRight);
}

TEST(SphericalMetadata, V2WithoutTheMandatoryHeaderIsStillUnderstood) {
    EXPECT_EQ(parsed(movie(sv3d(kEquirect, false))).projection, Projection::Equirect);
}

TEST(SphericalMetadata, V2OtherProjections) {
    EXPECT_EQ(parsed(movie(sv3d(fullBox("cbmp", be(0, 8))))).projection, Projection::Cubemap);
    EXPECT_EQ(parsed(movie(sv3d(fullBox("mshp", be(0, 8))))).projection, Projection::Mesh);
}

TEST(SphericalMetadata, V2BoundsOfAHalfEnvironment) {
    const auto m = parsed(movie(sv3d(fullBox("equi", be(0, 8) + be(0x40000000, 4) + be(0x40000000, 4)))));
    EXPECT_EQ(m.missingLeft, 0.25f);
    EXPECT_EQ(m.missingRight, 0.25f);
    EXPECT_EQ(m.missingTop, 0);
    const auto nothingLeft =
        parsed(movie(sv3d(fullBox("equi", be(0, 8) + be(0xc0000000, 4) + be(0xc0000000, 4)))));
    EXPECT_EQ(nothingLeft.missingLeft, 0);
}

TEST(SphericalMetadata, V1InTheTrack) {
    const auto m = parsed(movie("", v1(kV1TopBottom)));
    EXPECT_TRUE(m.present);
    EXPECT_EQ(m.version, 1);
    EXPECT_EQ(m.projection, Projection::Equirect);
    EXPECT_EQ(m.layout, Layout::TopBottom);
}

TEST(SphericalMetadata, V1Cropping) {
    const auto m = parsed(
        movie("", v1("<GSpherical:Spherical>true</GSpherical:Spherical>"
                     "<GSpherical:FullPanoWidthPixels>4000</GSpherical:FullPanoWidthPixels>"
                     "<GSpherical:FullPanoHeightPixels>2000</GSpherical:FullPanoHeightPixels>"
                     "<GSpherical:CroppedAreaImageWidthPixels>2000</GSpherical:CroppedAreaImageWidthPixels>"
                     "<GSpherical:CroppedAreaImageHeightPixels>2000</GSpherical:CroppedAreaImageHeightPixels>"
                     "<GSpherical:CroppedAreaLeftPixels>1000</GSpherical:CroppedAreaLeftPixels>"
                     "<GSpherical:CroppedAreaTopPixels>0</GSpherical:CroppedAreaTopPixels>")));
    EXPECT_EQ(m.missingLeft, 0.25f);
    EXPECT_EQ(m.missingRight, 0.25f);
    EXPECT_EQ(m.missingTop, 0);
    EXPECT_EQ(m.missingBottom, 0);
}

TEST(SphericalMetadata, V1ThatSaysFalseIsNone) {
    EXPECT_FALSE(parsed(movie("", v1("<GSpherical:Spherical>false</GSpherical:Spherical>"))).present);
}

TEST(SphericalMetadata, V2WinsOverV1) {
    const auto m =
        parsed(movie(fullBox("st3d", be(0, 1)) + sv3d(fullBox("cbmp", be(0, 8))), v1(kV1TopBottom)));
    EXPECT_EQ(m.version, 2);
    EXPECT_EQ(m.projection, Projection::Cubemap);
    EXPECT_EQ(m.layout, Layout::Mono);
}

TEST(SphericalMetadata, StereoBoxAloneAddsToV1) {
    const auto m =
        parsed(movie(fullBox("st3d", be(2, 1)), v1("<GSpherical:Spherical>true</GSpherical:Spherical>")));
    EXPECT_EQ(m.version, 1);
    EXPECT_EQ(m.layout, Layout::LeftRight);
}

TEST(SphericalMetadata, NoneIsNotPresent) {
    const auto m = parsed(movie(""));
    EXPECT_FALSE(m.present);
    EXPECT_EQ(m.projection, Projection::Unknown);
    EXPECT_EQ(m.layout, Layout::Auto);
}

TEST(SphericalMetadata, AudioTracksAreIgnored) {
    std::string audio = movie(sv3d(kEquirect));
    audio.replace(audio.find("vide"), 4, "soun");
    EXPECT_FALSE(parsed(audio).present);
}

TEST(SphericalMetadata, LargeSizesAndSizesToTheEnd) {
    const std::string plain = movie(sv3d(kEquirect));
    // A 64-bit media box before the movie; nothing of its claimed 4 GiB is there to be skipped to.
    EXPECT_EQ(
        parsed(box("ftyp", "isom") + be(1, 4) + "free" + be(20, 8) + "1234" + plain.substr(12)).projection,
        Projection::Equirect);
    EXPECT_FALSE(parsed(be(1, 4) + "mdat" + be(uint64_t{1} << 40, 8) + plain).present);
    // moov as the last box, with size 0.
    std::string open = plain;
    open.replace(12, 4, be(0, 4));
    EXPECT_EQ(parsed(open).projection, Projection::Equirect);
}

// Every size field in turn gets absurd values; the answer does not matter, coming back does.
TEST(SphericalMetadata, LyingSizesAreSurvived) {
    const std::string good = movie(fullBox("st3d", be(1, 1)) + sv3d(kEquirect), v1(kV1TopBottom));
    for (size_t at = 0; at + 4 <= good.size(); ++at)
        for (const uint32_t lie : {0u, 1u, 7u, 8u, 9u, 0x7fffffffu, 0xffffffffu}) {
            std::string bad = good;
            bad.replace(at, 4, be(lie, 4));
            const auto m = parsed(bad);
            EXPECT_LE(m.missingTop + m.missingBottom, 1);
        }
    for (size_t length = 0; length < good.size(); ++length) parsed(good.substr(0, length));
}

TEST(SphericalMetadata, ABoxLargerThanItsParentEndsWithIt) {
    std::string bytes = movie(sv3d(kEquirect));
    const size_t at = bytes.find("sv3d") - 4;
    bytes.replace(at, 4, be(1000000, 4));
    EXPECT_EQ(parsed(bytes).projection, Projection::Equirect);
}

TEST(SphericalMetadata, DepthAndCountAreLimited) {
    std::string deep = kEquirect;
    for (int i = 0; i < 2000; ++i) deep = box("proj", deep);
    EXPECT_FALSE(parsed(movie(deep)).present);
    std::string many;
    for (int i = 0; i < 100000; ++i) many += box("free", "");
    EXPECT_FALSE(parsed(many + movie(sv3d(kEquirect))).present);
}

// --- Matroska: libavformat reads it, as VideoSource does.

std::string element(const std::string& id, const std::string& payload) {
    return id + be(uint64_t{0x10000000} | payload.size(), 4) + payload;
}

SphericalMetadata matroska(const std::string& inVideo) {
    const TempFolder folder;
    const std::string video =
        element("\xe0", element("\xb0", be(1920, 2)) + element("\xba", be(1080, 2)) + inVideo);
    const std::string track = element("\xd7", be(1, 1)) + element("\x83", be(1, 1)) + // number, type video
                              element("\x86", "V_VP8") + video;
    const std::string cluster = element("\x1f\x43\xb6\x75", element("\xe7", be(0, 1)));
    const std::string bytes = element("\x1a\x45\xdf\xa3", element("\x42\x82", "webm")) +
                              std::string("\x18\x53\x80\x67\x01\xff\xff\xff\xff\xff\xff\xff") +
                              element("\x16\x54\xae\x6b", element("\xae", track)) + cluster;
    writeBytes(folder / "a.webm", bytes);
    const Input input = openInput(folder / "a.webm");
    EXPECT_TRUE(input && input->nb_streams == 1);
    if (!input || input->nb_streams != 1) return {};
    EXPECT_EQ(input->streams[0]->codecpar->width, 1920);
    return matroskaMetadata(*input->streams[0],
                            std::span(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()));
}

const auto projection = [](uint64_t type) {
    return element("\x76\x70", std::string("\x76\x71\x81") + be(type, 1) +
                                   element("\x76\x73", be(std::bit_cast<uint32_t>(45.0f), 4)));
};

TEST(SphericalMetadata, MatroskaProjection) {
    const auto m = matroska(element("\x53\xb8", be(3, 1)) + projection(1));
    EXPECT_TRUE(m.present);
    EXPECT_EQ(m.projection, Projection::Equirect);
    EXPECT_EQ(m.layout, Layout::TopBottom);
}

TEST(SphericalMetadata, MatroskaStereoModes) {
    const struct {
        uint64_t mode;
        Layout layout;
    } kModes[] = {{0, Layout::Mono},
                  {1, Layout::LeftRight},
                  {2, Layout::TopBottom},
                  {3, Layout::TopBottom},
                  {11, Layout::LeftRight}};
    for (const auto& [mode, layout] : kModes)
        EXPECT_EQ(matroska(element("\x53\xb8", be(mode, 1)) + projection(1)).layout, layout) << mode;
    EXPECT_EQ(matroska(projection(1)).layout, Layout::Auto);
    EXPECT_EQ(matroska(element("\x53\xb8", be(3, 1))).layout, Layout::Auto) << "a flat stereo video";
}

TEST(SphericalMetadata, MatroskaMeshAndNone) {
    EXPECT_EQ(matroska(projection(3)).projection, Projection::Mesh);
    EXPECT_FALSE(matroska(projection(0)).present);
    EXPECT_FALSE(matroska("").present);
}

} // namespace
} // namespace shoal::media
