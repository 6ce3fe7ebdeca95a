// From which directions a body is seen, and which of them is nearest to a ray.
#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/glm.hpp>

namespace shoal::occlusion {

// Radians from one point of a spiral to the next, so that they never line up.
inline constexpr double kGoldenAngle = std::numbers::pi * 0.7639320225002103; // 3 - sqrt 5

// The thesis' set: a cube around the body, each face cut into n x n cells of equal angle, one direction
// through the middle of each; 6 n^2 in all: 54 (n = 3), 150 (5), 486 (9). Unit vectors.
std::vector<glm::vec3> cubeDirections(int n);
// Index into cubeDirections(n) of the cell that holds this direction.
int nearestCubeDirection(const glm::vec3& direction, int n);

// Any number of axes spread over half a sphere (a Fibonacci lattice), each serving the rays along it both
// ways. The nearest is read from a table over the half sphere's octahedral square.
class Axes {
  public:
    static constexpr int kTableWidth = 64;

    explicit Axes(int count = 0); // 0 to 65536
    const std::vector<glm::vec3>& axes() const { return axes_; }
    // Index of the axis nearest to +-direction; within half a table cell (at most 0.05 rad) of the border
    // between two, it may be the second nearest.
    int nearest(const glm::vec3& direction) const { return table_[cell(direction)]; }
    // kTableWidth rows.
    const std::vector<uint16_t>& table() const { return table_; }
    size_t bytes() const { return table_.size() * sizeof(uint16_t); }

  private:
    static size_t cell(glm::vec3 direction);

    std::vector<glm::vec3> axes_;
    std::vector<uint16_t> table_;
};

// Cosine-weighted over the half sphere around +Z, stratified: Shirley and Chiu 1997 by rings of Vogel's
// spiral.
std::vector<glm::vec3> cosineDirections(int count);

// Some right-handed frame with +Z along a unit normal; turns smoothly with it but at one point. Duff et al.
// 2017, "Building an Orthonormal Basis, Revisited".
glm::mat3 frameAround(const glm::vec3& normal);

// A rotation whose third row is `axis` (unit), the others turned by `turn` radians around it.
glm::mat3 lookingAlong(const glm::vec3& axis, float turn);

} // namespace shoal::occlusion
