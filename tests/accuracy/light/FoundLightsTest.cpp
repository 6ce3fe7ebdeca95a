// Lights of pictures of high dynamic range are found where they are after a camera has clipped them.
#include "tests/accuracy/light/RadianceFile.h"
#include "tests/unit/light/Angles.h"
#include "tests/unit/light/Surrounds.h"

#include "engine/light/FindLights.h"
#include "engine/light/Pyramid.h"
#include "engine/math/Colour.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace shoal::light {
namespace {

struct Picture {
    const char* name;
    double within_deg; // of the clipped picture's lights the nearest to the true strongest one
};

class FoundLightsHdr : public testing::TestWithParam<Picture> {};

ImageRgb8 clipped(const ImageRgbF& radianceLin) {
    const float exposure =
        static_cast<float>(0.1 / glm::dot(meanOf(radianceLin), glm::dvec3(0.3, 0.59, 0.11)));
    ImageRgb8 frame(radianceLin.width, radianceLin.height);
    for (size_t i = 0; i < frame.pixels.size(); ++i)
        frame.pixels[i] = static_cast<uint8_t>(
            255 * math::srgbFromLinear(std::clamp(exposure * radianceLin.pixels[i], 0.0f, 1.0f)) + 0.5f);
    return frame;
}

TEST_P(FoundLightsHdr, ClippedTheyAreFoundWhereTheyWere) {
    const char* set = std::getenv("SHOAL_SHARED");
    const Path folder = (set && *set ? Path(set) : Path(SHOAL_SOURCE_DIR) / ".." / "shared") / "data" / "hdr";
    const Path file = folder / (std::string(GetParam().name) + "_1k.hdr");
    const auto picture = readRadianceFile(file);
    if (!picture) GTEST_SKIP() << file << " is not at hand";
    PyramidMaker pyramid;
    RadiancePyramid radiance;
    LightFinder finder;
    FoundLights truth, found;
    pyramid.make(*picture, 512, radiance);
    finder.find(radiance, truth);
    const ImageRgb8 frame = clipped(*picture);
    pyramid.make({frame.pixels.data(), frame.width, frame.height, ptrdiff_t{3} * frame.width, false}, 512,
                 radiance);
    finder.find(radiance, found);
    ASSERT_GT(truth.count, 0u);
    double nearest = 180;
    for (size_t i = 0; i < found.count; ++i)
        nearest = std::min(nearest, degreesBetween(found.lights[i].direction, truth.lights[0].direction));
    EXPECT_LT(nearest, GetParam().within_deg);
}

// Suns and lamps: within 2 degrees. Glows that cover a tenth of the sky and have no middle of their own are
// held by what is clipped of them: measured 2.4 degrees for the evening sky, 6.4 for the lamps of a town.
INSTANTIATE_TEST_SUITE_P(Pictures, FoundLightsHdr,
                         testing::Values(Picture{"kloppenheim_05", 2}, Picture{"studio_small_03", 2},
                                         Picture{"st_fagans_interior", 2}, Picture{"rainforest_trail", 2},
                                         Picture{"venice_sunset", 4}, Picture{"dikhololo_night", 8}),
                         [](const auto& each) { return std::string(each.param.name); });

} // namespace
} // namespace shoal::light
