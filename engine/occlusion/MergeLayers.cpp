#include "engine/occlusion/MergeLayers.h"

#include "engine/occlusion/Ollfb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace shoal::occlusion {

namespace {

// Returns the offset of a sample's middle from the pixel's middle, pixels.
glm::vec2 sampleOffset(int sample) {
    return {static_cast<float>(sample % 4) * 0.25f - 0.375f, static_cast<float>(sample / 4) * 0.25f - 0.375f};
}

// Returns the unit normal, tilted to the slope kSteepest if it is steeper; towards: z gets a negative sign.
glm::vec3 layBack(const glm::vec3& normal, bool towards) {
    const float flat = glm::length(glm::vec2(normal));
    const float depth = std::max(towards ? -normal.z : normal.z, flat / kSteepest);
    return glm::normalize(glm::vec3(glm::vec2(normal), towards ? -depth : depth));
}

// Sets the plane's depth from the chosen fragments; sets its slope and normal too if the normals' slope does
// not fit the depths. Near a silhouette depth grows as a square root, and the slope at most samples is far
// from the mean normal's.
void fit(std::span<const Fragment> fragments, const std::array<int, 16>& chosen, bool towards, Plane& plane) {
    // Regularised least squares: kPull draws towards the normals' slope where samples are few or in a line.
    constexpr float kPull = 0.02f;
    constexpr float kFits = 0.3f; // pixels of depth per pixel
    glm::vec2 asideSum(0);
    float depthSum = 0, count = 0;
    for (int s = 0; s < 16; ++s) {
        const int i = chosen[static_cast<size_t>(s)];
        if (i < 0) continue;
        asideSum += sampleOffset(s), depthSum += fragments[static_cast<size_t>(i)].depth, ++count;
    }
    const glm::vec2 middle = asideSum / count;
    const float depth = depthSum / count;
    float xx = kPull, xy = 0, yy = kPull;
    glm::vec2 rises(0);
    for (int s = 0; s < 16; ++s) {
        const int i = chosen[static_cast<size_t>(s)];
        if (i < 0) continue;
        const glm::vec2 aside = sampleOffset(s) - middle;
        const float rise = fragments[static_cast<size_t>(i)].depth - depth - glm::dot(plane.slope, aside);
        xx += aside.x * aside.x, xy += aside.x * aside.y, yy += aside.y * aside.y;
        rises += aside * rise;
    }
    const float determinant = xx * yy - xy * xy;
    const glm::vec2 more = glm::vec2(yy * rises.x - xy * rises.y, xx * rises.y - xy * rises.x) / determinant;
    if (glm::length(more) > kFits) {
        const glm::vec2 slope = plane.slope + more;
        plane.normal = layBack(glm::normalize(glm::vec3(slope, -1.0f)) * (towards ? 1.0f : -1.0f), towards);
        plane.slope = slopeOf(plane.normal);
    }
    plane.depth = depth - glm::dot(plane.slope, middle);
}

constexpr uint8_t kTaken = 16; // index of no sample; marks a taken fragment

// Makes a plane of the fragments that continue the first one's, at most one for each sample, and marks them
// with kTaken. rest: sorted by depth.
Plane takePlane(std::span<Fragment> rest) {
    const Fragment seed = rest.front();
    const glm::vec2 seedSlope = slopeOf(layBack(seed.normal, seed.towards));
    const float steep = glm::length(seedSlope);
    constexpr float kBend_px = 0.5f,
                    kFurthest_px = 1.07f; // kFurthest_px: greatest distance of two samples
    const float beyond = seed.depth + kBend_px + 2 * steep * kFurthest_px;
    std::array<int, 16> chosen;
    std::array<float, 16> apart;
    chosen.fill(-1);
    for (int i = 0; i < static_cast<int>(rest.size()) && rest[static_cast<size_t>(i)].depth <= beyond; ++i) {
        const Fragment& f = rest[static_cast<size_t>(i)];
        if (f.sample == kTaken || f.towards != seed.towards) continue;
        const glm::vec2 aside = sampleOffset(f.sample) - sampleOffset(seed.sample);
        const float off = std::abs(f.depth - seed.depth - glm::dot(seedSlope, aside));
        // On a steep surface the slope may be twice the seed's.
        if (off > kBend_px + steep * glm::length(aside)) continue;
        if (chosen[f.sample] >= 0 && off >= apart[f.sample]) continue;
        chosen[f.sample] = i, apart[f.sample] = off;
    }
    Plane plane;
    for (size_t s = 0; s < 16; ++s) {
        if (chosen[s] < 0) continue;
        plane.coverage = static_cast<uint16_t>(plane.coverage | 1u << s);
        plane.normal += rest[static_cast<size_t>(chosen[s])].normal;
    }
    const float length = glm::length(plane.normal);
    plane.normal = layBack(length > 0 ? plane.normal / length : seed.normal, seed.towards);
    plane.slope = slopeOf(plane.normal);
    fit(rest, chosen, seed.towards, plane);
    for (const int i : chosen)
        if (i >= 0) rest[static_cast<size_t>(i)].sample = kTaken;
    return plane;
}

} // namespace

void mergeLayers(std::vector<Fragment>& fragments, std::vector<Plane>& planes) {
    const auto first = static_cast<ptrdiff_t>(planes.size());
    std::sort(fragments.begin(), fragments.end(), [](const Fragment& a, const Fragment& b) {
        return a.depth != b.depth ? a.depth < b.depth : a.towards > b.towards;
    });
    for (size_t i = 0; i < fragments.size(); ++i)
        if (fragments[i].sample != kTaken) planes.push_back(takePlane(std::span(fragments).subspan(i)));
    std::stable_sort(planes.begin() + first, planes.end(),
                     [](const Plane& a, const Plane& b) { return a.depth < b.depth; });
}

} // namespace shoal::occlusion
