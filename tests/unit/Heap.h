// The heap as a test sees it: how often it is asked, and where it ends. Replaces operator new of the whole
// program, so only one of a program's files includes it.
#pragma once

#include <cstdlib>
#include <limits>
#include <new>

namespace shoal::heap {

inline constexpr long kUnlimited = std::numeric_limits<long>::max();
inline long left = kUnlimited; // allocations that succeed
inline bool counting = false;
inline int allocations = 0; // while counting

inline void* take(std::size_t size) {
    if (counting) ++allocations;
    if (left != kUnlimited && left-- <= 0) throw std::bad_alloc();
    if (void* p = std::malloc(size ? size : 1)) return p;
    throw std::bad_alloc();
}

} // namespace shoal::heap

void* operator new(std::size_t size) { return shoal::heap::take(size); }
void* operator new[](std::size_t size) { return shoal::heap::take(size); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }
