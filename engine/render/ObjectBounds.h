// Bounds the objects of a frame by spheres, to find which of them a view sees and which the film hides.
#pragma once

#include "engine/render/EyePicture.h"

#include <cmath>
#include <span>
#include <vector>

namespace shoal::render {

// The share of an object behind nearer parts of the film.
enum class BehindFilm { Nothing, Perhaps, All };

// Allocates nothing once the vectors have grown.
class ObjectBounds {
  public:
    void clear();
    // Adds an object and returns its index, from 0. World frame: `whole` holds the object; parts are smaller
    // spheres that together hold it, none if they are not known.
    size_t add(const Sphere& whole, std::span<const Sphere> parts);

    const Sphere& whole(size_t object) const { return objects_[object].whole; }

    struct Seen {
        bool any = false;
        float nearest_m = INFINITY; // distance from the eye to the nearest part in the view
        // Radius divided by distance; if its sphere holds the eye, the largest such ratio of visible parts.
        float slope = 0;
        BehindFilm behind = BehindFilm::Nothing; // Nothing in the player's room, where the film is not seen
    };
    void seenIn(const EyePicture& picture, std::vector<Seen>& out) const; // one for each object
    // Adds spheres that together hold all that is in the view.
    void addVisible(const View& view, std::vector<Sphere>& out) const;

  private:
    struct Object {
        Sphere whole;
        size_t firstPart, partCount; // range of parts_; at least one
    };
    std::span<const Sphere> partsOf(const Object& object) const;
    Seen seenIn(const View& view, const Object& object) const;
    BehindFilm behindFilm(const Object& object, const EyePicture& picture) const;

    std::vector<Object> objects_;
    std::vector<Sphere> parts_;
};

} // namespace shoal::render
