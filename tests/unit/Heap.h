// The heap as a test sees it: how often it is asked, and where it ends. Replaces operator new of the whole
// program, so only one of a program's files includes it.
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

// Null: there is no more. Not counted is what OpenAL Soft 1.24, which is C++, takes for itself.
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
// As std::stable_sort asks for its buffer; the sanitizers have one of their own, which free() must not meet.
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
