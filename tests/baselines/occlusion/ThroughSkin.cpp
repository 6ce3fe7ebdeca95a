#include "tests/baselines/occlusion/ThroughSkin.h"

#include "tests/baselines/occlusion/PixelWalk.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace shoal::occlusion {

namespace {

size_t index(const glm::ivec3& size, const glm::ivec3& at) {
    return static_cast<size_t>((at.z * size.y + at.y) * size.x + at.x);
}

// Calls visit(corner, weight) for the eight corners around a place in cells; weights sum to 1.
template <class Visit> void corners(const glm::ivec3& size, const glm::vec3& place, Visit&& visit) {
    const glm::vec3 inside = glm::clamp(place, glm::vec3(0), glm::vec3(size - 1));
    const glm::ivec3 low = glm::min(glm::ivec3(inside), size - 2);
    const glm::vec3 share = inside - glm::vec3(low);
    for (int k = 0; k < 8; ++k) {
        const glm::ivec3 step(k & 1, k >> 1 & 1, k >> 2);
        const glm::vec3 weight = glm::mix(1.0f - share, share, glm::vec3(step));
        visit(index(size, low + step), weight.x * weight.y * weight.z);
    }
}

} // namespace

void ThroughSkin::bend(std::span<const glm::vec3> posedPositions) {
    assert(posedPositions.size() == restPositions_.size());
    if (posedPositions.empty()) return;
    glm::vec3 low = posedPositions[0], high = low;
    for (const glm::vec3& p : posedPositions) low = glm::min(low, p), high = glm::max(high, p);
    const glm::vec3 extent = high - low;
    const float longest = std::max({extent.x, extent.y, extent.z});
    sphere_ = {(low + high) / 2.0f, 0};
    for (const glm::vec3& p : posedPositions)
        sphere_.radius = std::max(sphere_.radius, glm::distance(p, sphere_.centre));
    perMetre_ = longest > 0 ? kCells / longest : 1.0f;
    low_ = low;
    size_ = glm::ivec3(glm::ceil(extent * perMetre_)) + 2;

    grid_.assign(static_cast<size_t>(size_.x * size_.y * size_.z), glm::vec4(0));
    for (size_t i = 0; i < posedPositions.size(); ++i) {
        const glm::vec4 known(restPositions_[i] - posedPositions[i], 1);
        corners(size_, (posedPositions[i] - low_) * perMetre_,
                [&](size_t at, float weight) { grid_[at] += weight * known; });
    }
    for (glm::vec4& cell : grid_)
        if (cell.w > 0) cell /= cell.w;
    // What no position is near takes its neighbours' mean, ring by ring outwards.
    for (bool grown = true; grown;) {
        grown = false;
        spread_ = grid_;
        glm::ivec3 at;
        for (at.z = 0; at.z < size_.z; ++at.z)
            for (at.y = 0; at.y < size_.y; ++at.y)
                for (at.x = 0; at.x < size_.x; ++at.x) {
                    if (grid_[index(size_, at)].w > 0) continue;
                    glm::vec4 sum(0);
                    for (int k = 0; k < 6; ++k) {
                        glm::ivec3 beside = at;
                        beside[k / 2] += k % 2 ? 1 : -1;
                        if (beside[k / 2] >= 0 && beside[k / 2] < size_[k / 2])
                            sum += grid_[index(size_, beside)];
                    }
                    if (sum.w > 0) spread_[index(size_, at)] = sum / sum.w, grown = true;
                }
        std::swap(grid_, spread_);
    }
}

glm::vec3 ThroughSkin::restFromPosed(const glm::vec3& place) const {
    glm::vec3 displacement(0);
    corners(size_, (place - low_) * perMetre_,
            [&](size_t at, float weight) { displacement += weight * glm::vec3(grid_[at]); });
    return place + displacement;
}

std::optional<Hit> ThroughSkin::trace(const glm::vec3& origin, const glm::vec3& direction,
                                      float nearest) const {
    if (grid_.empty()) return {};
    float begin = nearest, end = glm::distance(origin, sphere_.centre) + sphere_.radius;
    const glm::vec3 high = low_ + glm::vec3(size_ - 1) / perMetre_;
    for (int k = 0; k < 3; ++k)
        if (!clipSlab(origin[k], direction[k], low_[k], high[k], begin, end)) return {};
    const float step = (end - begin) / kPieces;
    if (!(step > 0)) return {};
    glm::vec3 from = restFromPosed(origin + begin * direction);
    for (int i = 0; i < kPieces; ++i) {
        const float t = begin + step * static_cast<float>(i);
        const glm::vec3 to = restFromPosed(origin + (t + step) * direction);
        const float length = glm::distance(from, to);
        if (length > 0) {
            const auto hit = rest_->trace(from, (to - from) / length, 0, length);
            if (hit) {
                const float distance = t + step * glm::min(1.0f, hit->distance / length);
                // Normals go back with the transposed derivative of the map.
                const glm::vec3 place = origin + distance * direction;
                const float aside = 0.5f / perMetre_;
                glm::vec3 normal;
                for (int k = 0; k < 3; ++k) {
                    glm::vec3 offset(0);
                    offset[k] = aside;
                    normal[k] =
                        glm::dot(hit->normal, restFromPosed(place + offset) - restFromPosed(place - offset));
                }
                normal = glm::normalize(normal);
                return Hit{distance, glm::dot(normal, direction) > 0 ? -normal : normal};
            }
        }
        from = to;
    }
    return {};
}

} // namespace shoal::occlusion
