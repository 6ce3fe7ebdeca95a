// Malicious files: each is refused in a sentence that names the element, and none takes much memory or
// time.
#include "engine/scene/Vertices.h"
#include "tests/unit/scene/Fixture.h"

namespace shoal::scene {
namespace {

using testing::HasSubstr;

Gltf triangle() {
    Gltf file;
    file.addTriangles(file.addFloats(kTriangle, "VEC3"));
    return file;
}

// Returns the reason against the triangle with this in the first element of a list.
std::string reasonAgainst(const char* list, const char* member, const Json& value) {
    Gltf file = triangle();
    file.root[list][0][member] = value;
    return refusal(file.load());
}

TEST(Hostile, Counts) {
    const auto reason = [](const Json& count) { return reasonAgainst("accessors", "count", count); };
    EXPECT_EQ(reason(4'000'000'000u), "accessors[0].count is 4000000000, more than can be");
    EXPECT_THAT(reason(18446744073709551615u), HasSubstr("accessors[0].count is 18446744073709551615"));
    EXPECT_EQ(reason(-1), "accessors[0].count is negative");
    EXPECT_THAT(reason(2'000'000'000), HasSubstr("accessors[0] reaches past the end of bufferViews[0]"));
    EXPECT_EQ(reason(0), "accessors[0].count is 0");
    EXPECT_EQ(reason("3"), "accessors[0].count is not a whole number");
    Gltf file = triangle();
    file.root["accessors"][0]["count"] = 2'000'000'000;
    file.root["accessors"][0].erase("bufferView"); // two thousand million zeros
    EXPECT_THAT(refusal(file.load()), HasSubstr("more than the limit of 4000000 vertices"));
}

TEST(Hostile, Ranges) {
    EXPECT_EQ(reasonAgainst("accessors", "byteOffset", 4),
              "accessors[0] reaches past the end of bufferViews[0] (40 bytes of 36)");
    EXPECT_EQ(reasonAgainst("bufferViews", "byteLength", 37),
              "bufferViews[0] reaches past the end of buffers[0] (37 bytes of 36)");
    EXPECT_EQ(reasonAgainst("bufferViews", "byteStride", 16),
              "accessors[0] reaches past the end of bufferViews[0] (44 bytes of 36)");
    Gltf file = triangle();
    file.root["bufferViews"][0]["byteOffset"] = 2'147'483'647;
    file.root["bufferViews"][0]["byteLength"] = 2'147'483'647;
    EXPECT_THAT(refusal(file.load()), HasSubstr("bufferViews[0] reaches past the end of buffers[0]"));
    file = triangle();
    file.root["buffers"] = {
        {{"byteLength", 2'000'000'000}, {"uri", "data:application/octet-stream;base64,AAAA"}}};
    EXPECT_EQ(refusal(file.load()), "buffers[0].byteLength is 2000000000, but there are only 3 bytes");
}

TEST(Hostile, Indices) {
    Gltf file = triangle();
    file.root["meshes"][0]["primitives"][0]["indices"] =
        file.add<uint32_t>({0, 1, 4'294'967'295u}, "SCALAR", Gltf::kUnsignedInt);
    EXPECT_THAT(refusal(file.load()), HasSubstr("number 2 is 4294967295, but there are 3 vertices"));
    file.root["meshes"][0]["primitives"][0]["indices"] = 4'294'967'296; // 0 in 32 bits
    EXPECT_THAT(refusal(file.load()), HasSubstr("meshes[0].primitives[0].indices is 4294967296"));
    file.root["meshes"][0]["primitives"][0]["indices"] = 0; // positions
    EXPECT_THAT(refusal(file.load()), HasSubstr("does not hold single unsigned integers"));
    file = triangle();
    file.root["meshes"][0]["primitives"][0]["material"] = 0;
    EXPECT_EQ(refusal(file.load()), "meshes[0].primitives[0].material is 0, but there are 0 materials");
}

TEST(Hostile, SparseIndices) {
    Gltf file = triangle();
    const int indices = file.addView<uint32_t>({2, 1}), values = file.addView<float>({1, 2, 3, 4, 5, 6});
    Json& sparse = file.root["accessors"][0]["sparse"];
    sparse = {{"count", 2},
              {"indices", {{"bufferView", indices}, {"componentType", Gltf::kUnsignedInt}}},
              {"values", {{"bufferView", values}}}};
    EXPECT_THAT(refusal(file.load()), HasSubstr("accessors[0].sparse.indices: number 1 is 1"));
    sparse["indices"]["componentType"] = Gltf::kFloat;
    EXPECT_THAT(refusal(file.load()), HasSubstr("no unsigned integer type"));
    sparse["indices"]["componentType"] = Gltf::kUnsignedShort; // 2, 0: in range, but falling
    EXPECT_THAT(refusal(file.load()), HasSubstr("number 1 is 0"));
    sparse["count"] = 3;
    EXPECT_THAT(refusal(file.load()),
                HasSubstr("accessors[0].sparse.values reaches past the end of bufferViews[2]"));
    sparse["count"] = 4;
    EXPECT_EQ(refusal(file.load()), "accessors[0].sparse.count is 4, not 1 .. 3");
}

TEST(Hostile, NumbersThatAreNone) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Gltf file;
        std::vector<float> positions = kTriangle;
        positions[4] = bad;
        file.addTriangles(file.addFloats(positions, "VEC3"));
        EXPECT_EQ(refusal(file.load()), "accessors[0]: element 1 is not finite");
    }
    Gltf file = triangle();
    file.root["nodes"][0]["translation"] = {0, 1e300, 0}; // finite, but not as a float
    EXPECT_EQ(refusal(file.load()), "nodes[0].translation[1] is not finite");
    file.root["nodes"][0] = {{"rotation", {0, 0, 0, 0}}};
    EXPECT_THAT(refusal(file.load()), HasSubstr("nodes[0].rotation"));
    file.root["nodes"] = {{{"scale", {1e30, 1, 1}}, {"children", {1}}}, {{"scale", {1e30, 1, 1}}}};
    EXPECT_EQ(refusal(file.load()), "nodes[1] lies infinitely far away");
}

TEST(Hostile, NodesInACycle) {
    Gltf file;
    file.root["nodes"] = {{{"children", {1}}}, {{"children", {2}}}, {{"children", {0}}}};
    EXPECT_THAT(refusal(file.load()), HasSubstr("is its own ancestor"));
    file.root["nodes"] = {{{"children", {0}}}};
    EXPECT_THAT(refusal(file.load()), HasSubstr("nodes[0] is its own ancestor"));
    file.root["nodes"] = {{{"children", {1, 1}}}, Json::object()};
    EXPECT_THAT(refusal(file.load()), HasSubstr("nodes[1] is a child twice"));
}

TEST(Hostile, ADeepChainOfNodesLoads) {
    Gltf file;
    constexpr int kNodes = 60'000;
    for (int i = 0; i < kNodes; ++i) {
        Json node = {{"translation", {0, 1, 0}}};
        if (i + 1 < kNodes) node["children"] = {i + 1};
        file.root["nodes"].push_back(std::move(node));
    }
    EXPECT_EQ(restOf(file.model()).modelFromNode.back()[3][1], kNodes); // whole numbers below 2^24: exact
    EXPECT_EQ(refusal(file.load({.maxNodes = 100})), "nodes has 60000 elements, more than the limit of 100");
}

TEST(Hostile, DeepAndWideJson) {
    const Folder folder;
    const std::string deep(1'000'000, '[');
    EXPECT_THAT(refusal(loadModel(folder.write("a.gltf", deep))), HasSubstr("nested deeper than 64"));
    EXPECT_THAT(refusal(loadModel(folder.write("a.gltf", R"({"asset":{"version":"2.0"},"extras":)" + deep))),
                HasSubstr("nested deeper than 64"));
    std::string wide = "{\"asset\":{\"version\":\"2.0\"},\"extras\":[";
    for (int i = 0; i < 600'000; ++i) wide += "{},";
    EXPECT_THAT(refusal(loadModel(folder.write("a.gltf", wide + "{}]}"))), HasSubstr("objects"));
    EXPECT_EQ(refusal(loadModel(folder.write("a.gltf", ""))), "is empty");
    EXPECT_THAT(refusal(loadModel(folder.write("a.gltf", "{\"asset\""))), HasSubstr("broken at byte"));
}

std::string glb(uint32_t version, uint32_t length, uint32_t chunkLength, const std::string& json) {
    std::string bytes = "glTF";
    const auto put = [&](uint32_t number) { bytes.append(reinterpret_cast<const char*>(&number), 4); };
    put(version), put(length), put(chunkLength), put(0x4E4F534A);
    return bytes + json;
}

TEST(Hostile, GlbLengths) {
    const Folder folder;
    const auto reason = [&](const std::string& bytes) {
        return refusal(loadModel(folder.write("a.glb", bytes)));
    };
    const std::string json = R"({"asset":{"version":"2.0"}} )"; // 28 bytes
    EXPECT_EQ(reason(glb(2, 48, 28, json)), "");
    EXPECT_THAT(reason(glb(1, 48, 28, json)), HasSubstr("GLB version 1"));
    EXPECT_THAT(reason(glb(2, 0xFFFFFFFFu, 28, json)), HasSubstr("says 4294967295 bytes"));
    EXPECT_THAT(reason(glb(2, 48, 0xFFFFFFFCu, json)), HasSubstr("GLB chunk 0 reaches past the end"));
    EXPECT_THAT(reason(glb(2, 50, 28, json + "ab")), HasSubstr("GLB chunk 1 is cut short"));
    for (size_t size = 4; size < 48; ++size)
        EXPECT_NE(reason(glb(2, 48, 28, json).substr(0, size)), "") << size << " bytes";
}

TEST(Hostile, PathsOutOfTheFolder) {
    const Folder folder;
    const std::string secret(36, '\0');
    folder.write("secret.bin", secret);
    folder.write("models/inside.bin", secret);
    folder.write("models/sub/below.bin", secret);
    std::filesystem::create_symlink("../secret.bin", folder.path() / "models/link.bin");
    std::filesystem::create_symlink("..", folder.path() / "models/up");
    const auto reason = [&](const std::string& uri) {
        Gltf file = triangle();
        file.root["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
        return refusal(loadModel(folder.write("models/a.gltf", file.text())));
    };
    EXPECT_EQ(reason("inside.bin"), "");
    EXPECT_EQ(reason("sub/below.bin"), "");
    EXPECT_EQ(reason("./in%73ide.bin"), "");
    for (const char* uri : {"../secret.bin", "..%2Fsecret.bin", "%2e%2e/secret.bin", "sub/../../secret.bin",
                            "link.bin", "up/secret.bin", "/etc/passwd", "%2Fetc/passwd"})
        EXPECT_THAT(reason(uri), HasSubstr("leads out of the model's own folder")) << uri;
    EXPECT_EQ(reason((folder.path() / "models/inside.bin").string()).find("there is no"), std::string::npos);
    for (const char* uri : {"file:///etc/passwd", "http://example.com/a.bin", "file%3Ainside.bin"})
        EXPECT_THAT(reason(uri), HasSubstr("is no file of the model's own folder")) << uri;
    EXPECT_THAT(reason("..\\secret.bin"), HasSubstr("characters"));
    EXPECT_THAT(reason("inside.bin%00.png"), HasSubstr("characters"));
    EXPECT_THAT(reason("sub"), HasSubstr("is a folder"));
    EXPECT_THAT(reason("none.bin"), HasSubstr("there is no such file"));
    EXPECT_THAT(reason(""), HasSubstr("uri is empty"));
}

TEST(Hostile, FilesAndLimits) {
    const Folder folder;
    folder.write("big.bin", std::string(5000, 'x'));
    Gltf file = triangle();
    const Json buffer = {{"byteLength", 36}, {"uri", "big.bin"}};
    file.root["buffers"] = {buffer};
    const Path path = folder.write("a.gltf", file.text());
    EXPECT_EQ(refusal(loadModel(path)), "");
    EXPECT_THAT(refusal(loadModel(path, {}, {.maxFileBytes = 4000})),
                HasSubstr("buffers[0].uri (big.bin): is larger than the limit"));
    for (int i = 0; i < 10; ++i) file.root["buffers"].push_back(buffer);
    EXPECT_THAT(refusal(loadModel(folder.write("a.gltf", file.text()), {}, {.maxTotalBytes = 20'000})),
                HasSubstr("more than the limit of 20000 bytes"));
    EXPECT_THAT(refusal(triangle().load({.maxVertices = 2})), HasSubstr("limit of 2 vertices"));
    EXPECT_THAT(refusal(triangle().load({.maxIndices = 2})), HasSubstr("limit of 2 indices"));
    EXPECT_EQ(refusal(loadModel(folder.path() / "none.glb")), "there is no such file");
}

TEST(Hostile, Images) {
    Gltf file = triangle();
    file.root["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    file.root["textures"] = {{{"source", 0}}};
    const auto reason = [&](const std::vector<uint8_t>& bytes) {
        file.root["images"] = {{{"uri", "data:image/png;base64," + base64(bytes)}}};
        return refusal(file.load());
    };
    EXPECT_EQ(reason({1, 2, 3}), "images[0] is not a PNG or JPEG image that can be read");
    // A PNG header (RFC 2083) of 16000 x 16000, whose data says that it has 1 GiB; then a small one.
    std::vector<uint8_t> png = {0x89, 'P', 'N', 'G', 13,  10, 26,   10,   0, 0,    0,    13,
                                'I',  'H', 'D', 'R', 0,   0,  0x3E, 0x80, 0, 0,    0x3E, 0x80,
                                8,    6,   0,   0,   0,   0,  0,    0,    0, 0x3F, 0xFF, 0xFF,
                                0xFF, 'I', 'D', 'A', 'T', 0,  0,    0,    0};
    EXPECT_EQ(reason(png), "images[0] brings the model to more than the limit of 64000000 image pixels");
    png[18] = png[22] = 0, png[19] = png[23] = 4;
    EXPECT_EQ(reason(png), "images[0] is broken or cut short");
    // A JPEG's Huffman table (ITU-T T.81, B.2.4.2) of 16 times 255 codes, the second of its segment, behind
    // fill bytes and padding.
    std::vector<uint8_t> jpeg = {0xFF, 0xD8, 0xFF, 0xFE, 0, 4, 0xFF, 0xC4, 0, 0xFF, 0xFF, 0xC4, 0x10, 0x14};
    jpeg.resize(jpeg.size() + 17); // one without codes
    jpeg.push_back(0x11);
    jpeg.resize(jpeg.size() + 16, 255);
    jpeg.resize(jpeg.size() + 16 * 255, 1);
    EXPECT_EQ(reason(jpeg), "images[0] is broken or cut short");
    const std::string picture = readText(dataRoot() / "content/lessons/catch.jpg").value();
    EXPECT_EQ(reason({picture.begin(), picture.end()}), "");
    EXPECT_EQ(reason({picture.begin(), picture.end() - 100}), "images[0] is broken or cut short");
    file.root["images"] = {{{"uri", "none.png"}}};
    EXPECT_EQ(refusal(file.load()), "images[0].uri (none.png): there is no such file");
    file.root["images"] = {{{"uri", "none.png"}, {"mimeType", "image/webp"}}};
    EXPECT_THAT(refusal(file.load()), HasSubstr("images[0].mimeType is image/webp"));
}

TEST(Hostile, Skins) {
    Gltf file = triangle();
    file.root["nodes"].push_back(Json::object());
    file.root["nodes"][0]["skin"] = 0;
    file.root["skins"] = {{{"joints", {1, 1}}}};
    EXPECT_EQ(refusal(file.load()), "skins[0].joints holds nodes[1] twice");
    file.root["skins"] = {
        {{"joints", {0, 1}}, {"inverseBindMatrices", file.addFloats(std::vector<float>(16), "MAT4")}}};
    EXPECT_EQ(refusal(file.load()), "skins[0] has 2 joints, but accessors[1] only 1 matrices");
    file.root["skins"] = {{{"joints", {0}}}};
    Json& attributes = file.root["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] =
        file.add<uint8_t>({0, 0, 0, 0, 9, 0, 0, 0, 0, 0, 0, 0}, "VEC4", Gltf::kUnsignedByte);
    EXPECT_THAT(refusal(file.load()), HasSubstr("JOINTS_0 is there without WEIGHTS_0"));
    attributes["WEIGHTS_0"] = file.addFloats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    EXPECT_THAT(refusal(file.load()), HasSubstr("a vertex hangs on joint 9 of a skin with 1 joints"));
    file.root["scenes"] = {{{"nodes", {0}}}};
    file.root["skins"] = {{{"joints", {1}}}};
    EXPECT_EQ(refusal(file.load()), "nodes[0] uses skins[0], whose joint nodes[1] is not in the scene");
    EXPECT_EQ(refusal(file.load({.maxJoints = 0})), "skins[0] has 1 joints, more than the limit of 0");
}

TEST(Hostile, Animations) {
    Gltf file = triangle();
    const int times = file.addFloats({0, 1}, "SCALAR"), falling = file.addFloats({1, 0}, "SCALAR");
    const int values = file.addFloats({0, 0, 0, 1, 1, 1}, "VEC3");
    const auto reason = [&](int input, int output, int sampler, const char* path) {
        file.root["animations"] = {
            {{"samplers", {{{"input", input}, {"output", output}}}},
             {"channels", {{{"sampler", sampler}, {"target", {{"node", 0}, {"path", path}}}}}}}};
        return refusal(file.load());
    };
    EXPECT_EQ(reason(times, values, 0, "translation"), "");
    EXPECT_EQ(reason(times, values, 1, "scale"),
              "animations[0].channels[0].sampler is 1, but there are 1 samplers");
    EXPECT_EQ(reason(falling, values, 0, "scale"), "accessors[2]: key 1 is not later than the one before");
    EXPECT_THAT(reason(times, values, 0, "rotation"), HasSubstr("has a type that its channel cannot take"));
    EXPECT_THAT(reason(times, 0, 0, "scale"), HasSubstr("has 9 numbers instead of 6"));
    EXPECT_THAT(reason(times, values, 0, "weights"), HasSubstr("which has no morph targets"));
    reason(times, values, 0, "scale");
    EXPECT_THAT(refusal(file.load({.maxKeyValues = 7})), HasSubstr("limit of 7 key values"));
}

TEST(Hostile, Extensions) {
    Gltf file = triangle();
    file.root["extensionsUsed"] = {"KHR_materials_sheen"};
    EXPECT_EQ(refusal(file.load()), "");
    file.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    EXPECT_EQ(refusal(file.load()), "needs the extension KHR_draco_mesh_compression, which is not supported");
    // Quantized positions, with and without the extension that allows them.
    Gltf small;
    small.addTriangles(small.add<int16_t>({0, 0, 0, 5, 0, 0, 0, 5, 0}, "VEC3", Gltf::kShort));
    EXPECT_THAT(refusal(small.load()), HasSubstr("POSITION: accessors[0] has a type"));
    small.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    EXPECT_EQ(refusal(small.load()), "");
}

// A vertex in which very many triangles meet: no quadratic search.
TEST(Hostile, ManyTangentsAtOneVertex) {
    constexpr uint32_t kTriangles = 100'000;
    Primitive fan;
    fan.positions = {{0, 0, 0}};
    fan.texCoords[0] = {{0, 0}};
    for (uint32_t i = 0; i < kTriangles; ++i) {
        const auto f = static_cast<float>(i);
        fan.positions.insert(fan.positions.end(), {{1, f, 0}, {1, f + 0.5f, 0}});
        fan.texCoords[0].insert(fan.texCoords[0].end(), {{1, 0}, {0, 1 + f}});
        fan.indices.insert(fan.indices.end(), {0, 2 * i + 1, 2 * i + 2});
    }
    fan.normals.assign(fan.positions.size(), {0, 0, 1});
    EXPECT_EQ(makeTangents(fan, 0).source.size(), 2 * kTriangles + 1);
}

} // namespace
} // namespace shoal::scene
