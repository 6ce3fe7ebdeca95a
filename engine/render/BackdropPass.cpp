#include "engine/render/BackdropPass.h"

#include "engine/gl/Renderer.h"
#include "engine/math/LatLong.h"
#include "engine/render/LatLongPass.h"
#include "shaders/render/Attributes.glsl"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <thread>

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

// Where cells meet: whole pixels, of larger pictures eight at a time, which are sampled together.
void findEdges(float halfExtent, int pixels, std::vector<int>& edges) {
    const int wanted = std::clamp(static_cast<int>(std::ceil(2 * halfExtent / kCell)), 1, 256);
    const int cells = std::clamp(wanted, 1, std::max(pixels, 1)), step = pixels / cells >= 16 ? 8 : 1;
    edges.clear();
    for (int k = 0; k < cells; ++k)
        edges.push_back(static_cast<int>(int64_t{k} * pixels / cells) / step * step);
    edges.push_back(pixels);
}

// What the bound framebuffer's colours are, if all of a texture's.
GLuint drawnTexture() {
    GLint type = GL_NONE, name = 0, bound = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    if (bound == 0 || glIsEnabled(GL_STENCIL_TEST)) return 0;
    const auto ask = [](GLenum what, GLint& answer) {
        glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, what, &answer);
    };
    ask(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, type);
    if (type == GL_TEXTURE) ask(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, name);
    return static_cast<GLuint>(name);
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
    if (gl::rendersInSoftware() && canSampleFrames())
        pass.crew_.emplace(std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 4) - 1);
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

void BackdropPass::makeCells(const View& view, const glm::mat3& envFromRay, const glm::ivec2& size) {
    const glm::vec2 half = view.halfExtent();
    findEdges(half.x, size.x, columns_);
    findEdges(half.y, size.y, rows_);
    uvs_.clear();
    for (const int y : rows_)
        for (const int x : columns_) {
            const glm::vec2 place = 2.0f * glm::vec2(x, y) / glm::vec2(size) - 1.0f;
            uvs_.push_back(
                latLongFromDirection(glm::normalize(envFromRay * glm::vec3(place * half + view.shift, -1))));
        }
    cells_.clear();
    for (size_t y = 0; y + 1 < rows_.size(); ++y)
        for (size_t x = 0; x + 1 < columns_.size(); ++x) {
            const size_t at = y * columns_.size() + x, above = at + columns_.size();
            std::array<glm::vec2, 4> uv = {uvs_[at], uvs_[at + 1], uvs_[above], uvs_[above + 1]};
            // The map repeats: all corners on one side of the seam.
            for (glm::vec2& each : uv) each.x += std::round(uv[0].x - each.x);
            Cell cell{{columns_[x], rows_[y]}, {columns_[x + 1], rows_[y + 1]}};
            cell.right = rounded(0.5f * (uv[1] - uv[0] + uv[3] - uv[2]));
            cell.up = rounded(0.5f * (uv[2] - uv[0] + uv[3] - uv[1]));
            cell.first = rounded(0.25f * (uv[0] + uv[1] + uv[2] + uv[3]) - 0.5f * (cell.right + cell.up));
            cell.drawnAs = std::abs(uv[0].y - 0.5f) > kPolarV ? Cell::Polar : Cell::Plain;
            cells_.push_back(cell);
        }
}

// Whole rows of cells belong to one thread: a cell is written over what the one before it wrote too far.
void BackdropPass::SampleRow::operator()(int row) const {
    const auto r = static_cast<size_t>(row);
    for (size_t k = pass->sampledRows_[r]; k < pass->sampledRows_[r + 1]; ++k)
        sampleCell(pass->sampledFrame_, pass->sampled_[k], pass->picture_.data(), pass->stride_);
}

void BackdropPass::startSampling(const InMemory& inMemory, const glm::ivec2& size) {
    const CodedFrame& frame = inMemory.frame;
    const glm::vec2 texels(frame.width, frame.height);
    sampledFrame_ = frame;
    sampled_.clear();
    sampledRows_.clear();
    for (Cell& cell : cells_) {
        if (cell.low.x == 0) sampledRows_.push_back(sampled_.size());
        if (cell.drawnAs != Cell::Plain) continue;
        const glm::vec2 right = cell.right * texels / static_cast<float>(cell.high.x - cell.low.x);
        const glm::vec2 up = cell.up * texels / static_cast<float>(cell.high.y - cell.low.y);
        const SampledCell sampled{cell.low, cell.high, cell.first * texels + 0.5f * (right + up) - 0.5f,
                                  right, up};
        if (!isWithin(frame, sampled)) continue;
        if (inMemory.painted) {
            const glm::vec2 end = cell.first + cell.right + cell.up;
            const glm::vec2 low = glm::min(cell.first, end) + glm::min(glm::min(cell.right, cell.up), 0.0f);
            const glm::vec2 high = glm::max(cell.first, end) + glm::max(glm::max(cell.right, cell.up), 0.0f);
            if (inMemory.painted->isChosen(low, high)) continue;
        }
        cell.drawnAs = Cell::Sampled;
        sampled_.push_back(sampled);
    }
    sampledRows_.push_back(sampled_.size());
    stride_ = size.x + 8; // of which a row's last cell may write seven
    picture_.resize(static_cast<size_t>(stride_) * static_cast<size_t>(size.y));
    sampleRow_ = {this};
    crew_->start(static_cast<int>(sampledRows_.size()) - 1, sampleRow_);
    begun_ = true;
}

void BackdropPass::finishSampling() {
    crew_->finish();
    begun_ = false;
}

void BackdropPass::putPicture(const glm::ivec2& size, GLuint texture) const {
    if (sampled_.empty()) return;
    glBindTexture(GL_TEXTURE_2D, texture);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, stride_);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.x, size.y, GL_BGRA, GL_UNSIGNED_BYTE, picture_.data());
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

void BackdropPass::begin(const SurroundGpu& surround, const View& view, const glm::mat3& envFromWorld,
                         const Exposure& exposure, const glm::ivec2& size, const InMemory& inMemory) {
    if (!crew_ || featuresOf(surround, exposure) != kAsIs) return;
    if (begun_) finishSampling(); // of a picture that was not drawn
    makeCells(view, envFromWorld * glm::mat3_cast(view.worldFromEye), size);
    startSampling(inMemory, size);
}

Status BackdropPass::draw(const SurroundGpu& surround, const View& view, const glm::mat3& envFromWorld,
                          const Exposure& exposure, const InMemory* inMemory) {
    const glm::mat3 envFromRay = envFromWorld * glm::mat3_cast(view.worldFromEye);
    std::array<GLint, 4> viewport{};
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    const glm::ivec2 size(viewport[2], viewport[3]);
    const unsigned features = featuresOf(surround, exposure);
    const GLuint texture = crew_ && inMemory && features == kAsIs ? drawnTexture() : 0;
    const bool begun = begun_;
    if (begun) finishSampling();
    if (!begun || texture == 0) makeCells(view, envFromRay, size);
    if (texture != 0) {
        if (!begun) startSampling(*inMemory, size), finishSampling();
        putPicture(size, texture);
    }

    corners_.clear();
    const auto put = [&](Cell::DrawnAs as) {
        for (const Cell& cell : cells_) {
            if (cell.drawnAs != as) continue;
            for (int i = 0; i < 4; ++i) {
                const glm::ivec2 at(i & 1 ? cell.high.x : cell.low.x, i >> 1 ? cell.high.y : cell.low.y);
                corners_.push_back({2.0f * glm::vec2(at) / glm::vec2(size) - 1.0f,
                                    cell.first + static_cast<float>(i & 1) * cell.right +
                                        static_cast<float>(i >> 1) * cell.up});
            }
        }
        return corners_.size() / 4;
    };
    const size_t plain = put(Cell::Plain), all = put(Cell::Polar);
    if (all == 0) return Done{};
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
    const auto drawCells = [&](unsigned drawn, size_t first, size_t count) -> Status {
        if (count == 0) return Done{};
        auto found = programs_.get(drawn);
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
    if (Status s = drawCells(features, 0, plain); !s) return s;
    if (Status s = drawCells(features | kPolar, plain, all - plain); !s) return s;
    glBindVertexArray(0);
    return Done{};
}

} // namespace shoal::render
