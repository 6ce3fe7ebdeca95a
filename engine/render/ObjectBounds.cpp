#include "engine/render/ObjectBounds.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace shoal::render {

void ObjectBounds::clear() {
    objects_.clear();
    parts_.clear();
}

size_t ObjectBounds::add(const Sphere& whole, std::span<const Sphere> parts) {
    objects_.push_back({whole, parts_.size(), std::max<size_t>(parts.size(), 1)});
    if (parts.empty()) parts_.push_back(whole);
    parts_.insert(parts_.end(), parts.begin(), parts.end());
    return objects_.size() - 1;
}

std::span<const Sphere> ObjectBounds::partsOf(const Object& object) const {
    return std::span(parts_).subspan(object.firstPart, object.partCount);
}

// Tests the parts: the sphere around an arm holds the eye, and reaches into views that the arm does not.
ObjectBounds::Seen ObjectBounds::seenIn(const View& view, const Object& object) const {
    Seen seen;
    if (!sees(view, object.whole)) return seen;
    const float middle = glm::distance(object.whole.centre, view.eyeWorld);
    const bool holdsEye = middle < object.whole.radius;
    if (!holdsEye) seen.slope = object.whole.radius / std::max(middle, view.near_m);
    for (const Sphere& part : partsOf(object)) {
        if (!sees(view, part)) continue;
        const float distance = glm::distance(part.centre, view.eyeWorld);
        seen.any = true;
        seen.nearest_m = std::min(seen.nearest_m, distance - part.radius);
        if (holdsEye) seen.slope = std::max(seen.slope, part.radius / std::max(distance, view.near_m));
    }
    return seen;
}

// Compares an object's distances with the film's range within the caps that its parts cover, widened by the
// angle that an eye beside the film's camera may see past their edges.
BehindFilm ObjectBounds::behindFilm(const Object& object, const EyePicture& picture) const {
    const depth::DepthRange* range = picture.environment.depthRange();
    if (!range) return BehindFilm::Nothing;
    const float beside = glm::length(picture.eyeInFilm);
    const auto behind = [&](const Sphere& part) {
        const glm::vec3 away = part.centre - picture.view.eyeWorld;
        const float distance = glm::length(away), radius = part.radius;
        // Distances from the film's camera and from the eye differ by at most the distance between these.
        if (distance + radius + beside <= depth::kNearest_m) return BehindFilm::Nothing;
        if (distance <= radius) return BehindFilm::Perhaps;
        const float halfAngle = std::asin(radius / distance) + beside / depth::kNearest_m;
        const auto film = range->around(picture.envFromWorld * (away / distance), halfAngle);
        if (film.max_perM * (distance + radius + beside) <= 1) return BehindFilm::Nothing;
        return film.min_perM * (distance - radius - beside) > 1 ? BehindFilm::All : BehindFilm::Perhaps;
    };
    if (const BehindFilm whole = behind(object.whole); whole != BehindFilm::Perhaps) return whole;
    const std::span<const Sphere> parts = partsOf(object);
    const BehindFilm first = behind(parts[0]);
    return std::ranges::all_of(parts, [&](const Sphere& part) { return behind(part) == first; })
               ? first
               : BehindFilm::Perhaps;
}

void ObjectBounds::seenIn(const EyePicture& picture, std::vector<Seen>& out) const {
    out.clear();
    for (const Object& object : objects_) {
        Seen& seen = out.emplace_back(seenIn(picture.view, object));
        if (seen.any && picture.surroundings != Surroundings::Room) seen.behind = behindFilm(object, picture);
    }
}

void ObjectBounds::addVisible(const View& view, std::vector<Sphere>& out) const {
    for (const Object& object : objects_)
        if (sees(view, object.whole))
            for (const Sphere& part : partsOf(object))
                if (sees(view, part)) out.push_back(part);
}

} // namespace shoal::render
