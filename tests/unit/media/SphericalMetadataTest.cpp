#include "engine/media/SphericalMetadata.h"

#include "engine/media/Ffmpeg.h"
#include "tests/unit/media/TestFiles.h"

#include <bit>

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
    return box("ftyp", "isom" + be(0, 4)) +
           box("moov", inMovie + box("trak", box("mdia", kHandler + box("minf", table)) + inTrack));
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

const std::string kV1 = "<GSpherical:Spherical>true</GSpherical:Spherical>"
                        "<GSpherical:Stitched>true</GSpherical:Stitched>"
                        "<GSpherical:StitchingSoftware>test</GSpherical:StitchingSoftware>"
                        "<GSpherical:ProjectionType>equirectangular</GSpherical:ProjectionType>";
const std::string kV1TopBottom = kV1 + "<GSpherical:StereoMode>top-bottom</GSpherical:StereoMode>";

// Reads the metadata of a file of these bytes, which hold one stream.
SphericalMetadata parsed(const std::string& bytes) {
    const TempFolder folder;
    const Path file = folder / "a";
    writeBytes(file, bytes);
    const Input input = openInput(file);
    EXPECT_TRUE(input && input->nb_streams == 1);
    if (!input || input->nb_streams != 1) return {};
    return sphericalMetadata(*input, *input->streams[0], file);
}

// --- Matroska: libavformat reads it, as VideoSource does.

std::string element(const std::string& id, const std::string& payload) {
    return id + be(uint64_t{0x10000000} | payload.size(), 4) + payload;
}

SphericalMetadata matroska(const std::string& inVideo) {
    const std::string video =
        element("\xe0", element("\xb0", be(1920, 2)) + element("\xba", be(1080, 2)) + inVideo);
    const std::string track = element("\xd7", be(1, 1)) + element("\x83", be(1, 1)) + // number, type video
                              element("\x86", "V_VP8") + video;
    const std::string cluster = element("\x1f\x43\xb6\x75", element("\xe7", be(0, 1)));
    return parsed(element("\x1a\x45\xdf\xa3", element("\x42\x82", "webm")) +
                  std::string("\x18\x53\x80\x67\x01\xff\xff\xff\xff\xff\xff\xff") +
                  element("\x16\x54\xae\x6b", element("\xae", track)) + cluster);
}

const auto projection = [](uint64_t type) {
    return element("\x76\x70", std::string("\x76\x71\x81") + be(type, 1) +
                                   element("\x76\x73", be(std::bit_cast<uint32_t>(45.0f), 4)));
};

const std::string kCube = fullBox("cbmp", be(0, 8)), kMesh = fullBox("mshp", be(0, 8));

std::string stereoBox(uint64_t mode) { return fullBox("st3d", be(mode, 1)); }
std::string stereoMode(uint64_t mode) { return element("\x53\xb8", be(mode, 1)); }

TEST(SphericalMetadata, IsUnderstoodAsItIsWritten) {
    using enum Projection;
    using enum Layout;
    const std::string mesh = movie(sv3d(kMesh)), media = box("mdat", std::string(100000, 'x'));
    const struct {
        const char* what;
        SphericalMetadata read;
        Projection projection;
        Layout layout;
    } kRows[] = {
        {"V2", parsed(movie(stereoBox(2) + sv3d(kEquirect))), Equirect, LeftRight},
        {"V2 without its header", parsed(movie(sv3d(kEquirect, false))), Equirect, Auto},
        {"a cube without a header", parsed(movie(sv3d(kCube, false))), Cubemap, Auto},
        {"a cube", parsed(movie(sv3d(kCube))), Cubemap, Auto},
        {"a mesh", parsed(mesh), Mesh, Auto},
        {"a mesh behind the pictures", parsed(mesh.substr(0, 16) + media + mesh.substr(16)), Mesh, Auto},
        {"V1", parsed(movie("", v1(kV1TopBottom))), Equirect, TopBottom},
        {"V1 without who stitched",
         parsed(movie("", v1("<GSpherical:Spherical>true</GSpherical:Spherical>"
                             "<GSpherical:StereoMode>left-right</GSpherical:StereoMode>"))),
         Equirect, LeftRight},
        {"V2 wins over V1", parsed(movie(stereoBox(0) + sv3d(kCube), v1(kV1TopBottom))), Cubemap, Mono},
        {"a stereo box beside V1", parsed(movie(stereoBox(2), v1(kV1))), Equirect, LeftRight},
        {"Matroska", matroska(projection(1)), Equirect, Auto},
        {"Matroska, mono", matroska(stereoMode(0) + projection(1)), Equirect, Mono},
        {"Matroska, left eye first", matroska(stereoMode(1) + projection(1)), Equirect, LeftRight},
        {"Matroska, right eye below", matroska(stereoMode(2) + projection(1)), Equirect, TopBottom},
        {"Matroska, left eye above", matroska(stereoMode(3) + projection(1)), Equirect, TopBottom},
        {"Matroska, right eye first", matroska(stereoMode(11) + projection(1)), Equirect, LeftRight},
        {"Matroska, a mesh", matroska(projection(3)), Mesh, Auto},
    };
    for (const auto& row : kRows) {
        EXPECT_TRUE(row.read.present) << row.what;
        EXPECT_EQ(row.read.projection, row.projection) << row.what;
        EXPECT_EQ(row.read.layout, row.layout) << row.what;
    }
}

TEST(SphericalMetadata, NoneIsNotPresent) {
    std::string audio = movie(sv3d(kEquirect));
    audio.replace(audio.find("vide"), 4, "soun");
    const std::string isFalse = v1("<GSpherical:Spherical>false</GSpherical:Spherical>");
    for (const SphericalMetadata& read : {parsed(movie("")), parsed(movie("", isFalse)), parsed(audio),
                                          matroska(""), matroska(projection(0))}) {
        EXPECT_FALSE(read.present);
        EXPECT_EQ(read.projection, Projection::Unknown);
        EXPECT_EQ(read.layout, Layout::Auto);
    }
    EXPECT_EQ(matroska(stereoMode(3)).layout, Layout::Auto) << "a flat stereo video";
}

TEST(SphericalMetadata, V2BoundsOfAHalfEnvironment) {
    EXPECT_TRUE(
        parsed(movie(sv3d(fullBox("equi", be(0, 8) + be(0x40000000, 4) + be(0x40000000, 4))))).partial);
    EXPECT_FALSE(parsed(movie(sv3d(kEquirect))).partial);
}

} // namespace
} // namespace shoal::media
