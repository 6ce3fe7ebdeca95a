// In steady state an update takes no memory from the heap.
#include "Heard.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

namespace {
bool counting = false;
int allocations = 0;

void* take(std::size_t size) {
    if (counting) ++allocations;
    if (void* p = std::malloc(size ? size : 1)) return p;
    throw std::bad_alloc();
}
} // namespace

void* operator new(std::size_t size) { return take(size); }
void* operator new[](std::size_t size) { return take(size); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }

namespace shoal::audio {
namespace {

TEST(Allocation, AnUpdateTakesNoMemory) {
    auto audio = Audio::open({.loopback = true});
    ASSERT_TRUE(audio);
    audio->add(tone(300, 0.2f));
    std::vector<float> samples(2 * 800);
    std::array<Emitter, 6> emitters;
    std::array<Shot, 8> shots;
    counting = true;
    for (uint32_t i = 0; i < 300; ++i) {
        for (uint32_t k = 0; k < emitters.size(); ++k)
            emitters[k] = {.id = k, .position = {0.01f * static_cast<float>(i), 0, -1}};
        audio->update({}, {emitters.data(), i % 7}, {shots.data(), i % 9}); // some start, some end
        audio->render(samples);
    }
    counting = false;
    EXPECT_EQ(allocations, 0);
}

} // namespace
} // namespace shoal::audio
