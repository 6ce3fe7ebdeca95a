#include "content/make/depth/RelativePose.h"

#include "engine/math/Quantile.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace shoal::depth {

namespace {

constexpr double kMinScale_rad = 2e-4; // smallest scale of the Cauchy weights: the precision of the flow

glm::dmat3 rotation(const glm::dvec3& axisTimesAngle) {
    const double angle = glm::length(axisTimesAngle);
    if (angle < 1e-12) return glm::dmat3(1);
    return glm::mat3_cast(glm::angleAxis(angle, axisTimesAngle / angle));
}

double cauchyWeight(double error, double scale) { return 1 / (1 + (error / scale) * (error / scale)); }

// Solves N equations by Gaussian elimination with pivoting. Returns false if they do not determine the
// unknowns.
template <size_t N> bool solve(std::array<std::array<double, N + 1>, N>& rows, std::array<double, N>& out) {
    for (size_t column = 0; column < N; ++column) {
        size_t pivot = column;
        for (size_t r = column + 1; r < N; ++r)
            if (std::abs(rows[r][column]) > std::abs(rows[pivot][column])) pivot = r;
        std::swap(rows[pivot], rows[column]);
        if (std::abs(rows[column][column]) < 1e-15) return false;
        for (size_t r = 0; r < N; ++r) {
            if (r == column) continue;
            const double factor = rows[r][column] / rows[column][column];
            for (size_t k = column; k <= N; ++k) rows[r][k] -= factor * rows[column][k];
        }
    }
    for (size_t r = 0; r < N; ++r) out[r] = rows[r][N] / rows[r][r];
    return true;
}

// Finds the rotation that explains most of the movement, with Cauchy weights, linearised about the last
// estimate.
glm::dmat3 fitRotation(const std::vector<Correspondence>& points) {
    glm::dmat3 estimate(1);
    std::vector<double> errors;
    for (int round = 0; round < 15; ++round) {
        errors.clear();
        for (const Correspondence& p : points) errors.push_back(glm::length(p.second - estimate * p.first));
        std::vector<double> sorted = errors;
        const double scale = std::max(math::median(sorted), kMinScale_rad);
        std::array<std::array<double, 4>, 3> rows{};
        for (size_t i = 0; i < points.size(); ++i) {
            const glm::dvec3 d = estimate * points[i].first;
            const glm::dvec3 moment = glm::cross(d, points[i].second);
            const double w = cauchyWeight(errors[i], scale);
            for (int r = 0; r < 3; ++r) {
                for (int c = 0; c < 3; ++c) rows[r][c] += w * ((r == c ? 1.0 : 0.0) - d[r] * d[c]);
                rows[r][3] += w * moment[r];
            }
        }
        std::array<double, 3> step{};
        if (!solve<3>(rows, step)) break;
        estimate = rotation({step[0], step[1], step[2]}) * estimate;
    }
    return estimate;
}

// Returns the signed angle of the second direction from the epipolar plane.
double epipolarError(const glm::dmat3& secondFromFirst, const glm::dvec3& towards, const Correspondence& p) {
    const glm::dvec3 back = p.second * secondFromFirst; // R^T second
    const glm::dvec3 normal = glm::cross(towards, p.first);
    return glm::dot(normal, back) / std::max(glm::length(normal), 0.05);
}

struct Fit {
    glm::dmat3 secondFromFirst;
    glm::dvec3 towards;
    double cost = 0;
};

double costOf(const Fit& fit, const std::vector<Correspondence>& points, double scale) {
    double sum = 0;
    for (const Correspondence& p : points) {
        const double e = epipolarError(fit.secondFromFirst, fit.towards, p) / scale;
        sum += std::log1p(e * e);
    }
    return sum / static_cast<double>(points.size());
}

// Levenberg-Marquardt on the three angles of the rotation and the two of the movement.
void refine(Fit& fit, const std::vector<Correspondence>& points, double scale, int rounds) {
    fit.cost = costOf(fit, points, scale);
    double damping = 1e-3;
    for (int round = 0; round < rounds; ++round) {
        const glm::dvec3 helper = std::abs(fit.towards.y) < 0.8 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        const glm::dvec3 a = glm::normalize(glm::cross(fit.towards, helper)), b = glm::cross(fit.towards, a);
        const auto moved = [&](const std::array<double, 5>& by) {
            Fit next;
            next.secondFromFirst = rotation({by[0], by[1], by[2]}) * fit.secondFromFirst;
            next.towards = glm::normalize(fit.towards + by[3] * a + by[4] * b);
            return next;
        };
        constexpr double kStep = 1e-6;
        std::array<Fit, 5> varied;
        for (size_t k = 0; k < 5; ++k) {
            std::array<double, 5> by{};
            by[k] = kStep;
            varied[k] = moved(by);
        }
        std::array<std::array<double, 6>, 5> normal{};
        for (const Correspondence& p : points) {
            const double e = epipolarError(fit.secondFromFirst, fit.towards, p);
            const double w = cauchyWeight(e, scale);
            std::array<double, 5> slope{};
            for (size_t k = 0; k < 5; ++k)
                slope[k] = (epipolarError(varied[k].secondFromFirst, varied[k].towards, p) - e) / kStep;
            for (size_t r = 0; r < 5; ++r) {
                for (size_t c = 0; c < 5; ++c) normal[r][c] += w * slope[r] * slope[c];
                normal[r][5] -= w * slope[r] * e;
            }
        }
        for (size_t k = 0; k < 5; ++k) normal[k][k] *= 1 + damping, normal[k][k] += 1e-12;
        std::array<double, 5> step{};
        if (!solve<5>(normal, step)) return;
        Fit next = moved(step);
        next.cost = costOf(next, points, scale);
        if (next.cost < fit.cost) {
            fit = next;
            damping *= 0.3;
        } else
            damping *= 10;
    }
}

} // namespace

Triangulated triangulate(const RelativePose& pose, const Correspondence& point) {
    Triangulated result;
    const glm::dvec3 back = point.second * pose.secondFromFirst;
    const double along = glm::dot(point.first, pose.towards);
    glm::dvec3 across = point.first - along * pose.towards;
    result.sinToMovement = glm::length(across);
    if (result.sinToMovement < 1e-6) return result;
    across /= result.sinToMovement;
    result.offPlane_rad = glm::dot(back, glm::cross(pose.towards, across));
    // The triangle of both cameras and the point: law of sines.
    const double atFirst = std::atan2(result.sinToMovement, along);
    const double atSecond = std::atan2(glm::dot(back, across), glm::dot(back, pose.towards));
    result.parallax_rad = atSecond - atFirst;
    if (std::sin(atSecond) > 1e-3) result.inverse = std::sin(result.parallax_rad) / std::sin(atSecond);
    return result;
}

RelativePose inverted(const RelativePose& pose) {
    RelativePose result = pose;
    result.secondFromFirst = glm::transpose(pose.secondFromFirst);
    result.towards = -(pose.secondFromFirst * pose.towards);
    return result;
}

RelativePose relativePose(const std::vector<Correspondence>& points) {
    RelativePose result;
    if (points.size() < 20) return result;
    const glm::dmat3 turned = fitRotation(points);
    std::vector<double> moved;
    for (const Correspondence& p : points) moved.push_back(glm::length(p.second - turned * p.first));
    const double scale = std::max(0.2 * math::median(moved), kMinScale_rad);
    // Starts from axes over half the sphere: the error does not change with the sign of the movement.
    Fit best{turned, {0, 0, -1}, 1e30};
    for (int x = -1; x <= 1; ++x)
        for (int y = 0; y <= 1; ++y)
            for (int z = 0; z <= 1; ++z) {
                if (x == 0 && y == 0 && z == 0) continue;
                Fit fit{turned, glm::normalize(glm::dvec3(x, y, z)), 0};
                refine(fit, points, scale, 6);
                if (fit.cost < best.cost) best = fit;
            }
    refine(best, points, kMinScale_rad * 2 + 0.3 * scale, 30);
    result.secondFromFirst = best.secondFromFirst;
    result.towards = best.towards;
    // Chooses the sign for which points lie in front of both cameras. Points off their epipolar planes move
    // by themselves and count little.
    double forwards = 0, all = 0;
    moved.clear();
    for (const Correspondence& p : points) {
        const Triangulated t = triangulate(result, p);
        const double still = cauchyWeight(t.offPlane_rad, kMinScale_rad * 2 + 0.3 * scale);
        const double bounded = still * std::clamp(t.parallax_rad, -0.02, 0.02);
        forwards += bounded, all += std::abs(bounded);
        moved.push_back(std::abs(t.parallax_rad));
    }
    if (forwards < 0) result.towards = -result.towards;
    result.parallax_rad = math::median(moved);
    result.agreement = all > 0 ? std::abs(forwards) / all : 0;
    return result;
}

} // namespace shoal::depth
