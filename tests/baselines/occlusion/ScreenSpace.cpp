#include "tests/baselines/occlusion/ScreenSpace.h"

#include "tests/baselines/occlusion/Directions.h"

#include <cmath>

namespace shoal::occlusion::baselines {

glm::vec3 DepthPicture::toPicture(const glm::vec3& world) const {
    const glm::vec3 eye = eyeFromWorld * glm::vec4(world, 1);
    const float depth = std::max(-eye.z, 1e-6f),
                scale = 0.5f * static_cast<float>(height) / (tanHalfFovY * depth);
    return {0.5f * static_cast<float>(width) + eye.x * scale,
            0.5f * static_cast<float>(height) - eye.y * scale, depth};
}

bool DepthPicture::shows(const glm::vec3& world, float slack_m) const {
    const glm::vec3 at = toPicture(world);
    const glm::ivec2 pixel(glm::floor(glm::vec2(at)));
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= width || pixel.y >= height) return false;
    return at.z < depth_m[static_cast<size_t>(pixel.y) * width + pixel.x] + slack_m;
}

float screenSpaceOcclusion(const DepthPicture& picture, const glm::vec3& position, const glm::vec3& normal,
                           float reach_m, int samples) {
    static const auto directions = cosineDirections(64);
    const glm::mat3 frame = frameAround(normal);
    const auto stride = static_cast<int>(directions.size()) / samples;
    int hidden = 0;
    for (int i = 0; i < samples; ++i) {
        // Radii of even steps, in an order that is not the directions'.
        const float radius =
            reach_m * (static_cast<float>((i * 7) % samples) + 0.5f) / static_cast<float>(samples);
        const glm::vec3 at =
            picture.toPicture(position + radius * (frame * directions[static_cast<size_t>(i * stride)]));
        const glm::ivec2 pixel(glm::floor(glm::vec2(at)));
        if (pixel.x < 0 || pixel.y < 0 || pixel.x >= picture.width || pixel.y >= picture.height) continue;
        const float before = at.z - picture.depth_m[static_cast<size_t>(pixel.y) * picture.width + pixel.x];
        hidden += before > 0.02f * reach_m && before < 2 * reach_m; // what is far in front casts nothing
    }
    return 1 - static_cast<float>(hidden) / static_cast<float>(samples);
}

} // namespace shoal::occlusion::baselines
