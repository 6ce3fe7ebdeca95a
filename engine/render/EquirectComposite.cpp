#include "engine/render/EquirectComposite.h"

#include "engine/core/Random.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace shoal::render {

namespace {

enum Feature : unsigned { kFilmed = 1, kShaded = 2 };
constexpr std::array kCompositeDefines = {"FILMED", "SHADED"};
constexpr float kFinest = 0.6f;            // texels a pixel
constexpr float kUnseenNoise = 0.3f / 255; // standard deviation
// A video of range 16 to 235 that is read as 0 to 255 lacks both ends in all channels. If only one end is
// missing, the scene has nothing as dark or as bright, but objects may be as dark or as bright.
constexpr float kMaxLift = 16.0f / 255, kMaxCut = 20.0f / 255, kMissing = 6.0f / 255;

} // namespace

float layerTexels(const camera::CameraResponse& response, int samples) {
    const float blur2 = 1 / 12.0f + response.blur_texels * response.blur_texels;
    return samples > 1 ? std::max(std::sqrt(4 * blur2), kFinest) : std::max(std::sqrt(6 * blur2), 1.0f);
}

const std::vector<uint8_t>& grains() {
    static const auto made = [] {
        Random random(29, 7);
        const auto value = [&] {
            const float radius = std::sqrt(-2 * std::log(std::max(random.unit(), 1e-7f)));
            const float normal =
                radius * std::cos(2 * std::numbers::pi_v<float> * random.unit()); // Box, Muller 1958
            return static_cast<uint8_t>(
                std::clamp(255 * (0.5f + kGrainDeviation * normal) + 0.5f, 0.0f, 255.0f));
        };
        std::vector<uint8_t> all(size_t{2} * kGrainSize * kGrainSize);
        for (int y = 0; y < kGrainSize; ++y)
            for (int x = 0; x < kGrainSize; ++x) {
                const auto at = [&](int i, int j) { return 2 * static_cast<size_t>(j * kGrainSize + i); };
                all[at(x, y)] = value();
                all[at(x, y) + 1] = x % 2 || y % 2 ? all[at(x & ~1, y & ~1) + 1] : value();
            }
        return all;
    }();
    return made;
}

CameraUniforms cameraUniforms(const FilmedFrame& filmed) {
    const camera::CameraResponse& response = filmed.response;
    const bool shortRange = glm::all(glm::greaterThan(response.black, glm::vec3(kMissing))) &&
                            glm::all(glm::lessThan(response.white, glm::vec3(1 - kMissing)));
    const glm::vec3 black = shortRange ? glm::min(response.black, kMaxLift) : glm::vec3(0);
    const glm::vec3 white = shortRange ? glm::max(response.white, 1 - kMaxCut) : glm::vec3(1);
    const auto seen = [](const auto& noise) { return *std::ranges::max_element(noise) > kUnseenNoise; };
    const bool grainy = seen(response.fineNoise) || seen(response.coarseNoise);
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
            grainy ? 0.5f / kGrainDeviation : 0};
}

Result<EquirectComposite> EquirectComposite::make() {
    EquirectComposite pass;
    pass.programs_ = gl::Variants("render/EquirectComposite", kCompositeDefines);
    for (unsigned features = 0; features <= (kFilmed | kShaded); ++features)
        if (auto program = pass.programs_.get(features); !program) return program.error();
    pass.grain_ = gl::makeTexture(GL_NEAREST, GL_NEAREST, GL_REPEAT, GL_REPEAT);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RG8, kGrainSize, kGrainSize, 0, GL_RG, GL_UNSIGNED_BYTE,
                 grains().data());
    pass.drawn_ = TriangleBatch::make();
    pass.framebuffer_ = gl::Framebuffer::make();
    return pass;
}

void EquirectComposite::paint(const EnvironmentGpu& environment, const FrameTiles& tiles,
                              const std::vector<bool>& wanted, GLuint layer, const View& layerView,
                              const glm::mat3& envFromWorld, const FilmedFrame* filmed, GLuint shadows) {
    assert(environment.frameIsCoded());
    const glm::ivec2 size = tiles.frameSize();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    if (size != size_) {
        size_ = size;
        frame_ = makeLatLongTexture();
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, size.x, size.y, 0, GL_BGRA, GL_UNSIGNED_BYTE, nullptr);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, frame_.name(), 0);
        assert(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
    }
    corners_.clear();
    FrameTiles::eachOf(wanted, [&](const glm::ivec2& tile) {
        const glm::vec2 low = tiles.lowOf(tile), high = tiles.lowOf(tile + 1);
        if (low.x < high.x && low.y < high.y)
            addRectangle(low / glm::vec2(size), high / glm::vec2(size), corners_);
    });
    if (corners_.empty()) return;

    const gl::Program& program =
        **programs_.get((filmed ? kFilmed : 0u) | (shadows ? kShaded : 0u)); // made before
    const GLuint frame = environment.frameTexture(); // before other textures are bound: it may upload
    program.use();
    if (filmed) {
        const CameraUniforms n = cameraUniforms(*filmed);
        program.set("black", n.black);
        program.set("range", n.range);
        program.set("glare", n.glare);
        program.set("shares", n.shares);
        program.setArray("fineNoise[0]", std::span<const float>(n.fineNoise));
        program.setArray("coarseNoise[0]", std::span<const float>(n.coarseNoise));
        program.set("grainShift", n.grainShift);
        program.set("perGrain", n.perGrain);
        program.setTexture("scattered", 1, environment.scatteredTexture());
        program.setTexture("grain", 3, grain_.name());
    }
    if (shadows) program.setTexture("shadowsLeft", 4, shadows);
    program.setTexture("frame", 2, frame);
    program.setTexture("layer", 0, layer);
    program.set("eyeFromEnv", glm::transpose(envFromWorld * glm::mat3_cast(layerView.worldFromEye)));
    program.set("rayScale", layerView.halfExtent());
    program.set("rayShift", layerView.shift);
    glViewport(0, 0, size.x, size.y);
    glDisable(GL_BLEND);
    drawn_.draw(corners_);
}

} // namespace shoal::render
