#include "tests/baselines/occlusion/BoneBalls.h"

#include <algorithm>
#include <cmath>

namespace shoal::occlusion::baselines {

namespace {

// Eigenvectors of a symmetric matrix, by Jacobi's rotations; values on the diagonal of what is left.
glm::mat3 eigenvectors(glm::mat3& m) {
    glm::mat3 vectors(1);
    for (int sweep = 0; sweep < 12; ++sweep)
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q) {
                if (std::abs(m[q][p]) < 1e-20f) continue;
                const float angle = 0.5f * std::atan2(2 * m[q][p], m[q][q] - m[p][p]);
                glm::mat3 turn(1);
                turn[p][p] = turn[q][q] = std::cos(angle);
                turn[q][p] = std::sin(angle);
                turn[p][q] = -turn[q][p];
                m = glm::transpose(turn) * m * turn;
                vectors = vectors * turn;
            }
    return vectors;
}

} // namespace

std::vector<Ellipsoid> fitEllipsoids(const BodyMesh& rest, std::span<const int> boneOf, int bones) {
    struct Moments {
        double weight = 0;
        glm::dvec3 first{0};
        glm::dmat3 second{0};
    };
    std::vector<Moments> sums(static_cast<size_t>(bones));
    for (const glm::uvec3& corner : rest.triangles) {
        const glm::dvec3 a = rest.positions[corner.x], b = rest.positions[corner.y],
                         c = rest.positions[corner.z];
        const double area = glm::length(glm::cross(b - a, c - a));
        const glm::dvec3 middle = (a + b + c) / 3.0;
        Moments& sum = sums[static_cast<size_t>(boneOf[corner.x])];
        sum.weight += area;
        sum.first += area * middle;
        sum.second += area * glm::outerProduct(middle, middle);
    }
    double all = 0;
    for (const Moments& sum : sums) all += sum.weight;
    std::vector<Ellipsoid> out;
    for (int bone = 0; bone < bones; ++bone) {
        const Moments& sum = sums[static_cast<size_t>(bone)];
        if (sum.weight < 0.01 * all) continue;
        const glm::dvec3 centre = sum.first / sum.weight;
        glm::mat3 spread(sum.second / sum.weight - glm::outerProduct(centre, centre));
        Ellipsoid fitted{centre, eigenvectors(spread), bone};
        // A shell's spread along an axis is a third of its half length's square.
        for (int axis = 0; axis < 3; ++axis)
            fitted.axes[axis] *= std::sqrt(std::max(3 * spread[axis][axis], 1e-8f));
        out.push_back(fitted);
    }
    return out;
}

Ellipsoid moved(const Ellipsoid& at, const glm::mat4& worldFromRest) {
    return {glm::vec3(worldFromRest * glm::vec4(at.centre, 1)), glm::mat3(worldFromRest) * at.axes, at.bone};
}

// The outline seen along a unit direction d has the area pi times |adj(A) d| for half axes A.
SeenSphere seenFrom(const glm::vec3& point, const Ellipsoid& at) {
    const glm::vec3 to = at.centre - point;
    const float distance = glm::length(to);
    const glm::vec3 toward = to / std::max(distance, 1e-9f);
    const glm::vec3 x = at.axes[0], y = at.axes[1], z = at.axes[2];
    const float area =
        glm::length(glm::vec3(glm::dot(glm::cross(y, z), toward), glm::dot(glm::cross(z, x), toward),
                              glm::dot(glm::cross(x, y), toward)));
    return {to, std::min(std::sqrt(area), 0.999f * distance)};
}

} // namespace shoal::occlusion::baselines
