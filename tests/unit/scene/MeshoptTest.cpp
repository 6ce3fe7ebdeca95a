// EXT_meshopt_compression: bufferViews that are decoded when the file is read.
#include "Fixture.h"

#include <meshoptimizer.h>

namespace shoal::scene {
namespace {

using testing::HasSubstr;

constexpr const char* kName = "EXT_meshopt_compression";

void encodeExponent(uint8_t* out, const float& number) {
#if MESHOPTIMIZER_VERSION >= 200
    meshopt_encodeFilterExp(out, 1, 4, 15, &number, meshopt_EncodeExpSeparate);
#else
    meshopt_encodeFilterExp(out, 1, 4, 15, &number);
#endif
}

// A document whose buffer 0 holds streams, and buffer 1 stands for what they become.
struct Compressed {
    Gltf file;
    size_t decodedBytes = 0;

    // Returns the view.
    int addView(const std::vector<uint8_t>& stream, size_t count, size_t stride, const char* mode,
                const char* filter = nullptr) {
        const int view = file.addView(stream);
        Json& json = file.root["bufferViews"][view];
        Json compression = {{"buffer", 0},
                            {"byteOffset", json["byteOffset"]},
                            {"byteLength", stream.size()},
                            {"byteStride", stride},
                            {"count", count},
                            {"mode", mode}};
        if (filter) compression["filter"] = filter;
        json = {{"buffer", 1}, {"byteOffset", decodedBytes}, {"byteLength", count * stride}};
        json["extensions"][kName] = compression;
        decodedBytes += count * stride;
        return view;
    }

    Json& view(size_t index) { return file.root["bufferViews"][index]; }
    Json& compression(size_t index) { return view(index)["extensions"][kName]; }

    // With its buffers, of which the second has no bytes.
    Gltf whole() const {
        Gltf all = file;
        all.root["extensionsRequired"] = {kName, "KHR_mesh_quantization"};
        all.root["buffers"] = {
            {{"byteLength", all.bytes.size()},
             {"uri", "data:application/octet-stream;base64," + base64(all.bytes)}},
            {{"byteLength", decodedBytes}, {"extensions", {{kName, {{"fallback", true}}}}}}};
        return all;
    }
};

template <class T> std::vector<uint8_t> encodedVertices(const std::vector<T>& values, size_t stride) {
    const size_t count = values.size() * sizeof(T) / stride;
    std::vector<uint8_t> stream(meshopt_encodeVertexBufferBound(count, stride));
    stream.resize(meshopt_encodeVertexBuffer(stream.data(), stream.size(), values.data(), count, stride));
    return stream;
}

// A bumpy square of 10 x 10 vertices.
constexpr uint32_t kSide = 10;

std::vector<float> squarePositions() {
    std::vector<float> positions;
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
        const auto x = static_cast<float>(i % kSide), y = static_cast<float>(i / kSide);
        positions.insert(positions.end(), {x, y, std::sin(x) * std::cos(y)});
    }
    return positions;
}

std::vector<uint32_t> squareIndices() {
    std::vector<uint32_t> indices;
    for (uint32_t y = 0; y + 1 < kSide; ++y)
        for (uint32_t x = 0; x + 1 < kSide; ++x) {
            const uint32_t a = y * kSide + x;
            for (const uint32_t i : {a, a + 1, a + kSide, a + 1, a + kSide + 1, a + kSide})
                indices.push_back(i);
        }
    return indices;
}

// Views: 0 positions, 1 indices.
Compressed square(const char* mode = "TRIANGLES", size_t indexBytes = 4) {
    const std::vector<uint32_t> indices = squareIndices();
    Compressed made;
    const int positions = made.file.addAccessor(
        made.addView(encodedVertices(squarePositions(), 12), kSide * kSide, 12, "ATTRIBUTES"), kSide * kSide,
        "VEC3", Gltf::kFloat);
    const bool triangles = std::string(mode) == "TRIANGLES";
    std::vector<uint8_t> stream(triangles ? meshopt_encodeIndexBufferBound(indices.size(), kSide * kSide)
                                          : meshopt_encodeIndexSequenceBound(indices.size(), kSide * kSide));
    stream.resize(
        triangles
            ? meshopt_encodeIndexBuffer(stream.data(), stream.size(), indices.data(), indices.size())
            : meshopt_encodeIndexSequence(stream.data(), stream.size(), indices.data(), indices.size()));
    const int order =
        made.file.addAccessor(made.addView(stream, indices.size(), indexBytes, mode), indices.size(),
                              "SCALAR", indexBytes == 2 ? Gltf::kUnsignedShort : Gltf::kUnsignedInt);
    made.file.addTriangles(positions)["indices"] = order;
    return made;
}

Primitive primitiveOf(const Gltf& file) { return file.model().meshes[0].primitives[0]; }

void expectSquare(const Primitive& primitive, const char* what) {
    SCOPED_TRACE(what);
    const std::vector<float> positions = squarePositions();
    // Normals are made flat: each triangle has vertices of its own.
    const std::vector<uint32_t> indices = squareIndices();
    ASSERT_EQ(primitive.indices.size(), indices.size());
    std::vector<std::array<glm::vec3, 3>> got, want;
    for (size_t i = 0; i < indices.size(); i += 3) {
        const auto at = [&](uint32_t v) {
            return glm::vec3(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]);
        };
        const auto sorted = [](std::array<glm::vec3, 3> t) { // begins with the corner of least x, then y
            const auto first =
                std::ranges::min_element(t, {}, [](const glm::vec3& p) { return std::pair(p.x, p.y); });
            std::rotate(t.begin(), first, t.end());
            return t;
        };
        got.push_back(
            sorted({primitive.positions[primitive.indices[i]], primitive.positions[primitive.indices[i + 1]],
                    primitive.positions[primitive.indices[i + 2]]}));
        want.push_back(sorted({at(indices[i]), at(indices[i + 1]), at(indices[i + 2])}));
    }
    EXPECT_EQ(got, want);
}

TEST(Meshopt, AttributesTrianglesAndIndicesBecomeWhatTheyWere) {
    expectSquare(primitiveOf(square().whole()), "triangles");
    expectSquare(primitiveOf(square("TRIANGLES", 2).whole()), "triangles of 16 bits");
    expectSquare(primitiveOf(square("INDICES").whole()), "indices");
    expectSquare(primitiveOf(square("INDICES", 2).whole()), "indices of 16 bits");
}

// A buffer without bytes needs no mark; one with bytes that are marked is not opened.
TEST(Meshopt, FallbackBuffers) {
    Gltf file = square().whole();
    file.root["buffers"][1].erase("extensions");
    expectSquare(primitiveOf(file), "no mark");
    file = square().whole();
    file.root["buffers"][1]["uri"] = "missing.bin";
    expectSquare(primitiveOf(file), "bytes that are not there");
    file.root.erase("extensionsRequired");
    file.root["extensionsUsed"] = {kName, "KHR_mesh_quantization"};
    expectSquare(primitiveOf(file), "optional");
    // What is not compressed has nothing there.
    file = square().whole();
    file.root["bufferViews"][0].erase("extensions");
    EXPECT_EQ(refusal(file.load()), "bufferViews[0] reaches past the end of buffers[1] (1200 bytes of 0)");
    file = square().whole();
    file.root["bufferViews"][0]["extensions"][kName]["buffer"] = 1;
    EXPECT_THAT(refusal(file.load()),
                HasSubstr("bufferViews[0].EXT_meshopt_compression reaches past the end of buffers[1]"));
}

// Unit vectors, in 8 and 16 bits: off by a step of each at most.
TEST(Meshopt, OctahedralNormals) {
    std::vector<glm::vec3> normals;
    std::vector<float> wanted;
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
        const float z = 1 - 2 * (static_cast<float>(i) + 0.5f) / (kSide * kSide),
                    turn = 2.4f * static_cast<float>(i);
        normals.emplace_back(std::sqrt(1 - z * z) * glm::vec2(std::cos(turn), std::sin(turn)), z);
        wanted.insert(wanted.end(), {normals.back().x, normals.back().y, normals.back().z, 0});
    }
    for (const size_t stride : {4u, 8u}) {
        Compressed made = square();
        std::vector<uint8_t> filtered(normals.size() * stride);
        meshopt_encodeFilterOct(filtered.data(), normals.size(), stride, stride == 4 ? 8 : 16, wanted.data());
        const int view = made.addView(encodedVertices(filtered, stride), normals.size(), stride, "ATTRIBUTES",
                                      "OCTAHEDRAL");
        made.view(static_cast<size_t>(view))["byteStride"] = stride;
        made.file.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = made.file.addAccessor(
            view, normals.size(), "VEC3", stride == 4 ? Gltf::kByte : Gltf::kShort, true);
        const Primitive primitive = primitiveOf(made.whole());
        ASSERT_EQ(primitive.normals.size(), normals.size());
        for (size_t i = 0; i < normals.size(); ++i)
            EXPECT_LT(glm::distance(primitive.normals[i], normals[i]),
                      stride == 4 ? 2.0f / 127 : 2.0f / 32767)
                << i;
    }
}

// A turning node: rotations of 16 bits, and places by mantissas of 15 bits.
TEST(Meshopt, QuaternionsAndExponents) {
    constexpr size_t kKeys = 33;
    std::vector<float> times, rotations, places;
    for (size_t i = 0; i < kKeys; ++i) {
        const float t = static_cast<float>(i) / 8, half = 0.3f * t;
        times.push_back(t);
        rotations.insert(rotations.end(), {std::sin(half) * 0.6f, std::sin(half) * 0.8f, 0, std::cos(half)});
        places.insert(places.end(), {1000 * t, -0.001f * t, std::sin(t)});
    }
    Compressed made = square();
    std::vector<uint8_t> turns(kKeys * 8), moves(kKeys * 12);
    meshopt_encodeFilterQuat(turns.data(), kKeys, 8, 16, rotations.data());
    for (size_t i = 0; i < places.size(); ++i) // each with an exponent of its own
        encodeExponent(moves.data() + 4 * i, places[i]);
    const int input = made.file.addAccessor(made.addView(encodedVertices(times, 4), kKeys, 4, "ATTRIBUTES"),
                                            kKeys, "SCALAR", Gltf::kFloat);
    const int turn =
        made.file.addAccessor(made.addView(encodedVertices(turns, 8), kKeys, 8, "ATTRIBUTES", "QUATERNION"),
                              kKeys, "VEC4", Gltf::kShort, true);
    const int move = made.file.addAccessor(
        made.addView(encodedVertices(moves, 12), kKeys, 12, "ATTRIBUTES", "EXPONENTIAL"), kKeys, "VEC3",
        Gltf::kFloat);
    Gltf file = made.whole();
    file.root["animations"] = {
        {{"channels",
          {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}},
           {{"sampler", 1}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
         {"samplers", {{{"input", input}, {"output", turn}}, {{"input", input}, {"output", move}}}}}};
    const auto model = file.model();
    const auto& channels = model.animations[0].channels;
    ASSERT_EQ(channels.size(), 2u);
    for (size_t i = 0; i < kKeys; ++i) {
        EXPECT_EQ(channels[0].times_s[i], times[i]);
        // The same turn, perhaps by the other quaternion for it.
        float cosine = 0;
        for (size_t k = 0; k < 4; ++k) cosine += channels[0].values[4 * i + k] * rotations[4 * i + k];
        EXPECT_GT(std::abs(cosine), 1 - 1e-7f) << i;
        for (size_t k = 3 * i; k < 3 * i + 3; ++k)
            EXPECT_NEAR(channels[1].values[k], places[k], std::abs(places[k]) / 16384) << i;
    }
}

TEST(Meshopt, LayoutsThatCannotBeAreRefused) {
    const auto reason = [](size_t view, const char* member, const Json& value) {
        Compressed made = square();
        made.compression(view)[member] = value;
        return refusal(made.whole().load());
    };
    const std::string who = "bufferViews[0].EXT_meshopt_compression";
    EXPECT_EQ(reason(0, "mode", "POINTS"),
              who + ": the mode POINTS cannot have 100 elements of 12 bytes with the filter NONE");
    for (const char* filter : {"BLUR", "OCTAHEDRAL", "QUATERNION"})
        EXPECT_THAT(reason(0, "filter", filter), HasSubstr(std::string("with the filter ") + filter));
    EXPECT_THAT(reason(1, "filter", "EXPONENTIAL"), HasSubstr("with the filter EXPONENTIAL"));
    for (const int stride : {0, 2, 13, 260})
        EXPECT_THAT(reason(0, "byteStride", stride), HasSubstr("the mode ATTRIBUTES cannot have")) << stride;
    EXPECT_THAT(reason(1, "byteStride", 8), HasSubstr("the mode TRIANGLES cannot have"));
    EXPECT_THAT(reason(1, "count", 485), HasSubstr("cannot have 485 elements"));
    EXPECT_EQ(reason(0, "count", 0), who + ".count is 0");
    EXPECT_EQ(reason(0, "count", 99), who + " becomes 1188 bytes, but its bufferView has 1200");
    EXPECT_EQ(reason(0, "byteStride", 16), who + " becomes 1600 bytes, but its bufferView has 1200");
    EXPECT_EQ(reason(0, "buffer", 2), who + ".buffer is 2, but there are 2 buffers");
    EXPECT_THAT(reason(0, "byteLength", 2'147'483'647), HasSubstr("reaches past the end of buffers[0]"));
    EXPECT_THAT(reason(0, "byteOffset", 2'147'483'647), HasSubstr("reaches past the end of buffers[0]"));
    EXPECT_EQ(reason(0, "count", "many"), who + ".count is not a whole number");
    EXPECT_EQ(reason(0, "byteOffset", -1), who + ".byteOffset is negative");
    Compressed made = square();
    made.view(0)["byteStride"] = 16;
    EXPECT_EQ(refusal(made.whole().load()), who + ".byteStride is not that of its bufferView");
    made = square();
    made.compression(0).erase("mode");
    EXPECT_EQ(refusal(made.whole().load()), who + ".mode is missing");
    made = square();
    made.view(0)["extensions"][kName] = 7;
    EXPECT_EQ(refusal(made.whole().load()), who + " is not an object");
}

// A few bytes that say they become half a terabyte, once or little by little: refused before memory is taken.
TEST(Meshopt, AMeshThatBecomesTooLargeIsRefused) {
    Compressed made = square();
    made.compression(0)["count"] = 2'147'483'647;
    made.compression(0)["byteStride"] = 256;
    EXPECT_THAT(refusal(made.whole().load()),
                HasSubstr("becomes 549755813632 bytes, but its bufferView has 1200"));
    made.compression(0)["count"] = 2'147'483'644 / 4;
    made.compression(0)["byteStride"] = 4;
    made.view(0)["byteLength"] = 2'147'483'644;
    EXPECT_THAT(
        refusal(made.whole().load()),
        HasSubstr("bufferViews[0].EXT_meshopt_compression brings the model to more than the limit of "));
    LoadLimits limits;
    const Gltf whole = square().whole();
    // The file, what its data URI holds, and what that becomes.
    limits.maxTotalBytes = whole.text().size() + whole.root["buffers"][0]["uri"].get<std::string>().size() +
                           1200 + squareIndices().size() * 4;
    EXPECT_EQ(refusal(whole.load(limits)), "");
    --limits.maxTotalBytes;
    EXPECT_THAT(refusal(whole.load(limits)), HasSubstr("bufferViews[1].EXT_meshopt_compression brings"));
}

// Cut short anywhere, or of another mode.
TEST(Meshopt, BrokenStreamsAreRefused) {
    for (const size_t view : {0u, 1u})
        for (const char* mode : {"TRIANGLES", "INDICES"}) {
            const size_t whole = square(mode).compression(view)["byteLength"];
            for (size_t length = 0; length < whole; ++length) {
                Compressed made = square(mode);
                made.compression(view)["byteLength"] = length;
                ASSERT_EQ(refusal(made.whole().load()), "bufferViews[" + std::to_string(view) +
                                                            "].EXT_meshopt_compression holds a broken stream")
                    << length << " of " << whole << " bytes of " << mode;
            }
        }
    Compressed made = square();
    made.compression(1)["mode"] = "INDICES";
    EXPECT_THAT(refusal(made.whole().load()), HasSubstr("holds a broken stream"));
}

} // namespace
} // namespace shoal::scene
