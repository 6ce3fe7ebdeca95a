#include "game/rules/FilmSpace.h"

#include "engine/core/Hash.h"
#include "game/rules/Swimmer.h"

#include <algorithm>
#include <cmath>

namespace shoal::game {

namespace {

constexpr int kBordered = FilmSpace::kSide + 2;
constexpr size_t kStride = static_cast<size_t>(kBordered) * kBordered; // cells of a step with its border

// Limits on how fast an animal's room shrinks, so that it can follow by swimming.
struct Shrinking {
    float wall_mps;    // with time, as a wall comes nearer or a pillar passes
    float narrowing_m; // with direction, metres per radian
};
constexpr std::array<Shrinking, 2> kShrinking = {{{0.6f, 2.5f}, {1.2f, 6.0f}}}; // by FilmSpace::Room

// Returns the place of a direction on the unfolded square, in cells, 0 to kSide.
glm::vec2 unfolded(const glm::vec3& dir) {
    constexpr float kHalf = 0.5f * FilmSpace::kSide;
    return (math::octahedralFromDirection(dir) + 1.0f) * kHalf;
}

size_t cellAt(int x, int y) { return static_cast<size_t>(y + 1) * kBordered + static_cast<size_t>(x + 1); }
size_t cellAt(int cell) { return cellAt(cell % FilmSpace::kSide, cell / FilmSpace::kSide); }

// Fills the border cells around the square: beyond an edge the octahedron continues at that edge, mirrored.
template <class T> void fillBorder(T* grid) {
    constexpr int n = FilmSpace::kSide;
    for (int i = 0; i < n; ++i) {
        grid[cellAt(-1, i)] = grid[cellAt(0, n - 1 - i)];
        grid[cellAt(n, i)] = grid[cellAt(n - 1, n - 1 - i)];
    }
    for (int i = -1; i <= n; ++i) { // with the corners, from the columns just filled
        grid[cellAt(i, -1)] = grid[cellAt(n - 1 - i, 0)];
        grid[cellAt(i, n)] = grid[cellAt(n - 1 - i, n - 1)];
    }
}

// Offsets from a cell's index to those of its eight neighbours.
constexpr std::array<int, 8> kAround = {-kBordered - 1, -kBordered, -kBordered + 1, -1, 1,
                                        kBordered - 1,  kBordered,  kBordered + 1};

// Returns by how many millimetres each cell may exceed each of its neighbours. The angle between two cells is
// taken as its chord, which is shorter, so the room narrows a little more slowly than the limit.
std::vector<std::array<float, 8>> allowances(float narrowing_m) {
    std::vector<glm::vec3> directions(kStride);
    for (int cell = 0; cell < FilmSpace::kCells; ++cell)
        directions[cellAt(cell)] = FilmSpace::directionOf(cell);
    fillBorder(directions.data());
    std::vector<std::array<float, 8>> allowed(kStride);
    for (int cell = 0; cell < FilmSpace::kCells; ++cell)
        for (size_t i = 0; i < kAround.size(); ++i) {
            const glm::vec3 apart = directions[cellAt(cell)] - directions[cellAt(cell) + kAround[i]];
            allowed[cellAt(cell)][i] = 1000 * narrowing_m * glm::length(apart);
        }
    return allowed;
}

// Sets each cell to the minimum of itself and its neighbours, so that interpolation between four cells gives
// no distance greater than any of theirs.
void widen(const uint16_t* surface, float* room) {
    for (int cell = 0; cell < FilmSpace::kCells; ++cell) {
        uint16_t nearest = surface[cellAt(cell)];
        for (const int offset : kAround) nearest = std::min(nearest, surface[cellAt(cell) + offset]);
        room[cellAt(cell)] = nearest;
    }
    fillBorder(room);
}

// Lowers cells until none is farther than its neighbours allow: sweeps there and back.
void smoothDirections(const std::vector<std::array<float, 8>>& allowed, float* room) {
    constexpr int kMaxSweeps = 16;
    for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
        bool changed = false;
        for (int i = 0; i < FilmSpace::kCells; ++i) {
            const size_t cell = cellAt(sweep % 2 ? FilmSpace::kCells - 1 - i : i);
            for (size_t k = 0; k < kAround.size(); ++k) {
                const float most = room[cell + kAround[k]] + allowed[cell][k];
                if (room[cell] > most) room[cell] = most, changed = true;
            }
        }
        fillBorder(room);
        if (!changed && sweep > 0) return;
    }
}

} // namespace

FilmSpace::FilmSpace(double length_s, std::vector<uint16_t> surface_mm)
    : length_s_(length_s), steps_(static_cast<int>(surface_mm.size() / kCells)) {
    surface_mm_.resize(steps_ * kStride);
    for (int step = 0; step < steps_; ++step) {
        uint16_t* to = surface_mm_.data() + step * kStride;
        for (int cell = 0; cell < kCells; ++cell)
            to[cellAt(cell)] =
                std::min(surface_mm[step * kCells + cell], static_cast<uint16_t>(1000 * kFar_m));
        fillBorder(to);
    }
    for (const Room of : {Room::Fish, Room::Shark}) makeRoom(of);
}

// Makes the room: the largest function below the surface that changes no faster than the limits with time and
// with direction. The limits add, so they can be applied one after the other.
void FilmSpace::makeRoom(Room of) {
    const Shrinking& may = kShrinking[static_cast<size_t>(of)];
    const auto allowed = allowances(may.narrowing_m);
    std::vector<float> room(surface_mm_.size());
    for (int step = 0; step < steps_; ++step) {
        float* here = room.data() + step * kStride;
        widen(surface_mm_.data() + step * kStride, here);
        smoothDirections(allowed, here);
    }
    const auto step_s = static_cast<float>(length_s_ / steps_);
    const float later = 1000 * may.wall_mps * step_s;
    const auto limit = [&](int step, int by) {
        float* here = room.data() + step * kStride;
        const float* other = room.data() + by * kStride;
        for (size_t i = 0; i < kStride; ++i) here[i] = std::min(here[i], other[i] + later);
    };
    // Two rounds, as the film repeats.
    for (int i = 0; i < 2 * steps_; ++i) limit((i + 1) % steps_, i % steps_);
    for (int i = 2 * steps_; i > 0; --i) limit((i - 1) % steps_, i % steps_);
    std::vector<uint16_t>& made = room_mm_[static_cast<size_t>(of)];
    made.resize(room.size());
    std::transform(room.begin(), room.end(), made.begin(),
                   [](float mm) { return static_cast<uint16_t>(mm); });
}

uint64_t FilmSpace::hash() const {
    Hash hash;
    hash.add(length_s_);
    hash.add(steps_);
    hash.bytes(surface_mm_.data(), surface_mm_.size() * sizeof(uint16_t));
    return hash.value();
}

FilmSpace::Moment FilmSpace::at(double time_s) const {
    const double turns = time_s / length_s_;
    const double step = (turns - std::floor(turns)) * steps_;
    const int before = std::min(static_cast<int>(step), steps_ - 1);
    return {static_cast<size_t>(before), static_cast<size_t>((before + 1) % steps_),
            static_cast<float>(step - before)};
}

float FilmSpace::lookUp(const std::vector<uint16_t>& grid, const Moment& moment, glm::vec3 dir) const {
    const glm::vec2 place = unfolded(dir);
    const float left = std::floor(place.x - 0.5f), top = std::floor(place.y - 0.5f);
    const float across = place.x - 0.5f - left, down = place.y - 0.5f - top;
    const size_t first = cellAt(std::clamp(static_cast<int>(left), -1, kSide - 1),
                                std::clamp(static_cast<int>(top), -1, kSide - 1));
    const auto inStep = [&](size_t step) {
        const uint16_t* cell = grid.data() + step * kStride + first;
        const auto mix = [](float a, float b, float share) { return a + (b - a) * share; };
        return mix(mix(cell[0], cell[1], across), mix(cell[kBordered], cell[kBordered + 1], across), down);
    };
    const float before = inStep(moment.before), after = inStep(moment.after);
    return 0.001f * (before + (after - before) * moment.share);
}

glm::vec3 FilmSpace::corner(const Moment& moment, int x, int y) const {
    const auto mirror = [](int& beyond, int& along) {
        if (beyond >= 0 && beyond < kSide) return;
        beyond = beyond < 0 ? -1 - beyond : 2 * kSide - 1 - beyond;
        along = kSide - 1 - along;
    };
    mirror(y, x);
    mirror(x, y);
    const int cell = std::clamp(y, 0, kSide - 1) * kSide + std::clamp(x, 0, kSide - 1);
    const auto inStep = [&](size_t step) {
        return static_cast<float>(surface_mm_[step * kStride + cellAt(cell)]);
    };
    const float before = inStep(moment.before), after = inStep(moment.after);
    return directionOf(cell) * (0.001f * (before + (after - before) * moment.share));
}

float FilmMoment::gap_m(glm::vec3 place) const {
    const float distance = glm::length(place);
    return space_->room_m(moment_, distance > 1e-4f ? place : kUp, of_) - distance;
}

float FilmMoment::surfaceGap_m(glm::vec3 place) const {
    const float distance = glm::length(place);
    return space_->surface_m(moment_, distance > 1e-4f ? place : kUp) - distance;
}

glm::vec3 FilmMoment::inward(glm::vec3 place) const {
    constexpr float kApart_m = 0.1f;
    glm::vec3 slope;
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 aside(0);
        aside[axis] = kApart_m;
        slope[axis] = gap_m(place + aside) - gap_m(place - aside);
    }
    return normalizedOr(slope, normalizedOr(-place, kUp));
}

float FilmMoment::keepOff(glm::vec3& way, glm::vec3 soon, float gap_m, float shy_m, float push) const {
    if (gap_m >= shy_m) return 0;
    const glm::vec3 away = inward(soon);
    const float share = std::min(1 - gap_m / shy_m, 2.0f);
    const float outwards = -glm::dot(way, away);
    if (outwards > 0) way += away * (outwards * std::min(share, 1.0f));
    way += away * (share * push);
    return share;
}

float FilmMoment::overshoot_m(const physics::Capsule& body, float enough_m) const {
    if (!known()) return 0;
    constexpr float kBetween_m = 0.35f; // greatest distance between places tested along the body
    const glm::vec3 core = body.b - body.a;
    const int pieces = 2 + static_cast<int>(glm::length(core) / kBetween_m);
    float most = 0;
    for (int i = 0; i <= pieces && most <= enough_m; ++i)
        most = std::max(
            most, body.radius - gap_m(body.a + core * (static_cast<float>(i) / static_cast<float>(pieces))));
    return most;
}

glm::vec3 FilmMoment::pulledIn(glm::vec3 place, const physics::Capsule& body, float most_m) const {
    const float moved_m = std::min(overshoot_m(body), most_m);
    return moved_m > 0 ? place - place * (moved_m / glm::length(place)) : place;
}

void FilmMoment::triangles(glm::vec3 low, glm::vec3 high, const physics::Ground::Visit& visit) const {
    constexpr int kSide = FilmSpace::kSide;
    constexpr float kCellsPerRad = 0.5f * kSide; // cells are narrowest at the octahedron's corners
    const glm::vec3 centre = 0.5f * (low + high);
    const float reach = 0.5f * glm::length(high - low), distance = glm::length(centre);
    const float angle = distance > 2 * reach ? 1.05f * reach / distance : 4.0f; // the arc sine, from above
    const int range = std::min(kSide / 2, 2 + static_cast<int>(kCellsPerRad * angle));
    const glm::vec2 middle = unfolded(distance > 0 ? centre : kUp);
    const int left = static_cast<int>(middle.x) - range, top = static_cast<int>(middle.y) - range;
    std::array<std::array<glm::vec3, kSide + 1>, 2> rows;
    for (int y = 0; y <= 2 * range; ++y) {
        const auto &above = rows[(y + 1) % 2], &here = rows[y % 2];
        for (int x = 0; x <= 2 * range; ++x) rows[y % 2][x] = space_->corner(moment_, left + x, top + y);
        for (int x = 0; y > 0 && x < 2 * range; ++x) {
            const glm::vec3 a = above[x], b = above[x + 1], c = here[x], d = here[x + 1];
            const glm::vec3 least = glm::min(glm::min(a, b), glm::min(c, d)),
                            most = glm::max(glm::max(a, b), glm::max(c, d));
            if (glm::any(glm::greaterThan(least, high)) || glm::any(glm::lessThan(most, low))) continue;
            visit(a, b, d);
            visit(a, d, c);
        }
    }
}

bool FilmMoment::hides(glm::vec3 headWorld, glm::vec3 place) const {
    if (!known()) return false;
    constexpr float kBehind_m = 0.05f; // tolerance: a body that is half in a surface counts as seen
    constexpr int kLooks = 6;
    const glm::vec3 way = place - headWorld;
    const float distance = glm::length(way);
    if (distance < FilmSpace::kNearest_m) return false;
    // Tests points on the line of sight, whose directions from the camera differ if the head is beside it.
    for (int i = 1; i <= kLooks; ++i) {
        const float share = static_cast<float>(i) / kLooks;
        if (share * distance < FilmSpace::kNearest_m) continue;
        const glm::vec3 along = headWorld + way * share;
        const float fromCamera = glm::length(along);
        if (fromCamera > FilmSpace::kNearest_m && fromCamera > space_->surface_m(moment_, along) + kBehind_m)
            return true;
    }
    return false;
}

} // namespace shoal::game
