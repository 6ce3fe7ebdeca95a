#include "engine/core/Random.h"
#include "engine/media/Ffmpeg.h"
#include "engine/media/SphericalMetadata.h"
#include "engine/media/VideoPlayer.h"
#include "tests/unit/media/TestFiles.h"

#include <fmt/core.h>

#include <bit>

namespace shoal::media {
namespace {

TEST(StereoView, EyesCoverTheirHalves) {
    const auto expect = [](Layout layout, int eye, std::array<int, 4> wanted) {
        const EyePart part = eyePart(layout, eye, 101, 51);
        EXPECT_EQ((std::array{part.x, part.y, part.width, part.height}), wanted) << enumName(layout) << eye;
    };
    for (const int eye : {0, 1}) expect(Layout::Mono, eye, {0, 0, 101, 51});
    for (const int eye : {0, 1}) { // 0: the left one
        expect(Layout::TopBottom, eye, {0, 25 * eye, 101, 25});
        expect(Layout::BottomTop, eye, {0, 25 * (1 - eye), 101, 25});
        expect(Layout::LeftRight, eye, {50 * eye, 0, 50, 51});
        expect(Layout::RightLeft, eye, {50 * (1 - eye), 0, 50, 51});
    }
}

TEST(StereoView, ShapeTellsWhereItCan) {
    EXPECT_EQ(layoutFromShape(2048, 1024), Layout::Mono);
    EXPECT_EQ(layoutFromShape(426, 214), Layout::Mono);
    EXPECT_EQ(layoutFromShape(2048, 2048), Layout::TopBottom);
    EXPECT_EQ(layoutFromShape(8192, 2048), Layout::LeftRight);
    EXPECT_EQ(layoutFromShape(1920, 1080), Layout::Auto);
    EXPECT_EQ(layoutFromShape(5470, 3646), Layout::Auto);
}

using Brightness = std::function<double(double u, double v)>; // of one eye's picture, 0 to 1 each way

// Noise of cells, smooth between them and around: `across` cells around, half as many down.
Brightness noise(int across, uint64_t seed) {
    Random random(seed);
    std::vector<double> cells(static_cast<size_t>(across * (across / 2 + 1)));
    for (double& cell : cells) cell = random.below(256);
    return [=](double u, double v) {
        const double x = (u - std::floor(u)) * across, y = std::clamp(v, 0.0, 0.999) * (across / 2);
        const int column = static_cast<int>(x), row = static_cast<int>(y);
        const auto cell = [&](int i, int j) { return cells[(row + j) * across + (column + i) % across]; };
        return std::lerp(std::lerp(cell(0, 0), cell(1, 0), x - column),
                         std::lerp(cell(0, 1), cell(1, 1), x - column), y - row);
    };
}

ImageRgb8 drawn(int width, int height, const Brightness& at) {
    ImageRgb8 frame(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            std::fill_n(
                frame.at(x, y), 3,
                static_cast<uint8_t>(std::clamp(at((x + 0.5) / width, (y + 0.5) / height), 0.0, 255.0)));
    return frame;
}

// Returns the pictures of both eyes. Lower parts are nearer, and shifted by up to `disparity` of the width.
ImageRgb8 stereoPair(bool topBottom, const Brightness& seen, int width = 512, int height = 256,
                     double disparity = 0.02) {
    return drawn(width, height, [&](double u, double v) {
        double& across = topBottom ? v : u;
        const bool second = across >= 0.5;
        across = 2 * across - (second ? 1 : 0);
        return seen(u + (second ? disparity * v : 0), v);
    });
}

TEST(StereoView, ContentTellsTwoEyesFromOne) {
    for (const auto& [width, height] : {std::pair(512, 256), {320, 180}, {256, 256}, {4096, 2048}})
        for (const uint64_t seed : {1, 2, 3}) {
            const Brightness seen = noise(32, seed);
            EXPECT_EQ(layoutFromContent(stereoPair(true, seen, width, height)), Layout::TopBottom) << width;
            EXPECT_EQ(layoutFromContent(stereoPair(false, seen, width, height)), Layout::LeftRight) << width;
            EXPECT_EQ(layoutFromContent(drawn(width, height, seen)), Layout::Mono) << width;
        }
    // A picture beside its copy is a stereo pair too.
    EXPECT_EQ(layoutFromContent(stereoPair(false, noise(32, 4), 512, 256, 0)), Layout::LeftRight);
    // Shifted further than anything at an arm's length: another picture.
    EXPECT_EQ(layoutFromContent(drawn(512, 256,
                                      [seen = noise(32, 5)](double u, double v) {
                                          return seen(u < 0.5 ? 2 * u : 2 * u + 0.4, v);
                                      })),
              Layout::Mono);
}

// Two eyes' pictures must look so, whatever their shape.
TEST(StereoView, SqueezedPairsAreFoundByContent) {
    const Brightness seen = noise(32, 6);
    EXPECT_EQ(layoutOf(stereoPair(true, seen)), Layout::TopBottom);
    EXPECT_EQ(layoutOf(stereoPair(false, seen)), Layout::LeftRight);
    EXPECT_EQ(layoutOf(drawn(512, 256, seen)), Layout::Mono);
    EXPECT_EQ(layoutOf(stereoPair(true, seen, 256, 256)), Layout::TopBottom);
    EXPECT_EQ(layoutOf(stereoPair(false, seen, 1024, 256)), Layout::LeftRight);
    for (const int width : {256, 455, 1024}) EXPECT_EQ(layoutOf(drawn(width, 256, seen)), Layout::Auto);
    EXPECT_EQ(layoutOf(ImageRgb8(512, 256)), Layout::Mono) << "blank";
}

// Frames without structure give no layout: blank frames, fades, plain water with a gradient and noise.
TEST(StereoView, WithoutStructureNothingIsSaid) {
    EXPECT_EQ(layoutFromContent(ImageRgb8(64, 32)), Layout::Auto);
    EXPECT_EQ(layoutFromContent(ImageRgb8(1, 1)), Layout::Auto);
    const Brightness seen = noise(32, 7);
    EXPECT_EQ(layoutFromContent(stereoPair(false, [&](double u, double v) { return seen(u, v) / 40; })),
              Layout::Auto);
    Random random(4);
    EXPECT_EQ(
        layoutFromContent(drawn(512, 256, [&](double, double v) { return 240 - 200 * v + random.below(5); })),
        Layout::Auto);
}

// Rooms that are the same to the left and to the right: mirrored about the middle, or about each half's.
TEST(StereoView, MirrorSymmetricRoomsAreMono) {
    for (const uint64_t seed : {8, 9, 10}) {
        const Brightness seen = noise(32, seed);
        EXPECT_EQ(layoutFromContent(
                      drawn(512, 256, [&](double u, double v) { return seen(std::abs(u - 0.5), v); })),
                  Layout::Mono);
        EXPECT_EQ(layoutFromContent(
                      drawn(512, 256, [&](double u, double v) { return seen(u, std::abs(v - 0.5)); })),
                  Layout::Mono);
    }
}

Layout layoutOfFilm(const std::function<ImageRgb8(int)>& frame) {
    const TempFolder folder;
    writeFilm(folder / "film.avi", "MJPG", 24, frame, 24);
    auto player = tests::valueOf(VideoPlayer::open(folder / "film.avi"));
    EXPECT_EQ(player.waitFor(0)->number, 0) << "it begins with its first frame";
    return player.info().layout;
}

TEST(StereoView, AFilmGoesByFramesThatHaveStructure) {
    const Brightness seen = noise(32, 11);
    const ImageRgb8 pair = stereoPair(false, seen), one = drawn(512, 256, seen), black(512, 256);
    EXPECT_EQ(layoutOfFilm([&](int) { return pair; }), Layout::LeftRight);
    EXPECT_EQ(layoutOfFilm([&](int i) { return i < 6 ? black : pair; }), Layout::LeftRight) << "fades in";
    EXPECT_EQ(layoutOfFilm([&](int i) { return i < 6 ? black : one; }), Layout::Mono);
    EXPECT_EQ(layoutOfFilm([&](int i) { return i < 2 ? pair : one; }), Layout::Mono) << "frames disagree";
    EXPECT_EQ(layoutOfFilm([&](int) { return black; }), Layout::Mono);
    EXPECT_EQ(layoutOfFilm([&](int) { return drawn(256, 256, seen); }), Layout::Mono) << "no shape makes two";
    EXPECT_EQ(layoutOfFilm([&](int) { return stereoPair(true, seen, 256, 256); }), Layout::TopBottom);
}

std::string be(uint64_t value, int bytes) { return number(value, bytes, false); } // big endian

std::string fullBox(const std::string& name, const std::string& payload) {
    return box(name, be(0, 4) + payload);
}

std::string fixed(float degrees) { return be(static_cast<int32_t>(degrees * 65536), 4); }

const std::string kHandler = fullBox("hdlr", be(0, 4) + "vide" + be(0, 12) + "v" + be(0, 1));

std::string movie(const std::string& inEntry, const std::string& inTrack = "",
                  const std::string& inMovie = "") {
    const std::string sample =
        box("avc1", be(0, 6) + be(1, 2) + be(0, 16) + be(2048, 2) + be(1024, 2) + be(0, 50) + inEntry);
    const std::string table = box("stbl", fullBox("stsd", be(1, 4) + sample));
    return box("ftyp", "isom" + be(0, 4)) +
           box("moov", inMovie + box("trak", box("mdia", kHandler + box("minf", table)) + inTrack));
}

std::string sv3d(const std::string& projection, bool withHeader = true, const glm::vec3& pose = {}) {
    return box("sv3d",
               (withHeader ? fullBox("svhd", "test" + be(0, 1)) : "") +
                   box("proj", fullBox("prhd", fixed(pose.x) + fixed(pose.y) + fixed(pose.z)) + projection));
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

const auto projection = [](uint64_t type, const glm::vec3& pose = {}, const std::string& bounds = "") {
    std::string inside = std::string("\x76\x71\x81") + be(type, 1);
    if (!bounds.empty()) inside += element("\x76\x72", bounds);
    for (int i = 0; i < 3; ++i)
        inside += element({'\x76', static_cast<char>(0x73 + i)}, be(std::bit_cast<uint32_t>(pose[i]), 4));
    return element("\x76\x70", inside);
};

const std::string kCube = fullBox("cbmp", be(0, 8)), kMesh = fullBox("mshp", be(0, 8));

std::string stereoBox(uint64_t mode) { return fullBox("st3d", be(mode, 1)); }
std::string stereoMode(uint64_t mode) { return element("\x53\xb8", be(mode, 1)); }

TEST(SphericalMetadata, IsUnderstoodAsItIsWritten) {
    using enum Projection;
    using enum Layout;
    const std::string mesh = movie(sv3d(kMesh)), media = box("mdat", std::string(100000, 'x')),
                      title = box("udta", box("\xa9nam", be(4, 2) + be(0, 2) + "sv3d"));
    const struct {
        const char* what;
        SphericalMetadata read;
        Projection projection;
        Layout layout;
    } kRows[] = {
        {"V2", parsed(movie(stereoBox(2) + sv3d(kEquirect))), Equirect, LeftRight},
        {"V2, right eye first", parsed(movie(stereoBox(4) + sv3d(kEquirect))), Equirect, RightLeft},
        {"V2 without its header", parsed(movie(sv3d(kEquirect, false))), Equirect, Auto},
        {"a cube without a header", parsed(movie(sv3d(kCube, false))), Cubemap, Auto},
        {"a cube", parsed(movie(sv3d(kCube))), Cubemap, Auto},
        {"a mesh", parsed(mesh), Mesh, Auto},
        {"a mesh behind the pictures", parsed(mesh.substr(0, 16) + media + mesh.substr(16)), Mesh, Auto},
        {"V1", parsed(movie("", v1(kV1TopBottom))), Equirect, TopBottom},
        {"V1 without who stitched, of the title sv3d",
         parsed(movie("",
                      v1("<GSpherical:Spherical>true</GSpherical:Spherical>"
                         "<GSpherical:StereoMode>left-right</GSpherical:StereoMode>"),
                      title)),
         Equirect, LeftRight},
        {"V2 wins over V1", parsed(movie(stereoBox(0) + sv3d(kCube), v1(kV1TopBottom))), Cubemap, Mono},
        {"a stereo box beside V1", parsed(movie(stereoBox(2), v1(kV1))), Equirect, LeftRight},
        {"Matroska", matroska(projection(1)), Equirect, Auto},
        {"Matroska, mono", matroska(stereoMode(0) + projection(1)), Equirect, Mono},
        {"Matroska, left eye first", matroska(stereoMode(1) + projection(1)), Equirect, LeftRight},
        {"Matroska, right eye below", matroska(stereoMode(2) + projection(1)), Equirect, BottomTop},
        {"Matroska, left eye above", matroska(stereoMode(3) + projection(1)), Equirect, TopBottom},
        {"Matroska, right eye first", matroska(stereoMode(11) + projection(1)), Equirect, RightLeft},
        {"Matroska, a mesh", matroska(projection(3)), Mesh, Auto},
    };
    for (const auto& row : kRows) {
        EXPECT_TRUE(row.read.isStated()) << row.what;
        EXPECT_EQ(row.read.projection, row.projection) << row.what;
        EXPECT_EQ(row.read.layout, row.layout) << row.what;
    }
}

TEST(SphericalMetadata, NoneIsNotPresent) {
    std::string audio = movie(sv3d(kEquirect));
    audio.replace(audio.find("vide"), 4, "soun");
    const std::string isFalse = v1("<GSpherical:Spherical>false</GSpherical:Spherical>");
    for (const SphericalMetadata& read :
         {parsed(movie("")), parsed(movie("", isFalse)), parsed(audio), matroska(""), matroska(projection(0)),
          parsed(movie("") + box("mdat", stereoBox(4) + sv3d(kCube)))}) {
        EXPECT_FALSE(read.isStated());
        EXPECT_EQ(read.projection, Projection::Unknown);
        EXPECT_EQ(read.layout, Layout::Auto);
    }
    EXPECT_EQ(matroska(stereoMode(3)).layout, Layout::Auto) << "a flat stereo video";
}

// Where a direction of the film's picture is seen: ahead is -Z, right +X, up +Y. V2 turns to the left, up,
// and clockwise; V1 says where the viewer looks.
TEST(SphericalMetadata, PosesTurnTheSphere) {
    const auto v2 = [](const glm::vec3& pose) { return parsed(movie(sv3d(kEquirect, true, pose))); };
    const auto first = [](const char* name, int degrees) {
        return parsed(movie(
            "", v1(fmt::format("{}<GSpherical:InitialView{}Degrees>{}</GSpherical:x>", kV1, name, degrees))));
    };
    constexpr glm::vec3 kAhead(0, 0, -1), kRight(1, 0, 0), kUp(0, 1, 0);
    const float r = std::sqrt(0.5f);
    const struct {
        const char* what;
        SphericalMetadata read;
        glm::vec3 film, seen;
    } kRows[] = {
        {"yaw", v2({90, 0, 0}), kAhead, -kRight},
        {"yaw without a header", parsed(movie(sv3d(kEquirect, false, {90, 0, 0}))), kAhead, -kRight},
        {"pitch", v2({0, 45, 0}), kAhead, {0, r, -r}},
        {"roll", v2({0, 0, 45}), kUp, {r, r, 0}},
        {"yaw, then pitch", v2({90, 90, 0}), kRight, kAhead},
        {"pitch, then roll", v2({0, 90, 90}), kUp, kRight},
        {"Matroska", matroska(projection(1, {90, 0, 0})), kRight, kAhead},
        {"Matroska, more than a turn", matroska(projection(1, {450, 0, 0})), kRight, kAhead},
        {"Matroska's roll", matroska(projection(1, {0, 0, -45})), kUp, {-r, r, 0}},
        {"V1, looking to the right", first("Heading", 90), kRight, kAhead},
        {"V1, more than a turn", first("Heading", 450), kAhead, kAhead},
        {"V1, looking up", first("Pitch", 45), {0, r, -r}, kAhead},
        {"V1, the head to the right", first("Roll", 90), kRight, kUp},
        {"none", v2({}), kAhead, kAhead},
    };
    for (const auto& row : kRows) {
        EXPECT_LT(glm::distance(row.read.envFromFilm * row.film, row.seen), 1e-5f) << row.what;
        const glm::vec3 right(-row.seen.z, row.seen.y, row.seen.x); // a quarter turn to the right
        const glm::vec3 back = filmFromWorld(row.read.envFromFilm, glm::radians(90.0f)) * right;
        EXPECT_LT(glm::distance(back, row.film), 1e-5f) << row.what << ", with the environment turned";
    }
    EXPECT_NEAR(glm::length(matroska(projection(1, {NAN, 0, 0})).envFromFilm), 1, 1e-5);
}

TEST(SphericalMetadata, BoundsAreSharesOfTheSphere) {
    const std::string half = be(0, 4) + be(0, 8) + be(0x40000000, 4) + be(0x40000000, 4); // top .. right
    const std::string cropped =
        "<GSpherical:CroppedAreaImageWidthPixels>50</x><GSpherical:FullPanoWidthPixels>100"
        "</x><GSpherical:CroppedAreaImageHeightPixels>50</x><GSpherical:"
        "FullPanoHeightPixels>50</x><GSpherical:CroppedAreaLeftPixels>25</x>"
        "<GSpherical:CroppedAreaTopPixels>0</x>";
    for (const SphericalMetadata& read :
         {parsed(movie(sv3d(box("equi", half)))), parsed(movie(sv3d(box("equi", half), false))),
          matroska(projection(1, {}, half)), parsed(movie("", v1(kV1 + cropped)))}) {
        const SphereBounds& b = read.bounds;
        EXPECT_EQ(std::vector({b.left, b.top, b.right, b.bottom}), std::vector({0.25, 0.0, 0.25, 0.0}));
        EXPECT_NE(read.note().find("180 x 180 of 360 x 180"), std::string::npos) << read.note();
    }
    EXPECT_TRUE(parsed(movie(sv3d(kEquirect))).bounds.isWhole());
    const auto thin = parsed(movie(sv3d(fullBox("equi", be(0, 8) + be(0xff000000, 4) + be(0, 4)))));
    EXPECT_TRUE(thin.boundsIgnored && thin.bounds.isWhole());
}

// Appends a box to the innermost of these boxes, which are found one in another.
std::string with(std::string film, std::initializer_list<const char*> boxes, const std::string& added) {
    size_t at = 0, end = 0;
    for (const char* name : boxes) {
        at = film.find(name, at);
        uint32_t size = 0;
        for (int i = 0; i < 4; ++i) size = size << 8 | static_cast<uint8_t>(film[at - 4 + i]);
        end = at - 4 + size;
        film.replace(at - 4, 4, be(size + added.size(), 4));
    }
    return film.insert(end, added);
}

// Opens a film whose sample entry states this.
Result<VideoPlayer> filmThatSays(const ImageRgb8& picture, const std::string& stated) {
    const TempFolder folder;
    const Path file = folder / "film.mp4";
    writeFilm(
        file, "MJPG", 24, [&](int) -> const ImageRgb8& { return picture; }, 24);
    writeBytes(file, with(readBytes(file), {"moov", "trak", "mdia", "minf", "stbl", "stsd", "mp4v"}, stated));
    return VideoPlayer::open(file);
}

// The brightness of an eye's picture is 200 in its first quarter, and 0 elsewhere.
TEST(SphericalFilms, AHalfSphereIsPlacedAndMirroredForEachEye) {
    const std::string half = sv3d(fullBox("equi", be(0, 8) + be(0x40000000, 4) + be(0x40000000, 4)));
    for (const int eyes : {1, 2}) {
        const ImageRgb8 stored =
            drawn(32 * eyes, 32, [&](double u, double) { return u * eyes < 0.25 ? 200 : 0; });
        auto player = tests::valueOf(filmThatSays(stored, (eyes == 2 ? stereoBox(2) : "") + half));
        const ImageRgb8& picture = player.waitFor(0)->pixelsBgr;
        ASSERT_EQ(std::pair(picture.width, picture.height), std::pair(64 * eyes, 32));
        EXPECT_EQ(std::pair(player.info().width, player.info().height), std::pair(64 * eyes, 32));
        for (int x = 0; x < picture.width; ++x)
            EXPECT_EQ(picture.at(x, 16)[1] > 100, x >= 8 && x < 24) << x << " of " << eyes;
    }
}

// A film in HLG of an eighth of the sphere each way.
TEST(SphericalFilms, LightThatIsPlacedStaysSmall) {
    const std::string hlg = box("colr", "nclx" + be(9, 2) + be(18, 2) + be(9, 2) + be(0, 1));
    std::string bounds;
    for (int side = 0; side < 4; ++side) bounds += be(0x70000000, 4);
    const ImageRgb8 stored = drawn(256, 128, [](double u, double) { return u < 0.5 ? 200 : 0; });
    auto player = tests::valueOf(filmThatSays(stored, hlg + sv3d(fullBox("equi", bounds))));
    EXPECT_EQ(player.info().width, 2048);
    const ImageRgbF& light = player.waitFor(0)->radianceLin;
    ASSERT_EQ(std::pair(light.width, light.height), std::pair(1024, 512));
    EXPECT_GT(light.at(480, 256)[1], 10 * light.at(544, 256)[1]);
}

TEST(SphericalFilms, PixelsThatAreNotSquareCount) {
    const ImageRgb8 square = drawn(64, 64, noise(32, 12));
    const auto player = tests::valueOf(filmThatSays(square, box("pasp", be(2, 4) + be(1, 4))));
    EXPECT_EQ(player.info().layout, Layout::Mono);
    EXPECT_STREQ(player.info().layoutSource, "shape");
}

TEST(SphericalFilms, OtherProjectionsAreRefused) {
    for (const auto& [boxes, name] : {std::pair(kCube, "a cube map"), {kMesh, "a mesh"}}) {
        EXPECT_EQ(tests::errorOf(filmThatSays(ImageRgb8(64, 32), sv3d(boxes, false))).reason,
                  fmt::format("is {}; only lat-long video can be shown, so convert it", name));
    }
}

TEST(SphericalFilms, ACoverOfMusicIsNone) {
    AVFormatContext* input = avformat_alloc_context();
    for (const int disposition : {0, AV_DISPOSITION_ATTACHED_PIC, 0}) {
        EXPECT_LT(filmStreamOf(*input), 0);
        AVStream& stream = *avformat_new_stream(input, nullptr);
        stream.codecpar->codec_type = input->nb_streams == 1 ? AVMEDIA_TYPE_AUDIO : AVMEDIA_TYPE_VIDEO;
        stream.disposition = disposition;
    }
    EXPECT_EQ(filmStreamOf(*input), 2);
    avformat_free_context(input);
}

} // namespace
} // namespace shoal::media
