// Distances to the surfaces that the film shows, by direction and time of the film: a small grid, made once
// before a dive, which the rules read. Plain data. World frame; metres from the film's camera, which is where
// the viewer's eyes rest; seconds of the film, which starts with the dive and repeats.
// Directions lie on an octahedron unfolded to a square (math/Octahedron.h): no trigonometry, so that a lookup
// is the same on every machine.
#pragma once

#include "engine/math/Octahedron.h"
#include "engine/physics/Capsule.h"
#include "engine/physics/World.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace shoal::game {

class FilmSpace {
  public:
    static constexpr int kSide = 48; // a cell is 4 degrees wide
    static constexpr int kCells = kSide * kSide;
    static constexpr float kFar_m = 8;        // farthest distance stored; bodies stay within it
    static constexpr float kNearest_m = 0.6f; // a place nearer to the eyes is never hidden
    static constexpr int kMaxSteps = 2400;    // enough for ten minutes

    // Kind of animal that a room is for. A shark's room may change faster than a small fish's.
    enum class Room { Fish, Shark };

    // surface_mm: for every time step, evenly over the film, kCells distances in millimetres, each the
    // nearest that the film shows within a cell. At most kMaxSteps steps.
    FilmSpace(double length_s, std::vector<uint16_t> surface_mm);

    static int cellOf(const glm::vec3& dir) { return math::octahedralCell(dir, kSide); }
    static glm::vec3 directionOf(int cell) { return math::octahedralDirection(cell, kSide); }

    // Returns the hash of length and distances: equal hashes, equal dives.
    uint64_t hash() const;
    int steps() const { return steps_; }
    double length_s() const { return length_s_; }

    // A time of the film, between two steps.
    struct Moment {
        size_t before = 0, after = 0; // indices of the steps
        float share = 0;              // weight of `after`
    };
    Moment at(double time_s) const;

    // Returns the distance from the camera to the surface that the film shows.
    float surface_m(const Moment& at, glm::vec3 dir) const { return lookUp(surface_mm_, at, dir); }
    // Returns the place of the surface in the middle of a cell. x, y: 0 to kSide - 1, or up to kSide beyond
    // an edge of the unfolded square, where the octahedron goes on.
    glm::vec3 corner(const Moment& at, int x, int y) const;
    // Returns the distance from the camera up to which bodies may be: at most the surface's, and changing so
    // slowly, with time and direction, that a body kept within it swims and does not jump.
    float room_m(const Moment& at, glm::vec3 dir, Room of = Room::Fish) const {
        return lookUp(room_mm_[static_cast<size_t>(of)], at, dir);
    }

  private:
    void makeRoom(Room of);
    float lookUp(const std::vector<uint16_t>& grid, const Moment&, glm::vec3 dir) const;

    double length_s_;
    int steps_;
    // The grids of all steps, each with a border of one cell that repeats the octahedron's adjacent cells.
    std::vector<uint16_t> surface_mm_;
    std::array<std::vector<uint16_t>, 2> room_mm_; // by Room
};

// The film's space at one time, for the rules. Everything is free in a film without distances.
class FilmMoment {
  public:
    FilmMoment() = default;
    FilmMoment(const FilmSpace* space, double time_s, FilmSpace::Room of = FilmSpace::Room::Fish)
        : space_(space), time_s_(time_s), of_(of) {
        if (space) moment_ = space->at(time_s);
    }

    // The same film for another kind of animal, some seconds later.
    FilmMoment as(FilmSpace::Room of, float ahead_s = 0) const {
        return {space_, time_s_ + static_cast<double>(ahead_s), of};
    }
    bool known() const { return space_ != nullptr; }
    // Returns the distance from the place outwards to the end of the room for bodies; negative beyond it.
    // Requires known(), as the next three do.
    float gap_m(glm::vec3 place) const;
    // Returns the direction in which that gap grows fastest, unit length.
    glm::vec3 inward(glm::vec3 place) const;
    // Returns the distance from the place outwards to the surface that the film shows; negative beyond it.
    float surfaceGap_m(glm::vec3 place) const;
    // Steers the wanted way off the film's surfaces: reduces its outward component, and adds up to 2 * push
    // inwards, more for a smaller gap. soon: predicted place of the body; gap_m: its gap there; shy_m: the
    // gap that it wants. Returns the missing share of shy_m, 0 to 2.
    float keepOff(glm::vec3& way, glm::vec3 soon, float gap_m, float shy_m, float push) const;
    // Returns how far the body reaches out of its room; 0: not at all. Stops at the first place of the body
    // that reaches out farther than enough_m.
    float overshoot_m(const physics::Capsule& body, float enough_m = 1e9f) const;
    // Returns the place moved towards the camera by as far as the body, whose middle it is, reaches out of
    // its room, but by no more than most_m.
    glm::vec3 pulledIn(glm::vec3 place, const physics::Capsule& body, float most_m) const;
    // Calls visit() for each triangle between the middles of cells that may reach into the box.
    void triangles(glm::vec3 low, glm::vec3 high, const physics::Ground::Visit& visit) const;
    // Returns whether a surface of the film lies between the head and the place.
    bool hides(glm::vec3 headWorld, glm::vec3 place) const;

  private:
    const FilmSpace* space_ = nullptr;
    double time_s_ = 0;
    FilmSpace::Room of_ = FilmSpace::Room::Fish;
    FilmSpace::Moment moment_;
};

} // namespace shoal::game
