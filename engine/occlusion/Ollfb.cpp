#include "engine/occlusion/Ollfb.h"

#include "engine/occlusion/Scan.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <utility>

namespace shoal::occlusion {

namespace {

constexpr int kTurns = 8; // rotations within a quarter turn that frameView() tries
// Limit of one view's fragments before merging; they take some 600 MB.
constexpr size_t kMaxFragments = 1u << 24;

// A triangle's surface at one sample.
struct Fragment {
    float depth = 0;      // pixels
    glm::vec3 normal{0};  // unit, view frame
    uint8_t sample = 0;   // 4 y + x in the pixel
    bool towards = false; // whether it is front-facing
};

// A plane through a pixel: depth at its middle, and depth per pixel right and up.
struct Plane {
    float depth = 0;
    glm::vec2 slope{0};
    glm::vec3 normal{0}; // unit, view frame; its z has the sign of the side it faces and is never small
    uint16_t coverage = 0;
};

struct Frame {
    OllfbView view;
    std::vector<glm::vec3> corners; // the mesh's positions in pixels
};

// Rotates the view so that the body's bounding rectangle is smallest, and scales it to the resolution.
void frameView(const BodyMesh& mesh, const glm::vec3& axis, int resolution, Frame& frame) {
    OllfbView& view = frame.view;
    glm::vec3 low(0), high(0);
    float smallest = 0;
    for (int i = 0; i < kTurns; ++i) {
        const glm::mat3 turned =
            lookingAlong(axis, std::numbers::pi_v<float> / 2 * static_cast<float>(i) / kTurns);
        glm::vec3 from(INFINITY), to(-INFINITY);
        for (const glm::uvec3& t : mesh.triangles)
            for (int k = 0; k < 3; ++k) {
                const glm::vec3 p = turned * mesh.positions[t[k]];
                from = glm::min(from, p), to = glm::max(to, p);
            }
        const float area = (to.x - from.x) * (to.y - from.y);
        if (i == 0 || area < smallest) smallest = area, view.viewFromBody = turned, low = from, high = to;
    }
    // A hundredth of a pixel of margin all round.
    constexpr float kMargin_px = 0.01f;
    const glm::vec3 size = high - low;
    const float longest = std::max({size.x, size.y, 1e-6f * size.z});
    view.pixelsPerMetre = (static_cast<float>(resolution) - 2 * kMargin_px) / longest;
    view.low = low * view.pixelsPerMetre - glm::vec3(kMargin_px, kMargin_px, kDepthMargin_px);
    view.size = glm::clamp(glm::ivec2(glm::ceil(glm::vec2(size) * view.pixelsPerMetre + 2 * kMargin_px)),
                           glm::ivec2(1), glm::ivec2(resolution));
    view.depthRange_px = size.z * view.pixelsPerMetre + 2 * kDepthMargin_px;
    frame.corners.resize(mesh.positions.size());
    for (size_t i = 0; i < frame.corners.size(); ++i)
        frame.corners[i] = view.pixelFromBody(mesh.positions[i]);
}

// Returns whether most of the surface, by area, has triangles wound counter-clockwise around their normals.
bool runsWithNormals(const BodyMesh& mesh) {
    double sum = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3& a = mesh.positions[t.x];
        const glm::vec3 area = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
        sum += glm::dot(area, mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z]);
    }
    return sum >= 0;
}

// Renders one view with 4 x 4 samples a pixel. seen: the fragments of each pixel.
Status see(const BodyMesh& mesh, const Frame& frame, bool withNormals,
           std::vector<std::vector<Fragment>>& seen) {
    const glm::ivec2& size = frame.view.size;
    seen.resize(std::max(seen.size(), static_cast<size_t>(size.x * size.y)));
    for (std::vector<Fragment>& pixel : seen) pixel.clear();
    size_t total = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 &a = frame.corners[t.x], &b = frame.corners[t.y], &c = frame.corners[t.z];
        const glm::vec3 flat = glm::cross(b - a, c - a) * (withNormals ? 1.0f : -1.0f);
        const glm::mat3 normals =
            frame.view.viewFromBody * glm::mat3(mesh.normals[t.x], mesh.normals[t.y], mesh.normals[t.z]);
        scanTriangle({a * 4.0f, b * 4.0f, c * 4.0f}, size.x * 4, size.y * 4,
                     [&](int x, int y, const glm::vec3& weights) {
                         if (++total > kMaxFragments) return;
                         const glm::vec3 sum = normals * weights;
                         const float length = glm::length(sum);
                         seen[y / 4 * size.x + x / 4].push_back(
                             {glm::dot(weights, glm::vec3(a.z, b.z, c.z)),
                              length > 0 ? sum / length : glm::normalize(flat),
                              static_cast<uint8_t>(y % 4 * 4 + x % 4), flat.z < 0});
                     });
    }
    if (total > kMaxFragments) return Error{"", "a body has too many layers behind each other to be seen"};
    return Done{};
}

OllfbLayer pack(const Plane& plane, float depthRange_px) {
    const float share = std::clamp(plane.depth / depthRange_px, 0.0f, 1.0f);
    return {static_cast<uint16_t>(std::lround(share * 65535)),
            static_cast<uint16_t>(packDirection(plane.normal, 8)), plane.coverage};
}

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
void fit(const std::array<Fragment*, 16>& chosen, bool towards, Plane& plane) {
    // Regularised least squares: kPull draws towards the normals' slope where samples are few or in a line.
    constexpr float kPull = 0.02f;
    constexpr float kFits = 0.3f; // pixels of depth per pixel
    glm::vec2 asideSum(0);
    float depthSum = 0, count = 0;
    for (int s = 0; s < 16; ++s)
        if (chosen[s]) asideSum += sampleOffset(s), depthSum += chosen[s]->depth, ++count;
    const glm::vec2 middle = asideSum / count;
    const float depth = depthSum / count;
    float xx = kPull, xy = 0, yy = kPull;
    glm::vec2 rises(0);
    for (int s = 0; s < 16; ++s) {
        if (!chosen[s]) continue;
        const glm::vec2 aside = sampleOffset(s) - middle;
        const float rise = chosen[s]->depth - depth - glm::dot(plane.slope, aside);
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
    std::array<Fragment*, 16> chosen{}; // by sample
    std::array<float, 16> apart;
    for (Fragment& f : rest) {
        if (f.depth > beyond) break;
        if (f.sample == kTaken || f.towards != seed.towards) continue;
        const glm::vec2 aside = sampleOffset(f.sample) - sampleOffset(seed.sample);
        const float off = std::abs(f.depth - seed.depth - glm::dot(seedSlope, aside));
        // On a steep surface the slope may be twice the seed's.
        if (off > kBend_px + steep * glm::length(aside)) continue;
        if (chosen[f.sample] && off >= apart[f.sample]) continue;
        chosen[f.sample] = &f, apart[f.sample] = off;
    }
    Plane plane;
    for (size_t s = 0; s < 16; ++s) {
        if (!chosen[s]) continue;
        plane.coverage = static_cast<uint16_t>(plane.coverage | 1u << s);
        plane.normal += chosen[s]->normal;
    }
    const float length = glm::length(plane.normal);
    plane.normal = layBack(length > 0 ? plane.normal / length : seed.normal, seed.towards);
    plane.slope = slopeOf(plane.normal);
    fit(chosen, seed.towards, plane);
    for (Fragment* taken : chosen)
        if (taken) taken->sample = kTaken;
    return plane;
}

// Merges the fragments of one pixel into planes, by ascending depth. Every fragment belongs to one plane,
// every plane covers a sample at most once. Marks all fragments as taken.
void mergeLayers(std::vector<Fragment>& fragments, std::vector<Plane>& planes) {
    planes.clear();
    std::ranges::sort(fragments, {}, [](const Fragment& f) { return std::pair(f.depth, !f.towards); });
    for (size_t i = 0; i < fragments.size(); ++i)
        if (fragments[i].sample != kTaken) planes.push_back(takePlane(std::span(fragments).subspan(i)));
    std::ranges::stable_sort(planes, {}, &Plane::depth);
}

} // namespace

Result<Ollfb> Ollfb::make(const BodyMesh& mesh, const Options& options) {
    assert(options.views >= 1 && options.views <= 4096 && options.resolution >= 1 &&
           options.resolution <= 256);
    Ollfb result;
    result.sphere = boundingSphere(mesh);
    if (!(result.sphere.radius > 0)) return result;
    result.closed = isClosed(mesh);
    result.axes = Axes(options.views);
    const bool withNormals = runsWithNormals(mesh);

    Frame frame;
    std::vector<std::vector<Fragment>> seen;
    std::vector<Plane> planes;
    for (const glm::vec3& axis : result.axes.axes) {
        frameView(mesh, axis, options.resolution, frame);
        if (Status status = see(mesh, frame, withNormals, seen); !status) return status.error();
        frame.view.firstRow = static_cast<uint32_t>(result.rows.size());
        result.views.push_back(frame.view);
        for (int y = 0; y < frame.view.size.y; ++y) {
            std::vector<Fragment>* const pixels = seen.data() + y * frame.view.size.x;
            OllfbRow row{static_cast<uint32_t>(result.layers.size()),
                         static_cast<uint32_t>(result.starts.size()), 0,
                         static_cast<uint16_t>(frame.view.size.x)};
            while (row.begin < row.end && pixels[row.begin].empty()) ++row.begin;
            while (row.begin < row.end && pixels[row.end - 1].empty()) --row.end;
            result.rows.push_back(row);
            result.starts.push_back(0);
            for (int x = row.begin; x < row.end; ++x) {
                mergeLayers(pixels[x], planes);
                for (const Plane& plane : planes)
                    result.layers.push_back(pack(plane, frame.view.depthRange_px));
                const size_t end = result.layers.size() - row.firstLayer;
                if (end > UINT16_MAX)
                    return Error{"", "a body has more than 65535 layers in a row of pixels"};
                result.starts.push_back(static_cast<uint16_t>(end));
            }
        }
        if (result.bytes() > options.maxBytes)
            return Error{"", "a body's layers would take more than " + std::to_string(options.maxBytes) +
                                 " bytes; see it from fewer sides or with fewer pixels"};
    }
    result.rows.shrink_to_fit(), result.starts.shrink_to_fit(), result.layers.shrink_to_fit();
    return result;
}

} // namespace shoal::occlusion
