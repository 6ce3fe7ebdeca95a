#include "engine/render/BackgroundPass.h"

#include "shaders/render/Attributes.glsl"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace shoal::render {

namespace {

enum FeatureBit : unsigned {
    kPolarBit = 1u << 0,
    kAsIs = 1u << 1,
    kFrameIsCoded = 1u << 2,
    kAces = 1u << 3,
    kLinear = 1u << 4,
};
constexpr std::array<const char*, 5> kBackgroundDefines = {"POLAR", "AS_IS", "FRAME_IS_CODED", "TONE_ACES",
                                                           "TONE_LINEAR"};

unsigned featuresOf(const EnvironmentGpu& environment, const Exposure& exposure) {
    if (showsFrameAsCoded(environment, exposure)) return kAsIs;
    return (environment.frameIsCoded() ? kFrameIsCoded : 0u) |
           (exposure.curve == ToneCurve::Aces     ? kAces
            : exposure.curve == ToneCurve::Linear ? kLinear
                                                  : 0u);
}

} // namespace

bool showsFrameAsCoded(const EnvironmentGpu& environment, const Exposure& exposure) {
    return environment.frameIsCoded() && exposure.curve == ToneCurve::InverseOfVideo &&
           exposure.scale() == 1.0f;
}

Result<std::unique_ptr<BackgroundPass>> BackgroundPass::make(bool withLayers) {
    std::unique_ptr<BackgroundPass> pass(new BackgroundPass);
    if (Status s = pass->setUp(withLayers); !s) return s.error();
    return pass;
}

Status BackgroundPass::setUp(bool withLayers) {
    programs_ = gl::Variants("render/Background", kBackgroundDefines);
    // Compiled now, so that a broken shader is known at the start.
    for (const unsigned features : {0u, static_cast<unsigned>(kPolarBit)})
        if (auto program = programs_.get(kAsIs | features); !program) return program.error();
    if (withLayers) {
        auto composite = EquirectComposite::make();
        if (!composite) return composite.error();
        composite_ = std::move(*composite);
    }
    vertexArray_ = gl::VertexArray::make();
    vertices_ = gl::Buffer::make();
    indices_ = gl::Buffer::make();
    glBindVertexArray(vertexArray_.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    gl::setAttribute(ATTRIBUTE_POSITION, 2, sizeof(Corner), offsetof(Corner, place));
    gl::setAttribute(ATTRIBUTE_UV0, 2, sizeof(Corner), offsetof(Corner, uv));
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
    glBindVertexArray(0);
    return Done{};
}

void BackgroundPass::want(const FrameTiles& tiles, const BackgroundCell& cell) {
    tiles.eachBetween(cell.mapLow(), cell.mapHigh(), [&](size_t tile) { wanted_[tile] = true; });
}

Status BackgroundPass::draw(const EyePicture& picture, const TexelLayer* layer) {
    cells_.make(picture.view, picture.envFromEye(), picture.size());
    wanted_.assign(FrameTiles::kAll, false);
    drawn_.clear();
    bool any = false;
    for (const BackgroundCell& cell : cells_.all()) {
        const bool painted = layer && layer->tiles.isChosen(cell.mapLow(), cell.mapHigh());
        drawn_.push_back({&cell, painted});
        if (!painted) continue;
        want(layer->tiles, cell);
        any = true;
    }
    if (any) {
        const FilmedFrame* filmed = layer->filmed ? &picture.filmed : nullptr;
        if (Status s =
                composite_.paint(picture.environment, layer->tiles, wanted_, layer->layer.layer().texture(),
                                 layer->view, picture.envFromWorld, filmed);
            !s)
            return s;
        picture.canvas.bindColour();
    }
    return drawCells(picture, drawn_, composite_.texture());
}

void BackgroundPass::upload(std::span<const CellToDraw> cells, const glm::ivec2& size) {
    for (std::vector<Corner>& each : corners_) each.clear();
    for (const auto& [cell, painted] : cells) {
        std::vector<Corner>& to =
            corners_[(cell->polar ? kPolar : kPlain) + (painted ? kPaintedPlain : kPlain)];
        for (int i = 0; i < 4; ++i) {
            const glm::ivec2 at(i & 1 ? cell->high.x : cell->low.x, i >> 1 ? cell->high.y : cell->low.y);
            to.push_back({2.0f * glm::vec2(at) / glm::vec2(size) - 1.0f,
                          cell->first + static_cast<float>(i & 1) * cell->right +
                              static_cast<float>(i >> 1) * cell->up});
        }
    }
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(4 * cells.size() * sizeof(Corner)), nullptr,
                 GL_STREAM_DRAW);
    GLintptr put = 0;
    for (const std::vector<Corner>& each : corners_) {
        const auto bytes = static_cast<GLsizeiptr>(each.size() * sizeof(Corner));
        glBufferSubData(GL_ARRAY_BUFFER, put, bytes, each.data());
        put += bytes;
    }
    if (indexedCells_ >= cells.size()) return;
    indexedCells_ = cells.size();
    std::vector<uint32_t> indices;
    for (uint32_t first = 0; first < 4 * indexedCells_; first += 4)
        for (const uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) indices.push_back(first + corner);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(uint32_t)),
                 indices.data(), GL_STATIC_DRAW);
}

Status BackgroundPass::drawCells(const EyePicture& picture, std::span<const CellToDraw> cells,
                                 GLuint painted) {
    if (cells.empty()) return Done{};
    glBindVertexArray(vertexArray_.name());
    upload(cells, picture.size());

    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    size_t first = 0;
    for (size_t kind = 0; kind < kKinds; ++kind) {
        const size_t count = corners_[kind].size() / 4;
        if (count == 0) continue;
        auto found =
            programs_.get(featuresOf(picture.environment, picture.exposure) | (kind % 2 ? kPolarBit : 0u));
        if (!found) return found.error();
        const gl::Program& program = **found;
        program.use();
        program.setTexture("frame", UNIT_FRAME,
                           kind >= kPaintedPlain ? painted : picture.environment.frameTexture());
        program.set("envFromRay", picture.envFromEye());
        program.set("rayScale", picture.view.halfExtent());
        program.set("rayShift", picture.view.shift);
        program.set("exposureScale", picture.exposure.scale());
        // Few at a time: llvmpipe cuts longer draws between the triangles of a rectangle.
        constexpr size_t kAtOnce = 160;
        for (size_t done = 0; done < count; done += kAtOnce)
            glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(6 * std::min(kAtOnce, count - done)),
                           GL_UNSIGNED_INT,
                           reinterpret_cast<const void*>(6 * (first + done) * sizeof(uint32_t)));
        first += count;
    }
    glBindVertexArray(0);
    return Done{};
}

} // namespace shoal::render
