#include "engine/render/FloorShadowPass.h"

#include "shaders/render/Attributes.glsl"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace shoal::render {

namespace {

constexpr int kMaxCells = 28; // most cells along a shadow
constexpr float kFinest_m = 0.03f;
constexpr glm::vec3 kLuminance(0.2126f, 0.7152f, 0.0722f);

// The part of the floor that a body may shade: x and z, world.
struct Footprint {
    glm::vec2 low{INFINITY}, high{-INFINITY};
    float softness_m = INFINITY; // least width of a penumbra
};

std::optional<Footprint> footprintOf(std::span<const FlatPiece> body, const CastingLight& light,
                                     float floor_m) {
    Footprint found;
    for (const FlatPiece& piece : body) {
        const float fall = (piece.middle.y - floor_m) / light.towards.y;
        if (!(fall > 0)) continue;
        const glm::vec3 place = piece.middle - light.towards * fall;
        const float softness = std::max(light.tangent * fall, kFinest_m);
        // A disc at right angles to the light is an ellipse on the floor, longer by the cosine.
        const float reach = (std::hypot(piece.halfAlong_m, piece.halfAside_m) + softness) / light.towards.y;
        found.low = glm::min(found.low, glm::vec2(place.x, place.z) - reach);
        found.high = glm::max(found.high, glm::vec2(place.x, place.z) + reach);
        found.softness_m = std::min(found.softness_m, softness);
    }
    if (!(found.low.x < found.high.x)) return std::nullopt;
    return found;
}

// Returns the taken share of the light's luminance. Radiance of frames coded as in the thesis is proportional
// to display values, the square roots of light (see leftOf()).
float takenOf(const glm::vec3& share, FrameCoding frames) {
    const glm::vec3 left = 1.0f - share;
    return 1 - glm::dot(kLuminance, frames == FrameCoding::Srgb ? left : left * left);
}

} // namespace

Result<FloorShadowPass> FloorShadowPass::make() {
    FloorShadowPass pass;
    if (Status s = gl::Program::load("render/FloorShadow").moveTo(pass.program_); !s) return s.error();
    pass.drawn_ = TriangleBatch::make({{ATTRIBUTE_POSITION, 3}, {ATTRIBUTE_COLOUR, 1}});
    return pass;
}

void FloorShadowPass::begin() {
    triangles_.clear();
    spheres_.clear();
}

void FloorShadowPass::add(std::span<const occlusion::Ellipsoid> body, const CastingLight& light,
                          float floor_m, FrameCoding frames) {
    if (!(light.towards.y > 0)) return;
    flatten(body, light, body_);
    const auto footprint = footprintOf(body_, light, floor_m);
    if (!footprint) return;
    const glm::vec2 size = footprint->high - footprint->low;
    // Three nodes to a penumbra: between them the taken share is nearly linear.
    const glm::ivec2 cells = glm::clamp(glm::ivec2(glm::ceil(3.0f * size / footprint->softness_m)),
                                        glm::ivec2(1), glm::ivec2(kMaxCells));
    nodes_.clear();
    float most = 0;
    for (int y = 0; y <= cells.y; ++y)
        for (int x = 0; x <= cells.x; ++x) {
            const glm::vec2 at = footprint->low + size * glm::vec2(x, y) / glm::vec2(cells);
            const glm::vec3 place(at.x, floor_m, at.y);
            const float hidden = light.presence * covered(body_, light, place);
            nodes_.push_back({place, hidden > 0 ? takenOf(hidden * light.share, frames) : 0});
            most = std::max(most, nodes_.back().taken);
        }
    if (most <= kMinShadow) return;
    const float strength = glm::smoothstep(kMinShadow, 2 * kMinShadow, most); // faint at first
    for (Node& node : nodes_) node.taken *= strength;
    const auto triangle = [&](int a, int b, int c) {
        const Node corners[] = {nodes_[static_cast<size_t>(a)], nodes_[static_cast<size_t>(b)],
                                nodes_[static_cast<size_t>(c)]};
        if (corners[0].taken + corners[1].taken + corners[2].taken > 0)
            triangles_.insert(triangles_.end(), std::begin(corners), std::end(corners));
    };
    const int stride = cells.x + 1;
    for (int row = 0; row < cells.y; ++row)
        for (int cell = row * stride; cell < row * stride + cells.x; ++cell) {
            triangle(cell, cell + 1, cell + stride);
            triangle(cell + stride, cell + 1, cell + stride + 1);
        }
    const glm::vec2 middle = footprint->low + size / 2.0f;
    spheres_.push_back({{middle.x, floor_m, middle.y}, glm::length(size) / 2});
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
