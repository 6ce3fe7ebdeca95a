#include "engine/render/ShadowPass.h"

#include "shaders/render/Attributes.glsl"

#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <initializer_list>

namespace shoal::render {

namespace {
constexpr float kMin = 0.012f; // of the surface's light: at most three of 255 display values
} // namespace

glm::vec3 leftOf(const glm::vec3& taken, FrameCoding frames, const water::Water& water, float distance_m) {
    const glm::vec3 left = 1.0f - taken;
    const glm::vec3 arrives = glm::exp(-water.attenuation_perM * distance_m);
    return glm::sqrt(1.0f - (1.0f - (frames == FrameCoding::Srgb ? left : left * left)) * arrives);
}

Result<ShadowPass> ShadowPass::make() {
    ShadowPass pass;
    if (Status s = gl::Program::load("render/Shadow").moveTo(pass.plain_); !s) return s.error();
    if (Status s = gl::Program::load("render/Shadow", {"COVERED"}).moveTo(pass.covered_); !s)
        return s.error();
    pass.drawn_ = TriangleBatch::make({{ATTRIBUTE_POSITION, 3}, {ATTRIBUTE_COLOUR, 3}});
    return pass;
}

void ShadowPass::begin() {
    nodes_.clear();
    corners_.clear();
}

void ShadowPass::add(std::span<const occlusion::Ellipsoid> body, const CastingLight& light,
                     const FilmSurface& film, std::span<const View> eyes) {
    flatten(body, light, body_);
    if (std::ranges::none_of(eyes, [&](const View& eye) { return mayBeSeen(body_, light, eye); })) return;
    castOn(film, body_, light, kMin, grid_);
    if (grid_.across == 0) return;
    const size_t first = nodes_.size(), stride = static_cast<size_t>(grid_.across) + 1;
    const auto triangle = [&](size_t a, size_t b, size_t c) {
        if (grid_.shades(a, b, c))
            for (const size_t corner : {a, b, c}) corners_.push_back(first + corner);
    };
    for (size_t row = 0; row < static_cast<size_t>(grid_.down); ++row)
        for (size_t cell = row * stride; cell + 1 < (row + 1) * stride; ++cell) {
            triangle(cell, cell + 1, cell + stride);
            triangle(cell + stride, cell + 1, cell + stride + 1);
        }
    nodes_.insert(nodes_.end(), grid_.nodes.begin(), grid_.nodes.end());
}

void ShadowPass::draw(const View& view, FrameCoding frames, const water::Water& water, const Cover* cover) {
    seen_.clear();
    triangles_.clear();
    if (corners_.empty()) return;
    for (const ShadowGrid::Node& node : nodes_)
        seen_.push_back(
            {node.place, node.taken == glm::vec3(0)
                             ? glm::vec3(1)
                             : leftOf(node.taken, frames, water, glm::distance(node.place, view.eyeWorld))});
    for (const size_t corner : corners_) triangles_.push_back(seen_[corner]);
    const gl::Program& program = cover ? covered_ : plain_;
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE);
    program.use();
    program.set("clipFromWorld", view.clipFromWorld());
    if (cover) {
        program.setTexture("cover", 0, cover->texture);
        program.set("coverScale", 1.0f / (cover->wider * glm::vec2(cover->size)));
        program.set("coverShift", glm::vec2(0.5f - 0.5f / cover->wider));
    }
    drawn_.draw(triangles_);
    glDisable(GL_BLEND);
}

} // namespace shoal::render
