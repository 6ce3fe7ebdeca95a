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

// Cells so small that a map's coordinates are linear in them: at most 0.4 texels of a 2048 wide video off,
// 0.1 on average (0.2 and 0.04 where cells are not taken in fours).
int cellsAcross(float halfExtent) {
    constexpr float kCell = 0.04f; // of the image plane at distance 1
    return std::clamp(static_cast<int>(std::ceil(2 * halfExtent / kCell)), 1, 256);
}

constexpr float kLevelSine = 0.35f;   // below, cells may be twice as large
constexpr float kPolarSine = 0.7071f; // sine of the latitude from which on a cell is polar

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
    // Even, so that cells can be taken in fours.
    const int across = 2 * cellsAcross(half.x / 2), down = 2 * cellsAcross(half.y / 2), stride = across + 1;
    const auto placeOf = [&](int x, int y) {
        return glm::vec2(2 * static_cast<float>(x) / static_cast<float>(across) - 1,
                         2 * static_cast<float>(y) / static_cast<float>(down) - 1);
    };
    uvs_.clear();
    sines_.clear();
    for (int y = 0; y <= down; ++y)
        for (int x = 0; x <= across; ++x) {
            const glm::vec3 ray =
                glm::normalize(envFromRay * glm::vec3(placeOf(x, y) * half + view.shift, -1));
            uvs_.push_back(latLongFromDirection(ray));
            sines_.push_back(std::abs(ray.y));
        }
    const auto put = [&](int x, int y, int size) {
        const float u = uvs_[static_cast<size_t>(y * stride + x)].x;
        for (int i = 0; i < 4; ++i) {
            const int cx = x + size * (i & 1), cy = y + size * (i >> 1);
            glm::vec2 uv = uvs_[static_cast<size_t>(cy * stride + cx)];
            uv.x += std::round(u - uv.x); // the map repeats: all corners on one side of the seam
            corners_.push_back({placeOf(cx, cy), uv});
        }
    };
    corners_.clear();
    size_t plain = 0;
    for (const bool polarOnes : {false, true}) {
        for (int y = 0; y < down; y += 2)
            for (int x = 0; x < across; x += 2) {
                const float sine = sines_[static_cast<size_t>((y + 1) * stride + x + 1)]; // of the middle
                if ((sine > kPolarSine) != polarOnes) continue;
                if (polarOnes || sine < kLevelSine) {
                    put(x, y, 2);
                    continue;
                }
                for (int i = 0; i < 4; ++i) put(x + (i & 1), y + (i >> 1), 1);
            }
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
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(6 * count), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(6 * first * sizeof(uint32_t)));
        return Done{};
    };
    const unsigned features = featuresOf(surround, exposure);
    if (Status s = drawCells(features, 0, plain); !s) return s;
    if (Status s = drawCells(features | kPolar, plain, all - plain); !s) return s;
    glBindVertexArray(0);
    return Done{};
}

} // namespace shoal::render
