// How far away what the film shows is, in every direction and over its time: a small grid, made once before a
// dive, that the rules read. Plain data. World frame, metres from the film's camera, which is where the
// viewer's eyes are at rest; seconds of the film, which starts with the dive and repeats.
//
// Directions lie on an octahedron unfolded to a square (math/Octahedron.h): no trigonometry, so that a lookup
// is the same on every machine.
#pragma once

#include "engine/physics/Capsule.h"

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
    static constexpr float kFar_m = 8;        // as far as bodies go; what is beyond counts as this far
    static constexpr float kNearest_m = 0.6f; // nothing hides what is nearer to the eyes
    static constexpr int kMaxSteps = 2400;    // ten minutes

    // Rooms differ in how fast they shrink: a shark follows a wall faster than a small fish does.
    enum class Room { Fish, Shark };

    // surface_mm: for every step of time, evenly over the film, kCells distances in millimetres of the
    // nearest that the film shows within a cell. A multiple of kCells, at most kMaxSteps times.
    FilmSpace(double length_s, std::vector<uint16_t> surface_mm);

    // dir: not zero.
    static int cellOf(glm::vec3 dir);
    static glm::vec3 directionOf(int cell); // of its middle, unit length

    // Of all that it was made from: equal hashes, equal dives.
    uint64_t hash() const;
    size_t bytes() const { return 3 * surface_mm_.size() * sizeof(uint16_t); }
    int steps() const { return steps_; }
    double length_s() const { return length_s_; }

    // A time of the film: linear between two steps.
    struct Moment {
        size_t before = 0, after = 0; // steps
        float share = 0;              // 0: all `before`
    };
    Moment at(double time_s) const;

    // From the camera to what the film shows.
    float surface_m(const Moment&, glm::vec3 dir) const;
    // From the camera to where bodies may be: not behind the surface, and changing so slowly, with time and
    // from direction to direction, that who keeps to it swims and does not jump.
    float room_m(const Moment&, glm::vec3 dir, Room of = Room::Fish) const;

  private:
    void makeRoom(Room of);
    float lookUp(const std::vector<uint16_t>& grid, const Moment&, glm::vec3 dir) const;

    double length_s_;
    int steps_;
    // Each step with a border of one cell around it, as the octahedron continues there.
    std::vector<uint16_t> surface_mm_;
    std::array<std::vector<uint16_t>, 2> room_mm_; // by Room
};

// The film's space at one time, for the rules. Of a film without distances everything is free.
class FilmMoment {
  public:
    FilmMoment() = default;
    FilmMoment(const FilmSpace* space, double time_s, FilmSpace::Room of = FilmSpace::Room::Fish)
        : space_(space), of_(of) {
        if (space) moment_ = space->at(time_s);
    }

    bool known() const { return space_ != nullptr; }
    // Only where known(): from the place to the end of the room for bodies, outwards; negative beyond it.
    float gap_m(glm::vec3 place) const;
    // Only where known(): the direction in which that gap grows fastest, unit length.
    glm::vec3 inward(glm::vec3 place) const;
    // Only where known(): along rock and away from it: the nearer it comes, the less of the wanted way leads
    // out of its room. gap_m: of the place where it soon is; shy_m: the room that it wants; push: of the way,
    // away from rock. Returns by how much of that room it is too near, up to 2; 0: not at all.
    float keepOff(glm::vec3& way, glm::vec3 soon, float gap_m, float shy_m, float push) const;
    // How far the body reaches out of its room; 0: not at all.
    float overshoot_m(const physics::Capsule& body) const;
    // Whether something of the film stands between the head and the place.
    bool hides(glm::vec3 headWorld, glm::vec3 place) const;

  private:
    const FilmSpace* space_ = nullptr;
    FilmSpace::Room of_ = FilmSpace::Room::Fish;
    FilmSpace::Moment moment_;
};

} // namespace shoal::game
