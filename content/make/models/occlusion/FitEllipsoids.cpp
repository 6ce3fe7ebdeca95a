#include "content/make/models/occlusion/FitEllipsoids.h"

#include "content/make/models/occlusion/Bvh.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace shoal::occlusion {

namespace {

constexpr int kLines = 80;         // lines of samples across the body's longest side
constexpr int kSweeps = 12;        // rounds of assigning samples to parts
constexpr float kThinnest = 0.25f; // least depth of a sample, in steps: thin sheets block light, too
constexpr float kFlattest = 0.02f; // least ratio of a semi-axis to the longest
constexpr float kMinShare = 0.004f;

constexpr size_t kMaxCrossings = 64;

struct Crossing {
    float distance = 0;
    uint16_t joint = 0;
    int around = 0; // number of surfaces that enclose the line from here on
};

struct Sample {
    glm::vec3 at{0};
    float mass = 0;
    uint16_t joint = 0;
};

// Returns where a line through the body meets its surface, at most kMaxCrossings times.
std::vector<Crossing> crossingsAlong(const RestBody& body, const Bvh& bvh, const glm::vec3& origin,
                                     int axis) {
    glm::vec3 direction(0);
    direction[axis] = 1;
    std::vector<Crossing> crossings;
    int around = 0; // number of enclosing surfaces: a body and its fins overlap
    for (float at = 0; crossings.size() < kMaxCrossings;) {
        const auto touch = bvh.first(origin, direction, at, INFINITY);
        if (!touch) break;
        at = touch->distance;
        const uint32_t* corner = &body.indices[3 * touch->triangle];
        const glm::vec3 normal = glm::cross(body.positions[corner[1]] - body.positions[corner[0]],
                                            body.positions[corner[2]] - body.positions[corner[0]]);
        around += normal[axis] < 0 ? 1 : -1;
        const float first = 1 - touch->u - touch->v;
        const int nearest = first >= touch->u && first >= touch->v ? 0 : touch->u >= touch->v ? 1 : 2;
        crossings.push_back({at, body.jointsOf[corner[nearest]], around});
    }
    return crossings;
}

// Samples the body's volume, and its sheets that have no volume, along lines parallel to the coordinate axis
// that most of its surface faces.
std::vector<Sample> fill(const RestBody& body) {
    glm::vec3 low(INFINITY), high(-INFINITY), facing(0);
    for (size_t i = 0; i + 2 < body.indices.size(); i += 3) {
        const glm::vec3& a = body.positions[body.indices[i]];
        const glm::vec3& b = body.positions[body.indices[i + 1]];
        const glm::vec3& c = body.positions[body.indices[i + 2]];
        low = glm::min(low, glm::min(a, glm::min(b, c))), high = glm::max(high, glm::max(a, glm::max(b, c)));
        facing += glm::abs(glm::cross(b - a, c - a));
    }
    std::vector<Sample> samples;
    const glm::vec3 extent = high - low;
    const float longest = std::max({extent.x, extent.y, extent.z});
    if (!(longest > 0) || !std::isfinite(longest)) return samples;
    const int axis = facing.x >= facing.y && facing.x >= facing.z ? 0 : facing.y >= facing.z ? 1 : 2;
    const int right = (axis + 1) % 3, up = (axis + 2) % 3;
    const float step = longest / kLines;
    const Bvh bvh(body.positions, body.indices);
    glm::vec3 origin;
    origin[axis] = low[axis] - step;
    const auto put = [&](const Crossing& from, const Crossing& to) {
        const float length = to.distance - from.distance;
        const int count = std::max(1, static_cast<int>(std::lround(length / step)));
        for (int k = 0; k < count; ++k) {
            const float share = (static_cast<float>(k) + 0.5f) / static_cast<float>(count);
            Sample sample{origin, std::max(length / static_cast<float>(count), kThinnest * step),
                          share < 0.5f ? from.joint : to.joint};
            sample.at[axis] += from.distance + share * length;
            samples.push_back(sample);
        }
    };
    for (int v = 0; (static_cast<float>(v) + 0.5f) * step < extent[up]; ++v)
        for (int u = 0; (static_cast<float>(u) + 0.5f) * step < extent[right]; ++u) {
            origin[right] = low[right] + (static_cast<float>(u) + 0.5f) * step;
            origin[up] = low[up] + (static_cast<float>(v) + 0.5f) * step;
            const std::vector<Crossing> crossings = crossingsAlong(body, bvh, origin, axis);
            const bool open = !crossings.empty() && crossings.back().around != 0; // not closed, so sheets
            size_t entered = 0;
            for (size_t k = 0; k < crossings.size(); ++k) {
                if (open)
                    put(crossings[k], crossings[k]);
                else if (crossings[k].around == 0)
                    put(crossings[entered], crossings[k]), entered = k + 1;
            }
        }
    return samples;
}

struct Moments {
    double mass = 0;
    glm::dvec3 mean{0};
    glm::dmat3 spread{0}; // covariance
};

Moments momentsOf(std::span<const Sample> samples, std::span<const size_t> partOf, size_t part) {
    Moments m;
    glm::dmat3 squares(0);
    for (size_t i = 0; i < samples.size(); ++i) {
        if (partOf[i] != part) continue;
        const glm::dvec3 at(samples[i].at);
        m.mass += samples[i].mass;
        m.mean += static_cast<double>(samples[i].mass) * at;
        squares += glm::outerProduct(static_cast<double>(samples[i].mass) * at, at);
    }
    if (m.mass <= 0) return m;
    m.mean /= m.mass;
    m.spread = squares / m.mass - glm::outerProduct(m.mean, m.mean);
    return m;
}

// Diagonalises by Jacobi's rotations: columns of `axes` become eigenvectors; returns their eigenvalues.
glm::dvec3 eigen(glm::dmat3 a, glm::dmat3& axes) {
    axes = glm::dmat3(1);
    for (int sweep = 0; sweep < 12; ++sweep)
        for (const auto& [p, q] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
            if (std::abs(a[p][q]) < 1e-30) continue;
            const double angle = 0.5 * std::atan2(2 * a[p][q], a[q][q] - a[p][p]);
            glm::dmat3 turn(1);
            turn[p][p] = turn[q][q] = std::cos(angle);
            turn[p][q] = -std::sin(angle), turn[q][p] = std::sin(angle);
            a = glm::transpose(turn) * a * turn;
            axes = axes * turn;
        }
    return {a[0][0], a[1][1], a[2][2]};
}

// Returns the solid ellipsoid with these moments. Its variance along a semi-axis of length s is s^2 / 5.
Ellipsoid solidOf(const Moments& m) {
    glm::dmat3 axes;
    const glm::dvec3 variance = eigen(m.spread, axes);
    if (glm::determinant(axes) < 0) axes[0] = -axes[0];
    glm::dvec3 semi = glm::sqrt(5.0 * glm::max(variance, 0.0));
    semi = glm::max(semi, std::max({semi.x, semi.y, semi.z}) * static_cast<double>(kFlattest));
    return {glm::vec3(m.mean), glm::mat3(axes), glm::vec3(semi)};
}

// Assigns each sample to the part of least Mahalanobis distance^2 plus log-determinant of its covariance.
void assign(std::span<const Sample> samples, size_t count, float minimum, std::vector<size_t>& partOf) {
    struct Part {
        glm::dvec3 mean;
        glm::dmat3 inverse;
        double level;
    };
    std::vector<Part> parts;
    for (size_t k = 0; k < count; ++k) {
        const Moments m = momentsOf(samples, partOf, k);
        if (m.mass <= 0) {
            parts.push_back({{}, glm::dmat3(0), INFINITY});
            continue;
        }
        const glm::dmat3 spread = m.spread + glm::dmat3(static_cast<double>(minimum * minimum) * 0.1);
        parts.push_back({m.mean, glm::inverse(spread), std::log(glm::determinant(spread))});
    }
    for (size_t i = 0; i < samples.size(); ++i) {
        double best = INFINITY;
        for (size_t k = 0; k < count; ++k) {
            const glm::dvec3 off = glm::dvec3(samples[i].at) - parts[k].mean;
            const double far = 5 * glm::dot(off, parts[k].inverse * off) / 3 + parts[k].level;
            if (far < best) best = far, partOf[i] = k;
        }
    }
}

// Assigns each sample to the part of the nearest seed; seeds come from farthest-point sampling.
std::vector<size_t> byShape(std::span<const Sample> samples, size_t maximum) {
    std::vector<size_t> partOf(samples.size(), 0);
    std::vector<float> far(samples.size(), INFINITY);
    glm::vec3 seed = samples[0].at;
    const auto furthest = [&] {
        return static_cast<size_t>(std::max_element(far.begin(), far.end()) - far.begin());
    };
    for (size_t i = 0; i < samples.size(); ++i) far[i] = glm::distance(samples[i].at, seed);
    seed = samples[furthest()].at;
    std::fill(far.begin(), far.end(), INFINITY);
    for (size_t k = 0; k < maximum; ++k) {
        for (size_t i = 0; i < samples.size(); ++i)
            if (const float d = glm::distance(samples[i].at, seed); d < far[i]) far[i] = d, partOf[i] = k;
        seed = samples[furthest()].at;
    }
    return partOf;
}

std::vector<size_t> byJoint(std::span<const Sample> samples, size_t maximum) {
    std::map<uint16_t, float> masses;
    float all = 0;
    for (const Sample& s : samples) masses[s.joint] += s.mass, all += s.mass;
    std::vector<std::pair<float, uint16_t>> sorted;
    for (const auto& [joint, mass] : masses)
        if (mass > kMinShare * all) sorted.emplace_back(-mass, joint);
    std::sort(sorted.begin(), sorted.end());
    sorted.resize(std::min(sorted.size(), maximum));
    std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    std::vector<size_t> partOf(samples.size(), sorted.size());
    for (size_t i = 0; i < samples.size(); ++i)
        for (size_t k = 0; k < sorted.size(); ++k)
            if (sorted[k].second == samples[i].joint) partOf[i] = k;
    return partOf; // samples of joints with too little volume belong to no part
}

uint16_t maxOften(std::span<const Sample> samples, std::span<const size_t> partOf, size_t part) {
    std::map<uint16_t, float> masses;
    for (size_t i = 0; i < samples.size(); ++i)
        if (partOf[i] == part) masses[samples[i].joint] += samples[i].mass;
    return std::max_element(masses.begin(), masses.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
}

} // namespace

std::vector<BodyPart> fitEllipsoids(const RestBody& body, Parts parts, size_t maximum) {
    std::vector<BodyPart> result;
    const std::vector<Sample> samples = fill(body);
    if (samples.empty() || maximum == 0) return result;
    std::vector<size_t> partOf =
        parts == Parts::ByJoint ? byJoint(samples, maximum) : byShape(samples, maximum);
    if (parts == Parts::ByShape)
        for (int sweep = 0; sweep < kSweeps; ++sweep) assign(samples, maximum, samples[0].mass, partOf);
    double all = 0;
    for (const Sample& s : samples) all += s.mass;
    for (size_t k = 0; k < maximum; ++k) {
        const Moments m = momentsOf(samples, partOf, k);
        if (m.mass <= 1e-4 * all) continue;
        result.push_back({solidOf(m), maxOften(samples, partOf, k)});
    }
    return result;
}

} // namespace shoal::occlusion
