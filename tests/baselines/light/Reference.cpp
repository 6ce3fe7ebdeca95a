#include "tests/baselines/light/Reference.h"

#include "engine/math/LatLong.h"

#include <cmath>
#include <numbers>

namespace shoal::light {

std::vector<glm::dvec3> referenceRadiance(const ImageRgbF& radianceLin, const glm::dvec3& axis,
                                          std::span<const Lobe> lobes) {
    std::vector<glm::dvec3> gathered(lobes.size(), glm::dvec3(0));
    std::vector<double> weights(lobes.size(), 0.0);
    std::vector<glm::dvec3> equator; // each column's direction
    for (int column = 0; column < radianceLin.width; ++column)
        equator.push_back(directionFromLatLong(glm::dvec2((column + 0.5) / radianceLin.width, 0.5)));
    for (int row = 0; row < radianceLin.height; ++row) {
        const double latitude = (0.5 - (row + 0.5) / radianceLin.height) * std::numbers::pi;
        const double up = axis.y * std::sin(latitude), level = std::cos(latitude);
        const double solidAngle = texelSolidAngle(row, radianceLin.width, radianceLin.height);
        for (int column = 0; column < radianceLin.width; ++column) {
            const glm::dvec3& towards = equator[column];
            const double cosine = up + level * (axis.x * towards.x + axis.z * towards.z);
            if (cosine <= 0) continue; // no lobe reaches there
            const float* texel = radianceLin.at(column, row);
            const glm::dvec3 radiance(texel[0], texel[1], texel[2]);
            for (size_t i = 0; i < lobes.size(); ++i) {
                const double weight = lobes[i](cosine) * solidAngle;
                gathered[i] += radiance * weight;
                weights[i] += weight;
            }
        }
    }
    for (size_t i = 0; i < lobes.size(); ++i) gathered[i] /= weights[i];
    return gathered;
}

} // namespace shoal::light
