#include "tests/bench/occlusion/Cells.h"

#include "engine/math/LatLong.h"
#include "engine/math/Octahedron.h"

namespace shoal::bench {

constexpr int kBase = 96, kFine = 768; // cells along the square's side: the widest, the narrowest
constexpr float kShare = 1e-3f;        // share of an environment's light above which a cell is cut in four

glm::vec3 directionOfSquare(const glm::vec2& at) { return math::directionFromOctahedral(at * 2.0f - 1.0f); }

// Returns the place in the square at its finest, row by row.
static size_t placeOf(const glm::vec3& direction) {
    const glm::vec2 square = math::octahedralFromDirection(direction) * 0.5f + 0.5f;
    const glm::ivec2 at = glm::min(glm::ivec2(square * static_cast<float>(kFine)), kFine - 1);
    return at.y * kFine + at.x;
}

Fine fineOf(const ImageRgbF& image) {
    std::vector<glm::dvec3> sums(static_cast<size_t>(kFine) * kFine);
    const int parts = std::max(1, 2048 / image.width); // of a texel, each way
    for (int y = 0; y < image.height; ++y) {
        const double share = texelSolidAngle(y, image.width, image.height) / (parts * parts);
        for (int x = 0; x < image.width; ++x) {
            const float* texel = image.at(x, y);
            const glm::dvec3 power = share * glm::dvec3(texel[0], texel[1], texel[2]);
            for (int part = 0; part < parts * parts; ++part) {
                const glm::vec3 direction = texelDirection(x * parts + part % parts, y * parts + part / parts,
                                                           image.width * parts, image.height * parts);
                sums[placeOf(direction)] += power;
            }
        }
    }
    return {sums.begin(), sums.end()};
}

size_t Cells::cellTowards(const glm::vec3& direction) const { return byPlace[placeOf(direction)]; }

Cells cellsOf(std::span<const Fine> environments) {
    Cells out;
    out.environments = environments.size();
    out.byPlace.resize(static_cast<size_t>(kFine) * kFine);
    std::vector<float> whole;
    for (const Fine& fine : environments) {
        glm::dvec3 sum(0);
        for (const glm::vec3& power : fine) sum += power;
        whole.push_back(static_cast<float>(sum.x + sum.y + sum.z));
    }
    std::vector<glm::vec3> power(environments.size());
    const auto visit = [&](auto&& self, glm::ivec2 low, int side) -> void {
        bool bright = false;
        for (size_t s = 0; s < environments.size(); ++s) {
            glm::dvec3 sum(0);
            for (int y = low.y; y < low.y + side; ++y)
                for (int x = low.x; x < low.x + side; ++x) sum += environments[s][y * kFine + x];
            power[s] = sum;
            bright = bright || power[s].x + power[s].y + power[s].z > kShare * whole[s];
        }
        if (bright && side > 1) {
            for (int quarter = 0; quarter < 4; ++quarter)
                self(self, low + glm::ivec2(quarter & 1, quarter >> 1) * (side / 2), side / 2);
            return;
        }
        for (int y = low.y; y < low.y + side; ++y)
            for (int x = low.x; x < low.x + side; ++x)
                out.byPlace[y * kFine + x] = static_cast<uint32_t>(out.cells.size());
        const glm::vec2 corner = glm::vec2(low) / static_cast<float>(kFine);
        const float width = static_cast<float>(side) / kFine;
        const glm::vec3 centre = directionOfSquare(corner + 0.5f * width);
        // The octahedron's faces, at the length 1 / k of the ray that meets them, seen from the middle.
        const float k = std::abs(centre.x) + std::abs(centre.y) + std::abs(centre.z);
        out.cells.push_back({corner, width, centre, 4 * width * width * k * k * k});
        out.power.insert(out.power.end(), power.begin(), power.end());
    };
    for (int y = 0; y < kBase; ++y)
        for (int x = 0; x < kBase; ++x) visit(visit, glm::ivec2(x, y) * (kFine / kBase), kFine / kBase);
    return out;
}

} // namespace shoal::bench
