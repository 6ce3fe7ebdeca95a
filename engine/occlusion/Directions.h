// Sets of directions: axes over half a sphere, cosine-weighted samples, and frames around a direction.
#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/glm.hpp>

namespace shoal::occlusion {

// Radians from one point of a spiral to the next, so that they never line up.
inline constexpr double kGoldenAngle = std::numbers::pi * 0.7639320225002103; // 3 - sqrt 5

// Any number of axes spread over half a sphere (a Fibonacci lattice), each serving the rays along it both
// ways. A shader reads the nearest from a table.
class Axes {
  public:
    static constexpr int kTableWidth = 64;

    explicit Axes(int count = 0); // 0 to 65536
    const std::vector<glm::vec3>& axes() const { return axes_; }
    // The index of the axis nearest to +-each direction: kTableWidth rows over the half of the octahedron
    // with z >= 0, turned by 45 degrees so that it fills the square.
    const std::vector<uint16_t>& table() const { return table_; }
    size_t bytes() const { return table_.size() * sizeof(uint16_t); }

  private:
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
