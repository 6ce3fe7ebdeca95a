#include "tests/bench/light/Truth.h"
#include "engine/core/Hash.h"

#include <fmt/format.h>

namespace shoal::bench {

std::vector<glm::dvec3> chartDirections(int spread) {
    std::vector<glm::dvec3> dirs;
    for (int i = 0; i < spread; ++i) {
        const double y = 1 - (2 * i + 1.0) / spread, turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
        const double ring = std::sqrt(1 - y * y);
        dirs.emplace_back(ring * std::cos(turn), y, ring * std::sin(turn));
    }
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0}) {
            glm::dvec3 dir(0);
            dir[axis] = sign;
            dirs.push_back(dir);
        }
    return dirs;
}

namespace {

constexpr uint64_t kVersion = 1; // raise it when lobes or the integral change

Path fileOf(const ImageRgbF& image, std::span<const glm::dvec3> dirs, const Path& folder) {
    Hash hash;
    hash.add(kVersion);
    hash.add(image.width);
    hash.bytes(image.pixels.data(), image.pixels.size() * sizeof(float));
    for (const glm::dvec3& dir : dirs) hash.bytes(&dir[0], 3 * sizeof(double));
    for (const float roughness : kRoughnesses) hash.add(roughness);
    return folder / fmt::format("{:016x}", hash.value());
}

} // namespace

Truth integrals(const ImageRgbF& radianceLin, std::span<const glm::dvec3> dirs,
                std::span<const light::Lobe> lobes) {
    Truth truth(dirs.size());
    onAllCores(dirs.size(),
               [&](size_t k) { truth[k] = light::referenceRadiance(radianceLin, dirs[k], lobes); });
    return truth;
}

Truth truthOf(const ImageRgbF& radianceLin, std::span<const glm::dvec3> dirs, const Path& folder) {
    Truth truth(dirs.size(), std::vector<glm::dvec3>(kLobes));
    const size_t rowBytes = kLobes * sizeof(glm::dvec3);
    const Path file = fileOf(radianceLin, dirs, folder);
    if (const auto kept = readFile(file, 1u << 24); kept && kept->size() == dirs.size() * rowBytes) {
        for (size_t i = 0; i < dirs.size(); ++i)
            std::memcpy(truth[i].data(), kept->data() + i * rowBytes, rowBytes);
        return truth;
    }

    std::vector<light::Lobe> lobes = {light::diffuseLobe()};
    for (const float roughness : kRoughnesses) lobes.push_back(light::glossyLobe(roughness));
    truth = integrals(radianceLin, dirs, lobes);
    std::string bytes;
    for (const auto& row : truth) bytes.append(reinterpret_cast<const char*>(row.data()), rowBytes);
    if (const auto written = writeFileWhole(file, bytes); !written)
        std::fprintf(stderr, "chart: %s\n", written.error().message().c_str());
    return truth;
}

} // namespace shoal::bench
