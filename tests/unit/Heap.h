// A heap that counts allocations and fails after a given number. Replaces operator new of the whole program,
// so only one of a program's files includes it.
#pragma once

#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <limits>
#include <new>

namespace shoal::heap {

inline constexpr long kUnlimited = std::numeric_limits<long>::max();
inline long left = kUnlimited; // allocations that succeed
inline bool counting = false;
inline int allocations = 0; // while counting

// Allocates; null: none is left. Allocations by OpenAL Soft 1.24, which is C++, itself are not counted.
inline void* take(std::size_t size, const void* caller) {
    Dl_info of{};
    if (counting) allocations += !dladdr(caller, &of) || !std::strstr(of.dli_fname, "libopenal");
    if (left != kUnlimited && left-- <= 0) return nullptr;
    return std::malloc(size ? size : 1);
}

inline void* takeOrThrow(std::size_t size, const void* caller) {
    if (void* p = take(size, caller)) return p;
    throw std::bad_alloc();
}

} // namespace shoal::heap

void* operator new(std::size_t size) { return shoal::heap::takeOrThrow(size, __builtin_return_address(0)); }
void* operator new[](std::size_t size) { return shoal::heap::takeOrThrow(size, __builtin_return_address(0)); }
// Replaces the form that std::stable_sort uses: free() must not get memory of the sanitizers' own version.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return shoal::heap::take(size, __builtin_return_address(0));
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
    return shoal::heap::take(size, __builtin_return_address(0));
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }
