#include "engine/light/Reference.h"

#include "engine/math/Brdf.h"
#include "engine/math/LatLong.h"

namespace shoal::light {

Lobe diffuseLobe() {
    return [](double cosine) { return std::max(0.0, cosine); };
}

Lobe glossyLobe(double roughness) {
    return [alpha = math::alphaFromRoughness(roughness)](double cosine) {
        return math::ggxMirrorLobe(cosine, alpha);
    };
}

std::vector<glm::dvec3> referenceRadiance(const ImageRgbF& radianceLin, const glm::dvec3& axis,
                                          std::span<const Lobe> lobes) {
    std::vector<glm::dvec3> gathered(lobes.size(), glm::dvec3(0));
    std::vector<double> weights(lobes.size(), 0.0);
    for (int row = 0; row < radianceLin.height; ++row) {
        const double solidAngle = texelSolidAngle(row, radianceLin.width, radianceLin.height);
        for (int column = 0; column < radianceLin.width; ++column) {
            const glm::dvec2 uv((column + 0.5) / radianceLin.width, (row + 0.5) / radianceLin.height);
            const double cosine = glm::dot(axis, directionFromLatLong(uv));
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
