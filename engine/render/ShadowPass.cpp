#include "engine/render/ShadowPass.h"

#include "shaders/render/Attributes.glsl"

#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace shoal::render {

namespace {
constexpr float kLeast = 0.012f; // of the ground's light: three of 255 display values where it is bright

// Whether all corners of the rectangle lie beyond one side of the view.
bool isUnseen(const std::array<glm::vec3, 4>& corners, const glm::mat4& clipFromWorld) {
    int right = 0, left = 0, above = 0, below = 0, behind = 0;
    for (const glm::vec3& corner : corners) {
        const glm::vec4 clip = clipFromWorld * glm::vec4(corner, 1);
        right += clip.x > clip.w, left += clip.x < -clip.w;
        above += clip.y > clip.w, below += clip.y < -clip.w;
        behind += clip.z < -clip.w;
    }
    return std::max({right, left, above, below, behind}) == 4;
}
} // namespace

glm::vec3 leftOfGround(const FloorLight& light, float hidden, const water::Water& water, float distance_m) {
    const glm::vec3 left = 1.0f - hidden * light.share;
    const glm::vec3 arrives = glm::exp(-water.attenuation_perM * distance_m);
    return glm::sqrt(1.0f - (1.0f - left * left) * arrives);
}

Result<ShadowPass> ShadowPass::make() {
    ShadowPass pass;
    auto program = gl::Program::load("render/Shadow");
    if (!program) return program.error();
    pass.program_ = std::move(*program);
    pass.vertexArray_ = gl::VertexArray::make();
    pass.vertexBuffer_ = gl::Buffer::make();
    pass.indexBuffer_ = gl::Buffer::make();
    glBindVertexArray(pass.vertexArray_.name());
    glBindBuffer(GL_ARRAY_BUFFER, pass.vertexBuffer_.name());
    const auto attribute = [](GLuint location, size_t offset) {
        glEnableVertexAttribArray(location);
        glVertexAttribPointer(location, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                              reinterpret_cast<const void*>(offset));
    };
    attribute(ATTRIBUTE_POSITION, offsetof(Vertex, place));
    attribute(ATTRIBUTE_COLOUR, offsetof(Vertex, left));
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, pass.indexBuffer_.name());
    glBindVertexArray(0);
    return pass;
}

void ShadowPass::begin() {
    patches_.clear();
    places_.clear();
}

void ShadowPass::add(std::span<const CastingPiece> body, const FloorLight& light) {
    const FloorPatch patch = patchOf(body, light, kLeast);
    if (patch.across == 0) return;
    flatten(body, light, flat_);
    patches_.push_back({places_.size(), patch.across, patch.down});
    const glm::vec2 step = (patch.high - patch.low) / glm::vec2(patch.across, patch.down);
    for (int y = 0; y <= patch.down; ++y)
        for (int x = 0; x <= patch.across; ++x) {
            const glm::vec2 xz = patch.low + step * glm::vec2(x, y);
            places_.push_back({xz, patch.strength * covered(flat_, light, xz)});
        }
}

void ShadowPass::draw(const View& view, const FloorLight& light, const water::Water& water) {
    vertices_.clear();
    indices_.clear();
    const glm::mat4 clipFromWorld = view.clipFromWorld();
    const auto onGround = [&](const Place& each) { return glm::vec3(each.xz.x, light.height_m, each.xz.y); };
    for (const Patch& patch : patches_) {
        const int stride = patch.across + 1, last = stride * (patch.down + 1) - 1;
        const std::span places(places_.data() + patch.first, static_cast<size_t>(last) + 1);
        const auto corner = [&](int i) { return onGround(places[static_cast<size_t>(i)]); };
        if (isUnseen({corner(0), corner(patch.across), corner(last - patch.across), corner(last)},
                     clipFromWorld))
            continue;
        const size_t first = vertices_.size();
        for (const Place& each : places) {
            const glm::vec3 place = onGround(each);
            vertices_.push_back(
                {place, leftOfGround(light, each.hidden, water, glm::distance(place, view.eyeWorld))});
        }
        for (int y = 0; y < patch.down; ++y)
            for (int x = 0; x < patch.across; ++x) {
                const int cell = y * stride + x;
                const auto hides = [&](int i) { return places[static_cast<size_t>(cell + i)].hidden > 0; };
                if (!hides(0) && !hides(1) && !hides(stride) && !hides(stride + 1)) continue;
                for (const int i : {0, 1, stride, stride, 1, stride + 1})
                    indices_.push_back(static_cast<uint32_t>(first) + static_cast<uint32_t>(cell + i));
            }
    }
    if (indices_.empty()) return;
    glBindVertexArray(vertexArray_.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertexBuffer_.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices_.size() * sizeof(Vertex)),
                 vertices_.data(), GL_STREAM_DRAW);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices_.size() * sizeof(uint32_t)),
                 indices_.data(), GL_STREAM_DRAW);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE);
    program_.use();
    program_.set("clipFromWorld", clipFromWorld);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(indices_.size()), GL_UNSIGNED_INT, nullptr);
    glDisable(GL_BLEND);
    glBindVertexArray(0);
}

} // namespace shoal::render
