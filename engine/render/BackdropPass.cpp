#include "engine/render/BackdropPass.h"

#include "engine/math/LatLong.h"
#include "shaders/render/Attributes.glsl"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace shoal::render {

namespace {

enum FeatureBit : unsigned {
    kPolar = 1u << 0,
    kAsIs = 1u << 1,
    kFrameIsCoded = 1u << 2,
    kAces = 1u << 3,
    kLinear = 1u << 4,
};
constexpr std::array<const char*, 5> kDefines = {"POLAR", "AS_IS", "FRAME_IS_CODED", "TONE_ACES",
                                                 "TONE_LINEAR"};

unsigned featuresOf(const SurroundGpu& surround, const Exposure& exposure) {
    const bool inverse = exposure.curve == ToneCurve::InverseOfVideo;
    if (surround.frameIsCoded() && inverse && exposure.scale() == 1.0f) return kAsIs;
    return (surround.frameIsCoded() ? kFrameIsCoded : 0u) | (exposure.curve == ToneCurve::Aces     ? kAces
                                                             : exposure.curve == ToneCurve::Linear ? kLinear
                                                                                                   : 0u);
}

// Of the image plane at distance 1: so small that a map's coordinates are as good as affine within a cell. Of
// a 2048 wide video at most 0.1 texels off up to 45 degrees of latitude, 0.2 where polar cells begin.
constexpr float kCell = 0.04f;
constexpr float kPolarV = 0.3234f; // of the map's height, from its middle: a latitude whose sine is 0.85

int cellsAcross(float halfExtent) {
    return std::clamp(static_cast<int>(std::ceil(2 * halfExtent / kCell)), 1, 256);
}

// So coarse that sums of a few of them are exact: corners then lie in one plane to the last bit, by which
// llvmpipe knows a rectangle. 1/1024 texel of a 2048 wide video.
glm::vec2 rounded(const glm::vec2& uv) {
    constexpr float kSteps = 1 << 21;
    return glm::round(uv * kSteps) / kSteps;
}

} // namespace

Result<BackdropPass> BackdropPass::make() {
    BackdropPass pass;
    pass.programs_ = gl::Variants("render/Backdrop", kDefines);
    pass.vertexArray_ = gl::VertexArray::make();
    pass.vertices_ = gl::Buffer::make();
    pass.indices_ = gl::Buffer::make();
    glBindVertexArray(pass.vertexArray_.name());
    glBindBuffer(GL_ARRAY_BUFFER, pass.vertices_.name());
    const auto attribute = [](GLuint location, size_t offset) {
        glEnableVertexAttribArray(location);
        glVertexAttribPointer(location, 2, GL_FLOAT, GL_FALSE, sizeof(Corner),
                              reinterpret_cast<const void*>(offset));
    };
    attribute(ATTRIBUTE_POSITION, offsetof(Corner, place));
    attribute(ATTRIBUTE_UV0, offsetof(Corner, uv));
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, pass.indices_.name());
    glBindVertexArray(0);
    // Compiled now, so that a broken shader is known at the start.
    for (const unsigned features : {0u, static_cast<unsigned>(kPolar)})
        if (auto program = pass.programs_.get(kAsIs | features); !program) return program.error();
    return pass;
}

size_t BackdropPass::makeCells(const View& view, const glm::mat3& envFromRay) {
    const glm::vec2 half = view.halfExtent();
    const int across = cellsAcross(half.x), down = cellsAcross(half.y), stride = across + 1;
    const auto placeOf = [&](int x, int y) {
        return 2.0f * glm::vec2(x, y) / glm::vec2(across, down) - 1.0f;
    };
    uvs_.clear();
    for (int y = 0; y <= down; ++y)
        for (int x = 0; x <= across; ++x) {
            const glm::vec3 ray =
                glm::normalize(envFromRay * glm::vec3(placeOf(x, y) * half + view.shift, -1));
            uvs_.push_back(latLongFromDirection(ray));
        }
    const auto put = [&](int x, int y) {
        const auto at = [&](int i) { return static_cast<size_t>((y + (i >> 1)) * stride + x + (i & 1)); };
        std::array<glm::vec2, 4> uv = {uvs_[at(0)], uvs_[at(1)], uvs_[at(2)], uvs_[at(3)]};
        // The map repeats: all corners on one side of the seam.
        for (glm::vec2& each : uv) each.x += std::round(uv[0].x - each.x);
        const glm::vec2 right = rounded(0.5f * (uv[1] - uv[0] + uv[3] - uv[2]));
        const glm::vec2 up = rounded(0.5f * (uv[2] - uv[0] + uv[3] - uv[1]));
        const glm::vec2 first = rounded(0.25f * (uv[0] + uv[1] + uv[2] + uv[3]) - 0.5f * (right + up));
        for (int i = 0; i < 4; ++i)
            corners_.push_back({placeOf(x + (i & 1), y + (i >> 1)),
                                first + static_cast<float>(i & 1) * right + static_cast<float>(i >> 1) * up});
    };
    corners_.clear();
    size_t plain = 0;
    for (const bool polarOnes : {false, true}) {
        for (int y = 0; y < down; ++y)
            for (int x = 0; x < across; ++x)
                if ((std::abs(uvs_[static_cast<size_t>(y * stride + x)].y - 0.5f) > kPolarV) == polarOnes)
                    put(x, y);
        if (!polarOnes) plain = corners_.size() / 4;
    }
    return plain;
}

Status BackdropPass::draw(const SurroundGpu& surround, const View& view, const glm::mat3& envFromWorld,
                          const Exposure& exposure) {
    const glm::mat3 envFromRay = envFromWorld * glm::mat3_cast(view.worldFromEye);
    const size_t plain = makeCells(view, envFromRay), all = corners_.size() / 4;
    glBindVertexArray(vertexArray_.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners_.size() * sizeof(Corner)), corners_.data(),
                 GL_STREAM_DRAW);
    if (indexedCells_ < all) {
        std::vector<uint32_t> indices;
        for (uint32_t first = 0; first < 4 * all; first += 4)
            for (const uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) indices.push_back(first + corner);
        glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(uint32_t)),
                     indices.data(), GL_STATIC_DRAW);
        indexedCells_ = all;
    }

    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    const auto drawCells = [&](unsigned features, size_t first, size_t count) -> Status {
        if (count == 0) return Done{};
        auto found = programs_.get(features);
        if (!found) return found.error();
        const gl::Program& program = **found;
        program.use();
        surround.bindFrame(program);
        program.set("envFromRay", envFromRay);
        program.set("rayScale", view.halfExtent());
        program.set("rayShift", view.shift);
        program.set("exposureScale", exposure.scale());
        // Few at a time: llvmpipe cuts longer draws between the triangles of a rectangle.
        constexpr size_t kAtOnce = 160;
        for (size_t done = 0; done < count; done += kAtOnce)
            glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(6 * std::min(kAtOnce, count - done)),
                           GL_UNSIGNED_INT,
                           reinterpret_cast<const void*>(6 * (first + done) * sizeof(uint32_t)));
        return Done{};
    };
    const unsigned features = featuresOf(surround, exposure);
    if (Status s = drawCells(features, 0, plain); !s) return s;
    if (Status s = drawCells(features | kPolar, plain, all - plain); !s) return s;
    glBindVertexArray(0);
    return Done{};
}

} // namespace shoal::render
