// Names of an enumeration's values, for parsing and printing. One table per enumeration: specialise
// EnumNames<E> beside E with kNames in the order of the values, which count up from 0.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace shoal {

template <class E> struct EnumNames;

template <class E> constexpr const char* enumName(E value) {
    return EnumNames<E>::kNames[static_cast<size_t>(value)];
}

template <class E> constexpr std::optional<E> enumNamed(std::string_view name) {
    for (size_t i = 0; i < EnumNames<E>::kNames.size(); ++i)
        if (name == EnumNames<E>::kNames[i]) return static_cast<E>(i);
    return std::nullopt;
}

} // namespace shoal
