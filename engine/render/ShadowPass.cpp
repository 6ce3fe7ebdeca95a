#include "engine/render/ShadowPass.h"

#include "shaders/render/Attributes.glsl"

#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>

namespace shoal::render {

namespace {
constexpr float kMin = 0.012f;            // of the ground's light: at most three of 255 display values
constexpr float kUnseen = 1 - 0.5f / 255; // a factor that leaves display values what they are

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

glm::vec3 leftOfGround(const FloorLight& light, FrameCoding frames, float hidden, const water::Water& water,
                       float distance_m) {
    const glm::vec3 left = 1.0f - hidden * light.share;
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

glm::vec2 ShadowPass::Patch::at(int x, int y) const {
    return floor.low + (floor.high - floor.low) * glm::vec2(x, y) / glm::vec2(floor.across, floor.down);
}

void ShadowPass::begin() {
    patches_.clear();
    flat_.clear();
}

void ShadowPass::add(std::span<const occlusion::Ellipsoid> body, const FloorLight& light) {
    flatten(body, light, body_);
    const FloorPatch floor = patchOf(body_, light, kMin);
    if (floor.across == 0) return;
    patches_.push_back({floor, flat_.size(), body_.size()});
    flat_.insert(flat_.end(), body_.begin(), body_.end());
}

void ShadowPass::draw(const View& view, const FloorLight& light, FrameCoding frames,
                      const water::Water& water, const Cover* cover) {
    triangles_.clear();
    const glm::mat4 clipFromWorld = view.clipFromWorld();
    for (const Patch& patch : patches_) {
        const int across = patch.floor.across, down = patch.floor.down, stride = across + 1;
        const auto onGround = [&](int x, int y) {
            const glm::vec2 xz = patch.at(x, y);
            return glm::vec3(xz.x, light.height_m, xz.y);
        };
        if (isUnseen({onGround(0, 0), onGround(across, 0), onGround(0, down), onGround(across, down)},
                     clipFromWorld))
            continue;
        const std::span body(flat_.data() + patch.firstPiece, patch.pieces);
        grid_.clear();
        for (int y = 0; y <= down; ++y)
            for (int x = 0; x <= across; ++x) {
                const glm::vec3 place = onGround(x, y);
                const float here = patch.floor.strength * covered(body, light, {place.x, place.z});
                const float away = glm::distance(place, view.eyeWorld);
                grid_.push_back(
                    {place, here > 0 ? leftOfGround(light, frames, here, water, away) : glm::vec3(1)});
            }
        for (int y = 0; y < down; ++y)
            for (int x = 0; x < across; ++x) {
                const int cell = y * stride + x;
                const auto dims = [&](int i) {
                    const glm::vec3& left = grid_[static_cast<size_t>(cell + i)].left;
                    return std::min({left.x, left.y, left.z}) < kUnseen;
                };
                if (!dims(0) && !dims(1) && !dims(stride) && !dims(stride + 1)) continue;
                for (const int i : {0, 1, stride, stride, 1, stride + 1})
                    triangles_.push_back(grid_[static_cast<size_t>(cell + i)]);
            }
    }
    if (triangles_.empty()) return;
    const gl::Program& program = cover ? covered_ : plain_;
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE);
    program.use();
    program.set("clipFromWorld", clipFromWorld);
    if (cover) {
        program.setTexture("cover", 0, cover->texture);
        program.set("coverScale", 1.0f / (cover->wider * glm::vec2(cover->size)));
        program.set("coverShift", glm::vec2(0.5f - 0.5f / cover->wider));
    }
    drawn_.draw(triangles_);
    glDisable(GL_BLEND);
}

} // namespace shoal::render
