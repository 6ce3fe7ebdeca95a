// Where the objects of a frame are, by spheres: which of them a view sees, and which the film hides.
#pragma once

#include "engine/render/EyePicture.h"

#include <cmath>
#include <span>
#include <vector>

namespace shoal::render {

// Whether the film has something that is nearer than an object.
enum class BehindFilm { Nothing, Perhaps, All };

// Nothing allocates once the vectors have grown.
class ObjectBounds {
  public:
    void clear();
    // Spheres in the world: whole holds the object; parts are smaller ones that hold it all together, none if
    // they are not known. Its number, from 0 on.
    size_t add(const Sphere& whole, std::span<const Sphere> parts);

    const Sphere& whole(size_t object) const { return objects_[object].whole; }

    struct Seen {
        bool any = false;
        float nearest_m = INFINITY; // from the eye to the nearest of the parts in the view
        // Its radius per distance; where its sphere holds the eye, the largest of these parts'.
        float slope = 0;
        BehindFilm behind = BehindFilm::Nothing; // in the player's room nothing of the film hides
    };
    void seenIn(const EyePicture& picture, std::vector<Seen>& out) const; // of each object
    // Adds spheres that hold all that is in the view.
    void addVisible(const View& view, std::vector<Sphere>& out) const;

  private:
    struct Object {
        Sphere whole;
        size_t firstPart, partCount; // of parts_; one at least
    };
    std::span<const Sphere> partsOf(const Object& object) const;
    Seen seenIn(const View& view, const Object& object) const;
    BehindFilm behindFilm(const Object& object, const EyePicture& picture) const;

    std::vector<Object> objects_;
    std::vector<Sphere> parts_;
};

} // namespace shoal::render
