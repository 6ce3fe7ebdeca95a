#include "engine/render/FloorShadowPass.h"

#include "shaders/render/Attributes.glsl"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::render {

namespace {

constexpr int kMaxCells = 28; // most cells along a shadow
constexpr float kFinest_m = 0.03f;
constexpr glm::vec3 kLuminance(0.2126f, 0.7152f, 0.0722f);

} // namespace

Result<FloorShadowPass> FloorShadowPass::make() {
    FloorShadowPass pass;
    if (Status s = gl::Program::load("render/FloorShadow").moveTo(pass.program_); !s) return s.error();
    pass.drawn_ = TriangleBatch::make({{ATTRIBUTE_POSITION, 3}, {ATTRIBUTE_COLOUR, 1}});
    return pass;
}

void FloorShadowPass::begin() {
    triangles_.clear();
}

void FloorShadowPass::add(std::span<const occlusion::Ellipsoid> body, const CastingLight& light,
                          float floor_m, FrameCoding frames) {
    if (!(light.towards.y > 0)) return;
    flatten(body, light, body_);
    glm::vec2 low(INFINITY), high(-INFINITY); // x and z of the floor that the body may shade
    float softness_m = INFINITY;              // least width of a penumbra
    for (const FlatPiece& piece : body_) {
        const float fall = (piece.middle.y - floor_m) / light.towards.y;
        if (!(fall > 0)) continue;
        const glm::vec3 place = piece.middle - light.towards * fall;
        const float softness = std::max(light.tangent * fall, kFinest_m);
        // A disc at right angles to the light casts an ellipse on the floor, longer by 1 / cosine.
        const float reach = (std::hypot(piece.halfAlong_m, piece.halfAside_m) + softness) / light.towards.y;
        low = glm::min(low, glm::vec2(place.x, place.z) - reach);
        high = glm::max(high, glm::vec2(place.x, place.z) + reach);
        softness_m = std::min(softness_m, softness);
    }
    if (!(low.x < high.x)) return;
    // Three nodes to a penumbra: between them the taken share is nearly linear.
    const glm::vec2 size = high - low;
    const glm::ivec2 cells =
        glm::clamp(glm::ivec2(glm::ceil(3.0f * size / softness_m)), glm::ivec2(1), glm::ivec2(kMaxCells));
    nodes_.clear();
    float most = 0;
    for (int y = 0; y <= cells.y; ++y)
        for (int x = 0; x <= cells.x; ++x) {
            const glm::vec2 at = low + size * glm::vec2(x, y) / glm::vec2(cells);
            const glm::vec3 place(at.x, floor_m, at.y);
            const float hidden = light.presence * covered(body_, light, place);
            // Radiance of frames coded as in the thesis is proportional to the square root of light:
            // remainingOf().
            glm::vec3 left = 1.0f - hidden * light.share;
            if (frames == FrameCoding::Thesis) left *= left;
            nodes_.push_back({place, hidden > 0 ? 1 - glm::dot(kLuminance, left) : 0});
            most = std::max(most, nodes_.back().taken);
        }
    if (most <= kMinShadow) return;
    const float strength = glm::smoothstep(kMinShadow, 2 * kMinShadow, most); // so that it appears gradually
    for (Node& node : nodes_) node.taken *= strength;
    const size_t stride = static_cast<size_t>(cells.x) + 1;
    for (size_t node = 0; node + stride + 1 < nodes_.size(); ++node)
        if (node % stride != stride - 1 && // a row's last node begins no cell
            nodes_[node].taken + nodes_[node + 1].taken + nodes_[node + stride].taken +
                    nodes_[node + stride + 1].taken >
                0)
            for (const size_t offset : {size_t{0}, size_t{1}, stride, stride, size_t{1}, stride + 1})
                triangles_.push_back(nodes_[node + offset]);
}

void FloorShadowPass::draw(const View& view) {
    if (triangles_.empty()) return;
    program_.use();
    program_.set("clipFromWorld", view.clipFromWorld());
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_FALSE);
    drawn_.draw(triangles_, TriangleBatch::DepthTest::On);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}

} // namespace shoal::render
