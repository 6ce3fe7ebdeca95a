#include "engine/render/LatLongPass.h"

#include "engine/math/LatLong.h"
#include "engine/render/ObjectPass.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace shoal::render {

namespace {

constexpr std::array<const char*, 3> kDefines = {"FILMED", "GRAINY", "SHARES_COLOUR"}; // as FilmedFeature
// Of the frame: 16 x 16 texels of a 2048 x 1024 one. A row of texels bends by sin(2 latitude) / 16 of the
// square of a tile's longitude from the straight line that its rays are drawn on: a twentieth of a texel.
constexpr glm::ivec2 kTiles(128, 64);
constexpr float kMargin = 2; // texels that a layer's filter spreads an object by

void attach(const gl::Framebuffer& framebuffer, GLuint texture) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    assert(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
}

} // namespace

View widened(const View& view, float factor) {
    View wide = view;
    wide.verticalFov = 2 * std::atan(factor * std::tan(view.verticalFov / 2));
    return wide;
}

Result<LatLongPass> LatLongPass::make() {
    LatLongPass pass;
    pass.programs_ = gl::Variants("render/LatLong", kDefines);
    // Compiled now, so that a broken shader is known at the start.
    for (const unsigned features : {0u, static_cast<unsigned>(kFilmed)})
        if (auto program = pass.programs_.get(features); !program) return program.error();
    pass.drawn_ = Corners::make();
    pass.frameBuffer_ = gl::Framebuffer::make();
    pass.keptBuffer_ = gl::Framebuffer::make();
    return pass;
}

// The tiles of a cap around a direction. Its meridians are furthest from the middle one where they touch it:
// sin(longitude) = sin(angle) / cos(latitude); a cap that holds a pole touches all.
void LatLongPass::mark(const glm::vec3& dirEnv, float halfAngle) {
    constexpr float kPi = std::numbers::pi_v<float>;
    const float angle = halfAngle + kMargin * kPi / static_cast<float>(size_.y);
    const glm::vec2 uv = latLongFromDirection(dirEnv);
    const float latitude = (0.5f - uv.y) * kPi;
    const bool polar = std::abs(latitude) + angle >= kPi / 2;
    const float across = polar ? 0.5f : std::asin(std::sin(angle) / std::cos(latitude)) / (2 * kPi);
    const auto tile = [](float share, int tiles) {
        return static_cast<int>(std::floor(share * static_cast<float>(tiles)));
    };
    const int top = std::max(tile(uv.y - angle / kPi, kTiles.y), 0);
    const int bottom = std::min(tile(uv.y + angle / kPi, kTiles.y), kTiles.y - 1);
    const int left = tile(uv.x - across, kTiles.x);
    const int right = std::min(tile(uv.x + across, kTiles.x), left + kTiles.x - 1);
    for (int y = top; y <= bottom; ++y)
        for (int x = left; x <= right; ++x) // columns repeat: the seam is none
            chosen_[static_cast<size_t>(y * kTiles.x + (x + 2 * kTiles.x) % kTiles.x)] = true;
}

void LatLongPass::copy(GLuint from, GLuint to) const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
    for (const Run& r : runs_)
        glBlitFramebuffer(r.x, r.y, r.x + r.width, r.y + r.height, r.x, r.y, r.x + r.width, r.y + r.height,
                          GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

bool LatLongPass::isChosen(const glm::vec2& low, const glm::vec2& high) const {
    if (chosen_.empty()) return false;
    const glm::vec2 texel = 1.0f / glm::vec2(size_);
    const glm::ivec2 first(glm::floor((low - texel) * glm::vec2(kTiles)));
    const glm::ivec2 last(glm::floor((high + texel) * glm::vec2(kTiles)));
    for (int y = std::max(first.y, 0); y <= std::min(last.y, kTiles.y - 1); ++y)
        for (int x = first.x; x <= last.x; ++x)
            if (chosen_[static_cast<size_t>(y * kTiles.x + (x + 2 * kTiles.x) % kTiles.x)]) return true;
    return false;
}

void LatLongPass::restore(const SurroundGpu& surround) {
    if (paintedFrame_ != 0 && paintedFrame_ == surround.frameNumber())
        copy(keptBuffer_.name(), frameBuffer_.name());
    paintedFrame_ = 0;
}

void LatLongPass::choose(const SurroundGpu& surround, const glm::mat3& envFromWorld,
                         std::span<const Ball> balls, const glm::vec3& eyeWorld) {
    size_ = {surround.frameWidth(), surround.frameHeight()};
    chosen_.assign(static_cast<size_t>(kTiles.x * kTiles.y), false);
    for (const Ball& ball : balls) {
        const glm::vec3 away = ball.centre - eyeWorld;
        const float distance = glm::length(away);
        // Around the eye: everywhere.
        const float halfAngle =
            distance > ball.radius ? std::asin(ball.radius / distance) : std::numbers::pi_v<float>;
        mark(distance > 0 ? envFromWorld * (away / distance) : glm::vec3(0, 0, -1), halfAngle);
    }
}

Status LatLongPass::paint(const SurroundGpu& surround, GLuint layer, const View& layerView,
                          const glm::mat3& envFromWorld, const Filmed* filmed) {
    assert(surround.frameIsCoded());
    restore(surround);
    const glm::ivec2 size(surround.frameWidth(), surround.frameHeight());
    assert(size == size_);
    if (size != keptSize_) {
        keptSize_ = size;
        kept_ = gl::Texture::make();
        glBindTexture(GL_TEXTURE_2D, kept_.name());
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, size.x, size.y, 0, GL_BGRA, GL_UNSIGNED_BYTE, nullptr);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
        attach(keptBuffer_, kept_.name());
    }

    runs_.clear();
    corners_.clear();
    const auto edge = [](int tile, int tiles, int texels) { return tile * texels / tiles; };
    eachRun(chosen_, kTiles, [&](int first, int end, int row) {
        const glm::ivec2 low(edge(first, kTiles.x, size.x), edge(row, kTiles.y, size.y));
        const glm::ivec2 high(edge(end, kTiles.x, size.x), edge(row + 1, kTiles.y, size.y));
        if (low.x == high.x || low.y == high.y) return;
        runs_.push_back({low.x, low.y, high.x - low.x, high.y - low.y});
        for (int tile = first; tile < end; ++tile) {
            const glm::vec2 left(edge(tile, kTiles.x, size.x), low.y),
                right(edge(tile + 1, kTiles.x, size.x), high.y);
            if (left.x < right.x) addRectangle(left / glm::vec2(size), right / glm::vec2(size), corners_);
        }
    });
    if (runs_.empty()) return Done{};
    attach(frameBuffer_, surround.frameTexture());
    copy(frameBuffer_.name(), keptBuffer_.name());
    paintedFrame_ = surround.frameNumber();

    auto found = programs_.get(filmed ? filmedFeatures(filmed->look) : 0);
    if (!found) return found.error();
    const gl::Program& program = **found;
    glBindFramebuffer(GL_FRAMEBUFFER, frameBuffer_.name());
    glViewport(0, 0, size.x, size.y);
    program.use();
    if (filmed) {
        if (!grain_) grain_ = makeGrain();
        setFilmed(program, filmed->look, filmed->index);
        surround.bindScattered(program, 1);
        glActiveTexture(GL_TEXTURE2);
        glBindTexture(GL_TEXTURE_2D, kept_.name());
        program.set("kept", 2);
        glActiveTexture(GL_TEXTURE3);
        glBindTexture(GL_TEXTURE_2D, grain_.name());
        program.set("grain", 3);
    }
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, layer);
    program.set("layer", 0);
    program.set("eyeFromEnv", glm::transpose(envFromWorld * glm::mat3_cast(layerView.worldFromEye)));
    program.set("rayScale", layerView.halfExtent());
    program.set("rayShift", layerView.shift);
    if (filmed)
        drawn_.draw(corners_); // mixes by itself
    else
        drawn_.drawOver(corners_);
    return Done{};
}

} // namespace shoal::render
