// Occlusion from the depth picture alone. Filion and McNaughton 2008, "StarCraft II: Effects and Techniques":
// points in the hemisphere over a pixel's surface are hidden where the picture is nearer.
#pragma once

#include "tests/baselines/occlusion/Visibility.h"

#include <vector>

namespace shoal::occlusion::baselines {

// Perspective, looking from eye along -Z of its own frame.
struct DepthPicture {
    glm::mat4 eyeFromWorld{1};
    float tanHalfFovY = 0.3f;
    int width = 0, height = 0;
    std::vector<float> depth_m; // along the view's axis; 1e30 where nothing is; rows from the top

    std::size_t bytes() const { return depth_m.size() * sizeof(float); }
    // x, y in pixels, z the depth.
    glm::vec3 toPicture(const glm::vec3& world) const;
    bool shows(const glm::vec3& world, float slack_m) const;
};
static_assert(KeepsMemory<DepthPicture>);

// Share of the hemisphere that is free, 0 to 1, from so many samples within `reach` metres.
float screenSpaceOcclusion(const DepthPicture& picture, const glm::vec3& position, const glm::vec3& normal,
                           float reach_m, int samples);

} // namespace shoal::occlusion::baselines
