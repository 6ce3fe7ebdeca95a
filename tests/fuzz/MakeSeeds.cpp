// make_fuzz_seeds FOLDER: one or more valid inputs for each fuzz target, in FOLDER/TARGET.
#include "content/make/depth/DepthTrackWriter.h"
#include "engine/core/Random.h"
#include "engine/core/WriteFile.h"
#include "engine/media/Pictures.h"
#include "game/rules/Dive.h"
#include "tests/TestRig.h"
#include "tests/unit/leap_service/Recordings.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include <cstdio>
#include <span>
#include <string>

using namespace shoal;

namespace {

Path folder;

void put(const std::string& target, const std::string& name, std::string_view bytes) {
    if (const Status written = writeFileWhole(folder / target / name, bytes); !written) {
        std::fprintf(stderr, "%s\n", written.error().message().c_str());
        std::exit(1);
    }
}

std::string contentFile(const std::string& name, size_t most = 1 << 20) {
    const auto bytes = readFileBegin(dataRoot() / name, most);
    return bytes ? std::string(bytes->begin(), bytes->end()) : std::string();
}

std::string big32(uint32_t value) {
    return {static_cast<char>(value >> 24), static_cast<char>(value >> 16), static_cast<char>(value >> 8),
            static_cast<char>(value)};
}

std::string box(const std::string& name, const std::string& body) {
    return big32(static_cast<uint32_t>(8 + body.size())) + name + body;
}

void models() {
    put("Gltf", "angelfish.glb", contentFile("content/models/angelfish.glb"));
    // A triangle that turns, wears a skin and has a target to morph to.
    put("Gltf", "triangle.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0,"skin":0,"children":[1]},{"name":"joint","rotation":[0,0,0,1]}],
"skins":[{"joints":[1]}],"materials":[{"name":"m","alphaMode":"MASK","pbrMetallicRoughness":{"roughnessFactor":0.5}}],
"meshes":[{"weights":[0.5],"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},"indices":1,"material":0,
"targets":[{"POSITION":0}]}]}],
"animations":[{"channels":[{"sampler":0,"target":{"node":1,"path":"rotation"}}],"samplers":[{"input":4,"output":3,
"interpolation":"LINEAR"}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"},{"bufferView":2,"componentType":5121,"count":3,"type":"VEC4"},
{"bufferView":3,"componentType":5126,"count":3,"type":"VEC4"},{"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":3},
{"buffer":0,"byteOffset":40,"byteLength":12},{"buffer":0,"byteOffset":52,"byteLength":48}],
"buffers":[{"byteLength":100,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAECAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAA=="}]})");
    // A compressed triangle with normals, and materials of extensions.
    put("Gltf", "compressed.gltf", R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],
"extensionsRequired":["EXT_meshopt_compression","KHR_mesh_quantization"],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":2},"indices":1,"material":0},
{"attributes":{"POSITION":0},"indices":1,"material":1}]}],
"materials":[{"extensions":{"KHR_materials_ior":{"ior":1.4},
"KHR_materials_specular":{"specularFactor":0.5,"specularColorFactor":[1,0.5,2]},
"KHR_materials_clearcoat":{"clearcoatFactor":1,"clearcoatRoughnessFactor":0.3}}},{"extensions":{"KHR_materials_unlit":{}}}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
{"bufferView":1,"componentType":5125,"count":3,"type":"SCALAR"},
{"bufferView":2,"componentType":5120,"normalized":true,"count":3,"type":"VEC3"}],
"bufferViews":[{"buffer":1,"byteLength":36,"extensions":{"EXT_meshopt_compression":
{"buffer":0,"byteLength":67,"byteStride":12,"count":3,"mode":"ATTRIBUTES"}}},
{"buffer":1,"byteOffset":36,"byteLength":12,"extensions":{"EXT_meshopt_compression":
{"buffer":0,"byteOffset":68,"byteLength":18,"byteStride":4,"count":3,"mode":"TRIANGLES"}}},
{"buffer":1,"byteOffset":48,"byteLength":12,"byteStride":4,"extensions":{"EXT_meshopt_compression":
{"buffer":0,"byteOffset":88,"byteLength":37,"byteStride":4,"count":3,"mode":"ATTRIBUTES","filter":"OCTAHEDRAL"}}}],
"buffers":[{"byteLength":125,"uri":"data:application/octet-stream;base64,oAAAATwAAAD//wE8AAAAfn0AAAEMAAAA/wEMAAAAfgAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAADg8AB2h1ZneKmGZYlomAFpAAAAAKAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAfwA="},
{"byteLength":60,"extensions":{"EXT_meshopt_compression":{"fallback":true}}}]})");
}

void replays() {
    const Path file = folder / "seed.replay";
    const auto files = game::loadDiveFiles("reef");
    game::Dive dive(files->species, files->dive, 7);
    {
        auto writer = sim::RecordingWriter::create(file, game::recordingHeader(dive));
        game::Events events;
        std::array<uint8_t, game::kTickInputBytes> bytes;
        for (int tick = 0; tick < 180; ++tick) {
            game::TickInput input;
            input.hands[1].tracked = tick > 60;
            input.hands[1].grip = 0.005f * static_cast<float>(tick);
            game::toBytes(input, bytes);
            dive.step(input, events);
            if (!writer->add(bytes, dive.stateHash())) std::exit(1);
        }
        if (!writer->finish()) std::exit(1);
    }
    const auto bytes = readFile(file, 1 << 24);
    const std::string whole(bytes->begin(), bytes->end());
    put("Replay", "two_blocks.replay", whole);
    put("Replay", "stopped.replay", whole.substr(0, whole.size() - 12));
    std::filesystem::remove(file);
}

void texts() {
    const std::string species = contentFile("content/species.toml");
    for (const char* name : {"reef", "night", "kelp"})
        put("DiveFiles", name,
            species + "\n---\n" + contentFile("content/dives/" + std::string(name) + ".toml"));
    for (const char* name : {"whole_dive", "first_catch", "shark_steals", "waving", "two_hands"})
        put("Playthrough", name, contentFile("tests/playthrough/" + std::string(name) + ".toml"));
    put("KeptFiles", "settings",
        "0{\"assist\":\"none\",\"volume\":0.5,\"language\":\"de\",\"unknown\":[1,{\"a\":null}]}");
    put("KeptFiles", "scores",
        "1{\"reef\":{\"top\":[120,40],\"last\":40},\"night\":{\"top\":[],\"last\":0}}");
    put("KeptFiles", "guide", "2[\"clownfish\",\"shark\"]");
    put("BakedOcclusion", "boxfish", contentFile("content/models/boxfish.occlusion.json"));
}

void metadata() {
    put("Metadata", "reef.mp4", contentFile("content/video/reef.small.mp4", 96 << 10));
    const std::string projection =
        box("sv3d", box("svhd", std::string(4, '\0') + "maker" + '\0') +
                        box("proj", box("prhd", std::string(16, '\0')) + box("equi", std::string(20, '\0'))));
    const std::string stereo = box("st3d", std::string(4, '\0') + '\1');
    const std::string xmp = "<rdf:SphericalVideo><GSpherical:Spherical>true</GSpherical:Spherical>"
                            "<GSpherical:ProjectionType>equirectangular</GSpherical:ProjectionType>"
                            "<GSpherical:StereoMode>top-bottom</GSpherical:StereoMode></rdf:SphericalVideo>";
    const std::string uuid = "\xff\xcc\x82\x63\xf8\x55\x4a\x93\x88\x14\x58\x7a\x02\x52\x1f\xdd" + xmp;
    put("Metadata", "boxes.mp4",
        box("ftyp", "isom" + std::string(4, '\0')) +
            box("moov", box("trak", stereo + projection + box("uuid", uuid))));
    const std::string gpano = std::string("http://ns.adobe.com/xap/1.0/") + '\0' +
                              "<x GPano:ProjectionType=\"equirectangular\" GPano:FullPanoWidthPixels=\"400\" "
                              "GPano:FullPanoHeightPixels=\"200\" "
                              "GPano:CroppedAreaLeftPixels=\"10\" "
                              "GPano:CroppedAreaTopPixels=\"20\" GPano:CroppedAreaImageWidthPixels=\"300\" "
                              "GPano:CroppedAreaImageHeightPixels=\"150\"/>";
    const auto length = static_cast<uint32_t>(gpano.size() + 2);
    put("Metadata", "orientation.tif",
        std::string("II*\0\x08\0\0\0\1\0\x12\1\3\0\1\0\0\0\6\0\0\0\0\0\0\0", 26));
    put("Metadata", "linear.png",
        "\x89PNG\r\n\x1a\n" + box("gAMA", "").replace(3, 1, "\4") + big32(100000) + "sum.");
    put("Metadata", "turned.avif",
        box("ftyp", "avif" + std::string(4, '\0')) +
            box("meta",
                std::string(4, '\0') +
                    box("iprp", box("ipco", box("irot", "\1") + box("imir", "\1") +
                                                box("ispe", std::string(4, '\0') + big32(8) + big32(4))))));
    put("Metadata", "sphere.jpg", "\xff\xd8\xff\xe1" + big32(length).substr(2) + gpano + "\xff\xd9");
}

cv::Mat halfNoise(int height, int width, Random& random) {
    cv::Mat picture(height, width, CV_8UC3, cv::Scalar(10, 20, 30));
    for (int i = 0; i < height * width * 3 / 2; ++i) picture.data[i] = static_cast<uint8_t>(random.next());
    return picture;
}

void films() {
    std::filesystem::create_directories(folder / "Video");
    Random random(8);
    for (const std::string kind : {".avi", ".mp4", ".mkv"}) {
        const int codec = kind == ".mp4" ? cv::VideoWriter::fourcc('m', 'p', '4', 'v')
                                         : cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
        cv::VideoWriter writer(folder / "Video" / ("noise" + kind), cv::CAP_FFMPEG, codec, 30, {64, 32});
        if (!writer.isOpened()) std::exit(1);
        for (int i = 0; i < 12; ++i) writer.write(halfNoise(32, 64, random));
    }
}

void pictures() {
    Random random(7);
    ImageRgbF light(48, 24); // runs and noise, so that every way of coding is used
    for (size_t i = 0; i < light.pixels.size(); ++i)
        light.pixels[i] = i < light.pixels.size() / 2 ? 0.25f : random.between(0, 100);
    for (const char* name : {"seed.hdr", "seed.exr", "seed.pfm"})
        put("Pictures", name, *media::encodeHdr(name, light));
    for (const std::string kind : {".png", ".jpg", ".bmp", ".webp", ".tif", ".ppm"}) {
        std::vector<uint8_t> bytes;
        cv::imencode(kind, halfNoise(24, 48, random), bytes);
        put("Pictures", "noise" + kind, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }
    put("Pictures", "turned.hdr", "#?RADIANCE\nEXPOSURE=2\n\n+X 1 -Y 2\n" + std::string(8, 'x'));
    put("Pictures", "alpha.pfm", "PF4\n1 1\n-1\n" + std::string(16, '?'));
    put("Frames", "pq", std::string("\x0f\7\0\0\x09\x09\x10\3", 8) + "some of the light");
    put("Pictures", "seed.ppm", "P6\n2 2\n255\n" + std::string(12, 'x'));
    put("Pictures", "seed.pgm", "P2 2 1 # grey\n255\n1 2\n");
}

void depthTracks() {
    for (const int width : {16, 64}) {
        auto writer = media::DepthTrackWriter::make({width, width / 2, 5, 0.5}, {});
        media::DepthFrame frame{width, width / 2,
                                std::vector<uint16_t>(static_cast<size_t>(width) * width / 2),
                                std::vector<uint16_t>(static_cast<size_t>(width) * width / 8, uint16_t{900})};
        for (int i = 0; i < 5; ++i) {
            for (size_t at = 0; at < frame.inverse.size(); ++at)
                frame.inverse[at] = static_cast<uint16_t>((7 * at * at + static_cast<size_t>(i)) % 1024);
            if (!writer || !writer->add(frame)) std::exit(1);
        }
        const Path file = folder / "DepthTrack" / ("seed" + std::to_string(width));
        std::filesystem::create_directories(file.parent_path());
        if (!writer->finish(file)) std::exit(1);
    }
}

void devices() {
    put("LeapMessages", "device",
        R"({"event":{"type":"deviceEvent","state":{"attached":true,"streaming":true,"type":"peripheral"}}})");
    hands::test::MadeHand hand = hands::test::closingHand(tests::rig(), 1).front();
    hand.elbow = {0.02f, 0.18f, 0.26f};
    const std::string frame = hands::test::madeFrame(6, 1, 5, {hand});
    put("LeapMessages", "frame", frame + "\n" + frame);
}

void ticks() {
    // Both hands tracked and closing, looking about, for some seconds.
    std::string bytes(1, 3);
    for (int i = 0; i < 40; ++i) {
        bytes += static_cast<char>(3);
        for (int hand = 0; hand < 2; ++hand) {
            bytes += static_cast<char>(1 | 8 | 16);
            for (int axis = 0; axis < 3; ++axis)
                bytes += static_cast<char>((i * 7 + axis * 5 + hand) % 5 - 2);
            bytes += static_cast<char>(i % 8);
        }
        bytes += static_cast<char>(9);
    }
    put("Tick", "reaching", bytes);
}

// A scene of six fish, twelve bones and four things, at places of chance near the middle.
void scenes() {
    std::string bytes = {6, 12, 4};
    Random random(5, 1);
    for (int i = 0; i < 1200; ++i) bytes += static_cast<char>(i % 2 ? random.below(12) : random.below(256));
    put("World", "crowd", bytes);
}

} // namespace

int main(int count, char** arguments) {
    if (count != 2) return 2;
    folder = arguments[1];
    for (const auto make :
         {models, replays, texts, metadata, pictures, films, depthTracks, devices, ticks, scenes})
        make();
    return 0;
}
