#include "content/make/video/Route.h"

#include <algorithm>
#include <cmath>

namespace shoal::reef {

// A uniform cubic B-spline, whose continuous curvature avoids jerks. It passes near its places rather than
// through them.
Route::Route(const std::vector<vec3>& places) {
    const auto n = places.size();
    std::vector<vec3> fine;
    constexpr size_t kSteps = 400;
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < kSteps; ++k) {
            const float t = static_cast<float>(k) / kSteps, t2 = t * t, t3 = t2 * t;
            fine.push_back((places[i] * (1 - 3 * t + 3 * t2 - t3) +
                            places[(i + 1) % n] * (4 - 6 * t2 + 3 * t3) +
                            places[(i + 2) % n] * (1 + 3 * t + 3 * t2 - 3 * t3) + places[(i + 3) % n] * t3) /
                           6.0f);
        }
    std::vector<float> far{0};
    for (size_t i = 0; i < fine.size(); ++i)
        far.push_back(far.back() + glm::distance(fine[i], fine[(i + 1) % fine.size()]));
    length_ = far.back();
    constexpr size_t kPoints = 720;
    size_t at = 0;
    for (size_t i = 0; i < kPoints; ++i) {
        const float wanted = length_ * static_cast<float>(i) / kPoints;
        while (far[at + 1] < wanted) ++at;
        const float share = (wanted - far[at]) / (far[at + 1] - far[at]);
        points_.push_back(glm::mix(fine[at], fine[(at + 1) % fine.size()], share));
    }
}

vec3 Route::at(float turn) const {
    const float p = (turn - std::floor(turn)) * static_cast<float>(points_.size());
    const size_t i = static_cast<size_t>(p), n = points_.size();
    const float t = p - static_cast<float>(i), t2 = t * t, t3 = t2 * t;
    const vec3 &a = points_[(i + n - 1) % n], &b = points_[i % n], &c = points_[(i + 1) % n],
               &d = points_[(i + 2) % n];
    return b + 0.5f * (t * (c - a) + t2 * (2.0f * a - 5.0f * b + 4.0f * c - d) +
                       t3 * (3.0f * b - a - 3.0f * c + d));
}

float Route::distanceTo(const vec3& p) const {
    float minimum = 1e9f;
    for (const vec3& q : points_) minimum = std::min(minimum, glm::dot(p - q, p - q));
    return std::sqrt(minimum);
}

} // namespace shoal::reef
