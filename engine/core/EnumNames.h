// Names of an enumeration's values, for parsing and printing. One table per enumeration: specialise
// kEnumNames<E> beside E with the names in the order of the values, which count up from 0.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace shoal {

template <class E> inline constexpr int kEnumNames = 0; // no names

template <class E> constexpr const char* enumName(E value) {
    return kEnumNames<E>[static_cast<size_t>(value)];
}

template <class E> constexpr std::optional<E> enumNamed(std::string_view name) {
    for (size_t i = 0; i < kEnumNames<E>.size(); ++i)
        if (name == kEnumNames<E>[i]) return static_cast<E>(i);
    return std::nullopt;
}

} // namespace shoal
