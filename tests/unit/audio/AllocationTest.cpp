// An update in steady state takes no memory from the heap.
#include "Heard.h"
#include "tests/unit/Heap.h"

#include <gtest/gtest.h>

namespace shoal::audio {
namespace {

TEST(Allocation, AnUpdateTakesNoMemory) {
    auto audio = Audio::open({.loopback = true});
    ASSERT_TRUE(audio);
    audio->add(tone(300, 0.2f));
    std::vector<float> samples(2 * 800);
    std::array<Sound, 6> emitters;
    std::array<Sound, 8> shots;
    heap::counting = true;
    for (uint32_t i = 0; i < 300; ++i) {
        for (uint32_t k = 0; k < emitters.size(); ++k)
            emitters[k] = {.id = k, .position = {0.01f * static_cast<float>(i), 0, -1}};
        audio->update({}, {emitters.data(), i % 7}, {shots.data(), i % 9}); // some start, some end
        audio->render(samples);
    }
    heap::counting = false;
    EXPECT_LE(heap::allocations, 2); // names that OpenAL Soft 1.24 makes itself by std::string
}

} // namespace
} // namespace shoal::audio
