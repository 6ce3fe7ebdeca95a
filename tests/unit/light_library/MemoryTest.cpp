// Nothing is allocated from a light's second frame on; an error says that there is not enough memory, and the
// maker and the light serve again.
#include "tests/unit/Heap.h"
#include "tests/unit/light_library/Library.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace {

using shoal::heap::kUnlimited, shoal::heap::left;

constexpr int kFrameWidth = 256, kFrameHeight = 128;

TEST(LightLibraryMemory, ASecondFrameTakesNone) {
    const std::vector<uint8_t> bytes(4 * kFrameWidth * kFrameHeight, 99);
    const std::vector<float> floats(4 * kFrameWidth * kFrameHeight, 0.5f);
    for (const int32_t format : {SHOAL_LIGHT_BGR8, SHOAL_LIGHT_RGBA8, SHOAL_LIGHT_RGBA32F}) {
        const bool coded = format != SHOAL_LIGHT_RGBA32F;
        const void* pixels = coded ? static_cast<const void*>(bytes.data()) : floats.data();
        const ShoalLightFrame frame{pixels, kFrameWidth, kFrameHeight, 0, format};
        shoallight::Maker maker({SHOAL_LIGHT_VIDEO, 0.05f, 512});
        shoallight::Light light;
        maker.make(frame, light);
        left = 0;
        EXPECT_NO_THROW(maker.make(frame, light)) << format;
        left = kUnlimited;
    }
}

TEST(LightLibraryMemory, TooLittleIsSaidWhereverItEnds) {
    const std::vector<uint8_t> bytes(4 * kFrameWidth * kFrameHeight, 99);
    const ShoalLightFrame frame{bytes.data(), kFrameWidth, kFrameHeight, 0, SHOAL_LIGHT_RGBA8};
    const ShoalLightOptions options{SHOAL_LIGHT_VIDEO, 0.5f, 256};
    ShoalLightMaker* none = nullptr;
    left = 0;
    EXPECT_EQ(shoalLightMakerCreate(&options, &none), SHOAL_LIGHT_OUT_OF_MEMORY);
    left = kUnlimited;
    EXPECT_EQ(none, nullptr);

    shoallight::Light wanted;
    shoallight::Maker(options).make(frame, wanted);
    ShoalLightMaker* maker = nullptr;
    ASSERT_EQ(shoalLightMakerCreate(&options, &maker), SHOAL_LIGHT_OK);
    int failures = 0;
    for (long enough = 0;; enough += 1 + enough / 4) {
        shoallight::Light light;
        left = enough;
        const ShoalLightStatus status = shoalLightMake(maker, &frame, light.object);
        left = kUnlimited;
        if (status == SHOAL_LIGHT_OK) break;
        ++failures;
        ASSERT_EQ(status, SHOAL_LIGHT_OUT_OF_MEMORY);
        EXPECT_EQ(light.maps().mapCount, 0);
        if (failures % 5) continue; // now and then: the same maker, with enough of it
        ASSERT_EQ(shoalLightMake(maker, &frame, light.object), SHOAL_LIGHT_OK);
        EXPECT_EQ(light.diffuse({0, 1, 0}), wanted.diffuse({0, 1, 0}));
        shoalLightMakerDestroy(maker);
        ASSERT_EQ(shoalLightMakerCreate(&options, &maker), SHOAL_LIGHT_OK);
    }
    EXPECT_GT(failures, 10);
    shoalLightMakerDestroy(maker);
}

} // namespace
