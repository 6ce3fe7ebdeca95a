#include "engine/render/CameraComposite.h"

#include "engine/core/Random.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::render {

namespace {

constexpr float kFinest = 0.6f;            // texels
constexpr float kUnseenNoise = 0.3f / 255; // standard deviation
// A range of 16 to 235 that is shown as 0 to 255 lacks both ends in all channels. Where one end alone is
// missing, it is the scene that has nothing as dark or as bright, and what is drawn may.
constexpr float kMaxLift = 16.0f / 255, kMaxCut = 20.0f / 255, kMissing = 6.0f / 255;

} // namespace

float layerTexels(const camera::CameraResponse& response, int samples) {
    const float blur2 = 1 / 12.0f + response.blur_texels * response.blur_texels;
    return samples > 1 ? std::max(std::sqrt(4 * blur2), kFinest) : std::max(std::sqrt(6 * blur2), 1.0f);
}

std::vector<uint8_t> makeGrain() {
    Random random(29, 7);
    const auto value = [&] {
        const float radius = std::sqrt(-2 * std::log(std::max(random.unit(), 1e-7f)));
        const float normal =
            radius * std::cos(2 * std::numbers::pi_v<float> * random.unit()); // Box, Muller 1958
        return static_cast<uint8_t>(std::clamp(255 * (0.5f + kGrainDeviation * normal) + 0.5f, 0.0f, 255.0f));
    };
    std::vector<uint8_t> grains(size_t{2} * kGrainSize * kGrainSize);
    for (int y = 0; y < kGrainSize; ++y)
        for (int x = 0; x < kGrainSize; ++x) {
            const auto at = [&](int i, int j) { return 2 * static_cast<size_t>(j * kGrainSize + i); };
            grains[at(x, y)] = value();
            grains[at(x, y) + 1] = x % 2 || y % 2 ? grains[at(x & ~1, y & ~1) + 1] : value();
        }
    return grains;
}

gl::Texture makeGrainTexture() {
    const std::vector<uint8_t> grains = makeGrain();
    gl::Texture texture = gl::makeTexture(GL_NEAREST, GL_NEAREST, GL_REPEAT, GL_REPEAT);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RG8, kGrainSize, kGrainSize, 0, GL_RG, GL_UNSIGNED_BYTE, grains.data());
    return texture;
}

unsigned cameraFeatures(const camera::CameraResponse& response) {
    unsigned features = kFilmed;
    const auto seen = [](const auto& noise) { return *std::ranges::max_element(noise) > kUnseenNoise; };
    if (seen(response.fineNoise) || seen(response.coarseNoise)) features |= kGrainy;
    if (response.chromaTexels != glm::ivec2(1)) features |= kSharesColour;
    return features;
}

CameraUniforms cameraUniforms(const FilmedFrame& filmed) {
    const camera::CameraResponse& response = filmed.response;
    const bool shortRange = glm::all(glm::greaterThan(response.black, glm::vec3(kMissing))) &&
                            glm::all(glm::lessThan(response.white, glm::vec3(1 - kMissing)));
    const glm::vec3 black = shortRange ? glm::min(response.black, kMaxLift) : glm::vec3(0);
    const glm::vec3 white = shortRange ? glm::max(response.white, 1 - kMaxCut) : glm::vec3(1);
    Random random(static_cast<uint64_t>(filmed.index), 13);
    const auto step = [&] { return static_cast<int>(random.below(kGrainSize)); };
    const int x = step();
    return {black,
            white - black,
            response.glare,
            glm::vec2(response.chromaTexels - 1),
            response.fineNoise,
            response.coarseNoise,
            {x, step()},
            0.5f / kGrainDeviation};
}

void setCameraUniforms(const gl::Program& program, const FilmedFrame& filmed) {
    const CameraUniforms n = cameraUniforms(filmed);
    program.set("black", n.black);
    program.set("range", n.range);
    program.set("glare", n.glare);
    program.set("shares", n.shares);
    program.setArray("fineNoise[0]", std::span<const float>(n.fineNoise));
    program.setArray("coarseNoise[0]", std::span<const float>(n.coarseNoise));
    program.set("grainShift", n.grainShift);
    program.set("perGrain", n.perGrain);
}

} // namespace shoal::render
